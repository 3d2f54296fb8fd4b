//! `inpact server`: the language server for editors.

use crate::failure::{Failure, Outcome};
use crate::server;
use clap::Args;

/// Editors start it, and speak the language server protocol to it; docs/editors.md says how.
#[derive(Debug, Args)]
pub(crate) struct ServerArguments {
    /// Accepted because editors pass it: there is no other way to speak to it.
    #[arg(long, hide = true)]
    stdio: bool,
}

pub(crate) fn run(arguments: &ServerArguments) -> Result<Outcome, Failure> {
    let ServerArguments { stdio: _ } = arguments;
    server::run()
}
