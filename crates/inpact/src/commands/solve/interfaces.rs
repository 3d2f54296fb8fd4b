//! The result table of the interfaces of a solved scene: its rows as batches of columns, evaluated as `eval` evaluates those of a node table.

use super::super::findings::{Messages, refuse_configured_errors};
use crate::commands::evaluable::kept_rows;
use crate::commands::solvable::SolvableScene;
use crate::failure::Failure;
use crate::files::ResultFile;
use inpact_diagnostics::{Cell, Diagnostic, Findings, Place};
use inpact_evaluation::Evaluation;
use inpact_evaluation::nodes::{CONTRADICTORY_RATE, KeptRows, NodeReader, Selection};
use inpact_evaluation::plan::{make, survey_keeping};
use inpact_evaluation::results::{ResultWriter, TableFormat};
use inpact_network::scene::Scene;
use std::path::Path;

/// Evaluates the rows, and writes the result.
pub(super) fn write(
    prepared: &SolvableScene,
    columns: &Selection,
    mut made: KeptRows,
    target: &Path,
    messages: Messages<'_>,
) -> Result<(), Failure> {
    let SolvableScene { settings, model, choices, name, scene, .. } = prepared;
    let unreadable = |error| Failure::read(Path::new("the interface rows"), error);
    let mut findings = Findings::new(name);
    let mut made = made.give_back(columns).map_err(unreadable)?;
    let made = std::iter::from_fn(move || made.next_batch().transpose());
    let (reader, mut rows) = (NodeReader::of_made(&columns.labels, &columns.numbers, Box::new(made)), kept_rows());
    let surveyed = survey_keeping(reader, model, choices, &mut findings, &mut rows).map_err(unreadable)?;
    let Some(surveyed) = surveyed.filter(|_| !findings.has_errors()) else {
        messages.data(prepared.quoted(of_scene(findings, scene), &messages), settings);
        return Err(Failure::Data("the interface rows of the scene cannot be evaluated".to_owned()));
    };
    let plan = make(model, &surveyed, choices);
    let mut rows = rows.give_back(&plan.selection).map_err(unreadable)?;
    let mut output = ResultFile::create(Some(target))?;
    let table_format = TableFormat::of_extension(target).unwrap_or_default();
    let mut evaluation = Evaluation::on_all_threads(model, &plan, choices);
    let written = match ResultWriter::with_format(&mut output, table_format, plan.keys(), &plan.outputs) {
        Ok(mut writer) => {
            let ran = evaluation.run(&mut rows, &plan, |batch, results| writer.write(batch, results));
            ran.map_err(unreadable)?.and_then(|()| writer.finish())
        }
        Err(error) => Err(error),
    };
    written.map_err(|error| output.failure(error))?;
    let tally = evaluation.finish();
    tally.report_user_faults(&mut findings);
    tally.report(&plan, &mut findings);
    let found = of_scene(findings, scene);
    let kept = refuse_configured_errors(&found, settings);
    messages.data(prepared.quoted(found, &messages), settings);
    kept?;
    output.finish()
}

/// Findings about the table as such about the scene, which has other lines: the row of the table gives that of the scene.
fn of_scene(findings: Findings, scene: &Scene) -> Vec<Diagnostic> {
    // Every state has a row of each interface, in the order of the scene.
    let number = |cell: &Cell| usize::try_from(cell.row?).ok()?.checked_sub(1)?.checked_rem(scene.interfaces.len());
    let placed = |found: Diagnostic| {
        let (place, message) = match found.cell.as_ref().and_then(number) {
            Some(row) => scene.interfaces[row].located(found.message),
            None => (Place::default(), found.message),
        };
        let column = found.cell.and_then(|cell| cell.field);
        let cell = Some(Cell { row: None, field: column });
        Diagnostic { primary: place.label(&found.primary.file), cell, message, ..found }
    };
    // A contradiction to a given rate was reported for the scene itself, before it was solved.
    let list = findings.into_list().into_iter().filter(|found| found.code != CONTRADICTORY_RATE.code);
    list.map(placed).collect()
}

#[cfg(test)]
mod tests {
    use super::of_scene;
    use inpact_diagnostics::{Findings, Place};
    use inpact_evaluation::nodes::NON_FINITE;
    use inpact_network::scene::{self, SceneFiles};

    struct Rows;

    impl SceneFiles for Rows {
        fn read(&mut self, _: &str) -> Option<Vec<u8>> {
            Some(b"slave,master,area\na,b,1\n".to_vec())
        }
    }

    #[test]
    fn findings_about_rows_have_the_lines_of_the_scene() {
        let text = "deck = \"d\"\n[[node]]\nname = \"a\"\n[[node]]\nname = \"b\"\n[[interface]]\nslave = \"a\"\nmaster = \"b\"\narea = 1.0\n\
                    [[interface_file]]\nfile = \"rows.csv\"\n";
        let (scene, _) = scene::read(text, "s.toml", &mut Rows);
        let mut findings = Findings::new("s.toml");
        for row in [None, Some(3), Some(4)] {
            findings.report(&NON_FINITE, Place { row, line: row, ..Place::default() }, "wrong", "");
        }
        let found: Vec<_> = of_scene(findings, &scene.expect("a scene"))
            .into_iter()
            .map(|finding| (finding.primary.line(), finding.cell.and_then(|cell| cell.row), finding.message))
            .collect();
        let in_table = "wrong (line 2 of `rows.csv`)".to_owned();
        assert_eq!(
            found,
            [(None, None, "wrong".to_owned()), (Some(6), None, "wrong".to_owned()), (None, None, in_table)]
        );
    }
}
