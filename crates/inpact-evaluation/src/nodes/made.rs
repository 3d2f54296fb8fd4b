//! Node tables that are generated in memory instead of being read, for example from a mesh.

use super::batch::Batch;
use super::column::Column;
use super::header::Header;
use super::number::number;
use std::io;

/// Batches of a generated table: the texts of its key columns and its numbers, in the order of its header.
pub type MadeBatches<'a> = Box<dyn Iterator<Item = io::Result<Batch>> + Send + 'a>;

/// Returns a generated table as if it were read.
pub(super) struct MadeReader<'a> {
    header: Header,
    /// The number of text columns, which come first.
    texts: usize,
    batches: MadeBatches<'a>,
    /// The last generated batch, and the number of its rows already returned.
    current: Batch,
    done: usize,
    labels: Vec<usize>,
    numbers: Vec<usize>,
    most: usize,
}

impl<'a> MadeReader<'a> {
    pub(super) fn new(texts: &[Column], numbers: &[Column], batches: MadeBatches<'a>) -> Self {
        let names: Vec<String> = texts.iter().chain(numbers).map(ToString::to_string).collect();
        Self {
            header: Header::new(names.iter().map(String::as_str)),
            texts: texts.len(),
            batches,
            current: Batch::default(),
            done: 0,
            labels: Vec::new(),
            numbers: Vec::new(),
            most: 1,
        }
    }

    pub(super) fn header(&self) -> &Header {
        &self.header
    }

    pub(super) fn select(&mut self, labels: &[usize], numbers: &[usize], most: usize) {
        (self.labels, self.numbers, self.most) = (labels.to_vec(), numbers.to_vec(), most);
    }

    pub(super) fn read_batch(&mut self, batch: &mut Batch) -> io::Result<bool> {
        batch.clear(self.labels.len(), self.numbers.len());
        while self.done == self.current.rows {
            match self.batches.next() {
                None => return Ok(false),
                Some(made) => (self.current, self.done) = (made?, 0),
            }
        }
        let rows = self.done..self.current.rows.min(self.done + self.most);
        batch.first_row = self.current.first_row + self.done as u64;
        batch.rows = rows.len();
        for (to, from) in batch.labels.iter_mut().zip(&self.labels) {
            let column = self.current.labels.get(*from);
            for row in rows.clone() {
                to.push(column.map_or(&b""[..], |column| column.get(row)));
            }
        }
        for (to, from) in batch.numbers.iter_mut().zip(&self.numbers) {
            // A time is both a text that is passed through and a number.
            let text = self.current.labels.get(*from);
            let column = from.checked_sub(self.texts).and_then(|from| self.current.numbers.get(from));
            for row in rows.clone() {
                to.push(match (text, column) {
                    (Some(text), _) => number(text.get(row)),
                    (None, Some(column)) => column.get(row),
                    (None, None) => None,
                });
            }
        }
        self.done = rows.end;
        Ok(true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::nodes::{Findings, NodeReader, Selection};

    /// A batch of rows: node, time and clearance.
    fn made(first_row: u64, rows: &[(&str, &str, Option<f64>)]) -> Batch {
        let mut batch = Batch::with_columns(2, 1);
        (batch.rows, batch.first_row) = (rows.len(), first_row);
        for (node, time, clearance) in rows {
            batch.labels[0].push(node.as_bytes());
            batch.labels[1].push(time.as_bytes());
            batch.numbers[0].push(*clearance);
        }
        batch
    }

    #[test]
    fn batches_are_cut_to_size_and_a_time_is_text_and_number() {
        let rows = [("1", "0.5", Some(1.0)), ("2", "0.5", None), ("3", "0.5", Some(3.0))];
        let batches = [made(0, &rows), made(3, &[]), made(3, &[("1", "", Some(4.0))])];
        let keys = [Column::Node, Column::Time];
        let mut reader = NodeReader::of_made(&keys, &[Column::Clearance], Box::new(batches.into_iter().map(Ok)));
        let numbers = vec![Column::Clearance, Column::Time, Column::Pressure];
        reader.select(&Selection { labels: vec![Column::Time, Column::Node], numbers });
        reader.set_rows_of_a_batch(2);
        let (mut batch, mut findings) = (Batch::default(), Findings::new("mesh"));
        let mut found = Vec::new();
        while reader.read_batch(&mut batch, &mut findings).expect("made") {
            for row in 0..batch.rows {
                let text = |at: usize| String::from_utf8_lossy(batch.labels[at].get(row)).into_owned();
                let number = |at: usize| batch.numbers[at].get(row);
                found.push((batch.first_row + row as u64, text(1), text(0), [number(0), number(1), number(2)]));
            }
            assert!(batch.rows <= 2);
        }
        let row = |at, node: &str, time: &str, numbers| (at, node.to_owned(), time.to_owned(), numbers);
        let half = Some(0.5);
        assert_eq!(
            found,
            [
                row(0, "1", "0.5", [Some(1.0), half, None]),
                row(1, "2", "0.5", [None, half, None]),
                row(2, "3", "0.5", [Some(3.0), half, None]),
                row(3, "1", "", [Some(4.0), None, None]),
            ]
        );
    }
}
