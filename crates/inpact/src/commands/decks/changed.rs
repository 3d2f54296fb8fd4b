//! The files that a branch changes, from git.

use crate::failure::Failure;
use crate::files;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Files that differ from the merge base of a branch.
#[derive(Debug)]
pub(crate) struct Changed(BTreeSet<PathBuf>);

impl Changed {
    /// Differences between the working tree and the merge base of `reference` and this branch, including new files.
    ///
    /// # Errors
    /// The error message of git, or git cannot be run.
    pub(crate) fn since(reference: &str) -> Result<Self, Failure> {
        if reference.starts_with('-') {
            return Err(Failure::Usage(format!("`--since`: `{reference}` is no reference of git")));
        }
        let here = Path::new(".");
        let top = git(here, &["rev-parse", "--show-toplevel"])?;
        let top = path_of(top.strip_suffix(b"\n").unwrap_or(&top));
        let base = git(here, &["merge-base", "HEAD", reference])?;
        let base = String::from_utf8_lossy(&base).trim().to_owned();
        let changed = git(here, &["diff", "--name-only", "--no-renames", "-z", &base, "--"])?;
        // Run at the top level: names of new files are relative to the working folder.
        let new = git(&top, &["ls-files", "--others", "--exclude-standard", "-z"])?;
        let names = changed.split(|byte| *byte == 0).chain(new.split(|byte| *byte == 0));
        let names = names.filter(|name| !name.is_empty());
        Ok(Self(names.map(|name| files::whole_path(&top.join(path_of(name)))).collect()))
    }

    /// Whether a file is one of them; by its whole path.
    pub(crate) fn has(&self, place: &Path) -> bool {
        self.0.contains(place)
    }
}

/// The output of git in a folder.
fn git(folder: &Path, arguments: &[&str]) -> Result<Vec<u8>, Failure> {
    let output = Command::new("git")
        .arg("-C")
        .arg(folder)
        .args(arguments)
        .output()
        .map_err(|error| Failure::Usage(format!("`--since` asks git, which cannot be run: {error}")))?;
    if output.status.success() {
        return Ok(output.stdout);
    }
    let said = String::from_utf8_lossy(&output.stderr);
    Err(Failure::Usage(format!("`--since`: git says: {}", said.trim())))
}

#[cfg(unix)]
fn path_of(bytes: &[u8]) -> PathBuf {
    use std::os::unix::ffi::OsStrExt;
    PathBuf::from(std::ffi::OsStr::from_bytes(bytes))
}

#[cfg(not(unix))]
fn path_of(bytes: &[u8]) -> PathBuf {
    PathBuf::from(String::from_utf8_lossy(bytes).into_owned())
}
