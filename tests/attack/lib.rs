//! Attacks on the program: long runs of a suite write their section of `docs/reliability.md`, short ones are tests.
//!
//! A suite is a function from a program, a number of trials and a seed to a [`Report`]; a new one gets a file here, a line in
//! `main.rs`, where its long runs are started, and one in `bounded.rs`, where its short ones are tests.

pub mod chance;
pub mod edits;
pub mod hostile;
pub mod page;
#[cfg(unix)]
pub mod stops;

use std::path::Path;
use std::process::{Command, Stdio};

/// Result of a suite.
#[derive(Debug, Default)]
pub struct Report {
    /// The counts, as Markdown.
    pub text: String,
    /// The faults, each with the trial that it happened in.
    pub faults: Vec<String>,
}

/// The program, to be started in a folder, silent.
pub fn command(program: &Path, folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(program);
    command.args(arguments).current_dir(folder).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command
}

/// The names in a folder that only temporary files of the program have.
pub fn leftovers(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
    names.filter(|name| name.starts_with(".inpact-")).collect()
}
