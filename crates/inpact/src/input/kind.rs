//! Distinguishes decks and scenes: by name, or by content where the name does not tell.

use crate::failure::Failure;
use crate::files::STANDARD_STREAM;
use std::fs::File;
use std::io::{BufRead, Read, stdin};
use std::path::Path;

/// The number of bytes inspected of a file without `.toml`.
const LOOKED_AT: u64 = 8 * 1024;

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Kind {
    /// A deck or a fragment of one.
    Deck,
    Scene,
}

/// The kind of a file: a scene by its name, or by its content where the name does not tell.
pub(crate) fn kind_of(path: &Path) -> Kind {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
    let begins_as_scene = || match beginning(path) {
        Some(bytes) => is_scene(&bytes),
        // Read errors are reported by the reader.
        None => false,
    };
    match extension.as_deref() {
        Some("toml") => Kind::Scene,
        Some("inp") => Kind::Deck,
        _ if begins_as_scene() => Kind::Scene,
        _ => Kind::Deck,
    }
}

/// Rejects a scene where a deck is expected: as a deck it would be rows without a keyword, without any findings.
pub(crate) fn refuse_scene(path: &Path) -> Result<(), Failure> {
    if kind_of(path) == Kind::Deck {
        return Ok(());
    }
    let name = path.display();
    Err(Failure::Usage(format!(
        "`{name}` is a scene, where a deck is expected: `inpact solve {name}` solves it, and `inpact check {name}` judges it"
    )))
}

/// The first bytes of a file; those of standard input are not consumed.
fn beginning(path: &Path) -> Option<Vec<u8>> {
    if path.as_os_str() == STANDARD_STREAM {
        return stdin().lock().fill_buf().ok().map(<[u8]>::to_vec);
    }
    // Anything but a regular file can be read only once.
    path.metadata().ok().filter(std::fs::Metadata::is_file)?;
    let mut bytes = Vec::new();
    File::open(path).ok()?.take(LOOKED_AT).read_to_end(&mut bytes).ok()?;
    Some(bytes)
}

/// Whether a text looks like a scene: it begins with a table, or a key and a value, has some line with a table or `deck`, and no keyword line.
fn is_scene(bytes: &[u8]) -> bool {
    let lines = bytes.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii);
    let mut lines = lines.filter(|line| !line.is_empty() && !line.starts_with(b"#")).peekable();
    let is_of_key = |byte: &u8| byte.is_ascii_alphanumeric() || b"_-\"'. ".contains(byte);
    let key_of = |line: &[u8]| line.iter().position(|byte| !is_of_key(byte)).filter(|end| line[*end] == b'=');
    let is_toml = |line: &[u8]| line.starts_with(b"[") || key_of(line).is_some_and(|length| 0 < length);
    // The definitions of a deck's parameters are keys with values as well.
    let is_of_scene = |line: &[u8]| line.starts_with(b"[") || (line.starts_with(b"deck") && is_toml(line));
    if !lines.peek().is_some_and(|first| is_toml(first)) {
        return false;
    }
    let mut has_sign = false;
    lines.all(|line| {
        has_sign |= is_of_scene(line);
        !line.starts_with(b"*")
    }) && has_sign
}

#[cfg(test)]
mod tests {
    use super::is_scene;

    #[test]
    fn a_scene_is_known_by_its_beginning() {
        for scene in ["deck = \"a.inp\"\n", "# made\n\n[time]\nend = 1.0\n", "[[node]]\n", " deck='a'"] {
            assert!(is_scene(scene.as_bytes()), "{scene}");
        }
        for other in [
            "",
            "*NODE\n1, 0.\n",
            "** A\n",
            "1., 2.\n",
            "a = 3\n*NODE\n",
            "a = 3\nb = a\n",
            "version https://git-lfs\n",
            "# only\n",
        ] {
            assert!(!is_scene(other.as_bytes()), "{other}");
        }
    }
}
