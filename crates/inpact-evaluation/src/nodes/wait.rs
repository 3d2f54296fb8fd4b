//! Waiting for work that other threads do.

use std::io;
use std::sync::mpsc::{Receiver, TryRecvError};

/// Waits for what another thread of rayon's pool sends, and does what else is to be done on this thread until then.
pub(super) fn wait_for<T>(receiver: &Receiver<T>) -> io::Result<T> {
    let failed = || io::Error::other("a thread that reads rows has failed");
    loop {
        match receiver.try_recv() {
            Ok(work) => return Ok(work),
            Err(TryRecvError::Empty) => {}
            Err(TryRecvError::Disconnected) => return Err(failed()),
        }
        if rayon::yield_now() != Some(rayon::Yield::Executed) {
            // All work is taken: this is being done elsewhere.
            return receiver.recv().map_err(|_| failed());
        }
    }
}
