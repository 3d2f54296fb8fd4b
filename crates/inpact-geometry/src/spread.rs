//! Work spread over rayon's current thread pool, where feature `threads` is on; otherwise it runs sequentially.

#[cfg(feature = "threads")]
use rayon::prelude::*;

/// Results of `work` on each item, in order.
pub(crate) fn map<T: Sync, R: Send>(items: &[T], work: impl Fn(&T) -> R + Sync + Send) -> Vec<R> {
    #[cfg(feature = "threads")]
    return items.par_iter().map(work).collect();
    #[cfg(not(feature = "threads"))]
    items.iter().map(work).collect()
}
