//! `--into`: writes the files of the lossless form into a folder, all of them or none.

use crate::failure::{Failure, say_failures};
use crate::files;
use crate::files::transaction::{self, Change};
use std::io;
use std::path::{Component, Path, PathBuf};

/// Folders created for the files; empty ones are removed again.
struct MadeFolders(Vec<PathBuf>);

/// Writes the files under their names into a folder; every name is checked before anything is written.
pub(super) fn write(folder: &Path, decks: &[(String, Vec<u8>)]) -> Result<(), Failure> {
    let paths = decks.iter().map(|(name, _)| below(folder, name)).collect::<Result<Vec<PathBuf>, Failure>>()?;
    refuse_conflicts(&paths)?;
    let mut made = MadeFolders(Vec::new());
    for path in &paths {
        made.make(files::folder_of(path))?;
    }
    let whole = folder.canonicalize().map_err(|error| Failure::write(folder, error))?;
    for (path, (name, _)) in paths.iter().zip(decks) {
        // A link in the folder may lead outside.
        if !files::whole_path(path).starts_with(&whole) {
            return Err(leads_out(folder, name));
        }
    }
    let targets: Vec<Option<&Path>> = paths.iter().map(|path| Some(path.as_path())).collect();
    files::check_targets(&targets)?;
    let changes = paths.iter().zip(decks).map(|(path, (_, bytes))| Change::result(path, bytes.as_slice().into()));
    let changes: Vec<Change> = changes.collect();
    transaction::commit(&changes).map_err(|failures| {
        say_failures(&failures);
        Failure::AlreadySaid
    })?;
    made.0.clear();
    Ok(())
}

/// The path of a file in the folder; a name that leads outside, or names no file, is rejected.
fn below(folder: &Path, name: &str) -> Result<PathBuf, Failure> {
    let parts: Vec<Component<'_>> = Path::new(name).components().collect();
    if parts.iter().any(|part| !matches!(part, Component::Normal(_) | Component::CurDir)) {
        return Err(leads_out(folder, name));
    }
    let names: PathBuf = parts.into_iter().filter(|part| *part != Component::CurDir).collect();
    if names.as_os_str().is_empty() || name.ends_with(std::path::is_separator) || name.contains('\0') {
        return Err(Failure::Data(format!("`{}` is no name of a file", name.escape_debug())));
    }
    Ok(folder.join(names))
}

fn leads_out(folder: &Path, name: &str) -> Failure {
    Failure::Data(format!("`{name}` leads out of `{}`: name the files relative to it", folder.display()))
}

/// Rejects two files with the same name, and a file with the name of another's folder.
fn refuse_conflicts(paths: &[PathBuf]) -> Result<(), Failure> {
    let mut sorted: Vec<&PathBuf> = paths.iter().collect();
    sorted.sort();
    for pair in sorted.windows(2) {
        if pair[0] == pair[1] {
            return Err(Failure::Data(format!("two files would go to `{}`: name two", pair[0].display())));
        }
        if pair[1].starts_with(pair[0]) {
            let (file, below) = (pair[0].display(), pair[1].display());
            return Err(Failure::Data(format!("`{file}` cannot be a file and the folder of `{below}`")));
        }
    }
    Ok(())
}

impl MadeFolders {
    fn make(&mut self, folder: &Path) -> Result<(), Failure> {
        let missing: Vec<&Path> = folder.ancestors().take_while(|folder| !folder.as_os_str().is_empty()).collect();
        for folder in missing.into_iter().rev() {
            match std::fs::create_dir(folder) {
                Ok(()) => self.0.push(folder.to_owned()),
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists && folder.is_dir() => {}
                // Roots and drives cannot be created, and exist.
                Err(_) if folder.is_dir() => {}
                Err(error) => return Err(Failure::write(folder, error)),
            }
        }
        Ok(())
    }
}

impl Drop for MadeFolders {
    fn drop(&mut self) {
        for folder in self.0.drain(..).rev() {
            // A folder that is not empty is used by others by now.
            let _ = std::fs::remove_dir(folder);
        }
    }
}
