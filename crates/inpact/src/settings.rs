//! How a deck is read and judged: `inpact.toml`, found upward from the deck, and the arguments that override it.

use crate::failure::Failure;
use crate::files;
use crate::reach::irregular;
use crate::rules;
use clap::{Args, ValueEnum};
use globset::{Glob, GlobMatcher};
use inpact_diagnostics::{Diagnostic, Severity};
use inpact_parser::grammar::{Dialect, Grammar, Release};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// The name of the configuration file.
pub(crate) const FILE_NAME: &str = "inpact.toml";

/// How a deck is read; the same for every command that reads one.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "How the deck is read")]
pub(crate) struct DeckArguments {
    /// Whose keyword language the deck is in [default: abaqus].
    #[arg(long, value_enum)]
    dialect: Option<DialectName>,
    /// Which release of Abaqus the deck is for: 6.11, 6.14, 2016, 2017, 2022, 2024 [default: 2024].
    #[arg(long)]
    release: Option<Release>,
    /// Look for included files here as well; may be given several times.
    #[arg(long, value_name = "FOLDER")]
    include_dir: Vec<PathBuf>,
    /// Read no included file outside of this folder [default: the repository, for `--format github` and `--format sarif`].
    #[arg(long, value_name = "FOLDER")]
    include_root: Option<PathBuf>,
    /// What the names of included files are relative to [default: deck].
    #[arg(long, value_enum)]
    relative_to: Option<RelativeTo>,
    /// Read this configuration instead of the `inpact.toml` above the deck.
    #[arg(long, value_name = "FILE", conflicts_with = "isolated")]
    config: Option<PathBuf>,
    /// Read no configuration.
    #[arg(long)]
    isolated: bool,
}

/// The dialects by the names users give them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Deserialize)]
#[serde(rename_all = "lowercase")]
enum DialectName {
    /// Abaqus/Standard and Abaqus/Explicit.
    Abaqus,
    /// CalculiX ccx.
    Calculix,
}

/// What the names of included files are relative to (S-54).
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum RelativeTo {
    /// The folder of the deck, as for Abaqus.
    Deck,
    /// The folder of the file that includes them.
    IncludingFile,
}

/// `inpact.toml`.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct File {
    dialect: Option<DialectName>,
    release: Option<String>,
    #[serde(default)]
    include_dirs: Vec<PathBuf>,
    include_root: Option<RootEntry>,
    relative_to: Option<RelativeTo>,
    /// The severity of a rule by its code; `off` silences it.
    #[serde(default)]
    rules: BTreeMap<String, Level>,
    #[serde(default)]
    ignore: Vec<IgnoreEntry>,
}

/// `include-root`: a folder, relative to the configuration file, or `true` for the repository.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged, expecting = "expected a folder, or `true` for the repository")]
enum RootEntry {
    Repository(bool),
    Folder(PathBuf),
}

/// Rules that do not count for some files.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct IgnoreEntry {
    /// Paths relative to the configuration file, with `*`, `**` and `?`.
    paths: Vec<String>,
    /// Codes.
    rules: Vec<String>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Level {
    Off,
    Note,
    Warning,
    Error,
}

/// What counts for one deck.
#[derive(Debug, Clone)]
pub(crate) struct Settings {
    pub(crate) grammar: &'static Grammar,
    pub(crate) include_dirs: Vec<PathBuf>,
    /// The include folders that arguments name: whoever runs the program knows them.
    pub(crate) named_include_dirs: Vec<PathBuf>,
    pub(crate) relative_to: RelativeTo,
    /// Whole paths of the folders outside of which nothing is read; a file must lie in all of them.
    pub(crate) include_roots: Vec<PathBuf>,
    /// Whether an argument says what the only root is.
    has_named_root: bool,
    levels: BTreeMap<String, Level>,
    ignores: Vec<(Vec<GlobMatcher>, Vec<String>)>,
    /// The folder of the configuration file, which the paths in `ignores` are relative to.
    root: PathBuf,
}

impl DeckArguments {
    /// The settings for the deck at `path`: the configuration above it, overridden by the arguments.
    ///
    /// # Errors
    /// When the configuration cannot be read, or says what it cannot say.
    pub(crate) fn settings(&self, path: &Path) -> Result<Settings, Failure> {
        let (file, found) = match self.configuration_of(path) {
            Some(found) => (read(&found)?, found),
            None => (File::default(), PathBuf::new()),
        };
        let root = found.parent().unwrap_or(Path::new(""));
        let release = match (self.release, &file.release) {
            (Some(release), _) => release,
            (None, Some(release)) => {
                release.parse().map_err(|error| in_file(&found, &format!("`release`: {error}")))?
            }
            (None, None) => Release::NEWEST,
        };
        let dialect = match self.dialect.or(file.dialect) {
            Some(DialectName::Calculix) => Dialect::Calculix,
            Some(DialectName::Abaqus) | None => Dialect::Abaqus,
        };
        let from_file = file.include_dirs.iter().map(|folder| root.join(folder));
        let include_root = match (&self.include_root, &file.include_root) {
            (Some(folder), _) => Some(whole_folder(folder, "--include-root")?),
            (None, Some(RootEntry::Folder(folder))) => Some(whole_folder(&root.join(folder), "include-root")?),
            (None, Some(RootEntry::Repository(true))) => Some(repository_of(path)),
            (None, Some(RootEntry::Repository(false)) | None) => None,
        };
        Ok(Settings {
            grammar: grammar_of(dialect, release),
            include_dirs: self.include_dir.iter().cloned().chain(from_file).collect(),
            named_include_dirs: self.include_dir.iter().filter_map(|folder| folder.canonicalize().ok()).collect(),
            include_roots: include_root.into_iter().collect(),
            has_named_root: self.include_root.is_some(),
            relative_to: self.relative_to.or(file.relative_to).unwrap_or(RelativeTo::Deck),
            levels: file.rules,
            ignores: file.ignore.iter().map(|entry| matchers(entry, &found)).collect::<Result<_, _>>()?,
            root: found.canonicalize().ok().and_then(|found| Some(found.parent()?.to_owned())).unwrap_or_default(),
        })
    }

    /// The configuration file that counts for a deck: the one that is named, or the nearest above the deck.
    fn configuration_of(&self, path: &Path) -> Option<PathBuf> {
        if self.isolated {
            return None;
        }
        if self.config.is_some() {
            return self.config.clone();
        }
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let folder = folder.canonicalize().ok()?;
        folder.ancestors().map(|folder| folder.join(FILE_NAME)).find(|file| file.is_file() && irregular(file).is_none())
    }
}

/// The whole path of a folder that is named as a root.
fn whole_folder(folder: &Path, named_by: &str) -> Result<PathBuf, Failure> {
    let whole = folder.canonicalize().map_err(|error| Failure::read(folder, error))?;
    if whole.is_dir() {
        return Ok(whole);
    }
    Err(Failure::Usage(format!("`{named_by}`: `{}` is no folder", folder.display())))
}

/// The nearest folder above a deck that has `.git`; the deck's folder where there is none.
fn repository_of(deck: &Path) -> PathBuf {
    let folder = folder_of_deck(deck);
    let repository = folder.ancestors().find(|folder| folder.join(".git").exists());
    repository.map_or_else(|| folder.clone(), Path::to_owned)
}

/// The whole path of the folder that a deck is named in; the working folder for standard input.
pub(crate) fn folder_of_deck(deck: &Path) -> PathBuf {
    let folder = deck.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    folder.canonicalize().unwrap_or_else(|_| folder.to_owned())
}

fn read(path: &Path) -> Result<File, Failure> {
    let text = files::read_text(path)?;
    let wrong = |message: &str| Failure::Usage(format!("`{}`: {message}", path.display()));
    // A configuration comes with the deck: where it is a link, the lines of what it leads to are nobody's business.
    let is_link = path.is_symlink();
    let shown = |error: &toml::de::Error| if is_link { error.message().to_owned() } else { error.to_string() };
    let file: File = toml::from_str(&text).map_err(|error| wrong(shown(&error).trim_end()))?;
    let levels = file.rules.iter().map(|(code, level)| (code, *level));
    let ignored = file.ignore.iter().flat_map(|entry| &entry.rules).map(|code| (code, Level::Off));
    for (code, level) in levels.chain(ignored) {
        let Some(rule) = rules::of_code(code) else {
            return Err(wrong(&format!("there is no rule `{code}`")));
        };
        if rules::is_final(rule) && level != Level::Error {
            let message = format!("`{code}` ({}) is always an error: data that has it cannot be evaluated", rule.name);
            return Err(wrong(&message));
        }
    }
    Ok(file)
}

fn in_file(file: &Path, message: &str) -> Failure {
    Failure::Usage(format!("`{}`: {message}", file.display()))
}

fn matchers(entry: &IgnoreEntry, file: &Path) -> Result<(Vec<GlobMatcher>, Vec<String>), Failure> {
    let compile = |pattern: &String| {
        let glob = Glob::new(pattern).map_err(|error| in_file(file, &format!("`ignore.paths`: {error}")))?;
        Ok(glob.compile_matcher())
    };
    Ok((entry.paths.iter().map(compile).collect::<Result<_, Failure>>()?, entry.rules.clone()))
}

/// The language of a dialect and release; made once, and there are few.
fn grammar_of(dialect: Dialect, release: Release) -> &'static Grammar {
    static MADE: Mutex<Vec<&'static Grammar>> = Mutex::new(Vec::new());
    if (dialect, release) == (Dialect::Abaqus, Release::NEWEST) {
        return Grammar::builtin();
    }
    let mut made = MADE.lock().unwrap_or_else(PoisonError::into_inner);
    let same = |grammar: &&&Grammar| (grammar.dialect(), grammar.release()) == (dialect, release);
    if let Some(grammar) = made.iter().find(same) {
        return grammar;
    }
    let grammar: &'static Grammar = Box::leak(Box::new(Grammar::new(dialect, release)));
    made.push(grammar);
    grammar
}

impl Settings {
    /// Reads nothing outside of the repository of a deck, unless an argument names another root.
    ///
    /// What `inpact.toml` says can only take away from that: it comes with the deck.
    pub(crate) fn confine_to_repository(&mut self, deck: &Path) {
        if !self.has_named_root {
            self.include_roots.push(repository_of(deck));
        }
    }

    /// Changes severities as configured, and leaves out what is switched off or ignored for this file.
    pub(crate) fn apply(&self, diagnostics: Vec<Diagnostic>) -> Vec<Diagnostic> {
        if self.levels.is_empty() && self.ignores.is_empty() {
            return diagnostics;
        }
        let judged = diagnostics.into_iter().filter_map(|mut found| {
            if self.is_ignored(found.code, Path::new(&*found.primary.file)) {
                return None;
            }
            match self.levels.get(found.code) {
                Some(Level::Off) => return None,
                Some(Level::Note) => found.severity = Severity::Note,
                Some(Level::Warning) => found.severity = Severity::Warning,
                Some(Level::Error) => found.severity = Severity::Error,
                None => {}
            }
            Some(found)
        });
        judged.collect()
    }

    fn is_ignored(&self, code: &str, file: &Path) -> bool {
        let whole = file.canonicalize().unwrap_or_else(|_| file.to_owned());
        let relative = whole.strip_prefix(&self.root).unwrap_or(&whole);
        let matches = |matchers: &[GlobMatcher]| matchers.iter().any(|matcher| matcher.is_match(relative));
        self.ignores.iter().any(|(paths, codes)| codes.iter().any(|ignored| ignored == code) && matches(paths))
    }
}
