//! Hostile JSON, scenes, configurations and node tables: samples changed by chance, each given to the command that reads it.
//!
//! The program must end by itself with an exit code from 0 to 2, within its memory: a panic ends with 101, an abort by a signal.
//! What it refuses it says, and what is wrong by any reading it refuses.

mod structured;

use crate::Report;
use crate::chance::Chance;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};
use structured::{Form, Kind};

/// The most memory that a run may map, in KiB.
const MAX_MEMORY: u64 = 1 << 20;

const DECK: &str = "*SURFACE INTERACTION, NAME=A\n1.,\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n1., 0.\n2., 1.\n\
                    *GAP CONDUCTANCE\n20., 0.\n10., 0.1\n*CONTACT PAIR, INTERACTION=A\nS1, M1\n";

const TABLE: &str = "node,interaction,clearance,pressure,epot_s,epot_m,temp_s,temp_m,time\n1,A,0,1,1,0,300,290,0\n\
                     2,\"A\",0.05,,1e0,0,300,290,0\n1,A,0,0.5,1,0,310,290,1\n2,A,0.05,0,1,0,300,290,1\n";

const SCENE: &str = "deck = \"d.inp\"\n[[node]]\nname = \"a\"\npotential = { fixed = 1.0 }\n[[node]]\nname = \"b\"\n\
                     potential = { fixed = 0.0 }\n[[node]]\nname = \"c\"\n[[link]]\nnodes = [\"a\", \"c\"]\nelectrical = 2.0\n\
                     [[interface]]\nslave = \"c\"\nmaster = \"b\"\ninteraction = \"A\"\npressure = 1.0\nclearance = 0.0\narea = 1.0\n";

const SETTINGS: &str = "dialect = \"abaqus\"\ninclude-dirs = [\"sub\"]\ninclude-root = true\n[rules]\nT005 = \"off\"\nS006 = \"note\"\n\
                        [[ignore]]\npaths = [\"old/**\"]\nrules = [\"K001\"]\n";

/// Pieces that formats trip over.
const PIECES: [&str; 24] = [
    "\"",
    "{",
    "}",
    "[",
    "]",
    "[[",
    ",",
    "=",
    "null",
    "1e400",
    "-0",
    "9999999999999999999999",
    "nan",
    "inf",
    "\0",
    "\u{feff}",
    "\\ud800",
    "\u{1b}[2J",
    "''''",
    "\r",
    "\n",
    "true",
    "<p>",
    "\"dependencies\": 4294967295,",
];

/// A changed file, its sample, and the command that reads it.
struct Target {
    name: &'static str,
    form: Form,
    file: &'static str,
    sample: Vec<u8>,
    arguments: &'static [&'static str],
}

/// The folder of the runs, and the targets in it.
struct Runs {
    folder: tempfile::TempDir,
    targets: Vec<Target>,
}

impl Runs {
    /// Prepares the runs; every sample is accepted as it is.
    fn prepared(program: &Path) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |name: &str| folder.path().join(name);
        fs::create_dir_all(path("below/sub")).expect("folders");
        for (name, text) in [("d.inp", DECK), ("below/d.inp", DECK)] {
            fs::write(path(name), text).expect("writable");
        }
        let json = |view: &str| {
            let mut command = Command::new(program);
            command.args(["json", "--isolated", "--view", view, "d.inp"]).current_dir(folder.path());
            command.output().expect("the program starts").stdout
        };
        let target = |name, form, file, sample: &[u8], arguments| {
            let sample = sample.to_vec();
            Target { name, form, file, sample, arguments }
        };
        let (scene, settings, table) = (SCENE.as_bytes(), SETTINGS.as_bytes(), TABLE.as_bytes());
        let targets = vec![
            target(
                "JSON of the model: `inp`",
                Form::Json,
                "m.json",
                &json("model"),
                &["inp", "m.json", "-o", "out.inp"][..],
            ),
            target(
                "JSON of the syntax: `inp --into`",
                Form::Json,
                "s.json",
                &json("syntax"),
                &["inp", "s.json", "--into", "new"],
            ),
            target("scene: `solve`", Form::Toml, "s.toml", scene, &["solve", "--isolated", "s.toml"]),
            target("`inpact.toml`: `check`", Form::Toml, "below/inpact.toml", settings, &["check", "below/d.inp"]),
            target(
                "node table: `eval`",
                Form::Csv,
                "n.csv",
                table,
                &["eval", "--isolated", "d.inp", "--nodes", "n.csv"],
            ),
            target(
                "node table: `plan`",
                Form::Csv,
                "n.csv",
                table,
                &["plan", "--isolated", "d.inp", "--nodes", "n.csv"],
            ),
        ];
        let runs = Self { folder, targets };
        for target in &runs.targets {
            let (status, errors) = runs.shoot(program, target, &target.sample);
            assert!(status.success(), "{}: {errors}", target.name);
        }
        runs
    }

    /// Gives a file to the command that reads it; its exit, and what it says.
    fn shoot(&self, program: &Path, target: &Target, bytes: &[u8]) -> (ExitStatus, String) {
        fs::write(self.folder.path().join(target.file), bytes).expect("writable");
        let run = limited(program, self.folder.path(), target.arguments).output().expect("the program starts");
        (run.status, String::from_utf8_lossy(&run.stderr).chars().take(300).collect())
    }
}

/// An exit code from 0 to 2; `None` for a panic, an abort or a signal.
fn code(status: ExitStatus) -> Option<usize> {
    status.code().and_then(|code| usize::try_from(code).ok()).filter(|code| *code <= 2)
}

/// Gives `trials` files with changes by chance to the program, and as many with changes of structure.
///
/// # Panics
/// When the runs cannot be prepared.
pub fn run(program: &Path, trials: u64, seed: u64) -> Report {
    let runs = Runs::prepared(program);
    let mut report = by_chance(program, &runs, trials, seed);
    let structured = by_structure(program, &runs, trials, seed);
    report.text += "\n";
    report.text += &structured.text;
    report.faults.extend(structured.faults);
    report
}

/// Files in which one value, one key or the end is another: all of them where there are no more than `trials`, otherwise a choice.
fn by_structure(program: &Path, runs: &Runs, trials: u64, seed: u64) -> Report {
    let mut chance = Chance::new(seed);
    let of_target = |target: usize| {
        let Target { form, sample, .. } = &runs.targets[target];
        (0..structured::count(*form, sample)).map(move |index| (target, index))
    };
    let mut all: Vec<(usize, usize)> = (0..runs.targets.len()).flat_map(of_target).collect();
    let possible = all.len();
    let wanted = usize::try_from(trials).unwrap_or(usize::MAX).min(possible);
    for place in 0..wanted {
        let other = place + usize::try_from(chance.below((possible - place) as u64)).unwrap_or(0);
        all.swap(place, other);
    }
    let mut counts = [[0_u64; 4]; Kind::ALL.len()];
    let mut report = Report::default();
    for &(target, index) in &all[..wanted] {
        let target = &runs.targets[target];
        let changed = structured::changed(target.form, &target.sample, index);
        let (status, errors) = runs.shoot(program, target, &changed.bytes);
        let code = code(status);
        let is_silent = code != Some(0) && errors.trim().is_empty();
        let is_accepted = code == Some(0) && changed.kind.is_always_wrong(target.form);
        let is_fault = code.is_none() || is_silent || is_accepted;
        let kind = Kind::ALL.iter().position(|kind| *kind == changed.kind).unwrap_or(0);
        counts[kind][code.filter(|_| !is_fault).unwrap_or(3)] += 1;
        if is_fault {
            let shown: String = changed.bytes.escape_ascii().to_string().chars().take(2000).collect();
            let (name, kind) = (target.name, changed.kind.name());
            report.faults.push(format!("change {index}, {name}, {kind}: {status}: {errors}: {shown}"));
        }
    }
    report.text = format!(
        "{wanted} of the {possible} files in which one value, one key or the end is another.\n\
         What is refused is refused with a message; in JSON and TOML bytes that are not UTF-8, NUL, values nested 100,000 deep and keys that are there twice are always refused, and so is JSON that is cut short; a table of nodes may hold names of any bytes and end after any row.\n\n\
         | changed | ended with 0 | with 1 | with 2 | faults |\n|---|---|---|---|---|\n"
    );
    for (kind, [clean, errors, refused, faults]) in Kind::ALL.iter().zip(counts) {
        let _ = writeln!(report.text, "| {} | {clean} | {errors} | {refused} | {faults} |", kind.name());
    }
    report
}

/// Files with one to six changes that know nothing of the format.
fn by_chance(program: &Path, runs: &Runs, trials: u64, seed: u64) -> Report {
    let mut chance = Chance::new(seed);
    let targets = &runs.targets;
    let mut counts = vec![[0_u64; 4]; targets.len()];
    let mut report = Report::default();
    for trial in 0..trials {
        let index = usize::try_from(trial).unwrap_or(0) % targets.len();
        let target = &targets[index];
        let changed = changed(&target.sample, &mut chance);
        let (status, errors) = runs.shoot(program, target, &changed);
        let code = code(status);
        counts[index][code.unwrap_or(3)] += 1;
        if code.is_none() {
            report.faults.push(format!(
                "trial {trial}, {}: {status}: {errors}: {}",
                target.name,
                changed.escape_ascii()
            ));
        }
    }
    report.text = text(targets, &counts, trials, seed);
    report
}

/// The program, to be started in a folder within its memory.
fn limited(program: &Path, folder: &Path, arguments: &[&str]) -> Command {
    let mut command = if cfg!(unix) { Command::new("sh") } else { Command::new(program) };
    if cfg!(unix) {
        command.args(["-c", &format!("ulimit -v {MAX_MEMORY} && exec \"$0\" \"$@\"")]).arg(program);
    }
    command
        .args(arguments)
        .current_dir(folder)
        .env("RAYON_NUM_THREADS", "1")
        .stdin(Stdio::null())
        .stdout(Stdio::null());
    command
}

fn text(targets: &[Target], counts: &[[u64; 4]], trials: u64, seed: u64) -> String {
    let mut text = format!(
        "## Hostile JSON, scenes, configurations and node tables\n\n\
         `cargo run -p inpact-tests --bin attack -- hostile --trials {trials} --seed {seed} --page docs/reliability.md`\n\n\
         {trials} files made of a sound one by one to six changes: bytes flipped, cut out, repeated, or pieces that formats trip over put in.\n\
         Each is given to the command that reads it, with 1 GiB of memory to map; a panic, an abort or a signal is a fault.\n\n\
         | what is changed | ended with 0 | with 1 | with 2 | faults |\n|---|---|---|---|---|\n"
    );
    for (target, [clean, errors, refused, faults]) in targets.iter().zip(counts) {
        let _ = writeln!(text, "| {} | {clean} | {errors} | {refused} | {faults} |", target.name);
    }
    text
}

/// A copy with one to six changes.
fn changed(sample: &[u8], chance: &mut Chance) -> Vec<u8> {
    let mut bytes = sample.to_vec();
    let below = |chance: &mut Chance, end: usize| usize::try_from(chance.below(end.max(1) as u64)).unwrap_or(0);
    for _ in 0..=chance.below(6) {
        let at = below(chance, bytes.len() + 1);
        let end = (at + 1 + below(chance, 40)).min(bytes.len());
        match chance.below(6) {
            0 if at < end => bytes[at] ^= 1 << chance.below(8),
            1 => drop(bytes.drain(at..end)),
            2 => {
                let copied = bytes[at..end].repeat(1 + below(chance, 50));
                bytes.splice(at..at, copied);
            }
            3 => {
                let nested = chance.one_of(&PIECES).repeat(1 + below(chance, 5000));
                bytes.splice(at..at, nested.into_bytes());
            }
            4 => drop(bytes.splice(at..end, chance.one_of(&PIECES).bytes())),
            _ => drop(bytes.splice(at..at, chance.one_of(&PIECES).bytes())),
        }
    }
    bytes
}
