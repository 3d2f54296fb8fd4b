//! The work of `--fix` and `--diff` between checking the decks and printing the findings.

use super::{CheckArguments, Checked, Kind, judge, scene};
use crate::difference;
use crate::failure::{Failure, say, say_failures};
use crate::files::transaction;
use crate::fixing::{self, FixSelection, Mended, Purpose, Subject};
use crate::input::{self, HeldFiles};
use crate::text::counted;
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::path::PathBuf;

/// Result of fixing, for output.
#[derive(Debug, Default)]
pub(super) struct Mending {
    pub(super) differences: String,
    /// Some file could not be written.
    pub(super) has_failed: bool,
}

/// Fixes the decks before anything is printed, as the reader of a pipe may stop.
///
/// Then they are checked in their new state, or in the old one if nothing could be written.
pub(super) fn mend(
    checked: &mut [Result<Checked<'_>, Failure>],
    arguments: &CheckArguments,
    selection: &FixSelection,
) -> Mending {
    let held = HeldFiles::default();
    checked.iter_mut().flatten().filter_map(|checked| checked.held.take()).for_each(|files| held.take_over(files));
    let is_deck = |checked: &&mut Checked<'_>| checked.kind == Kind::Deck;
    let subjects = checked.iter_mut().flatten().filter(is_deck).map(|checked| Subject {
        path: checked.path,
        settings: &checked.settings,
        places: std::mem::take(&mut checked.places),
        need: checked.need,
    });
    let mut subjects: Vec<Subject<'_>> = subjects.collect();
    let Mended { findings, left, failures } = fixing::mend(&mut subjects, &held, selection);
    let places: Vec<Vec<PathBuf>> = subjects.into_iter().map(|subject| subject.places).collect();
    for (checked, places) in checked.iter_mut().flatten().filter(is_deck).zip(places) {
        checked.places = places;
    }
    let mut mending = Mending { has_failed: !failures.is_empty(), ..Mending::default() };
    say_failures(&failures);
    let changed = held.changed();
    let mended = format!("{} in {}", counted(findings, "finding"), counted(changed.len(), "file"));
    let verb = match selection.purpose {
        Purpose::Show => {
            let difference = |file: &input::Held| {
                difference::unified(&file.read.name.display().to_string(), &file.read.bytes, &file.now)
            };
            mending.differences = changed.iter().map(difference).collect();
            "would mend"
        }
        Purpose::Write => match transaction::commit(&held.changes()) {
            Ok(()) => "mended",
            Err(failures) => {
                say_failures(&failures);
                say(&format!("error: nothing is mended, since all files are or none: {mended} could be"));
                return Mending { has_failed: true, ..mending };
            }
        },
    };
    if !arguments.quiet {
        if findings > 0 {
            say(&format!("{verb} {mended}"));
        }
        for left in &left {
            say(&format!("warning: {left}"));
        }
    }
    let changed: BTreeSet<PathBuf> = changed.into_iter().map(|file| file.read.path).collect();
    checked.par_iter_mut().for_each(|result| {
        let Ok(checked) = result else { return };
        if !checked.places.iter().any(|place| changed.contains(place)) {
            return;
        }
        if checked.kind == Kind::Scene {
            match scene::check(checked.path, arguments) {
                Ok(again) => *checked = again,
                Err(failure) => *result = Err(failure),
            }
            return;
        }
        let keep = arguments.keep(checked.path);
        let read = input::read_located_deck(checked.path, keep, &checked.settings, Some(&held));
        match read.and_then(|deck| judge(checked.path, &deck, &checked.settings, arguments)) {
            Ok(judged) => (checked.text, checked.tally) = judged,
            Err(failure) => *result = Err(failure),
        }
    });
    mending
}
