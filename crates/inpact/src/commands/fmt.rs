//! `inpact fmt`: formats the parts of decks that inpact interprets.
//!
//! Files are formatted one by one; included files are formatted only when they are named as well.

use super::decks::{self, Same};
use crate::difference;
use crate::failure::{Failure, Outcome, say};
use crate::files::transaction::{self, Change, Snapshot};
use crate::files::{self, STANDARD_STREAM};
use crate::input;
use crate::settings::DeckArguments;
use crate::text::counted;
use crate::threads::with_threads;
use clap::Args;
use inpact_parser::deck::scan;
use inpact_parser::format;
use inpact_parser::span::SourceId;
use rayon::prelude::*;
use std::io::Write;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct FormatArguments {
    /// Decks, fragments, or folders of them; `-` reads standard input and writes to standard output.
    ///
    /// In a folder every `.inp` is formatted, but for what `.gitignore` or `exclude` of the configuration names.
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

/// The number of decks in memory at a time.
const AT_A_TIME: usize = 32;

/// Counts of the files.
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
    // Files are formatted even when standard output is closed.
    let mut unwritten = None;
    let decks = decks::find(&arguments.decks, Same::Place, &arguments.reading)?;
    // They are read and formatted in parallel, and written one by one, in order.
    let formatted = decks.chunks(AT_A_TIME).flat_map(|decks| {
        with_threads(0, || decks.par_iter().map(|deck| (&deck.path, read(&deck.path, arguments))).collect::<Vec<_>>())
    });
    for (path, read) in formatted {
        let done = read.and_then(|(before, after)| {
            let is_changed = *before.bytes != *after;
            let to_standard_output = if !only_shown && path.as_os_str() == STANDARD_STREAM {
                after
            } else if !is_changed {
                Vec::new()
            } else if !only_shown {
                write_back(before, after)?;
                Vec::new()
            } else if arguments.diff {
                difference::unified(&path.display().to_string(), &before.bytes, &after).into_bytes()
            } else {
                format!("{}\n", path.display()).into_bytes()
            };
            if unwritten.is_none() {
                unwritten = output.write_all(&to_standard_output).err();
            }
            Ok(is_changed)
        });
        match done {
            Ok(true) => tally.changed += 1,
            Ok(false) => tally.unchanged += 1,
            // The other files are still formatted.
            Err(failure) => {
                say(&format!("error: {failure}"));
                tally.failed += 1;
            }
        }
    }
    if let Some(error) = unwritten {
        return Err(Failure::Output(error));
    }
    output.finish()?;
    say(&tally.summary(if only_shown { "would be formatted" } else { "formatted" }));
    match () {
        () if tally.failed > 0 => Err(Failure::AlreadySaid),
        () if only_shown && tally.changed > 0 => Ok(Outcome::HasErrors),
        () => Ok(Outcome::Clean),
    }
}

/// A file before, and its bytes after.
fn read(path: &Path, arguments: &FormatArguments) -> Result<(Snapshot, Vec<u8>), Failure> {
    input::refuse_scene(path)?;
    let settings = arguments.reading.settings(path)?;
    let before = if path.as_os_str() == STANDARD_STREAM {
        Snapshot::of_text(path, files::read_lines(path)?.into())
    } else {
        Snapshot::read(path)?
    };
    let deck = scan(&path.display().to_string(), &before.bytes, settings.grammar);
    let after = format(&deck, SourceId::ROOT, settings.grammar);
    Ok((before, after))
}

/// Writes a file back, if it is unchanged since it was read.
fn write_back(file: Snapshot, after: Vec<u8>) -> Result<(), Failure> {
    if !file.is_file() {
        let error = std::io::Error::new(std::io::ErrorKind::InvalidInput, "it is no file that can be written back");
        return Err(Failure::write(&file.name, error));
    }
    let committed = transaction::commit(&[Change::of_read(file, after.into())]);
    // One file gives one failure.
    committed.map_err(|failures| failures.into_iter().next().unwrap_or(Failure::AlreadySaid))
}

impl Tally {
    /// `3 files: 1 formatted, 2 left unchanged`.
    fn summary(self, verb: &str) -> String {
        let files = self.changed + self.unchanged + self.failed;
        let files = counted(files, "file");
        let mut summary = format!("{files}: {} {verb}, {} left unchanged", self.changed, self.unchanged);
        if self.failed > 0 {
            summary += &format!(", {} failed", self.failed);
        }
        summary
    }
}
