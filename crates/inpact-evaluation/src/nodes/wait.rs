//! Work on other threads, where feature `threads` is on, and waiting for it.

use std::io;
use std::sync::mpsc::{Receiver, TryRecvError};

/// Does some work on another thread, or at once where there are none.
pub(super) fn begin(work: impl FnOnce() + Send + 'static) {
    #[cfg(feature = "threads")]
    rayon::spawn_fifo(work);
    #[cfg(not(feature = "threads"))]
    work();
}

/// Waits for what another thread of rayon's pool sends, and does what else is to be done on this thread until then.
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
            // All work is taken: this is being done elsewhere.
            return receiver.recv().map_err(|_| failed());
        }
    }
}
