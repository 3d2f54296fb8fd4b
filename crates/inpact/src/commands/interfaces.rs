//! `inpact interfaces`: a deck with a mesh and its job's result files in; the interfaces of a scene out, one row per slave node or per pair.

use super::findings::{Messages, with_messages};
use super::job_results::{RESULTS_HELP, states};
use super::mesh_rows::{RowsSummary, node_rows};
use super::meshed::MeshedDeck;
use crate::failure::{Failure, Outcome};
use crate::files;
use crate::render::Format;
use crate::settings::DeckArguments;
use crate::text::{counted, csv, number_text};
use clap::Args;
use inpact_contact::{Interfaces, Joined, LumpedPair, PairInterfaces, State, WeightedMean};
use inpact_diagnostics::visible::visible_line;
use serde_json::{Value, json};
use std::path::PathBuf;
use std::time::Instant;

/// The maximum number of names in a line.
const MAX_NAMES: usize = 10;

#[derive(Debug, Args)]
pub(crate) struct InterfacesArguments {
    /// The deck, with its mesh; `-` reads standard input.
    #[arg(value_name = "DECK")]
    deck: PathBuf,
    /// Make one interface of each pair: the sum of its areas, and means weighted by them.
    #[arg(long)]
    lumped: bool,
    #[arg(long, value_name = "FILE", help = RESULTS_HELP, long_help = format!("{RESULTS_HELP}.\n\nInterfaces are those of the last state."))]
    results: Vec<PathBuf>,
    /// Where to write the interfaces, instead of standard output: comma-separated values, an `[[interface_file]]` of a scene.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Write what is across from each slave node: the nearest face of the master, its nodes with their weights, and how far the slave node hangs over the edge.
    #[arg(long, value_name = "FILE")]
    projections: Option<PathBuf>,
    #[command(flatten)]
    reading: DeckArguments,
    /// How to print notes and summary on standard error.
    #[arg(long, value_enum, default_value_t = Format::Concise)]
    format: Format,
}

pub(crate) fn run(arguments: &InterfacesArguments) -> Result<Outcome, Failure> {
    with_messages(arguments.format, |messages| make(arguments, messages))
}

fn make(arguments: &InterfacesArguments, messages: Messages<'_>) -> Result<Outcome, Failure> {
    let start = Instant::now();
    files::name_as_inputs(&[&arguments.deck]);
    files::name_as_inputs(&arguments.results);
    let targets = [arguments.output.as_deref(), arguments.projections.as_deref()];
    files::check_targets(&targets)?;
    let settings = arguments.reading.settings(&arguments.deck)?;
    let meshed = MeshedDeck::read(&arguments.deck, &settings)?;
    // The included files are known now.
    files::check_targets(&targets)?;
    let Joined { states, files, .. } = states(&arguments.results, &meshed, messages)?;
    let mut rows = node_rows(&meshed, &states, messages)?;
    let Some(state) = states.last() else { return Err(Failure::Data("the result files have no state".to_owned())) };
    let interfaces = rows.interfaces(state)?;
    let table = if arguments.lumped { lumped_rows(&interfaces) } else { node_rows_of(&interfaces) };
    let made = table.len();
    files::write_result(arguments.output.as_deref(), &csv(std::iter::once(header(&interfaces)).chain(table)))?;
    if let Some(target) = &arguments.projections {
        files::write_result(Some(target), &projections(&interfaces))?;
    }
    let seconds = start.elapsed().as_secs_f64();
    let summary = RowsSummary::of(&rows, &files);
    let RowsSummary { lines: of_rows, value: mut summary } = summary;
    let shown = || {
        let head = format!("{}{}, {seconds:.3} s", counted(made, "interface"), when(state, states.len()));
        let lumped = interfaces.pairs.iter().flat_map(|pair| lines(&interfaces, pair, arguments.lumped));
        let all = std::iter::once(head).chain(of_rows).chain(lumped);
        all.map(|line| visible_line(&line).into_owned()).collect()
    };
    let json = || {
        summary["seconds"] = json!(seconds);
        summary["interfaces"] = json!(made);
        summary["time"] = json!(state.moment.time);
        for (pair, of) in summary["pairs"].as_array_mut().into_iter().flatten().zip(&interfaces.pairs) {
            pair["beside"] = json!(of.beside);
            pair["lumped"] =
                arguments.lumped.then(|| interfaces.lumped(of)).flatten().map(|of| value(&interfaces, &of)).into();
        }
        json!({ "summary": summary }).to_string()
    };
    messages.tell(shown, json);
    Ok(Outcome::Clean)
}

/// The time of the state, where there are several.
fn when(state: &State, states: usize) -> String {
    match state.moment.time {
        Some(time) => format!(" at time {} (the last of {})", number_text(time), counted(states, "state")),
        None => String::new(),
    }
}

/// The columns of both tables of interfaces.
fn header(interfaces: &Interfaces) -> Vec<String> {
    let own = ["slave", "master", "interaction", "area"].map(str::to_owned);
    own.into_iter().chain(interfaces.quantities.iter().map(ToString::to_string)).collect()
}

/// One row per slave node.
fn node_rows_of(interfaces: &Interfaces) -> Vec<Vec<String>> {
    let rows = interfaces.pairs.iter().flat_map(|pair| pair.rows.iter().map(move |row| (pair, row)));
    let cells = rows.map(|(pair, row)| {
        let values = row.values.iter().copied();
        cells([&row.slave, &row.master, pair.interaction.written()], row.area, values)
    });
    cells.collect()
}

/// One row per pair.
fn lumped_rows(interfaces: &Interfaces) -> Vec<Vec<String>> {
    let lumped = interfaces.pairs.iter().filter_map(|pair| Some((pair, interfaces.lumped(pair)?)));
    let cells = lumped.map(|(pair, lumped)| {
        let names = [pair.slave.written(), pair.master.written(), pair.interaction.written()];
        cells(names, lumped.area, lumped.means.iter().map(|mean| mean.map(|mean| mean.mean)))
    });
    cells.collect()
}

fn cells(names: [&str; 3], area: f64, values: impl Iterator<Item = Option<f64>>) -> Vec<String> {
    let texts = names.into_iter().map(str::to_owned);
    let numbers = std::iter::once(Some(area)).chain(values);
    texts.chain(numbers.map(|value| value.map_or_else(String::new, number_text))).collect()
}

/// One row per slave node and node of the nearest face.
fn projections(interfaces: &Interfaces) -> Vec<u8> {
    let header = ["slave", "master", "master_node", "weight", "element", "face", "clearance", "overhang", "projects"];
    let rows = interfaces.pairs.iter().flat_map(|pair| &pair.projections);
    let cells = rows.flat_map(|row| {
        row.weights.iter().map(move |(node, weight)| {
            let (element, face) = &row.face;
            vec![
                row.slave.clone(),
                row.master.clone(),
                node.to_string(),
                number_text(*weight),
                element.to_string(),
                face.to_string(),
                number_text(row.clearance),
                number_text(row.overhang),
                u8::from(row.projects).to_string(),
            ]
        })
    });
    csv(std::iter::once(header.map(str::to_owned).to_vec()).chain(cells))
}

/// Remarks on a pair: nodes beyond the edge, and the averages of lumping.
fn lines(interfaces: &Interfaces, pair: &PairInterfaces, lumped: bool) -> Vec<String> {
    let mut lines = Vec::new();
    let lumped = if lumped { interfaces.lumped(pair) } else { None };
    if pair.beside.is_empty() && lumped.is_none() {
        return lines;
    }
    lines.push(format!("  `{}` on `{}`:", pair.slave, pair.master));
    if !pair.beside.is_empty() {
        let nodes = counted(pair.beside.len(), "slave node");
        let (verb, theirs) = if pair.beside.len() == 1 { ("hangs", "it has") } else { ("hang", "they have") };
        let names = listed(&pair.beside);
        lines.push(format!("    {nodes} {verb} over the edge of the master, so that {theirs} no interface: {names}"));
    }
    if let Some(lumped) = lumped {
        lines.extend(lumped_lines(interfaces, &lumped));
    }
    lines
}

/// The means of a pair with their ranges, as averaging is a modelling choice.
pub(crate) fn lumped_lines(interfaces: &Interfaces, lumped: &LumpedPair) -> Vec<String> {
    let mut lines = Vec::new();
    for (quantity, mean) in interfaces.quantities.iter().zip(&lumped.means) {
        let Some(mean) = mean else { continue };
        lines.push(format!("    {quantity}: {}", mean_text(mean)));
    }
    let [closed, open] = lumped.states;
    if 0 < closed && 0 < open {
        lines.push(format!(
            "    {closed} closed and {open} open slave nodes are one interface, which is closed where its mean clearance is not above 0 or its mean pressure is not 0"
        ));
    }
    lines
}

/// `0.5, mean over 9 nodes by area, 0.2 to 0.8`.
fn mean_text(mean: &WeightedMean) -> String {
    let nodes = counted(mean.nodes, "node");
    let WeightedMean { mean: value, least, largest, .. } = *mean;
    if mean.is_uniform() {
        return format!("{} at {nodes}", number_text(value));
    }
    let (value, least, largest) = (number_text(value), number_text(least), number_text(largest));
    format!("{value}, the mean by area of {nodes}, where it is from {least} to {largest}")
}

fn value(interfaces: &Interfaces, lumped: &LumpedPair) -> Value {
    let means = interfaces.quantities.iter().zip(&lumped.means).filter_map(|(quantity, mean)| {
        let mean = (*mean)?;
        let WeightedMean { mean, least, largest, nodes } = mean;
        Some((quantity.to_string(), json!({ "mean": mean, "least": least, "largest": largest, "nodes": nodes })))
    });
    let means: serde_json::Map<String, Value> = means.collect();
    json!({ "area": lumped.area, "means": means, "closed": lumped.states[0], "open": lumped.states[1] })
}

fn listed(names: &[String]) -> String {
    let shown = names.iter().take(MAX_NAMES).cloned().collect::<Vec<_>>().join(", ");
    match names.len().checked_sub(MAX_NAMES) {
        Some(more) if 0 < more => format!("{shown} and {more} more"),
        _ => shown,
    }
}
