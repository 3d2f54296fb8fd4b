//! `inpact fmt`: decks rewritten in one style where inpact interprets them.
//!
//! A file is formatted by itself; what it includes is formatted only when it is named as well.

use crate::difference;
use crate::failure::{Failure, Outcome, say};
use crate::files::{self, STANDARD_STREAM};
use crate::settings::DeckArguments;
use clap::Args;
use inpact_parser::deck::scan;
use inpact_parser::format::format;
use inpact_parser::span::SourceId;
use std::io::Write;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct FormatArguments {
    /// Decks or fragments; `-` reads standard input and writes to standard output.
    #[arg(required = true, value_name = "DECK")]
    decks: Vec<PathBuf>,
    /// List the files that would change, and write nothing; ends with 1 if there are any.
    #[arg(long)]
    check: bool,
    /// Show what would change, and write nothing; ends with 1 if anything would.
    #[arg(long)]
    diff: bool,
    #[command(flatten)]
    reading: DeckArguments,
}

/// What became of the files.
#[derive(Debug, Default, Clone, Copy)]
struct Tally {
    changed: usize,
    unchanged: usize,
    failed: usize,
}

pub(crate) fn run(arguments: &FormatArguments) -> Result<Outcome, Failure> {
    let only_shown = arguments.check || arguments.diff;
    let mut output = files::ResultFile::create(None)?;
    let mut tally = Tally::default();
    for path in &arguments.decks {
        let done = read(path, arguments).and_then(|(before, after)| {
            let is_changed = before != after;
            let to_standard_output = if !only_shown {
                let is_stream = path.as_os_str() == STANDARD_STREAM;
                if is_changed && !is_stream {
                    files::rewrite(path, &after)?;
                }
                if is_stream { after } else { Vec::new() }
            } else if !is_changed {
                Vec::new()
            } else if arguments.diff {
                difference::unified(&path.display().to_string(), &before, &after).into_bytes()
            } else {
                format!("{}\n", path.display()).into_bytes()
            };
            output.write_all(&to_standard_output).map_err(Failure::Output)?;
            Ok(is_changed)
        });
        match done {
            Ok(true) => tally.changed += 1,
            Ok(false) => tally.unchanged += 1,
            // Nobody reads what is written: nothing is left to do.
            Err(failure @ Failure::Output(_)) => return Err(failure),
            // The other files are still formatted.
            Err(failure) => {
                say(&format!("error: {failure}"));
                tally.failed += 1;
            }
        }
    }
    output.finish()?;
    say(&tally.summary(if only_shown { "would be formatted" } else { "formatted" }));
    match () {
        () if tally.failed > 0 => Err(Failure::AlreadySaid),
        () if only_shown && tally.changed > 0 => Ok(Outcome::HasErrors),
        () => Ok(Outcome::Clean),
    }
}

/// The bytes of a file before and after.
fn read(path: &Path, arguments: &FormatArguments) -> Result<(Vec<u8>, Vec<u8>), Failure> {
    let settings = arguments.reading.settings(path)?;
    let before = files::read_bytes(path)?;
    let deck = scan(&path.display().to_string(), &before, settings.grammar);
    let after = format(&deck, SourceId::ROOT, settings.grammar);
    Ok((before, after))
}

impl Tally {
    /// `3 files: 1 formatted, 2 left unchanged`.
    fn summary(self, verb: &str) -> String {
        let files = self.changed + self.unchanged + self.failed;
        let noun = if files == 1 { "file" } else { "files" };
        let mut summary = format!("{files} {noun}: {} {verb}, {} left unchanged", self.changed, self.unchanged);
        if self.failed > 0 {
            summary += &format!(", {} failed", self.failed);
        }
        summary
    }
}
