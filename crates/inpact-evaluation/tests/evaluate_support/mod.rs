//! From the text of a deck and of a node table to the text of a result table: what `inpact eval` does, without files.

#![allow(dead_code, reason = "every test uses some of it")]

use inpact_evaluation::nodes::{Batch, Findings, KeptRows, NodeReader};
use inpact_evaluation::plan::{Choices, Plan, make, survey, survey_keeping};
use inpact_evaluation::results::{ResultBatch, ResultWriter};
use inpact_evaluation::{Evaluation, Tally};
use inpact_parser::deck::scan;
use inpact_parser::grammar::{Dialect, Grammar, Release};
use inpact_parser::model::{self, Model};

/// What came of a deck and a node table.
pub(crate) struct Run {
    /// The plan; none where the node table has errors.
    pub(crate) plan: Option<Plan>,
    /// The result table, empty where there is none.
    pub(crate) csv: String,
    /// What was counted.
    pub(crate) tally: Option<Tally>,
    /// Findings, a line each.
    pub(crate) findings: Vec<String>,
}

/// The model of a deck.
pub(crate) fn model_of(deck: &str) -> Model {
    read(deck, Grammar::builtin())
}

fn read(deck: &str, grammar: &Grammar) -> Model {
    model::read(&scan("deck.inp", deck.as_bytes(), grammar), grammar).0
}

/// Evaluates with no choice made.
pub(crate) fn evaluate(deck: &str, nodes: &str) -> Run {
    evaluate_with(deck, nodes, &Choices::default(), 1024)
}

/// Evaluates in batches of so many rows.
pub(crate) fn evaluate_with(deck: &str, nodes: &str, choices: &Choices, rows_of_a_batch: usize) -> Run {
    let model = match choices.dialect {
        Dialect::Abaqus => model_of(deck),
        dialect @ Dialect::Calculix => read(deck, &Grammar::new(dialect, Release::NEWEST)),
    };
    let mut findings = Findings::new("nodes.csv");
    let reader = |findings: &mut Findings| {
        let mut reader = NodeReader::open(Box::new(nodes.as_bytes()), findings).expect("a slice can be read");
        reader.set_rows_of_a_batch(rows_of_a_batch);
        reader
    };
    let first = reader(&mut findings);
    let surveyed = survey(first, &model, choices, &mut findings).expect("a slice can be read");
    let Some(surveyed) = surveyed.filter(|_| !findings.has_errors()) else {
        return Run { plan: None, csv: String::new(), tally: None, findings: lines(findings) };
    };
    let plan = make(&model, &surveyed, choices);
    if plan.outputs.is_empty() {
        plan.report_missing(&mut findings);
    }
    let mut reader = reader(&mut Findings::new("nodes.csv"));
    reader.select(&plan.selection);
    let mut evaluation = Evaluation::new(&model, &plan, choices);
    let mut output = Vec::new();
    let mut writer = ResultWriter::new(&mut output, plan.keys(), &plan.outputs).expect("a vector takes all");
    let (mut batch, mut results) = (Batch::default(), ResultBatch::default());
    while reader.read_batch(&mut batch, &mut findings).expect("a slice can be read") {
        plan.name_rows(&mut batch);
        evaluation.evaluate(&batch, &mut results);
        writer.write(&batch, &results).expect("a vector takes all");
    }
    assert_eq!(writer.finish().expect("a vector takes all"), plan.rows, "rows out are rows in");
    let tally = evaluation.finish();
    tally.report(&plan, &mut findings);
    let csv = String::from_utf8_lossy(&output).into_owned();
    Run { plan: Some(plan), csv, tally: Some(tally), findings: lines(findings) }
}

/// Evaluates in batches of so many rows, in so many shares, from rows of which `room` bytes are kept in memory.
pub(crate) fn evaluate_kept(
    deck: &str,
    nodes: &str,
    choices: &Choices,
    (rows_of_a_batch, shares, room): (usize, usize, usize),
) -> (String, Vec<String>) {
    let model = model_of(deck);
    let mut findings = Findings::new("nodes.csv");
    let mut reader = NodeReader::open(Box::new(nodes.as_bytes()), &mut findings).expect("a slice can be read");
    reader.set_rows_of_a_batch(rows_of_a_batch);
    let mut kept = KeptRows::new(room, Box::new(|| Ok(Box::new(std::io::Cursor::new(Vec::new())))));
    let surveyed = survey_keeping(reader, &model, choices, &mut findings, &mut kept).expect("a slice can be read");
    let Some(surveyed) = surveyed.filter(|_| !findings.has_errors()) else { return (String::new(), lines(findings)) };
    let plan = make(&model, &surveyed, choices);
    let mut rows = kept.give_back(&plan.selection).expect("memory can be read");
    let mut evaluation = Evaluation::shared_by(shares, &model, &plan, choices);
    let mut output = Vec::new();
    let mut writer = ResultWriter::new(&mut output, plan.keys(), &plan.outputs).expect("a vector takes all");
    let ran = evaluation.run(&mut rows, &plan, |batch, results| writer.write(batch, results));
    ran.expect("memory can be read").expect("a vector takes all");
    assert_eq!(writer.finish().expect("a vector takes all"), plan.rows, "rows out are rows in");
    let tally = evaluation.finish();
    tally.report(&plan, &mut findings);
    let totals = tally.interactions.iter().map(|of| format!("{:?} {:?}", of.totals, (of.rows, of.closed, of.open)));
    let said = lines(findings).into_iter().chain(totals).collect();
    (String::from_utf8_lossy(&output).into_owned(), said)
}

fn lines(findings: Findings) -> Vec<String> {
    let lines = findings.into_list().into_iter().map(|found| {
        let line = found.primary.line().map_or_else(|| "-".to_owned(), |line| line.to_string());
        let column = found.cell.and_then(|cell| cell.field).unwrap_or_else(|| "-".to_owned());
        let help = found.help.map_or_else(String::new, |help| format!(" ({help})"));
        format!("{line}:{column}: {}[{} {}] {}{help}", found.severity, found.code, found.name, found.message)
    });
    lines.collect()
}

impl Run {
    /// The plan as text.
    pub(crate) fn plan_text(&self) -> String {
        self.plan.as_ref().map_or_else(|| self.findings.join("\n"), ToString::to_string)
    }

    /// The cells of a column of the result, one a row.
    pub(crate) fn column(&self, name: &str) -> Vec<&str> {
        let mut lines = self.csv.lines();
        let header: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
        let place = header.iter().position(|header| *header == name);
        let place = place.unwrap_or_else(|| panic!("no column {name} among {header:?}; {:?}", self.findings));
        lines.map(|line| line.split(',').nth(place).expect("a cell in every row")).collect()
    }

    /// The numbers of a column of the result; NaN where a cell is empty.
    pub(crate) fn numbers(&self, name: &str) -> Vec<f64> {
        let number = |cell: &&str| if cell.is_empty() { f64::NAN } else { cell.parse().expect("a number") };
        self.column(name).iter().map(number).collect()
    }

    /// The header of the result.
    pub(crate) fn header(&self) -> &str {
        self.csv.lines().next().unwrap_or_default()
    }
}
