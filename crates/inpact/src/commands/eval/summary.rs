//! Summary of an evaluation for standard error: as text for users, as JSON for programs.

use inpact_evaluation::plan::{InteractionPlan, LeftOut, Plan, Reason, TablePlan};
use inpact_evaluation::results::{Output, push_number};
use inpact_evaluation::{InteractionTally, Tally};
use serde::Serialize;
use std::collections::BTreeMap;
use std::time::Duration;

/// Up to this number of interactions each has a line in the summary; more share one.
const MAX_INTERACTIONS: usize = 12;

/// Summary of an evaluation, for standard error.
pub(super) struct Summary<'a> {
    pub(super) tally: &'a Tally,
    pub(super) plan: &'a Plan,
    pub(super) rows_out: u64,
    pub(super) time: Duration,
}

impl Summary<'_> {
    /// Readable lines.
    pub(super) fn text(&self) -> Vec<String> {
        let seconds = self.time.as_secs_f64();
        let mut lines = vec![format!("{} in, {} out, {seconds:.3} s", rows(self.tally.rows), rows(self.rows_out))];
        lines.extend(self.of_interactions());
        lines
    }

    /// The lines about the interactions.
    pub(super) fn of_interactions(&self) -> Vec<String> {
        let mut lines = Vec::new();
        if self.plan.interactions.len() > MAX_INTERACTIONS {
            let whole = self.tally.whole();
            let sum = |count: fn(&InteractionPlan) -> u64| self.plan.interactions.iter().map(count).sum();
            let contact = Contact { closed: sum(|plan| plan.closed), open: sum(|plan| plan.open) };
            lines.push(format!("  {} interactions: {}", self.plan.interactions.len(), counts(&whole, contact)));
            lines.extend(remarks(&whole).into_iter().map(|remark| format!("    {remark}")));
            lines.extend(said_together(&self.plan.interactions).into_iter().map(|line| format!("    {line}")));
            return lines;
        }
        for interaction in &self.plan.interactions {
            let of = &self.tally.interactions[interaction.index];
            let contact = Contact { closed: interaction.closed, open: interaction.open };
            lines.push(format!("  {}: {}", interaction.name, counts(of, contact)));
            let said = remarks(of).into_iter().chain(said_in_plan(interaction));
            lines.extend(said.map(|line| format!("    {line}")));
            lines.extend(totals(&self.tally.summed, interaction, of).map(|line| format!("    {line}")));
            lines.extend(accuracy(interaction, of).into_iter().map(|line| format!("    {line}")));
        }
        lines
    }

    /// The same as a JSON object on one line.
    pub(super) fn json(&self) -> String {
        let summary = SummaryRecord {
            rows_in: self.tally.rows,
            rows_out: self.rows_out,
            seconds: self.time.as_secs_f64(),
            interactions: self.plan.interactions.iter().map(|plan| self.record(plan)).collect(),
        };
        // A record of strings and numbers has no reason to fail.
        serde_json::to_string(&Line { summary }).unwrap_or_default()
    }

    fn record<'b>(&'b self, plan: &'b InteractionPlan) -> InteractionRecord<'b> {
        let of = &self.tally.interactions[plan.index];
        let totals = self.tally.summed.iter().zip(of.totals.values());
        let totals = totals.filter(|(output, _)| plan.outputs.contains(output));
        InteractionRecord {
            name: plan.name.written(),
            rows: of.rows,
            closed: plan.closed,
            open: plan.open,
            beyond_table: of.beyond_table,
            cutoff: of.cutoff,
            constrained: of.constrained,
            incomplete: of.incomplete,
            incomplete_flows: of.incomplete_flows,
            needs_char_length: of.needs_length,
            lost_digits: of.lost_digits,
            incomplete_heat: of.incomplete_heat,
            beyond_curves: of.beyond_curves,
            below_absolute_zero: of.below_absolute_zero,
            negative_friction: of.negative_friction,
            closing: of.closing.rows,
            contradictory_rates: of.contradictory_rates.rows,
            unnumbered_nodes: of.unnumbered_nodes,
            electrical_regime: plan.electrical.as_ref().map(|law| law.regime.to_string()),
            pore_regime: plan.pore.as_ref().map(|law| law.regime.to_string()),
            notes: &plan.notes,
            left_out: plan.left_out.iter().map(LeftOutRecord::new).collect(),
            totals: totals.map(|(output, value)| (output.to_string(), value)).collect(),
            totals_time: of.totals.time,
            tables: plan.tables().filter_map(|(what, table)| TableRecord::new(what, table)).collect(),
            largest_error_seen: Some(of.seen_error).filter(|seen| seen.rows > 0).map(|seen| SeenErrorRecord {
                rows: seen.rows,
                relative_to_largest: seen.relative_to_largest,
                pointwise: seen.pointwise,
            }),
        }
    }
}

#[derive(Serialize)]
struct Line<'a> {
    summary: SummaryRecord<'a>,
}

#[derive(Serialize)]
struct SummaryRecord<'a> {
    rows_in: u64,
    rows_out: u64,
    seconds: f64,
    interactions: Vec<InteractionRecord<'a>>,
}

#[derive(Serialize)]
struct InteractionRecord<'a> {
    name: &'a str,
    rows: u64,
    closed: u64,
    open: u64,
    beyond_table: u64,
    cutoff: u64,
    constrained: u64,
    incomplete: u64,
    incomplete_flows: u64,
    needs_char_length: u64,
    lost_digits: u64,
    incomplete_heat: u64,
    beyond_curves: u64,
    below_absolute_zero: u64,
    negative_friction: u64,
    /// Rows that include the jump of an open circuit in the heat of the increment that closes it (D022).
    closing: u64,
    /// Rows whose given rate contradicts the change of their clearance (D021).
    contradictory_rates: u64,
    unnumbered_nodes: u64,
    electrical_regime: Option<String>,
    pore_regime: Option<String>,
    notes: &'a [String],
    left_out: Vec<LeftOutRecord<'a>>,
    totals: BTreeMap<String, f64>,
    totals_time: Option<f64>,
    tables: Vec<TableRecord>,
    largest_error_seen: Option<SeenErrorRecord>,
}

#[derive(Serialize)]
struct LeftOutRecord<'a> {
    what: &'a str,
    reason: String,
}

impl<'a> LeftOutRecord<'a> {
    fn new(left_out: &'a LeftOut) -> Self {
        Self { what: &left_out.what, reason: left_out.reason.to_string() }
    }
}

#[derive(Serialize)]
struct TableRecord {
    what: &'static str,
    against: String,
    method: String,
    bound_relative_to_largest: Option<f64>,
    bound_pointwise: Option<f64>,
    tolerance_missed: Option<f64>,
}

#[derive(Serialize)]
struct SeenErrorRecord {
    rows: u64,
    relative_to_largest: f64,
    pointwise: f64,
}

impl TableRecord {
    fn new(what: &'static str, table: &TablePlan) -> Option<Self> {
        let form = table.form.as_ref()?;
        Some(Self {
            what,
            against: table.against.to_string(),
            method: form.method.to_string(),
            bound_relative_to_largest: form.bound.map(|bound| bound.relative_to_largest),
            bound_pointwise: form.bound.map(|bound| bound.pointwise),
            tolerance_missed: form.missed,
        })
    }
}

/// `1 row`, `2 rows`.
fn rows(number: u64) -> String {
    format!("{number} row{}", if number == 1 { "" } else { "s" })
}

/// Numbers of closed and open rows: as the plan counted them, which reads all columns of contact.
#[derive(Clone, Copy)]
struct Contact {
    closed: u64,
    open: u64,
}

/// The notes of the plan on an interaction: regimes where procedures disagree, parts left out.
fn said_in_plan(plan: &InteractionPlan) -> Vec<String> {
    let regimes = [
        ("electrical law", plan.electrical.as_ref().map(|law| &law.regime)),
        ("pore fluid law", plan.pore.as_ref().map(|law| &law.regime)),
    ];
    let disputed = regimes.into_iter().filter_map(|(law, regime)| {
        let regime = regime.filter(|regime| regime.is_disputed())?;
        Some(format!("note: {law}, {regime}"))
    });
    let notes = plan.notes.iter().map(|note| format!("note: {note}"));
    // Outputs that were not requested, and tables that no row reads, are not reported.
    let is_lost = |reason: &Reason| !matches!(reason, Reason::NotRequested | Reason::NoRowClosed | Reason::NoRowOpen);
    let left_out = plan.left_out.iter().filter(|left_out| is_lost(&left_out.reason));
    let left_out = left_out.map(|left_out| format!("without {}: {}", left_out.what, left_out.reason));
    disputed.chain(notes).chain(left_out).collect()
}

/// The same for many interactions: each line once, with their number.
fn said_together(plans: &[InteractionPlan]) -> Vec<String> {
    let mut said: Vec<(String, usize)> = Vec::new();
    for line in plans.iter().flat_map(said_in_plan) {
        match said.iter_mut().find(|(before, _)| *before == line) {
            Some((_, count)) => *count += 1,
            None => said.push((line, 1)),
        }
    }
    let of = |count| if count == 1 { "1 interaction".to_owned() } else { format!("{count} interactions") };
    said.into_iter().map(|(line, count)| format!("{}: {line}", of(count))).collect()
}

/// `300 rows, 212 closed, 88 open, 12 beyond a table`.
fn counts(of: &InteractionTally, contact: Contact) -> String {
    let mut counts = vec![rows(of.rows), format!("{} closed", contact.closed), format!("{} open", contact.open)];
    let others = [
        (of.beyond_table, "beyond a table"),
        (of.cutoff, "beyond the cutoff of flow across"),
        (of.constrained, "constrained to equal pore pressures"),
    ];
    counts.extend(others.into_iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}")));
    counts.join(", ")
}

/// The sums over the rows of the latest time.
fn totals(summed: &[Output], plan: &InteractionPlan, of: &InteractionTally) -> Option<String> {
    let values: Vec<String> = summed
        .iter()
        .zip(of.totals.values())
        .filter(|(output, _)| plan.outputs.contains(output))
        .map(|(output, value)| {
            let mut number = Vec::new();
            push_number(&mut number, value);
            format!("{output} {}", String::from_utf8_lossy(&number))
        })
        .collect();
    let time = of.totals.time.map_or_else(String::new, |time| format!(" at time {time:?}"));
    (!values.is_empty() && of.totals.rows > 0)
        .then(|| format!("total of {}{time}: {}", rows(of.totals.rows), values.join(", ")))
}

/// The accuracy of the tables of an interaction: mode, bound, and the largest error seen.
fn accuracy(plan: &InteractionPlan, of: &InteractionTally) -> Vec<String> {
    let forms = plan.tables().filter_map(|(what, table)| Some((what, table, table.form.as_ref()?)));
    let mut lines: Vec<String> =
        forms.map(|(what, table, form)| format!("{what} against {}: {form}", table.against)).collect();
    let seen = of.seen_error;
    if seen.rows > 0 {
        lines.push(format!(
            "largest error of the electrical conductance seen in {} against the reference: {:.1e} of the largest value, {:.1e} of the value itself",
            rows(seen.rows),
            seen.relative_to_largest,
            seen.pointwise
        ));
    }
    lines
}

/// The remarks on the rows.
fn remarks(of: &InteractionTally) -> Vec<String> {
    let remarks = [
        (of.incomplete, "without a number that a law needs, and so without its results"),
        (of.incomplete_flows, "without potentials, and so without current"),
        (of.needs_length, "without the characteristic element length: give `char_length` or `--char-length`"),
        (
            of.lost_digits,
            "with a difference of potentials below 1e-8 of the potentials, which has lost its digits: give `epot_jump`",
        ),
        (
            of.incomplete_heat,
            "without a number that the heat at the interface depends on, and so without all of its parts",
        ),
        (
            of.beyond_curves,
            "outside the curves of CalculiX, or the pressures that two of them share: the value at the end is kept",
        ),
        (of.below_absolute_zero, "with a temperature below absolute zero"),
        (of.negative_friction, "with `shear` and `slip_rate` of opposite signs, and so a heat of friction below zero"),
        (of.unnumbered_nodes, "whose `node` is no number: the user subroutine was given NODE = 0"),
    ];
    let remarks = remarks.into_iter().filter(|(count, _)| *count > 0);
    remarks.map(|(count, what)| format!("warning: {} {what}", rows(count))).collect()
}
