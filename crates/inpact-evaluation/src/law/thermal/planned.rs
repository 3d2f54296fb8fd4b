//! Plans of the parts of the thermal law, and the temperatures that several of them need.

use crate::nodes::{Column, Part};
use crate::plan::planner::{LeftOuts, Planner};
use crate::plan::reason::{Missing, Reason};

/// Results of planning a part of the law.
pub(crate) enum Planned<T> {
    /// The deck has no such part.
    Absent,
    /// It was left out, for this reason.
    LeftOut(Reason),
    /// It is evaluated.
    Part(T),
}

impl<T> Planned<T> {
    pub(crate) fn of(planned: Result<T, Reason>) -> Self {
        match planned {
            Ok(part) => Self::Part(part),
            Err(reason) => Self::LeftOut(reason),
        }
    }

    /// The part; reports what is left out, and stores the first reason.
    pub(super) fn part(self, what: &str, left_out: &mut LeftOuts, first: &mut Option<Reason>) -> Option<T> {
        match self {
            Self::Absent => None,
            Self::Part(part) => Some(part),
            Self::LeftOut(reason) => {
                left_out.push(what, reason.clone());
                first.get_or_insert(reason);
                None
            }
        }
    }
}

/// The temperatures of both sides, which every flux across depends on.
pub(crate) fn temperatures(planner: Planner<'_>) -> Result<[Column; 2], Missing> {
    let sides = [Part::Slave, Part::Master].map(Column::Temperature);
    let lacking: Vec<Column> = sides.into_iter().filter(|side| !planner.presence(*side).has_numbers()).collect();
    match lacking.as_slice() {
        [] => Ok(sides),
        _ if lacking.iter().all(|side| planner.survey.columns.contains(side)) => Err(Missing::empty(lacking)),
        _ => Err(Missing::absent(lacking)),
    }
}
