//! The pages of rules, keywords and columns as Markdown, for `explain` and the documentation.

use crate::text::in_backticks;
use inpact_diagnostics::{FixKind, Rule};
use inpact_evaluation::nodes::{COLUMN_PAGES, ColumnPage};
use inpact_evaluation::results::{OUTPUT_PAGES, OutputPage};
use inpact_parser::grammar::{Column, Data, Definition, Level, ParameterDefinition, ParameterKind, Product, RowShape};
use std::fmt::Write;

/// The page of a rule.
///
/// ```
/// let rule = inpact::pages::rules().find(|rule| rule.name == "not-ascending").expect("there is one");
/// assert!(inpact::pages::of_rule(rule).contains("Severity: error."));
/// ```
pub fn of_rule(rule: &Rule) -> String {
    let fix = match rule.fix {
        FixKind::None => "",
        FixKind::Safe => " `--fix` mends it.",
        FixKind::ChangesMeaning => " `--fix-also` with its code mends it, which changes what the deck means.",
    };
    let mut page = format!("# {} {}\n\n", rule.code, rule.name);
    let _ = writeln!(page, "Severity: {}. Source: {}.{fix}\n", rule.severity, rule.source);
    for line in rule.documentation.lines() {
        page += line.strip_prefix(' ').unwrap_or(line).trim_end();
        page.push('\n');
    }
    // Tags for the test harness are not for readers.
    page.replace("```inp,expect", "```inp").replace("```inp,fixed", "```inp")
}

/// The page of a column of node tables.
pub(crate) fn of_column(column: &ColumnPage) -> String {
    let (name, others) = (column.names[0], in_backticks(&column.names[1..]));
    let mut page = format!("# {name}\n\nA column of node tables: {}.\n\n", column.meaning);
    if !others.is_empty() {
        let _ = writeln!(page, "- Other names: {others}");
    }
    let _ = writeln!(page, "- Unit: {}", if column.unit.is_empty() { "a text" } else { column.unit });
    let _ = writeln!(page, "- Read by: {}", column.read_by);
    let _ = writeln!(page, "- Source: {}", column.source);
    page
}

/// The page of a column of results.
pub(crate) fn of_output(output: &OutputPage) -> String {
    let mut page = format!("# {}\n\nA column of results: {}.\n\n", output.output, output.meaning);
    let _ = writeln!(page, "- Unit: {}", if output.unit.is_empty() { "a text" } else { output.unit });
    let _ = writeln!(page, "- Needs: {}", output.needs);
    let _ = writeln!(page, "- Source: {}", output.source);
    page
}

/// The columns of node tables and those of results, one table each.
pub(crate) fn of_columns() -> String {
    let mut page = "## Columns of node tables\n\n".to_owned();
    page +=
        "Names are compared without regard to case; `_s` is the slave (secondary) side, `_m` the master (main) side.\n";
    page += "Units are by dimension: M mass, L length, T time, θ temperature, φ electric potential, C charge.\n\n";
    page += "| column | other names | meaning | unit | read by | source |\n|---|---|---|---|---|---|\n";
    for ColumnPage { names: all, meaning, unit, read_by, source, .. } in COLUMN_PAGES {
        let others = in_backticks(&all[1..]);
        let _ = writeln!(page, "| `{}` | {others} | {meaning} | {unit} | {read_by} | {source} |", all[0]);
    }
    page += "\n## Columns of results\n\n";
    page += "The key columns of the node table (`node`, `interaction`, `time`) come first, then what the laws give.\n";
    page +=
        "An output whose inputs are not all there is left out, and one that `--outputs` names is an error instead.\n\n";
    page += "| column | meaning | unit | needs | source |\n|---|---|---|---|---|\n";
    for OutputPage { output, meaning, unit, needs, source } in OUTPUT_PAGES {
        let _ = writeln!(page, "| `{output}` | {meaning} | {unit} | {needs} | {source} |");
    }
    page
}

/// The page of a keyword.
///
/// ```
/// let grammar = inpact_parser::grammar::Grammar::builtin();
/// let keyword = grammar.keywords().find_map(|(_, keyword)| keyword.definition()).expect("there is one");
/// assert!(inpact::pages::of_keyword(keyword).starts_with(&format!("# *{}\n", keyword.name)));
/// ```
pub fn of_keyword(definition: &Definition) -> String {
    let mut page = format!("# *{}\n\n{}.\n\n", definition.name, definition.summary);
    let levels: Vec<&str> = definition.levels.iter().map(|level| level_name(*level)).collect();
    let _ = writeln!(page, "- Level: {}", levels.join(", "));
    if !definition.parents.is_empty() {
        let parents: Vec<String> = definition.parents.iter().map(|parent| format!("*{parent}")).collect();
        let _ = writeln!(page, "- In the block of: {}", parents.join(", "));
    }
    let products: Vec<&str> = definition.products.iter().map(|product| product_name(*product)).collect();
    let _ = writeln!(page, "- Product: {}", products.join(", "));
    if let Some(release) = definition.since {
        let _ = writeln!(page, "- Since release {release}");
    }
    if let Some(release) = definition.until {
        let _ = writeln!(page, "- Until release {release}");
    }
    let _ = writeln!(page, "- Source: {}", definition.source);
    page += "\n## Parameters\n\n";
    if definition.parameters.is_empty() {
        page += "None.\n";
    }
    for parameter in &definition.parameters {
        page += &parameter_item(parameter);
    }
    if !definition.parameters_complete {
        page += "\nThere may be others: inpact knows only those it needs.\n";
    }
    page += "\n## Data lines\n\n";
    page += &data_section(&definition.data);
    let _ = write!(page, "\n## Example\n\n```inp\n{}\n```\n", definition.example.trim());
    page
}

fn level_name(level: Level) -> &'static str {
    match level {
        Level::Model => "model",
        Level::Part => "part",
        Level::Instance => "instance",
        Level::Assembly => "assembly",
        Level::Step => "step",
    }
}

fn product_name(product: Product) -> &'static str {
    match product {
        Product::Standard => "Abaqus/Standard",
        Product::Explicit => "Abaqus/Explicit",
    }
}

pub(crate) fn parameter_item(parameter: &ParameterDefinition) -> String {
    let kind = match parameter.kind {
        ParameterKind::Flag | ParameterKind::Choice => "",
        ParameterKind::Integer => "=integer",
        ParameterKind::Float => "=number",
        ParameterKind::Label => "=name",
        ParameterKind::Text => "=text",
        ParameterKind::File => "=file",
    };
    let choices =
        if parameter.choices.is_empty() { String::new() } else { format!("={}", parameter.choices.join("|")) };
    let mut facts = Vec::new();
    if parameter.required {
        facts.push("required".to_owned());
    }
    facts.extend(parameter.dimension.map(|dimension| format!("dimension {dimension}")));
    facts.extend(parameter.default.as_ref().map(|default| format!("default {default}")));
    facts.extend(parameter.since.map(|release| format!("since {release}")));
    facts.extend(parameter.until.map(|release| format!("until {release}")));
    let list = |title: &str, names: &[String]| (!names.is_empty()).then(|| format!("{title} {}", names.join(", ")));
    facts.extend(list("needs", &parameter.needs));
    facts.extend(list("not with", &parameter.excludes));
    facts.extend(list("ignored with", &parameter.ignored_with));
    let facts = if facts.is_empty() { String::new() } else { format!(" ({})", facts.join("; ")) };
    format!("- `{}{kind}{choices}`: {}{facts}\n", parameter.name, parameter.description)
}

fn data_section(data: &Data) -> String {
    let mut text = match data.shape {
        RowShape::None => return "None.\n".to_owned(),
        RowShape::Text => return "Free text.\n".to_owned(),
        RowShape::Uninterpreted => return "Not interpreted: kept as they are.\n".to_owned(),
        RowShape::Line => "One line at most.\n\n".to_owned(),
        RowShape::Table => "Rows of a table, as many as needed.\n\n".to_owned(),
        RowShape::HeadedTable => "One line of its own, then rows of a table.\n\n".to_owned(),
        RowShape::Items => "Lines of items.\n\n".to_owned(),
    };
    if data.required {
        text += "At least one is needed.\n\n";
    }
    if data.minimum_rows > 1 {
        let _ = writeln!(text, "At least {} rows are needed.\n", data.minimum_rows);
    }
    if !data.head.is_empty() {
        text += &layout_table(&data.head.iter().collect::<Vec<_>>(), None);
        text.push('\n');
    }
    text +=
        &layout_table(&data.columns.iter().collect::<Vec<_>>(), data.counted.as_ref().map(|counted| &*counted.prefix));
    if let Some(counted) = &data.counted {
        let _ = writeln!(
            text,
            "\n`{0}1`, `{0}2`, …: {1}, as many as {2} says; {3} of them on the first line, {4} on every further one.",
            counted.prefix, counted.description, counted.count, counted.first_line, counted.following
        );
    }
    text
}

/// The items of a line as a table, which an analyst looks for first.
fn layout_table(columns: &[&Column], counted: Option<&str>) -> String {
    let mut text = "| item | name | dimension | empty means | what it is |\n|---|---|---|---|---|\n".to_owned();
    let mut item = 0;
    for column in columns {
        // Two mutually exclusive columns share a position.
        item += usize::from(column.with.is_none());
        let dimension = column.dimension.map_or_else(|| "-".to_owned(), |dimension| dimension.to_string());
        let default = column.default.unwrap_or(0.0);
        let only = match (&column.with, &column.without) {
            (Some(with), _) => format!(" (with {with})"),
            (None, Some(without)) => format!(" (without {without})"),
            (None, None) => String::new(),
        };
        let _ =
            writeln!(text, "| {item} | `{}`{only} | {dimension} | {default} | {} |", column.name, column.description);
    }
    if let Some(prefix) = counted {
        let _ = writeln!(text, "| {}… | `{prefix}1` … | | 0 | see below |", item + 1);
    }
    text
}
