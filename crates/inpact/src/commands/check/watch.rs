//! `check --watch`: looks at the files again and again, and checks the decks whose files changed.
//!
//! Files are asked for their time and size: that works wherever decks lie, on a drive of another machine too.

use super::{CheckArguments, check_all};
use crate::commands::decks::{self, Named};
use crate::failure::{Failure, Outcome, say};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// How often the files are asked.
const PAUSE: Duration = Duration::from_millis(300);

/// Marks by which a file is known as the one that was read; `None` for one that is not there.
type Stamp = Option<(Option<SystemTime>, u64)>;

/// A deck: its files, and their state before it was read.
struct Watched {
    stamps: BTreeMap<PathBuf, Stamp>,
}

/// Checks all decks, then those that change, until the program is stopped.
pub(super) fn watch(arguments: &CheckArguments) -> Result<Outcome, Failure> {
    let mut known: BTreeMap<PathBuf, Watched> = BTreeMap::new();
    let mut is_first = true;
    loop {
        let decks = decks::find(&arguments.decks, arguments.same(), &arguments.reading)?;
        known.retain(|path, _| decks.iter().any(|deck| deck.path == *path));
        let has_changed = |deck: &&Named| {
            known
                .get(&deck.path)
                .is_none_or(|watched| watched.stamps.iter().any(|(file, stamp)| stamp_of(file) != *stamp))
        };
        let due: Vec<Named> = decks.iter().filter(has_changed).cloned().collect();
        if !due.is_empty() {
            // Taken before the files are read: what changes meanwhile is seen the next time.
            let before: BTreeMap<PathBuf, Stamp> = known
                .values()
                .flat_map(|watched| watched.stamps.keys())
                .map(|file| (file.clone(), stamp_of(file)))
                .collect();
            let round = check_all(&due, arguments)?;
            for (deck, places) in due.iter().zip(round.places) {
                let files = places.into_iter().chain([deck.path.clone()]).chain(configurations(&deck.path));
                let stamp = |file: PathBuf| {
                    let stamp = before.get(&file).copied().unwrap_or_else(|| stamp_of(&file));
                    (file, stamp)
                };
                known.insert(deck.path.clone(), Watched { stamps: files.map(stamp).collect() });
            }
            if is_first && !arguments.quiet {
                say("watching for changes; Ctrl-C ends it");
            }
            is_first = false;
        }
        std::thread::sleep(PAUSE);
    }
}

/// Where a configuration that counts for a deck may be: one that comes or goes changes what is found as well.
fn configurations(deck: &Path) -> Vec<PathBuf> {
    let folder = crate::reach::folder_of_deck(deck);
    folder.ancestors().map(|folder| folder.join(crate::settings::FILE_NAME)).collect()
}

fn stamp_of(file: &Path) -> Stamp {
    let found = file.metadata().ok()?;
    Some((found.modified().ok(), found.len()))
}
