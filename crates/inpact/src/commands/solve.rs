//! `inpact solve`: a scene in, the state of its nodes out.

mod interfaces;
mod output;
mod summary;

use self::output::{Outputs, StateFormat};
use super::choice::{Choice, one_of};
use super::evaluable::tolerance;
use super::findings::{Messages, with_messages};
use super::laws::LawArguments;
use super::solvable::{Ended, SolvableScene};
use crate::failure::{Failure, Outcome};
use crate::files::{self, STANDARD_STREAM};
use crate::render::Format;
use crate::settings::DeckArguments;
use crate::threads::with_threads;
use clap::Args;
use inpact_network::linear::{LAST_DIGIT, Method};
use inpact_network::transient;
use inpact_network::{Equations, Histories, State};
use std::path::PathBuf;
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
    /// How to print findings on standard error, instead of a line each, or of JSON with `--format json`.
    #[arg(long, value_enum, value_name = "FORMAT")]
    findings: Option<Format>,
    /// Write the result table of the interfaces, as `eval` gives it; .csv, .parquet, .arrow by the extension.
    #[arg(long, value_name = "FILE")]
    interfaces: Option<PathBuf>,
    /// Give the flow through each link as well: after the state, or with =FILE in a table of its own.
    #[arg(long, value_name = "FILE", num_args = 0..=1, require_equals = true, default_missing_value = STANDARD_STREAM)]
    links: Option<PathBuf>,
    /// How linear equations are solved.
    #[arg(long, value_parser = one_of(&SOLVERS), default_value = "direct")]
    solver: Method,
    /// The relative error of a flow that is acceptable; a solver that does not reach it is replaced by the next safer one [default: the last digit].
    #[arg(long, value_name = "X", value_parser = tolerance)]
    tolerance: Option<f64>,
    #[command(flatten)]
    laws: LawArguments,
    #[command(flatten)]
    reading: DeckArguments,
}

const SOLVERS: [Choice<Method>; 3] = [
    ("direct", Method::Direct, "A Cholesky factor in f64"),
    ("mixed", Method::Mixed, "A Cholesky factor in f32, refined in f64: half the memory, faster in three dimensions"),
    (
        "iterative",
        Method::Iterative,
        "Conjugate gradients with an incomplete factor: for networks whose factor would not fit",
    ),
];

pub(crate) fn run(arguments: &SolveArguments) -> Result<Outcome, Failure> {
    let format = arguments.findings.unwrap_or(arguments.format.of_findings());
    with_messages(format, |messages| with_threads(0, || run_on_threads(arguments, messages)))
}

fn run_on_threads(arguments: &SolveArguments, mut messages: Messages<'_>) -> Result<Outcome, Failure> {
    let start = Instant::now();
    let targets = [arguments.output.as_deref(), arguments.interfaces.as_deref(), arguments.links.as_deref()];
    files::check_targets(&targets)?;
    let reading = arguments.reading.options();
    let prepared = SolvableScene::read(&arguments.scene, &arguments.laws, &reading, &mut messages)?;
    let Some(prepared) = prepared else { return Ok(Outcome::HasErrors) };
    // The input files of the scene are known now.
    files::check_targets(&targets)?;
    let Some(problem) = prepared.problem(&mut messages) else { return Ok(Outcome::HasErrors) };
    let method = arguments.solver;
    let histories = if arguments.interfaces.is_some() { Histories::Wanted } else { Histories::NotWanted };
    let tolerance = arguments.tolerance.unwrap_or(LAST_DIGIT);
    let mut equations = Equations::new(&problem, method, tolerance).with(histories);
    let mut outputs = Outputs::create(arguments, &prepared, &problem)?;
    let mut last: Option<State> = None;
    let ran = transient::run(&mut equations, |state| {
        outputs.take(state).map_err(Ended::Taking)?;
        last = Some(state.clone());
        Ok(())
    });
    let ran = match ran {
        Ok(report) => Some(report),
        Err(Ended::Taking(failure)) => return Err(failure),
        Err(Ended::Solving(failure)) => {
            let found = prepared.findings(&failure, last.as_ref().map(|state| state.time));
            messages.data(prepared.quoted(found, &messages), &prepared.settings);
            None
        }
    };
    let Some(last) = last else { return Ok(Outcome::HasErrors) };
    // The states before a failure are valid, and were expensive: they are kept like those of a complete run.
    outputs.finish(&last, messages)?;
    let Some(report) = ran else { return Ok(Outcome::HasErrors) };
    let summary = summary::Summary {
        problem: &problem,
        state: &last,
        report: &report,
        name: &prepared.name,
        time: start.elapsed(),
    };
    messages.tell(|| summary.text(), || summary.json().to_string());
    Ok(Outcome::Clean)
}
