//! Results as a picture: on the slave surfaces of the deck's mesh, with the numeric columns that were read.

use super::super::evaluable::Evaluable;
use super::super::findings::refuse_configured_errors;
use super::super::picture::PictureWriter;
use crate::failure::Failure;
use inpact_evaluation::nodes::{Column, Findings, Selection};
use inpact_evaluation::plan::Plan;
use inpact_evaluation::{Evaluation, Tally};
use std::path::Path;

/// Evaluates the rows of a mesh and draws them; returns the counts and the number of rows.
pub(super) fn evaluate_and_draw(
    evaluable: &mut Evaluable,
    target: &Path,
    deck: &Path,
    findings: &mut Findings,
) -> Result<(Tally, u64), Failure> {
    let Evaluable { settings, model, plan, choices, rows, made, .. } = evaluable;
    let Some(made) = made else {
        let message =
            "a picture needs rows that are made of the deck's mesh: leave `--nodes` out, or name a table with `-o`";
        return Err(Failure::Usage(message.to_owned()));
    };
    let unreadable = |error| Failure::read(deck, error);
    let selection = with_all_that_was_read(plan);
    let mut rows = rows.give_back(&selection).map_err(unreadable)?;
    let mut evaluation = Evaluation::on_all_threads(model, plan, choices);
    let numbers = &selection.numbers;
    let given: Vec<usize> = (0..numbers.len()).filter(|place| numbers[*place] != Column::Time).collect();
    let columns = given.iter().map(|place| numbers[*place].to_string());
    let names = columns.chain(plan.outputs.iter().map(ToString::to_string)).collect();
    let mut writer = PictureWriter::new(&made.drawn, target, names)?;
    let take = |batch: &_, results: &mut _| writer.take(batch, &given, results, &plan.outputs);
    evaluation.run(&mut rows, plan, take).map_err(unreadable)??;
    let tally = evaluation.finish();
    tally.report_user_faults(findings);
    if findings.has_errors() {
        return Err(Failure::Data("the user subroutine fails, and no picture is drawn".to_owned()));
    }
    tally.report(plan, findings);
    refuse_configured_errors(findings.list(), settings)?;
    writer.finish()?;
    let rows = tally.rows;
    Ok((tally, rows))
}

/// The columns that laws read, then the others with numbers: constant columns are left out of an evaluation, but not of a picture.
fn with_all_that_was_read(plan: &Plan) -> Selection {
    let mut selection = plan.selection.clone();
    for column in plan.columns.iter().filter(|column| column.range.is_some()).filter_map(|column| column.column) {
        if !selection.numbers.contains(&column) {
            selection.numbers.push(column);
        }
    }
    selection
}
