//! `inpact completions` and `inpact man`: files that a package installs with the program.

use crate::failure::{Failure, Outcome};
use crate::files;
use clap::{Args, Command};
use clap_complete::Shell;

#[derive(Debug, Args)]
pub(crate) struct CompletionsArguments {
    /// The shell.
    #[arg(value_enum)]
    shell: Shell,
}

pub(crate) fn completions(arguments: &CompletionsArguments, mut command: Command) -> Result<Outcome, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, "inpact", &mut script);
    files::write_result(None, &script)?;
    Ok(Outcome::Clean)
}

/// Writes the manual page: the program, then each command.
pub(crate) fn manual(command: &Command) -> Result<Outcome, Failure> {
    let mut page = Vec::new();
    let subcommands = command.get_subcommands().filter(|subcommand| !subcommand.is_hide_set());
    let named = subcommands.map(|subcommand| {
        let name = format!("inpact-{}", subcommand.get_name());
        subcommand.clone().name(name)
    });
    for command in std::iter::once(command.clone()).chain(named) {
        clap_mangen::Man::new(command).render(&mut page).map_err(Failure::Output)?;
    }
    files::write_result(None, &page)?;
    Ok(Outcome::Clean)
}
