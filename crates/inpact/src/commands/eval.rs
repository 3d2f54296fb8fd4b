//! `inpact eval`: a deck and a node table in, a result table out.

mod drawing;
mod summary;

use self::drawing::evaluate_and_draw;
use self::summary::Summary;
use super::evaluable::{Evaluable, EvaluableArguments, other_reasons};
use super::findings::{Messages, refuse_configured_errors, with_messages};
use super::laws::LawArguments;
use super::table_output::TableOutput;
use crate::failure::{Failure, Outcome};
use crate::files::{self, ResultFile};
use crate::render::Format;
use crate::settings::DeckArguments;
use crate::text::counted;
use clap::Args;
use inpact_diagnostics::visible::visible_line;
use inpact_evaluation::nodes::{Findings, KeptRowsIter};
use inpact_evaluation::plan::Plan;
use inpact_evaluation::results::{ResultWriter, TableFormat};
use inpact_evaluation::{Evaluation, Tally};
use serde_json::json;
use std::io::{self, ErrorKind};
use std::time::Instant;

#[derive(Debug, Args)]
pub(crate) struct EvalArguments {
    #[command(flatten)]
    evaluable: EvaluableArguments,
    #[command(flatten)]
    laws: LawArguments,
    #[command(flatten)]
    reading: DeckArguments,
    #[command(flatten)]
    output: TableOutput,
    /// How to print findings and summary on standard error.
    #[arg(long, value_enum, default_value_t = Format::Concise)]
    format: Format,
}

pub(crate) fn run(arguments: &EvalArguments) -> Result<Outcome, Failure> {
    with_messages(arguments.format, |messages| arguments.evaluable.with_threads(|| run_on_threads(arguments, messages)))
}

fn run_on_threads(arguments: &EvalArguments, messages: Messages<'_>) -> Result<Outcome, Failure> {
    let start = Instant::now();
    files::name_as_inputs(&arguments.evaluable.inputs());
    files::check_targets(&[arguments.output.target()])?;
    let prepared = arguments.evaluable.prepare(&arguments.laws, &arguments.reading, messages)?;
    let Some(mut evaluable) = prepared else { return Ok(Outcome::HasErrors) };
    // The included files are known now.
    files::check_targets(&[arguments.output.target()])?;
    if evaluable.deck_has_errors {
        return Ok(Outcome::HasErrors);
    }
    if evaluable.plan.outputs.is_empty() {
        return Err(nothing_to_evaluate(&evaluable, messages));
    }
    let mut findings = Findings::new(&evaluable.nodes_name);
    let mut went_out = 0;
    let evaluated = match arguments.output.picture() {
        Some(target) => evaluate_and_draw(&mut evaluable, target, arguments.evaluable.nodes_path(), &mut findings),
        None => evaluate(arguments, &mut evaluable, &mut findings, &mut went_out),
    };
    evaluable.say(findings, messages);
    if evaluated.as_ref().is_err_and(|failure| went_out > 0 && !failure.is_closed_pipe()) {
        messages.line(&format!("note: {} went out before this", counted(went_out, "row")));
    }
    let (tally, rows_out) = evaluated?;
    let summary = Summary { tally: &tally, plan: &evaluable.plan, rows_out, time: start.elapsed() };
    messages.tell(|| summary.text(), || summary.json());
    if let Some(made) = &evaluable.made {
        let lines = || {
            let head = format!("rows of the {}:", evaluable.nodes_name);
            let lines = std::iter::once(&head).chain(&made.summary.lines);
            lines.map(|line| visible_line(line).into_owned()).collect()
        };
        messages.tell(lines, || json!({ "nodes": made.summary.value }).to_string());
    }
    Ok(Outcome::Clean)
}

/// Evaluates the node table; returns the counts and the number of rows written. `went_out` is the number of rows that cannot be undone.
fn evaluate(
    arguments: &EvalArguments,
    evaluable: &mut Evaluable,
    findings: &mut Findings,
    went_out: &mut u64,
) -> Result<(Tally, u64), Failure> {
    let nodes_path = arguments.evaluable.nodes_path();
    let unreadable = |error| Failure::read(nodes_path, error);
    let Evaluable { settings, model, plan, choices, nodes_name, rows, .. } = evaluable;
    let mut rows = rows.give_back(&plan.selection).map_err(unreadable)?;
    let mut output = ResultFile::create(arguments.output.target())?;
    let evaluation = Evaluation::on_all_threads(model, plan, choices);
    let mut rows_out = 0;
    let written = write(&mut rows, evaluation, plan, (&mut output, arguments.output.format()), &mut rows_out);
    *went_out = if output.is_stream() { rows_out } else { 0 };
    let tally = written.map_err(unreadable)?.map_err(|error| match error.kind() {
        // A value that a column of the format cannot hold is a fault of the data, not of the output file.
        ErrorKind::InvalidData => Failure::Data(format!("`{nodes_name}` cannot be written in this format: {error}")),
        _ => output.failure(error),
    })?;
    tally.report_user_faults(findings);
    if findings.has_errors() {
        let result = if output.is_stream() { "the rows it fails in have no result" } else { "no result is written" };
        return Err(Failure::Data(format!("the user subroutine fails, and {result}")));
    }
    tally.report(plan, findings);
    refuse_configured_errors(findings.list(), settings)?;
    output.finish()?;
    Ok((tally, rows_out))
}

/// Writes all results; an error of reading rows, or in the inner result one of writing.
fn write(
    rows: &mut KeptRowsIter,
    mut evaluation: Evaluation<'_>,
    plan: &Plan,
    (output, format): (&mut ResultFile, TableFormat),
    rows_out: &mut u64,
) -> io::Result<io::Result<Tally>> {
    let mut writer = match ResultWriter::with_format(output, format, plan.keys(), &plan.outputs) {
        Ok(writer) => writer,
        Err(error) => return Ok(Err(error)),
    };
    let ran = evaluation.run(rows, plan, |batch, results| {
        writer.write(batch, results)?;
        *rows_out = writer.rows_written();
        Ok(())
    })?;
    Ok(ran.and_then(|()| writer.finish()).map(|_| evaluation.finish()))
}

/// Reports why there is nothing to evaluate: missing columns, or other obstacles.
fn nothing_to_evaluate(evaluable: &Evaluable, messages: Messages<'_>) -> Failure {
    let mut findings = Findings::new(&evaluable.nodes_name);
    evaluable.plan.report_missing(&mut findings);
    messages.data(findings.into_list(), &evaluable.settings);
    let reasons: Vec<String> = other_reasons(&evaluable.plan).collect();
    let reasons = if reasons.is_empty() { String::new() } else { format!(" ({})", reasons.join("; ")) };
    Failure::Data(format!("nothing of `{}` can be evaluated on these rows{reasons}", evaluable.deck_name))
}

/// The summary of an evaluation as in `eval`, without the time.
pub(super) fn summary_lines(tally: &Tally, plan: &Plan) -> Vec<String> {
    let summary = Summary { tally, plan, rows_out: tally.rows, time: std::time::Duration::ZERO };
    std::iter::once(counted(tally.rows, "row")).chain(summary.of_interactions()).collect()
}
