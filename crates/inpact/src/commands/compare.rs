//! `inpact compare`: what is computed of a deck's interfaces, beside what its solver says of them, node by node.

mod measure;
mod report;

use self::measure::{Comparison, Quantity};
use super::evaluable::{Evaluable, EvaluableArguments, HistoryStartChoice, tolerance};
use super::findings::Messages;
use super::job_results::RESULTS_HELP;
use super::laws::LawArguments;
use super::meshed::MeshedDeck;
use super::picture::{PictureWriter, is_picture};
use crate::failure::{Failure, Outcome};
use crate::files;
use crate::settings::DeckArguments;
use clap::{Args, ValueEnum};
use inpact_contact::{ContactQuantity, NodeRows, State};
use inpact_diagnostics::Findings;
use inpact_diagnostics::visible::{visible, visible_json};
use inpact_evaluation::results::Output;
use inpact_evaluation::{Evaluation, RunFailure};
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
    #[arg(long, value_enum, default_value_t = CompareFormat::Text)]
    format: CompareFormat,
    /// Where the histories of nodes start: at time 0 without a jump of potential, or at the first state of the results, whose integrals are 0 then.
    #[arg(long, value_enum, default_value_t = HistoryStartChoice::AtRest)]
    history_start: HistoryStartChoice,
    #[command(flatten)]
    laws: LawArguments,
    #[command(flatten)]
    reading: DeckArguments,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum CompareFormat {
    /// For a person.
    Text,
    /// For another program.
    Json,
}

pub(crate) fn run(arguments: &CompareArguments) -> Result<Outcome, Failure> {
    let CompareArguments { deck, results, output, .. } = arguments;
    let evaluable = EvaluableArguments::of_results(deck.clone(), results.clone(), arguments.history_start);
    files::name_as_inputs(&evaluable.inputs());
    files::check_targets(&[output.as_deref()])?;
    let messages = match arguments.format {
        CompareFormat::Text => Messages::LINES,
        CompareFormat::Json => Messages::JSON,
    };
    let prepared = evaluable.with_threads(|| evaluable.prepare(&arguments.laws, &arguments.reading, messages))?;
    let Some(mut prepared) = prepared.filter(|prepared| !prepared.deck_has_errors) else {
        return Ok(Outcome::HasErrors);
    };
    // The included files are known now.
    files::check_targets(&[output.as_deref()])?;
    let mut comparison = of_geometry(arguments, &prepared)?;
    comparison.extend(evaluable.with_threads(|| of_outputs(deck, &mut prepared, messages))?);
    if comparison.iter().all(|quantity| quantity.compared() == 0) {
        let message = "the results say nothing that is computed here: expected COPEN or CNAREA, or outputs of the interface such as HFL, ECD, SJD, PFL";
        return Err(Failure::Data(message.to_owned()));
    }
    let comparison = Comparison::new(comparison, &prepared, arguments.tolerance);
    if let Some(target) = output.as_deref() {
        if is_picture(target) {
            draw(&comparison, &prepared, target)?;
        } else {
            files::write_result(Some(target), report::table(&comparison).as_bytes())?;
        }
    }
    let text = match arguments.format {
        CompareFormat::Text => visible(&report::text(&comparison)).into_owned(),
        CompareFormat::Json => visible_json(&report::json(&comparison)).into_owned(),
    };
    files::write_result(None, text.as_bytes())?;
    Ok(if comparison.is_beyond() { Outcome::HasErrors } else { Outcome::Clean })
}

/// Clearances and areas of the moved mesh beside those that the solver says.
fn of_geometry(arguments: &CompareArguments, prepared: &Evaluable) -> Result<Vec<Quantity>, Failure> {
    let Some(made) = &prepared.made else { return Ok(Vec::new()) };
    let said = |state: &State, quantity| state.contact.iter().any(|field| field.quantity == quantity);
    let kinds = [ContactQuantity::Clearance, ContactQuantity::Area];
    let kinds: Vec<ContactQuantity> =
        kinds.into_iter().filter(|kind| made.drawn.states.iter().any(|state| said(state, *kind))).collect();
    if kinds.is_empty() {
        return Ok(Vec::new());
    }
    let settings = arguments.reading.settings(&arguments.deck)?;
    let meshed = MeshedDeck::read(&arguments.deck, &settings)?;
    // Without what the solver says the rows have what the mesh says.
    let states: Vec<State> =
        made.drawn.states.iter().cloned().map(|state| State { contact: Vec::new(), ..state }).collect();
    let failed = |error: inpact_contact::Error| Failure::Data(error.to_string());
    let mut rows = NodeRows::new(&meshed.mesh, &meshed.read.model, &states).map_err(failed)?;
    let places: Vec<Option<usize>> =
        kinds.iter().map(|kind| rows.numbers().iter().position(|column| *column == kind.column())).collect();
    let mut quantities: Vec<Quantity> = kinds.iter().map(|kind| Quantity::new(kind.column().to_string())).collect();
    for batch in rows.batches(&states) {
        let batch = batch.map_err(failed)?;
        for row in 0..batch.rows {
            for (quantity, place) in quantities.iter_mut().zip(&places) {
                quantity.ours.push(place.and_then(|place| batch.numbers[place].get(row)));
            }
        }
    }
    for (quantity, kind) in quantities.iter_mut().zip(kinds) {
        quantity.solvers = made.drawn.rows(|state, pair, node| state.contact(kind, pair, node).map(|(value, _)| value));
    }
    Ok(quantities)
}

/// Outputs of the interface beside those that the solver says.
fn of_outputs(deck: &Path, prepared: &mut Evaluable, messages: Messages<'_>) -> Result<Vec<Quantity>, Failure> {
    let Evaluable { settings, model, plan, choices, nodes_name, rows, made, .. } = prepared;
    let Some(made) = made else { return Ok(Vec::new()) };
    let mut said: Vec<Output> =
        made.drawn.states.iter().flat_map(|state| &state.outputs).map(|field| field.output).collect();
    said.sort_unstable();
    said.dedup();
    let mut quantities: Vec<Quantity> = said.iter().map(|output| Quantity::new(output.to_string())).collect();
    for (quantity, output) in quantities.iter_mut().zip(&said) {
        quantity.solvers =
            made.drawn.rows(|state, pair, node| state.output(*output, pair, node).map(|(value, _)| value));
    }
    // Statuses are no columns of numbers.
    let numbers = plan.outputs.iter().filter(|output| output.is_number());
    let places: Vec<Option<usize>> =
        said.iter().map(|output| numbers.clone().position(|planned| planned == output)).collect();
    if places.iter().all(Option::is_none) {
        for quantity in &mut quantities {
            quantity.ours = vec![None; quantity.solvers.len()];
        }
        return Ok(quantities);
    }
    let unreadable = |error| Failure::read(deck, error);
    let mut rows = rows.give_back(&plan.selection).map_err(unreadable)?;
    let mut evaluation = Evaluation::on_all_threads(model, plan, choices);
    let ran = evaluation.run::<Failure>(&mut rows, plan, |batch, results| {
        for row in 0..batch.rows {
            for (quantity, place) in quantities.iter_mut().zip(&places) {
                quantity.ours.push(place.and_then(|place| results.numbers[place].get(row)));
            }
        }
        Ok(())
    });
    ran.map_err(|failed| match failed {
        RunFailure::Reading(error) => unreadable(error),
        RunFailure::Writing(failure) => failure,
    })?;
    let tally = evaluation.finish();
    let mut findings = Findings::new(nodes_name);
    tally.report_user_faults(&mut findings);
    let failed = findings.has_errors();
    messages.data(findings.into_list(), settings);
    if failed {
        return Err(Failure::Data("the user subroutine fails, and nothing is compared".to_owned()));
    }
    Ok(quantities)
}

/// Draws both values of every quantity and their difference.
fn draw(comparison: &Comparison, prepared: &Evaluable, target: &Path) -> Result<(), Failure> {
    let Some(made) = &prepared.made else { return Ok(()) };
    let names = comparison
        .quantities
        .iter()
        .flat_map(|quantity| ["", "_solver", "_difference"].map(|ending| format!("{}{ending}", quantity.name)));
    let mut writer = PictureWriter::new(&made.drawn, target, names.collect())?;
    for row in 0..comparison.rows() {
        let values = comparison.quantities.iter().flat_map(|quantity| {
            let (ours, solvers) = (quantity.ours[row], quantity.solvers[row]);
            [ours, solvers, ours.zip(solvers).map(|(ours, solvers)| ours - solvers)]
        });
        writer.push(values)?;
    }
    writer.finish()
}
