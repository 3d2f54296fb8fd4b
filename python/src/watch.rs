//! Long work beside Python: it runs on a thread of its own while the calling thread looks for signals, such as Ctrl-C, and tells how far it is.

use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// How long the calling thread waits before it looks for signals again.
const LOOK: Duration = Duration::from_millis(25);

/// State shared by the work and the calling thread.
#[derive(Debug, Default)]
pub(crate) struct Watch {
    stop: AtomicBool,
    done: AtomicU64,
}

impl Watch {
    /// Says how much is done; true where the work is to stop.
    pub(crate) fn advance(&self, done: u64) -> bool {
        self.done.store(done, Ordering::Relaxed);
        self.is_stopped()
    }

    /// Whether the work is to stop.
    pub(crate) fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

/// Does some work without holding Python; a signal whose handler raises, or a callback that does, stops it.
pub(crate) fn run<T: Send>(
    py: Python<'_>,
    watch: &Watch,
    progress: Option<Py<PyAny>>,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    py.detach(|| {
        std::thread::scope(|scope| {
            let (sender, receiver) = channel();
            scope.spawn(move || {
                // Nobody waits for it where the calling thread has failed.
                let _ = sender.send(work());
            });
            let mut failed: Option<PyErr> = None;
            let mut said = 0;
            let looked = |failed: &mut Option<PyErr>, said: &mut u64| {
                if failed.is_some() {
                    return;
                }
                let result = Python::attach(|py| {
                    py.check_signals()?;
                    let done = watch.done.load(Ordering::Relaxed);
                    if let Some(progress) = progress.as_ref().filter(|_| *said < done) {
                        *said = done;
                        progress.call1(py, (done,))?;
                    }
                    Ok(())
                });
                if let Err(error) = result {
                    watch.stop.store(true, Ordering::Relaxed);
                    *failed = Some(error);
                }
            };
            loop {
                match receiver.recv_timeout(LOOK) {
                    Ok(result) => {
                        looked(&mut failed, &mut said);
                        return failed.map_or(Ok(result), Err);
                    }
                    Err(RecvTimeoutError::Timeout) => looked(&mut failed, &mut said),
                    // The work has panicked: the scope passes that on.
                    Err(RecvTimeoutError::Disconnected) => {
                        return Err(pyo3::exceptions::PyRuntimeError::new_err("inpact has failed; this is a bug"));
                    }
                }
            }
        })
    })
}
