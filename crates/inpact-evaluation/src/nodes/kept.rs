//! Rows kept so that the table is read once: in memory up to a limit, beyond it spilled to a file that the caller gives.

use super::batch::Batch;
use super::reader::Selection;
use super::spill;
use std::collections::VecDeque;
use std::fmt;
use std::io::{self, BufReader, BufWriter, Read, Seek, SeekFrom, Write};

/// Storage for rows that are spilled from memory.
pub trait SpillFile: Read + Write + Seek + Send {}

impl<T: Read + Write + Seek + Send> SpillFile for T {}

/// Makes the file for spilled rows.
pub type MakeSpillFile = Box<dyn FnMut() -> io::Result<Box<dyn SpillFile>> + Send>;

/// The buffer size of file reads and writes.
const BUFFER: usize = 1 << 20;

/// Rows of a node table in order, to be read again from the first.
pub struct KeptRows {
    /// The number of bytes of rows kept in memory.
    room: usize,
    used: usize,
    batches: VecDeque<Batch>,
    /// The rows after them, and their number of batches.
    spilled: Option<BufWriter<Box<dyn SpillFile>>>,
    spilled_batches: u64,
    make_file: MakeSpillFile,
    selection: Selection,
}

impl fmt::Debug for KeptRows {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("KeptRows")
            .field("used", &self.used)
            .field("batches", &self.batches.len())
            .field("spilled_batches", &self.spilled_batches)
            .finish_non_exhaustive()
    }
}

impl KeptRows {
    /// No rows yet; up to `room` bytes stay in memory, the rest goes to a file.
    pub fn new(room: usize, make_file: MakeSpillFile) -> Self {
        Self {
            room,
            used: 0,
            batches: VecDeque::new(),
            spilled: None,
            spilled_batches: 0,
            make_file,
            selection: Selection::default(),
        }
    }

    /// Starts for batches with these columns.
    pub fn begin(&mut self, selection: &Selection) {
        selection.clone_into(&mut self.selection);
    }

    /// Keeps the next rows, which have the columns given at the start.
    ///
    /// # Errors
    /// Those of making and writing the file.
    pub fn push(&mut self, batch: Batch) -> io::Result<()> {
        let size = batch.size();
        if self.spilled.is_none() && self.used + size <= self.room {
            self.used += size;
            self.batches.push_back(batch);
            return Ok(());
        }
        let file = match &mut self.spilled {
            Some(file) => file,
            None => {
                let file = (self.make_file)().map_err(|error| not_kept(&error))?;
                self.spilled.insert(BufWriter::with_capacity(BUFFER, file))
            }
        };
        self.spilled_batches += 1;
        spill::write(file, &batch).map_err(|error| not_kept(&error))
    }

    /// Iterates over the rows, which stay kept.
    ///
    /// # Errors
    /// Those of reading the file.
    pub(crate) fn for_each(&mut self, mut take: impl FnMut(&Batch)) -> io::Result<()> {
        self.batches.iter().for_each(&mut take);
        let Some(file) = &mut self.spilled else { return Ok(()) };
        file.flush()?;
        let file = file.get_mut();
        file.seek(SeekFrom::Start(0))?;
        let mut reader = BufReader::with_capacity(BUFFER, &mut *file);
        for _ in 0..self.spilled_batches {
            take(&spill::read(&mut reader)?);
        }
        file.seek(SeekFrom::End(0)).map(drop)
    }

    /// A copy of the rows, for a second reading; `make_file` is for those that do not fit into memory.
    ///
    /// # Errors
    /// Those of reading and writing the files.
    pub fn try_clone(&mut self, make_file: MakeSpillFile) -> io::Result<Self> {
        let mut copy = Self::new(self.room, make_file);
        copy.begin(&self.selection);
        let mut pushed = Ok(());
        self.for_each(|batch| {
            if pushed.is_ok() {
                pushed = copy.push(batch.clone());
            }
        })?;
        pushed.map(|()| copy)
    }

    /// Returns the rows batch by batch, with the columns that are selected now, and releases them.
    ///
    /// A column that was not kept gives missing numbers and empty texts.
    ///
    /// # Errors
    /// Those of writing the rest of the file.
    pub fn give_back(&mut self, selection: &Selection) -> io::Result<KeptRowsIter> {
        let file = match self.spilled.take().map(BufWriter::into_inner) {
            Some(Ok(mut file)) => {
                file.seek(SeekFrom::Start(0))?;
                Some(BufReader::with_capacity(BUFFER, file))
            }
            Some(Err(error)) => return Err(error.into_error()),
            None => None,
        };
        let place = |of: &[super::Column], column| of.iter().position(|kept| *kept == column);
        Ok(KeptRowsIter {
            batches: std::mem::take(&mut self.batches),
            file,
            left_in_file: std::mem::take(&mut self.spilled_batches),
            labels: selection.labels.iter().map(|column| place(&self.selection.labels, *column)).collect(),
            numbers: selection.numbers.iter().map(|column| place(&self.selection.numbers, *column)).collect(),
        })
    }
}

/// An error other than reading the table.
fn not_kept(error: &io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("a temporary file cannot hold its rows until they are evaluated: {error}"))
}

/// An iterator over kept rows.
pub struct KeptRowsIter {
    batches: VecDeque<Batch>,
    file: Option<BufReader<Box<dyn SpillFile>>>,
    left_in_file: u64,
    /// The indices of the requested columns among those kept.
    labels: Vec<Option<usize>>,
    numbers: Vec<Option<usize>>,
}

impl fmt::Debug for KeptRowsIter {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("KeptRowsIter").field("batches", &self.batches.len()).finish_non_exhaustive()
    }
}

impl KeptRowsIter {
    /// The next rows; `None` after the last.
    ///
    /// # Errors
    /// Those of reading the file.
    pub fn next_batch(&mut self) -> io::Result<Option<Batch>> {
        let batch = match (self.batches.pop_front(), &mut self.file) {
            (Some(batch), _) => batch,
            (None, Some(file)) if self.left_in_file > 0 => {
                self.left_in_file -= 1;
                spill::read(file)?
            }
            _ => return Ok(None),
        };
        Ok(Some(batch.with_selected(&self.labels, &self.numbers)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nodes::{Column, NodeReader};
    use inpact_diagnostics::Findings;
    use std::io::Cursor;

    /// The rows of a table as texts, kept with this limit and returned.
    fn kept(table: &str, room: usize, selection: &Selection) -> Vec<String> {
        let mut findings = Findings::new("n.csv");
        let mut reader = NodeReader::open(Box::new(table.as_bytes()), &mut findings).expect("a slice can be read");
        let first = Selection {
            labels: vec![Column::Node, Column::Time],
            numbers: vec![Column::Clearance, Column::Pressure, Column::Area],
        };
        reader.set_rows_of_a_batch(2);
        reader.select(&first);
        let mut kept = KeptRows::new(room, Box::new(|| Ok(Box::new(Cursor::new(Vec::new())))));
        kept.begin(&first);
        let mut batch = Batch::default();
        while reader.read_batch(&mut batch, &mut findings).expect("a slice can be read") {
            kept.push(std::mem::take(&mut batch)).expect("memory takes all");
        }
        let mut seen = 0;
        kept.for_each(|batch| seen += batch.rows).expect("it was written");
        assert_eq!(seen, table.lines().count() - 1);
        let mut given = kept.give_back(selection).expect("it was written");
        let mut lines = Vec::new();
        while let Some(batch) = given.next_batch().expect("it was written") {
            for row in 0..batch.rows {
                let labels: Vec<_> = batch.labels.iter().map(|label| String::from_utf8_lossy(label.get(row))).collect();
                let numbers: Vec<_> = batch.numbers.iter().map(|column| column.get(row)).collect();
                lines.push(format!("{} {:?} {labels:?} {numbers:?}", batch.first_row + row as u64, batch.lines[row]));
            }
        }
        lines
    }

    #[test]
    fn rows_come_back_from_memory_and_file_alike() {
        let table = "node,time,clearance,pressure\na,0,1.5,\nb,1,,2\n,2,-0,3\nd,x,0.1,\n\"e,f\",,1e300,5\n";
        let selection = Selection {
            labels: vec![Column::Time, Column::Node, Column::Interaction],
            numbers: vec![Column::Pressure, Column::Closed],
        };
        let all = kept(table, usize::MAX, &selection);
        assert_eq!(all.len(), 5);
        assert_eq!(all[1], r#"1 3 ["1", "b", ""] [Some(2.0), None]"#);
        for room in [0, 1, 150, 300] {
            assert_eq!(kept(table, room, &selection), all, "{room} bytes in memory");
        }
    }
}
