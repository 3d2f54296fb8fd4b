//! `inpact eval`: a deck and a node table in, a result table out.

use super::scene::{FindingFormat, Scene, SceneArguments, say_data_findings};
use crate::failure::{Failure, Outcome, say};
use crate::files::{self, ResultFile};
use clap::Args;
use inpact_evaluation::compile::compile;
use inpact_evaluation::evaluate::{Evaluation, InteractionTally, Tally};
use inpact_evaluation::nodes::{Batch, Findings, NodeReader};
use inpact_evaluation::plan::{InteractionPlan, Plan, Reason};
use inpact_evaluation::results::{ResultBatch, ResultWriter};
use serde::Serialize;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Up to so many interactions each has a line in the summary; more have one together.
const MOST_INTERACTIONS: usize = 12;

#[derive(Debug, Args)]
pub(crate) struct EvalArguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Where to write the result, instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// How to print findings and summary on standard error.
    #[arg(long, value_enum, default_value_t = FindingFormat::Concise)]
    format: FindingFormat,
}

pub(crate) fn run(arguments: &EvalArguments) -> Result<Outcome, Failure> {
    let start = Instant::now();
    files::refuse_overwriting(arguments.output.as_deref(), &arguments.scene.inputs())?;
    let format = arguments.format;
    let Some(mut scene) = arguments.scene.prepare(format)? else { return Ok(Outcome::HasErrors) };
    if scene.deck_has_errors {
        return Ok(Outcome::HasErrors);
    }
    if scene.plan.outputs.is_empty() {
        return Err(nothing_to_evaluate(&scene, format));
    }
    let mut findings = Findings::new(&scene.nodes_name);
    let evaluated = evaluate(arguments, &mut scene, &mut findings);
    say_data_findings(findings.into_list(), format);
    let (tally, rows_out) = evaluated?;
    let summary = Summary { tally: &tally, plan: &scene.plan, rows_out, time: start.elapsed() };
    match format {
        FindingFormat::Concise => summary.text().iter().for_each(|line| say(line)),
        FindingFormat::Json => say(&summary.json()),
    }
    Ok(Outcome::Clean)
}

/// Evaluates the node table batch by batch; gives the counts and the number of rows written.
fn evaluate(arguments: &EvalArguments, scene: &mut Scene, findings: &mut Findings) -> Result<(Tally, u64), Failure> {
    let nodes_path = arguments.scene.nodes_path();
    let unreadable = |error| Failure::read(nodes_path, error);
    let Scene { model, plan, choices, nodes_name, nodes, .. } = scene;
    let laws = compile(model, plan, choices);
    let mut reader = NodeReader::open(nodes.reader(nodes_path)?, findings).map_err(unreadable)?;
    reader.select(&plan.selection);
    let mut output = ResultFile::create(arguments.output.as_deref())?;
    let written = write(&mut reader, Evaluation::new(model, plan, &laws), plan, &mut output, findings);
    let (tally, rows_out) = match written {
        Ok(counts) => counts,
        Err(Stopped::Reading(error)) => return Err(unreadable(error)),
        Err(Stopped::Writing(error)) => return Err(output.failure(error)),
    };
    if tally.rows != plan.rows || rows_out != plan.rows || findings.has_errors() {
        let (first, then) = (plan.rows, tally.rows);
        let message = format!("`{nodes_name}` changed while it was read: {first} rows, then {then}");
        return Err(Failure::Data(message));
    }
    tally.report_user_faults(findings);
    if findings.has_errors() {
        return Err(Failure::Data("the user subroutine fails, and no result is written".to_owned()));
    }
    tally.report(plan, findings);
    output.finish()?;
    Ok((tally, rows_out))
}

/// Which end of an evaluation failed.
enum Stopped {
    Reading(std::io::Error),
    Writing(std::io::Error),
}

fn write(
    reader: &mut NodeReader<'_>,
    mut evaluation: Evaluation<'_>,
    plan: &Plan,
    output: &mut ResultFile,
    findings: &mut Findings,
) -> Result<(Tally, u64), Stopped> {
    let mut writer = ResultWriter::new(output, plan.keys(), &plan.outputs).map_err(Stopped::Writing)?;
    let (mut batch, mut results) = (Batch::default(), ResultBatch::default());
    while reader.read_batch(&mut batch, findings).map_err(Stopped::Reading)? {
        evaluation.evaluate(&batch, &mut results);
        writer.write(&batch, &results).map_err(Stopped::Writing)?;
    }
    Ok((evaluation.finish(), writer.rows_written()))
}

/// Says why there is nothing to evaluate: the columns that are missing, or what else is in the way.
fn nothing_to_evaluate(scene: &Scene, format: FindingFormat) -> Failure {
    let mut findings = Findings::new(&scene.nodes_name);
    scene.plan.report_missing(&mut findings);
    say_data_findings(findings.into_list(), format);
    let reasons = scene.plan.interactions.iter().flat_map(|interaction| {
        let others = interaction.left_out.iter().filter(|left_out| !matches!(left_out.reason, Reason::Missing(_)));
        others.map(move |left_out| format!("{} of `{}`: {}", left_out.what, interaction.name, left_out.reason))
    });
    let reasons: Vec<String> = reasons.collect();
    let reasons = if reasons.is_empty() { String::new() } else { format!(" ({})", reasons.join("; ")) };
    Failure::Data(format!("nothing of `{}` can be evaluated on these rows{reasons}", scene.deck_name))
}

/// What an evaluation did, for standard error.
struct Summary<'a> {
    tally: &'a Tally,
    plan: &'a Plan,
    rows_out: u64,
    time: Duration,
}

impl Summary<'_> {
    fn text(&self) -> Vec<String> {
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
            lines.extend(accuracy(interaction, of).into_iter().map(|line| format!("    {line}")));
            let laws_and_outputs =
                interaction.left_out.iter().filter(|left_out| matches!(left_out.reason, Reason::Missing(_)));
            for left_out in laws_and_outputs {
                lines.push(format!("    without {}: {}", left_out.what, left_out.reason));
            }
        }
        lines
    }

    fn json(&self) -> String {
        #[derive(Serialize)]
        struct Record<'a> {
            rows_in: u64,
            rows_out: u64,
            seconds: f64,
            interactions: Vec<Interaction<'a>>,
        }
        #[derive(Serialize)]
        struct Interaction<'a> {
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
            tables: Vec<Table>,
            largest_error_seen: Option<SeenError>,
        }
        #[derive(Serialize)]
        struct Table {
            what: &'static str,
            against: String,
            method: String,
            bound_relative_to_largest: Option<f64>,
            bound_pointwise: Option<f64>,
        }
        #[derive(Serialize)]
        struct SeenError {
            rows: u64,
            relative_to_largest: f64,
            pointwise: f64,
        }
        #[derive(Serialize)]
        struct Line<'a> {
            summary: Record<'a>,
        }
        let interactions = self.plan.interactions.iter().map(|interaction| {
            let of = &self.tally.interactions[interaction.index];
            Interaction {
                name: interaction.name.written(),
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
                tables: interaction
                    .tables()
                    .filter_map(|(what, table)| {
                        let form = table.form.as_ref()?;
                        Some(Table {
                            what,
                            against: table.against.to_string(),
                            method: form.method.to_string(),
                            bound_relative_to_largest: form.bound.map(|bound| bound.relative_to_largest),
                            bound_pointwise: form.bound.map(|bound| bound.pointwise),
                        })
                    })
                    .collect(),
                largest_error_seen: Some(of.seen_error).filter(|seen| seen.rows > 0).map(|seen| SeenError {
                    rows: seen.rows,
                    relative_to_largest: seen.relative_to_largest,
                    pointwise: seen.pointwise,
                }),
            }
        });
        let summary = Record {
            rows_in: self.tally.rows,
            rows_out: self.rows_out,
            seconds: self.time.as_secs_f64(),
            interactions: interactions.collect(),
        };
        // A record of strings and numbers has no reason to fail.
        serde_json::to_string(&Line { summary }).unwrap_or_default()
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

/// How exactly the tables of an interaction were evaluated: mode, bound, and the largest error seen.
fn accuracy(plan: &InteractionPlan, of: &InteractionTally) -> Vec<String> {
    let forms = plan.tables().filter_map(|(what, table)| Some((what, table, table.form.as_ref()?)));
    let mut lines: Vec<String> = forms
        .map(|(what, table, form)| {
            let bound = form.bound.map_or_else(String::new, |bound| {
                format!(", error at most {:.1e} of the largest value", bound.relative_to_largest)
            });
            format!("{what} against {}: {}{bound}", table.against, form.method)
        })
        .collect();
    let seen = of.seen_error;
    if seen.rows > 0 {
        lines.push(format!(
            "largest error seen in {} against the reference: {:.1e} of the largest value, {:.1e} of the value itself",
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
