//! A routine that ends the program: Fortran's STOP calls `exit`, and an incomplete run would end with exit code 0.

use crate::failure::say;
use crate::files;
use inpact_evaluation::law::UserConductancePoint;
use std::ffi::c_int;
use std::sync::Once;
use std::sync::atomic::{AtomicI64, Ordering};

/// The node of the call under way, or [`NO_CALL`].
static NODE: AtomicI64 = AtomicI64::new(NO_CALL);

const NO_CALL: i64 = i64::MIN;

unsafe extern "C" {
    /// Registers what `exit` calls (C11 7.22.4.2).
    fn atexit(handler: extern "C" fn()) -> c_int;
    /// Ends the process at once (POSIX, and the C library of Windows).
    fn _exit(status: c_int) -> !;
}

/// From now on the end of the program during a call is reported and has exit code 2.
pub(super) fn watch() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        // SAFETY: the handler is a function of this program, which is there until it ends. Without room for one more handler nothing is reported, and nothing else changes.
        unsafe { atexit(tell) };
    });
}

pub(super) fn during(point: &UserConductancePoint<'_>, call: impl FnOnce()) {
    NODE.store(i64::from(point.node), Ordering::Relaxed);
    call();
    NODE.store(NO_CALL, Ordering::Relaxed);
}

extern "C" fn tell() {
    let node = NODE.load(Ordering::Relaxed);
    if node == NO_CALL {
        return;
    }
    say(&format!(
        "error: user subroutine GAPELECTR ended the program (by STOP or an error of the Fortran runtime) when it was called for node {node}; the result is not whole"
    ));
    // `_exit` runs no destructors.
    files::remove_temporary_files();
    // SAFETY: it takes a number and does not return.
    unsafe { _exit(2) }
}
