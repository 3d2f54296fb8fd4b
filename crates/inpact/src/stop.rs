//! Cancellation of work whose result is no longer needed.
//!
//! Long work polls a [`Stop`].
//! Once it is requested, the work unwinds to its starter, which catches [`Stopped`]: no function in between needs to know of it, and all must be unwind-safe.
//! The language server does so with cancelled requests; everything else has a `Stop` that is never requested.

use std::panic::resume_unwind;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether cancellation is requested.
#[derive(Debug, Clone, Default)]
pub(crate) struct Stop(Option<Arc<AtomicBool>>);

/// The payload of work that unwinds.
#[derive(Debug)]
pub(crate) struct Stopped;

impl Stop {
    /// Returns, or unwinds if cancellation is requested.
    pub(crate) fn look(&self) {
        if self.0.as_ref().is_some_and(|requested| requested.load(Ordering::Relaxed)) {
            // It is not a fault, so no panic message is printed.
            resume_unwind(Box::new(Stopped));
        }
    }
}

#[cfg(feature = "server")]
impl Stop {
    /// One that can be requested, by any of its clones.
    pub(crate) fn new() -> Self {
        Self(Some(Arc::default()))
    }

    /// Requests cancellation.
    pub(crate) fn request(&self) {
        self.set(true);
    }

    /// Resets the request.
    pub(crate) fn clear(&self) {
        self.set(false);
    }

    fn set(&self, is_requested: bool) {
        if let Some(requested) = &self.0 {
            requested.store(is_requested, Ordering::Relaxed);
        }
    }
}
