//! Files that an untrusted deck may read.
//!
//! Only regular files: no folders, devices, pipes or sockets, and none of the virtual files that the system generates when they are
//! read, such as `/proc/self/environ`, which may hold the secrets of a CI job. With roots (`--include-root`) nothing outside of them is
//! read, whatever the name and wherever a symbolic link leads; files are judged by their canonical paths.

use crate::files;
use std::fs::Metadata;
use std::path::{Component, Path, PathBuf};

/// Folders of virtual files. Shared memory of programs in `/dev/shm` is not among them.
const OF_THE_SYSTEM: [&str; 3] = ["/proc", "/sys", "/dev"];
const SHARED_MEMORY: &str = "/dev/shm";

/// The reason why a file named in a deck is not read; `None` for a regular one, and for a missing one.
pub(crate) fn irregular(path: &Path) -> Option<&'static str> {
    let found = path.metadata().ok()?;
    if found.is_dir() {
        return Some("it is a folder");
    }
    if !found.is_file() {
        return Some("it is a device, a pipe or a socket: only regular files are read");
    }
    let is_made_up = path.canonicalize().is_ok_and(|whole| is_of_the_system(&whole, &found));
    is_made_up.then_some("it is made up by the system when it is read: only regular files of a disk are")
}

/// Whether a file lies in `/proc`, `/sys` or `/dev`, or in a copy of one of the first two that is mounted elsewhere.
fn is_of_the_system(whole: &Path, found: &Metadata) -> bool {
    let is_below = OF_THE_SYSTEM.iter().any(|folder| whole.starts_with(folder)) && !whole.starts_with(SHARED_MEMORY);
    is_below || is_on_device_of(found, &OF_THE_SYSTEM[..2])
}

#[cfg(unix)]
fn is_on_device_of(found: &Metadata, folders: &[&str]) -> bool {
    use std::os::unix::fs::MetadataExt;
    // Without such a file system the folder is an ordinary one on disk.
    let of_disk = Path::new("/").metadata().map(|root| root.dev()).ok();
    let device = |folder: &&str| Path::new(folder).metadata().map(|folder| folder.dev()).ok();
    folders.iter().filter_map(device).any(|device| device == found.dev() && Some(device) != of_disk)
}

#[cfg(not(unix))]
fn is_on_device_of(_found: &Metadata, _folders: &[&str]) -> bool {
    false
}

/// Whether a file lies in all of some folders: by the link target if it exists, otherwise by its name.
pub(crate) fn lies_in_all(path: &Path, roots: &[PathBuf]) -> bool {
    if roots.is_empty() {
        return true;
    }
    let whole = path.canonicalize().unwrap_or_else(|_| without_dots(path));
    roots.iter().all(|root| whole.starts_with(root))
}

/// The canonical path of a missing file: that of the nearest existing folder, and the rest with `..` resolved textually.
fn without_dots(path: &Path) -> PathBuf {
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let mut whole = PathBuf::new();
    for component in absolute.components() {
        match component {
            Component::ParentDir => {
                whole.pop();
            }
            other => whole.push(other),
        }
        if let Ok(found) = whole.canonicalize() {
            whole = found;
        }
    }
    whole
}

/// The reason why a named deck is not read: it is a link out of the roots, or to a virtual file.
pub(crate) fn leads_astray(deck: &Path, roots: &[PathBuf]) -> Option<String> {
    let (Ok(whole), Some(name)) = (deck.canonicalize(), deck.file_name()) else { return None };
    let named = folder_of_deck(deck).join(name);
    // A stream such as `/dev/stdin` is always a link, and named on purpose.
    let is_plain = whole == named || OF_THE_SYSTEM.iter().any(|folder| named.starts_with(folder));
    let found = deck.metadata().ok().filter(Metadata::is_file)?;
    if is_plain {
        return None;
    }
    if is_of_the_system(&whole, &found) {
        return Some("it is a link to a file that the system makes up when it is read".to_owned());
    }
    let root = roots.iter().find(|root| !whole.starts_with(root))?;
    Some(format!("it is a link that leads out of `{}`, outside of which nothing is read", root.display()))
}

/// The canonical path of the folder of a deck; the working folder for standard input.
pub(crate) fn folder_of_deck(deck: &Path) -> PathBuf {
    let folder = files::folder_of(deck);
    folder.canonicalize().unwrap_or_else(|_| folder.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_the_system_are_irregular() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("a.inp");
        std::fs::write(&file, "*HEADING\n").expect("written");
        assert_eq!(irregular(&file), None);
        assert_eq!(irregular(&folder.path().join("b.inp")), None);
        assert_eq!(irregular(folder.path()), Some("it is a folder"));
        #[cfg(target_os = "linux")]
        for path in ["/proc/self/environ", "/proc/version", "/dev/zero", "/sys/kernel/mm/transparent_hugepage/enabled"]
        {
            assert!(irregular(Path::new(path)).is_some() || !Path::new(path).exists(), "{path}");
        }
    }

    #[test]
    fn a_name_that_leads_out_lies_outside_whether_it_is_there_or_not() {
        let folder = tempfile::tempdir().expect("a folder");
        let root = folder.path().join("root").join("below");
        std::fs::create_dir_all(&root).expect("made");
        std::fs::write(folder.path().join("secret"), "x").expect("written");
        let roots = [root.parent().expect("a folder").canonicalize().expect("there")];
        for inside in ["a.inp", "../a.inp", "new/../a.inp", "../below/a.inp"] {
            assert!(lies_in_all(&root.join(inside), &roots), "{inside}");
        }
        for outside in ["../../secret", "../../nothing", "new/../../../nothing", "/etc/passwd", "/nothing/there"] {
            assert!(!lies_in_all(&root.join(outside), &roots), "{outside}");
        }
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(folder.path(), root.join("out")).expect("linked");
            assert!(!lies_in_all(&root.join("out/secret"), &roots));
            assert!(!lies_in_all(&root.join("out/nothing"), &roots));
        }
        assert!(lies_in_all(Path::new("/etc/passwd"), &[]));
    }
}
