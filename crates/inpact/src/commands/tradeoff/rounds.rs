//! Minimum times of subjects that are run in interleaved rounds.

use std::time::Instant;

/// Runs all of them in interleaved rounds, and returns the minimum time of each, in seconds.
///
/// Interleaved, so that other load on the machine affects all alike.
pub(super) fn least_times(rounds: u32, runs: &mut [Box<dyn FnMut() + '_>]) -> Vec<f64> {
    let mut least = vec![f64::INFINITY; runs.len()];
    for _ in 0..rounds {
        for (run, least) in runs.iter_mut().zip(&mut least) {
            let start = Instant::now();
            run();
            *least = least.min(start.elapsed().as_secs_f64());
        }
    }
    least
}
