//! Procedure and times of a scene: start, end, increments, start of histories.

use super::{Reader, start};
use crate::scene::file::{ClosingHeatName, ProcedureName, SceneFile, TimeEntry};
use crate::scene::rules::MALFORMED_TIME;
use crate::scene::values::Number;
use crate::scene::{Procedure, Steps, TimeSpan};
use inpact_evaluation::law::ClosingHeat;

/// The fraction of the range of values below which the local error of an increment is lost in rounding.
const LEAST_TOLERANCE: f64 = 1e-12;

/// More increments are probably an error of units: their states alone would fill a disk.
const MAX_INCREMENTS: f64 = 1e7;

impl Reader<'_> {
    pub(super) fn procedure(&mut self, file: &SceneFile) -> Procedure {
        match (file.procedure, &file.time) {
            (ProcedureName::Steady, None) => Procedure::Steady,
            (ProcedureName::Steady, Some(time)) => {
                let at = start(time);
                let help = "write procedure = \"transient\", or leave `time` out";
                self.report(&MALFORMED_TIME, at, "a steady state has no `time`", help);
                Procedure::Steady
            }
            (ProcedureName::Transient, None) => {
                let help = "add [time] with `end`, and `step` or `tolerance`";
                self.report(&MALFORMED_TIME, 0, "a transient needs `time`", help);
                Procedure::Steady
            }
            (ProcedureName::Transient, Some(time)) => self.time_span(time.as_ref()).map_or_else(
                |(number, message, help)| {
                    let at = number.map_or_else(|| start(time), |number| number.span().start);
                    self.report(&MALFORMED_TIME, at, message, help);
                    Procedure::Steady
                },
                Procedure::Transient,
            ),
        }
    }

    /// The time of a transient; or the invalid number, its fault, and the help.
    pub(super) fn time_span<'n>(
        &self,
        entry: &'n TimeEntry,
    ) -> Result<TimeSpan, (Option<&'n Number>, String, &'static str)> {
        let TimeEntry { start, end, step, tolerance, first_step, start_from, closing_heat } = entry;
        for (name, number) in [("start", start.as_ref()), ("end", Some(end))] {
            if let Some(number) = number.filter(|number| !number.value().is_finite()) {
                return Err((Some(number), format!("`{name}` is {}", self.written(number)), "give a finite time"));
            }
        }
        let (from, to) = (start.as_ref().map_or(0.0, Number::value), end.value());
        if to <= from {
            let from = start.as_ref().map_or("0.0", |start| self.written(start));
            let message = format!("the time goes from {from} to {}", self.written(end));
            return Err((Some(end), message, "let `end` be later than `start`"));
        }
        let positive = |number: &'n Option<Number>, name: &str| match number {
            Some(number) if !(number.value() > 0.0 && number.value().is_finite()) => {
                Err((Some(number), format!("`{name}` is {}", self.written(number)), "give a finite number above zero"))
            }
            number => Ok(number.as_ref().map(Number::value)),
        };
        let given = (positive(step, "step")?, positive(tolerance, "tolerance")?, positive(first_step, "first_step")?);
        let steps = match given {
            (Some(step), None, None) => Steps::Given(step),
            (Some(_), None, Some(_)) => {
                let message = "`first_step` and `step` exclude each other".to_owned();
                return Err((first_step.as_ref(), message, "leave one of the two out"));
            }
            (None, Some(tolerance), first) => Steps::ByError { tolerance, first: first.unwrap_or(1e-3 * (to - from)) },
            _ => {
                let help = "give `step` for increments of one length, or `tolerance` for increments by their error";
                return Err((None, "`time` needs one of `step` and `tolerance`".to_owned(), help));
            }
        };
        let closing_heat = match closing_heat {
            ClosingHeatName::Balanced => ClosingHeat::Balanced,
            ClosingHeatName::Manual => ClosingHeat::Manual,
        };
        let span = TimeSpan { start: from, end: to, steps, start_from: *start_from, closing_heat };
        let shown = |number: &Option<Number>| number.as_ref().map_or("", |number| self.written(number));
        if let Some(number) = tolerance.as_ref().filter(|tolerance| tolerance.value() < LEAST_TOLERANCE) {
            let message = format!("`tolerance` is {}, below what rounding leaves of an error", shown(tolerance));
            return Err((Some(number), message, "give a tolerance of 1e-12 or above"));
        }
        for (name, given) in [("step", step), ("first_step", first_step)] {
            if let Some(number) = given.as_ref().filter(|given| given.value() < span.resolution()) {
                let furthest = from.abs().max(to.abs());
                let message =
                    format!("`{name}` is {}, which rounding loses beside a time of {furthest:?}", shown(given));
                return Err((Some(number), message, "give a longer one, or count the time from a start nearer to 0"));
            }
        }
        if let Some(number) = step.as_ref().filter(|step| MAX_INCREMENTS < (to - from) / step.value()) {
            let increments = (to - from) / number.value();
            let message =
                format!("a `step` of {} makes {increments:.0} increments, more than {MAX_INCREMENTS:.0}", shown(step));
            return Err((Some(number), message, "give a longer `step`, or `tolerance` for increments by their error"));
        }
        Ok(span)
    }
}
