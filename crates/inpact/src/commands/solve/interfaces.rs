//! The result table of the interfaces of a solved scene: its rows as a node table, evaluated as `eval` evaluates one.

use super::super::findings::{FindingFormat, say_data_findings};
use crate::commands::solvable::SolvableScene;
use crate::failure::Failure;
use crate::files::ResultFile;
use inpact_evaluation::compile::compile;
use inpact_evaluation::evaluate::Evaluation;
use inpact_evaluation::nodes::{Batch, Findings, NodeReader};
use inpact_evaluation::plan::{make, survey};
use inpact_evaluation::results::{ResultBatch, ResultWriter, TableFormat};
use std::io::{self, Cursor};
use std::path::Path;

/// Evaluates rows that stand in a table of comma-separated values, and writes the result.
pub(super) fn write(
    prepared: &SolvableScene,
    table: Vec<u8>,
    target: &Path,
    format: FindingFormat,
) -> Result<(), Failure> {
    let SolvableScene { model, choices, name, .. } = prepared;
    let unreadable = |error| Failure::read(Path::new("the interface rows"), error);
    let mut findings = Findings::new(name);
    let reader = NodeReader::open_any(Box::new(Cursor::new(table.clone())), &mut findings).map_err(unreadable)?;
    let surveyed = survey(reader, model, choices, &mut findings).map_err(unreadable)?;
    let Some(surveyed) = surveyed.filter(|_| !findings.has_errors()) else {
        say_data_findings(findings.into_list(), format);
        return Err(Failure::Data("the interface rows of the scene cannot be evaluated".to_owned()));
    };
    let plan = make(model, &surveyed, choices);
    let laws = compile(model, &plan, choices);
    let mut reader = NodeReader::open_any(Box::new(Cursor::new(table)), &mut findings).map_err(unreadable)?;
    reader.select(&plan.selection);
    let mut output = ResultFile::create(Some(target))?;
    let table_format = TableFormat::of_extension(target).unwrap_or_default();
    let mut evaluation = Evaluation::new(model, &plan, &laws);
    let written = (|| -> io::Result<()> {
        let mut writer = ResultWriter::with_format(&mut output, table_format, plan.keys(), &plan.outputs)?;
        let (mut batch, mut results) = (Batch::default(), ResultBatch::default());
        while reader.read_batch(&mut batch, &mut findings)? {
            evaluation.evaluate(&batch, &mut results);
            writer.write(&batch, &results)?;
        }
        writer.finish().map(drop)
    })();
    written.map_err(|error| output.failure(error))?;
    let tally = evaluation.finish();
    tally.report_user_faults(&mut findings);
    tally.report(&plan, &mut findings);
    say_data_findings(findings.into_list(), format);
    output.finish()
}
