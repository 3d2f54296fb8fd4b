//! `inpact tradeoff`: what accuracy costs on a user's own deck and node table, as a work–precision diagram.
//!
//! Every mode evaluates the tables that the plan has in force, folded as the plan folds them, on the rows that reach them.
//! Columns stay in memory, the rounds of all modes are interleaved, and the least time of each counts.

mod diagram;
mod measure;
mod modes;
mod report;
mod subjects;

use super::scene::{FindingFormat, SceneArguments, say_data_findings};
use crate::chart::Chart;
use crate::failure::{Failure, Outcome};
use crate::files;
use clap::{Args, ValueEnum};
use inpact_evaluation::nodes::Findings;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct TradeoffArguments {
    #[command(flatten)]
    scene: SceneArguments,
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
    #[arg(long, value_name = "ROWS", default_value_t = 1_000_000, value_parser = clap::value_parser!(u64).range(1..))]
    sample: u64,
    /// How often each mode is timed.
    #[arg(long, value_name = "N", default_value_t = 11, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    rounds: u32,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum TradeoffFormat {
    /// A table for a person.
    Text,
    /// A table for a spreadsheet.
    Csv,
    /// For another program.
    Json,
}

/// A picture to draw.
#[derive(Debug, Clone)]
struct Picture {
    path: PathBuf,
    kind: PictureKind,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum PictureKind {
    Svg,
    Png,
}

pub(crate) fn run(arguments: &TradeoffArguments) -> Result<Outcome, Failure> {
    let targets = [arguments.output.as_deref(), arguments.plot.as_ref().map(|plot| plot.path.as_path())];
    for target in targets {
        files::refuse_overwriting(target, &arguments.scene.inputs())?;
    }
    let format = match arguments.format {
        TradeoffFormat::Json => FindingFormat::Json,
        TradeoffFormat::Text | TradeoffFormat::Csv => FindingFormat::Concise,
    };
    let Some(mut scene) = arguments.scene.prepare(format)? else { return Ok(Outcome::HasErrors) };
    if scene.deck_has_errors {
        return Ok(Outcome::HasErrors);
    }
    let mut findings = Findings::new(&scene.nodes_name);
    let sample = subjects::gather(&mut scene, arguments.scene.nodes_path(), arguments.sample, &mut findings)?;
    let has_errors = findings.has_errors();
    say_data_findings(findings.into_list(), format);
    if has_errors {
        return Ok(Outcome::HasErrors);
    }
    if sample.subjects.is_empty() {
        let message = format!("no table of `{}` varies on these rows: there is nothing to trade", scene.deck_name);
        return Err(Failure::Data(message));
    }
    let measured = measure::measure(&sample, arguments.rounds);
    let names = report::Names { deck: &scene.deck_name, nodes: &scene.nodes_name };
    let text = match arguments.format {
        TradeoffFormat::Text => report::text(&measured, names),
        TradeoffFormat::Csv => report::csv(&measured),
        TradeoffFormat::Json => report::json(&measured, names),
    };
    files::write_result(arguments.output.as_deref(), text.as_bytes())?;
    if let Some(picture) = &arguments.plot {
        let drawn = draw(&diagram::chart(&measured, names), picture.kind)?;
        files::write_result(Some(&picture.path), &drawn)?;
    }
    Ok(Outcome::Clean)
}

fn draw(chart: &Chart, kind: PictureKind) -> Result<Vec<u8>, Failure> {
    let svg = chart.svg();
    match kind {
        PictureKind::Svg => Ok(svg.into_bytes()),
        #[cfg(feature = "png")]
        PictureKind::Png => {
            crate::chart::png::render(&svg).map_err(|error| Failure::Usage(format!("cannot draw the picture: {error}")))
        }
        #[cfg(not(feature = "png"))]
        PictureKind::Png => Err(Failure::Usage("this inpact was built without PNG: draw an .svg".to_owned())),
    }
}

fn picture(text: &str) -> Result<Picture, String> {
    let path = Path::new(text);
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    let kind = match extension.to_str() {
        Some("svg") => PictureKind::Svg,
        Some("png") => PictureKind::Png,
        _ => return Err("the name of a picture must end in .svg or .png".to_owned()),
    };
    Ok(Picture { path: path.to_owned(), kind })
}
