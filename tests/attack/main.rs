//! The long runs of the attacks: `cargo run -p inpact-tests --bin attack -- SUITE --trials 1000 --page docs/reliability.md`.

use clap::{Parser, ValueEnum};
use inpact_attack::{Report, page};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Attacks the program and counts what is lost.
#[derive(Debug, Parser)]
struct Arguments {
    suite: Suite,
    /// The number of runs.
    #[arg(long, default_value_t = 1000)]
    trials: u64,
    /// Other runs for another seed.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// The program [default: `inpact` beside this one, or the program under test].
    #[arg(long)]
    program: Option<PathBuf>,
    /// Write the figures into their section of this page.
    #[arg(long)]
    page: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Suite {
    /// Runs that are stopped by a signal at a random moment.
    #[cfg(unix)]
    Stops,
    /// Another program edits the deck meanwhile.
    Edits,
    /// Changed JSON, scenes, configurations and node tables.
    Hostile,
}

impl Suite {
    /// The name of its section.
    fn name(self) -> &'static str {
        match self {
            #[cfg(unix)]
            Self::Stops => "stops",
            Self::Edits => "edits",
            Self::Hostile => "hostile",
        }
    }

    fn run(self, program: &Path, trials: u64, seed: u64) -> Report {
        match self {
            #[cfg(unix)]
            Self::Stops => inpact_attack::stops::run(program, trials, seed),
            Self::Edits => inpact_attack::edits::run(program, trials, seed),
            Self::Hostile => inpact_attack::hostile::run(program, trials, seed),
        }
    }
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let beside = std::env::current_exe().ok().and_then(|own| Some(own.parent()?.join("inpact-under-test")));
    let Some(program) = arguments.program.or(beside).and_then(|program| program.canonicalize().ok()) else {
        let _ = writeln!(std::io::stderr(), "there is no program: name it with --program");
        return ExitCode::from(2);
    };
    let report = arguments.suite.run(&program, arguments.trials, arguments.seed);
    let _ = writeln!(std::io::stdout(), "{}", report.text);
    for fault in &report.faults {
        let _ = writeln!(std::io::stderr(), "{fault}");
    }
    if let Some(path) = arguments.page
        && let Err(error) = page::write_section(&path, arguments.suite.name(), &report.text)
    {
        let _ = writeln!(std::io::stderr(), "cannot write `{}`: {error}", path.display());
        return ExitCode::from(2);
    }
    if report.faults.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(1) }
}
