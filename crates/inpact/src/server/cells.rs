//! Items of rows: each with its column, as the grammar lays them out (K-50 to K-56).

use super::analysis::Analysis;
use super::blocks::{Entry, substituted};
use inpact_parser::deck::DataLine;
use inpact_parser::grammar::{Column, Counted, Definition, RowShape};
use inpact_parser::model::{MAX_FIELD_VARIABLES, Table};
use inpact_parser::number::read_integer;
use inpact_parser::span::Span;

/// A row: its cells, on one or more lines.
#[derive(Debug)]
pub(super) struct Row<'a> {
    pub(super) cells: Vec<Cell<'a>>,
}

/// An item of a row.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell<'a> {
    pub(super) span: Span,
    /// Its index among the columns, from 0.
    pub(super) index: usize,
    pub(super) column: ColumnOf<'a>,
}

#[derive(Debug, Clone, Copy)]
pub(super) enum ColumnOf<'a> {
    Named(&'a Column),
    /// One of the columns that a parameter counts, from 1.
    Counted(&'a Counted, usize),
}

impl ColumnOf<'_> {
    pub(super) fn name(self) -> String {
        match self {
            Self::Named(column) => column.name.clone(),
            Self::Counted(counted, number) => format!("{}{number}", counted.prefix),
        }
    }

    pub(super) fn description(&self) -> &str {
        match self {
            Self::Named(column) => &column.description,
            Self::Counted(counted, _) => &counted.description,
        }
    }

    /// The dimension of a number; that of field variables depends on the deck.
    pub(super) fn dimension(self) -> Option<String> {
        match self {
            Self::Named(column) => column.dimension.map(|dimension| dimension.to_string()),
            Self::Counted(..) => None,
        }
    }

    /// The meaning of an empty item.
    pub(super) fn default(self) -> Option<f64> {
        match self {
            Self::Named(column) => column.dimension.map(|_| column.default.unwrap_or(0.0)),
            Self::Counted(..) => Some(0.0),
        }
    }

    pub(super) fn source(&self) -> &str {
        match self {
            Self::Named(column) => &column.source,
            Self::Counted(counted, _) => &counted.source,
        }
    }
}

/// The columns of a row and their layout on lines.
struct Layout<'a> {
    columns: Vec<ColumnOf<'a>>,
    /// The number of items on the first line, and on every further one.
    first_line: usize,
    following: usize,
}

impl<'a> Layout<'a> {
    /// `None` where the rows are unknown, or ignored.
    fn of(analysis: &Analysis, entry: &Entry<'a>) -> Option<Self> {
        let definition: &'a Definition = entry.definition?;
        let data = &definition.data;
        let is_given = |name: &str| entry.is_given(name);
        if data.columns.is_empty() || data.ignored_with.iter().any(|name| is_given(name)) {
            return None;
        }
        let lead: Vec<&Column> = data.columns_for(is_given).collect();
        let number = |counted: &Counted| {
            let value = entry.parameter(&counted.count)?.value?;
            let text = substituted(analysis, &analysis.deck.shown(value));
            usize::try_from(read_integer(text.as_bytes()).ok()?).ok()
        };
        let counted = data.counted.as_ref().map(|counted| (counted, number(counted).unwrap_or(0)));
        let (first_line, following) = match counted {
            Some((counted, _)) => (lead.len() + counted.first_line, counted.following),
            None => (usize::MAX, usize::MAX),
        };
        let named = lead.into_iter().map(ColumnOf::Named);
        let numbers = counted.into_iter().flat_map(|(counted, count)| {
            (1..=count.min(MAX_FIELD_VARIABLES)).map(move |number| ColumnOf::Counted(counted, number))
        });
        Some(Self { columns: named.chain(numbers).collect(), first_line, following })
    }
}

/// The rows of a block, blank lines and comments skipped; none where the grammar does not describe them.
pub(super) fn rows<'a>(analysis: &'a Analysis, entry: &Entry<'a>) -> impl Iterator<Item = Row<'a>> {
    let layout = Layout::of(analysis, entry);
    let shape = entry.definition.map(Definition::rows);
    let head = entry.definition.map_or(&[][..], |definition| definition.data.head.as_slice());
    let mut lines = analysis.deck.data_lines(entry.block).filter(|line| !line.is_blank());
    let mut is_head = shape == Some(RowShape::HeadedTable);
    std::iter::from_fn(move || {
        let layout = layout.as_ref()?;
        let first = lines.next()?;
        if std::mem::take(&mut is_head) {
            let columns: Vec<ColumnOf<'a>> = head.iter().map(ColumnOf::Named).collect();
            return Some(Row { cells: on_line(&first, &columns, 0) });
        }
        let width = layout.columns.len();
        let mut cells = on_line(&first, &layout.columns, 0);
        // A row on one line that should span several (K-53) has all its items there.
        let mut taken = if cells.len() == width { width } else { layout.first_line.min(width) };
        cells.truncate(taken.max(1));
        if matches!(shape, Some(RowShape::Table | RowShape::HeadedTable | RowShape::Line)) {
            while taken < width {
                let Some(line) = lines.next() else { break };
                let mut further = on_line(&line, &layout.columns[taken..], taken);
                further.truncate(layout.following);
                cells.append(&mut further);
                taken = taken.saturating_add(layout.following);
            }
        }
        Some(Row { cells })
    })
}

/// The items of a line that have a column.
fn on_line<'a>(line: &DataLine<'_>, columns: &[ColumnOf<'a>], first: usize) -> Vec<Cell<'a>> {
    let items = line.items().zip(columns).enumerate();
    items.map(|(index, (span, column))| Cell { span, index: first + index, column: *column }).collect()
}

/// The table that a keyword line opens.
pub(super) fn table_of<'a>(analysis: &'a Analysis, entry: &Entry<'_>) -> Option<&'a Table> {
    let opens = |table: &Table| {
        table.keyword.source() == entry.keyword.span.source() && table.keyword.start() == entry.keyword.span.start()
    };
    analysis.model.tables().map(|of| of.table).find(|table| opens(table))
}
