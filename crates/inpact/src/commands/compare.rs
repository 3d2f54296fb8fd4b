//! `inpact compare`: computed results of a deck's interfaces beside those of its solver, node by node.

mod geometry;
mod measure;
mod report;

use self::geometry::Geometry;
use self::measure::{Comparison, Quantity, RowsOf};
use super::choice::one_of;
use super::evaluable::{Evaluable, EvaluableArguments, HISTORY_STARTS, tolerance};
use super::findings::{Messages, PrintedAs};
use super::job_results::RESULTS_HELP;
use super::laws::LawArguments;
use super::picture::{PictureWriter, is_picture};
use crate::failure::{Failure, Outcome};
use crate::files;
use crate::settings::DeckArguments;
use clap::Args;
use inpact_diagnostics::Findings;
use inpact_diagnostics::visible::{visible, visible_json};
use inpact_evaluation::results::Output;
use inpact_evaluation::{Evaluation, HistoryStart};
use std::convert::Infallible;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct CompareArguments {
    /// The deck, with its mesh; `-` reads standard input.
    #[arg(value_name = "DECK")]
    deck: PathBuf,
    #[arg(long, value_name = "FILE", help = RESULTS_HELP, required = true)]
    results: Vec<PathBuf>,
    /// The difference that is acceptable, as a part of the largest value of the quantity: beyond it the exit code is 1.
    #[arg(long, value_name = "X", value_parser = tolerance)]
    tolerance: Option<f64>,
    /// Where to write both values of every node as comma-separated values; a name that ends in .vtu or .pvd draws them on the slave surfaces for ParaView.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// How to print the comparison on standard output.
    #[arg(long, value_enum, default_value_t = PrintedAs::Text)]
    format: PrintedAs,
    /// Where the histories of nodes start: at time 0 without a jump of potential, or at the first state of the results, whose integrals are 0 then.
    #[arg(long, value_parser = one_of(&HISTORY_STARTS), default_value = "at-rest")]
    history_start: HistoryStart,
    #[command(flatten)]
    laws: LawArguments,
    #[command(flatten)]
    reading: DeckArguments,
}

pub(crate) fn run(arguments: &CompareArguments) -> Result<Outcome, Failure> {
    let CompareArguments { deck, results, output, .. } = arguments;
    let evaluable = EvaluableArguments::of_results(deck.clone(), results.clone(), arguments.history_start);
    files::name_as_inputs(&evaluable.inputs());
    files::check_targets(&[output.as_deref()])?;
    let messages = Messages::at_once(arguments.format.of_findings());
    let prepared = evaluable.with_threads(|| evaluable.prepare(&arguments.laws, &arguments.reading, messages))?;
    let Some(mut prepared) = prepared.filter(|prepared| !prepared.deck_has_errors) else {
        return Ok(Outcome::HasErrors);
    };
    // The included files are known now.
    files::check_targets(&[output.as_deref()])?;
    let (geometry, mut quantities) = Geometry::of(arguments, &prepared)?;
    let outputs = outputs_said(&prepared, &geometry);
    let wanted: Vec<Output> =
        outputs.iter().map(|(output, _)| *output).chain([Output::TotalHeatSlave, Output::TotalHeatMaster]).collect();
    let mut ours = evaluable.with_threads(|| evaluated(deck, &mut prepared, &wanted, messages))?;
    if let Some(made) = &prepared.made {
        let [into_slave, into_master] = [ours.len() - 2, ours.len() - 1];
        let totals = geometry.totals(&made.drawn, [&ours[into_slave], &ours[into_master]]);
        let of_outputs = outputs.into_iter().zip(ours.drain(..into_slave));
        quantities.extend(of_outputs.map(|((_, quantity), ours)| Quantity { ours, ..quantity }));
        quantities.extend(totals);
    }
    if quantities.iter().all(|quantity| quantity.compared() == 0) {
        let message = "the results say nothing that is computed here: expected COPEN or CNAREA, outputs of the interface such as HFL, ECD, SJD, PFL, the flux of heat in bodies, or area or heat of a pair";
        return Err(Failure::Data(message.to_owned()));
    }
    let of_pairs = prepared.made.as_ref().map(|made| geometry.names_and_times(&made.drawn)).unwrap_or_default();
    let comparison = Comparison::new(quantities, &prepared, of_pairs, arguments.tolerance);
    if let Some(target) = output.as_deref() {
        if is_picture(target) {
            draw(&comparison, &prepared, target)?;
        } else {
            files::write_result(Some(target), report::table(&comparison).as_bytes())?;
        }
    }
    let text = match arguments.format {
        PrintedAs::Text => visible(&report::text(&comparison)).into_owned(),
        PrintedAs::Json => visible_json(&report::json(&comparison)).into_owned(),
    };
    files::write_result(None, text.as_bytes())?;
    Ok(if comparison.is_beyond() { Outcome::HasErrors } else { Outcome::Clean })
}

/// The outputs with values of the solver, each with one value per row.
fn outputs_said(prepared: &Evaluable, geometry: &Geometry) -> Vec<(Output, Quantity)> {
    let Some(made) = &prepared.made else { return Vec::new() };
    let fields = || made.drawn.states.iter().flat_map(|state| &state.outputs);
    let mut said: Vec<Output> = fields().map(|field| field.output).collect();
    said.sort_unstable();
    said.dedup();
    let quantity = |output: Output| {
        let solvers = made.drawn.rows(|state, pair, node| state.output(output, pair, node).map(|(value, _)| value));
        let source = fields().find(|field| field.output == output).map(|field| field.source.to_string());
        (output, Quantity { solvers, source: source.unwrap_or_default(), ..Quantity::of_output(output) })
    };
    let heat = geometry.heat_into_slave(&made.drawn).map(|quantity| (Output::TotalHeatSlave, quantity));
    said.into_iter().map(quantity).chain(heat).collect()
}

/// Some outputs by the deck's laws, one value per row each; none for an output that is not planned.
fn evaluated(
    deck: &Path,
    prepared: &mut Evaluable,
    outputs: &[Output],
    messages: Messages<'_>,
) -> Result<Vec<Vec<Option<f64>>>, Failure> {
    let Evaluable { settings, model, plan, choices, nodes_name, rows, made, .. } = prepared;
    let Some(made) = made else { return Ok(vec![Vec::new(); outputs.len()]) };
    // Statuses are not columns of numbers.
    let numbers = plan.outputs.iter().filter(|output| output.is_number());
    let places: Vec<Option<usize>> =
        outputs.iter().map(|output| numbers.clone().position(|planned| planned == output)).collect();
    if places.iter().all(Option::is_none) {
        return Ok(vec![vec![None; made.drawn.rows_in_all()]; outputs.len()]);
    }
    let mut columns = vec![Vec::new(); outputs.len()];
    let unreadable = |error| Failure::read(deck, error);
    let mut rows = rows.give_back(&plan.selection).map_err(unreadable)?;
    let mut evaluation = Evaluation::on_all_threads(model, plan, choices);
    let ran = evaluation.run::<Infallible>(&mut rows, plan, |batch, results| {
        for row in 0..batch.rows {
            for (column, place) in columns.iter_mut().zip(&places) {
                column.push(place.and_then(|place| results.numbers[place].get(row)));
            }
        }
        Ok(())
    });
    let Ok(()) = ran.map_err(unreadable)?;
    let tally = evaluation.finish();
    let mut findings = Findings::new(nodes_name);
    tally.report_user_faults(&mut findings);
    let failed = findings.has_errors();
    messages.data(findings.into_list(), settings);
    if failed {
        return Err(Failure::Data("the user subroutine fails, and nothing is compared".to_owned()));
    }
    Ok(columns)
}

/// Draws both values of every quantity of nodes and their difference.
fn draw(comparison: &Comparison, prepared: &Evaluable, target: &Path) -> Result<(), Failure> {
    let Some(made) = &prepared.made else { return Ok(()) };
    let quantities = || comparison.quantities.iter().filter(|quantity| quantity.rows_of == RowsOf::Nodes);
    let names = quantities()
        .flat_map(|quantity| ["", "_solver", "_difference"].map(|ending| format!("{}{ending}", quantity.name)));
    let mut writer = PictureWriter::new(&made.drawn, target, names.collect())?;
    for row in 0..comparison.rows() {
        let values = quantities().flat_map(|quantity| {
            let (ours, solvers) = (quantity.ours[row], quantity.solvers[row]);
            [ours, solvers, ours.zip(solvers).map(|(ours, solvers)| ours - solvers)]
        });
        writer.push(values)?;
    }
    writer.finish()
}
