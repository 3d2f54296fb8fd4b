//! Shared parts of the rules on tables: the tables to check, and how they must start.
//!
//! The numbers of a table are checked only where they can be trusted: a row with too many items, a
//! misspelt parameter or an unreadable DEPENDENCIES has a finding of its own, and its consequences have none.

use crate::parameter::given;
use crate::rule::{Context, DefinedBlock, trimmed};
use inpact_parser::ProblemKind;
use inpact_parser::deck::{Deck, KeywordLine};
use inpact_parser::expression::{Parameters, substitute};
use inpact_parser::grammar::{Grammar, RowShape};
use inpact_parser::model::{MAX_FIELD_VARIABLES, Model, OptionKind, Table, TableOf};
use inpact_parser::number::{read_float, read_integer};
use inpact_parser::span::Span;
use std::collections::HashSet;

/// The tables whose rows match their columns.
pub(crate) fn sound_tables<'a>(context: &'a Context<'_>) -> impl Iterator<Item = TableOf<'a>> {
    // Used by every rule on tables, and mostly empty.
    let misread = context.misread.get_or_init(|| misread(context));
    context
        .tables()
        .filter(move |of| of.table.width() > 1 && (misread.is_empty() || !misread.contains(&of.table.keyword)))
}

/// The keyword lines whose rows do not match their columns.
fn misread(context: &Context<'_>) -> HashSet<Span> {
    // CalculiX ignores items after those it reads.
    let is_misread = |kind: &ProblemKind| match kind {
        ProblemKind::TooManyItems { .. } => !context.is_for_calculix(),
        ProblemKind::IncompleteRow { .. } => true,
        _ => false,
    };
    let of_rows = context.problems.iter().filter(|problem| is_misread(&problem.kind));
    let of_lines = context.defined_blocks().filter(|block| {
        let is_table = matches!(block.definition.rows(), RowShape::Table | RowShape::HeadedTable);
        is_table && columns_are_unclear(context, *block)
    });
    of_rows.map(|problem| problem.keyword).chain(of_lines.map(|block| block.keyword.span)).collect()
}

/// Whether the keyword line has an unknown parameter, or leaves the number of columns open.
pub(crate) fn columns_are_unclear(context: &Context<'_>, block: DefinedBlock<'_>) -> bool {
    if block.definition.parameters_complete && !context.is_for_calculix() && has_unclear_parameters(block.keyword) {
        return true;
    }
    let mut counts = given(block).filter(|given| given.definition.name == "DEPENDENCIES");
    let Some(count) = counts.next() else { return false };
    let number = count.value().and_then(|value| read_integer(context.value(value).as_bytes()).ok());
    let fits = |number: i64| usize::try_from(number).is_ok_and(|number| number <= MAX_FIELD_VARIABLES);
    counts.next().is_some() || !number.is_some_and(fits)
}

/// Whether a parameter of the line is unknown or ambiguous: K004 and K005 report it.
pub(crate) fn has_unclear_parameters(keyword: &KeywordLine) -> bool {
    keyword.parameters().any(|parameter| parameter.index().is_none())
}

/// Whether a group may start at that clearance or pressure (T-24, Q-11).
pub(crate) fn starts_as_it_must(of: TableOf<'_>, abscissa: f64) -> bool {
    if of.kind.is_against_clearance() {
        abscissa == 0.0
    } else {
        !of.kind.is_conductance_against_pressure() || abscissa <= 0.0
    }
}

/// Whether a cell is not empty; an empty one reads as 0.
pub(crate) fn is_written(context: &Context<'_>, of: TableOf<'_>, row: usize, column: usize) -> bool {
    let cell = context.cell(of, row, column);
    // The span of the row marks a missing cell; but a row of one item is its first cell.
    !cell.is_empty() && (column == 0 || cell != of.table.row_span(row))
}

/// The view factors of every *GAP RADIATION against clearance, read here because the model keeps its rows as text (2.6).
pub(crate) fn radiation_tables(deck: &Deck, grammar: &Grammar, model: &Model) -> Vec<Table> {
    let blocks = deck.blocks().iter().filter_map(|block| {
        let keyword = block.keyword.as_ref()?;
        let entry = grammar.keyword(keyword.id()?);
        (OptionKind::of(&entry.name) == OptionKind::GapRadiation).then_some((block, keyword, entry.definition()?))
    });
    let tables = blocks.map(|(block, keyword, definition)| {
        let columns: Vec<String> = definition.data.columns.iter().map(|column| column.name.clone()).collect();
        let mut table = Table { keyword: keyword.span, ..Table::default() };
        // The first line holds the emissivities.
        let (mut values, mut spans) = (Vec::new(), Vec::new());
        for line in deck.data_lines(block).filter(|line| !line.is_blank()).skip(1) {
            let mut items = line.items();
            spans.push(trimmed(deck, line.span));
            values.extend(
                columns.iter().map(|_| items.next().map_or(0.0, |item| number_in(deck, &model.parameters, item))),
            );
        }
        table.values = values.into();
        table.set_row_spans(spans);
        table.columns = columns.into();
        table
    });
    tables.filter(|table| table.row_count() > 0).collect()
}

/// The emissivities of every *GAP RADIATION, with their places.
pub(crate) fn emissivities(context: &Context<'_>) -> Vec<(Span, f64)> {
    let options = context.defined_blocks().filter(|block| block.kind() == OptionKind::GapRadiation);
    let heads = options.filter_map(|block| context.rows(block).next());
    let items = heads.flat_map(|head| head.items().take(2).collect::<Vec<_>>());
    items.map(|item| (item, number_in(context.deck, &context.model.parameters, item))).collect()
}

/// The number in an item, a `<parameter>` replaced by its value: 0 for an empty item (S-32), NaN where it is no number.
fn number_in(deck: &Deck, parameters: &Parameters, item: Span) -> f64 {
    if item.is_empty() {
        return 0.0;
    }
    let text = deck.shown(item);
    substitute(&text, parameters).ok().and_then(|text| read_float(text.trim().as_bytes()).ok()).unwrap_or(f64::NAN)
}
