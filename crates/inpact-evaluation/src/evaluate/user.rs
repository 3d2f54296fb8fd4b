//! The conductance of one row by a user's routine.

use super::{InteractionTally, Row, UserFaultInRow};
use crate::compile::CompiledUser;
use crate::law::user::{UserConductancePoint, UserConductanceValue, UserFault};
use crate::plan::Source;

/// The conductance; `None` where the row lacks a number the routine is called with.
///
/// `fields` is room for the field variables.
pub(super) fn conductance(
    user: &CompiledUser,
    row: Row<'_>,
    fields: &mut Vec<[f64; 2]>,
    tally: &mut InteractionTally,
) -> Option<Result<UserConductanceValue, UserFault>> {
    let clearance = row.number(user.clearance)?;
    let temperatures = sides(&user.temperatures, row)?;
    fields.clear();
    for source in &user.field_variables {
        fields.push(sides(source, row)?);
    }
    let number = |place: Option<usize>| place.and_then(|place| row.number(place));
    let total_time = number(user.time).unwrap_or(0.0);
    let node = user.node.and_then(|place| node_number(row.batch.labels[place].get(row.index)));
    tally.unnumbered_nodes += u64::from(user.node.is_some() && node.is_none());
    Some(user.law.conductance(&UserConductancePoint {
        clearance,
        temperatures,
        field_variables: fields,
        time: [number(user.step_time).unwrap_or(total_time), total_time],
        names: &user.names,
        coordinates: user.coordinates.map(|side| side.map(|place| number(place).unwrap_or(0.0))),
        node: node.unwrap_or(0),
        step: number(user.step).map_or(1, counter),
        increment: number(user.increment).map_or(1, counter),
    }))
}

/// Slave and master; the column of both sides has the say where a row lacks one of them.
fn sides(source: &Source<usize>, row: Row<'_>) -> Option<[f64; 2]> {
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

/// A step or an increment: the first reading let only whole numbers of that size pass.
#[expect(clippy::cast_possible_truncation, reason = "whole and within the range of i32")]
fn counter(value: f64) -> i32 {
    value as i32
}

/// What there is to say of a row whose conductance is none.
#[cold]
pub(super) fn fault_in_row(user: &CompiledUser, row: Row<'_>, fault: &UserFault) -> UserFaultInRow {
    let place = row.batch.place(row.index, None);
    let number = place.row.unwrap_or_default();
    let clearance = row.number(user.clearance).unwrap_or(f64::NAN);
    let message = format!("user subroutine GAPELECTR {fault} in row {number}, clearance {clearance:?}");
    UserFaultInRow { place, message }
}

impl InteractionTally {
    /// Counts a row whose conductance is none; true for those few that are told.
    #[cold]
    pub(super) fn count_fault(&mut self) -> bool {
        /// How many rows are told of.
        const MOST: u64 = 20;
        self.user_faults += 1;
        self.user_faults <= MOST
    }
}
