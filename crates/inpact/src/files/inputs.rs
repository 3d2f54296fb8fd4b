//! The files that this run has read, for all commands: no result ever overwrites one of them.

use crate::failure::Failure;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{File, Metadata};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The identity of a file, independent of its name.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Identity {
    #[cfg(unix)]
    device: u64,
    #[cfg(unix)]
    number: u64,
    #[cfg(not(unix))]
    path: PathBuf,
}

impl Identity {
    /// The identity of what `metadata` was taken from; `path` is where that is.
    #[cfg(unix)]
    pub(crate) fn of(metadata: &Metadata, _path: &Path) -> Self {
        use std::os::unix::fs::MetadataExt;
        Self { device: metadata.dev(), number: metadata.ino() }
    }

    /// The identity of what `metadata` was taken from; `path` is where that is.
    #[cfg(not(unix))]
    pub(crate) fn of(_metadata: &Metadata, path: &Path) -> Self {
        Self { path: super::whole_path(path) }
    }

    /// The identity of the file at `path`, links followed; `None` when there is none.
    pub(crate) fn at(path: &Path) -> Option<Self> {
        std::fs::metadata(path).ok().map(|metadata| Self::of(&metadata, path))
    }
}

/// The files read so far, by identity and by path, since a file may be replaced after it was read.
#[derive(Debug, Default)]
struct Inputs {
    /// With the name under which each was read.
    files: BTreeMap<Identity, PathBuf>,
    places: BTreeSet<PathBuf>,
}

static INPUTS: Mutex<Inputs> = Mutex::new(Inputs { files: BTreeMap::new(), places: BTreeSet::new() });

fn inputs() -> MutexGuard<'static, Inputs> {
    INPUTS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Records an open file, or a file named as an input; devices and pipes cannot be overwritten.
pub(super) fn take_down(file: &File, path: &Path) {
    if let Ok(metadata) = file.metadata() {
        take_down_metadata(&metadata, path);
    }
}

/// Records a file that is not read by [`super`], such as by the library loader.
pub(crate) fn take_down_path(path: &Path) {
    if let Ok(metadata) = std::fs::metadata(path) {
        take_down_metadata(&metadata, path);
    }
}

fn take_down_metadata(metadata: &Metadata, path: &Path) {
    if !metadata.is_file() {
        return;
    }
    let (identity, place) = (Identity::of(metadata, path), super::whole_path(path));
    let mut inputs = inputs();
    inputs.files.entry(identity).or_insert_with(|| path.to_owned());
    inputs.places.insert(place);
}

/// Records standard input where it is a file, and returns its metadata.
#[cfg(unix)]
pub(super) fn take_down_standard_input() -> Option<Metadata> {
    let metadata = standard_metadata(&std::io::stdin());
    if let Some(metadata) = metadata.as_ref().filter(|metadata| metadata.is_file()) {
        let name = PathBuf::from("standard input");
        inputs().files.entry(Identity::of(metadata, &name)).or_insert(name);
    }
    metadata
}

/// Records standard input where it is a file: only Unix knows which.
#[cfg(not(unix))]
pub(super) fn take_down_standard_input() -> Option<Metadata> {
    None
}

#[cfg(unix)]
pub(super) fn standard_metadata(stream: &impl std::os::fd::AsFd) -> Option<Metadata> {
    let descriptor = stream.as_fd().try_clone_to_owned().ok()?;
    File::from(descriptor).metadata().ok()
}

/// Rejects a result that would overwrite a file that this run has read.
pub(super) fn refuse(target: &Path) -> Result<(), Failure> {
    let identity = Identity::at(target);
    let inputs = inputs();
    let by_identity = identity.and_then(|identity| inputs.files.get(&identity));
    let by_place = || inputs.places.get(&super::whole_path(target));
    match by_identity.or_else(by_place) {
        Some(input) => Err(replaces(input)),
        None => Ok(()),
    }
}

/// Rejects a result to a standard stream that is a file which this run has read.
#[cfg(unix)]
pub(super) fn refuse_standard(stream: &impl std::os::fd::AsFd) -> Result<(), Failure> {
    let Some(metadata) = standard_metadata(stream).filter(Metadata::is_file) else { return Ok(()) };
    match inputs().files.get(&Identity::of(&metadata, Path::new(""))) {
        Some(input) => Err(replaces(input)),
        None => Ok(()),
    }
}

fn replaces(input: &Path) -> Failure {
    Failure::Usage(format!("the result would replace `{}`, which it is made from", input.display()))
}
