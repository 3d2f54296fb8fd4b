//! Decodes rows of text into columns; only the requested cells are parsed.
//!
//! Pieces of a table are independent, so that they can be decoded in parallel; rows and lines are counted from the beginning of the piece.

use super::batch::Batch;
use super::lines::{Cells, Piece, end_of_row, is_blank};
use super::number::number;
use inpact_parser::number::read_plain;
use memchr::memchr;

/// The mapping of cells of a row to columns.
#[derive(Debug, Clone, Default)]
pub(super) struct Layout {
    /// The separator of cells.
    pub(super) separator: u8,
    /// The number of cells of a row.
    pub(super) cells: usize,
    /// The maximum number of rows of a batch.
    pub(super) rows_of_a_batch: usize,
    labels: usize,
    numbers: usize,
    /// In the order of the cells.
    steps: Vec<Step>,
    /// Columns of labels and numbers that the table does not have.
    absent: Vec<Target>,
}

#[derive(Debug, Clone, Copy)]
struct Step {
    field: usize,
    target: Target,
}

#[derive(Debug, Clone, Copy)]
enum Target {
    Label(usize),
    Number(usize),
}

/// Results of a piece of text.
#[derive(Debug, Default)]
pub(super) struct Decoded {
    /// The rows; batches beyond [`Decoded::used`] are left over for reuse.
    pub(super) batches: Vec<Batch>,
    pub(super) used: usize,
    pub(super) problems: Vec<Problem>,
    pub(super) rows: u64,
    pub(super) lines: u64,
}

/// The part of a cell's text that a message shows.
const MAX_SHOWN: usize = 200;

/// Faults of a row or a cell.
#[derive(Debug)]
pub(super) struct Problem {
    /// Counted from 1.
    pub(super) row: u64,
    /// Counted from 1.
    pub(super) line: u64,
    pub(super) kind: ProblemKind,
}

#[derive(Debug)]
pub(super) enum ProblemKind {
    /// The row has this number of cells.
    Count(usize),
    /// The cell is not a number.
    Cell { field: usize, text: Vec<u8> },
    /// A quote in it is not closed.
    OpenQuote,
}

impl Layout {
    /// The layout that reads these cells of a row; `usize::MAX` is a cell that the table does not have.
    pub(super) fn new(
        separator: u8,
        cells: usize,
        rows_of_a_batch: usize,
        labels: &[usize],
        numbers: &[usize],
    ) -> Self {
        let labels_to = labels.iter().enumerate().map(|(to, field)| Step { field: *field, target: Target::Label(to) });
        let numbers_to =
            numbers.iter().enumerate().map(|(to, field)| Step { field: *field, target: Target::Number(to) });
        let (mut steps, absent): (Vec<Step>, Vec<Step>) =
            labels_to.chain(numbers_to).partition(|step| step.field < cells);
        steps.sort_by_key(|step| step.field);
        let absent = absent.into_iter().map(|step| step.target).collect();
        Self { separator, cells, rows_of_a_batch, labels: labels.len(), numbers: numbers.len(), steps, absent }
    }

    /// Decodes a piece, whose text ends at the end of a row or of the table.
    pub(super) fn decode(&self, piece: &Piece, decoded: &mut Decoded) {
        decoded.used = 0;
        decoded.problems.clear();
        (decoded.rows, decoded.lines) = (0, 0);
        let mut cells = Cells::default();
        let mut rest = piece.text.as_slice();
        while !rest.is_empty() {
            if decoded.used == decoded.batches.len() {
                decoded.batches.push(Batch::default());
            }
            decoded.used += 1;
            let batch = &mut decoded.batches[decoded.used - 1];
            batch.clear(self.labels, self.numbers);
            // The length of the first row estimates their number.
            let first = memchr(b'\n', rest).map_or(rest.len(), |end| end + 1);
            batch.reserve((rest.len() / first + 1).min(self.rows_of_a_batch));
            batch.first_row = decoded.rows;
            while batch.rows < self.rows_of_a_batch && !rest.is_empty() {
                let (row, after) = self.split(rest, piece.has_quotes);
                rest = after;
                let line_ends = if piece.has_quotes { memchr::memchr_iter(b'\n', row).count() as u64 } else { 0 };
                decoded.lines += 1 + line_ends;
                if is_blank(row, self.separator) {
                    continue;
                }
                batch.rows += 1;
                decoded.rows += 1;
                batch.lines.push(decoded.lines);
                let mut problems = Problems { row: decoded.rows, line: decoded.lines, list: &mut decoded.problems };
                let found = if piece.has_quotes && memchr(b'"', row).is_some() {
                    self.take_quoted(row, &mut cells, batch, &mut problems)
                } else {
                    self.take_plain(row, batch, &mut problems)
                };
                if found != self.cells {
                    problems.add(ProblemKind::Count(found));
                }
            }
            for target in &self.absent {
                match target {
                    Target::Label(to) => (0..batch.rows).for_each(|_| batch.labels[*to].push(b"")),
                    Target::Number(to) => batch.numbers[*to].reset(batch.rows),
                }
            }
            if batch.rows == 0 {
                decoded.used -= 1;
            }
        }
    }

    /// The first row of a text without its line end, and what comes after it.
    #[inline]
    fn split<'t>(&self, text: &'t [u8], has_quotes: bool) -> (&'t [u8], &'t [u8]) {
        let end = if has_quotes { end_of_row(text, self.separator).map(|end| end - 1) } else { memchr(b'\n', text) };
        let (row, after) = end.map_or((text, &[][..]), |end| (&text[..end], &text[end + 1..]));
        (row.strip_suffix(b"\r").unwrap_or(row), after)
    }

    /// Adds a row without quotes; returns its number of cells.
    #[inline]
    fn take_plain(&self, row: &[u8], batch: &mut Batch, problems: &mut Problems<'_>) -> usize {
        let separator = self.separator;
        // The start of cell number `field`, and its end if known.
        let (mut field, mut start) = (0, 0);
        let mut end = None;
        let end_of = |start: usize| {
            let length = row[start..].iter().position(|byte| *byte == separator);
            length.map_or(row.len(), |length| start + length)
        };
        for (index, step) in self.steps.iter().enumerate() {
            while field < step.field {
                let end = end.take().unwrap_or_else(|| end_of(start));
                if end == row.len() {
                    self.leave_empty(index, batch);
                    return field + 1;
                }
                start = end + 1;
                field += 1;
            }
            match step.target {
                Target::Label(to) => {
                    let end = *end.get_or_insert_with(|| end_of(start));
                    batch.labels[to].push(&row[start..end]);
                }
                Target::Number(to) => {
                    let text = &row[start..];
                    if let Some((value, length)) = read_plain(text)
                        && text.get(length).is_none_or(|byte| *byte == separator)
                    {
                        end = Some(start + length);
                        batch.numbers[to].push(Some(value));
                        continue;
                    }
                    let end = *end.get_or_insert_with(|| end_of(start));
                    push_number(&row[start..end], field, to, batch, problems);
                }
            }
        }
        let end = end.unwrap_or_else(|| end_of(start));
        field + 1 + memchr::memchr_iter(separator, &row[end..]).count()
    }

    /// Adds a row with quotes; returns its number of cells.
    #[cold]
    fn take_quoted(&self, row: &[u8], cells: &mut Cells, batch: &mut Batch, problems: &mut Problems<'_>) -> usize {
        if !cells.cut(row, self.separator) {
            problems.add(ProblemKind::OpenQuote);
        }
        for step in &self.steps {
            let cell = cells.get(step.field).unwrap_or_default();
            match step.target {
                Target::Label(to) => batch.labels[to].push(cell),
                Target::Number(to) => push_number(cell, step.field, to, batch, problems),
            }
        }
        cells.len()
    }

    /// Adds the cells of a row that is too short for them.
    #[cold]
    fn leave_empty(&self, from: usize, batch: &mut Batch) {
        for step in &self.steps[from..] {
            match step.target {
                Target::Label(to) => batch.labels[to].push(b""),
                Target::Number(to) => batch.numbers[to].push(None),
            }
        }
    }
}

/// Adds a cell that is not a plain number.
fn push_number(cell: &[u8], field: usize, to: usize, batch: &mut Batch, problems: &mut Problems<'_>) {
    let value = number(cell);
    if value.is_none() && !cell.trim_ascii().is_empty() {
        let text = cell.trim_ascii();
        problems.add(ProblemKind::Cell { field, text: text[..text.len().min(MAX_SHOWN)].to_vec() });
    }
    batch.numbers[to].push(value);
}

/// The problems of a row.
struct Problems<'p> {
    row: u64,
    line: u64,
    list: &'p mut Vec<Problem>,
}

impl Problems<'_> {
    #[cold]
    fn add(&mut self, kind: ProblemKind) {
        self.list.push(Problem { row: self.row, line: self.line, kind });
    }
}
