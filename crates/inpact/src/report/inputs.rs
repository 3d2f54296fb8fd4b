//! The input files of a report, with their hashes.

use crate::failure::Failure;
use crate::files::{self, STANDARD_STREAM};
use sha2::{Digest, Sha256};
use std::io::Read;
use std::path::Path;

/// A file that was read.
pub(crate) struct Input {
    pub(crate) name: String,
    /// Its length; `None` for a stream, which cannot be read again.
    pub(crate) bytes: Option<u64>,
    /// The SHA-256 of its bytes in hexadecimal digits.
    pub(crate) hash: Option<String>,
}

impl Input {
    /// Reads a file for its hash.
    ///
    /// # Errors
    /// A file that cannot be read any more.
    pub(crate) fn of(path: &Path) -> Result<Self, Failure> {
        let name = path.display().to_string();
        let is_file = path.metadata().is_ok_and(|metadata| metadata.is_file());
        if path.as_os_str() == STANDARD_STREAM || !is_file {
            return Ok(Self { name, bytes: None, hash: None });
        }
        let mut file = files::open_file(path)?;
        let mut hasher = Sha256::new();
        let mut bytes = 0_u64;
        let mut piece = vec![0; 1 << 16];
        loop {
            let count = file.read(&mut piece).map_err(|error| Failure::read(path, error))?;
            if count == 0 {
                break;
            }
            hasher.update(&piece[..count]);
            bytes += count as u64;
        }
        let hash: String = hasher.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Self { name, bytes: Some(bytes), hash: Some(hash) })
    }
}
