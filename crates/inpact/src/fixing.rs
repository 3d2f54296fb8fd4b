//! `check --fix`: applies the fixes of findings to the files that were read, until none is left.
//!
//! All decks of a run share the files in memory, so that a file is fixed once, however many names and decks refer to it.
//! Nothing is written here; changes are written by a transaction.

mod edits;

use self::edits::{Chosen, Left, Reason, choose};
use crate::failure::Failure;
use crate::files;
use crate::input::{self, HeldFiles, LocatedDeck};
use crate::settings::Settings;
use inpact_parser::deck::Keep;
use inpact_parser::model;
use inpact_validation::{Diagnostic, Fix, FixSafety, apply, fixable};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The maximum number of rounds: a fix may reveal another finding, but not endlessly.
const MAX_ROUNDS: usize = 10;

/// The fixes to apply, and the files.
#[derive(Debug, Clone, Default)]
pub(crate) struct FixSelection {
    /// The codes whose fixes are applied although they change the meaning of the deck.
    pub(crate) also: Vec<String>,
    /// The codes whose fixes are applied; `None` for all.
    pub(crate) only: Option<Vec<String>>,
    pub(crate) reach: FixReach,
    pub(crate) purpose: Purpose,
}

/// The included files that may be changed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) enum FixReach {
    /// Those below its folder, and those that are named.
    #[default]
    BelowDeck,
    /// All of them.
    EveryIncluded,
}

/// Purposes of fixing.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) enum Purpose {
    Write,
    #[default]
    Show,
}

/// A deck to fix.
pub(crate) struct Subject<'a> {
    pub(crate) path: &'a Path,
    pub(crate) settings: &'a Settings,
    pub(crate) places: Vec<PathBuf>,
    pub(crate) need: Need,
}

/// Whether a deck has to be checked before another one changes its files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Need {
    Mending,
    Nothing,
}

#[derive(Debug, Default)]
pub(crate) struct Mended {
    /// The number of findings fixed.
    pub(crate) findings: usize,
    /// The remaining findings that have a fix, with the reason.
    pub(crate) left: Vec<String>,
    /// Decks that could not be read again, and files that cannot be written back.
    pub(crate) failures: Vec<Failure>,
}

impl FixSelection {
    fn selects<'a>(&self, found: &'a Diagnostic) -> Option<&'a Fix> {
        let fix = found.fix.as_ref()?;
        let is_wanted = fix.safety == FixSafety::Safe || self.also.iter().any(|code| code == found.code);
        let is_meant = self.only.as_ref().is_none_or(|only| only.iter().any(|code| code == found.code));
        (is_wanted && is_meant).then_some(fix)
    }
}

/// Whether a deck has anything to fix.
pub(crate) fn need_of(deck: &LocatedDeck, settings: &Settings, selection: &FixSelection) -> Need {
    let found = findings(deck, settings);
    if found.iter().any(|found| selection.selects(found).is_some()) { Need::Mending } else { Need::Nothing }
}

/// All findings with a fix, however many there are.
fn findings(LocatedDeck { deck, .. }: &LocatedDeck, settings: &Settings) -> Vec<Diagnostic> {
    let (model, problems) = model::read(deck, settings.grammar);
    settings.apply(fixable(deck, settings.grammar, &model, &problems))
}

/// Applies the fixes of all decks to the files in memory.
pub(crate) fn mend(subjects: &mut [Subject<'_>], held: &HeldFiles, selection: &FixSelection) -> Mended {
    let named: BTreeSet<PathBuf> = subjects.iter().map(|subject| files::whole_path(subject.path)).collect();
    let mut mended = Mended::default();
    let mut left: Vec<BTreeMap<PathBuf, Left>> = subjects.iter().map(|_| BTreeMap::new()).collect();
    let mut due: Vec<usize> = (0..subjects.len()).filter(|index| subjects[*index].need == Need::Mending).collect();
    for round in 0..=MAX_ROUNDS {
        let mut touched: BTreeSet<PathBuf> = BTreeSet::new();
        for index in due {
            let subject = &mut subjects[index];
            let deck = match input::read_located_deck(subject.path, Keep::Interpreted, subject.settings, Some(held)) {
                Ok(deck) => deck,
                Err(failure) => {
                    mended.failures.push(failure);
                    continue;
                }
            };
            subject.places.clone_from(&deck.places);
            let chosen = choose(&findings(&deck, subject.settings), &deck, (subject.path, &named), held, selection);
            let Chosen { edits, findings, left: left_here } = chosen;
            left[index] = left_here;
            if round == MAX_ROUNDS {
                if !edits.is_empty() {
                    let name = subject.path.display();
                    mended.left.push(format!(
                        "mending `{name}` brings up further findings after {MAX_ROUNDS} rounds: run it again"
                    ));
                }
                continue;
            }
            mended.findings += findings;
            for (place, edits) in edits {
                if let Some(file) = held.get(&place) {
                    held.set(&place, apply(&file.now, &edits));
                    touched.insert(place);
                }
            }
        }
        if touched.is_empty() {
            break;
        }
        let is_touched = |subject: &Subject<'_>| subject.places.iter().any(|place| touched.contains(place));
        due = (0..subjects.len()).filter(|index| is_touched(&subjects[*index])).collect();
    }
    for (reason, text) in explain(subjects, left, held) {
        match reason {
            Reason::Outside => mended.left.push(text),
            Reason::NoFile => mended.failures.push(Failure::Usage(text)),
        }
    }
    mended
}

/// Reports the remaining findings of each file and the reason; each file once.
fn explain(subjects: &[Subject<'_>], left: Vec<BTreeMap<PathBuf, Left>>, held: &HeldFiles) -> Vec<(Reason, String)> {
    let mut by_place: BTreeMap<PathBuf, (Left, &Path)> = BTreeMap::new();
    for (subject, left) in subjects.iter().zip(left) {
        for (place, left) in left {
            let entry = by_place.entry(place).or_insert_with(|| (left.clone(), subject.path));
            entry.0.fixes.extend(left.fixes);
        }
    }
    let explained = by_place.into_iter().map(|(place, (left, deck))| {
        let name = held.get(&place).map_or_else(|| place.clone(), |file| file.read.name);
        let number = left.fixes.len();
        let (fixes, them) = if number == 1 { ("1 fix is", "it") } else { (&*format!("{number} fixes are"), "them") };
        let (name, deck) = (name.display(), deck.display());
        let text = match left.reason {
            Reason::Outside => format!(
                "{fixes} not applied to `{name}`, which lies outside of the folder of `{deck}` (`--fix-included` applies {them})"
            ),
            Reason::NoFile => {
                format!("{fixes} not applied to `{name}`, which is no file that can be written back (`--diff` shows {them})")
            }
        };
        (left.reason, text)
    });
    explained.collect()
}
