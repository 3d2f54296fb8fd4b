//! A deck and a node table through the library: what `inpact eval` does, without files.

use inpact_evaluation::nodes::{Batch, Findings, NodeReader};
use inpact_evaluation::plan::{Choices, Plan, make, survey};
use inpact_evaluation::results::{ResultBatch, Status};
use inpact_evaluation::{Evaluation, InteractionTally, Tally};
use inpact_parser::deck::scan;
use inpact_parser::grammar::Grammar;
use inpact_parser::model::{self, Model};
use inpact_validation::{Severity, check};

/// A deck and node table that can be evaluated.
pub(super) struct Scene {
    pub(super) model: Model,
    pub(super) plan: Plan,
    choices: Choices,
    /// The findings about the node table that are not errors, such as `D003 non-finite`.
    pub(super) warnings: Vec<String>,
}

/// The results of one evaluation.
pub(super) struct Results {
    names: Vec<String>,
    last: Vec<Option<f64>>,
    /// The status of the last row.
    pub(super) status: Option<Status>,
    /// The counts of the only interaction.
    pub(super) tally: InteractionTally,
    /// The findings about the node table that are not errors.
    pub(super) warnings: Vec<String>,
}

impl Scene {
    /// Reads deck and node table; the errors of either, as `D006 time-not-ascending`, where there are any.
    pub(super) fn new(deck: &str, nodes: &str) -> Result<Self, Vec<String>> {
        let grammar = Grammar::builtin();
        let deck = scan("deck.inp", deck.as_bytes(), grammar);
        let (model, problems) = model::read(&deck, grammar);
        let errors = check(&deck, grammar, &model, &problems).into_iter();
        let errors = errors.filter(|found| found.severity == Severity::Error);
        let mut errors: Vec<String> = errors.map(|found| format!("{} {}", found.code, found.name)).collect();
        errors.dedup();
        let choices = Choices::default();
        let mut findings = Findings::new("nodes.csv");
        let surveyed = survey(open(nodes, &mut findings), &model, &choices, &mut findings).expect("a slice is read");
        let (bad, warnings): (Vec<_>, Vec<_>) =
            findings.into_list().into_iter().partition(|found| found.severity == Severity::Error);
        errors.extend(bad.iter().map(|found| format!("{} {}", found.code, found.name)));
        let Some(surveyed) = surveyed.filter(|_| errors.is_empty()) else { return Err(errors) };
        let warnings = warnings.iter().map(|found| format!("{} {}", found.code, found.name)).collect();
        let plan = make(&model, &surveyed, &choices);
        Ok(Self { model, plan, choices, warnings })
    }

    /// Evaluates a node table with the columns the scene was made with.
    pub(super) fn evaluate(&self, nodes: &str) -> Results {
        let mut findings = Findings::new("nodes.csv");
        let mut reader = open(nodes, &mut findings);
        reader.select(&self.plan.selection);
        self.evaluate_batches(|batch| reader.read_batch(batch, &mut findings).expect("a slice is read"))
    }

    /// Evaluates batches as long as `next` fills one.
    pub(super) fn evaluate_batches(&self, mut next: impl FnMut(&mut Batch) -> bool) -> Results {
        let mut evaluation = Evaluation::new(&self.model, &self.plan, &self.choices);
        let (mut batch, mut results) = (Batch::default(), ResultBatch::default());
        let mut last = Vec::new();
        let mut status = None;
        while next(&mut batch) {
            evaluation.evaluate(&batch, &mut results);
            last = results.numbers.iter().map(|column| column.get(batch.rows - 1)).collect();
            status = results.status[batch.rows - 1];
        }
        let Tally { mut interactions, .. } = evaluation.finish();
        let names = self.plan.outputs.iter().map(ToString::to_string).filter(|name| name != "status").collect();
        let tally = interactions.pop().unwrap_or_default();
        Results { names, last, status, tally, warnings: self.warnings.clone() }
    }
}

impl Results {
    /// Evaluates a deck on a node table; the codes of the errors where there are any.
    pub(super) fn of(deck: &str, nodes: &str) -> Result<Self, Vec<String>> {
        Ok(Scene::new(deck, nodes)?.evaluate(nodes))
    }

    /// The output of that name in the last row; `None` where it has none.
    pub(super) fn output(&self, name: &str) -> Option<f64> {
        let place = self.names.iter().position(|known| known == name)?;
        self.last[place]
    }
}

fn open<'a>(nodes: &'a str, findings: &mut Findings) -> NodeReader<'a> {
    NodeReader::open(Box::new(nodes.as_bytes()), findings).expect("a slice is read")
}
