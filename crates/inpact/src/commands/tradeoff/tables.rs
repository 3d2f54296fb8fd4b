//! The modes of evaluation on the tables of a deck.
//!
//! Every mode evaluates the tables in force, folded as in the plan, on the rows that reach them.
//! Columns stay in memory, the rounds of all modes are interleaved, and the least time of each counts.

mod diagram;
mod measure;
mod modes;
mod report;
mod subjects;

use super::{Shown, TradeoffArguments, TradeoffFormat};
use crate::chart::Chart;
use crate::commands::evaluable::{Evaluable, EvaluableArguments};
use crate::failure::Failure;
use crate::files;
use inpact_diagnostics::visible::visible;
use measure::Measured;
use std::path::Path;

/// Measures on a deck and its node table; `None` after reporting their faults.
pub(super) fn measured(table: &EvaluableArguments, arguments: &TradeoffArguments) -> Result<Option<Shown>, Failure> {
    table.with_threads(|| measured_on_threads(table, arguments))
}

fn measured_on_threads(table: &EvaluableArguments, arguments: &TradeoffArguments) -> Result<Option<Shown>, Failure> {
    let messages = arguments.format.messages();
    let prepared = table.prepare_in_rounds(&arguments.laws, &arguments.reading, messages, arguments.rounds)?;
    let Some(mut scene) = prepared.filter(|scene| !scene.deck_has_errors) else { return Ok(None) };
    // The included files are known now.
    files::check_targets(&arguments.targets())?;
    let measured = measured_tables(&mut scene, table.nodes_path(), arguments.sample, arguments.rounds)?;
    let names = report::Names { deck: &scene.deck_name, nodes: &scene.nodes_name };
    let text = match arguments.format {
        TradeoffFormat::Text => visible(&report::text(&measured, names)).into_owned(),
        TradeoffFormat::Csv => report::csv(&measured),
        TradeoffFormat::Json => report::json(&measured, names),
    };
    Ok(Some(Shown { text, chart: diagram::chart(&measured, names) }))
}

/// The work and precision of the tables of a deck on its rows as a diagram and as text, for a report.
///
/// # Errors
/// Rows that cannot be read again; a deck of which no table varies on them.
pub(crate) fn diagram(scene: &mut Evaluable, nodes_path: &Path) -> Result<(Chart, String), Failure> {
    /// The maximum number of rows, and the rounds: fewer than in a separate measurement.
    const SAMPLE: u64 = 100_000;
    const ROUNDS: u32 = 7;
    let measured = measured_tables(scene, nodes_path, SAMPLE, ROUNDS)?;
    let names = report::Names { deck: &scene.deck_name, nodes: &scene.nodes_name };
    Ok((diagram::chart(&measured, names), visible(&report::text(&measured, names)).into_owned()))
}

fn measured_tables(scene: &mut Evaluable, nodes_path: &Path, most: u64, rounds: u32) -> Result<Measured, Failure> {
    let sample = subjects::gather(scene, nodes_path, (most, rounds))?;
    if sample.subjects.is_empty() {
        let message = format!("no table of `{}` varies on these rows: there is nothing to trade", scene.deck_name);
        return Err(Failure::Data(message));
    }
    Ok(measure::measure(&sample, rounds))
}
