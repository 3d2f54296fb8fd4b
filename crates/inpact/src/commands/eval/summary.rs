//! What an evaluation did, for standard error: as text for a person, as JSON for a program.

use inpact_evaluation::evaluate::{InteractionTally, Tally};
use inpact_evaluation::plan::{InteractionPlan, Plan, Reason, TablePlan};
use inpact_evaluation::results::{Output, push_number, rounded_up};
use serde::Serialize;
use std::collections::BTreeMap;
use std::time::Duration;

/// Up to so many interactions each has a line in the summary; more have one together.
const MOST_INTERACTIONS: usize = 12;

/// What an evaluation did, for standard error.
pub(super) struct Summary<'a> {
    pub(super) tally: &'a Tally,
    pub(super) plan: &'a Plan,
    pub(super) rows_out: u64,
    pub(super) time: Duration,
}

impl Summary<'_> {
    /// Lines for a person.
    pub(super) fn text(&self) -> Vec<String> {
        let seconds = self.time.as_secs_f64();
        let mut lines = vec![format!("{} in, {} out, {seconds:.3} s", rows(self.tally.rows), rows(self.rows_out))];
        if self.plan.interactions.len() > MOST_INTERACTIONS {
            let whole = self.tally.whole();
            lines.push(format!("  {} interactions: {}", self.plan.interactions.len(), counts(&whole)));
            lines.extend(remarks(&whole).into_iter().map(|remark| format!("    {remark}")));
            return lines;
        }
        for interaction in &self.plan.interactions {
            let of = &self.tally.interactions[interaction.index];
            lines.push(format!("  {}: {}", interaction.name, counts(of)));
            lines.extend(remarks(of).into_iter().map(|remark| format!("    {remark}")));
            if interaction.electrical.as_ref().is_some_and(|law| law.user.is_some()) {
                lines.extend(interaction.notes.iter().map(|note| format!("    note: {note}")));
            }
            lines.extend(totals(&self.tally.summed, interaction, of).map(|line| format!("    {line}")));
            lines.extend(accuracy(interaction, of).into_iter().map(|line| format!("    {line}")));
            let laws_and_outputs =
                interaction.left_out.iter().filter(|left_out| matches!(left_out.reason, Reason::Missing(_)));
            for left_out in laws_and_outputs {
                lines.push(format!("    without {}: {}", left_out.what, left_out.reason));
            }
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
            closed: of.closed,
            open: of.open,
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
            unnumbered_nodes: of.unnumbered_nodes,
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
    unnumbered_nodes: u64,
    totals: BTreeMap<String, f64>,
    totals_time: Option<f64>,
    tables: Vec<TableRecord>,
    largest_error_seen: Option<SeenErrorRecord>,
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

/// `300 rows, 212 closed, 88 open, 12 beyond a table`.
fn counts(of: &InteractionTally) -> String {
    let mut counts = vec![rows(of.rows), format!("{} closed", of.closed), format!("{} open", of.open)];
    let others = [
        (of.beyond_table, "beyond a table"),
        (of.cutoff, "beyond the cutoff of flow across"),
        (of.constrained, "constrained to equal pore pressures"),
    ];
    counts.extend(others.into_iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}")));
    counts.join(", ")
}

/// What the rows of the latest time add up to.
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

/// How exactly the tables of an interaction were evaluated: mode, bound, and the largest error seen.
fn accuracy(plan: &InteractionPlan, of: &InteractionTally) -> Vec<String> {
    let forms = plan.tables().filter_map(|(what, table)| Some((what, table, table.form.as_ref()?)));
    let mut lines: Vec<String> = forms
        .map(|(what, table, form)| {
            let bound = form.bound.map_or_else(String::new, |bound| {
                format!(", error at most {} of the largest value", rounded_up(bound.relative_to_largest))
            });
            let missed = form
                .missed
                .map_or_else(String::new, |missed| format!(": above the tolerance of {missed:e}, which no form keeps"));
            format!("{what} against {}: {}{bound}{missed}", table.against, form.method)
        })
        .collect();
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

/// What a user should know of the rows.
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
