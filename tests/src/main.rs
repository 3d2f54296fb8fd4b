//! The program under test: the same few lines as the real binary's.

use std::process::ExitCode;

fn main() -> ExitCode {
    inpact::cli::run(std::env::args_os())
}
