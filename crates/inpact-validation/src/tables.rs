//! What the rules on tables share: which tables to judge, how their rows ascend, which rows form a group.
//!
//! A table is judged by its numbers only where they can be trusted to be what was meant: a row with too many items, a
//! misspelt parameter or an unreadable DEPENDENCIES has a finding of its own, and what follows from it has none.
//! Cells without a number (a `<parameter>`, something malformed) are NaN and take no part.

use crate::diagnostic::Edit;
use crate::parameter::given;
use crate::rule::{Context, DefinedBlock};
use inpact_parser::deck::{Deck, KeywordLine};
use inpact_parser::expression::{Parameters, substitute};
use inpact_parser::grammar::{Grammar, RowShape};
use inpact_parser::model::{MOST_FIELD_VARIABLES, Model, Table, TableKind, TableOf};
use inpact_parser::number::{read_float, read_integer};
use inpact_parser::problem::ProblemKind;
use inpact_parser::span::Span;
use std::cmp::Ordering;
use std::collections::HashSet;
use std::ops::Range;

/// The keyword of radiation tables.
pub(crate) const RADIATION: &str = "GAP RADIATION";

/// The tables whose rows were read as they were meant.
pub(crate) fn sound_tables<'a, 'deck>(context: &'a Context<'deck>) -> impl Iterator<Item = &'a TableOf<'deck>> {
    let misread = misread(context);
    context.tables.iter().filter(move |of| of.table.width() > 1 && !misread.contains(&of.table.keyword))
}

/// The keyword lines whose rows hold something else than their columns say.
fn misread(context: &Context<'_>) -> HashSet<Span> {
    let of_rows = context
        .problems
        .iter()
        .filter(|problem| matches!(problem.kind, ProblemKind::TooManyItems { .. } | ProblemKind::IncompleteRow { .. }));
    let of_lines = context.defined_blocks().filter(|block| {
        let is_table = matches!(block.definition.rows(), RowShape::Table | RowShape::HeadedTable);
        is_table && columns_are_unclear(context, *block)
    });
    of_rows.map(|problem| problem.keyword).chain(of_lines.map(|block| block.keyword.span)).collect()
}

/// Whether the keyword line has a parameter that nobody can tell, or leaves open how many columns there are.
pub(crate) fn columns_are_unclear(context: &Context<'_>, block: DefinedBlock<'_>) -> bool {
    if block.definition.parameters_complete && has_unclear_parameters(block.keyword) {
        return true;
    }
    let mut counts = given(block).filter(|given| given.definition.name == "DEPENDENCIES");
    let Some(count) = counts.next() else { return false };
    let number = count.value().and_then(|value| read_integer(context.value(value).as_bytes()).ok());
    let fits = |number: i64| usize::try_from(number).is_ok_and(|number| number <= MOST_FIELD_VARIABLES);
    counts.next().is_some() || !number.is_some_and(fits)
}

/// Whether a parameter of the line is unknown or ambiguous: K004 and K005 say so.
pub(crate) fn has_unclear_parameters(keyword: &KeywordLine) -> bool {
    keyword.parameters.iter().any(|parameter| parameter.index().is_none())
}

/// Whether the first independent variable is the clearance.
pub(crate) fn is_against_clearance(of: &TableOf<'_>) -> bool {
    of.kind.is_against_clearance() || of.keyword == RADIATION
}

/// Whether a group may start at that clearance or pressure (T-24, Q-11).
pub(crate) fn starts_as_it_must(of: &TableOf<'_>, abscissa: f64) -> bool {
    if is_against_clearance(of) {
        abscissa == 0.0
    } else {
        !of.kind.is_conductance_against_pressure() || abscissa <= 0.0
    }
}

/// Whether something is written in a cell; an empty one reads as 0.
pub(crate) fn is_written(context: &Context<'_>, of: &TableOf<'_>, row: usize, column: usize) -> bool {
    let cell = context.cell(of, row, column);
    // The row itself stands for a cell that is not there; but a row of one item is its first cell.
    !cell.is_empty() && (column == 0 || cell != of.table.row_span(row))
}

/// Finds the falls of a table in the first variable of a group, or in an outer one: the first of them and how many there are.
///
/// A table that is out of order in many places has one finding.
pub(crate) fn falls(table: &Table, is_meant: impl Fn(usize) -> bool) -> Option<Falls> {
    let mut falls = None;
    for (before, row, ordering, column) in steps(table) {
        if ordering.is_lt() && is_meant(column) {
            falls.get_or_insert(Falls { before, row, column, count: 0 }).count += 1;
        }
    }
    falls
}

/// Where a table falls that should rise.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Falls {
    /// The row before the first fall.
    pub(crate) before: usize,
    /// The row in which the value is lower.
    pub(crate) row: usize,
    /// The column of the value.
    pub(crate) column: usize,
    /// How many rows fall.
    pub(crate) count: usize,
}

/// The edits that put the rows of a table in order, each row whole; comments between rows stay in their places.
///
/// `None` where sorting does not mend the table: a value is not known, or rows agree in all independent variables.
pub(crate) fn sort_edits(context: &Context<'_>, table: &Table) -> Option<Vec<Edit>> {
    let order = sorted_order(table)?;
    let repeats = order.windows(2).any(|pair| step(table.row(pair[0]), table.row(pair[1])).0.is_eq());
    let source = table.keyword.source;
    if repeats || table.rows.len() != order.len() || table.rows.iter().any(|row| row.source != source) {
        return None;
    }
    let moved = order.iter().enumerate().filter(|(place, row)| place != *row);
    Some(moved.map(|(place, row)| Edit::new(table.rows[place], context.deck.text(table.rows[*row]))).collect())
}

/// How a row stands to the one before: by the slowest independent variable in which they differ (T-02, T-09).
///
/// `Equal` is always that of column 1.
pub(crate) fn step(before: &[f64], row: &[f64]) -> (Ordering, usize) {
    for column in (1..row.len()).rev() {
        match row[column].partial_cmp(&before[column]) {
            Some(Ordering::Equal) | None => {}
            Some(ordering) => return (ordering, column),
        }
    }
    (Ordering::Equal, 1)
}

/// The steps from row to row, rows left out that lack an independent variable: the first row, the second, and how they stand.
///
/// What is left of an ascending table by leaving rows out ascends as well.
pub(crate) fn steps(table: &Table) -> impl Iterator<Item = (usize, usize, Ordering, usize)> {
    let mut before = None;
    table.row_values().enumerate().filter_map(move |(index, row)| {
        if row[1..].iter().any(|value| value.is_nan()) {
            return None;
        }
        let (earlier, values) = before.replace((index, row))?;
        let (ordering, column) = step(values, row);
        Some((earlier, index, ordering, column))
    })
}

/// The order that sorts the rows: by the slowest variable first, rows that are equal in all as they stand.
///
/// `None` when a row lacks an independent variable.
pub(crate) fn sorted_order(table: &Table) -> Option<Vec<usize>> {
    if table.row_values().any(|row| row[1..].iter().any(|value| value.is_nan())) {
        return None;
    }
    Some(order(table))
}

fn order(table: &Table) -> Vec<usize> {
    let mut order: Vec<usize> = (0..table.row_count()).collect();
    // A NaN stands in the first variable only, behind the numbers of its group.
    let columns = || (1..table.width()).rev();
    let compare = |a: &[f64], b: &[f64]| {
        let differences = columns().map(|column| a[column].partial_cmp(&b[column]));
        let by_numbers = differences.flatten().find(|ordering| ordering.is_ne()).unwrap_or(Ordering::Equal);
        by_numbers.then(a[1].is_nan().cmp(&b[1].is_nan()))
    };
    order.sort_by(|a, b| compare(table.row(*a), table.row(*b)));
    order
}

/// The rows of a table in ascending order, whatever order they stand in.
///
/// Rules on groups look at it, so that a table out of order has one finding, on its order.
#[derive(Debug)]
pub(crate) struct Arranged<'a> {
    table: &'a Table,
    /// `None` when the rows stand in order.
    order: Option<Vec<usize>>,
}

/// Rows that agree in all independent variables but the first, as places in the ascending order.
#[derive(Debug, Clone)]
pub(crate) struct Group {
    /// The places.
    pub(crate) places: Range<usize>,
    /// Whether the first variable is known in all of them.
    pub(crate) is_complete: bool,
    /// Whether it is known in the row with which the group starts: no row without it stands before that.
    pub(crate) starts_known: bool,
}

impl<'a> Arranged<'a> {
    /// Arranges the rows; `None` when a row could belong to any group, because an outer variable of it is not known.
    pub(crate) fn new(table: &'a Table) -> Option<Self> {
        knows_outer_variables(table).then(|| Self { table, order: (!stands_in_order(table)).then(|| order(table)) })
    }

    /// Arranges the rows of a table that stands in order.
    ///
    /// What a table out of order means is not known before it is put in order: T001 and T003 come first.
    pub(crate) fn in_order(table: &'a Table) -> Option<Self> {
        (knows_outer_variables(table) && stands_in_order(table)).then_some(Self { table, order: None })
    }

    /// The groups, in ascending order.
    pub(crate) fn groups(&self) -> impl Iterator<Item = Group> {
        let count = self.table.row_count();
        let mut start = 0;
        std::iter::from_fn(move || {
            if start == count {
                return None;
            }
            let first = start;
            let mut is_complete = true;
            let mut starts_known = !self.row(first)[1].is_nan();
            while start < count && self.row(start)[2..] == self.row(first)[2..] {
                if self.row(start)[1].is_nan() {
                    is_complete = false;
                    starts_known &= self.index(first) < self.index(start);
                }
                start += 1;
            }
            Some(Group { places: first..start, is_complete, starts_known })
        })
    }

    /// The groups in which every row has its first variable.
    pub(crate) fn complete_groups(&self) -> impl Iterator<Item = Range<usize>> {
        self.groups().filter(|group| group.is_complete).map(|group| group.places)
    }

    /// Whether both tables have the same outer variables.
    pub(crate) fn has_outer_columns_of(&self, other: &Self) -> bool {
        self.table.columns[2..] == other.table.columns[2..]
    }

    /// The places where the groups start whose first row has its first variable.
    pub(crate) fn starts(&self) -> impl Iterator<Item = usize> {
        self.groups().filter(|group| group.starts_known).map(|group| group.places.start)
    }

    /// The numbers of the row at a place.
    pub(crate) fn row(&self, place: usize) -> &'a [f64] {
        self.table.row(self.index(place))
    }

    /// Which row of the table stands at a place.
    pub(crate) fn index(&self, place: usize) -> usize {
        self.order.as_ref().map_or(place, |order| order[place])
    }
}

fn knows_outer_variables(table: &Table) -> bool {
    !table.row_values().any(|row| row[2..].iter().any(|value| value.is_nan()))
}

/// Whether no row falls below the one before; equal rows are no fall.
fn stands_in_order(table: &Table) -> bool {
    let mut rows = table.row_values();
    rows.next().is_none_or(|first| {
        let mut before = first;
        rows.all(|row| step(std::mem::replace(&mut before, row), row).0.is_ge())
    })
}

/// The tables of the model, and those of radiation.
pub(crate) fn all_tables<'a>(model: &'a Model, radiation: &'a [Table]) -> Vec<TableOf<'a>> {
    let mut tables = model.tables();
    let of = |table| TableOf { kind: TableKind::Other, keyword: RADIATION, interaction: None, table };
    tables.extend(radiation.iter().map(of));
    tables
}

/// The view factors of every *GAP RADIATION against clearance, read here because the model keeps its rows as text (2.6).
pub(crate) fn radiation_tables(deck: &Deck, grammar: &Grammar, model: &Model) -> Vec<Table> {
    let blocks = deck.blocks().iter().filter_map(|block| {
        let keyword = block.keyword.as_ref()?;
        let entry = grammar.keyword(keyword.id()?);
        (entry.name == RADIATION).then_some((block, keyword, entry.definition()?))
    });
    let tables = blocks.map(|(block, keyword, definition)| {
        let columns: Vec<String> = definition.data.columns.iter().map(|column| column.name.clone()).collect();
        let mut table = Table { keyword: keyword.span, ..Table::default() };
        // The first line holds the emissivities.
        for line in deck.data_lines(block).filter(|line| !line.is_blank()).skip(1) {
            let mut items = line.items();
            table.rows.push(trimmed(deck, line.span));
            table.values.extend(
                columns.iter().map(|_| items.next().map_or(0.0, |item| number_in(deck, &model.parameters, item))),
            );
        }
        table.columns = columns;
        table
    });
    tables.filter(|table| table.row_count() > 0).collect()
}

/// The number in an item, a `<parameter>` replaced by its value: 0 where nothing stands (S-32), NaN where it is no number.
pub(crate) fn number_in(deck: &Deck, parameters: &Parameters, item: Span) -> f64 {
    if item.is_empty() {
        return 0.0;
    }
    let text = deck.shown(item);
    substitute(&text, parameters).ok().and_then(|text| read_float(text.trim().as_bytes()).ok()).unwrap_or(f64::NAN)
}

/// The span without blanks and line ends around it.
pub(crate) fn trimmed(deck: &Deck, span: Span) -> Span {
    let text = deck.text(span);
    let start = span.start + (text.len() - text.trim_ascii_start().len()) as u64;
    Span::new(span.source, start, start + text.trim_ascii().len() as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(rows: &[[f64; 3]]) -> Table {
        let columns = ["conductance", "clearance", "temp"].map(str::to_owned).to_vec();
        Table { columns, values: rows.concat(), ..Table::default() }
    }

    fn groups(table: &Table) -> Vec<Vec<usize>> {
        let arranged = Arranged::new(table).expect("the outer variables are known");
        arranged.complete_groups().map(|places| places.map(|place| arranged.index(place)).collect()).collect()
    }

    #[test]
    fn a_step_is_judged_by_the_slowest_variable_that_differs() {
        assert_eq!(step(&[1.0, 0.5, 300.0], &[1.0, 0.0, 400.0]), (Ordering::Greater, 2));
        assert_eq!(step(&[1.0, 0.0, 400.0], &[1.0, 0.5, 300.0]), (Ordering::Less, 2));
        assert_eq!(step(&[1.0, 0.5, 300.0], &[1.0, 0.0, 300.0]), (Ordering::Less, 1));
        assert_eq!(step(&[1.0, 0.5, 300.0], &[2.0, 0.5, 300.0]), (Ordering::Equal, 1));
        // A middle variable restarts when a slower one grows (T-09).
        assert_eq!(step(&[1.0, 0.5, 400.0, 1.0], &[1.0, 0.0, 300.0, 2.0]), (Ordering::Greater, 3));
    }

    #[test]
    fn rows_are_grouped_in_whatever_order_they_stand() {
        let ordered = table(&[[3.0, 0.0, 300.0], [2.0, 1.0, 300.0], [4.0, 0.0, 400.0]]);
        assert_eq!(groups(&ordered), [vec![0, 1], vec![2]]);
        let scrambled = table(&[[4.0, 0.0, 400.0], [2.0, 1.0, 300.0], [3.0, 0.0, 300.0]]);
        assert_eq!(groups(&scrambled), [vec![2, 1], vec![0]]);
        assert_eq!(sorted_order(&scrambled), Some(vec![2, 1, 0]));
    }

    #[test]
    fn rows_without_a_number_take_no_part() {
        let unknown_clearance = table(&[[3.0, 0.0, 300.0], [2.0, f64::NAN, 300.0], [4.0, 0.0, 400.0]]);
        assert_eq!(groups(&unknown_clearance), [vec![2]]);
        assert_eq!(Arranged::new(&unknown_clearance).map(|arranged| arranged.starts().collect()), Some(vec![0, 2]));
        let unknown_start = table(&[[3.0, f64::NAN, 300.0], [2.0, 1.0, 300.0], [4.0, 0.0, 400.0]]);
        assert_eq!(Arranged::new(&unknown_start).map(|arranged| arranged.starts().collect()), Some(vec![2]));
        assert_eq!(steps(&unknown_clearance).collect::<Vec<_>>(), [(0, 2, Ordering::Greater, 2)]);
        assert_eq!(sorted_order(&unknown_clearance), None);
        let unknown_temperature = table(&[[3.0, 0.0, 300.0], [2.0, 1.0, f64::NAN]]);
        assert!(Arranged::new(&unknown_temperature).is_none());
    }
}
