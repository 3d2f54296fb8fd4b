//! Thermal gap conductance of CalculiX: the same keyword *GAP CONDUCTANCE, another law.
//!
//! The rows are (conductance, contact pressure, temperature); rows of one temperature make a curve against pressure. There is no table against clearance:
//! a pair of faces conducts where it is closed, and nowhere else.
//!
//! | mean temperature | conductance |
//! |---|---|
//! | one curve only | that curve at any temperature |
//! | below the first curve, or at or above the last | that curve, constant outside its pressures |
//! | from one curve up to the next | both curves, **clipped to the pressures that both have**, linear in temperature; constant outside these pressures |
//!
//! The clipping distinguishes it from the nested tables of Abaqus (T-06), in which each curve is constant outside its own pressures.
//! It makes the conductance jump where the mean temperature reaches a curve of other pressures.
//! Curves whose pressure ranges are disjoint have no value between them, and ccx stops: such rows form no law here either.
//! ccx has room for 20 rows a curve and silently reads beyond that; that bug is not part of the law (rule T016 warns of it).
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | k | gap conductance | J T⁻¹ L⁻² θ⁻¹ |
//! | p | contact pressure | F L⁻² |
//! | θ̄ | mean temperature of both sides | θ |
//!
//! Derivatives: as those of a table (semantics 4.4), of the clipped curves.
//! Source: CalculiX ccx 2.20, `materialdata_sp.f`, `plmix.f`, `springforc_f2f_th.f`, and runs of it; semantics K-38.

use super::conductance::{Branch, Conductance, ConductanceSlopes, ContactPoint};
use super::contact::ContactState;
use crate::error::{Error, TableFault};
use crate::table::{PiecewiseTable, Sides, Tail};
use std::ops::Range;

/// The conductance of an interaction in the dialect of CalculiX.
#[derive(Clone, Debug, PartialEq)]
pub struct CalculixConductance {
    /// The temperature of each curve, ascending.
    temperatures: Vec<f64>,
    /// The first and the last curve against pressure, with which ccx continues outside the temperatures.
    outermost: [PiecewiseTable; 2],
    /// For each curve but the last the clipped table against pressure and temperature up to the next.
    between: Vec<PiecewiseTable>,
    /// All rows as one table, whose axes a plan shows.
    rows: PiecewiseTable,
}

const WIDTH: usize = CalculixConductance::WIDTH;

impl CalculixConductance {
    /// The number of columns of a row: conductance, pressure, temperature.
    pub const WIDTH: usize = 3;

    /// The conductance of `cells`, rows of conductance, pressure and temperature.
    ///
    /// # Errors
    /// Rows that do not ascend, which ccx silently misreads; and neighbouring curves without pressures in common, at which it stops.
    pub fn from_rows(cells: &[f64]) -> Result<Self, Error> {
        let rows = PiecewiseTable::from_rows(cells, WIDTH, Tail::Constant)?;
        let (rows_of_table, _) = cells.as_chunks::<WIDTH>();
        let curves: Vec<&[[f64; WIDTH]]> = rows_of_table.chunk_by(|row, next| row[2] == next[2]).collect();
        let nothing = Error::of_rows(0, TableFault::NoRows);
        let (Some(first), Some(last)) = (curves.first(), curves.last()) else { return Err(nothing) };
        let outermost = [curve_table(first)?, curve_table(last)?];
        let starts = curves.iter().scan(0, |next, curve| {
            *next += curve.len();
            Some(*next)
        });
        let pairs = curves.windows(2).zip(starts);
        let between = pairs.map(|(pair, row)| clipped(row, pair[0], pair[1])).collect::<Result<_, _>>()?;
        Ok(Self { temperatures: curves.iter().map(|curve| curve[0][2]).collect(), outermost, between, rows })
    }

    /// The conductance at a point whose first variable is the mean temperature; zero where it is open.
    ///
    /// NaN where the state is undetermined, or pressure or temperature is NaN and the conductance depends on it.
    pub fn conductance(&self, point: &ContactPoint<'_>) -> Conductance {
        let nowhere = |value| Conductance { value, branch: Branch::Neither, sides: Sides::default() };
        match point.state {
            ContactState::Open => return nowhere(0.0),
            ContactState::Undetermined => return nowhere(f64::NAN),
            ContactState::Closed => {}
        }
        let (table, outside) = self.in_force(point);
        let (value, mut sides) = match table {
            Some(table) => table.value_and_sides_at(point.pressure.0, point.variables),
            None => (f64::NAN, Sides::default()),
        };
        match outside {
            Outside::No => {}
            Outside::Below => sides.mark_below(1),
            Outside::Above => sides.mark_above(1),
        }
        Conductance { value, branch: Branch::Pressure, sides }
    }

    /// The slopes along pressure, and along the temperature in `variables`; there are no others.
    pub fn slopes(&self, point: &ContactPoint<'_>, variables: &mut [f64]) -> ConductanceSlopes {
        let nothing = match point.state {
            ContactState::Undetermined => f64::NAN,
            _ => 0.0,
        };
        let table = if point.state == ContactState::Closed { Some(self.in_force(point).0) } else { None };
        let slope = |axis| match table {
            None => nothing,
            Some(None) => f64::NAN,
            Some(Some(table)) => table.slope_at(axis, point.pressure.0, point.variables),
        };
        for (variable, along) in variables.iter_mut().enumerate() {
            *along = if variable == 0 { slope(1) } else { 0.0 };
        }
        ConductanceSlopes { clearance: nothing, pressure: slope(0) }
    }

    /// All rows as one table against pressure and temperature, for its axes: the values between two curves are not those of the law.
    pub fn rows(&self) -> &PiecewiseTable {
        &self.rows
    }

    /// Whether the conductance depends on the temperature.
    pub fn depends_on_temperature(&self) -> bool {
        1 < self.temperatures.len()
    }

    /// The table that holds at a temperature; none where the temperature is NaN.
    fn in_force(&self, point: &ContactPoint<'_>) -> (Option<&PiecewiseTable>, Outside) {
        let [first, last] = &self.outermost;
        if !self.depends_on_temperature() {
            return (Some(first), Outside::No);
        }
        let temperature = point.variables.first().copied().unwrap_or(f64::NAN);
        if temperature.is_nan() {
            return (None, Outside::No);
        }
        let not_above = self.temperatures.partition_point(|&curve| curve <= temperature);
        match not_above {
            0 => (Some(first), Outside::Below),
            _ => match self.between.get(not_above - 1) {
                Some(table) => (Some(table), Outside::No),
                None if self.temperatures.last() == Some(&temperature) => (Some(last), Outside::No),
                None => (Some(last), Outside::Above),
            },
        }
    }
}

/// On which side of all curves a temperature lies.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Outside {
    No,
    Below,
    Above,
}

/// A single curve, against pressure.
fn curve_table(rows: &[[f64; WIDTH]]) -> Result<PiecewiseTable, Error> {
    let cells: Vec<[f64; 2]> = rows.iter().map(|&[value, pressure, _]| [value, pressure]).collect();
    PiecewiseTable::from_rows(cells.as_flattened(), 2, Tail::Constant)
}

/// Two neighbouring curves over their common pressures; the second begins in that row of the table.
fn clipped(row: usize, first: &[[f64; WIDTH]], second: &[[f64; WIDTH]]) -> Result<PiecewiseTable, Error> {
    let (first_range, second_range) = (pressures(first), pressures(second));
    let shared = first_range.start.max(second_range.start)..first_range.end.min(second_range.end);
    // Curves with the same start share at least that pressure; otherwise the one that starts earlier must reach beyond the start of the other.
    let do_share = first_range.start == second_range.start
        || if first_range.start < second_range.start {
            second_range.start < first_range.end
        } else {
            first_range.start < second_range.end
        };
    if !do_share {
        return Err(Error::of_rows(row, TableFault::NoSharedPressures { temperatures: [first[0][2], second[0][2]] }));
    }
    let mut cells = Vec::new();
    for curve in [first, second] {
        let table = curve_table(curve)?;
        let temperature = curve[0][2];
        let mut push = |pressure: f64| cells.push([table.value(&[pressure]), pressure, temperature]);
        push(shared.start);
        let inner = curve.iter().map(|row| row[1]).filter(|&pressure| shared.start < pressure && pressure < shared.end);
        inner.for_each(&mut push);
        if shared.start < shared.end {
            push(shared.end);
        }
    }
    PiecewiseTable::from_rows(cells.as_flattened(), WIDTH, Tail::Constant)
}

/// From the first to the last pressure of a curve, inclusive.
fn pressures(curve: &[[f64; WIDTH]]) -> Range<f64> {
    curve[0][1]..curve[curve.len() - 1][1]
}
