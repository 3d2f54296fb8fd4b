//! The thread pool.
//!
//! If no threads can be created (a container's process limit), the work is done on the current one:
//! results do not depend on their number.

use rayon::ThreadPoolBuilder;
use std::num::NonZero;
use std::thread::available_parallelism;

/// The stack of a thread in bytes.
///
/// It holds the local arrays of a user's GAPELECTR, which Abaqus runs in 8 MiB. Only the used part takes memory.
const STACK: usize = 16 << 20;

/// Runs work with this number of threads, 0 for one per core; on the calling thread only where no other can be started.
///
/// Everything that may use rayon or call a user's routine runs within this: rayon's own pool ends the program where it cannot be made, and has small stacks.
pub(crate) fn with_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    let builder = || ThreadPoolBuilder::new().stack_size(STACK);
    let alone = |_| builder().num_threads(1).use_current_thread().build();
    match builder().num_threads(threads).build().or_else(alone) {
        Ok(pool) => pool.install(work),
        // The calling thread has a pool already.
        Err(_) => work(),
    }
}

/// The number of threads for work, with a maximum: all cores, or `RAYON_NUM_THREADS`, as in rayon.
pub(crate) fn threads_for(most: usize) -> usize {
    // To find out what the machine has takes longer than little work.
    if most <= 1 {
        return 1;
    }
    let said = std::env::var("RAYON_NUM_THREADS").ok().and_then(|number| number.parse().ok());
    let available = || available_parallelism().map_or(1, NonZero::get);
    said.filter(|number| *number != 0).unwrap_or_else(available).min(most)
}
