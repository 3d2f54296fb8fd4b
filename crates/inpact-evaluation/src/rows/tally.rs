//! Counts of an evaluation: rows in and out, contact, rows outside tables, and notes on them for the user.

use super::{Row, Totals};
use crate::evaluator::SeenError;
use crate::nodes::{BEYOND_TABLE, CONTRADICTORY_RATE, Findings, HEAT_OF_CLOSING, Place, USER_FAULT};
use crate::plan::{InteractionPlan, Plan, TablePlan};
use crate::results::{Along, Output, Status, push_number};
use crate::table::{Sides, Tail};
use inpact_diagnostics::Severity;
use inpact_parser::model::Name;

/// The index of the permeability table among the tables of an interaction; 0 is conductance against clearance, 1 against pressure.
pub(crate) const PERMEABILITY: usize = 2;

/// The index of the table of thermal conductance against clearance; that against pressure follows.
pub(crate) const THERMAL_CONDUCTANCE: usize = 3;

/// The index of the table of view factors.
pub(crate) const VIEW_FACTOR: usize = 5;

/// Counts over all rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Tally {
    /// The number of input rows.
    pub rows: u64,
    /// The counts of each interaction of the model, in its order.
    pub interactions: Vec<InteractionTally>,
    /// The outputs of which there are totals.
    pub summed: Vec<Output>,
    /// The first rows of each interaction in which a user's routine gave no conductance.
    pub user_faults: Vec<UserFaultInRow>,
}

/// A row in which a user's routine gave an invalid conductance.
#[derive(Debug, Clone, PartialEq)]
pub struct UserFaultInRow {
    /// Where it is.
    pub place: Place,
    /// Its arguments and its result.
    pub message: String,
}

/// Counts over the rows of one interaction.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct InteractionTally {
    /// The number of rows it governs.
    pub rows: u64,
    /// The number of closed rows, by the columns that its laws read; the plan counts with all columns.
    pub closed: u64,
    /// The number of open rows.
    pub open: u64,
    /// The number of rows with status `beyond_table` by one of their laws.
    pub beyond_table: u64,
    /// The number of rows with status `cutoff` by one of their laws.
    pub cutoff: u64,
    /// The number of rows with status `constrained` by one of their laws.
    pub constrained: u64,
    /// The number of rows that lack a number needed by a law.
    pub incomplete: u64,
    /// The number of rows with a conductance, but no jump of potential.
    pub incomplete_flows: u64,
    /// The number of rows that lack the characteristic element length where it decides.
    pub needs_length: u64,
    /// The number of rows whose jump of potential is below 1e-8 of the potentials from which it is computed.
    pub lost_digits: u64,
    /// The number of rows whose node label is not a number, for a user's routine that is called with one.
    pub unnumbered_nodes: u64,
    /// The sums over its rows of the latest time.
    pub totals: Totals,
    /// The largest error of its conductances in a sample of rows.
    pub seen_error: SeenError,
    /// The number of rows without a conductance because a user's routine gave none.
    pub user_faults: u64,
    /// The number of rows that lack a number on which the heat at the interface depends.
    pub incomplete_heat: u64,
    /// The number of rows outside the curves of CalculiX, or outside the pressures common to two neighbouring curves.
    pub beyond_curves: u64,
    /// The number of rows with a temperature below absolute zero.
    pub below_absolute_zero: u64,
    /// The number of rows with shear and slip rate of opposite signs, and so a negative heat of friction.
    pub negative_friction: u64,
    /// Rows that include the jump of an open circuit in the heat of the increment that closes it (D022).
    pub closing: RemarkedRows,
    /// Rows whose given rate contradicts the change of their clearance (D021).
    pub contradictory_rates: RemarkedRows,
    /// For each table the rows outside its range along each axis: conductance against clearance, against pressure, permeability,
    /// thermal conductance against clearance, against pressure, view factor.
    pub axes: [Vec<AxisTally>; 6],
}

/// Rows with a remark: their number and the remark on the first of them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RemarkedRows {
    /// The number of rows.
    pub rows: u64,
    /// The first row and the remark on it.
    pub first: Option<(Place, String)>,
}

impl RemarkedRows {
    /// Counts a row; `what` is the remark on the first.
    pub(crate) fn count(&mut self, row: Row<'_, '_>, what: impl FnOnce() -> String) {
        self.rows += 1;
        if self.first.is_none() {
            self.first = Some((row.part.place(row.index), what()));
        }
    }
}

impl RemarkedRows {
    /// Merges those of another thread; the remark is that of the first row of all.
    fn merge(&mut self, other: Self) {
        self.rows += other.rows;
        let row = |first: &Option<(Place, String)>| {
            first.as_ref().map_or(u64::MAX, |(place, _)| place.row.unwrap_or(u64::MAX))
        };
        if row(&other.first) < row(&self.first) {
            self.first = other.first;
        }
    }
}

/// Rows outside a table along one axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct AxisTally {
    /// Below its first abscissa.
    pub below: u64,
    /// Above its last abscissa.
    pub above: u64,
}

impl Tally {
    pub(crate) fn new(plan: &Plan, summed: Vec<Output>, interactions: usize) -> Self {
        let mut tally = Self {
            rows: 0,
            interactions: vec![InteractionTally::default(); interactions],
            summed,
            user_faults: Vec::new(),
        };
        for interaction in &plan.interactions {
            for (table, planned) in tables(interaction) {
                tally.interactions[interaction.index].axes[table] = vec![AxisTally::default(); planned.axes.len()];
            }
        }
        tally
    }

    /// Merges the counts of another thread; the totals are summed elsewhere.
    pub(crate) fn merge(&mut self, other: Self) {
        self.rows += other.rows;
        for (own, other) in self.interactions.iter_mut().zip(other.interactions) {
            own.merge(other);
        }
        self.user_faults.extend(other.user_faults);
    }

    /// The sum of one count over all interactions.
    pub fn total(&self, count: impl Fn(&InteractionTally) -> u64) -> u64 {
        self.interactions.iter().map(count).sum()
    }

    /// The counts of all interactions together; those of single axes belong to one table, totals to one interface, and are left out.
    pub fn whole(&self) -> InteractionTally {
        InteractionTally {
            rows: self.total(|of| of.rows),
            closed: self.total(|of| of.closed),
            open: self.total(|of| of.open),
            beyond_table: self.total(|of| of.beyond_table),
            cutoff: self.total(|of| of.cutoff),
            constrained: self.total(|of| of.constrained),
            incomplete: self.total(|of| of.incomplete),
            incomplete_flows: self.total(|of| of.incomplete_flows),
            needs_length: self.total(|of| of.needs_length),
            lost_digits: self.total(|of| of.lost_digits),
            incomplete_heat: self.total(|of| of.incomplete_heat),
            beyond_curves: self.total(|of| of.beyond_curves),
            below_absolute_zero: self.total(|of| of.below_absolute_zero),
            negative_friction: self.total(|of| of.negative_friction),
            unnumbered_nodes: self.total(|of| of.unnumbered_nodes),
            user_faults: self.total(|of| of.user_faults),
            closing: RemarkedRows::default(),
            contradictory_rates: RemarkedRows::default(),
            seen_error: self.interactions.iter().fold(SeenError::default(), |mut seen, of| {
                seen.merge(&of.seen_error);
                seen
            }),
            totals: Totals::default(),
            axes: Default::default(),
        }
    }

    /// Reports the rows in which a user's routine gave no conductance (D010).
    pub fn report_user_faults(&self, findings: &mut Findings) {
        let count = self.total(|of| of.user_faults);
        for UserFaultInRow { place, message } in &self.user_faults {
            let rows = if count == 1 { "in 1 row".to_owned() } else { format!("in {count} rows, all told") };
            let help = format!("{rows}: mend the routine, and compile it again");
            findings.report(&USER_FAULT, place.clone(), message.clone(), help);
        }
    }

    /// Reports rows whose rate contradicts their clearance (D021), and those that close a circuit (D022).
    fn report_histories(&self, plan: &Plan, findings: &mut Findings) {
        for interaction in &plan.interactions {
            let (of, name) = (&self.interactions[interaction.index], &interaction.name);
            let rows = |count: u64| if count == 1 { "1 row".to_owned() } else { format!("{count} rows") };
            if let Some((place, first)) = &of.contradictory_rates.first {
                let message = format!(
                    "`clearance_rate` contradicts the clearance in {} of `{name}`: {first}",
                    rows(of.contradictory_rates.rows)
                );
                let help = "PFL and PTL go by the rate: mend it, or leave the column out so that the rate follows from the clearance";
                findings.report(&CONTRADICTORY_RATE, place.clone(), message, help);
            }
            if let Some((place, first)) = &of.closing.first {
                let message = format!(
                    "the heat of the current takes the jump of an open circuit in {} of `{name}`: {first}",
                    rows(of.closing.rows)
                );
                let help = "the manual's mean over the increment (H-08) is right where the conductance changes little: \
                            give a row right after the circuit has closed, and count heat from there";
                findings.report(&HEAT_OF_CLOSING, place.clone(), message, help);
            }
        }
    }

    /// Reports rows beyond the tables, axis by axis (D007); beyond the last clearance of an electrical table it is a warning.
    pub fn report(&self, plan: &Plan, findings: &mut Findings) {
        self.report_histories(plan, findings);
        for interaction in &plan.interactions {
            for (table, planned) in tables(interaction) {
                let counts = &self.interactions[interaction.index].axes[table];
                let what = match table {
                    PERMEABILITY => "permeability",
                    VIEW_FACTOR => "view factor",
                    THERMAL_CONDUCTANCE.. => "thermal conductance",
                    _ => "conductance",
                };
                for (axis, count) in planned.axes.iter().zip(counts) {
                    let ends = [(count.below, axis.least, "below"), (count.above, axis.greatest, "above")];
                    for (rows, end, side) in ends.into_iter().filter(|(rows, ..)| *rows > 0) {
                        let Beyond { severity, help } = beyond(planned, table, axis.along, side);
                        let table = TableLabel { name: &interaction.name, what, against: planned.against };
                        let message = table.message(axis.along, rows, side, end);
                        let place = Place { column: Some(axis.along.to_string()), ..Place::default() };
                        findings.report_as(severity, &BEYOND_TABLE, place, message, help);
                    }
                }
            }
        }
    }
}

/// The severity and message for rows beyond a table.
struct Beyond {
    severity: Severity,
    help: &'static str,
}

fn beyond(planned: &TablePlan, table: usize, along: Along, side: &str) -> Beyond {
    if table >= THERMAL_CONDUCTANCE && along == Along::Clearance && side == "above" {
        // There is no choice: it is zero by the text of the manual (K-31, T-27).
        return Beyond { severity: Severity::Note, help: "it is zero there" };
    }
    if table != PERMEABILITY && along == Along::Clearance && side == "above" {
        if planned.ends_in_zero {
            return Beyond { severity: Severity::Note, help: "the conductance is zero there" };
        }
        let help = match planned.tail {
            Tail::Constant => {
                "the last value is kept, as the words of the manual have it; its figure has zero: `--clearance-tail zero`"
            }
            Tail::Zero => "the conductance is zero there, as chosen",
        };
        return Beyond { severity: Severity::Warning, help };
    }
    Beyond { severity: Severity::Note, help: "the value at the end of the table is kept" }
}

/// The table that a message is about.
struct TableLabel<'a> {
    name: &'a Name,
    what: &'a str,
    against: Along,
}

impl TableLabel<'_> {
    fn message(&self, along: Along, rows: u64, side: &str, end: f64) -> String {
        let Self { name, what, against } = self;
        let mut number = Vec::new();
        push_number(&mut number, end);
        let number = String::from_utf8_lossy(&number).into_owned();
        let lie = if rows == 1 { "1 row lies".to_owned() } else { format!("{rows} rows lie") };
        let end = if side == "below" { "first" } else { "last" };
        format!("{lie} {side} the {end} `{along}` of the table of {what} against {against} of `{name}`, {number}")
    }
}

/// The tables of an interaction in use, with their indices.
fn tables(interaction: &InteractionPlan) -> impl Iterator<Item = (usize, &TablePlan)> {
    let electrical = interaction.electrical.iter().flat_map(|law| &law.tables);
    let electrical = electrical.map(|table| (usize::from(table.against == Along::Pressure), table));
    let pore = interaction.pore.iter().filter_map(|law| law.table.as_ref());
    let thermal = interaction.thermal.iter();
    let conductance = thermal.clone().filter_map(|law| law.conduction.as_ref()).flat_map(|law| &law.tables);
    let conductance =
        conductance.map(|table| (THERMAL_CONDUCTANCE + usize::from(table.against == Along::Pressure), table));
    let view_factor = thermal.filter_map(|law| Some((VIEW_FACTOR, &law.radiation.as_ref()?.table)));
    electrical.chain(pore.map(|table| (PERMEABILITY, table))).chain(conductance).chain(view_factor)
}

impl InteractionTally {
    fn merge(&mut self, other: Self) {
        let counts = [
            (&mut self.rows, other.rows),
            (&mut self.closed, other.closed),
            (&mut self.open, other.open),
            (&mut self.beyond_table, other.beyond_table),
            (&mut self.cutoff, other.cutoff),
            (&mut self.constrained, other.constrained),
            (&mut self.incomplete, other.incomplete),
            (&mut self.incomplete_flows, other.incomplete_flows),
            (&mut self.needs_length, other.needs_length),
            (&mut self.lost_digits, other.lost_digits),
            (&mut self.unnumbered_nodes, other.unnumbered_nodes),
            (&mut self.user_faults, other.user_faults),
            (&mut self.incomplete_heat, other.incomplete_heat),
            (&mut self.beyond_curves, other.beyond_curves),
            (&mut self.below_absolute_zero, other.below_absolute_zero),
            (&mut self.negative_friction, other.negative_friction),
        ];
        for (own, other) in counts {
            *own += other;
        }
        self.seen_error.merge(&other.seen_error);
        self.closing.merge(other.closing);
        self.contradictory_rates.merge(other.contradictory_rates);
        for (own, other) in self.axes.iter_mut().flatten().zip(other.axes.iter().flatten()) {
            own.below += other.below;
            own.above += other.above;
        }
    }

    /// Counts a row with an invalid conductance; true for the few that are shown.
    #[cold]
    pub(crate) fn count_fault(&mut self) -> bool {
        /// The number of rows shown.
        const MOST: u64 = 20;
        self.user_faults += 1;
        self.user_faults <= MOST
    }

    #[inline]
    pub(crate) fn count_statuses(&mut self, statuses: [Option<Status>; 3]) {
        // Most rows are within all tables.
        if statuses.iter().flatten().all(|status| *status <= Status::Closed) {
            return;
        }
        let count = |status| u64::from(statuses.contains(&Some(status)));
        self.beyond_table += count(Status::BeyondTable);
        self.cutoff += count(Status::Cutoff);
        self.constrained += count(Status::Constrained);
    }

    #[cold]
    pub(crate) fn count_sides(&mut self, table: usize, sides: Sides) {
        for (axis, count) in self.axes[table].iter_mut().enumerate() {
            count.below += u64::from(sides.is_below(axis));
            count.above += u64::from(sides.is_above(axis));
        }
    }
}
