//! `inpact nodes`: a deck with a mesh and its job's result files in; the node table of its contact pairs out.

use super::findings::{Messages, with_messages};
use super::job_results::{RESULTS_HELP, states};
use super::mesh_rows::{RowsSummary, node_rows};
use super::meshed::MeshedDeck;
use super::picture::{Drawn, PictureWriter};
use super::table_output::TableOutput;
use crate::failure::{Failure, Outcome};
use crate::files::{self, ResultFile};
use crate::render::Format;
use crate::settings::DeckArguments;
use crate::text::counted;
use clap::Args;
use inpact_contact::{Joined, NodeRows, State};
use inpact_diagnostics::visible::visible_line;
use inpact_evaluation::results::{ResultWriter, TableFormat};
use serde_json::json;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

#[derive(Debug, Args)]
pub(crate) struct NodesArguments {
    /// The deck, with its mesh; `-` reads standard input.
    #[arg(value_name = "DECK")]
    deck: PathBuf,
    #[arg(long, value_name = "FILE", help = RESULTS_HELP)]
    results: Vec<PathBuf>,
    #[command(flatten)]
    reading: DeckArguments,
    #[command(flatten)]
    output: TableOutput,
    /// How to print notes and summary on standard error.
    #[arg(long, value_enum, default_value_t = Format::Concise)]
    format: Format,
}

pub(crate) fn run(arguments: &NodesArguments) -> Result<Outcome, Failure> {
    with_messages(arguments.format, |messages| make(arguments, messages))
}

fn make(arguments: &NodesArguments, messages: Messages<'_>) -> Result<Outcome, Failure> {
    let start = Instant::now();
    files::name_as_inputs(&[&arguments.deck]);
    files::name_as_inputs(&arguments.results);
    files::check_targets(&[arguments.output.target()])?;
    let settings = arguments.reading.settings(&arguments.deck)?;
    let meshed = MeshedDeck::read(&arguments.deck, &settings)?;
    // The included files are known now.
    files::check_targets(&[arguments.output.target()])?;
    let Joined { states, files, .. } = states(&arguments.results, &meshed, messages)?;
    let mut rows = node_rows(&meshed, &states, messages)?;
    if let Some(target) = arguments.output.picture() {
        let drawn = Drawn { faces: rows.slave_faces(), states };
        draw(&mut rows, &drawn, target)?;
    } else {
        let mut output = ResultFile::create(arguments.output.target())?;
        let written = write(&mut rows, &states, &mut output, arguments.output.format());
        written.map_err(|failure| match failure {
            Failure::Output(error) => output.failure(error),
            failure => failure,
        })?;
        output.finish()?;
    }
    let seconds = start.elapsed().as_secs_f64();
    let summary = RowsSummary::of(&rows, &files);
    let RowsSummary { lines, mut value } = summary;
    let lines = || {
        let head = format!("{}, {seconds:.3} s", counted(rows.rows(), "row"));
        std::iter::once(&head).chain(&lines).map(|line| visible_line(line).into_owned()).collect()
    };
    value["seconds"] = json!(seconds);
    messages.tell(lines, || json!({ "summary": value }).to_string());
    Ok(Outcome::Clean)
}

fn draw(rows: &mut NodeRows<'_>, drawn: &Drawn, target: &Path) -> Result<(), Failure> {
    let names = rows.numbers().iter().map(ToString::to_string).collect();
    let mut writer = PictureWriter::new(drawn, target, names)?;
    for batch in rows.batches(&drawn.states) {
        let batch = batch?;
        for row in 0..batch.rows {
            writer.push(batch.numbers.iter().map(|column| column.get(row)))?;
        }
    }
    writer.finish()
}

/// Writes the rows of all states as a node table; a write error is a failure of an unnamed output.
fn write(
    rows: &mut NodeRows<'_>,
    states: &[State],
    output: &mut (dyn io::Write + Send),
    format: TableFormat,
) -> Result<(), Failure> {
    let writer = ResultWriter::of_nodes(output, format, rows.keys(), rows.numbers());
    let mut writer = writer.map_err(Failure::Output)?;
    for state in states {
        rows.write(state, |batch| writer.write_nodes(batch).map_err(Failure::Output))?;
    }
    writer.finish().map_err(Failure::Output)?;
    Ok(())
}
