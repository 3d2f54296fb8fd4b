//! Expands arguments to decks: files as given, folders to the decks in them.
//!
//! In a folder every `.inp` counts, and whatever `include` of the configuration adds; files that `.gitignore` or `exclude` names do not, nor
//! do hidden files. The order is by name, independent of the file system.

mod changed;

pub(crate) use changed::Changed;

use crate::failure::Failure;
use crate::files;
use crate::files::inputs::Identity;
use crate::settings::{DeckArguments, FILE_NAME};
use ignore::WalkBuilder;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A deck to be read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Named {
    pub(crate) path: PathBuf,
    pub(crate) origin: Origin,
}

/// Why a deck is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Origin {
    /// It was named.
    Argument,
    /// It is in a named folder: where another deck includes it, it is checked there.
    Folder,
}

/// When two names are those of one file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Same {
    /// They lead to the same bytes.
    Content,
    /// Their paths are equal with links resolved: of two hard links each is written, since replacing a file breaks the link.
    Place,
}

/// The decks of some paths, in the order of the paths; each once.
pub(crate) fn find(paths: &[PathBuf], same: Same, reading: &DeckArguments) -> Result<Vec<Named>, Failure> {
    let mut decks = Each { decks: Vec::new(), same, contents: BTreeMap::new(), places: BTreeMap::new() };
    for path in paths {
        if path.as_os_str() == files::STANDARD_STREAM || !path.is_dir() {
            decks.add(path.clone(), Origin::Argument);
            continue;
        }
        for path in in_folder(path, reading)? {
            decks.add(path, Origin::Folder);
        }
    }
    Ok(decks.decks)
}

/// Decks, each file once, whatever names refer to it.
struct Each {
    decks: Vec<Named>,
    same: Same,
    /// The number of the deck that each file is.
    contents: BTreeMap<Identity, usize>,
    places: BTreeMap<PathBuf, usize>,
}

impl Each {
    fn add(&mut self, path: PathBuf, origin: Origin) {
        let next = self.decks.len();
        let is_named = path.as_os_str() != files::STANDARD_STREAM;
        if let Some(identity) = Identity::at(&path).filter(|_| is_named) {
            let number = match self.same {
                Same::Content => *self.contents.entry(identity).or_insert(next),
                Same::Place => *self.places.entry(files::whole_path(&path)).or_insert(next),
            };
            if let Some(earlier) = self.decks.get_mut(number) {
                // A named deck is checked on its own, even if it is in a folder as well.
                if origin == Origin::Argument {
                    earlier.origin = origin;
                }
                return;
            }
        }
        self.decks.push(Named { path, origin });
    }
}

fn in_folder(folder: &Path, reading: &DeckArguments) -> Result<Vec<PathBuf>, Failure> {
    let by_name = |a: &std::ffi::OsStr, b: &std::ffi::OsStr| a.cmp(b);
    // `.gitignore` applies with or without a repository.
    let walk = WalkBuilder::new(folder).require_git(false).sort_by_file_name(by_name).build();
    let mut found = Vec::new();
    let mut of_folders = BTreeMap::new();
    for entry in walk {
        let entry = entry.map_err(|error| Failure::Usage(format!("`{}`: {error}", folder.display())))?;
        if !entry.file_type().is_some_and(|kind| kind.is_file()) {
            continue;
        }
        let path = entry.into_path();
        // The configuration is not a scene, whatever `include` says.
        if path.file_name().is_some_and(|name| name == FILE_NAME) {
            continue;
        }
        let parent = files::folder_of(&path).to_owned();
        let settings = match of_folders.get(&parent) {
            Some(settings) => settings,
            None => of_folders.entry(parent).or_insert(reading.settings(&path)?),
        };
        if settings.takes(&path) {
            found.push(path);
        }
    }
    Ok(found)
}

/// Which decks from folders are included by others: those are checked there, and not on their own.
///
/// `places` has the files of each deck, itself first. Of decks that include one another the first is kept.
pub(crate) fn parts_of_others(decks: &[Named], places: &[Vec<PathBuf>]) -> Vec<bool> {
    let mut includers: BTreeMap<&Path, Vec<usize>> = BTreeMap::new();
    for (index, places) in places.iter().enumerate() {
        for place in places.iter().skip(1) {
            includers.entry(place).or_default().push(index);
        }
    }
    let is_part = |(index, deck): (usize, &Named)| {
        let own = places[index].first().filter(|_| deck.origin == Origin::Folder);
        let includers = own.and_then(|own| includers.get(own.as_path()));
        includers.into_iter().flatten().any(|other| {
            let is_mutual = places[*other].first().is_some_and(|place| places[index][1..].contains(place));
            *other != index && (!is_mutual || *other < index)
        })
    };
    decks.iter().enumerate().map(is_part).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(places: &[&[&str]], expected: &[bool]) {
        let decks: Vec<Named> =
            places.iter().map(|places| Named { path: PathBuf::from(places[0]), origin: Origin::Folder }).collect();
        let places: Vec<Vec<PathBuf>> =
            places.iter().map(|places| places.iter().map(PathBuf::from).collect()).collect();
        assert_eq!(parts_of_others(&decks, &places), expected);
    }

    #[test]
    fn a_part_is_judged_where_it_is_included() {
        check(&[&["a", "b"], &["b"], &["c"]], &[false, true, false]);
        check(&[&["a"], &["b", "a"]], &[true, false]);
        check(&[&["a", "b", "c"], &["b", "c"], &["c"]], &[false, true, true]);
        check(&[&["a", "b"], &["b", "a"]], &[false, true]);
        check(&[&["a", "a"]], &[false]);
    }
}
