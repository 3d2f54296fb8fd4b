//! Sums over the nodes of an interaction: total current, heat and fluid flow of the interface.
//!
//! *CONTACT PRINT, TOTALS=YES prints such sums for each increment (semantics O-1); here they are those of the latest time, or of all rows where there is no time.
//! Sums are compensated and taken in the order of the rows, so that they depend neither on threads nor on batches.

use crate::nodes::NumberColumn;
use crate::numbers::UnboundedSum;
use crate::results::{Output, ResultBatch};
use std::ops::Range;

/// The sums of an interaction over the rows of its latest time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Totals {
    /// The time of the rows; `None` where they have none.
    pub time: Option<f64>,
    /// The number of rows summed: those that have one of the outputs.
    pub rows: u64,
    sums: Vec<UnboundedSum>,
}

/// The outputs that are summed, those that are multiplied by the area of the node, with their indices in the results.
pub(crate) fn summed(outputs: impl Iterator<Item = Output>) -> Vec<(Output, usize)> {
    use Output::{Ecda, Hfla, Pfla, Sfdra, Sjda};
    let is_summed = |output: &Output| matches!(output, Ecda | Sjda | Hfla | Sfdra | Pfla);
    outputs.enumerate().map(|(place, output)| (output, place)).filter(|(output, _)| is_summed(output)).collect()
}

impl Totals {
    /// Adds the results of some rows, those of the latest time so far.
    pub(crate) fn take(
        &mut self,
        times: Option<&NumberColumn>,
        summed: &[(Output, usize)],
        results: &ResultBatch,
        rows: Range<usize>,
    ) {
        let is_full = |(_, place): &(Output, usize)| results.numbers[*place].presence().is_none();
        let times = match times {
            // Rows without a time count only where no row has one.
            Some(times) if times.presence().is_some() => {
                return rows.for_each(|row| self.take_row(times.get(row), summed, results, row));
            }
            Some(times) => Some(times.values()),
            None if self.time.is_some() => return,
            None => None,
        };
        if !summed.iter().all(is_full) {
            return rows.for_each(|row| self.take_row(times.map(|times| times[row]), summed, results, row));
        }
        let mut first = rows.start;
        while first < rows.end {
            let time = times.map(|times| times[first]);
            let others = times.and_then(|times| times[first..rows.end].iter().position(|other| Some(*other) != time));
            // NaN is another time than itself.
            let some = first..others.map_or(rows.end, |count| first + count.max(1));
            first = some.end;
            self.take_rows(time, summed, results, some);
        }
    }

    /// Adds the results of some rows of one time, without missing results.
    fn take_rows(&mut self, time: Option<f64>, summed: &[(Output, usize)], results: &ResultBatch, rows: Range<usize>) {
        if !self.is_of_latest(time) {
            return;
        }
        self.sums.resize_with(summed.len(), UnboundedSum::default);
        let columns = summed.iter().map(|(_, place)| &results.numbers[*place].values()[rows.clone()]);
        UnboundedSum::add_columns(&mut self.sums, &columns.collect::<Vec<_>>());
        self.rows += rows.len() as u64;
    }

    /// Whether rows of this time are summed: a later time restarts the sums.
    fn is_of_latest(&mut self, time: Option<f64>) -> bool {
        let is_later = match (time, self.time) {
            (Some(time), Some(latest)) => latest < time,
            (Some(_), None) => true,
            (None, _) => false,
        };
        if is_later {
            *self = Self { time, ..Self::default() };
        }
        is_later || time == self.time
    }

    fn take_row(&mut self, time: Option<f64>, summed: &[(Output, usize)], results: &ResultBatch, row: usize) {
        if !self.is_of_latest(time) {
            return;
        }
        self.sums.resize_with(summed.len(), UnboundedSum::default);
        let mut has_number = false;
        for (sum, (_, place)) in self.sums.iter_mut().zip(summed) {
            if let Some(value) = results.numbers[*place].get(row) {
                sum.add(value);
                has_number = true;
            }
        }
        self.rows += u64::from(has_number);
    }

    /// The sums, in the order of the outputs.
    pub fn values(&self) -> impl Iterator<Item = f64> {
        self.sums.iter().map(UnboundedSum::total)
    }
}
