//! `inpact check`: decks and scenes in, diagnostics out.

mod mending;
mod scene;
mod tally;
mod watch;

use self::mending::Mending;
use self::tally::Tally;
use super::decks::{self, Changed, Named, Same};
use super::laws::LawArguments;
use super::meshed::mesh_of;
use crate::failure::{Failure, Outcome, say};
use crate::files;
use crate::fixing::{self, FixReach, FixSelection, Need, Purpose};
use crate::input::{self, HeldFiles, Kind, LocatedDeck, kind_of};
use crate::progress::Progress;
use crate::render::{self, Format, Sources, Style};
use crate::settings::{DeckArguments, Settings};
use crate::text::{counted, in_backticks};
use crate::threads::with_threads;
use clap::Args;
use inpact_contact::check_geometry;
use inpact_diagnostics::visible::visible_line;
use inpact_parser::deck::Keep;
use inpact_parser::model;
use inpact_validation::RULES;
use inpact_validation::{Severity, check_with};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct CheckArguments {
    /// Decks, fragments, or folders of them, and scenes; `-` reads standard input.
    ///
    /// In a folder every `.inp` is checked, but for what `.gitignore` or `exclude` of the configuration names; one that another includes is judged there.
    /// A scene is named: a `.toml`, or a file that begins as one. It is judged with its tables and its deck as `solve` judges it, and not solved.
    #[arg(required = true, value_name = "DECK")]
    decks: Vec<PathBuf>,
    /// How to print what was found.
    #[arg(long, value_enum, default_value_t = Format::Full)]
    format: Format,
    /// Where to write what was found, instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Mend what can be mended without changing what the deck means, and write the files back: all of them, or none where one cannot be written.
    ///
    /// Mended are the decks that are named, and of the files that they include those below the folder of the deck; scenes are not.
    #[arg(long)]
    fix: bool,
    /// Mend the findings of these rules as well, though it changes what the deck means: T001,S006.
    #[arg(long, value_name = "CODES", value_delimiter = ',')]
    fix_also: Vec<String>,
    /// Mend the included files that lie outside of the folder of the deck as well.
    #[arg(long)]
    fix_included: bool,
    /// Show what fixing would change, and write nothing.
    #[arg(long)]
    diff: bool,
    /// Print how often each rule found something, instead of the findings; with `--format json` as an array.
    #[arg(long)]
    statistics: bool,
    /// Check only decks that have files which differ from where this branch left REF, as git says.
    #[arg(long, value_name = "REF")]
    since: Option<String>,
    /// Go on, and check the decks again whose files change.
    #[arg(long, conflicts_with_all = ["fix", "fix_also", "fix_included", "diff", "output", "timings"])]
    watch: bool,
    /// End with 0 even when there are errors.
    #[arg(long)]
    exit_zero: bool,
    /// Look at the geometry of contact pairs as well, where the deck has a mesh: rules G001 and on.
    #[arg(long)]
    geometry: bool,
    /// Say nothing on standard error but failures.
    #[arg(short, long)]
    quiet: bool,
    /// Print how long each rule took.
    #[arg(long, hide = true)]
    timings: bool,
    #[command(flatten)]
    reading: DeckArguments,
    #[command(flatten, next_help_heading = "Laws of scenes")]
    laws: LawArguments,
}

/// Result of checking one deck or scene.
struct Checked<'a> {
    path: &'a Path,
    kind: Kind,
    settings: Settings,
    text: String,
    tally: Tally,
    /// Further notes, a line each.
    remarks: Vec<String>,
    /// The paths of its files, itself first.
    places: Vec<PathBuf>,
    need: Need,
    /// The files of a deck that needs mending.
    held: Option<HeldFiles>,
}

impl CheckArguments {
    /// Rows are kept where they cannot be read a second time: those of a stream, and of files that are changed.
    fn keep(&self, path: &Path) -> Keep {
        let is_file = path.metadata().is_ok_and(|metadata| metadata.is_file());
        let can_be_read_again = is_file && self.selection().is_none();
        match (self.geometry, can_be_read_again) {
            (true, false) => Keep::Everything,
            (true, true) | (false, false) => Keep::Interpreted,
            (false, true) => Keep::Ends,
        }
    }

    fn same(&self) -> Same {
        if self.selection().is_some() { Same::Place } else { Same::Content }
    }

    fn style(&self) -> Style {
        if self.output.is_some() { Style::Plain } else { Style::of_standard_output() }
    }

    /// Whether findings are printed one by one.
    fn shows_findings(&self) -> bool {
        !self.statistics && !self.diff
    }

    /// The fixes to apply; `None` without `--fix` and `--diff`.
    fn selection(&self) -> Option<FixSelection> {
        let is_wanted = self.fix || self.diff || self.fix_included || !self.fix_also.is_empty();
        is_wanted.then(|| FixSelection {
            also: self.fix_also.clone(),
            only: None,
            reach: if self.fix_included { FixReach::EveryIncluded } else { FixReach::BelowDeck },
            purpose: if self.diff { Purpose::Show } else { Purpose::Write },
        })
    }
}

pub(crate) fn run(arguments: &CheckArguments) -> Result<Outcome, Failure> {
    if let Some(unknown) = arguments.fix_also.iter().find(|code| !RULES.iter().any(|rule| rule.code == **code)) {
        return Err(Failure::Usage(format!("`--fix-also`: there is no rule `{unknown}`")));
    }
    files::refuse_second_stream(&arguments.decks)?;
    // Not only files that are read: `check nothing.inp -o nothing.inp` is a mistake as well.
    files::name_as_inputs(&arguments.decks);
    files::check_targets(&[arguments.output.as_deref()])?;
    if arguments.timings {
        return time_rules(arguments);
    }
    if arguments.watch {
        return watch::watch(arguments);
    }
    let decks = decks::find(&arguments.decks, arguments.same(), &arguments.reading)?;
    if decks.is_empty() {
        let folders = in_backticks(arguments.decks.iter().map(|path| path.display()));
        say(&format!("warning: there is no deck in {folders}"));
    }
    Ok(check_all(&decks, arguments)?.outcome)
}

/// Results of checking some decks.
struct Round {
    outcome: Outcome,
    /// The files of each deck; none for one that could not be read.
    places: Vec<Vec<PathBuf>>,
}

/// Checks decks, fixes them on request, and reports the findings.
fn check_all(decks: &[Named], arguments: &CheckArguments) -> Result<Round, Failure> {
    let changed = arguments.since.as_deref().map(Changed::since).transpose()?;
    let progress = Progress::over(decks.iter().map(|deck| deck.path.as_path()), arguments.quiet);
    let mut checked: Vec<Result<Checked<'_>, Failure>> = with_threads(0, || {
        let decks = decks.par_iter();
        decks.map(|deck| check_one(&deck.path, arguments, &progress)).collect()
    });
    progress.finish();
    let places_of = |result: &Result<Checked<'_>, Failure>| match result {
        Ok(checked) => checked.places.clone(),
        Err(_) => Vec::new(),
    };
    let places: Vec<Vec<PathBuf>> = checked.iter().map(places_of).collect();
    // The input files of a scene are not checked as parts of it: its deck is checked as a whole.
    let includes = |result: &Result<Checked<'_>, Failure>| match result {
        Ok(Checked { kind: Kind::Scene, places, .. }) => places.iter().take(1).cloned().collect(),
        result => places_of(result),
    };
    let including: Vec<Vec<PathBuf>> = checked.iter().map(includes).collect();
    let mut parts = decks::parts_of_others(decks, &including).into_iter();
    checked.retain(|result| {
        let is_part = parts.next() == Some(true);
        let has_changed = |checked: &Checked<'_>| {
            changed.as_ref().is_none_or(|changed| checked.places.iter().any(|place| changed.has(place)))
        };
        !is_part && result.as_ref().map_or(true, has_changed)
    });
    let mending = match arguments.selection() {
        Some(selection) => with_threads(0, || mending::mend(&mut checked, arguments, &selection)),
        None => Mending::default(),
    };
    let mut output = files::ResultFile::create(arguments.output.as_deref())?;
    let mut total = Tally::default();
    let mut unreadable = mending.has_failed;
    let (mut kinds, mut remarks): (Vec<Kind>, Vec<String>) = (Vec::new(), Vec::new());
    let document = render::document(arguments.format);
    let has_frame = arguments.shows_findings();
    let mut text = if has_frame { document.head } else { String::new() };
    let mut is_first = true;
    for result in checked {
        match result {
            Ok(checked) => {
                kinds.push(checked.kind);
                remarks.extend(checked.remarks);
                if !is_first && !checked.text.is_empty() {
                    text += document.separator;
                }
                is_first &= checked.text.is_empty();
                text += &checked.text;
                output.put(text.as_bytes())?;
                text.clear();
                total.add(&checked.tally);
            }
            // The other decks are still checked.
            Err(failure) => {
                say(&format!("error: {failure}"));
                unreadable = true;
            }
        }
    }
    if arguments.statistics {
        text += &total.statistics(arguments.format);
    } else if has_frame {
        text += &document.tail;
    }
    text += &mending.differences;
    output.put(text.as_bytes())?;
    output.finish()?;
    if !arguments.quiet && (!kinds.is_empty() || changed.is_some()) {
        for remark in &remarks {
            say(&visible_line(remark));
        }
        let scenes = kinds.iter().filter(|kind| **kind == Kind::Scene).count();
        say(&total.summary(kinds.len() - scenes, scenes));
        if arguments.statistics && total.fixable() > 0 {
            say(&format!("[*] `--fix` mends {}", counted(total.fixable(), "finding")));
        }
    }
    let outcome = match () {
        // With `--watch` the user can repair an unreadable file.
        () if unreadable && !arguments.watch => return Err(Failure::AlreadySaid),
        () if total.of(Severity::Error) > 0 && !arguments.exit_zero => Outcome::HasErrors,
        () => Outcome::Clean,
    };
    Ok(Round { outcome, places })
}

fn check_one<'a>(path: &'a Path, arguments: &CheckArguments, progress: &Progress) -> Result<Checked<'a>, Failure> {
    match kind_of(path) {
        Kind::Deck => check_deck(path, arguments, progress),
        Kind::Scene => scene::check(path, arguments).inspect(|_| progress.advance(path)),
    }
}

/// Checks a deck without changing it; the files of one to be fixed are kept in memory.
fn check_deck<'a>(path: &'a Path, arguments: &CheckArguments, progress: &Progress) -> Result<Checked<'a>, Failure> {
    let selection = arguments.selection();
    let mut settings = arguments.reading.settings(path)?;
    arguments.format.confine(&mut settings, path);
    if selection.is_some() && path.as_os_str() == files::STANDARD_STREAM {
        return Err(Failure::Usage("standard input cannot be mended in place: name a file".to_owned()));
    }
    let held = selection.as_ref().map(|_| HeldFiles::default());
    let mut deck = input::read_located_deck(path, arguments.keep(path), &settings, held.as_ref())?;
    progress.advance(path);
    let need = selection.map_or(Need::Nothing, |selection| fixing::need_of(&deck, &settings, &selection));
    let (mut text, mut tally) = judge(path, &deck, &settings, arguments)?;
    if deck.deck.lacks_rows() {
        // There is a finding in a table that was not kept completely.
        drop(deck);
        deck = input::read_located_deck(path, Keep::Interpreted, &settings, None)?;
        (text, tally) = judge(path, &deck, &settings, arguments)?;
    }
    let held = held.filter(|_| need == Need::Mending);
    let (kind, remarks, places) = (Kind::Deck, Vec::new(), deck.places);
    Ok(Checked { path, kind, settings, text, tally, remarks, places, need, held })
}

/// The findings of a deck.
fn judge(
    path: &Path,
    located: &LocatedDeck,
    settings: &Settings,
    arguments: &CheckArguments,
) -> Result<(String, Tally), Failure> {
    let deck = &located.deck;
    let (model, problems) = model::read(deck, settings.grammar);
    let of_geometry = if arguments.geometry {
        let mesh = mesh_of(path, located, arguments.keep(path), &model, settings)?;
        if mesh.pairs.is_empty() && !arguments.quiet {
            say(&visible_line(&format!("{}: no contact pair with a mesh: no geometry is checked", path.display())));
        }
        check_geometry(&mesh, &model)
    } else {
        Vec::new()
    };
    let diagnostics = settings.apply(check_with(deck, settings.grammar, &model, &problems, of_geometry));
    let shown = if arguments.shows_findings() { &diagnostics[..] } else { &[] };
    let text = render::diagnostics(shown, Sources::Deck(deck), arguments.format, arguments.style());
    Ok((text, Tally::of_findings(&diagnostics)))
}

/// Reads every deck and prints how long each stage and each rule took, in milliseconds.
fn time_rules(arguments: &CheckArguments) -> Result<Outcome, Failure> {
    let mut text = String::new();
    for path in &arguments.decks {
        if kind_of(path) == Kind::Scene {
            return Err(Failure::Usage(format!(
                "`--timings`: `{}` is a scene, and rules of decks are timed",
                path.display()
            )));
        }
        let settings = arguments.reading.settings(path)?;
        let start = std::time::Instant::now();
        let deck = input::read_deck(path, Keep::Interpreted, &settings)?;
        text += &format!("{:10.3} ms  scan\n", milliseconds(start));
        let start = std::time::Instant::now();
        let (model, problems) = model::read(&deck, settings.grammar);
        text += &format!("{:10.3} ms  read\n", milliseconds(start));
        let start = std::time::Instant::now();
        let times = inpact_validation::time_rules(&deck, settings.grammar, &model, &problems, || start.elapsed());
        for (code, time) in times {
            text += &format!("{:10.3} ms  {code}\n", time.as_secs_f64() * 1e3);
        }
    }
    files::write_result(arguments.output.as_deref(), text.as_bytes())?;
    Ok(Outcome::Clean)
}

fn milliseconds(start: std::time::Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}
