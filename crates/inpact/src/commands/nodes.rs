//! `inpact nodes`: a deck with a mesh in, and what its job wrote; the node table of its contact pairs out.

use super::findings::FindingFormat;
use super::job_results::{JobResultArguments, States};
use super::meshed::MeshedDeck;
use super::table_output::TableOutput;
use crate::failure::{Failure, Outcome, say, say_json};
use crate::files::{self, ResultFile};
use crate::settings::DeckArguments;
use clap::Args;
use inpact_contact::{ColumnSummary, FileSummary, NodeRows, PairSummary, RowsError, State};
use inpact_diagnostics::visible::visible_line;
use inpact_evaluation::results::{ResultWriter, TableFormat, push_number};
use serde_json::json;
use std::io;
use std::path::PathBuf;
use std::time::Instant;

#[derive(Debug, Args)]
pub(crate) struct NodesArguments {
    /// The deck, with its mesh; `-` reads standard input.
    #[arg(value_name = "DECK")]
    deck: PathBuf,
    #[command(flatten)]
    results: JobResultArguments,
    #[command(flatten)]
    reading: DeckArguments,
    #[command(flatten)]
    output: TableOutput,
    /// How to print notes and summary on standard error.
    #[arg(long, value_enum, default_value_t = FindingFormat::Concise)]
    format: FindingFormat,
}

pub(crate) fn run(arguments: &NodesArguments) -> Result<Outcome, Failure> {
    let start = Instant::now();
    files::name_as_inputs(&[&arguments.deck]);
    files::name_as_inputs(arguments.results.paths());
    files::check_targets(&[arguments.output.target()])?;
    let settings = arguments.reading.settings(&arguments.deck)?;
    let meshed = MeshedDeck::read(&arguments.deck, &settings)?;
    // What the deck includes is known now.
    files::check_targets(&[arguments.output.target()])?;
    let States { states, files } = arguments.results.states(&meshed, arguments.format)?;
    let mut rows = rows(&meshed, &states, arguments.format)?;
    let mut output = ResultFile::create(arguments.output.target())?;
    match write(&mut rows, &states, &mut output, arguments.output.format()) {
        Ok(()) => output.finish()?,
        Err(Stopped::Rows(error)) => return Err(Failure::Data(error.to_string())),
        Err(Stopped::Writing(error)) => return Err(output.failure(error)),
    }
    let seconds = start.elapsed().as_secs_f64();
    match arguments.format {
        FindingFormat::Concise | FindingFormat::Github => {
            for line in summary_text(&rows, &files, seconds) {
                say(&visible_line(&line));
            }
        }
        FindingFormat::Json => say_json(&summary_json(&rows, &files, seconds)),
    }
    Ok(Outcome::Clean)
}

/// The rows of a deck's pairs in these states, after saying what was not read; an error where there are none.
pub(crate) fn rows<'a>(
    meshed: &'a MeshedDeck,
    states: &[State],
    format: FindingFormat,
) -> Result<NodeRows<'a>, Failure> {
    meshed.say_notes(&meshed.mesh.notes, format)?;
    let rows = rows_of_pairs(meshed, states)?;
    meshed.say_notes(rows.notes(), format)?;
    refuse_none(meshed, &rows)?;
    Ok(rows)
}

/// The rows of a deck's pairs in these states; an error where it has no pair.
pub(crate) fn rows_of_pairs<'a>(meshed: &'a MeshedDeck, states: &[State]) -> Result<NodeRows<'a>, Failure> {
    let MeshedDeck { name, model, mesh, .. } = meshed;
    if mesh.pairs.is_empty() {
        let has_none = model.contact_pairs.is_empty() && model.property_assignments.is_empty();
        return Err(Failure::Data(if has_none {
            format!(
                "`{name}` has no contact pair: expected *CONTACT PAIR, or *CONTACT PROPERTY ASSIGNMENT with two surfaces"
            )
        } else {
            format!("no contact pair of `{name}` has both of its surfaces in the mesh")
        }));
    }
    NodeRows::new(mesh, model, states).map_err(|error| Failure::Data(error.to_string()))
}

/// Refuses pairs without a node.
pub(crate) fn refuse_none(MeshedDeck { name, .. }: &MeshedDeck, rows: &NodeRows<'_>) -> Result<(), Failure> {
    if rows.nodes() == 0 {
        return Err(Failure::Data(format!("no contact pair of `{name}` has a slave node with a place in the mesh")));
    }
    Ok(())
}

/// Which end of making a table failed.
pub(crate) enum Stopped {
    Rows(RowsError),
    Writing(io::Error),
}

impl From<RowsError> for Stopped {
    fn from(error: RowsError) -> Self {
        Self::Rows(error)
    }
}

/// Writes the rows of all states as a node table.
pub(crate) fn write(
    rows: &mut NodeRows<'_>,
    states: &[State],
    output: &mut (dyn io::Write + Send),
    format: TableFormat,
) -> Result<(), Stopped> {
    let writer = ResultWriter::of_nodes(output, format, rows.keys(), rows.numbers());
    let mut writer = writer.map_err(Stopped::Writing)?;
    for state in states {
        rows.write(state, |batch| writer.write_nodes(batch).map_err(Stopped::Writing))?;
    }
    writer.finish().map_err(Stopped::Writing)?;
    Ok(())
}

/// What was made, for a person.
fn summary_text(rows: &NodeRows<'_>, files: &[FileSummary], seconds: f64) -> Vec<String> {
    let counted = |number: u64, what: &str| format!("{number} {what}{}", if number == 1 { "" } else { "s" });
    let mut lines = vec![format!("{}, {seconds:.3} s", counted(rows.rows(), "row"))];
    for file in files {
        let FileSummary { file: name, format, frames, used_frames, nodes, matched_by } = file;
        lines.push(format!(
            "  `{name}`, {format}: {used_frames} of {frames} states, {nodes} nodes found by {matched_by}"
        ));
    }
    for pair in rows.summaries() {
        let PairSummary { slave, master, interaction, area_source, clearance_source, .. } = pair;
        let beside = match pair.without_master {
            0 => String::new(),
            rows => format!(", {rows} without a master face"),
        };
        let nodes = counted(pair.nodes as u64, "slave node");
        let (area, closed, open) = (number_text(pair.area), pair.closed, pair.open);
        lines.push(format!("  `{slave}` on `{master}`, interaction `{interaction}`: {nodes}, area {area}; {closed} closed, {open} open{beside}"));
        lines.push(format!("    area: {area_source}"));
        lines.push(format!("    clearance: {clearance_source}"));
    }
    for summary in rows.columns() {
        let empty = match summary.empty {
            0 => None,
            empty => Some(format!("empty in {}", counted(empty, "row"))),
        };
        let said: Vec<String> = summary.source().into_iter().chain(empty).collect();
        if !said.is_empty() {
            lines.push(format!("  {}: {}", summary.column, said.join(", ")));
        }
    }
    lines
}

/// The same as a JSON object on one line.
fn summary_json(rows: &NodeRows<'_>, files: &[FileSummary], seconds: f64) -> String {
    let pair = |pair: &PairSummary| {
        json!({
            "slave": pair.slave.written(),
            "master": pair.master.written(),
            "interaction": pair.interaction.written(),
            "nodes": pair.nodes,
            "area": pair.area,
            "closed": pair.closed,
            "open": pair.open,
            "without_master": pair.without_master,
            "area_source": pair.area_source.to_string(),
            "clearance_source": pair.clearance_source,
        })
    };
    let column = |column: &ColumnSummary| json!({ "column": column.column.to_string(), "source": column.source(), "empty": column.empty });
    let file = |file: &FileSummary| {
        json!({
            "file": &*file.file,
            "format": file.format.to_string(),
            "states": file.frames,
            "used_states": file.used_frames,
            "nodes": file.nodes,
            "matched_by": file.matched_by.to_string(),
        })
    };
    json!({ "summary": {
        "rows": rows.rows(),
        "seconds": seconds,
        "results": files.iter().map(file).collect::<Vec<_>>(),
        "pairs": rows.summaries().map(pair).collect::<Vec<_>>(),
        "columns": rows.columns().iter().map(column).collect::<Vec<_>>(),
    } })
    .to_string()
}

fn number_text(value: f64) -> String {
    let mut text = Vec::new();
    push_number(&mut text, value);
    String::from_utf8_lossy(&text).into_owned()
}
