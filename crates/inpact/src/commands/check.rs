//! `inpact check`: decks in, diagnostics out.

use crate::difference;
use crate::failure::{Failure, Outcome, say};
use crate::files;
use crate::fixing::{self, FixSelection, Fixed};
use crate::input;
use crate::progress::Progress;
use crate::render::{self, Format, Style};
use crate::settings::DeckArguments;
use crate::threads::with_threads;
use clap::Args;
use inpact_parser::deck::Keep;
use inpact_parser::model;
use inpact_validation::rules::RULES;
use inpact_validation::{Diagnostic, Severity, check};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(crate) struct CheckArguments {
    /// Decks or fragments; `-` reads standard input.
    #[arg(required = true, value_name = "DECK")]
    decks: Vec<PathBuf>,
    /// How to print what was found.
    #[arg(long, value_enum, default_value_t = Format::Full)]
    format: Format,
    /// Where to write what was found, instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Mend what can be mended without changing what the deck means, and write the files back.
    #[arg(long)]
    fix: bool,
    /// Mend the findings of these rules as well, though it changes what the deck means: T001,S006.
    #[arg(long, value_name = "CODES", value_delimiter = ',')]
    fix_also: Vec<String>,
    /// Show what fixing would change, and write nothing.
    #[arg(long)]
    diff: bool,
    /// Print how often each rule found something, instead of the findings.
    #[arg(long)]
    statistics: bool,
    /// End with 0 even when there are errors.
    #[arg(long)]
    exit_zero: bool,
    /// Say nothing on standard error but failures.
    #[arg(short, long)]
    quiet: bool,
    /// Print how long each rule took.
    #[arg(long, hide = true)]
    timings: bool,
    #[command(flatten)]
    reading: DeckArguments,
}

/// What came of one deck.
struct Checked {
    text: String,
    tally: Tally,
    fixed: Fixed,
}

/// How many findings there were, by severity and by code.
#[derive(Debug, Default, Clone)]
struct Tally {
    severities: BTreeMap<Severity, usize>,
    codes: BTreeMap<&'static str, usize>,
}

pub(crate) fn run(arguments: &CheckArguments) -> Result<Outcome, Failure> {
    if let Some(unknown) = arguments.fix_also.iter().find(|code| !RULES.iter().any(|rule| rule.code == **code)) {
        return Err(Failure::Usage(format!("`--fix-also`: there is no rule `{unknown}`")));
    }
    let standard_input = arguments.decks.iter().filter(|path| path.as_os_str() == files::STANDARD_STREAM);
    if standard_input.count() > 1 {
        return Err(Failure::Usage("standard input can be read only once".to_owned()));
    }
    files::refuse_overwriting(arguments.output.as_deref(), &arguments.decks)?;
    if arguments.timings {
        return time_rules(arguments);
    }
    let style = if arguments.output.is_some() { Style::Plain } else { Style::of_standard_output() };
    let progress = Progress::over(&arguments.decks, arguments.quiet);
    let checked: Vec<Result<Checked, Failure>> = with_threads(0, || {
        arguments.decks.par_iter().map(|path| check_deck(path, arguments, style, &progress)).collect()
    });
    progress.finish();
    let mut output = files::ResultFile::create(arguments.output.as_deref())?;
    let mut total = Tally::default();
    let (mut unreadable, mut decks, mut fixes, mut fixed_files) = (false, 0, 0, 0);
    let document = render::document(arguments.format);
    let has_frame = !arguments.statistics && !arguments.diff;
    let mut text = if has_frame { document.head } else { String::new() };
    let mut is_first = true;
    for result in checked {
        match result {
            Ok(checked) => {
                decks += 1;
                if !is_first && !checked.text.is_empty() {
                    text += document.separator;
                }
                is_first &= checked.text.is_empty();
                text += &checked.text;
                output.write_all(text.as_bytes()).map_err(|error| output.failure(error))?;
                text.clear();
                total.add(&checked.tally);
                fixes += checked.fixed.findings;
                fixed_files += checked.fixed.files.len();
                if !arguments.diff {
                    write_back(&checked.fixed)?;
                }
            }
            // The other decks are still checked.
            Err(failure) => {
                say(&format!("error: {failure}"));
                unreadable = true;
            }
        }
    }
    if arguments.statistics {
        text += &total.statistics();
    } else if has_frame {
        text += &document.tail;
    }
    output.write_all(text.as_bytes()).map_err(|error| output.failure(error))?;
    output.finish()?;
    if !arguments.quiet {
        if fixes > 0 {
            let verb = if arguments.diff { "would mend" } else { "mended" };
            say(&format!("{verb} {} in {}", count(fixes, "finding"), count(fixed_files, "file")));
        }
        if decks > 0 {
            say(&total.summary(decks));
        }
    }
    match () {
        () if unreadable => Err(Failure::AlreadySaid),
        () if total.of(Severity::Error) > 0 && !arguments.exit_zero => Ok(Outcome::HasErrors),
        () => Ok(Outcome::Clean),
    }
}

fn check_deck(path: &Path, arguments: &CheckArguments, style: Style, progress: &Progress) -> Result<Checked, Failure> {
    let mut settings = arguments.reading.settings(path)?;
    if matches!(arguments.format, Format::Github | Format::Sarif) {
        // Decks of strangers are checked for these.
        settings.confine_to_repository(path);
    }
    let fixed = if arguments.fix || arguments.diff || !arguments.fix_also.is_empty() {
        if path.as_os_str() == files::STANDARD_STREAM {
            return Err(Failure::Usage("standard input cannot be mended in place: name a file".to_owned()));
        }
        let selection = FixSelection { also: arguments.fix_also.clone() };
        fixing::fix(path, &settings, &selection)?
    } else {
        Fixed::default()
    };
    let overlay = fixed.files.iter().map(|(path, (_, after))| (path.clone(), after.clone())).collect();
    let deck = input::read_deck_over(path, Keep::Interpreted, &settings, &overlay)?;
    progress.advance(path);
    let (model, problems) = model::read(&deck, settings.grammar);
    let diagnostics = settings.apply(check(&deck, settings.grammar, &model, &problems), &deck);
    let text = if arguments.diff {
        let changes = fixed.files.iter();
        changes.map(|(path, (before, after))| difference::unified(&path.display().to_string(), before, after)).collect()
    } else if arguments.statistics {
        String::new()
    } else {
        render::diagnostics(&diagnostics, &deck, arguments.format, style)
    };
    Ok(Checked { text, tally: Tally::of_findings(&diagnostics), fixed })
}

fn write_back(fixed: &Fixed) -> Result<(), Failure> {
    for (path, (before, after)) in &fixed.files {
        if before != after {
            files::rewrite(path, after)?;
        }
    }
    Ok(())
}

/// Reads every deck and prints how long each stage and each rule took, in milliseconds.
fn time_rules(arguments: &CheckArguments) -> Result<Outcome, Failure> {
    let mut text = String::new();
    for path in &arguments.decks {
        let settings = arguments.reading.settings(path)?;
        let start = std::time::Instant::now();
        let deck = input::read_deck(path, Keep::Interpreted, &settings)?;
        text += &format!("{:10.3} ms  scan\n", milliseconds(start));
        let start = std::time::Instant::now();
        let (model, problems) = model::read(&deck, settings.grammar);
        text += &format!("{:10.3} ms  read\n", milliseconds(start));
        for (code, time) in inpact_validation::time_rules(&deck, settings.grammar, &model, &problems) {
            text += &format!("{:10.3} ms  {code}\n", time.as_secs_f64() * 1e3);
        }
    }
    files::write_result(arguments.output.as_deref(), text.as_bytes())?;
    Ok(Outcome::Clean)
}

fn milliseconds(start: std::time::Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}

fn count(number: usize, word: &str) -> String {
    format!("{number} {word}{}", if number == 1 { "" } else { "s" })
}

impl Tally {
    fn of_findings(diagnostics: &[Diagnostic]) -> Self {
        let mut tally = Self::default();
        for found in diagnostics {
            *tally.severities.entry(found.severity).or_default() += 1;
            *tally.codes.entry(found.code).or_default() += 1;
        }
        tally
    }

    fn add(&mut self, other: &Self) {
        for (severity, number) in &other.severities {
            *self.severities.entry(*severity).or_default() += number;
        }
        for (code, number) in &other.codes {
            *self.codes.entry(code).or_default() += number;
        }
    }

    fn of(&self, severity: Severity) -> usize {
        self.severities.get(&severity).copied().unwrap_or(0)
    }

    fn summary(&self, decks: usize) -> String {
        if self.codes.is_empty() {
            return format!("{}: nothing to report", count(decks, "deck"));
        }
        let of = |severity: Severity| count(self.of(severity), severity.word());
        format!("{}: {}, {}, {}", count(decks, "deck"), of(Severity::Error), of(Severity::Warning), of(Severity::Note))
    }

    /// A line a code: how often, code, name.
    fn statistics(&self) -> String {
        let mut lines: Vec<_> = self.codes.iter().collect();
        lines.sort_by_key(|(code, number)| (std::cmp::Reverse(**number), **code));
        let name = |code: &str| RULES.iter().find(|rule| rule.code == code).map_or("", |rule| rule.name);
        lines.iter().map(|(code, number)| format!("{number:8}  {code}  {}\n", name(code))).collect()
    }
}
