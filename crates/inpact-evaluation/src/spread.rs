//! Work spread over rayon's current thread pool, where feature `threads` is on; otherwise it runs sequentially.
//!
//! Results are the same in either case.

#[cfg(feature = "threads")]
use rayon::prelude::*;

/// The number of threads.
pub(crate) fn threads() -> usize {
    #[cfg(feature = "threads")]
    return rayon::current_num_threads();
    #[cfg(not(feature = "threads"))]
    1
}

/// Runs `work` on each item.
pub(crate) fn for_each<T: Send>(items: impl IntoIterator<Item = T>, work: impl Fn(T) + Sync + Send) {
    let items: Vec<T> = items.into_iter().collect();
    #[cfg(feature = "threads")]
    items.into_par_iter().for_each(work);
    #[cfg(not(feature = "threads"))]
    items.into_iter().for_each(work);
}

/// Results of `work` on each item, in order.
pub(crate) fn map<T: Send, R: Send>(items: impl IntoIterator<Item = T>, work: impl Fn(T) -> R + Sync + Send) -> Vec<R> {
    let items: Vec<T> = items.into_iter().collect();
    #[cfg(feature = "threads")]
    return items.into_par_iter().map(work).collect();
    #[cfg(not(feature = "threads"))]
    items.into_iter().map(work).collect()
}

/// Runs both, possibly in parallel.
pub(crate) fn join<A: Send, B: Send>(one: impl FnOnce() -> A + Send, other: impl FnOnce() -> B + Send) -> (A, B) {
    #[cfg(feature = "threads")]
    return rayon::join(one, other);
    #[cfg(not(feature = "threads"))]
    (one(), other())
}
