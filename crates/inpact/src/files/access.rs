//! Owner and permissions of a file: a file that replaces another keeps them.

use std::fs::{File, Metadata};
use std::io;
use std::path::Path;

/// Rejects a file that the user may not write to: with write access to its folder it could be replaced against its protection.
pub(super) fn require_writable(path: &Path, present: &Metadata) -> io::Result<()> {
    if present.permissions().readonly() {
        // The superuser may still write to it.
        return Err(io::Error::new(io::ErrorKind::PermissionDenied, "it is read-only"));
    }
    File::options().write(true).open(path).map(drop)
}

/// Gives `file` owner, group, permissions and attributes of the file at `path`, which it will replace.
///
/// The right to act as the owner (set-user-id, set-group-id) is not passed on to other content.
#[cfg(unix)]
pub(super) fn pass_on(path: &Path, present: &Metadata, file: &File) -> io::Result<()> {
    use std::os::unix::fs::{MetadataExt, PermissionsExt, fchown};
    let made = file.metadata()?;
    if (made.uid(), made.gid()) != (present.uid(), present.gid()) {
        fchown(file, Some(present.uid()), Some(present.gid())).map_err(|error| {
            let (user, group) = (present.uid(), present.gid());
            let message = format!(
                "it belongs to user {user} and group {group}, which a new file in its place would not ({error}); write a copy"
            );
            io::Error::new(io::ErrorKind::PermissionDenied, message)
        })?;
    }
    #[cfg(target_os = "linux")]
    attributes::pass_on(path, file)?;
    #[cfg(not(target_os = "linux"))]
    let _ = path;
    file.set_permissions(std::fs::Permissions::from_mode(present.mode() & 0o1777))
}

/// Gives `file` the permissions of the file that it will replace.
#[cfg(not(unix))]
pub(super) fn pass_on(_path: &Path, present: &Metadata, file: &File) -> io::Result<()> {
    file.set_permissions(present.permissions())
}

/// Extended attributes, of which access lists are one.
#[cfg(target_os = "linux")]
mod attributes {
    use rustix::fs::{XattrFlags, fgetxattr, flistxattr, fremovexattr, fsetxattr};
    use std::ffi::OsStr;
    use std::fs::File;
    use std::io;
    use std::os::unix::ffi::OsStrExt;
    use std::path::Path;

    /// The largest attribute, and the longest list of names, of any file system.
    const MAX_BYTES: usize = 64 * 1024;

    const ACCESS_LIST: &str = "system.posix_acl_access";

    /// Copies the attributes of the file at `path`.
    ///
    /// # Errors
    /// An access list that cannot be copied: without it others could read the file, or could no longer.
    pub(super) fn pass_on(path: &Path, file: &File) -> io::Result<()> {
        let original = File::open(path)?;
        // One that the folder gives to its new files.
        let _ = fremovexattr(file, ACCESS_LIST);
        let mut names = vec![0_u8; MAX_BYTES];
        let Ok(length) = flistxattr(&original, &mut names[..]) else { return Ok(()) };
        let mut value = vec![0_u8; MAX_BYTES];
        for name in names[..length].split(|byte| *byte == 0).filter(|name| !name.is_empty()) {
            let name = OsStr::from_bytes(name);
            if name == "security.capability" {
                // A right of the replaced program, like set-user-id.
                continue;
            }
            let copied = fgetxattr(&original, name, &mut value[..])
                .and_then(|length| fsetxattr(file, name, &value[..length], XattrFlags::empty()));
            if name == ACCESS_LIST {
                copied?;
            }
        }
        Ok(())
    }
}
