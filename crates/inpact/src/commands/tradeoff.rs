//! `inpact tradeoff`: the cost of accuracy on a user's own data, as a work–precision diagram.
//!
//! `tables` measures the modes of evaluation on a deck and its node table, `solvers` the linear solvers on a scene; their files have the same names.

mod cells;
mod front;
mod rounds;
mod solvers;
mod tables;

pub(crate) use tables::diagram;

use super::drawing::DrawingFormat;
use super::evaluable::EvaluableArguments;
use super::findings::Messages;
use super::laws::LawArguments;
use crate::chart::Chart;
use crate::failure::{Failure, Outcome};
use crate::files;
use crate::render::Format;
use crate::settings::DeckArguments;
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

/// Errors below half an ulp are drawn there, since zero has no logarithm.
const LEAST_ERROR: f64 = f64::EPSILON / 4.0;

#[derive(Debug, Args)]
#[command(override_usage = USAGE)]
pub(crate) struct TradeoffArguments {
    #[command(flatten)]
    table: Option<EvaluableArguments>,
    /// Measure the solvers on a scene, which names its deck, instead of the modes on a deck and its node table; `-` reads standard input.
    #[arg(long, value_name = "SCENE", conflicts_with_all = OF_TABLE)]
    scene: Option<PathBuf>,
    /// Where to write the result, instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// How to print the result.
    #[arg(long, value_enum, default_value_t = TradeoffFormat::Text)]
    format: TradeoffFormat,
    /// Draw error against time as well: FILE ends in .svg or .png.
    #[arg(long, value_name = "FILE", value_parser = picture)]
    plot: Option<Picture>,
    /// Of a longer node table, take so many rows at most, evenly spread.
    #[arg(long, value_name = "ROWS", default_value_t = 1_000_000, value_parser = clap::value_parser!(u64).range(1..), conflicts_with = "scene")]
    sample: u64,
    /// How often each mode, or each solver, is timed.
    #[arg(long, value_name = "N", default_value_t = 11, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    rounds: u32,
    #[command(flatten)]
    laws: LawArguments,
    #[command(flatten)]
    reading: DeckArguments,
}

/// Options that only the modes on a node table have; one by one, so that a message names those that were given.
const OF_TABLE: [&str; 11] = [
    "deck",
    "nodes",
    "results",
    "interaction",
    "procedure",
    "threads",
    "accuracy",
    "tolerance",
    "tolerance_relative",
    "outputs",
    "derivatives",
];

/// Both forms of the command.
const USAGE: &str = "\
inpact tradeoff [OPTIONS] --nodes <FILE> <DECK>
       inpact tradeoff [OPTIONS] [--results <FILE>]... <DECK>
       inpact tradeoff [OPTIONS] --scene <SCENE>";

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum TradeoffFormat {
    /// A table for a person.
    Text,
    /// A table for a spreadsheet.
    Csv,
    /// For another program.
    Json,
}

#[derive(Debug, Clone)]
struct Picture {
    path: PathBuf,
    format: DrawingFormat,
}

/// The measurements, as they are shown.
struct Shown {
    /// In the requested format.
    text: String,
    chart: Chart,
}

impl TradeoffFormat {
    fn messages(self) -> Messages<'static> {
        match self {
            Self::Json => Messages::at_once(Format::Json),
            Self::Text | Self::Csv => Messages::LINES,
        }
    }
}

impl TradeoffArguments {
    /// The files of results.
    fn targets(&self) -> [Option<&Path>; 2] {
        [self.output.as_deref(), self.plot.as_ref().map(|plot| plot.path.as_path())]
    }
}

pub(crate) fn run(arguments: &TradeoffArguments) -> Result<Outcome, Failure> {
    if let Some(table) = &arguments.table {
        files::name_as_inputs(&table.inputs());
    }
    files::check_targets(&arguments.targets())?;
    let shown = match (&arguments.scene, &arguments.table) {
        (Some(scene), _) => solvers::measured(scene, arguments)?,
        (None, Some(table)) => tables::measured(table, arguments)?,
        (None, None) => return Err(Failure::Usage(format!("nothing to measure on\n\nUsage: {USAGE}"))),
    };
    let Some(Shown { text, chart }) = shown else { return Ok(Outcome::HasErrors) };
    files::write_result(arguments.output.as_deref(), text.as_bytes())?;
    if let Some(picture) = &arguments.plot {
        files::write_result(Some(&picture.path), &picture.format.bytes(chart.svg())?)?;
    }
    Ok(Outcome::Clean)
}

fn picture(text: &str) -> Result<Picture, String> {
    let path = Path::new(text);
    match DrawingFormat::of_name(path) {
        Some(format) => Ok(Picture { path: path.to_owned(), format }),
        None => Err("the name of a picture must end in .svg or .png".to_owned()),
    }
}
