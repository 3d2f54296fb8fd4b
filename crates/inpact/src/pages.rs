//! The pages of rules, keywords and columns as Markdown, as `explain` prints and editors show them.

use crate::error::Error;
use crate::failure::Failure;
use crate::page;
pub use crate::page::{of_keyword, of_rule};
use crate::rules as registry;
use inpact_diagnostics::Rule;
use inpact_evaluation::nodes::{COLUMN_PAGES, Column};
use inpact_evaluation::results::Output;
use inpact_parser::grammar::{Grammar, nearest_names};
use std::collections::BTreeMap;

/// All rules: those of decks, of node tables, of scenes.
///
/// ```
/// assert!(inpact::pages::rules().any(|rule| rule.code == "D003"));
/// ```
pub fn rules() -> impl Iterator<Item = &'static Rule> {
    registry::all()
}

/// Every page: all rules by their codes, then all keywords, then the columns of node tables and results.
pub fn all() -> String {
    let grammar = Grammar::builtin();
    let rules: BTreeMap<&str, String> = registry::all().map(|rule| (rule.code, page::of_rule(rule))).collect();
    let keywords = grammar.keywords().filter_map(|(_, keyword)| keyword.definition()).map(page::of_keyword);
    rules.into_values().chain(keywords).chain([page::of_columns()]).collect::<Vec<_>>().join("\n")
}

/// The page of a rule by its code or name, of a keyword, or of a column of node tables or results; `columns` for all of these.
///
/// ```
/// assert!(inpact::pages::explain("T001")?.starts_with("# T001 not-ascending\n"));
/// assert!(inpact::pages::explain("*gap electrical conductance")?.contains("| item | name | dimension |"));
/// let error = inpact::pages::explain("T0O1").unwrap_err();
/// assert!(error.to_string().contains("did you mean `T001`"));
/// # Ok::<(), inpact::Error>(())
/// ```
///
/// # Errors
/// A text that names none of them, with suggestions.
pub fn explain(what: &str) -> Result<String, Error> {
    let is_meant = |code: &str, name: &str| code.eq_ignore_ascii_case(what) || name.eq_ignore_ascii_case(what);
    if let Some(rule) = registry::all().find(|rule| is_meant(rule.code, rule.name)) {
        return Ok(page::of_rule(rule));
    }
    if what.eq_ignore_ascii_case("columns") {
        return Ok(page::of_columns());
    }
    let grammar = Grammar::builtin();
    let name = what.trim_start_matches('*');
    let columns = if name == what { pages_of_columns(what) } else { String::new() };
    if !columns.is_empty() {
        // *NODE and *STEP are keywords too; a mere abbreviation means the column.
        let keyword = grammar.keywords().map(|(_, keyword)| keyword).find(|keyword| is_meant("", &keyword.name));
        let keyword = keyword.and_then(|keyword| keyword.definition()).map(page::of_keyword);
        return Ok(keyword.into_iter().chain([columns]).collect::<Vec<_>>().join("\n"));
    }
    let keyword = grammar.keyword_named(name.as_bytes()).found().map(|id| grammar.keyword(id));
    match keyword.map(|keyword| (keyword, keyword.definition())) {
        Some((_, Some(definition))) => Ok(page::of_keyword(definition)),
        Some((keyword, None)) => {
            let message =
                format!("*{} is a keyword of Abaqus, but inpact knows no more of it than its name", keyword.name);
            Err(Failure::Usage(message).into())
        }
        None => {
            let outputs: Vec<String> = Output::NAMED.iter().map(ToString::to_string).collect();
            let rules = registry::all().flat_map(|rule| [rule.code, rule.name]);
            let columns = COLUMN_PAGES.iter().flat_map(|page| page.names).copied();
            let rules = rules.chain(columns).chain(outputs.iter().map(String::as_str));
            let rules = nearest_names(what.as_bytes(), rules, 3).into_iter().map(|rule| format!("`{rule}`"));
            let keywords = grammar.nearest_keywords(name, 3).into_iter().map(|keyword| format!("*{keyword}"));
            let near: Vec<String> = rules.chain(keywords).collect();
            let near = if near.is_empty() {
                "; `inpact explain --all` has every page".to_owned()
            } else {
                format!("; did you mean {}?", near.join(", "))
            };
            Err(Failure::Usage(format!("there is no rule, no keyword and no column `{what}`{near}")).into())
        }
    }
}

/// The pages of the columns of that name, one of node tables and one of results at most; empty where there is none.
fn pages_of_columns(name: &str) -> String {
    let of_nodes = Column::named(name).and_then(Column::page).map(page::of_column);
    let of_results = Output::named(name).and_then(Output::page).map(page::of_output);
    of_nodes.into_iter().chain(of_results).collect::<Vec<_>>().join("\n")
}
