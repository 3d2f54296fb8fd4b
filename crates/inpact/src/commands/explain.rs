//! `inpact explain`: the page of a rule, of a keyword, or of a column of node tables and results.

use crate::error::Error;
use crate::failure::{Failure, Outcome};
use crate::files;
use crate::pages;
use crate::text;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct ExplainArguments {
    /// The code or name of a rule, a keyword, or a column: T001, not-ascending, "GAP ELECTRICAL CONDUCTANCE", ECD, epot_s; `columns` for all of these.
    #[arg(required_unless_present = "all", num_args = 1.., value_name = "WHAT")]
    what: Vec<String>,
    /// Every page: all rules, then all keywords, then the columns.
    #[arg(long, conflicts_with = "what")]
    all: bool,
    /// How to print it.
    #[arg(long, value_enum, default_value_t = PageFormat::Text)]
    format: PageFormat,
    /// Where to write, instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum PageFormat {
    /// For a terminal.
    Text,
    /// For a documentation site.
    Markdown,
}

pub(crate) fn run(arguments: &ExplainArguments) -> Result<Outcome, Failure> {
    let markdown = if arguments.all {
        pages::all()
    } else {
        pages::explain(&arguments.what.join(" ")).map_err(Error::into_failure)?
    };
    let text = match arguments.format {
        PageFormat::Markdown => markdown,
        PageFormat::Text => plain(&markdown),
    };
    files::write_result(arguments.output.as_deref(), text.as_bytes())?;
    Ok(Outcome::Clean)
}

/// The page without the marks of Markdown that only a browser needs.
fn plain(markdown: &str) -> String {
    let mut text = String::new();
    let mut is_code = false;
    let mut table = Vec::new();
    for line in markdown.lines() {
        if !is_code && line.starts_with('|') {
            table.push(line);
            continue;
        }
        text += &aligned(&std::mem::take(&mut table));
        if line.starts_with("```") {
            is_code = !is_code;
            continue;
        }
        let indent = if is_code { "    " } else { "" };
        let line = if is_code { line } else { line.trim_start_matches('#').trim_start_matches(' ') };
        text += &format!("{indent}{line}\n");
    }
    text + &aligned(&table)
}

/// A Markdown table with aligned columns.
fn aligned(table: &[&str]) -> String {
    let cells = |line: &str| line.trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect::<Vec<_>>();
    let is_ruler = |line: &&&str| line.starts_with("|---");
    let rows: Vec<Vec<String>> = table.iter().filter(|line| !is_ruler(line)).map(|line| cells(line)).collect();
    text::aligned(&rows, "    ", |_| true)
}
