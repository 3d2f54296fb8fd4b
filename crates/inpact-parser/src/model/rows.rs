//! Rows of numbers: from the lines of a block to a [`Table`] (S-30 to S-37, K-50 to K-56).
//!
//! Knows the layout of a row, not the meaning of its numbers. Reads every line, even after a faulty one.

use super::SubOption;
use super::row_places::RowPlaces;
use super::table::{CellText, Table};
use crate::deck::{Block, DataLine, Deck, MAX_CELLS, items, plain_row};
use crate::expression::{Parameters, SubstitutionError, substitute};
use crate::grammar::{Dialect, Layout};
use crate::number::{FLOAT_CHARACTERS, FortranNumber, read_float, read_fortran};
use crate::problem::{LongNumber, Problem, ProblemKind};
use crate::span::Span;
use std::ops::Range;

/// Up to this number of counted columns a table has them all, written or not.
const ALWAYS_THERE: usize = 32;

/// The number of the `count` counted columns that the rows of a block can reach; `lead` is the layout of those before them.
pub(super) fn most_written(
    deck: &Deck,
    block: &Block,
    count: usize,
    lead: impl FnOnce() -> Option<Layout>,
) -> Option<usize> {
    if count <= ALWAYS_THERE {
        return Some(count);
    }
    let layout = lead()?;
    let texts = block.all_rows().map(|rows| deck.text(rows));
    let (mut lines, mut commas) = (0, 0);
    for text in texts {
        lines += memchr::memchr2_iter(b'\n', b'\r', text.trim_ascii_end()).count() + 1;
        commas += memchr::memchr_iter(b',', text).count();
    }
    let on_lines = layout.first_line + lines.saturating_sub(1).saturating_mul(layout.following);
    Some(count.min(on_lines.max(commas + 1).saturating_sub(layout.columns.len())))
}

/// The table of a block of which only the ends of groups were kept; `None` where its layout needs more than numbers.
pub(super) fn table_of_ends(deck: &Deck, block: &Block, layout: Layout) -> Option<Table> {
    let ends = deck.ends_of(block)?;
    let is_whole = block.continued_in().is_empty() && layout.lines_per_row() == 1;
    let missing = layout.defaults.get(ends.width..).filter(|_| is_whole)?;
    let keyword = block.span_of_keyword();
    let rows = ends.values.chunks_exact(ends.width);
    Some(Table {
        values: rows.flat_map(|row| row.iter().chain(missing)).copied().collect(),
        places: RowPlaces::of(ends.places.iter().copied(), keyword),
        columns: layout.columns.into(),
        texts: Box::default(),
        keyword,
        unwritten: layout.unwritten,
    })
}

/// Reads the rows of a block.
pub(super) fn read_table(
    deck: &Deck,
    block: &Block,
    (layout, dialect): (Layout, Dialect),
    parameters: &Parameters,
    problems: &mut Vec<Problem>,
) -> Table {
    let keyword = block.span_of_keyword();
    let mut reader = RowReader {
        deck,
        keyword,
        dialect,
        layout: &layout,
        lines: layout.lines_per_row(),
        parameters,
        problems,
        values: Vec::new(),
        texts: Vec::new(),
        places: RowPlaces::default(),
    };
    reader.reserve(deck.text(block.rows()));
    let mut line_of_row = 0;
    for line in deck.data_lines(block) {
        if line.is_blank() {
            // CalculiX skips them (CX-01).
            if dialect == Dialect::Abaqus {
                reader.report(ProblemKind::BlankRow, line.span);
            }
            continue;
        }
        line_of_row = reader.take_line(&line, line_of_row);
    }
    reader.finish(line_of_row);
    let RowReader { values, texts, mut places, .. } = reader;
    places.shrink();
    Table {
        columns: layout.columns.into(),
        values: values.into(),
        places,
        texts: texts.into(),
        keyword,
        unwritten: layout.unwritten,
    }
}

/// A table under construction.
struct RowReader<'a> {
    deck: &'a Deck,
    keyword: Span,
    dialect: Dialect,
    layout: &'a Layout,
    lines: usize,
    parameters: &'a Parameters,
    problems: &'a mut Vec<Problem>,
    values: Vec<f64>,
    texts: Vec<CellText>,
    places: RowPlaces,
}

impl RowReader<'_> {
    /// Reserves memory for the rows that `text` may contain, so that a table does not grow step by step.
    fn reserve(&mut self, text: &[u8]) {
        let rows = memchr::memchr_iter(b'\n', text).count() / self.lines + 1;
        // No more than the text could contain: rows of empty items are added as they come.
        let most = text.len() / 2;
        self.places.reserve_exact(rows.min(most));
        let width = self.layout.columns.len();
        self.values.reserve_exact((rows * width).min(most.max(width)));
    }

    fn report(&mut self, kind: ProblemKind, span: Span) {
        self.problems.push(Problem { kind, span, keyword: self.keyword });
    }

    /// Adds line number `line_of_row` of a row; returns the number of the next line, 0 when the row is complete.
    fn take_line(&mut self, line: &DataLine<'_>, line_of_row: usize) -> usize {
        if self.lines == 1 && self.take_plain_row(line) {
            return 0;
        }
        let width = self.layout.columns.len();
        // K-53: too much for a first line, but exactly a whole row.
        let whole_row = self.lines > 1 && line_of_row == 0 && count_items(line) == self.layout.width();
        let room = if whole_row { width } else { items_on(self.layout, line_of_row) };
        let first_column = self.values.len() % width.max(1);
        let mut items = items(line.text);
        for column in first_column..first_column + room {
            match items.next() {
                Some(item) => self.take_item(line, item, column),
                None => self.values.push(self.layout.defaults[column]),
            }
        }
        let content = trimmed(line);
        if whole_row {
            let (first, following) = (self.layout.first_line, self.layout.following);
            self.report(ProblemKind::RowOnOneLine { lines: self.lines, first, following }, content);
        }
        let surplus = items.filter(|item| !item.is_empty()).map(|item| line.part(item)).reduce(Span::to);
        if let Some(surplus) = surplus {
            let given = count_items(line);
            self.report(ProblemKind::TooManyItems { allowed: room, given, lines: self.lines }, surplus);
        }
        match line_of_row {
            0 => self.places.push(content, self.keyword),
            // A row that begins in one file and ends in another is located where it begins.
            _ => self.places.extend_last(content, self.keyword),
        }
        if whole_row || line_of_row + 1 == self.lines { 0 } else { line_of_row + 1 }
    }

    /// Adds a row of numbers only, if it fits on a line.
    fn take_plain_row(&mut self, line: &DataLine<'_>) -> bool {
        let mut cells = [0.0; MAX_CELLS];
        let Some(row) = plain_row(line.text, 0, &mut cells) else { return false };
        let Some(missing) = self.layout.defaults.get(row.width..) else { return false };
        self.values.extend_from_slice(&cells[..row.width]);
        self.values.extend_from_slice(missing);
        self.places.push(line.part(row.content), self.keyword);
        true
    }

    fn take_item(&mut self, line: &DataLine<'_>, item: Range<usize>, column: usize) {
        let text = &line.text[item.clone()];
        // A plain number, as nearly every item is, needs no place.
        if text.len() <= FLOAT_CHARACTERS
            && let Ok(value) = read_float(text)
        {
            self.values.push(value);
            return;
        }
        let item = line.part(item);
        if text.is_empty() {
            if column == 0 && self.layout.columns.len() > 1 {
                self.report(ProblemKind::EmptyValue { column: self.layout.columns[column].clone() }, item);
            }
            self.values.push(self.layout.defaults[column]);
            return;
        }
        let is_symbolic = text.contains(&b'<');
        let value = if is_symbolic { self.symbolic_value(item, column) } else { self.value(text, item, column) };
        if is_symbolic || value.is_none() {
            let text = self.deck.shown(item);
            self.texts.push(CellText { cell: self.values.len(), text });
        }
        self.values.push(value.unwrap_or(f64::NAN));
    }

    /// The number of an item that names parameters (S-62).
    fn symbolic_value(&mut self, item: Span, column: usize) -> Option<f64> {
        let text = self.deck.shown(item);
        match substitute(&text, self.parameters) {
            Ok(text) => self.value(text.trim().as_bytes(), item, column),
            Err(error) => {
                self.problems.extend(substitution_problem(&error, self.parameters, item, self.keyword));
                None
            }
        }
    }

    fn value(&mut self, text: &[u8], item: Span, column: usize) -> Option<f64> {
        let (value, problem) = read_number(text, item, self.dialect, &self.layout.columns[column]);
        if let Some(kind) = problem {
            self.report(kind, item);
        }
        value
    }

    /// Completes a row that is unfinished at the end of the block (K-55).
    fn finish(&mut self, line_of_row: usize) {
        if line_of_row == 0 {
            return;
        }
        let row = self.places.iter(self.keyword).last().unwrap_or(self.keyword);
        self.report(ProblemKind::IncompleteRow { lines: self.lines, given: line_of_row }, row);
        let width = self.layout.columns.len();
        let missing = (width - self.values.len() % width) % width;
        self.values.extend_from_slice(&self.layout.defaults[width - missing..]);
    }
}

impl SubOption {
    /// Converts rows of texts to numbers: 0 for an empty item (S-32), a `<parameter>` by its value, NaN where there is no number.
    ///
    /// A row has as many numbers as it has items up to the last that is not empty.
    pub fn numbers(&self, parameters: &Parameters) -> Vec<Vec<f64>> {
        let number = |item: &str| {
            let text = substitute(item, parameters).ok()?;
            match text.trim() {
                "" => Some(0.0),
                text => read_float(text.as_bytes()).ok(),
            }
        };
        let numbers = |row: Vec<&str>| row.into_iter().map(|item| number(item).unwrap_or(f64::NAN)).collect();
        self.rows.iter().map(numbers).collect()
    }
}

/// The problem of a text whose parameters cannot be substituted; none for a parameter whose definition is reported already (S016).
pub(super) fn substitution_problem(
    error: &SubstitutionError,
    parameters: &Parameters,
    span: Span,
    keyword: Span,
) -> Option<Problem> {
    let kind = match error {
        SubstitutionError::Undefined(name) => {
            let similar = parameters.name_in_other_case(name).map(str::to_owned);
            ProblemKind::UndefinedParameter { name: name.clone(), similar }
        }
        SubstitutionError::WithoutValue(_) => return None,
        SubstitutionError::TooLong { bytes, most } => ProblemKind::SubstitutionTooLong { bytes: *bytes, most: *most },
    };
    Some(Problem { kind, span, keyword })
}

/// The number of an item of a column in a dialect, and its problem, if any.
pub(super) fn read_number(
    text: &[u8],
    item: Span,
    dialect: Dialect,
    column: &str,
) -> (Option<f64>, Option<ProblemKind>) {
    let malformed = |error| (None, Some(ProblemKind::MalformedNumber { error, column: column.to_owned() }));
    let characters = usize::try_from(item.len()).unwrap_or(usize::MAX);
    let long = |read| Some(ProblemKind::NumberTooLong { characters, read });
    if dialect == Dialect::Abaqus {
        return match read_float(text) {
            Ok(value) if FLOAT_CHARACTERS < characters && characters == text.len() => {
                (Some(value), long(LongNumber::Whole))
            }
            Ok(value) => (Some(value), None),
            Err(error) => malformed(error),
        };
    }
    match read_fortran(text) {
        Ok(FortranNumber::Whole(value)) => (Some(value), None),
        Ok(FortranNumber::Cut { value, whole: Some(whole) }) if differs_by_rounding(value, whole) => {
            (Some(value), long(LongNumber::SameValue))
        }
        Ok(FortranNumber::Cut { value, .. }) => (Some(value), long(LongNumber::OtherValue(value))),
        Ok(FortranNumber::CutToNothing) => (None, long(LongNumber::Nothing)),
        Err(error) => malformed(error),
    }
}

/// Whether digits that ccx does not read (CX-05) are insignificant: an f64 distinguishes 15 digits.
fn differs_by_rounding(cut: f64, whole: f64) -> bool {
    (cut - whole).abs() <= 1e-15 * whole.abs()
}

/// The number of items on line `line` of a row, counted from 0.
fn items_on(layout: &Layout, line: usize) -> usize {
    let before = if line == 0 { 0 } else { layout.first_line + (line - 1) * layout.following };
    let room = if line == 0 { layout.first_line } else { layout.following };
    room.min(layout.columns.len().saturating_sub(before))
}

/// The number of items of a line, except empty ones at its end (S-33).
fn count_items(line: &DataLine<'_>) -> usize {
    let given = line.items().enumerate().filter(|(_, item)| !item.is_empty());
    given.last().map_or(0, |(index, _)| index + 1)
}

/// The line without blanks around it.
fn trimmed(line: &DataLine<'_>) -> Span {
    let before = (line.text.len() - line.text.trim_ascii_start().len()) as u64;
    let start = line.span.start() + before;
    Span::new(line.span.source(), start, start + line.text.trim_ascii().len() as u64)
}
