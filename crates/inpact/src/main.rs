//! `inpact`: checks, converts and evaluates the contact interfaces of Abaqus input decks.

use std::process::ExitCode;

fn main() -> ExitCode {
    inpact::cli::run(std::env::args_os())
}
