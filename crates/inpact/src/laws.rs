//! The laws of one interaction on their own: a conductance at points and over columns, without a node table.

use crate::deck::Deck;
use crate::error::Error;
use crate::text::in_backticks;
use crate::threads::{threads_for, with_threads};
use inpact_evaluation::law::{Clearance, ConductanceTables, ContactPoint, ContactPressure, ContactState};
use inpact_evaluation::table::{AxisSummary, PiecewiseTable, TableKernel, Tail};
use inpact_parser::model::{ElectricalConductance, Interaction, Name, Table};
use rayon::prelude::*;
use std::ops::Range;

/// The gap electrical conductance of an interaction, σ_g (C T⁻¹ L⁻² φ⁻¹), as *GAP ELECTRICAL CONDUCTANCE gives it (T-20 to T-25).
#[derive(Debug, Clone)]
pub struct GapConductance {
    tables: ConductanceTables,
    clearance: Option<TableKernel>,
    pressure: Option<TableKernel>,
    /// Whether the values of the table against pressure depend on the pressure.
    pressure_matters: bool,
    /// The value depends on temperature, then on each field variable.
    depends_on: Vec<bool>,
    /// Of the tables against clearance and pressure.
    abscissae: [Vec<f64>; 2],
}

/// The points of a conductance, one column per variable, with one value per point.
#[derive(Debug, Clone, Copy, Default)]
pub struct ContactColumns<'a> {
    /// Clearance d, L.
    pub clearance: Option<&'a [f64]>,
    /// Contact pressure p, F L⁻².
    pub pressure: Option<&'a [f64]>,
    /// Temperature, the average of both sides, θ, then the field variables, as far as the tables depend on them; the rest may be empty.
    pub variables: &'a [&'a [f64]],
}

/// One of the tables of a conductance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Against {
    /// Against clearance, while open.
    Clearance,
    /// Against contact pressure, in contact.
    Pressure,
}

/// The chunk size in points, so that the output of one step is still in the L1 cache for the next.
const CHUNK: usize = 1024;

/// The minimum number of points per thread: fewer are done sooner than a thread starts.
const SHARE: usize = 1 << 17;

/// The same for tables of one axis, which are evaluated nearly as fast as memory is read.
const SHARE_OF_ONE_AXIS: usize = 1 << 20;

impl Deck {
    /// The electrical conductance of an interaction; `None` where it is given only by a user subroutine, or there is no *GAP ELECTRICAL CONDUCTANCE at all.
    ///
    /// ```
    /// use inpact::{Deck, ReadOptions};
    ///
    /// let text = "*SURFACE INTERACTION, NAME=JOINT\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n0., 0.\n4000., 1e6\n";
    /// let deck = Deck::parse("joint.inp", text, &ReadOptions::new().isolated())?;
    /// let gap = deck.electrical_conductance("joint")?.expect("it has one");
    /// assert_eq!(gap.at(None, Some(2.5e5), &[]), 1000.0);
    /// # Ok::<(), inpact::Error>(())
    /// ```
    ///
    /// # Errors
    /// An interaction that the deck does not have, or a table that cannot be evaluated, as [`check`](Self::check) says.
    pub fn electrical_conductance(&self, interaction: &str) -> Result<Option<GapConductance>, Error> {
        let Some(interaction) = self.model().interactions.get(&Name::new(interaction)) else {
            let names = in_backticks(self.model().interactions.keys());
            let names = if names.is_empty() { "none" } else { &names };
            let message = format!("`{}` has no interaction `{interaction}`: there are {names}", self.name());
            return Err(Error::data(message));
        };
        match &interaction.gap_electrical_conductance {
            Some(option) if option.user.is_none() => GapConductance::of(option, interaction).map(Some),
            _ => Ok(None),
        }
    }
}

impl GapConductance {
    fn of(option: &ElectricalConductance, interaction: &Interaction) -> Result<Self, Error> {
        let build = |table: Option<&Table>, against: &str| {
            let Some(table) = table else { return Ok(None) };
            let built = PiecewiseTable::from_rows(&table.values, table.width(), Tail::Constant);
            let name = &interaction.name;
            built.map(Some).map_err(|error| {
                Error::data(format!("the table of conductance against {against} of `{name}`: {error}"))
            })
        };
        let (clearance, pressure) =
            (build(option.clearance.as_deref(), "clearance")?, build(option.pressure.as_deref(), "pressure")?);
        let kernels = [&clearance, &pressure].map(|table| table.as_ref().map(TableKernel::new));
        let tables = || [&clearance, &pressure].into_iter().flatten();
        let axes = tables().map(PiecewiseTable::axis_count).max().unwrap_or(1);
        let depends = |axis: usize| tables().any(|table| table.axes().get(axis).is_some_and(AxisSummary::matters));
        let depends_on = (1..axes).map(depends).collect();
        let pressure_matters =
            pressure.as_ref().is_some_and(|table| table.axes().first().is_some_and(AxisSummary::matters));
        let abscissae =
            [&option.clearance, &option.pressure].map(|table| table.as_deref().map_or_else(Vec::new, abscissae));
        let Some(tables) = ConductanceTables::of(clearance, pressure) else {
            return Err(Error::data(format!("*GAP ELECTRICAL CONDUCTANCE of `{}` has no rows", interaction.name)));
        };
        let [clearance, pressure] = kernels;
        Ok(Self { tables, clearance, pressure, pressure_matters, depends_on, abscissae })
    }

    /// Whether there is a table against clearance or pressure.
    pub fn has(&self, against: Against) -> bool {
        self.kernel(against).is_some()
    }

    /// The variables of its tables other than clearance and pressure: whether the value depends on the temperature, then on each field variable.
    pub fn depends_on(&self) -> &[bool] {
        &self.depends_on
    }

    /// The conductance at one point; NaN where a deciding coordinate is NaN.
    ///
    /// The point is closed where d ≤ 0 or p ≠ 0 (T-22); without a clearance it is closed.
    /// `variables` are temperature and field variables, as far as the tables depend on them.
    pub fn at(&self, clearance: Option<f64>, pressure: Option<f64>, variables: &[f64]) -> f64 {
        self.tables.conductance(&point(clearance, pressure, variables)).value
    }

    /// The slopes at one point, along clearance and pressure, and along the variables in `slopes`: right-hand at an abscissa, zero outside of the table.
    pub fn slopes_at(
        &self,
        (clearance, pressure): (Option<f64>, Option<f64>),
        variables: &[f64],
        slopes: &mut [f64],
    ) -> [f64; 2] {
        let found = self.tables.slopes(&point(clearance, pressure, variables), slopes);
        [found.clearance, found.pressure]
    }

    /// The conductance at all points of some columns; bitwise equal to [`at`](Self::at).
    ///
    /// Many points are evaluated in parallel, on all cores or the number of threads in the environment variable `RAYON_NUM_THREADS`.
    ///
    /// # Panics
    /// A column is shorter than `values`, unless no table depends on it.
    pub fn values(&self, columns: &ContactColumns<'_>, values: &mut [f64]) {
        in_shares(values, self.share(), |first, values| {
            let part = first..first + values.len();
            let variables: Vec<&[f64]> = columns.variables.iter().map(|column| part_of(column, &part)).collect();
            let columns = ContactColumns {
                clearance: columns.clearance.map(|column| part_of(column, &part)),
                pressure: columns.pressure.map(|column| part_of(column, &part)),
                variables: &variables,
            };
            self.values_of_part(&columns, values);
        });
    }

    /// The same on the calling thread.
    fn values_of_part(&self, columns: &ContactColumns<'_>, values: &mut [f64]) {
        // Without a clearance every point is closed, and one whose pressure is NaN has the value NaN, which the table gives where the pressure matters.
        if let (None, Some(pressure), Some(kernel), true) =
            (columns.clearance, columns.pressure, &self.pressure, self.pressure_matters)
        {
            let columns: Vec<&[f64]> = std::iter::once(pressure).chain(columns.variables.iter().copied()).collect();
            return kernel.values(&columns, values);
        }
        let mut first = 0;
        let mut clearances = [0.0; CHUNK];
        let mut states = [ContactState::Closed; CHUNK];
        while first < values.len() {
            let end = values.len().min(first + CHUNK);
            let count = end - first;
            let part = first..end;
            let clearance = columns.clearance.map(|column| part_of(column, &part));
            let pressure = columns.pressure.map(|column| part_of(column, &part));
            for (row, state) in states[..count].iter_mut().enumerate() {
                *state = state_of(clearance.map(|column| column[row]), pressure.map(|column| column[row]));
            }
            let states = &states[..count];
            let out = &mut values[first..end];
            let coordinates = |first: &'_ [f64], of: &mut dyn FnMut(&[&[f64]])| {
                let others = columns.variables.iter().map(|column| part_of(column, &part));
                of(&std::iter::once(first).chain(others).collect::<Vec<_>>());
            };
            let is_open = |state: &ContactState| *state == ContactState::Open;
            let reads_pressure = self.pressure.is_some() && !states.iter().all(is_open);
            let reads_clearance = self.clearance.is_some() && (self.pressure.is_none() || states.iter().any(is_open));
            if reads_clearance {
                for (row, state) in states.iter().enumerate() {
                    let clearance = clearance.map(|column| column[row]);
                    clearances[row] = state.table_clearance(clearance).unwrap_or(f64::NAN);
                }
                if let Some(kernel) = &self.clearance {
                    coordinates(&clearances[..count], &mut |columns| kernel.values(columns, out));
                }
            }
            if !reads_pressure {
                if !reads_clearance {
                    out.iter_mut().zip(states).for_each(|(value, state)| *value = without_table(*state));
                }
            } else if let Some(kernel) = &self.pressure {
                // Closed by its clearance alone: the pressure is zero.
                let zeros = [0.0; CHUNK];
                let pressure = pressure.unwrap_or(&zeros[..count]);
                if states.iter().all(|state| *state == ContactState::Closed) {
                    coordinates(pressure, &mut |columns| kernel.values(columns, out));
                } else {
                    let mut closed = [0.0; CHUNK];
                    coordinates(pressure, &mut |columns| kernel.values(columns, &mut closed[..count]));
                    for (row, state) in states.iter().enumerate() {
                        out[row] = match state {
                            ContactState::Closed => closed[row],
                            ContactState::Open if reads_clearance => out[row],
                            state => without_table(*state),
                        };
                    }
                }
            }
            first = end;
        }
    }

    /// A single table over columns, whatever the state of contact: its own variable first, then temperature and field variables.
    ///
    /// `None` where there is no such table.
    ///
    /// # Panics
    /// A column the table depends on is shorter than `values`.
    pub fn table_values(&self, against: Against, columns: &[&[f64]], values: &mut [f64]) -> Option<()> {
        let kernel = self.kernel(against)?;
        in_shares(values, self.share(), |first, values| {
            let part = first..first + values.len();
            let columns: Vec<&[f64]> = columns.iter().map(|column| part_of(column, &part)).collect();
            kernel.values(&columns, values);
        });
        Some(())
    }

    /// The distinct abscissae of a table's own variable, in ascending order; empty where there is no such table.
    pub fn abscissae(&self, against: Against) -> &[f64] {
        match against {
            Against::Clearance => &self.abscissae[0],
            Against::Pressure => &self.abscissae[1],
        }
    }

    /// The number of points per thread.
    fn share(&self) -> usize {
        if self.depends_on.contains(&true) { SHARE } else { SHARE_OF_ONE_AXIS }
    }

    fn kernel(&self, against: Against) -> Option<&TableKernel> {
        match against {
            Against::Clearance => self.clearance.as_ref(),
            Against::Pressure => self.pressure.as_ref(),
        }
    }
}

/// The rows of a column in a part; none of one that is not given.
fn part_of<'a>(column: &'a [f64], part: &Range<usize>) -> &'a [f64] {
    if column.is_empty() { column } else { &column[part.clone()] }
}

/// Distributes chunks of values, each with its offset, over the threads; few values stay on this one.
fn in_shares(values: &mut [f64], least: usize, work: impl Fn(usize, &mut [f64]) + Send + Sync) {
    let threads = threads_for(values.len() / least);
    if threads == 1 {
        return work(0, values);
    }
    let share = values.len().div_ceil(threads).next_multiple_of(CHUNK);
    with_threads(threads, || {
        values.par_chunks_mut(share).enumerate().for_each(|(at, values)| work(at * share, values));
    });
}

/// The abscissae of the first variable.
fn abscissae(table: &Table) -> Vec<f64> {
    let mut abscissae: Vec<f64> = table.row_values().filter_map(|row| row.get(1)).copied().collect();
    abscissae.sort_by(f64::total_cmp);
    abscissae.dedup();
    abscissae
}

fn point(clearance: Option<f64>, pressure: Option<f64>, variables: &[f64]) -> ContactPoint<'_> {
    let state = state_of(clearance, pressure);
    // Without a pressure a closed point has none.
    let pressure = pressure.unwrap_or(0.0);
    let clearance = clearance.unwrap_or(if state == ContactState::Undetermined { f64::NAN } else { 0.0 });
    ContactPoint { clearance: Clearance(clearance), pressure: ContactPressure(pressure), state, variables }
}

/// The contact state (T-22). A point that has no clearance, and so no gap, is closed at zero pressure too: callers of one law may leave the clearance out.
#[inline]
fn state_of(clearance: Option<f64>, pressure: Option<f64>) -> ContactState {
    ContactState::of(None, clearance, pressure).unwrap_or(ContactState::Closed)
}

fn without_table(state: ContactState) -> f64 {
    if state == ContactState::Undetermined { f64::NAN } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::{Against, ContactColumns};
    use crate::{Deck, ReadOptions};

    const CLEARANCE: &str = "*GAP ELECTRICAL CONDUCTANCE\n8., 0., 300.\n5., 1., 300.\n9., 0., 400.\n6., 2., 400.\n";
    const PRESSURE: &str = "*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n10., 0., 300.\n30., 2., 300.\n40., 3., 400.\n";

    const CONSTANT: &str = "*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n10., 0., 300.\n10., 2., 300.\n40., 0., 400.\n";

    /// Columns and single points agree bit for bit, for every combination of tables and of given contact quantities.
    #[test]
    fn t_22_columns_have_the_bits_of_points() {
        let some = [f64::NAN, -1.0, 0.0, 0.25, 1.0, 1.5, 7.0];
        let points: Vec<[f64; 3]> = some
            .iter()
            .flat_map(|d| some.iter().flat_map(move |p| [250.0, 333.0, f64::NAN].map(|t| [*d, *p, t])))
            .cycle()
            .take(3000)
            .collect();
        let [d, p, t] = [0, 1, 2].map(|index| points.iter().map(|point| point[index]).collect::<Vec<f64>>());
        for tables in [CLEARANCE.to_owned(), PRESSURE.to_owned(), CLEARANCE.to_owned() + PRESSURE, CONSTANT.to_owned()]
        {
            let text = format!("*SURFACE INTERACTION, NAME=A\n{tables}");
            let deck = Deck::parse("a.inp", text, &ReadOptions::new().isolated()).expect("a deck");
            let gap = deck.electrical_conductance("A").expect("it is there").expect("it has tables");
            assert_eq!(gap.depends_on(), [true]);
            for (clearance, pressure) in [(true, true), (true, false), (false, true)] {
                let columns = ContactColumns {
                    clearance: clearance.then_some(d.as_slice()),
                    pressure: pressure.then_some(p.as_slice()),
                    variables: &[&t],
                };
                let mut values = vec![0.0; points.len()];
                gap.values(&columns, &mut values);
                for ([d, p, t], value) in points.iter().zip(values) {
                    let at = gap.at(clearance.then_some(*d), pressure.then_some(*p), &[*t]);
                    assert_eq!(value.to_bits(), at.to_bits(), "{tables}: d {d}, p {p}, t {t}: {value} and {at}");
                }
            }
        }
    }

    #[test]
    fn points_that_threads_share_have_the_bits_of_points_alone() {
        let text = format!("*SURFACE INTERACTION, NAME=A\n{CLEARANCE}{PRESSURE}");
        let deck = Deck::parse("a.inp", text, &ReadOptions::new().isolated()).expect("a deck");
        let gap = deck.electrical_conductance("A").expect("it is there").expect("it has tables");
        let rows = 2 * super::SHARE + 77;
        let column = |step: usize, width: f64| -> Vec<f64> {
            (0..rows).map(|row| (row * step % 1009) as f64 / 1009.0 * width - 0.5).collect()
        };
        let (d, p, t) = (column(7, 3.0), column(13, 4.0), column(11, 500.0));
        for (clearance, pressure) in [(true, true), (true, false), (false, true)] {
            let columns = ContactColumns {
                clearance: clearance.then_some(d.as_slice()),
                pressure: pressure.then_some(p.as_slice()),
                variables: &[&t],
            };
            let mut values = vec![0.0; rows];
            gap.values(&columns, &mut values);
            for (row, value) in values.iter().enumerate() {
                let at = gap.at(clearance.then_some(d[row]), pressure.then_some(p[row]), &[t[row]]);
                assert_eq!(value.to_bits(), at.to_bits(), "row {row}");
            }
        }
        for (against, own) in [(Against::Clearance, &d), (Against::Pressure, &p)] {
            let (mut values, mut alone) = (vec![0.0; rows], vec![0.0; 1]);
            gap.table_values(against, &[own, &t], &mut values).expect("there is such a table");
            for (row, value) in values.iter().enumerate().step_by(997) {
                gap.table_values(against, &[&own[row..=row], &t[row..=row]], &mut alone)
                    .expect("there is such a table");
                assert_eq!(value.to_bits(), alone[0].to_bits(), "row {row}");
            }
        }
    }

    #[test]
    fn abscissae_are_those_of_all_groups() {
        let text = format!("*SURFACE INTERACTION, NAME=A\n{CLEARANCE}");
        let deck = Deck::parse("a.inp", text, &ReadOptions::new().isolated()).expect("a deck");
        let gap = deck.electrical_conductance("a").expect("it is there").expect("it has tables");
        assert_eq!(gap.abscissae(Against::Clearance), [0.0, 1.0, 2.0]);
        assert!(gap.has(Against::Clearance) && !gap.has(Against::Pressure));
        assert!(deck.electrical_conductance("b").is_err());
    }
}
