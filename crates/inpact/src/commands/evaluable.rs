//! A deck and a node table that can be evaluated, with the user's choices: shared by `eval`, `plan` and `tradeoff`.

use super::choice::{Choice, one_of};
use super::findings::{Messages, Reporter};
use super::job_results::{RESULTS_HELP, states};
use super::laws::LawArguments;
use super::mesh_rows::{RowsSummary, node_rows};
use super::meshed::MeshedDeck;
use super::picture::Drawn;
use crate::failure::Failure;
use crate::files::{self, STANDARD_STREAM};
use crate::settings::{DeckArguments, Settings};
use crate::text::above_zero;
use crate::threads::with_threads;
use clap::Args;
use inpact_contact::Joined;
use inpact_diagnostics::{Diagnostic, Extent, Findings, keep_lines};
use inpact_evaluation::nodes::{COLUMN_PAGES, KeptRows, MakeSpillFile, NodeReader, locate};
use inpact_evaluation::plan::{Choices, Derivatives, Plan, Reason, Survey, make, survey_keeping};
use inpact_evaluation::results::{OUTPUT_PAGES, Output};
use inpact_evaluation::{Accuracy, HistoryStart, Tolerance, Wanted};
use inpact_parser::grammar::Dialect;
use inpact_parser::model::{Model, Name, Regime};
use std::fs::File;
use std::io::{self, BufReader, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// The number of pieces of a node table decoded ahead, per thread.
const READ_AHEAD: usize = 2;

/// The number of bytes of the rows of a node table kept in memory; the rest is spilled to a temporary file.
const ROOM_FOR_ROWS: usize = 128 << 20;

/// The time during which further rounds of reading and evaluating all rows are started.
pub(crate) const PATIENCE: Duration = Duration::from_secs(2);

#[derive(Debug, Default, Args)]
pub(crate) struct EvaluableArguments {
    /// The deck or fragment; `-` reads standard input.
    #[arg(value_name = "DECK")]
    deck: PathBuf,
    /// The node table: comma-separated values, Parquet or Arrow, as its first bytes say; `-` reads standard input. Without it the rows are made of the mesh of the deck, as `inpact nodes` makes them.
    #[arg(long, value_name = "FILE", conflicts_with = "results")]
    nodes: Option<PathBuf>,
    #[arg(long, value_name = "FILE", help = RESULTS_HELP)]
    results: Vec<PathBuf>,
    /// The interaction that governs every row, instead of column `interaction`.
    #[arg(long, value_name = "NAME")]
    interaction: Option<String>,
    /// Steady state or transient, instead of what the deck's procedures say.
    #[arg(long, value_parser = one_of(&PROCEDURES))]
    procedure: Option<Regime>,
    /// Where the histories of nodes start: at the first row of each, or at time 0 without a jump of potential, so that a first row later than that ends an increment.
    #[arg(long, value_parser = one_of(&HISTORY_STARTS), default_value = "first-row")]
    history_start: HistoryStart,
    /// Use so many threads, instead of all cores; the results are the same.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// How exactly the values of tables are found.
    #[arg(long, value_parser = one_of(&ACCURACIES), default_value = "full")]
    accuracy: Accuracy,
    /// The error that is acceptable, as a part of the largest value of a table: each is evaluated in the cheapest way whose bound is within it.
    #[arg(long, value_name = "X", value_parser = tolerance, conflicts_with = "accuracy")]
    tolerance: Option<f64>,
    /// The same, as a part of the value at the same point.
    #[arg(long, value_name = "X", value_parser = tolerance, conflicts_with_all = ["accuracy", "tolerance"])]
    tolerance_relative: Option<f64>,
    /// The outputs that are wanted, by the names of their columns; all that deck and node table give where there is none.
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = output_named)]
    outputs: Option<Vec<Output>>,
    /// Give the slopes of conductances and permeability as well; with `--outputs` name those that are wanted there.
    #[arg(long, conflicts_with = "outputs")]
    derivatives: bool,
}

const PROCEDURES: [Choice<Regime>; 2] = [("steady", Regime::SteadyState, ""), ("transient", Regime::Transient, "")];

/// Starts of the histories of nodes.
pub(crate) const HISTORY_STARTS: [Choice<HistoryStart>; 2] = [
    (
        "first-row",
        HistoryStart::FirstRow,
        "At its first row: its integrals are 0 there, and its own jump and clearance are those of the start",
    ),
    (
        "at-rest",
        HistoryStart::AtRest { time: 0.0 },
        "At time 0, without a jump of potential and with the clearance of its first row",
    ),
];

const ACCURACIES: [Choice<Accuracy>; 3] = [
    ("reference", Accuracy::Reference, "In twice the precision of f64, rounded once"),
    ("full", Accuracy::Full, "In f64, within two units in the last place an axis"),
    ("fast", Accuracy::Fast, "In the cheapest form whose error bound is within 1e-4 of the largest value"),
];

/// A node table that can be evaluated, with its deck and plan.
pub(crate) struct Evaluable {
    /// Severities of findings.
    pub(crate) settings: Settings,
    pub(crate) model: Model,
    pub(crate) choices: Choices,
    pub(crate) plan: Plan,
    /// The names of deck and node table, as given.
    pub(crate) deck_name: String,
    pub(crate) nodes_name: String,
    /// Whether the deck is wrong where the plan needs it.
    pub(crate) deck_has_errors: bool,
    pub(crate) rows: KeptRows,
    /// The source of the rows, where they are of the deck's mesh.
    pub(crate) made: Option<Made>,
    /// The node table, to be read once more.
    table: Option<NodesInput>,
    /// The time that reading the rows took.
    pub(crate) reading: Duration,
}

/// Rows that were made of a mesh: what there is to say of them, and what they are drawn on.
pub(crate) struct Made {
    pub(crate) summary: RowsSummary,
    pub(crate) drawn: Drawn,
}

/// Rows that were read once.
struct Surveyed {
    survey: Survey,
    rows: KeptRows,
    nodes_name: String,
    made: Option<Made>,
    table: Option<NodesInput>,
}

/// A node table that can be read beyond the next bytes.
enum NodesInput {
    File(PathBuf),
    /// Spooled from a stream to a temporary file.
    Spooled(File),
}

impl EvaluableArguments {
    /// Everything that a deck gives on a node table in full accuracy; nodes start at their first rows.
    pub(crate) fn of_nodes(deck: PathBuf, nodes: PathBuf) -> Self {
        Self { deck, nodes: Some(nodes), ..Self::default() }
    }

    /// Everything that a deck and the results of its job give, in full accuracy.
    pub(crate) fn of_results(deck: PathBuf, results: Vec<PathBuf>, history_start: HistoryStart) -> Self {
        Self { deck, results, history_start, ..Self::default() }
    }

    /// The files that are read.
    pub(crate) fn inputs(&self) -> Vec<&Path> {
        let paths = std::iter::once(&self.deck).chain(&self.nodes).chain(&self.results);
        paths.map(PathBuf::as_path).collect()
    }

    /// Reads deck and node table and makes the plan; `None` after reporting faults of the node table.
    pub(crate) fn prepare(
        &self,
        laws: &LawArguments,
        reading: &DeckArguments,
        messages: Messages<'_>,
    ) -> Result<Option<Evaluable>, Failure> {
        self.prepare_in_rounds(laws, reading, messages, 1)
    }

    /// The same, where the rows are read this many times and the minimum time is used.
    pub(crate) fn prepare_in_rounds(
        &self,
        laws: &LawArguments,
        reading: &DeckArguments,
        messages: Messages<'_>,
        rounds: u32,
    ) -> Result<Option<Evaluable>, Failure> {
        let is_standard = |path: &Path| path.as_os_str() == STANDARD_STREAM;
        if is_standard(&self.deck) && self.nodes.as_deref().is_some_and(is_standard) {
            return Err(Failure::Usage("deck and node table cannot both be read from standard input".to_owned()));
        }
        let mut settings = reading.settings(&self.deck)?;
        messages.confine(&mut settings, &self.deck);
        let grammar = settings.grammar;
        let meshed = match &self.nodes {
            Some(_) => MeshedDeck::without_mesh(&self.deck, &settings)?,
            None => MeshedDeck::read(&self.deck, &settings)?,
        };
        let model = &meshed.read.model;
        if model.interactions.is_empty() {
            return Err(Failure::Data(format!("`{}` defines no *SURFACE INTERACTION", self.deck.display())));
        }
        let choices = self.choices(laws, model, grammar.dialect())?;
        let start = Instant::now();
        let look = |messages: Messages<'_>| match &self.nodes {
            Some(path) => survey_table(path, model, &choices, &settings, messages),
            None => self.survey_mesh(&meshed, &choices, &settings, messages),
        };
        let surveyed = look(messages)?;
        let reading = self.least_reading(start.elapsed(), rounds, look)?;
        let Some(Surveyed { survey, rows, nodes_name, made, table }) = surveyed else { return Ok(None) };
        let read = meshed.read;
        let plan = make(&read.model, &survey, &choices);
        let mut unavailable = Findings::new(&nodes_name);
        plan.report_unavailable(&choices, &mut unavailable);
        if messages.data(unavailable.into_list(), &settings) {
            return Ok(None);
        }
        let found = read.check(&settings);
        let names: Vec<&Name> = plan.interactions.iter().map(|interaction| &interaction.name).collect();
        let deck_has_errors = messages.deck(&found, (&read.deck, grammar, &read.model), (&names, choices.regime));
        let deck_name = self.deck.display().to_string();
        Ok(Some(Evaluable {
            settings,
            model: read.model,
            choices,
            plan,
            deck_name,
            nodes_name,
            deck_has_errors,
            rows,
            made,
            table,
            reading,
        }))
    }

    /// The minimum time of reading the rows, in further rounds up to a time limit; for a stream the time of the only one.
    fn least_reading(
        &self,
        first: Duration,
        rounds: u32,
        read: impl Fn(Messages<'_>) -> Result<Option<Surveyed>, Failure>,
    ) -> Result<Duration, Failure> {
        let begun = Instant::now();
        let mut least = first;
        let rounds = if self.nodes.iter().chain(&self.results).any(|path| files::is_stream(path)) { 1 } else { rounds };
        for _ in 1..rounds {
            if PATIENCE < first + begun.elapsed() {
                break;
            }
            let start = Instant::now();
            Messages::unheard(&read)?;
            least = least.min(start.elapsed());
        }
        Ok(least)
    }

    fn choices(&self, laws: &LawArguments, model: &Model, dialect: Dialect) -> Result<Choices, Failure> {
        Ok(Choices {
            interaction: self.interaction.as_deref().map(Name::new),
            derivatives: self.derivatives(),
            accuracy: self.accuracy(),
            outputs: self.outputs.clone(),
            history_start: self.history_start,
            ..laws.choices(model, dialect, self.procedure)?
        })
    }

    fn accuracy(&self) -> Wanted {
        match (self.tolerance, self.tolerance_relative) {
            (Some(tolerance), _) => Wanted::Within(Tolerance::RelativeToLargest(tolerance)),
            (None, Some(tolerance)) => Wanted::Within(Tolerance::Pointwise(tolerance)),
            (None, None) => Wanted::Mode(self.accuracy),
        }
    }

    /// Slopes are planned where they are requested in general or by name.
    fn derivatives(&self) -> Derivatives {
        let by_name = self.outputs.as_ref().is_some_and(|outputs| outputs.iter().any(|output| output.is_slope()));
        if self.derivatives || by_name { Derivatives::Given } else { Derivatives::LeftOut }
    }

    /// Runs work with the requested number of threads.
    pub(crate) fn with_threads<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        with_threads(self.threads.map_or(0, usize::from), work)
    }

    /// The path of the source of the rows, for a failure to read it.
    pub(crate) fn nodes_path(&self) -> &Path {
        self.nodes.as_deref().unwrap_or(&self.deck)
    }

    /// Makes the rows of a deck's mesh and of the results of its job, and surveys them; `None` after reporting their faults.
    fn survey_mesh(
        &self,
        meshed: &MeshedDeck,
        choices: &Choices,
        settings: &Settings,
        messages: Messages<'_>,
    ) -> Result<Option<Surveyed>, Failure> {
        if meshed.mesh.pairs.is_empty() && self.results.is_empty() {
            meshed.say_notes(&meshed.mesh.notes, messages)?;
            let message = format!(
                "expected a node table (`--nodes FILE`), or a deck whose mesh rows can be made of: `{}` has no contact pair with a mesh",
                meshed.name
            );
            return Err(Failure::Usage(message));
        }
        let Joined { states, files, .. } = states(&self.results, meshed, messages)?;
        let mut node_rows = node_rows(meshed, &states, messages)?;
        node_rows.without_sources();
        let mut nodes_name = format!("mesh of {}", meshed.name);
        for (at, file) in files.iter().enumerate() {
            nodes_name += if at == 0 { " with " } else { ", " };
            nodes_name += &file.file;
        }
        let (keys, numbers) = (node_rows.keys().to_vec(), node_rows.numbers().to_vec());
        let batches = node_rows.batches(&states).map(|batch| batch.map_err(io::Error::other));
        let reader = NodeReader::of_made(&keys, &numbers, Box::new(batches));
        let mut findings = Findings::new(&nodes_name);
        let mut rows = kept_rows();
        let failed = |error: io::Error| match error.downcast::<inpact_contact::Error>() {
            Ok(error) => error.into(),
            Err(error) => Failure::read(&self.deck, error),
        };
        let survey = survey_keeping(reader, &meshed.read.model, choices, &mut findings, &mut rows).map_err(failed)?;
        let has_errors = messages.data(findings.into_list(), settings);
        let (summary, faces) = (RowsSummary::of(&node_rows, &files), node_rows.slave_faces());
        let made = Some(Made { summary, drawn: Drawn { faces, states } });
        Ok(survey.filter(|_| !has_errors).map(|survey| Surveyed { survey, rows, nodes_name, made, table: None }))
    }
}

impl Evaluable {
    /// Reports faults of evaluated rows; true if there are errors.
    pub(crate) fn say(&mut self, findings: Findings, messages: Messages<'_>) -> bool {
        let mut found = findings.into_list();
        if let (Some(table), true) = (&mut self.table, messages.shows_lines()) {
            // A table deleted since it was read has no lines to show.
            let _ = table.locate(Path::new(&self.nodes_name), &mut found, messages);
        }
        messages.data(found, &self.settings)
    }
}

/// Reads a node table and surveys its rows; `None` after reporting their faults.
fn survey_table(
    path: &Path,
    model: &Model,
    choices: &Choices,
    settings: &Settings,
    messages: Messages<'_>,
) -> Result<Option<Surveyed>, Failure> {
    let nodes_name = path.display().to_string();
    let mut nodes = NodesInput::open(path)?;
    let unreadable = |error| Failure::read(path, error);
    let mut findings = Findings::new(&nodes_name);
    let mut reader = NodeReader::open_any(nodes.reader(path)?, &mut findings).map_err(unreadable)?;
    reader.set_read_ahead(READ_AHEAD * rayon::current_num_threads());
    let mut rows = kept_rows();
    let survey = survey_keeping(reader, model, choices, &mut findings, &mut rows).map_err(unreadable)?;
    let mut found = findings.into_list();
    nodes.locate(path, &mut found, messages)?;
    let has_errors = messages.data(found, settings);
    Ok(survey.filter(|_| !has_errors).map(|survey| Surveyed {
        survey,
        rows,
        nodes_name,
        made: None,
        table: Some(nodes),
    }))
}

/// Storage for rows to be evaluated, first in memory, then in a temporary file.
pub(crate) fn kept_rows() -> KeptRows {
    KeptRows::new(ROOM_FOR_ROWS, spill_file())
}

/// Makes a temporary file for spilled rows.
pub(crate) fn spill_file() -> MakeSpillFile {
    Box::new(|| Ok(Box::new(tempfile::tempfile()?)))
}

impl Evaluable {
    /// A copy of the rows for a second pass.
    pub(crate) fn rows_again(&mut self, arguments: &EvaluableArguments) -> Result<KeptRows, Failure> {
        self.rows.try_clone(spill_file()).map_err(|error| Failure::read(arguments.nodes_path(), error))
    }
}

impl NodesInput {
    fn open(path: &Path) -> Result<Self, Failure> {
        if !files::is_stream(path) {
            return Ok(Self::File(path.to_owned()));
        }
        let mut spooled = tempfile::tempfile().map_err(|error| Failure::read(path, error))?;
        io::copy(&mut files::open(path)?, &mut spooled).map_err(|error| Failure::read(path, error))?;
        Ok(Self::Spooled(spooled))
    }

    /// Finds the cells that findings name by their lines, and the lines around them where they are shown.
    fn locate(&mut self, path: &Path, found: &mut [Diagnostic], messages: Messages<'_>) -> Result<(), Failure> {
        // Only a text table has lines, and locations of cells.
        if !found.iter().any(|found| found.primary.extent == Extent::Line) {
            return Ok(());
        }
        let unreadable = |error| Failure::read(path, error);
        locate(BufReader::new(self.reader(path)?), found).map_err(unreadable)?;
        if messages.shows_lines() {
            keep_lines(BufReader::new(self.reader(path)?), found).map_err(unreadable)?;
        }
        Ok(())
    }

    /// The table from its beginning; `path` is its name as given.
    fn reader(&mut self, path: &Path) -> Result<Box<File>, Failure> {
        match self {
            Self::File(path) => files::open_file(path).map(Box::new),
            Self::Spooled(spooled) => {
                let unreadable = |error| Failure::read(path, error);
                spooled.seek(SeekFrom::Start(0)).map_err(unreadable)?;
                // Its position is shared by all readers, so only one reads at a time.
                spooled.try_clone().map(Box::new).map_err(unreadable)
            }
        }
    }
}

/// The reasons why parts of a plan are left out, except missing columns.
pub(crate) fn other_reasons(plan: &Plan) -> impl Iterator<Item = String> {
    plan.interactions.iter().flat_map(|interaction| {
        let others = interaction.left_out.iter().filter(|left_out| !matches!(left_out.reason, Reason::Missing(_)));
        others.map(move |left_out| format!("{} of `{}`: {}", left_out.what, interaction.name, left_out.reason))
    })
}

/// The columns of node tables and results, for `--help`.
pub(crate) fn columns_help() -> String {
    let of_nodes: Vec<&str> = COLUMN_PAGES.iter().map(|page| page.names[0]).collect();
    let of_results: Vec<String> = OUTPUT_PAGES.iter().map(|page| page.output.to_string()).collect();
    format!(
        "Columns of node tables: {}\n\nColumns of results: {}\n\n`inpact explain columns` says what they mean, `inpact explain NAME` what one of them does",
        of_nodes.join(" "),
        of_results.join(" ")
    )
}

fn output_named(text: &str) -> Result<Output, String> {
    Output::named(text).ok_or_else(|| {
        let names: Vec<String> = Output::NAMED.iter().map(ToString::to_string).collect();
        format!("there is no such output; there are {} and slopes such as dconductance_dtemp", names.join(", "))
    })
}

pub(crate) fn tolerance(text: &str) -> Result<f64, String> {
    above_zero(text, "a tolerance")
}
