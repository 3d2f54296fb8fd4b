//! A scene: a deck, a node table and the choices between them; what `eval` and `plan` have in common.

use crate::failure::{Failure, say};
use crate::files::{self, STANDARD_STREAM};
use crate::input;
use crate::render::{self, Format, Style};
use crate::settings::DeckArguments;
use crate::user_library;
use clap::{Args, ValueEnum};
use inpact_evaluation::accuracy::{Accuracy, Tolerance, Wanted};
use inpact_evaluation::law::pore::CutoffBoundary;
use inpact_evaluation::law::user::UserLaw;
use inpact_evaluation::nodes::{DataDiagnostic, Findings, NodeReader};
use inpact_evaluation::plan::{Choices, Derivatives, Plan, concerning, make, survey};
use inpact_evaluation::results::Output;
use inpact_evaluation::table::Tail;
use inpact_parser::deck::{Deck, Keep};
use inpact_parser::grammar::{Dialect, Grammar};
use inpact_parser::model::{self, Model, Name, Regime};
use inpact_validation::{Diagnostic, Severity, check};
use serde::Serialize;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use tempfile::SpooledTempFile;

/// Of a node table from standard input, what is kept in memory; the rest goes to a temporary file.
const MOST_IN_MEMORY: usize = 64 * 1024 * 1024;

#[derive(Debug, Args)]
pub(crate) struct SceneArguments {
    /// The deck or fragment; `-` reads standard input.
    #[arg(value_name = "DECK")]
    deck: PathBuf,
    /// The node table, comma-separated values; `-` reads standard input.
    #[arg(long, value_name = "FILE")]
    nodes: PathBuf,
    /// The interaction that governs every row, instead of column `interaction`.
    #[arg(long, value_name = "NAME")]
    interaction: Option<String>,
    /// Steady state or transient, instead of what the deck's procedures say.
    #[arg(long, value_enum)]
    procedure: Option<Procedure>,
    /// What follows the last point of conductance against clearance: the manual's text or its figure.
    #[arg(long, value_enum, default_value_t = ClearanceTail::Constant)]
    clearance_tail: ClearanceTail,
    /// The characteristic element length of all rows, the default of both cutoffs of pore fluid flow.
    #[arg(long, value_name = "X", value_parser = positive_length)]
    char_length: Option<f64>,
    /// Whether pore fluid flows at the very cutoff.
    #[arg(long, value_enum, default_value_t = Boundary::Inclusive)]
    cutoff_boundary: Boundary,
    /// How exactly the values of tables are found.
    #[arg(long, value_enum, default_value_t = AccuracyChoice::Full)]
    accuracy: AccuracyChoice,
    /// The error that is acceptable, as a part of the largest value of a table: each is evaluated in the cheapest way whose bound is within it.
    #[arg(long, value_name = "X", value_parser = tolerance, conflicts_with = "accuracy")]
    tolerance: Option<f64>,
    /// The same, as a part of the value at the same point.
    #[arg(long, value_name = "X", value_parser = tolerance, conflicts_with_all = ["accuracy", "tolerance"])]
    tolerance_relative: Option<f64>,
    /// The outputs that are wanted, by the names of their columns; all that deck and node table give where there is none.
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = output_named)]
    outputs: Option<Vec<Output>>,
    /// Give the slopes of conductances and permeability as well.
    #[arg(long)]
    derivatives: bool,
    /// A shared library with the user subroutine GAPELECTR, compiled with
    /// `gfortran -shared -fPIC -o gapelectr.so gapelectr.f`, for *GAP ELECTRICAL CONDUCTANCE, USER.
    ///
    /// It is loaded and run only when it is named here, and when an interaction of the deck has such a conductance.
    /// `INCLUDE 'ABA_PARAM.INC'` reads a file beside the source with one line, `      IMPLICIT REAL*8 (A-H,O-Z)`.
    /// It is native code: inpact cannot stop it from harm, and a crash in it ends the program.
    /// What it writes to unit 6 comes out on standard output: write the result to a file with `-o`.
    #[arg(long, value_name = "FILE")]
    user_library: Option<PathBuf>,
    #[command(flatten)]
    reading: DeckArguments,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Procedure {
    Steady,
    Transient,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum ClearanceTail {
    /// The last value, as the text of the manual has it.
    Constant,
    /// Zero, as its figure has it.
    Zero,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum AccuracyChoice {
    /// In twice the precision of f64, rounded once.
    Reference,
    /// In f64, within two units in the last place an axis.
    Full,
    /// In the cheapest form whose error bound is within 1e-4 of the largest value.
    Fast,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Boundary {
    /// It does, as the user's guide has it.
    Inclusive,
    /// It does not, as the theory guide has it.
    Exclusive,
}

/// How what is found is printed on standard error.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum FindingFormat {
    /// A line each.
    Concise,
    /// A JSON object a line.
    Json,
}

/// A scene that can be evaluated, or shown.
pub(crate) struct Scene {
    pub(crate) model: Model,
    pub(crate) choices: Choices,
    pub(crate) plan: Plan,
    /// The names of deck and node table, as they were asked for.
    pub(crate) deck_name: String,
    pub(crate) nodes_name: String,
    /// Whether the deck is wrong where the plan needs it.
    pub(crate) deck_has_errors: bool,
    pub(crate) nodes: NodesInput,
}

/// A node table that can be read more than once.
pub(crate) enum NodesInput {
    File(PathBuf),
    Spooled(SpooledTempFile),
}

impl SceneArguments {
    /// The files a scene is read from.
    pub(crate) fn inputs(&self) -> [&Path; 2] {
        [&self.deck, &self.nodes]
    }

    /// Reads deck and node table and makes the plan; `None` after saying what is wrong with the node table.
    pub(crate) fn prepare(&self, format: FindingFormat) -> Result<Option<Scene>, Failure> {
        let is_standard = |path: &Path| path.as_os_str() == STANDARD_STREAM;
        if is_standard(&self.deck) && is_standard(&self.nodes) {
            return Err(Failure::Usage("deck and node table cannot both be read from standard input".to_owned()));
        }
        let settings = self.reading.settings(&self.deck)?;
        let grammar = settings.grammar;
        let deck = input::read_deck(&self.deck, Keep::Interpreted, &settings)?;
        let (model, problems) = model::read(&deck, grammar);
        if model.interactions.is_empty() {
            return Err(Failure::Data(format!("`{}` defines no *SURFACE INTERACTION", self.deck.display())));
        }
        let choices = self.choices(&model, grammar.dialect())?;
        let nodes_name = self.nodes.display().to_string();
        let mut findings = Findings::new(&nodes_name);
        let mut nodes = NodesInput::open(&self.nodes)?;
        let surveyed = NodeReader::open(nodes.reader(&self.nodes)?, &mut findings)
            .and_then(|reader| survey(reader, &model, &choices, &mut findings))
            .map_err(|error| Failure::read(&self.nodes, error))?;
        let has_errors = findings.has_errors();
        say_data_findings(findings.into_list(), format);
        let Some(surveyed) = surveyed.filter(|_| !has_errors) else { return Ok(None) };
        let plan = make(&model, &surveyed, &choices);
        let mut unavailable = Findings::new(&nodes_name);
        plan.report_unavailable(&choices, &mut unavailable);
        let is_unavailable = unavailable.has_errors();
        say_data_findings(unavailable.into_list(), format);
        if is_unavailable {
            return Ok(None);
        }
        let found = settings.apply(check(&deck, grammar, &model, &problems), &deck);
        let deck_has_errors = say_deck_findings(&found, (&deck, grammar, &model), &plan, format);
        let deck_name = self.deck.display().to_string();
        Ok(Some(Scene { model, choices, plan, deck_name, nodes_name, deck_has_errors, nodes }))
    }

    fn choices(&self, model: &Model, dialect: Dialect) -> Result<Choices, Failure> {
        Ok(Choices {
            interaction: self.interaction.as_deref().map(Name::new),
            regime: self.procedure.map(|procedure| match procedure {
                Procedure::Steady => Regime::SteadyState,
                Procedure::Transient => Regime::Transient,
            }),
            clearance_tail: match self.clearance_tail {
                ClearanceTail::Constant => Tail::Constant,
                ClearanceTail::Zero => Tail::Zero,
            },
            characteristic_length: self.char_length,
            cutoff_boundary: match self.cutoff_boundary {
                Boundary::Inclusive => CutoffBoundary::Inclusive,
                Boundary::Exclusive => CutoffBoundary::Exclusive,
            },
            dialect,
            derivatives: self.derivatives(),
            accuracy: self.accuracy(),
            outputs: self.outputs.clone(),
            user_conductance: self.user_conductance(model)?,
        })
    }

    /// The routine of `--user-library`, loaded only if an interaction of the deck asks for one.
    fn user_conductance(&self, model: &Model) -> Result<Option<UserLaw>, Failure> {
        let Some(path) = &self.user_library else { return Ok(None) };
        let electrical = model.interactions.values().filter_map(|of| of.gap_electrical_conductance.as_ref());
        if electrical.filter(|option| option.user.is_some()).count() == 0 {
            let path = path.display();
            say(&format!("warning: no *GAP ELECTRICAL CONDUCTANCE of the deck has USER; `{path}` is not loaded"));
            return Ok(None);
        }
        user_library::load(path).map(Some)
    }

    fn accuracy(&self) -> Wanted {
        match (self.tolerance, self.tolerance_relative) {
            (Some(tolerance), _) => Wanted::Within(Tolerance::RelativeToLargest(tolerance)),
            (None, Some(tolerance)) => Wanted::Within(Tolerance::Pointwise(tolerance)),
            (None, None) => Wanted::Mode(match self.accuracy {
                AccuracyChoice::Reference => Accuracy::Reference,
                AccuracyChoice::Full => Accuracy::Full,
                AccuracyChoice::Fast => Accuracy::Fast,
            }),
        }
    }

    /// Slopes are planned where they are asked for in general or by name.
    fn derivatives(&self) -> Derivatives {
        let is_slope = |output: &Output| matches!(output, Output::ConductanceSlope(_) | Output::PermeabilitySlope(_));
        let by_name = self.outputs.as_ref().is_some_and(|outputs| outputs.iter().any(is_slope));
        if self.derivatives || by_name { Derivatives::Given } else { Derivatives::LeftOut }
    }

    /// Where the node table is, for a failure to read it.
    pub(crate) fn nodes_path(&self) -> &Path {
        &self.nodes
    }
}

impl NodesInput {
    fn open(path: &Path) -> Result<Self, Failure> {
        if path.as_os_str() != STANDARD_STREAM {
            return Ok(Self::File(path.to_owned()));
        }
        let mut spooled = SpooledTempFile::new(MOST_IN_MEMORY);
        io::copy(&mut files::open(path)?, &mut spooled).map_err(|error| Failure::read(path, error))?;
        Ok(Self::Spooled(spooled))
    }

    /// The table from its beginning; `path` is what it was asked for by.
    pub(crate) fn reader(&mut self, path: &Path) -> Result<Box<dyn Read + '_>, Failure> {
        match self {
            Self::File(path) => files::open(path),
            Self::Spooled(spooled) => {
                spooled.seek(SeekFrom::Start(0)).map_err(|error| Failure::read(path, error))?;
                Ok(Box::new(spooled))
            }
        }
    }
}

/// Says what the check found in the interactions of the plan, notes left out; true if there are errors.
fn say_deck_findings(
    found: &[Diagnostic],
    (deck, grammar, model): (&Deck, &Grammar, &Model),
    plan: &Plan,
    format: FindingFormat,
) -> bool {
    let names: Vec<&Name> = plan.interactions.iter().map(|interaction| &interaction.name).collect();
    let concerning = concerning(found, deck, grammar, model, &names);
    let shown = concerning.iter().filter(|found| found.severity != Severity::Note);
    let shown: Vec<Diagnostic> = shown.map(|found| (*found).clone()).collect();
    let format = match format {
        FindingFormat::Concise => Format::Concise,
        FindingFormat::Json => Format::Json,
    };
    let text = render::diagnostics(&shown, deck, format, Style::Plain);
    text.lines().for_each(say);
    let errors = |found: &[Diagnostic]| found.iter().filter(|found| found.severity == Severity::Error).count();
    let elsewhere = errors(found) - errors(&shown);
    if elsewhere > 0 && format == Format::Concise {
        let errors = if elsewhere == 1 { "1 error".to_owned() } else { format!("{elsewhere} errors") };
        say(&format!("{errors} elsewhere in the deck: see `inpact check`"));
    }
    errors(&shown) > 0
}

/// Says what is wrong with a node table.
pub(crate) fn say_data_findings(found: Vec<DataDiagnostic>, format: FindingFormat) {
    for found in found {
        say(&match format {
            FindingFormat::Concise => concise(&found),
            FindingFormat::Json => json(&found),
        });
    }
}

/// `file:line: severity[CODE] message`, and what to do.
fn concise(found: &DataDiagnostic) -> String {
    let DataDiagnostic { code, severity, message, file, .. } = found;
    let line = found.place.line.map_or_else(String::new, |line| format!(":{line}"));
    let help = found.help.as_ref().map_or_else(String::new, |help| format!(" ({help})"));
    format!("{file}{line}: {severity}[{code}] {message}{help}")
}

/// The fields of a finding in a deck; instead of a column and a span a row and the name of its cell's column.
fn json(found: &DataDiagnostic) -> String {
    #[derive(Serialize)]
    struct Record<'a> {
        code: &'a str,
        name: &'a str,
        severity: &'a str,
        file: &'a str,
        line: Option<u64>,
        column: Option<u64>,
        span: Option<[u64; 2]>,
        row: Option<u64>,
        field: Option<&'a str>,
        message: &'a str,
        help: Option<&'a str>,
    }
    let record = Record {
        code: found.code,
        name: found.name,
        severity: found.severity.word(),
        file: &found.file,
        line: found.place.line,
        column: None,
        span: None,
        row: found.place.row,
        field: found.place.column.as_deref(),
        message: &found.message,
        help: found.help.as_deref(),
    };
    // A record of strings and numbers has no reason to fail.
    serde_json::to_string(&record).unwrap_or_default()
}

fn output_named(text: &str) -> Result<Output, String> {
    Output::named(text).ok_or_else(|| {
        let names: Vec<String> = Output::NAMED.iter().map(ToString::to_string).collect();
        format!("there is no such output; there are {} and slopes such as dconductance_dtemp", names.join(", "))
    })
}

fn tolerance(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(tolerance) if tolerance > 0.0 && tolerance.is_finite() => Ok(tolerance),
        Ok(_) => Err("a tolerance must be above zero and finite".to_owned()),
        Err(_) => Err("not a number".to_owned()),
    }
}

fn positive_length(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(length) if length > 0.0 && length.is_finite() => Ok(length),
        Ok(_) => Err("a length must be above zero and finite".to_owned()),
        Err(_) => Err("not a number".to_owned()),
    }
}
