//! `inpact explain`: the page of a rule, of a keyword, or of a column of node tables and results.

use crate::failure::{Failure, Outcome};
use crate::files;
use crate::page;
use crate::rules;
use clap::{Args, ValueEnum};
use inpact_evaluation::nodes::{COLUMN_PAGES, Column};
use inpact_evaluation::results::Output;
use inpact_parser::grammar::{Grammar, nearest_names};
use std::collections::BTreeMap;
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
    let markdown = if arguments.all { all_pages() } else { page_of(&arguments.what.join(" "))? };
    let text = match arguments.format {
        PageFormat::Markdown => markdown,
        PageFormat::Text => plain(&markdown),
    };
    files::write_result(arguments.output.as_deref(), text.as_bytes())?;
    Ok(Outcome::Clean)
}

fn all_pages() -> String {
    let grammar = Grammar::builtin();
    let rules: BTreeMap<&str, String> = rules::all().map(|rule| (rule.code, page::of_rule(rule))).collect();
    let keywords = grammar.keywords().filter_map(|(_, keyword)| keyword.definition()).map(page::of_keyword);
    rules.into_values().chain(keywords).chain([page::of_columns()]).collect::<Vec<_>>().join("\n")
}

fn page_of(what: &str) -> Result<String, Failure> {
    let is_meant = |code: &str, name: &str| code.eq_ignore_ascii_case(what) || name.eq_ignore_ascii_case(what);
    if let Some(rule) = rules::all().find(|rule| is_meant(rule.code, rule.name)) {
        return Ok(page::of_rule(rule));
    }
    if what.eq_ignore_ascii_case("columns") {
        return Ok(page::of_columns());
    }
    let grammar = Grammar::builtin();
    let words = what.trim_start_matches('*');
    let columns = if words == what { pages_of_columns(what) } else { String::new() };
    if !columns.is_empty() {
        // *NODE and *STEP are keywords too; what only abbreviates one means the column.
        let keyword = grammar.keywords().map(|(_, keyword)| keyword).find(|keyword| is_meant("", &keyword.name));
        let keyword = keyword.and_then(|keyword| keyword.definition()).map(page::of_keyword);
        return Ok(keyword.into_iter().chain([columns]).collect::<Vec<_>>().join("\n"));
    }
    let keyword = grammar.keyword_named(words.as_bytes()).found().map(|id| grammar.keyword(id));
    match keyword.map(|keyword| (keyword, keyword.definition())) {
        Some((_, Some(definition))) => Ok(page::of_keyword(definition)),
        Some((keyword, None)) => {
            let message =
                format!("*{} is a keyword of Abaqus, but inpact knows no more of it than its name", keyword.name);
            Err(Failure::Usage(message))
        }
        None => {
            let outputs: Vec<String> = Output::NAMED.iter().map(ToString::to_string).collect();
            let rules = rules::all().flat_map(|rule| [rule.code, rule.name]);
            let columns = COLUMN_PAGES.iter().flat_map(|page| page.names).copied();
            let rules = rules.chain(columns).chain(outputs.iter().map(String::as_str));
            let rules = nearest_names(what.as_bytes(), rules, 3).into_iter().map(|rule| format!("`{rule}`"));
            let keywords = grammar.nearest_keywords(words, 3).into_iter().map(|keyword| format!("*{keyword}"));
            let near: Vec<String> = rules.chain(keywords).collect();
            let near = if near.is_empty() {
                "; `inpact explain --all` has every page".to_owned()
            } else {
                format!("; did you mean {}?", near.join(", "))
            };
            Err(Failure::Usage(format!("there is no rule, no keyword and no column `{what}`{near}")))
        }
    }
}

/// The pages of the columns of that name, one of node tables and one of results at most; empty where there is none.
fn pages_of_columns(name: &str) -> String {
    let of_nodes = Column::named(name).and_then(Column::page).map(page::of_column);
    let of_results = Output::named(name).and_then(Output::page).map(page::of_output);
    of_nodes.into_iter().chain(of_results).collect::<Vec<_>>().join("\n")
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

/// A table of Markdown with its columns one below another.
fn aligned(table: &[&str]) -> String {
    let cells = |line: &str| line.trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect::<Vec<_>>();
    let is_ruler = |line: &&&str| line.starts_with("|---");
    let rows: Vec<Vec<String>> = table.iter().filter(|line| !is_ruler(line)).map(|line| cells(line)).collect();
    let width = |column: usize| rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max();
    let line = |row: &Vec<String>| {
        let padded = row.iter().enumerate().map(|(column, cell)| format!("{cell:<0$}", width(column).unwrap_or(0)));
        format!("    {}\n", padded.collect::<Vec<_>>().join("  ").trim_end())
    };
    rows.iter().map(line).collect()
}
