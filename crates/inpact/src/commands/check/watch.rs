//! `check --watch`: polls the files, and checks the decks whose files changed.
//!
//! It compares modification time and size, which works on network drives, too.

use super::{CheckArguments, check_all};
use crate::commands::decks::{self, Named};
use crate::failure::{Failure, Outcome, say};
use crate::files::Stamp;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The polling interval.
const PAUSE: Duration = Duration::from_millis(300);

/// The state of the files of a deck before it was read; `None` for a missing one.
type Stamps = BTreeMap<PathBuf, Option<Stamp>>;

/// Checks all decks, then those that change, until the program is stopped.
pub(super) fn watch(arguments: &CheckArguments) -> Result<Outcome, Failure> {
    let mut known: BTreeMap<PathBuf, Stamps> = BTreeMap::new();
    let mut is_first = true;
    loop {
        let decks = decks::find(&arguments.decks, arguments.same(), &arguments.reading)?;
        known.retain(|path, _| decks.iter().any(|deck| deck.path == *path));
        let has_changed = |deck: &&Named| {
            let is_other = |(file, stamp): (&PathBuf, &Option<Stamp>)| Stamp::of(file) != *stamp;
            known.get(&deck.path).is_none_or(|stamps| stamps.iter().any(is_other))
        };
        let due: Vec<Named> = decks.iter().filter(has_changed).cloned().collect();
        if !due.is_empty() {
            // Taken before the files are read, so that concurrent changes are seen the next time.
            let files = known.values().flat_map(Stamps::keys);
            let before: Stamps = files.map(|file| (file.clone(), Stamp::of(file))).collect();
            let round = check_all(&due, arguments)?;
            for (deck, places) in due.iter().zip(round.places) {
                let files = places.into_iter().chain([deck.path.clone()]).chain(configurations(&deck.path));
                let stamp = |file: PathBuf| {
                    let stamp = before.get(&file).copied().unwrap_or_else(|| Stamp::of(&file));
                    (file, stamp)
                };
                known.insert(deck.path.clone(), files.map(stamp).collect());
            }
            if is_first && !arguments.quiet {
                say("watching for changes; Ctrl-C ends it");
            }
            is_first = false;
        }
        std::thread::sleep(PAUSE);
    }
}

/// The possible paths of a configuration for a deck: creating or removing one changes the findings as well.
fn configurations(deck: &Path) -> Vec<PathBuf> {
    let folder = crate::reach::folder_of_deck(deck);
    folder.ancestors().map(|folder| folder.join(crate::settings::FILE_NAME)).collect()
}
