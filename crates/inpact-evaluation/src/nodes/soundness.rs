//! Tables of columns from anywhere, made safe to read.
//!
//! The libraries that read Parquet and Arrow trust what a file says of itself: how long a message is, how many bytes come out of a
//! compressed buffer, how many values a dictionary has. A file of eight bytes can say two gibibytes, and memory that cannot be had
//! ends the program. So a file is walked first, without its values being read: nothing may be longer than the file can hold, or
//! come to more than compression can make of it. What contradicts itself in other ways makes the libraries panic, which is caught.

pub(super) mod arrow;
pub(super) mod parquet;
mod thrift;

use std::cell::Cell;
use std::io;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

/// The most bytes that a piece of a file may come to when it is unpacked, besides so many times its packed size.
///
/// Columns of one value shrink to next to nothing, and a piece of a million of them is a sound table.
const UNPACKED: u64 = 128 << 20;

/// How many times its packed size a piece of a file may come to, besides [`UNPACKED`].
const TIMES: u64 = 256;

/// The most bytes that so many packed bytes may come to.
fn most_unpacked(packed: u64) -> u64 {
    UNPACKED.saturating_add(packed.saturating_mul(TIMES))
}

thread_local! {
    /// Whether a panic of this thread is one that is expected, and nothing to tell.
    static IS_EXPECTED: Cell<bool> = const { Cell::new(false) };
}

/// Reads part of a table; a library that panics over it is an error of the table.
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

/// The error of a file that is wrong inside.
pub(super) fn unsound(kind: &str, why: impl std::fmt::Display) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, format!("it is no sound {kind} table ({why})"))
}
