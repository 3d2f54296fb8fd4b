//! The linear solvers on a scene.
//!
//! Every solver solves the scene at tolerances from the last digit to a thousandth, each time from scratch:
//! a steady scene as a whole, including Newton's iteration; of a transient the state at its start and one increment.
//! The rounds of all solvers are interleaved, and the least time of each counts.

mod diagram;
mod measure;
mod report;
mod subjects;

use super::{Shown, TradeoffArguments, TradeoffFormat};
use crate::commands::solvable::SolvableScene;
use crate::failure::Failure;
use crate::files;
use crate::threads::with_threads;
use inpact_diagnostics::visible::visible;
use std::path::Path;

/// Measures on a scene; `None` after reporting its faults, as `solve` does.
pub(super) fn measured(path: &Path, arguments: &TradeoffArguments) -> Result<Option<Shown>, Failure> {
    with_threads(0, || measured_on_threads(path, arguments))
}

fn measured_on_threads(path: &Path, arguments: &TradeoffArguments) -> Result<Option<Shown>, Failure> {
    let mut messages = arguments.format.messages();
    let prepared = SolvableScene::read(path, &arguments.laws, &arguments.reading.options(), &mut messages)?;
    let Some(prepared) = prepared else { return Ok(None) };
    // The files that the scene is made from are known now.
    files::check_targets(&arguments.targets())?;
    let Some(problem) = prepared.problem(&mut messages) else { return Ok(None) };
    if problem.solved_fields().is_empty() {
        let message = format!("no field of `{}` is solved for: there is nothing to trade", prepared.name);
        return Err(Failure::Data(message));
    }
    let measured = match measure::measure(&prepared, &problem, arguments.rounds) {
        Ok(measured) => measured,
        Err(failed) => {
            messages.data(prepared.findings(&failed.why, failed.after), &prepared.settings);
            return Ok(None);
        }
    };
    let text = match arguments.format {
        TradeoffFormat::Text => visible(&report::text(&measured, &prepared)).into_owned(),
        TradeoffFormat::Csv => report::csv(&measured),
        TradeoffFormat::Json => report::json(&measured, &prepared),
    };
    Ok(Some(Shown { text, chart: diagram::chart(&measured, &prepared) }))
}
