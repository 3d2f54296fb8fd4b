//! Work on other threads, where feature `threads` is on, and waiting for it.

use std::io;
use std::sync::mpsc::{Receiver, TryRecvError};

/// Runs work on another thread, or immediately without threads.
pub(super) fn begin(work: impl FnOnce() + Send + 'static) {
    #[cfg(feature = "threads")]
    rayon::spawn_fifo(work);
    #[cfg(not(feature = "threads"))]
    work();
}

/// Waits for a message from another thread of rayon's pool, running other work of the pool on this thread until then.
pub(super) fn wait_for<T>(receiver: &Receiver<T>) -> io::Result<T> {
    let failed = || io::Error::other("a thread that reads rows has failed");
    loop {
        match receiver.try_recv() {
            Ok(work) => return Ok(work),
            Err(TryRecvError::Empty) => {}
            Err(TryRecvError::Disconnected) => return Err(failed()),
        }
        #[cfg(feature = "threads")]
        let has_done_other_work = rayon::yield_now() == Some(rayon::Yield::Executed);
        #[cfg(not(feature = "threads"))]
        let has_done_other_work = false;
        if !has_done_other_work {
            // No work is left in the pool: this one is running elsewhere.
            return receiver.recv().map_err(|_| failed());
        }
    }
}
