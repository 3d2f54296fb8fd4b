//! The interface laws of a deck on record batches: Arrow in, Arrow out.

use crate::commands::evaluable::{kept_rows, other_reasons};
use crate::commands::findings::has_errors;
use crate::deck::Deck;
use crate::error::Error;
use crate::failure::Failure;
use crate::threads::with_threads;
use inpact_diagnostics::{Diagnostic, Findings, Severity};
use inpact_evaluation::arrow::array::RecordBatch;
use inpact_evaluation::arrow::datatypes::SchemaRef;
use inpact_evaluation::arrow::error::ArrowError;
use inpact_evaluation::law::{UserConductance, UserLaw};
use inpact_evaluation::nodes::{NodeReader, RecordBatches};
use inpact_evaluation::plan::{Choices, Derivatives, Plan, concerning, make, survey_keeping};
use inpact_evaluation::results::{Output, ResultRecords};
use inpact_evaluation::{Accuracy, Evaluation, HistoryStart, Tolerance, Wanted};
use inpact_parser::model::{Name, Regime};
use std::ops::ControlFlow;

/// Options of an evaluation; the defaults follow from deck and columns, with full accuracy.
#[derive(Debug, Clone, Default)]
pub struct EvaluateOptions {
    outputs: Option<Vec<String>>,
    threads: usize,
    choices: Choices,
}

/// The result of an evaluation, without its rows.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct EvaluatedTo {
    /// The key columns of the table, then the results.
    pub schema: SchemaRef,
    /// Warnings and notes about deck and rows.
    pub findings: Vec<Diagnostic>,
    /// The parts left out and why, a sentence each.
    pub notes: Vec<String>,
}

/// A result table in memory.
#[derive(Debug, Clone)]
pub struct Evaluated {
    batches: Vec<RecordBatch>,
    to: EvaluatedTo,
}

impl EvaluateOptions {
    /// Everything that deck and columns give.
    pub fn new() -> Self {
        Self::default()
    }

    /// Only these columns of results, by the names that `inpact explain columns` lists; one that cannot be computed is then an error.
    #[must_use]
    pub fn outputs<S: Into<String>>(mut self, names: impl IntoIterator<Item = S>) -> Self {
        self.outputs = Some(names.into_iter().map(Into::into).collect());
        self
    }

    /// The interaction that governs every row, overriding the column `interaction`.
    #[must_use]
    pub fn interaction(mut self, name: &str) -> Self {
        self.choices.interaction = Some(Name::new(name));
        self
    }

    /// Steady state or transient, overriding the deck's procedures.
    #[must_use]
    pub fn regime(mut self, regime: Regime) -> Self {
        self.choices.regime = Some(regime);
        self
    }

    /// Sets the accuracy of tables.
    #[must_use]
    pub fn accuracy(mut self, accuracy: Accuracy) -> Self {
        self.choices.accuracy = Wanted::Mode(accuracy);
        self
    }

    /// The acceptable error: each table is evaluated by the cheapest method whose bound is within it.
    #[must_use]
    pub fn tolerance(mut self, tolerance: Tolerance) -> Self {
        self.choices.accuracy = Wanted::Within(tolerance);
        self
    }

    /// Computes the slopes of conductances and permeability as well.
    #[must_use]
    pub fn derivatives(mut self) -> Self {
        self.choices.derivatives = Derivatives::Given;
        self
    }

    /// The characteristic element length of all rows, L (P-20).
    #[must_use]
    pub fn characteristic_length(mut self, length: f64) -> Self {
        self.choices.characteristic_length = Some(length);
        self
    }

    /// Sets the start of the histories of nodes (C-25).
    #[must_use]
    pub fn history_start(mut self, start: HistoryStart) -> Self {
        self.choices.history_start = start;
        self
    }

    /// The conductance of interactions with *GAP ELECTRICAL CONDUCTANCE, USER (U-1).
    #[must_use]
    pub fn user_conductance(mut self, conductance: impl UserConductance + 'static) -> Self {
        self.choices.user_conductance = Some(UserLaw::new(conductance));
        self
    }

    /// The number of threads, instead of one per core; results do not depend on it.
    #[must_use]
    pub fn threads(mut self, threads: usize) -> Self {
        self.threads = threads;
        self
    }

    fn choices(&self, deck: &Deck) -> Result<Choices, Failure> {
        let unknown = |name: &String| {
            Failure::Usage(format!("there is no output `{name}`; `inpact explain columns` lists those there are"))
        };
        let named = |name: &String| Output::named(name).ok_or_else(|| unknown(name));
        let outputs = self.outputs.as_ref().map(|names| names.iter().map(named).collect::<Result<Vec<_>, _>>());
        let outputs = outputs.transpose()?;
        let mut choices = Choices { dialect: deck.grammar().dialect(), ..self.choices.clone() };
        if outputs.as_ref().is_some_and(|outputs| outputs.iter().any(|output| output.is_slope())) {
            choices.derivatives = Derivatives::Given;
        }
        choices.outputs = outputs;
        Ok(choices)
    }
}

impl Deck {
    /// Evaluates its interface laws on the rows of a node table, which has the columns that `inpact explain columns` lists.
    ///
    /// Results have the rows of the input, in the same order.
    /// The table is read to its end before the first row is evaluated, since a row with a history needs the earlier rows of its node:
    /// data beyond 128 MiB is spilled to a temporary file.
    ///
    /// ```
    /// use inpact::arrow::array::{AsArray, Float64Array, RecordBatch};
    /// use inpact::arrow::datatypes::Float64Type;
    /// use inpact::{Deck, EvaluateOptions, ReadOptions};
    /// use std::sync::Arc;
    ///
    /// let text = "*SURFACE INTERACTION, NAME=JOINT\n*GAP ELECTRICAL CONDUCTANCE\n4000., 0.\n0., 2.\n";
    /// let deck = Deck::parse("joint.inp", text, &ReadOptions::new().isolated())?;
    /// let column = |values: [f64; 2]| Arc::new(Float64Array::from(values.to_vec())) as _;
    /// let rows = RecordBatch::try_from_iter([("clearance", column([0.5, 1.0])), ("epot_jump", column([1.0, 2.0]))])?;
    ///
    /// let options = EvaluateOptions::new().outputs(["conductance", "ECD"]);
    /// let result = deck.evaluate(rows.schema(), [Ok(rows)], &options)?;
    /// let column = |name| result.batches()[0].column_by_name(name).expect("it is there").as_primitive::<Float64Type>();
    /// assert_eq!(column("conductance").values(), &[3000.0, 2000.0]);
    /// assert_eq!(column("ECD").values(), &[3000.0, 4000.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A deck with errors in the interactions that are used, rows with errors, a requested output that cannot be given:
    /// [`Error::findings`] has the details.
    pub fn evaluate<I>(&self, schema: SchemaRef, batches: I, options: &EvaluateOptions) -> Result<Evaluated, Error>
    where
        I: IntoIterator<Item = Result<RecordBatch, ArrowError>, IntoIter: Send + 'static>,
    {
        let mut out = Vec::new();
        let take = |_: u64, batch| {
            out.push(batch);
            ControlFlow::Continue(())
        };
        let to = self.evaluate_to(schema, batches, options, take)?;
        Ok(Evaluated { batches: out, to })
    }

    /// The same, batch by batch: `take` gets each with the number of rows done, and may stop.
    ///
    /// Rows passed before an error are invalid.
    ///
    /// # Errors
    /// As [`evaluate`](Self::evaluate), and where `take` stops.
    pub fn evaluate_to<I>(
        &self,
        schema: SchemaRef,
        batches: I,
        options: &EvaluateOptions,
        take: impl FnMut(u64, RecordBatch) -> ControlFlow<()> + Send,
    ) -> Result<EvaluatedTo, Error>
    where
        I: IntoIterator<Item = Result<RecordBatch, ArrowError>, IntoIter: Send + 'static>,
    {
        let choices = options.choices(self)?;
        let batches: RecordBatches = Box::new(batches.into_iter());
        with_threads(options.threads, || self.evaluate_rows((schema, batches), &choices, take))
    }

    fn evaluate_rows(
        &self,
        (schema, batches): (SchemaRef, RecordBatches),
        choices: &Choices,
        mut take: impl FnMut(u64, RecordBatch) -> ControlFlow<()> + Send,
    ) -> Result<EvaluatedTo, Error> {
        if self.model().interactions.is_empty() {
            return Err(Error::data(format!("`{}` defines no *SURFACE INTERACTION", self.name())));
        }
        let mut findings = Findings::new(TABLE);
        let reader = NodeReader::of_batches(schema, batches, &mut findings);
        let mut rows = kept_rows();
        let surveyed = survey_keeping(reader, self.model(), choices, &mut findings, &mut rows);
        let surveyed = surveyed.map_err(|error| unreadable(&error))?;
        let mut found = self.judged(findings, "the table has errors")?;
        let Some(surveyed) = surveyed else { return Err(Error::data("the table cannot be evaluated")) };
        let plan = make(self.model(), &surveyed, choices);
        let mut unavailable = Findings::new(TABLE);
        plan.report_unavailable(choices, &mut unavailable);
        found.extend(self.judged(unavailable, "a requested output cannot be given")?);
        found.extend(self.judged_deck(&plan, choices)?);
        if plan.outputs.is_empty() {
            return Err(self.nothing_to_evaluate(&plan));
        }
        let mut rows = rows.give_back(&plan.selection).map_err(|error| unreadable(&error))?;
        let mut evaluation = Evaluation::on_all_threads(self.model(), &plan, choices).without_summary();
        let mut records = ResultRecords::new(plan.keys(), &plan.outputs);
        let mut done = 0;
        let ran = evaluation.run::<Error>(&mut rows, &plan, |batch, results| {
            let records = records.record_batch(batch, results).map_err(|error| unreadable(&error))?;
            done += batch.rows as u64;
            if take(done, records).is_break() {
                return Err(Failure::Usage(format!("stopped after {done} rows")).into());
            }
            Ok(())
        });
        ran.map_err(|error| unreadable(&error))??;
        let tally = evaluation.finish();
        let mut findings = Findings::new(TABLE);
        tally.report_user_faults(&mut findings);
        if !findings.has_errors() {
            tally.report(&plan, &mut findings);
        }
        found.extend(self.judged(findings, "the rows have errors")?);
        let notes = plan.interactions.iter().flat_map(|interaction| {
            let name = &interaction.name;
            let left_out = interaction.left_out.iter();
            let left_out = left_out.map(move |left| format!("{name}: {} is left out: {}", left.what, left.reason));
            left_out.chain(interaction.notes.iter().map(move |note| format!("{name}: {note}")))
        });
        Ok(EvaluatedTo { schema: records.schema(), findings: found, notes: notes.collect() })
    }

    /// Findings with the configured severities; an error where one of them is.
    fn judged(&self, findings: Findings, otherwise: &str) -> Result<Vec<Diagnostic>, Error> {
        let found = self.settings.apply(findings.into_list());
        if has_errors(&found) { Err(Error::of_first(otherwise, found)) } else { Ok(found) }
    }

    /// The findings of the check on the interactions that are used.
    fn judged_deck(&self, plan: &Plan, choices: &Choices) -> Result<Vec<Diagnostic>, Error> {
        let found = self.check();
        let names: Vec<&Name> = plan.interactions.iter().map(|interaction| &interaction.name).collect();
        let concerning = concerning(&found, self.syntax(), self.grammar(), self.model(), &names, choices.regime);
        let concerning: Vec<Diagnostic> = concerning.into_iter().cloned().collect();
        if has_errors(&concerning) {
            return Err(Error::of_first(&format!("`{}` has errors in what is evaluated", self.name()), concerning));
        }
        Ok(concerning.into_iter().filter(|found| found.severity == Severity::Warning).collect())
    }

    /// The reason why there is nothing to evaluate: missing columns, or other obstacles.
    fn nothing_to_evaluate(&self, plan: &Plan) -> Error {
        let mut findings = Findings::new(TABLE);
        plan.report_missing(&mut findings);
        let found = self.settings.apply(findings.into_list());
        let missing = found.iter().map(|found| found.message.clone());
        let reasons: Vec<String> = missing.chain(other_reasons(plan)).collect();
        let reasons = if reasons.is_empty() { String::new() } else { format!(" ({})", reasons.join("; ")) };
        Error::of_findings(format!("nothing of `{}` can be evaluated on these rows{reasons}", self.name()), found)
    }
}

/// The name of a table in memory, in messages.
const TABLE: &str = "<table>";

fn unreadable(error: &std::io::Error) -> Error {
    Error::data(format!("the table cannot be evaluated: {error}"))
}

impl Evaluated {
    /// The key columns of the table, then the results.
    pub fn schema(&self) -> &SchemaRef {
        &self.to.schema
    }

    /// The rows, as many as in the input.
    pub fn batches(&self) -> &[RecordBatch] {
        &self.batches
    }

    /// The rows, by value.
    pub fn into_batches(self) -> Vec<RecordBatch> {
        self.batches
    }

    /// Warnings and notes about deck and rows.
    pub fn findings(&self) -> &[Diagnostic] {
        &self.to.findings
    }

    /// The parts left out and why, a sentence each.
    pub fn notes(&self) -> &[String] {
        &self.to.notes
    }
}
