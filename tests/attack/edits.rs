//! Another program edits the deck while it is being mended or formatted: its edit is never lost, and no file is torn.

use crate::chance::Chance;
use crate::{Report, command, leftovers};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::Write;
use std::path::Path;
use std::time::{Duration, Instant};

/// The line that the other program adds to the deck.
const MARK: &str = "** two hours of work\n";

/// Ways of saving by the other program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Manner {
    /// It writes another file and renames it.
    Rename,
    /// It opens the file, which empties it, and writes in two pieces.
    Overwrite,
    /// It opens the file and writes at its end a while later.
    Append,
}

const MANNERS: [(Manner, &str); 3] = [
    (Manner::Rename, "writes a new file and renames it"),
    (Manner::Overwrite, "empties the file and writes it in two pieces"),
    (Manner::Append, "opens the file and appends a while later"),
];

const JOBS: [(&str, &[&str]); 2] =
    [("check --fix", &["check", "--isolated", "--fix", "d.inp"]), ("fmt", &["fmt", "--isolated", "d.inp"])];

/// Outcomes of the edits that were saved in one manner.
#[derive(Debug, Default)]
struct Counts {
    trials: u64,
    /// The program wrote nothing and said so.
    refused: u64,
    /// The deck is mended and has the edit.
    both: u64,
    /// The edit came last, or was all that there was to read.
    edit_only: u64,
    lost: u64,
    torn: u64,
}

/// Starts `trials` runs and edits the deck of each meanwhile.
///
/// # Panics
/// When the runs cannot be prepared.
pub fn run(program: &Path, trials: u64, seed: u64) -> Report {
    let mut chance = Chance::new(seed);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("d.inp");
    let old = deck();
    let undisturbed: Vec<(String, Duration)> = JOBS
        .iter()
        .map(|(name, arguments)| {
            fs::write(&path, &old).expect("writable");
            let start = Instant::now();
            let status = command(program, folder.path(), arguments).status().expect("the program starts");
            assert_eq!(status.code(), Some(0), "{name}");
            let new = fs::read_to_string(&path).expect("readable");
            assert_ne!(new, old, "{name} changes nothing");
            (new, start.elapsed())
        })
        .collect();
    let mut counts: BTreeMap<Manner, Counts> = BTreeMap::new();
    let mut report = Report::default();
    for trial in 0..trials {
        let manner = chance.one_of(&MANNERS).0;
        let index = usize::try_from(chance.below(JOBS.len() as u64)).unwrap_or(0);
        let ((job, arguments), (new, time)) = (JOBS[index], &undisturbed[index]);
        let delay = chance.time_up_to(time.mul_f64(1.1));
        let pause = chance.time_up_to(time.mul_f64(0.3));
        fs::write(&path, &old).expect("writable");
        let mut child = command(program, folder.path(), arguments).spawn().expect("the program starts");
        std::thread::sleep(delay);
        save(&path, manner, pause);
        let status = child.wait().expect("it ends");
        let found = fs::read_to_string(&path).unwrap_or_default();
        let counts = counts.entry(manner).or_default();
        counts.trials += 1;
        let place = format!("trial {trial}, {job}, {manner:?} after {delay:?} and {pause:?}");
        match found.strip_suffix(MARK) {
            Some(deck) if deck == old => counts.edit_only += 1,
            Some(deck) if deck == new => counts.both += 1,
            Some(_) => {
                counts.torn += 1;
                report.faults.push(format!("{place}: the deck is torn"));
            }
            None => {
                counts.lost += 1;
                report.faults.push(format!("{place}: the edit is lost"));
            }
        }
        match status.code() {
            Some(2) => counts.refused += 1,
            Some(0 | 1) => {}
            _ => report.faults.push(format!("{place}: ended with {status}")),
        }
        for name in leftovers(folder.path()) {
            report.faults.push(format!("{place}: left {name}"));
            let _ = fs::remove_file(folder.path().join(name));
        }
    }
    report.text = text(&counts, trials, seed, &report.faults);
    report
}

fn text(counts: &BTreeMap<Manner, Counts>, trials: u64, seed: u64, faults: &[String]) -> String {
    let mut text = format!(
        "## Decks that others edit meanwhile\n\n\
         `cargo run -p inpact-tests --bin attack -- edits --trials {trials} --seed {seed} --page docs/reliability.md`\n\n\
         In each of {trials} runs of `check --fix` or `fmt` another program reads the deck at a random moment, adds a line and saves it.\n\
         The edit is lost when the line is missing afterwards; the deck is torn when the rest is neither what it was nor what the run makes of it.\n\n\
         | the other program | runs | the deck has both | the edit alone | of these refused by the run | lost | torn |\n\
         |---|---|---|---|---|---|---|\n"
    );
    for (manner, name) in MANNERS {
        if let Some(of) = counts.get(&manner) {
            let Counts { trials, refused, both, edit_only, lost, torn } = of;
            let _ = writeln!(text, "| {name} | {trials} | {both} | {edit_only} | {refused} | {lost} | {torn} |");
        }
    }
    let _ = write!(text, "\nFaults: {}.", faults.len());
    text
}

/// Reads the deck, adds a line and saves it.
fn save(path: &Path, manner: Manner, pause: Duration) {
    match manner {
        Manner::Rename => {
            let edited = fs::read_to_string(path).expect("readable") + MARK;
            let other = path.with_extension("saved");
            fs::write(&other, edited).expect("writable");
            std::thread::sleep(pause);
            fs::rename(other, path).expect("renamed");
        }
        Manner::Overwrite => {
            let edited = fs::read_to_string(path).expect("readable") + MARK;
            let (first, second) = edited.split_at(edited.len() / 2);
            let mut file = File::create(path).expect("writable");
            file.write_all(first.as_bytes()).expect("writable");
            std::thread::sleep(pause);
            file.write_all(second.as_bytes()).expect("writable");
        }
        Manner::Append => {
            let mut file = File::options().append(true).open(path).expect("writable");
            std::thread::sleep(pause);
            file.write_all(MARK.as_bytes()).expect("writable");
        }
    }
}

/// A deck that both jobs change.
fn deck() -> String {
    let rows: String = (0..2000).map(|row| format!("{row}, {row}.\n")).collect();
    format!("*SURFACE INTERACT, NAME=A\n1.,\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n{rows}")
}
