//! The rows of a batch that one interaction governs, as columns of their own.

use crate::law::conductance::Branch;
use crate::law::contact::ContactState;
use crate::law::contact::columns::count_states;
use crate::law::thermal::mean_mass_flow;
use crate::nodes::{Batch, Place};
use crate::plan::{ContactPlaces, MassFlow, Source};
use std::borrow::Cow;

/// Rows of a batch under one interaction.
#[derive(Debug)]
pub(crate) struct Part<'a> {
    whole: &'a Batch,
    /// Its rows as a batch; `None` where it has all rows of the batch.
    gathered: Option<Batch>,
    /// Their numbers in the batch; `None` where it has all rows.
    pub(crate) numbers: Option<Vec<u32>>,
    /// The index of the interaction in the model.
    pub(crate) interaction: usize,
    /// Whether each row is closed; `None` where that is undetermined.
    pub(crate) states: Vec<Option<ContactState>>,
    /// The number of closed rows.
    pub(crate) closed: u64,
    /// The number of open rows.
    pub(crate) open: u64,
    contact: ContactPlaces,
    time: Option<usize>,
}

/// A row of a part.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Row<'p, 'a> {
    pub(crate) part: &'p Part<'a>,
    pub(crate) index: usize,
    /// The row of the results that it fills.
    pub(crate) to: usize,
    pub(crate) state: ContactState,
    pub(crate) clearance: Option<f64>,
    pub(crate) pressure: Option<f64>,
    /// The time, where the row is part of a history.
    pub(crate) time: Option<f64>,
}

impl<'a> Part<'a> {
    /// The rows with these numbers, all of the batch where there are none; `labels` are the columns of texts that laws read.
    pub(crate) fn new(
        whole: &'a Batch,
        numbers: Option<Vec<u32>>,
        labels: &[usize],
        (interaction, contact): (usize, ContactPlaces),
        time: Option<usize>,
    ) -> Self {
        let gathered = numbers.as_ref().map(|numbers| whole.gather(numbers, labels));
        let batch = gathered.as_ref().unwrap_or(whole);
        let mut states = vec![None; batch.rows];
        contact.states(batch, 0..batch.rows, &mut states);
        let [closed, open] = [ContactState::Closed, ContactState::Open].map(|state| count_states(&states, Some(state)));
        Self { whole, gathered, numbers, interaction, states, closed, open, contact, time }
    }

    /// Whether all rows are determined, with both closed and open ones.
    pub(crate) fn is_mixed(&self) -> bool {
        0 < self.closed && 0 < self.open && self.closed + self.open == self.states.len() as u64
    }

    /// Whether contact is determined in every row.
    pub(crate) fn tells_contact(&self) -> bool {
        self.closed + self.open == self.states.len() as u64 || self.states.iter().all(Option::is_some)
    }

    /// Its rows as a batch, without their lines.
    pub(crate) fn batch(&self) -> &Batch {
        self.gathered.as_ref().unwrap_or(self.whole)
    }

    /// The number of rows.
    pub(crate) fn rows(&self) -> usize {
        self.batch().rows
    }

    /// The position of a row in the table.
    pub(crate) fn place(&self, row: usize) -> Place {
        let row = self.numbers.as_ref().map_or(row, |numbers| numbers[row] as usize);
        self.whole.place(row, None)
    }

    /// The number of a row in column `place`.
    #[inline]
    pub(crate) fn number(&self, place: usize, row: usize) -> Option<f64> {
        self.batch().numbers[place].get(row)
    }

    /// A row whose contact is determined, with its results in row `to`.
    #[inline]
    pub(crate) fn row(&self, index: usize, to: usize) -> Option<Row<'_, 'a>> {
        let number = |place: Option<usize>| self.number(place?, index);
        Some(Row {
            part: self,
            index,
            to,
            state: self.states[index]?,
            clearance: number(self.contact.clearance),
            pressure: number(self.contact.pressure),
            time: number(self.time),
        })
    }

    /// The times, where every row has one.
    pub(crate) fn times(&self) -> Option<&[f64]> {
        let column = &self.batch().numbers[self.time?];
        column.presence().is_none().then(|| column.values())
    }

    /// The clearances, NaN where one is missing.
    pub(crate) fn clearances(&self) -> Cow<'_, [f64]> {
        self.column(self.contact.clearance)
    }

    /// The contact pressures, NaN where one is missing.
    pub(crate) fn pressures(&self) -> Cow<'_, [f64]> {
        self.column(self.contact.pressure)
    }

    fn column(&self, place: Option<usize>) -> Cow<'_, [f64]> {
        match place {
            Some(place) => Cow::Borrowed(self.batch().numbers[place].values()),
            None => Cow::Owned(vec![f64::NAN; self.rows()]),
        }
    }

    /// Whether every row has the first coordinate of its branch's table.
    pub(crate) fn has_all_abscissae(&self, branch: Branch) -> bool {
        let place = if branch == Branch::Pressure { self.contact.pressure } else { self.contact.clearance };
        place.is_some_and(|place| self.batch().numbers[place].presence().is_none())
    }

    /// Whether a row has the first coordinate of a branch's table: closed rows need no clearance.
    #[inline]
    pub(crate) fn has_abscissa(&self, branch: Branch, state: ContactState, row: usize) -> bool {
        let has = |place: Option<usize>| place.is_some_and(|place| self.number(place, row).is_some());
        match (branch, state) {
            (Branch::Pressure, _) => has(self.contact.pressure),
            (_, ContactState::Open) => has(self.contact.clearance),
            _ => true,
        }
    }
}

impl Row<'_, '_> {
    /// The number in column `place`.
    #[inline]
    pub(crate) fn number(&self, place: usize) -> Option<f64> {
        self.part.number(place, self.index)
    }

    /// The number of a source; `combine` combines slave and master.
    #[inline]
    pub(crate) fn fetch(&self, source: &Source<usize>, combine: impl Fn(f64, f64) -> f64) -> Option<f64> {
        let sides = |slave, master| Some(combine(self.number(slave)?, self.number(master)?));
        match *source {
            Source::Cell(cell) => self.number(cell),
            Source::Sides(slave, master) => sides(slave, master),
            Source::CellOrSides(cell, slave, master) => self.number(cell).or_else(|| sides(slave, master)),
        }
    }
}

/// The mean of the magnitudes of mass flow rates: as given, or from the sides that have a number (K-32).
pub(crate) fn mean_mass_flow_of(source: MassFlow<usize>, part: &Part<'_>, row: usize) -> Option<f64> {
    let number = |place: Option<usize>| part.number(place?, row);
    if let Some(mean) = number(source.mean) {
        return Some(mean.abs());
    }
    let (slave, master) = (number(source.slave), number(source.master));
    (slave.is_some() || master.is_some()).then(|| mean_mass_flow(slave, master))
}
