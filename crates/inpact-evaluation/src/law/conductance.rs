//! Contact conductance by its two branches, against clearance and against contact pressure.
//!
//! Semantics T-20 to T-25, J-5, Q-1, Q-12, Q-36; Analysis User's Guide 37.3.1 (electrical) and 37.2.1 (thermal), 6.14.
//!
//! | tables given | closed | open |
//! |---|---|---|
//! | clearance only | clearance table at d = 0, whatever the clearance (Q-36) | clearance table, d < 0 taken as d = 0 |
//! | pressure only | pressure table | 0 |
//! | both | pressure table | clearance table, d < 0 taken as d = 0 |
//!
//! Both tables may depend on the average temperature and on averaged field variables as well.
//! The conductance jumps where the two branches meet, where a pressure table alone opens, and at the last clearance under [`crate::table::Tail::Zero`].

pub(crate) mod columns;
pub(crate) mod pair;

use super::contact::{Clearance, ContactPressure, ContactState};
use crate::evaluator::FoundValue;
use crate::table::{PiecewiseTable, Sides};

/// The tables of a conductance: axis 0 clearance or pressure, axis 1 average temperature, then the field variables.
#[derive(Clone, Debug)]
pub enum ConductanceTables {
    /// Conductance against clearance only.
    Clearance(PiecewiseTable),
    /// Conductance against contact pressure only.
    Pressure(PiecewiseTable),
    /// One table for the open and one for the closed interface.
    Both {
        /// Conductance against clearance, while open.
        clearance: PiecewiseTable,
        /// Conductance against contact pressure, while closed.
        pressure: PiecewiseTable,
    },
}

/// The variables of a conductance at one point of contact.
#[derive(Clone, Copy, Debug)]
pub struct ContactPoint<'a> {
    /// Clearance d.
    pub clearance: Clearance,
    /// Contact pressure p.
    pub pressure: ContactPressure,
    /// Closed or open.
    pub state: ContactState,
    /// The average temperature of the two sides, then the averages of the field variables, as far as the tables depend on them; the rest may be NaN or left out.
    pub variables: &'a [f64],
}

/// Which table a conductance came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Branch {
    /// The table against clearance.
    Clearance,
    /// The table against contact pressure.
    Pressure,
    /// No table: open with a pressure table alone, or a state that is undetermined.
    Neither,
}

/// A conductance and where it came from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductance {
    /// The conductance, in the unit of the table's first column.
    pub value: f64,
    /// The branch in force.
    pub branch: Branch,
    /// Along which axes of that branch's table the point lies outside.
    pub sides: Sides,
}

impl ConductanceTables {
    /// The conductance of the given tables; `None` without any.
    pub fn of(clearance: Option<PiecewiseTable>, pressure: Option<PiecewiseTable>) -> Option<Self> {
        match (clearance, pressure) {
            (Some(clearance), None) => Some(Self::Clearance(clearance)),
            (None, Some(pressure)) => Some(Self::Pressure(pressure)),
            (Some(clearance), Some(pressure)) => Some(Self::Both { clearance, pressure }),
            (None, None) => None,
        }
    }

    /// The conductance at a point.
    ///
    /// NaN where the state is undetermined or an input the branch depends on is NaN.
    #[inline]
    pub fn conductance(&self, point: &ContactPoint<'_>) -> Conductance {
        let (branch, found) = self.found_with(point, |_, table, first, others| {
            let (value, sides) = table.value_and_sides_at(first, others);
            FoundValue { value, rest: None, sides }
        });
        Conductance { value: found.value, branch, sides: found.sides }
    }

    /// [`Self::conductance`] with the tables' values from `find`.
    fn found_with(
        &self,
        point: &ContactPoint<'_>,
        find: impl Fn(Branch, &PiecewiseTable, f64, &[f64]) -> FoundValue,
    ) -> (Branch, FoundValue) {
        let (branch, table) = self.branch(point.state);
        match table {
            Some(table) => (branch, find(branch, table, abscissa(branch, point), point.variables)),
            None => {
                let value = value_without_table(point.state);
                (branch, FoundValue { value, rest: None, sides: Sides::default() })
            }
        }
    }

    /// The table of a branch.
    pub fn table(&self, branch: Branch) -> Option<&PiecewiseTable> {
        match (self, branch) {
            (Self::Clearance(table) | Self::Both { clearance: table, .. }, Branch::Clearance)
            | (Self::Pressure(table) | Self::Both { pressure: table, .. }, Branch::Pressure) => Some(table),
            _ => None,
        }
    }

    /// The same branches with other tables.
    #[must_use]
    pub fn map(self, other: impl Fn(Branch, PiecewiseTable) -> PiecewiseTable) -> Self {
        match self {
            Self::Clearance(table) => Self::Clearance(other(Branch::Clearance, table)),
            Self::Pressure(table) => Self::Pressure(other(Branch::Pressure, table)),
            Self::Both { clearance, pressure } => Self::Both {
                clearance: other(Branch::Clearance, clearance),
                pressure: other(Branch::Pressure, pressure),
            },
        }
    }

    /// The slope of the conductance along axis 0 of the branch in force, and along temperature and field variables in `variables`.
    ///
    /// Slope of the containing segment, right-hand at an abscissa, zero outside the table (semantics 4.4).
    /// So it is zero in overclosure and where a closed point has a clearance, which is ignored, and at d = 0 it is that of the first segment; jumps of the conductance do not contribute.
    pub fn slopes(&self, point: &ContactPoint<'_>, variables: &mut [f64]) -> ConductanceSlopes {
        for (variable, slope) in variables.iter_mut().enumerate() {
            *slope = self.slope(SlopeAlong::Variable(variable), point);
        }
        ConductanceSlopes {
            clearance: self.slope(SlopeAlong::Contact(Branch::Clearance), point),
            pressure: self.slope(SlopeAlong::Contact(Branch::Pressure), point),
        }
    }

    /// One of the [`slopes`](Self::slopes).
    pub(crate) fn slope(&self, along: SlopeAlong, point: &ContactPoint<'_>) -> f64 {
        let (branch, table) = self.branch(point.state);
        let Some(table) = table else { return value_without_table(point.state) };
        let axis = along.axis_of(branch, point.state, point.clearance.0);
        axis.map_or(0.0, |axis| table.slope_at(axis, abscissa(branch, point), point.variables))
    }

    /// The table in force in a state, if any.
    pub fn branch_in(&self, state: ContactState) -> Option<(Branch, &PiecewiseTable)> {
        let (branch, table) = self.branch(state);
        Some((branch, table?))
    }

    /// The branch that holds in a state.
    #[inline]
    pub(crate) fn branch_of(&self, state: ContactState) -> Branch {
        self.branch(state).0
    }

    /// The branch and table that hold in a state.
    #[inline]
    fn branch(&self, state: ContactState) -> (Branch, Option<&PiecewiseTable>) {
        match (self, state) {
            (Self::Clearance(table), _) | (Self::Both { clearance: table, .. }, ContactState::Open) => {
                (Branch::Clearance, Some(table))
            }
            (Self::Pressure(table) | Self::Both { pressure: table, .. }, ContactState::Closed) => {
                (Branch::Pressure, Some(table))
            }
            (Self::Pressure(_), ContactState::Open) | (_, ContactState::Undetermined) => (Branch::Neither, None),
        }
    }
}

/// Slopes of a conductance along the two quantities of contact; one of the two is zero, as only one branch holds at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConductanceSlopes {
    /// Per unit of clearance.
    pub clearance: f64,
    /// Per unit of contact pressure.
    pub pressure: f64,
}

/// A quantity along which a conductance has a slope.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SlopeAlong {
    /// The first quantity of this branch, clearance or contact pressure.
    Contact(Branch),
    /// A further variable, by its index.
    Variable(usize),
}

impl SlopeAlong {
    /// The axis of the table of the branch in force along which the slope is; `None` where there is none.
    #[inline]
    pub(crate) fn axis_of(self, branch: Branch, state: ContactState, clearance: f64) -> Option<usize> {
        let is_moot = || match state {
            // For a closed point the clearance matters only at d = 0, where it opens.
            ContactState::Closed => clearance != 0.0,
            _ => clearance < 0.0,
        };
        match self {
            Self::Variable(variable) => Some(variable + 1),
            Self::Contact(of) if of != branch || (branch == Branch::Clearance && is_moot()) => None,
            Self::Contact(_) => Some(0),
        }
    }
}

/// The coordinate of axis 0 of a branch's table ([`ContactState::table_clearance`]).
fn abscissa(branch: Branch, point: &ContactPoint<'_>) -> f64 {
    match branch {
        Branch::Pressure => point.pressure.0,
        _ => point.state.table_clearance(Some(point.clearance.0)).unwrap_or(f64::NAN),
    }
}

/// The conductance, and all its slopes, where no table holds.
fn value_without_table(state: ContactState) -> f64 {
    match state {
        ContactState::Undetermined => f64::NAN,
        _ => 0.0,
    }
}
