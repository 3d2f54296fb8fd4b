//! Conversion between URIs and file paths.

use std::path::{Path, PathBuf};

/// The path of a URI; a URI of another scheme than `file` gives a path that does not exist.
pub(super) fn path_of(uri: &str) -> PathBuf {
    let Some(rest) = uri.strip_prefix("file://") else { return PathBuf::from(uri) };
    // An authority is that of this machine, or of a share on Windows.
    let (authority, path) = rest.split_at(rest.find('/').unwrap_or(rest.len()));
    path_from(authority, decoded(path))
}

#[cfg(not(windows))]
fn path_from(_authority: &str, path: Vec<u8>) -> PathBuf {
    use std::os::unix::ffi::OsStringExt;
    PathBuf::from(std::ffi::OsString::from_vec(path))
}

/// `/c:/decks` is `c:/decks`; with an authority it is a share.
#[cfg(windows)]
fn path_from(authority: &str, path: Vec<u8>) -> PathBuf {
    let path = String::from_utf8_lossy(&path).into_owned();
    let has_drive = path.as_bytes().get(2) == Some(&b':');
    match authority {
        _ if has_drive => PathBuf::from(&path[1..]),
        "" | "localhost" => PathBuf::from(path),
        _ => PathBuf::from(format!("//{authority}{path}")),
    }
}

pub(super) fn uri_of(path: &Path) -> String {
    let bytes = path.as_os_str().as_encoded_bytes();
    let mut uri = "file://".to_owned();
    if !bytes.starts_with(b"/") {
        uri.push('/');
    }
    for byte in bytes {
        match byte {
            b'\\' if cfg!(windows) => uri.push('/'),
            byte if byte.is_ascii_alphanumeric() || b"-._~/@".contains(byte) => uri.push(char::from(*byte)),
            byte => uri.push_str(&format!("%{byte:02X}")),
        }
    }
    uri
}

/// Bytes with `%41` read as `A`.
fn decoded(text: &str) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let [first, after @ ..] = rest {
        let code = after.get(..2).filter(|_| *first == b'%').and_then(|digits| str::from_utf8(digits).ok());
        match code.and_then(|digits| u8::from_str_radix(digits, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                rest = &after[2..];
            }
            None => {
                bytes.push(*first);
                rest = after;
            }
        }
    }
    bytes
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn there_and_back() {
        for path in ["/a/b.inp", "/a b/ü/ß#?.inp", "/a%41.inp", "/a:b.inp"] {
            assert_eq!(path_of(&uri_of(Path::new(path))), Path::new(path), "{}", uri_of(Path::new(path)));
        }
    }

    #[test]
    fn what_editors_write() {
        assert_eq!(path_of("file:///c%3A/decks/a.inp"), Path::new("/c:/decks/a.inp"));
        assert_eq!(path_of("file://localhost/a%20b.inp"), Path::new("/a b.inp"));
        assert_eq!(path_of("file:///100%.inp"), Path::new("/100%.inp"));
        assert_eq!(path_of("untitled:Untitled-1"), Path::new("untitled:Untitled-1"));
    }
}
