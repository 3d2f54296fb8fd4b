//! One run of a solver on a grid: times of its phases, memory and the quality of the solution, as a line of JSON.

use super::grid::Grid;
use inpact_network::Error;
use inpact_network::linear::{LAST_DIGIT, Method, Solver};
use std::fmt::Write as _;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

/// The time since this was first called.
fn clock() -> Duration {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed()
}

/// Solves a grid several times from scratch, and reports the fastest.
///
/// # Errors
/// A grid that is not solved.
pub fn run(grid: Grid, method: Method, tolerance: Option<f64>, rounds: usize) -> Result<String, Error> {
    let network = grid.network();
    let base = memory("VmRSS:").unwrap_or(f64::NAN);
    let mut best: Option<(f64, inpact_network::linear::LinearReport)> = None;
    for _ in 0..rounds {
        let start = Instant::now();
        let solution = Solver::new(method, tolerance.unwrap_or(LAST_DIGIT)).timed_by(clock).solve(&network)?;
        let whole = start.elapsed().as_secs_f64();
        if best.as_ref().is_none_or(|(least, _)| whole < *least) {
            best = Some((whole, solution.report));
        }
    }
    let mut line = String::new();
    if let Some((whole, report)) = best {
        let phases = report.phases;
        let _ = write!(
            line,
            "{{\"size\":{:?},\"contrast\":{:e},\"unknowns\":{},\"solver\":\"{:?}\",\"whole\":{whole:.4},\"set_up\":{:.4},\
             \"order\":{:.4},\"factor\":{:.4},\"solve\":{:.4},\"entries\":{},\"ordering\":\"{:?}\",\"solves\":{},\
             \"iterations\":{},\"residual\":{:e},\"error\":{:e},\"condition\":{:e},\"base_mib\":{base:.1},\"peak_mib\":{:.1}}}",
            grid.size,
            grid.contrast,
            report.unknowns,
            report.method,
            phases.set_up,
            phases.order,
            phases.factor,
            phases.solve,
            report.factor_entries,
            report.ordering,
            report.quality.solves,
            report.iterations,
            report.quality.residual,
            report.quality.error,
            report.quality.condition,
            memory("VmHWM:").unwrap_or(f64::NAN),
        );
    }
    Ok(line)
}

/// The memory of this process, now (`VmRSS:`) or at most so far (`VmHWM:`), in MiB; where the system tells.
pub(crate) fn memory(key: &str) -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with(key))?;
    let kib: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kib / 1024.0)
}
