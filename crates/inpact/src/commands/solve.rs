//! `inpact solve`: a scene in, the state of its nodes out.

mod failures;
mod interfaces;
mod output;
mod summary;

use self::output::{Outputs, StateFormat};
use super::laws::LawArguments;
use super::scene::{FindingFormat, say_data_findings, say_deck_findings, tolerance};
use crate::failure::{Failure, Outcome, say};
use crate::files::{self, STANDARD_STREAM};
use crate::input;
use crate::settings::DeckArguments;
use clap::{Args, ValueEnum};
use inpact_evaluation::nodes::Findings;
use inpact_evaluation::plan::Choices;
use inpact_network::linear::{LAST_DIGIT, Method};
use inpact_network::scene::{self, Scene, SceneFiles};
use inpact_network::transient;
use inpact_network::{Equations, Problem, SolveFailure, State};
use inpact_parser::deck::Keep;
use inpact_parser::model::{self, Model, Name, Regime};
use inpact_validation::check;
use std::path::{Path, PathBuf};
use std::time::Instant;

#[derive(Debug, Args)]
pub(crate) struct SolveArguments {
    /// The scene: a TOML file; `-` reads standard input.
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// Where to write the state of the nodes, instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// How to print the state, and what there is to say on standard error.
    #[arg(long, value_enum, default_value_t = StateFormat::Csv)]
    format: StateFormat,
    /// Write the result table of the interfaces, as `eval` gives it; .csv, .parquet, .arrow by the extension.
    #[arg(long, value_name = "FILE")]
    interfaces: Option<PathBuf>,
    /// Give the flow through each link as well: behind the state, or with =FILE in a table of its own.
    #[arg(long, value_name = "FILE", num_args = 0..=1, require_equals = true, default_missing_value = STANDARD_STREAM)]
    links: Option<PathBuf>,
    #[command(flatten)]
    solver: SolverArguments,
    #[command(flatten)]
    laws: LawArguments,
    #[command(flatten)]
    reading: DeckArguments,
}

/// How equations are solved.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct SolverArguments {
    /// How linear equations are solved.
    #[arg(long, value_enum, default_value_t = SolverChoice::Direct)]
    solver: SolverChoice,
    /// The relative error of a flow that is acceptable; a solver that does not reach it is replaced by the next safer one [default: the last digit].
    #[arg(long, value_name = "X", value_parser = tolerance)]
    tolerance: Option<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum SolverChoice {
    /// A Cholesky factor in f64.
    Direct,
    /// A Cholesky factor in f32, refined in f64: half the memory, faster in three dimensions.
    Mixed,
    /// Conjugate gradients with an incomplete factor: for networks whose factor would not fit.
    Iterative,
}

/// A scene with the model of its deck.
pub(crate) struct SolvableScene {
    pub(crate) scene: Scene,
    pub(crate) model: Model,
    pub(crate) choices: Choices,
    pub(crate) name: String,
    pub(crate) deck_name: String,
}

/// Why solving ended early.
enum Stopped {
    Solving(SolveFailure),
    Writing(Failure),
}

impl From<SolveFailure> for Stopped {
    fn from(failure: SolveFailure) -> Self {
        Self::Solving(failure)
    }
}

impl SolverArguments {
    fn method(self) -> Method {
        match self.solver {
            SolverChoice::Direct => Method::Direct,
            SolverChoice::Mixed => Method::Mixed,
            SolverChoice::Iterative => Method::Iterative,
        }
    }
}

pub(crate) fn run(arguments: &SolveArguments) -> Result<Outcome, Failure> {
    let start = Instant::now();
    let format = arguments.format.of_findings();
    let targets = [arguments.output.as_deref(), arguments.interfaces.as_deref(), arguments.links.as_deref()];
    for target in targets {
        files::refuse_overwriting(target, &[&arguments.scene])?;
    }
    let prepared = prepare(&arguments.scene, &arguments.laws, &arguments.reading, format)?;
    let Some(prepared) = prepared else { return Ok(Outcome::HasErrors) };
    let SolvableScene { scene, model, choices, name, .. } = &prepared;
    let mut findings = Findings::new(name);
    let problem = Problem::new(scene, model, choices, &mut findings);
    say_data_findings(findings.into_list(), format);
    let Some(problem) = problem else { return Ok(Outcome::HasErrors) };
    let method = arguments.solver.method();
    let mut equations = Equations::new(&problem, method, arguments.solver.tolerance.unwrap_or(LAST_DIGIT));
    let mut outputs = Outputs::create(arguments, &prepared, &problem)?;
    let mut last: Option<State> = None;
    let ran = transient::run(&mut equations, |state| {
        outputs.take(state).map_err(Stopped::Writing)?;
        last = Some(state.clone());
        Ok(())
    });
    let report = match ran {
        Ok(report) => report,
        Err(Stopped::Writing(failure)) => return Err(failure),
        Err(Stopped::Solving(failure)) => {
            let after = last.filter(|_| scene.is_transient()).map(|state| state.time);
            say_data_findings(failures::findings(&failure, scene, (name, after)), format);
            return Ok(Outcome::HasErrors);
        }
    };
    let Some(last) = last else { return Ok(Outcome::HasErrors) };
    outputs.finish(&last, format)?;
    let summary = summary::Summary { problem: &problem, state: &last, report: &report, name, time: start.elapsed() };
    match format {
        FindingFormat::Concise => summary.text().iter().for_each(|line| say(line)),
        FindingFormat::Json => say(&summary.json().to_string()),
    }
    Ok(Outcome::Clean)
}

/// Reads a scene and its deck; `None` after saying what is wrong with them.
pub(crate) fn prepare(
    path: &Path,
    laws: &LawArguments,
    reading: &DeckArguments,
    format: FindingFormat,
) -> Result<Option<SolvableScene>, Failure> {
    let name = path.display().to_string();
    let folder =
        if path.as_os_str() == STANDARD_STREAM { Path::new("") } else { path.parent().unwrap_or(Path::new("")) };
    let text = files::read_bytes(path)?;
    let Ok(text) = String::from_utf8(text) else {
        return Err(Failure::Data(format!("`{name}` is no scene: it is not UTF-8")));
    };
    let mut files = FilesBeside { folder, failure: None };
    let (scene, found) = scene::read(&text, &name, &mut files);
    say_data_findings(found, format);
    if let Some(failure) = files.failure {
        return Err(failure);
    }
    let Some(scene) = scene else { return Ok(None) };
    let deck_path = folder.join(&scene.deck);
    let settings = reading.settings(&deck_path)?;
    let deck = input::read_deck(&deck_path, Keep::Interpreted, &settings)?;
    let grammar = settings.grammar;
    let (model, problems) = model::read(&deck, grammar);
    let regime = if scene.is_transient() { Regime::Transient } else { Regime::SteadyState };
    let choices = laws.choices(&model, grammar.dialect(), Some(regime))?;
    let found = settings.apply(check(&deck, grammar, &model, &problems), &deck);
    let mut names: Vec<&Name> = Vec::new();
    for interface in &scene.interfaces {
        let only = model.interactions.keys().next().filter(|_| model.interactions.len() == 1);
        if let Some(name) = interface.interaction.as_ref().or(only)
            && !names.contains(&name)
        {
            names.push(name);
        }
    }
    if say_deck_findings(&found, (&deck, grammar, &model), &names, format) {
        return Ok(None);
    }
    let deck_name = deck_path.display().to_string();
    Ok(Some(SolvableScene { scene, model, choices, name, deck_name }))
}

/// The files beside a scene.
struct FilesBeside<'a> {
    folder: &'a Path,
    /// The first file that could not be read.
    failure: Option<Failure>,
}

impl SceneFiles for FilesBeside<'_> {
    fn read(&mut self, name: &str) -> Option<Vec<u8>> {
        match files::read_bytes(&self.folder.join(name)) {
            Ok(bytes) => Some(bytes),
            Err(failure) => {
                self.failure.get_or_insert(failure);
                None
            }
        }
    }
}
