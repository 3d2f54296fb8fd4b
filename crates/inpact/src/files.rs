//! Decks in, results out: the only place where files are opened.
//!
//! Files read here are recorded, and none of them is overwritten, except by a [`transaction`] that replaces its own input.

mod access;
mod holders;
pub(crate) mod inputs;
mod result;
mod temporary;
pub(crate) mod transaction;
mod whole;

pub(crate) use inputs::take_down_path as name_as_input;
pub(crate) use result::{ResultFile, write_result};
pub(crate) use temporary::{remove_all as remove_temporary_files, remove_on_signals};
pub(crate) use whole::{read_lines, read_text};

use crate::failure::Failure;
use inpact_parser::deck::Scanner;
use std::fs::{File, Metadata};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::time::SystemTime;
use whole::LONGEST_LINE;

/// The number of bytes of a deck read at a time: few enough to stay in cache.
const PIECE: usize = 64 * 1024;

/// The name of standard input and standard output.
pub(crate) const STANDARD_STREAM: &str = "-";

/// Pushes a file into a scanner in pieces; standard input for `-`.
pub(crate) fn push_all(path: &Path, scanner: &mut Scanner<'_>) -> Result<(), Failure> {
    let mut input = open(path)?;
    let mut piece = vec![0; PIECE];
    loop {
        match input.read(&mut piece) {
            Ok(0) => return Ok(()),
            Ok(count) => {
                scanner.push(&piece[..count]);
                refuse_endless_line(path, scanner)?;
            }
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(Failure::read(path, error)),
        }
    }
}

/// A line is kept whole until it ends: without a limit an endless line would take all memory.
fn refuse_endless_line(path: &Path, scanner: &Scanner<'_>) -> Result<(), Failure> {
    if scanner.unfinished() <= LONGEST_LINE {
        return Ok(());
    }
    Err(Failure::read(path, whole::endless_line(scanner.line())))
}

/// Opens a file for reading, or standard input for `-`.
pub(crate) fn open(path: &Path) -> Result<Box<dyn Read>, Failure> {
    if path.as_os_str() == STANDARD_STREAM {
        let metadata = inputs::take_down_standard_input();
        return Ok(Box::new(whole::bounded(io::stdin().lock(), metadata.as_ref())));
    }
    let file = open_file(path)?;
    let metadata = file.metadata().ok();
    Ok(Box::new(whole::bounded(file, metadata.as_ref())))
}

/// Whether a path can be read only once: standard input, a pipe or a device.
pub(crate) fn is_stream(path: &Path) -> bool {
    let is_special = |metadata: Metadata| !metadata.is_file() && !metadata.is_dir();
    path.as_os_str() == STANDARD_STREAM || path.metadata().is_ok_and(is_special)
}

/// Refuses to read standard input more than once.
pub(crate) fn refuse_second_stream(paths: &[PathBuf]) -> Result<(), Failure> {
    if 1 < paths.iter().filter(|path| path.as_os_str() == STANDARD_STREAM).count() {
        return Err(Failure::Usage("standard input can be read only once".to_owned()));
    }
    Ok(())
}

/// Metadata that identify a file as the one that was read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Stamp {
    modified: Option<SystemTime>,
    length: u64,
}

impl Stamp {
    /// `None` for a missing file.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        let found = path.metadata().ok()?;
        Some(Self { modified: found.modified().ok(), length: found.len() })
    }
}

/// Opens a file for reading.
pub(crate) fn open_file(path: &Path) -> Result<File, Failure> {
    let file = File::open(path).map_err(|error| Failure::read(path, error))?;
    let is_folder = file.metadata().is_ok_and(|metadata| metadata.is_dir());
    if is_folder {
        return Err(Failure::read(path, io::Error::new(io::ErrorKind::IsADirectory, "it is a folder")));
    }
    inputs::take_down(&file, path);
    Ok(file)
}

/// Rejects results that would overwrite a file that this run has read, or one another, before the work is done; they are checked again when they are written.
///
/// A target that is not a regular file, such as a device, takes several results.
pub(crate) fn check_targets(targets: &[Option<&Path>]) -> Result<(), Failure> {
    let mut taken: Vec<PathBuf> = Vec::new();
    let is_file = |target: &&Path| {
        target.as_os_str() != STANDARD_STREAM && std::fs::metadata(target).map_or(true, |present| present.is_file())
    };
    for target in targets.iter().flatten().copied().filter(is_file) {
        inputs::refuse(target)?;
        let whole = whole_path(target);
        if taken.contains(&whole) {
            return Err(Failure::Usage(format!("two results would go to `{}`: name two files", target.display())));
        }
        taken.push(whole);
    }
    Ok(())
}

/// Records files that are named as inputs, so that no result overwrites one of them.
pub(crate) fn name_as_inputs<P: AsRef<Path>>(paths: &[P]) {
    paths.iter().map(AsRef::as_ref).filter(|path| path.as_os_str() != STANDARD_STREAM).for_each(name_as_input);
}

/// A path that identifies a file, existing or not; links are resolved, including dangling ones.
pub(crate) fn whole_path(path: &Path) -> PathBuf {
    /// More than any system resolves.
    const MAX_LINKS: usize = 40;
    let mut path = path.to_owned();
    for _ in 0..MAX_LINKS {
        if let Ok(whole) = path.canonicalize() {
            return whole;
        }
        let Ok(link) = path.read_link() else { break };
        path = folder_of(&path).join(link);
    }
    let name = path.file_name().unwrap_or_default();
    match folder_of(&path).canonicalize() {
        Ok(folder) => folder.join(name),
        Err(_) => std::path::absolute(&path).unwrap_or(path),
    }
}

pub(crate) fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Syncs a file to disk.
fn sync_file(file: &File) -> io::Result<()> {
    match file.sync_all() {
        Err(error) if cannot_sync(&error) => Ok(()),
        done => done,
    }
}

/// Waits until the names in a folder are stored.
#[cfg(unix)]
fn sync_folder(folder: &Path) -> io::Result<()> {
    // A folder that may be written to but not read cannot be listed.
    File::open(folder).map_or(Ok(()), |folder| sync_file(&folder))
}

/// Syncs the entries of a folder to disk: only Unix supports it.
#[cfg(not(unix))]
#[allow(clippy::unnecessary_wraps)]
fn sync_folder(_folder: &Path) -> io::Result<()> {
    Ok(())
}

/// Some file systems do not support syncing.
fn cannot_sync(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::InvalidInput | io::ErrorKind::Unsupported)
}
