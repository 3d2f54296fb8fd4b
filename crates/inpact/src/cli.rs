//! The command line as a function, for the program `inpact` and for packages that install the same command.
//!
//! No domain logic here; this is the only place that knows colours and chooses exit codes.
//! Exit codes: 0 done, no errors found; 1 the deck or the data has errors; 2 wrong usage, or a file that cannot be read or written.
//! A closed pipe (`inpact check … | head`) ends quietly with 0.

use crate::{commands, failure, files};
use clap::{CommandFactory, Parser, Subcommand};
use std::ffi::OsString;
use std::process::ExitCode;

/// Checks, converts and evaluates the contact interfaces of Abaqus input decks.
#[derive(Debug, Parser)]
#[command(name = "inpact", version, about, long_about = None, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Check decks and fragments: what is wrong, where, and how to mend it.
    Check(commands::check::CheckArguments),
    /// Format decks: aligned tables and one style, where inpact reads them; the rest stays.
    Fmt(commands::fmt::FormatArguments),
    /// Print a deck as JSON.
    Json(commands::json::JsonArguments),
    /// Write a deck from JSON, either view.
    Inp(commands::inp::InpArguments),
    /// Make the node table of a deck's contact pairs from its mesh: a row a slave node.
    Nodes(commands::nodes::NodesArguments),
    /// Find what the bodies of a deck conduct and hold between surfaces and node sets, and what lumping them costs.
    Body(commands::body::BodyArguments),
    /// Make the interfaces of a scene from the mesh of a deck: a row a slave node, or one a contact pair.
    Interfaces(commands::interfaces::InterfacesArguments),
    /// Evaluate the interface laws of a deck on node data.
    #[command(after_long_help = commands::evaluable::columns_help())]
    Eval(commands::eval::EvalArguments),
    /// Show what an evaluation would do: which laws, tables, columns and outputs, and what is left out and why.
    #[command(after_long_help = commands::evaluable::columns_help())]
    Plan(commands::plan::PlanArguments),
    /// Compare what is computed of a deck's interfaces with what its solver says of them, node by node.
    Compare(commands::compare::CompareArguments),
    /// Draw the laws of decks: conductance, permeability and view factor against clearance and contact pressure.
    Plot(commands::plot::PlotArguments),
    /// Make a page of a deck's interfaces: curves, tables, findings and, with a node table, results; one file that opens anywhere.
    Report(commands::report::ReportArguments),
    /// Make a scene of a deck: its contact pairs, its bodies between them, and its conditions.
    Scene(commands::scene::SceneArguments),
    /// Solve a scene: nodes, bulk conductances and the interfaces of a deck that couple them.
    Solve(commands::solve::SolveArguments),
    /// Measure what accuracy costs: time and error of every mode on a deck and its node data, or of every solver on a scene.
    Tradeoff(commands::tradeoff::TradeoffArguments),
    /// Explain a rule, a keyword, or a column of node tables and results.
    Explain(commands::explain::ExplainArguments),
    /// Serve an editor: findings while typing, fixes, hover, completion, over standard input and output.
    #[cfg(feature = "server")]
    Server(commands::server::ServerArguments),
    /// Print the completions of a shell.
    Completions(commands::shell::CompletionsArguments),
    /// Print the manual page.
    Man,
}

/// Runs the program with these arguments, the name of the program first; results go to standard output, messages to standard error.
///
/// ```
/// use std::process::ExitCode;
///
/// assert_eq!(inpact::cli::run(["inpact", "--version"].map(Into::into)), ExitCode::SUCCESS);
/// ```
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    files::remove_on_signals();
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(error) => return failure::report_usage(&error),
    };
    let result = match arguments.command {
        Command::Check(arguments) => commands::check::run(&arguments),
        Command::Fmt(arguments) => commands::fmt::run(&arguments),
        Command::Json(arguments) => commands::json::run(&arguments),
        Command::Inp(arguments) => commands::inp::run(&arguments),
        Command::Nodes(arguments) => commands::nodes::run(&arguments),
        Command::Body(arguments) => commands::body::run(&arguments),
        Command::Interfaces(arguments) => commands::interfaces::run(&arguments),
        Command::Eval(arguments) => commands::eval::run(&arguments),
        Command::Plan(arguments) => commands::plan::run(&arguments),
        Command::Compare(arguments) => commands::compare::run(&arguments),
        Command::Plot(arguments) => commands::plot::run(&arguments),
        Command::Report(arguments) => commands::report::run(&arguments),
        Command::Scene(arguments) => commands::scene::run(&arguments),
        Command::Solve(arguments) => commands::solve::run(&arguments),
        Command::Tradeoff(arguments) => commands::tradeoff::run(&arguments),
        Command::Explain(arguments) => commands::explain::run(&arguments),
        #[cfg(feature = "server")]
        Command::Server(arguments) => commands::server::run(&arguments),
        Command::Completions(arguments) => commands::shell::completions(&arguments, Arguments::command()),
        Command::Man => commands::shell::manual(&Arguments::command()),
    };
    failure::exit_code(result)
}
