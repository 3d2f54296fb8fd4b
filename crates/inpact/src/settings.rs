//! Settings for reading and checking a deck: `inpact.toml`, searched upwards from the deck, and the options or arguments that override it.

mod arguments;

pub(crate) use self::arguments::DeckArguments;

use crate::failure::Failure;
use crate::files;
use crate::reach::{folder_of_deck, irregular};
use crate::rules;
use crate::stop::Stop;
use clap::ValueEnum;
use globset::{Glob, GlobSet};
use inpact_diagnostics::{Diagnostic, Severity};
use inpact_parser::deck::{EditedText, Keep};
use inpact_parser::grammar::{Dialect, Grammar, Release};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

pub(crate) const FILE_NAME: &str = "inpact.toml";

/// Options of reading a deck: by default as in the `inpact.toml` above the deck, and otherwise as documented.
///
/// ```
/// use inpact::{Deck, Dialect, ReadOptions};
///
/// let options = ReadOptions::new().isolated().dialect(Dialect::Calculix);
/// let deck = Deck::parse("joint.inp", "*SURFACE INTERACTION, NAME=A\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n", &options)?;
/// assert_eq!(deck.check(), []);
/// # Ok::<(), inpact::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct ReadOptions {
    pub(crate) dialect: Option<Dialect>,
    pub(crate) release: Option<Release>,
    pub(crate) include_dirs: Vec<PathBuf>,
    pub(crate) include_root: Option<PathBuf>,
    pub(crate) relative_to: Option<RelativeTo>,
    pub(crate) configuration: Configuration,
    pub(crate) keep: Keep,
    pub(crate) overlay: Overlay,
    /// Whether somebody has asked for the end of reading.
    pub(crate) stop: Stop,
}

#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) enum Configuration {
    /// The nearest above the deck.
    #[default]
    Nearest,
    /// This one.
    File(PathBuf),
    /// None.
    Nothing,
}

/// Files with content in memory, by their canonical paths: open in an editor, or parsed from a text.
pub(crate) type Overlay = BTreeMap<PathBuf, EditedText>;

impl ReadOptions {
    /// The options of the configuration above the deck.
    pub fn new() -> Self {
        Self::default()
    }

    /// Whose keyword language the deck is in; Abaqus' unless said otherwise.
    #[must_use]
    pub fn dialect(mut self, dialect: Dialect) -> Self {
        self.dialect = Some(dialect);
        self
    }

    /// Sets the release of Abaqus that the deck is for; the newest by default.
    #[must_use]
    pub fn release(mut self, release: Release) -> Self {
        self.release = Some(release);
        self
    }

    /// Looks for included files in this folder as well.
    #[must_use]
    pub fn include_dir(mut self, folder: impl Into<PathBuf>) -> Self {
        self.include_dirs.push(folder.into());
        self
    }

    /// Reads no included file outside of this folder.
    #[must_use]
    pub fn include_root(mut self, folder: impl Into<PathBuf>) -> Self {
        self.include_root = Some(folder.into());
        self
    }

    /// Sets the folder that the names of included files are relative to (S-54); that of the deck by default.
    #[must_use]
    pub fn relative_to(mut self, relative_to: RelativeTo) -> Self {
        self.relative_to = Some(relative_to);
        self
    }

    /// Reads this configuration instead of the `inpact.toml` above the deck.
    #[must_use]
    pub fn configuration(mut self, file: impl Into<PathBuf>) -> Self {
        self.configuration = Configuration::File(file.into());
        self
    }

    /// Reads no configuration.
    #[must_use]
    pub fn isolated(mut self) -> Self {
        self.configuration = Configuration::Nothing;
        self
    }

    /// Keeps the text of every row, of meshes too, which [`Deck::to_syntax_json`](crate::Deck::to_syntax_json) needs and takes memory.
    #[must_use]
    pub fn keep_everything(mut self) -> Self {
        self.keep = Keep::Everything;
        self
    }

    /// Takes `content` for what is in the file at `path`, be it there or not: the unsaved text of an editor.
    #[must_use]
    pub fn file(mut self, path: impl AsRef<Path>, content: impl Into<Vec<u8>>) -> Self {
        self.overlay.insert(files::whole_path(path.as_ref()), EditedText::new(&content.into()));
        self
    }
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

impl DialectName {
    fn dialect(self) -> Dialect {
        match self {
            Self::Abaqus => Dialect::Abaqus,
            Self::Calculix => Dialect::Calculix,
        }
    }
}

/// Bases of the names of included files (S-54).
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum RelativeTo {
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
    /// Which files of a folder are decks besides `*.inp`; paths relative to this file, with `*`, `**` and `?`.
    #[serde(default)]
    include: Vec<String>,
    /// Which files of a folder are none.
    #[serde(default)]
    exclude: Vec<String>,
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
    ignores: Vec<(GlobSet, Vec<String>)>,
    /// Which files of a folder are decks besides `*.inp`, and which are none.
    include: GlobSet,
    exclude: GlobSet,
    /// The folder of the configuration file, which the paths in `ignores` are relative to.
    root: PathBuf,
    /// Files whose content is known.
    pub(crate) overlay: Overlay,
    /// Whether somebody has asked for the end of reading.
    pub(crate) stop: Stop,
}

impl Settings {
    /// The settings for the deck at `path`: the configuration above it, overridden by the options.
    ///
    /// # Errors
    /// The configuration cannot be read, or has a wrong value.
    pub(crate) fn of(path: &Path, options: &ReadOptions) -> Result<Self, Failure> {
        let (file, found) = match options.configuration_of(path) {
            Some(found) => (read(&found)?, found),
            None => (File::default(), PathBuf::new()),
        };
        let root = found.parent().unwrap_or(Path::new(""));
        let release = match (options.release, &file.release) {
            (Some(release), _) => release,
            (None, Some(release)) => {
                release.parse().map_err(|error| in_file(&found, &format!("`release`: {error}")))?
            }
            (None, None) => Release::NEWEST,
        };
        let dialect = options.dialect.or(file.dialect.map(DialectName::dialect)).unwrap_or_default();
        let from_file = file.include_dirs.iter().map(|folder| root.join(folder));
        let include_root = match (&options.include_root, &file.include_root) {
            (Some(folder), _) => Some(whole_folder(folder, "--include-root")?),
            (None, Some(RootEntry::Folder(folder))) => Some(whole_folder(&root.join(folder), "include-root")?),
            (None, Some(RootEntry::Repository(true))) => Some(repository_of(path)),
            (None, Some(RootEntry::Repository(false)) | None) => None,
        };
        let named = options.include_dirs.iter();
        let ignored = file.ignore.into_iter().map(|of| Ok((globs(&of.paths, &found, "ignore.paths")?, of.rules)));
        let ignores = ignored.collect::<Result<_, Failure>>()?;
        Ok(Self {
            grammar: grammar_of(dialect, release),
            include_dirs: named.clone().cloned().chain(from_file).collect(),
            named_include_dirs: named.filter_map(|folder| folder.canonicalize().ok()).collect(),
            include_roots: include_root.into_iter().collect(),
            has_named_root: options.include_root.is_some(),
            relative_to: options.relative_to.or(file.relative_to).unwrap_or(RelativeTo::Deck),
            levels: file.rules,
            ignores,
            include: globs(&file.include, &found, "include")?,
            exclude: globs(&file.exclude, &found, "exclude")?,
            root: found.canonicalize().ok().and_then(|found| Some(found.parent()?.to_owned())).unwrap_or_default(),
            overlay: options.overlay.clone(),
            stop: options.stop.clone(),
        })
    }
}

#[cfg(feature = "server")]
impl Settings {
    /// The settings where nothing says anything.
    pub(crate) fn unconfigured(overlay: Overlay) -> Self {
        Self {
            grammar: Grammar::builtin(),
            include_dirs: Vec::new(),
            named_include_dirs: Vec::new(),
            relative_to: RelativeTo::Deck,
            include_roots: Vec::new(),
            has_named_root: false,
            levels: BTreeMap::new(),
            ignores: Vec::new(),
            include: GlobSet::empty(),
            exclude: GlobSet::empty(),
            root: PathBuf::new(),
            overlay,
            stop: Stop::default(),
        }
    }
}

impl ReadOptions {
    /// The configuration file that counts for a deck: the one that is named, or the nearest above the deck.
    pub(crate) fn configuration_of(&self, path: &Path) -> Option<PathBuf> {
        match &self.configuration {
            Configuration::Nothing => return None,
            Configuration::File(file) => return Some(file.clone()),
            Configuration::Nearest => {}
        }
        let folder = files::folder_of(path).canonicalize().ok()?;
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

fn read(path: &Path) -> Result<File, Failure> {
    let text = files::read_text(path)?;
    let wrong = |message: &str| Failure::Usage(format!("`{}`: {message}", path.display()));
    // A configuration comes with the deck: where it is a link, the lines of its target are not quoted.
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

/// The patterns of a key of the configuration.
fn globs(patterns: &[String], file: &Path, key: &str) -> Result<GlobSet, Failure> {
    let wrong = |error| in_file(file, &format!("`{key}`: {error}"));
    let globs = patterns.iter().map(|pattern| Glob::new(pattern)).collect::<Result<Vec<_>, _>>();
    GlobSet::new(globs.map_err(wrong)?).map_err(wrong)
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
    /// Settings in `inpact.toml` can only take away from that: it comes with the deck.
    pub(crate) fn confine_to_repository(&mut self, deck: &Path) {
        if !self.has_named_root {
            self.include_roots.push(repository_of(deck));
        }
    }

    /// The content of a file, where it is known without reading.
    pub(crate) fn known_content(&self, path: &Path) -> Option<&EditedText> {
        if self.overlay.is_empty() { None } else { self.overlay.get(&files::whole_path(path)) }
    }

    /// Whether the content of any file is known without reading it.
    pub(crate) fn has_known_content(&self) -> bool {
        !self.overlay.is_empty()
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

    /// Whether a file of a folder is a deck: `*.inp` and what `include` adds, but for what `exclude` names.
    pub(crate) fn takes(&self, file: &Path) -> bool {
        let relative = self.relative(file);
        let is_deck = file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("inp"));
        (is_deck || self.include.is_match(&relative)) && !self.exclude.is_match(&relative)
    }

    /// A file as the patterns of the configuration name it.
    fn relative(&self, file: &Path) -> PathBuf {
        let whole = file.canonicalize().unwrap_or_else(|_| file.to_owned());
        whole.strip_prefix(&self.root).map(Path::to_owned).unwrap_or(whole)
    }

    fn is_ignored(&self, code: &str, file: &Path) -> bool {
        let relative = self.relative(file);
        self.ignores.iter().any(|(paths, codes)| codes.iter().any(|of| of == code) && paths.is_match(&relative))
    }
}
