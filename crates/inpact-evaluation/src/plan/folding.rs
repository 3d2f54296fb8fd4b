//! Tables folded along axes whose variable is constant.

use super::planner::Planner;
use super::source::Source;
use super::{AxisPlan, FormPlan, TablePlan};
use crate::accuracy::{Method, Shape, Wanted, choose};
use crate::evaluator::Evaluator;
use crate::law::contact::ContactState;
use crate::nodes::{Column, Part};
use crate::numbers::mean;
use crate::results::Along;
use crate::table::PiecewiseTable;

/// A table in the plan.
pub(crate) fn table_plan(table: &PiecewiseTable, along: impl Fn(usize) -> Along) -> TablePlan {
    let axes = table.axes().iter().enumerate().map(|(axis, summary)| AxisPlan {
        along: along(axis),
        least: summary.least,
        greatest: summary.greatest,
        points: summary.distinct_count,
        matters: summary.matters(),
        fold: None,
        is_idle: false,
    });
    TablePlan {
        against: along(0),
        rows: table.row_count(),
        tail: table.tail(),
        ends_in_zero: false,
        axes: axes.collect(),
        folded_rows: table.row_count(),
        shape: Shape::of(table),
        not_folded: Vec::new(),
        form: None,
    }
}

/// Folds a table along every axis for which `constant` gives a value, and chooses its method; the result is recorded in the plan.
pub(crate) fn fold_and_choose(
    planner: Planner<'_>,
    table: &PiecewiseTable,
    plan: &mut TablePlan,
    constant: impl Fn(Along) -> Option<f64>,
) {
    let folded = fold(table, plan, constant);
    let mut form = form_plan(&folded, planner.choices.accuracy);
    if plan.axes.iter().any(|axis| axis.fold.is_some()) {
        // The values of a folded table are rounded once.
        form.bound = form.bound.map(|bound| bound.and_half_an_ulp(&folded));
    }
    plan.form = Some(form);
}

/// The sources of variables that a table still reads once it is folded; the first is the variable of axis `first`.
pub(crate) fn still_read(
    variables: Vec<Option<Source<Column>>>,
    tables: &[TablePlan],
    first: usize,
) -> Vec<Option<Source<Column>>> {
    let is_read = |axis: usize| tables.iter().any(|table| table.axes.get(axis).is_some_and(AxisPlan::is_read));
    (first..).zip(variables).map(|(axis, source)| source.filter(|_| is_read(axis))).collect()
}

/// The method of a table.
fn form_plan(table: &PiecewiseTable, wanted: Wanted) -> FormPlan {
    let choice = choose(table, wanted);
    let refused = choice.refused.iter().filter_map(|candidate| {
        let refusal = candidate.refusal.as_ref()?;
        Some((candidate.method.to_string(), refusal.to_string()))
    });
    let chosen = &choice.chosen;
    FormPlan {
        method: chosen.method.clone(),
        wanted,
        bound: chosen.bound,
        missed: chosen.bound.and_then(|bound| wanted.missed_by(&bound)),
        cost: chosen.cost,
        full_cost: Shape::of(table).cost(&Method::Full),
        refused: refused.collect(),
        evaluator: Evaluator::of_choice(table, choice),
    }
}

fn fold(table: &PiecewiseTable, plan: &mut TablePlan, constant: impl Fn(Along) -> Option<f64>) -> PiecewiseTable {
    let mut folded = table.clone();
    // The outermost first, which makes the others smaller.
    for (axis, of) in plan.axes.iter_mut().enumerate().rev().filter(|(_, of)| of.matters) {
        let Some(at) = constant(of.along) else { continue };
        match folded.folded(axis, at) {
            Ok(smaller) => {
                folded = smaller;
                of.fold = Some(at);
            }
            Err(refusal) => plan.not_folded.push((of.along, refusal)),
        }
    }
    plan.folded_rows = folded.row_count();
    // With the others folded away, a variable may no longer make a difference.
    for (summary, of) in folded.axes().iter().zip(&mut plan.axes) {
        of.is_idle = of.matters && of.fold.is_none() && !summary.matters();
    }
    folded
}

impl TablePlan {
    /// The evaluator of the table; `None` for one that no row reaches.
    pub(crate) fn evaluator(&self) -> Option<&Evaluator> {
        self.form.as_ref().map(|form| &form.evaluator)
    }
}

impl AxisPlan {
    /// Whether an evaluation reads its coordinate.
    pub fn is_read(&self) -> bool {
        self.matters && self.fold.is_none() && !self.is_idle
    }
}

impl Planner<'_> {
    /// The number that a column has in every row of the interaction.
    fn constant(self, column: Column) -> Option<f64> {
        let place = self.survey.columns.iter().position(|read| *read == column)?;
        let of = self.of.column(place);
        let is_whole = self.of.rows > 0 && of.present == self.of.rows && of.non_finite == 0;
        (is_whole && of.least == of.greatest).then_some(of.least)
    }

    /// The value that a source has in every row.
    pub(crate) fn constant_of(self, source: Source<Column>) -> Option<f64> {
        match source {
            Source::Cell(cell) => self.constant(cell),
            Source::Sides(slave, master) => Some(mean(self.constant(slave)?, self.constant(master)?)),
            Source::CellOrSides(..) => None,
        }
    }

    /// The clearance at which a conductance table is evaluated in every row that uses it; there are `of` tables, and beside another one only open rows use it.
    pub(crate) fn constant_clearance(self, tables: usize) -> Option<f64> {
        let open = || ContactState::Open.table_clearance(self.constant(Column::Clearance));
        match self.only_state() {
            Some(state) => state.table_clearance(self.constant(Column::Clearance)),
            None if tables > 1 => open(),
            // Closed rows read it at zero.
            None => open().filter(|clearance| *clearance == 0.0),
        }
    }

    /// The contact pressure of every row.
    pub(crate) fn constant_pressure(self) -> Option<f64> {
        self.constant(Column::Pressure)
    }

    /// The pressure at which a permeability table is read in every row: zero while open (P-34).
    pub(crate) fn constant_permeability_pressure(self) -> Option<f64> {
        match self.only_state() {
            Some(ContactState::Open) => Some(0.0),
            Some(ContactState::Closed) => self.constant_pressure(),
            _ => self.constant_pressure().filter(|pressure| *pressure == 0.0),
        }
    }

    /// The mean pore pressure of every row.
    pub(crate) fn constant_pore_pressure(self) -> Option<f64> {
        let [slave, master] = [Part::Slave, Part::Master].map(|part| self.constant(Column::PorePressure(part)));
        Some(mean(slave?, master?))
    }

    /// The state common to all rows.
    fn only_state(self) -> Option<ContactState> {
        let of = self.of;
        match of.rows {
            0 => None,
            rows if of.closed == rows => Some(ContactState::Closed),
            rows if of.open == rows => Some(ContactState::Open),
            _ => None,
        }
    }
}
