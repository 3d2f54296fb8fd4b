//! Reading a deck with everything it includes.

mod held;
mod kind;

pub(crate) use held::{Held, HeldFiles};
pub(crate) use kind::{Kind, kind_of, refuse_scene};

use crate::failure::Failure;
use crate::files::{self, STANDARD_STREAM};
use crate::reach::{self, folder_of_deck};
use crate::settings::{RelativeTo, Settings};
use crate::text::in_backticks;
use inpact_diagnostics::Diagnostic;
use inpact_parser::Problem;
use inpact_parser::deck::{Deck, Excerpts, FoundFile, IncludedFiles, Keep, ScanOptions, Scanner};
use inpact_parser::model::{self, Model};
use inpact_parser::span::SourceId;
use inpact_validation::check;
use std::path::{Path, PathBuf};

/// A deck with the paths of its files, which may not be representable as text.
pub(crate) struct LocatedDeck {
    pub(crate) deck: Deck,
    /// The paths of its files by source, the deck itself first; links followed.
    pub(crate) places: Vec<PathBuf>,
}

/// A deck with its model.
pub(crate) struct ReadDeck {
    pub(crate) deck: Deck,
    /// The paths of its files, itself first.
    pub(crate) places: Vec<PathBuf>,
    pub(crate) model: Model,
    pub(crate) problems: Vec<Problem>,
}

impl LocatedDeck {
    pub(crate) fn place(&self, source: SourceId) -> Option<&Path> {
        self.places.get(source.0 as usize).map(PathBuf::as_path)
    }
}

impl ReadDeck {
    /// Reads the deck at `path`, or standard input for `-`, and what it includes.
    pub(crate) fn read(path: &Path, keep: Keep, settings: &Settings) -> Result<Self, Failure> {
        Ok(Self::of(read_located_deck(path, keep, settings, None)?, settings))
    }

    pub(crate) fn of(LocatedDeck { deck, places }: LocatedDeck, settings: &Settings) -> Self {
        let (model, problems) = model::read(&deck, settings.grammar);
        Self { deck, places, model, problems }
    }

    /// The findings of a check, with the configured severities.
    pub(crate) fn check(&self, settings: &Settings) -> Vec<Diagnostic> {
        settings.apply(check(&self.deck, settings.grammar, &self.model, &self.problems))
    }
}

/// Reads the deck at `path`, or standard input for `-`, and what it includes.
pub(crate) fn read_deck(path: &Path, keep: Keep, settings: &Settings) -> Result<Deck, Failure> {
    Ok(read_located_deck(path, keep, settings, None)?.deck)
}

/// Reads the deck at `path` and the files it includes; from files in memory, if there are any, otherwise they are read and kept.
pub(crate) fn read_located_deck(
    path: &Path,
    keep: Keep,
    settings: &Settings,
    held: Option<&HeldFiles>,
) -> Result<LocatedDeck, Failure> {
    if let Some(reason) = reach::leads_astray(path, &settings.include_roots) {
        return Err(Failure::Usage(format!("`{}` is not read: {reason}", path.display())));
    }
    if settings.known_content(path).is_none() {
        refuse_scene(path)?;
    }
    let options = ScanOptions { grammar: settings.grammar, keep };
    let mut scanner = Scanner::new(&path.display().to_string(), options);
    push(path, path, (held, settings), &mut scanner)?;
    let is_file = path.as_os_str() != STANDARD_STREAM;
    let own_folder = folder_of_deck(if is_file { path } else { Path::new("") });
    let places = vec![files::whole_path(path)];
    let mut included = FilesOnDisk { deck: is_file.then_some(path), own_folder, settings, held, places };
    let deck = scanner.finish().with_includes(options, &mut included);
    Ok(LocatedDeck { deck, places: included.places })
}

/// Pushes the file at `path`, named `name` in messages.
fn push(
    path: &Path,
    name: &Path,
    (held, settings): (Option<&HeldFiles>, &Settings),
    scanner: &mut Scanner<'_>,
) -> Result<(), Failure> {
    match (held, settings.known_content(path)) {
        (Some(held), _) => scanner.push(&held.content(path, name)?),
        (None, Some(content)) => content.push_watched(scanner, &|| settings.stop.look()),
        (None, None) => files::push_all(path, scanner)?,
    }
    Ok(())
}

/// The files that a deck on disk includes.
struct FilesOnDisk<'a> {
    /// `None` for standard input.
    deck: Option<&'a Path>,
    /// The canonical path of the deck's folder.
    own_folder: PathBuf,
    settings: &'a Settings,
    held: Option<&'a HeldFiles>,
    /// The paths of the files that were read, the deck first: in the order of their sources.
    places: Vec<PathBuf>,
}

impl IncludedFiles for FilesOnDisk<'_> {
    fn deck(&self) -> Option<PathBuf> {
        let deck = self.deck?;
        deck.canonicalize().ok().or_else(|| self.settings.known_content(deck).map(|_| files::whole_path(deck)))
    }

    fn outside(&mut self, name: &str, from: &str) -> Option<String> {
        let root = self.settings.include_roots.first()?;
        let name = expand(name, |variable| std::env::var(variable).ok()).ok()?;
        let is_inside = |path: &PathBuf| reach::lies_in_all(path, &self.settings.include_roots);
        let mut candidates: Vec<PathBuf> = self.folders(from).map(|folder| folder.join(&name)).collect();
        let first = candidates.first().cloned();
        candidates.retain(|path| self.is_there(path));
        let may_be_found =
            if candidates.is_empty() { first.iter().any(is_inside) } else { candidates.iter().any(is_inside) };
        (!may_be_found).then(|| root.display().to_string())
    }

    fn excerpts(&self, file: &FoundFile) -> Excerpts {
        let is_below = |folder: &PathBuf| file.path.starts_with(folder);
        // A named root, or folder for included files, permits its files.
        let is_meant = !self.settings.include_roots.is_empty()
            || is_below(&self.own_folder)
            || self.settings.named_include_dirs.iter().any(is_below);
        if is_meant { Excerpts::Shown } else { Excerpts::Withheld }
    }

    fn find(&mut self, name: &str, from: &str) -> Result<FoundFile, String> {
        if name.contains(char::REPLACEMENT_CHARACTER) {
            // It replaces bytes that are not text: a file whose name contains the character itself is another one.
            return Err("its name is not UTF-8: rename the file".to_owned());
        }
        let name = &expand(name, |variable| std::env::var(variable).ok())?;
        let beside_includer = folder_of(Path::new(from));
        let folders = self.folders(from);
        for folder in folders.clone() {
            let path = folder.join(name);
            if !self.is_there(&path) || !reach::lies_in_all(&path, &self.settings.include_roots) {
                continue;
            }
            if self.settings.known_content(&path).is_some() {
                return Ok(FoundFile { name: path.display().to_string(), path: files::whole_path(&path) });
            }
            return match reach::irregular(&path) {
                None => match path.canonicalize() {
                    Ok(whole) => Ok(FoundFile { name: path.display().to_string(), path: whole }),
                    Err(error) => Err(error.to_string()),
                },
                Some(reason) => Err(reason.to_owned()),
            };
        }
        let mut reason = format!("there is no such file in {}", in_backticks(folders.map(shown_folder)));
        if beside_includer.join(name).is_file() {
            reason += "; there is one beside the file that includes it (`--relative-to including-file`)";
        }
        Err(reason)
    }

    fn read(&mut self, file: &FoundFile, scanner: &mut Scanner<'_>) -> Result<(), String> {
        // By its path: the name is for display, and may be inexact.
        let pushed = push(&file.path, Path::new(&file.name), (self.held, self.settings), scanner);
        pushed.map_err(|failure| failure.about(Path::new(&file.name)).to_string())?;
        self.places.push(file.path.clone());
        Ok(())
    }
}

impl<'a> FilesOnDisk<'a> {
    fn is_there(&self, path: &Path) -> bool {
        self.settings.known_content(path).is_some() || path.exists()
    }

    /// The folders to which a name may be relative, in search order.
    fn folders<'b>(&self, from: &'b str) -> impl Iterator<Item = &'b Path> + Clone + use<'a, 'b>
    where
        'a: 'b,
    {
        let first = match self.settings.relative_to {
            RelativeTo::Deck => self.deck.map_or(Path::new(""), folder_of),
            RelativeTo::IncludingFile => folder_of(Path::new(from)),
        };
        std::iter::once(first).chain(self.settings.include_dirs.iter().map(PathBuf::as_path))
    }
}

/// Expands environment variables in a file name: `$NAME` and `${NAME}` (S-52).
///
/// # Errors
/// A variable that is not set.
fn expand(name: &str, value_of: impl Fn(&str) -> Option<String>) -> Result<String, String> {
    let mut expanded = String::new();
    let mut rest = name;
    while let Some((before, name)) = rest.split_once('$') {
        expanded += before;
        let is_part = |character: char| character.is_ascii_alphanumeric() || character == '_';
        let (variable, after) = match name.strip_prefix('{').and_then(|inner| inner.split_once('}')) {
            Some((variable, after)) => (variable, after),
            None => name.split_at(name.find(|character| !is_part(character)).unwrap_or(name.len())),
        };
        if variable.is_empty() {
            // A lone dollar is an ordinary character.
            expanded.push('$');
        } else {
            expanded += &value_of(variable).ok_or_else(|| format!("the environment has no variable `{variable}`"))?;
        }
        rest = after;
    }
    Ok(expanded + rest)
}

fn folder_of(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

fn shown_folder(folder: &Path) -> String {
    if folder.as_os_str().is_empty() { ".".to_owned() } else { folder.display().to_string() }
}

#[cfg(test)]
mod tests {
    use super::expand;

    #[test]
    fn s_52_environment_variables() {
        let value_of = |variable: &str| (variable == "DECKS").then(|| "/decks".to_owned());
        assert_eq!(expand("$DECKS/a.inp", value_of), Ok("/decks/a.inp".to_owned()));
        assert_eq!(expand("${DECKS}2/$/b.inp", value_of), Ok("/decks2/$/b.inp".to_owned()));
        assert_eq!(expand("a.inp", value_of), Ok("a.inp".to_owned()));
        assert_eq!(expand("$MESH/a.inp", value_of), Err("the environment has no variable `MESH`".to_owned()));
    }
}
