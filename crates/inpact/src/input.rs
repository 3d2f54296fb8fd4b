//! Reading a deck with everything it includes: the options that say how, and the files themselves.

use crate::failure::Failure;
use crate::files::{self, STANDARD_STREAM};
use clap::{Args, ValueEnum};
use inpact_parser::deck::{Deck, FoundFile, IncludedFiles, Keep, ScanOptions, Scanner};
use inpact_parser::grammar::Grammar;
use std::path::{Path, PathBuf};

/// How a deck is read; the same for every command that reads one.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "How the deck is read")]
pub(crate) struct DeckArguments {
    /// Look for included files here as well; may be given several times.
    #[arg(long, value_name = "FOLDER")]
    include_dir: Vec<PathBuf>,
    /// What the names of included files are relative to.
    #[arg(long, value_enum, default_value_t = RelativeTo::Deck)]
    relative_to: RelativeTo,
}

/// What the names of included files are relative to (S-54).
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum RelativeTo {
    /// The folder of the deck, as for Abaqus.
    Deck,
    /// The folder of the file that includes them.
    IncludingFile,
}

impl DeckArguments {
    /// The keyword language the deck is read in.
    pub(crate) fn grammar(&self) -> &'static Grammar {
        Grammar::builtin()
    }

    /// Reads the deck at `path`, or standard input for `-`, and what it includes.
    pub(crate) fn read(&self, path: &Path, keep: Keep) -> Result<Deck, Failure> {
        let options = ScanOptions { grammar: self.grammar(), keep };
        let mut scanner = Scanner::new(&path.display().to_string(), options);
        files::push_all(path, &mut scanner)?;
        let is_file = path.as_os_str() != STANDARD_STREAM;
        let mut included = FilesOnDisk { deck: is_file.then_some(path), arguments: self };
        Ok(scanner.finish().with_includes(options, &mut included))
    }
}

/// The files that a deck on disk includes.
struct FilesOnDisk<'a> {
    /// `None` for standard input.
    deck: Option<&'a Path>,
    arguments: &'a DeckArguments,
}

impl IncludedFiles for FilesOnDisk<'_> {
    fn deck(&self) -> Option<PathBuf> {
        self.deck?.canonicalize().ok()
    }

    fn find(&mut self, name: &str, from: &str) -> Result<FoundFile, String> {
        let beside_includer = folder_of(Path::new(from));
        let first = match self.arguments.relative_to {
            RelativeTo::Deck => self.deck.map_or(Path::new(""), folder_of),
            RelativeTo::IncludingFile => beside_includer,
        };
        let folders = std::iter::once(first).chain(self.arguments.include_dir.iter().map(PathBuf::as_path));
        for folder in folders.clone() {
            let path = folder.join(name);
            if path.is_file() {
                return identify(&path);
            }
        }
        let searched: Vec<String> = folders.map(|folder| format!("`{}`", shown_folder(folder))).collect();
        let mut reason = format!("there is no such file in {}", searched.join(", "));
        if beside_includer.join(name).is_file() {
            reason += "; there is one beside the file that includes it (`--relative-to including-file`)";
        }
        Err(reason)
    }

    fn read(&mut self, file: &FoundFile, scanner: &mut Scanner<'_>) -> Result<(), String> {
        files::push_all(&file.path, scanner).map_err(|failure| failure.to_string())
    }
}

fn identify(path: &Path) -> Result<FoundFile, String> {
    let whole = path.canonicalize().map_err(|error| error.to_string())?;
    Ok(FoundFile { name: path.display().to_string(), path: whole })
}

fn folder_of(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

fn shown_folder(folder: &Path) -> String {
    if folder.as_os_str().is_empty() { ".".to_owned() } else { folder.display().to_string() }
}
