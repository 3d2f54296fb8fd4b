//! A node table of comma-separated values: pieces of text are read sequentially, decoded in parallel and returned in order.

use super::batch::Batch;
use super::decode::{Decoded, Layout, Problem, ProblemKind};
use super::header::Header;
use super::lines::{Cells, LONGEST_ROW, Piece, Pieces, end_of_row, is_blank};
use super::rules::{MALFORMED_CELL, MISSING_COLUMN};
use super::wait::{begin, wait_for};
use inpact_diagnostics::{Findings, Place};
use std::collections::VecDeque;
use std::io::{self, Read};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};

/// Reads a node table of comma-separated values.
pub(super) struct CsvReader<'a> {
    pieces: Pieces<'a>,
    header: Header,
    layout: Arc<Layout>,
    /// The number of pieces decoded ahead while others are evaluated.
    read_ahead: usize,
    /// Pieces in flight, in order.
    under_way: VecDeque<Receiver<Work>>,
    /// The current piece, and the number of batches taken from it.
    current: Work,
    taken: usize,
    spare: Vec<Work>,
    /// The lines and rows before the current piece.
    rows_before: u64,
    lines_before: u64,
    /// Whether the input is exhausted, and the error if that is the reason.
    is_read: bool,
    failure: Option<io::Error>,
}

/// A piece and its decoded rows; both keep their memory for reuse.
#[derive(Default)]
struct Work {
    piece: Piece,
    decoded: Decoded,
}

impl<'a> CsvReader<'a> {
    pub(super) fn open(input: Box<dyn Read + Send + 'a>, findings: &mut Findings) -> io::Result<Self> {
        let mut reader = Self {
            pieces: Pieces::open(input)?,
            header: Header::default(),
            layout: Arc::default(),
            read_ahead: 0,
            under_way: VecDeque::new(),
            current: Work::default(),
            taken: 0,
            spare: Vec::new(),
            rows_before: 0,
            lines_before: 0,
            is_read: false,
            failure: None,
        };
        reader.read_header(findings)?;
        Ok(reader)
    }

    pub(super) fn header(&self) -> &Header {
        &self.header
    }

    /// Selects the cells of the following batches.
    pub(super) fn select(&mut self, labels: &[usize], numbers: &[usize], rows_of_a_batch: usize) {
        let cells = self.header.cells.len();
        self.layout = Arc::new(Layout::new(self.pieces.separator(), cells, rows_of_a_batch, labels, numbers));
    }

    /// Decodes this many pieces ahead on other threads; 0 decodes each when it is needed.
    pub(super) fn set_read_ahead(&mut self, pieces: usize) {
        self.read_ahead = pieces;
    }

    /// Reads the next rows; false when there are no more.
    pub(super) fn read_batch(&mut self, batch: &mut Batch, findings: &mut Findings) -> io::Result<bool> {
        while self.taken == self.current.decoded.used {
            self.rows_before += self.current.decoded.rows;
            self.lines_before += self.current.decoded.lines;
            if !self.next_piece()? {
                self.current.decoded = Decoded::default();
                self.taken = 0;
                self.report_end(findings);
                return Ok(false);
            }
            self.taken = 0;
            for problem in std::mem::take(&mut self.current.decoded.problems) {
                self.report(&problem, findings);
            }
        }
        std::mem::swap(batch, &mut self.current.decoded.batches[self.taken]);
        self.taken += 1;
        batch.first_row += self.rows_before;
        let lines_before = self.lines_before;
        batch.lines.iter_mut().for_each(|line| *line += lines_before);
        Ok(true)
    }

    /// Reads pieces up to the one with the header, and removes that.
    fn read_header(&mut self, findings: &mut Findings) -> io::Result<()> {
        let mut piece = Piece::default();
        let separator = self.pieces.separator();
        while self.pieces.next(&mut piece)? {
            let mut at = 0;
            while at < piece.text.len() {
                let end = end_of_row(&piece.text[at..], separator).map_or(piece.text.len(), |length| at + length);
                let row = &piece.text[at..end];
                self.lines_before += memchr::memchr_iter(b'\n', row).count() as u64;
                let row = row.strip_suffix(b"\n").unwrap_or(row);
                let row = row.strip_suffix(b"\r").unwrap_or(row);
                at = end;
                if is_blank(row, separator) {
                    continue;
                }
                let mut cells = Cells::default();
                cells.cut(row, separator);
                let texts = (0..cells.len()).filter_map(|index| cells.get(index));
                let texts: Vec<String> = texts.map(|text| String::from_utf8_lossy(text).into_owned()).collect();
                self.header = Header::new(texts.iter().map(String::as_str)).at_line(self.lines_before.max(1));
                self.header.report_duplicates(findings);
                piece.text.drain(..at);
                self.select(&[], &[], usize::MAX);
                self.spare.push(Work { piece, decoded: Decoded::default() });
                return Ok(());
            }
        }
        self.is_read = true;
        let message = "the node table is empty: it has no header line";
        findings.report(&MISSING_COLUMN, Place::default(), message, "name the columns in the first line");
        Ok(())
    }

    /// Makes the next piece the current one; false when there are no more.
    fn next_piece(&mut self) -> io::Result<bool> {
        while self.under_way.len() <= self.read_ahead && !self.is_read {
            let mut work = self.spare.pop().unwrap_or_default();
            // The rest of the piece with the header is not decoded yet.
            let is_first = self.under_way.is_empty() && self.rows_before == 0 && !work.piece.text.is_empty();
            match if is_first { Ok(true) } else { self.pieces.next(&mut work.piece) } {
                Ok(true) if self.read_ahead == 0 => {
                    self.layout.decode(&work.piece, &mut work.decoded);
                    self.take_over(work);
                    return Ok(true);
                }
                Ok(true) => {
                    let layout = Arc::clone(&self.layout);
                    let (sender, receiver) = channel();
                    begin(move || {
                        layout.decode(&work.piece, &mut work.decoded);
                        // The receiver is gone when the reader was dropped.
                        let _ = sender.send(work);
                    });
                    self.under_way.push_back(receiver);
                }
                Ok(false) => self.is_read = true,
                Err(error) => {
                    self.is_read = true;
                    self.failure = Some(error);
                }
            }
        }
        match self.under_way.pop_front() {
            Some(receiver) => {
                let work = wait_for(&receiver)?;
                self.take_over(work);
                Ok(true)
            }
            None => self.failure.take().map_or(Ok(false), Err),
        }
    }

    fn take_over(&mut self, work: Work) {
        self.spare.push(std::mem::replace(&mut self.current, work));
    }

    fn report_end(&mut self, findings: &mut Findings) {
        if self.pieces.gave_up() {
            let row = self.rows_before + 1;
            let message = format!(
                "row {row} is longer than {LONGEST_ROW} bytes, the most that a row may have: a quote in it is not closed"
            );
            let place = Place { row: Some(row), ..Place::of_line(self.lines_before + 1) };
            findings.report(&MALFORMED_CELL, place, message, "close the quote, or write two quotes for one in a text");
        }
    }

    #[cold]
    fn report(&self, problem: &Problem, findings: &mut Findings) {
        let row = self.rows_before + problem.row;
        let place = |column| Place { row: Some(row), column, ..Place::of_line(self.lines_before + problem.line) };
        match &problem.kind {
            ProblemKind::Count(found) => {
                let message = format!("row {row} has {found} cells, the header {}", self.header.cells.len());
                let help = match self.pieces.separator() {
                    b';' => {
                        "write a semicolon for every cell that is empty, and quotes around a text that holds semicolons"
                    }
                    b'\t' => "write a tab for every cell that is empty, and quotes around a text that holds tabs",
                    _ => "write a comma for every cell that is empty, and quotes around a text that holds commas",
                };
                findings.report(&MALFORMED_CELL, place(None), message, help);
            }
            ProblemKind::Cell { field, text } => {
                let column = self.header.cells[*field].text.clone();
                let text = String::from_utf8_lossy(text);
                let shown: String = text.chars().take(40).collect();
                let message = format!("`{column}` of row {row} is `{shown}`, which is no number");
                let help = if text.contains(',') {
                    "write numbers with a decimal point, as in 1.5e-3"
                } else {
                    "write a number such as 1.5e-3, or leave the cell empty where there is none"
                };
                findings.report(&MALFORMED_CELL, place(Some(column)), message, help);
            }
            ProblemKind::OpenQuote => {
                let message = format!("a quote in row {row} is not closed");
                let help = "close the quote, or write two quotes for one in a text";
                findings.report(&MALFORMED_CELL, place(None), message, help);
            }
        }
    }
}
