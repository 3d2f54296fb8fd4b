//! The conductance of one row by a user's routine, which is called in the order of the rows.

use super::{UserConductancePoint, UserConductanceValue, UserFault, UserLaw, UserNames};
use crate::nodes::{Column, Part, coordinates};
use crate::plan::{Source, UserPlan};
use crate::rows::{Binder, InteractionTally, Row, UserFaultInRow};

/// The routine, and the indices of its arguments in a row.
#[derive(Debug, Clone)]
pub(crate) struct UserColumns {
    law: UserLaw,
    names: UserNames,
    clearance: usize,
    temperatures: Source<usize>,
    field_variables: Vec<Source<usize>>,
    time: Option<usize>,
    step_time: Option<usize>,
    step: Option<usize>,
    increment: Option<usize>,
    /// Slave and master; where there is none the coordinate is 0.
    coordinates: [[Option<usize>; 3]; 2],
    /// Among the labels.
    node: Option<usize>,
}

impl UserColumns {
    pub(crate) fn bind(binder: Binder<'_>, plan: &UserPlan, law: &UserLaw) -> Option<Self> {
        // The plan reads every column it names.
        let source = |source: &Source<Column>| source.map(|column| binder.place(column).unwrap_or_default());
        let planned = |column: Column| binder.place(column).filter(|_| plan.others.contains(&column));
        Some(Self {
            law: law.clone(),
            names: plan.names.clone(),
            clearance: binder.place(Column::Clearance)?,
            temperatures: source(&plan.temperatures),
            field_variables: plan.field_variables.iter().map(source).collect(),
            time: planned(Column::Time),
            step_time: planned(Column::StepTime),
            step: planned(Column::Step),
            increment: planned(Column::Increment),
            coordinates: [Part::Slave, Part::Master].map(|part| coordinates(part).map(planned)),
            node: binder.label(Column::Node),
        })
    }

    /// The conductance; `None` where the row lacks a number the routine is called with.
    pub(crate) fn conductance(
        &self,
        row: Row<'_, '_>,
        tally: &mut InteractionTally,
    ) -> Option<Result<UserConductanceValue, UserFault>> {
        let clearance = row.number(self.clearance)?;
        let temperatures = sides(&self.temperatures, row)?;
        let fields = self.field_variables.iter().map(|source| sides(source, row)).collect::<Option<Vec<[f64; 2]>>>()?;
        let number = |place: Option<usize>| place.and_then(|place| row.number(place));
        let total_time = number(self.time).unwrap_or(0.0);
        let node = self.node.and_then(|place| node_number(row.part.batch().labels[place].get(row.index)));
        tally.unnumbered_nodes += u64::from(self.node.is_some() && node.is_none());
        Some(self.law.conductance(&UserConductancePoint {
            clearance,
            temperatures,
            field_variables: &fields,
            time: [number(self.step_time).unwrap_or(total_time), total_time],
            names: &self.names,
            coordinates: self.coordinates.map(|side| side.map(|place| number(place).unwrap_or(0.0))),
            node: node.unwrap_or(0),
            step: number(self.step).map_or(1, counter),
            increment: number(self.increment).map_or(1, counter),
        }))
    }

    /// The fault of a row with an invalid conductance, for users.
    #[cold]
    pub(crate) fn fault_in_row(&self, row: Row<'_, '_>, fault: &UserFault) -> UserFaultInRow {
        let place = row.part.place(row.index);
        let number = place.row.unwrap_or_default();
        let clearance = row.number(self.clearance).unwrap_or(f64::NAN);
        let message = format!("user subroutine GAPELECTR {fault} in row {number}, clearance {clearance:?}");
        UserFaultInRow { place, message }
    }
}

/// Slave and master; the column of both sides is used where a row lacks one of them.
fn sides(source: &Source<usize>, row: Row<'_, '_>) -> Option<[f64; 2]> {
    let both = |cell| row.number(cell).map(|value| [value; 2]);
    let each = |slave, master| Some([row.number(slave)?, row.number(master)?]);
    match *source {
        Source::Cell(cell) => both(cell),
        Source::Sides(slave, master) => each(slave, master),
        Source::CellOrSides(cell, slave, master) => each(slave, master).or_else(|| both(cell)),
    }
}

/// The number of a node, where its label is one.
fn node_number(label: &[u8]) -> Option<i32> {
    std::str::from_utf8(label.trim_ascii()).ok()?.parse().ok()
}

/// A step or an increment: the first pass accepted only integers of that size.
#[expect(clippy::cast_possible_truncation, reason = "whole and within the range of i32")]
fn counter(value: f64) -> i32 {
    value as i32
}
