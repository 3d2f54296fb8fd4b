//! The fixes of a deck in one round: those that do not overlap, in files that may be changed.

use super::{FixReach, FixSelection, Purpose};
use crate::files;
use crate::input::{HeldFiles, LocatedDeck};
use inpact_parser::span::SourceId;
use inpact_validation::{Diagnostic, Edit};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The edits of one round.
#[derive(Debug, Default)]
pub(super) struct Chosen {
    /// By the path of their file; no two overlap.
    pub(super) edits: BTreeMap<PathBuf, Vec<Edit>>,
    /// The number of findings they fix.
    pub(super) findings: usize,
    /// The remaining findings, by file.
    pub(super) left: BTreeMap<PathBuf, Left>,
}

/// Fixes that are not applied to a file.
#[derive(Debug, Clone)]
pub(super) struct Left {
    pub(super) reason: Reason,
    /// By code and place in the file: one that is included twice has each twice.
    pub(super) fixes: BTreeSet<(u64, &'static str)>,
}

/// Reasons why a file is not changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reason {
    /// It lies outside of the folder of the deck.
    Outside,
    /// It is a pipe or a device.
    NoFile,
}

/// Edits by the bytes that they replace.
type Taken = BTreeSet<(u64, u64)>;

/// Chooses among the findings of a deck; the file at `path` and all that are `named` may be changed wherever they are.
pub(super) fn choose(
    found: &[Diagnostic],
    deck: &LocatedDeck,
    (path, named): (&Path, &BTreeSet<PathBuf>),
    held: &HeldFiles,
    selection: &FixSelection,
) -> Chosen {
    let folder = files::folder_of(path).canonicalize().ok();
    let refusal = |place: &Path| {
        if selection.purpose == Purpose::Write && !held.get(place).is_some_and(|file| file.read.is_file()) {
            return Some(Reason::NoFile);
        }
        let is_within = named.contains(place)
            || selection.reach == FixReach::EveryIncluded
            || folder.as_ref().is_some_and(|folder| place.starts_with(folder));
        (!is_within).then_some(Reason::Outside)
    };
    let mut refusals: BTreeMap<SourceId, Option<Reason>> = BTreeMap::new();
    let mut taken: BTreeMap<&Path, Taken> = BTreeMap::new();
    let mut chosen = Chosen::default();
    for (found, fix) in found.iter().filter_map(|found| Some((found, selection.selects(found)?))) {
        // A source without a path was never read.
        let located: Option<Vec<(&Path, &Edit)>> =
            fix.edits.iter().map(|edit| Some((deck.place(edit.span.source())?, edit))).collect();
        let Some(located) = located else { continue };
        let refused = located.iter().find_map(|(place, edit)| {
            let reason = *refusals.entry(edit.span.source()).or_insert_with(|| refusal(place));
            Some((*place, edit.span.start(), reason?))
        });
        if let Some((place, start, reason)) = refused {
            let left = chosen.left.entry(place.to_owned());
            left.or_insert_with(|| Left { reason, fixes: BTreeSet::new() }).fixes.insert((start, found.code));
            continue;
        }
        // A fix is applied as a whole or not at all: overlapping ones wait for the next round.
        let is_free = |(place, edit): &(&Path, &Edit)| taken.get(place).is_none_or(|taken| is_free(taken, edit));
        if !located.iter().all(is_free) {
            continue;
        }
        chosen.findings += 1;
        for (place, edit) in located {
            taken.entry(place).or_default().insert((edit.span.start(), edit.span.end()));
            chosen.edits.entry(place.to_owned()).or_default().push(edit.clone());
        }
    }
    chosen
}

/// Whether an edit overlaps none of those before it.
fn is_free(taken: &Taken, edit: &Edit) -> bool {
    let (start, end) = (edit.span.start(), edit.span.end());
    let before = taken.range(..=(start, u64::MAX)).next_back().copied();
    let after = taken.range((start, 0)..).next().map(|(start, _)| *start);
    let is_before = before.is_none_or(|(other, other_end)| other < start && other_end <= start);
    let is_after = after.is_none_or(|other| start < other && end <= other);
    is_before && is_after
}

#[cfg(test)]
mod tests {
    use super::{Taken, is_free};
    use inpact_parser::span::{SourceId, Span};
    use inpact_validation::Edit;

    #[test]
    fn edits_that_touch_the_same_bytes_are_refused() {
        let taken: Taken = [(10, 20), (30, 30)].into();
        let free = |start, end| is_free(&taken, &Edit::delete(Span::new(SourceId::ROOT, start, end)));
        for (start, end) in [(0, 5), (0, 10), (20, 30), (20, 25), (31, 40), (5, 5), (25, 25)] {
            assert!(free(start, end), "{start}..{end}");
        }
        for (start, end) in [(0, 11), (10, 20), (10, 10), (12, 14), (15, 25), (19, 19), (30, 30), (29, 31), (30, 31)] {
            assert!(!free(start, end), "{start}..{end}");
        }
    }
}
