//! Other programs that have a file open for writing: one that opened it before the exchange of names may still write to it afterwards.

use std::path::Path;

/// Whether another visible process has the file at `path` open for writing.
///
/// Only on Linux, and only for processes of the same user, or for all as root.
#[cfg(target_os = "linux")]
pub(super) fn is_open_for_writing(paths: &[&Path]) -> Vec<bool> {
    let mut found = vec![false; paths.len()];
    if paths.is_empty() {
        return found;
    }
    let own = std::process::id().to_string();
    let Ok(processes) = std::fs::read_dir("/proc") else { return found };
    for process in processes.flatten() {
        let name = process.file_name();
        let is_process =
            name.to_str().is_some_and(|name| name.bytes().all(|byte| byte.is_ascii_digit()) && name != own);
        if !is_process {
            continue;
        }
        // Processes of other users, and those that have ended, are not readable.
        let Ok(descriptors) = std::fs::read_dir(process.path().join("fd")) else { continue };
        for descriptor in descriptors.flatten() {
            let Ok(open) = std::fs::read_link(descriptor.path()) else { continue };
            let Some(index) = paths.iter().position(|path| *path == open) else { continue };
            found[index] |= is_for_writing(&process.path().join("fdinfo").join(descriptor.file_name()));
        }
    }
    found
}

/// Whether the flags of an open file say that it can be written to.
#[cfg(target_os = "linux")]
fn is_for_writing(information: &Path) -> bool {
    /// `O_WRONLY` or `O_RDWR`.
    const WRITES: u32 = 0o3;
    let Ok(information) = std::fs::read_to_string(information) else { return false };
    let flags = information.lines().find_map(|line| line.strip_prefix("flags:"));
    flags.and_then(|flags| u32::from_str_radix(flags.trim(), 8).ok()).is_some_and(|flags| flags & WRITES != 0)
}

#[cfg(not(target_os = "linux"))]
pub(super) fn is_open_for_writing(paths: &[&Path]) -> Vec<bool> {
    vec![false; paths.len()]
}
