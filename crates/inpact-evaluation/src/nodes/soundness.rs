//! Validation of columnar files from untrusted sources.
//!
//! The libraries that read Parquet and Arrow trust the sizes a file declares: the length of a message, the number of bytes in a
//! decompressed buffer, the number of values of a dictionary. A file of eight bytes can declare two gibibytes, and a failed allocation
//! ends the program. So the structure of a file is walked first, without reading its values: nothing may be longer than the file, or
//! larger than the maximum compression ratio allows. Other inconsistencies make the libraries panic, which is caught.

pub(super) mod arrow;
pub(super) mod parquet;
mod thrift;

use std::cell::Cell;
use std::io;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

/// The maximum decompressed size of a part of a file, in addition to a multiple of its compressed size.
///
/// Constant columns compress to almost nothing, and a part of a million equal values is valid.
const UNPACKED: u64 = 128 << 20;

/// The maximum decompression ratio, in addition to [`UNPACKED`].
const TIMES: u64 = 256;

/// The maximum decompressed size of this many compressed bytes.
fn most_unpacked(packed: u64) -> u64 {
    UNPACKED.saturating_add(packed.saturating_mul(TIMES))
}

thread_local! {
    /// Whether a panic of this thread is expected and not reported.
    static IS_EXPECTED: Cell<bool> = const { Cell::new(false) };
}

/// Reads part of a table; a panic of a library becomes an error of the table.
///
/// # Errors
/// Those of `read`, and one of kind [`io::ErrorKind::InvalidData`] for a panic.
pub(super) fn caught<T>(kind: &str, read: impl FnOnce() -> io::Result<T>) -> io::Result<T> {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let tell = panic::take_hook();
        panic::set_hook(Box::new(move |panic| {
            if !IS_EXPECTED.get() {
                tell(panic);
            }
        }));
    });
    let before = IS_EXPECTED.replace(true);
    let result = panic::catch_unwind(AssertUnwindSafe(read));
    IS_EXPECTED.set(before);
    result.unwrap_or_else(|_| Err(unsound(kind, "what it says of itself does not fit what it holds")))
}

/// The error of an inconsistent file.
pub(super) fn unsound(kind: &str, why: impl std::fmt::Display) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, format!("it is no sound {kind} table ({why})"))
}
