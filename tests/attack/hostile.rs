//! Hostile JSON, scenes, configurations and node tables: samples changed by chance, each given to the command that reads it.
//!
//! The program must end by itself with an exit code from 0 to 2, within its memory: a panic ends with 101, an abort by a signal.

use crate::Report;
use crate::chance::Chance;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

/// The most memory that a run may map, in KiB.
const MOST_MEMORY: u64 = 1 << 20;

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
    file: &'static str,
    sample: Vec<u8>,
    arguments: &'static [&'static str],
}

/// Gives `trials` changed files to the program.
///
/// # Panics
/// When the runs cannot be prepared.
pub fn run(program: &Path, trials: u64, seed: u64) -> Report {
    let mut chance = Chance::new(seed);
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
    let target = |name, file, sample: &[u8], arguments| Target { name, file, sample: sample.to_vec(), arguments };
    let targets = [
        target("JSON of the model: `inp`", "m.json", &json("model"), &["inp", "m.json", "-o", "out.inp"]),
        target("JSON of the syntax: `inp --into`", "s.json", &json("syntax"), &["inp", "s.json", "--into", "new"]),
        target("scene: `solve`", "s.toml", SCENE.as_bytes(), &["solve", "--isolated", "s.toml"]),
        target("`inpact.toml`: `check`", "below/inpact.toml", SETTINGS.as_bytes(), &["check", "below/d.inp"]),
        target("node table: `eval`", "n.csv", TABLE.as_bytes(), &["eval", "--isolated", "d.inp", "--nodes", "n.csv"]),
        target("node table: `plan`", "n.csv", TABLE.as_bytes(), &["plan", "--isolated", "d.inp", "--nodes", "n.csv"]),
    ];
    for target in &targets {
        fs::write(path(target.file), &target.sample).expect("writable");
        let run = limited(program, folder.path(), target.arguments).output().expect("the program starts");
        assert!(run.status.success(), "{}: {}", target.name, String::from_utf8_lossy(&run.stderr));
    }
    let mut counts = vec![[0_u64; 4]; targets.len()];
    let mut report = Report::default();
    for trial in 0..trials {
        let index = usize::try_from(trial).unwrap_or(0) % targets.len();
        let target = &targets[index];
        let changed = changed(&target.sample, &mut chance);
        fs::write(path(target.file), &changed).expect("writable");
        let run = limited(program, folder.path(), target.arguments).output().expect("the program starts");
        let code = run.status.code().and_then(|code| usize::try_from(code).ok()).filter(|code| *code <= 2);
        counts[index][code.unwrap_or(3)] += 1;
        if code.is_none() {
            let stderr = String::from_utf8_lossy(&run.stderr);
            let stderr: String = stderr.chars().take(300).collect();
            report.faults.push(format!(
                "trial {trial}, {}: {}: {stderr}: {}",
                target.name,
                run.status,
                changed.escape_ascii()
            ));
        }
    }
    report.text = text(&targets, &counts, trials, seed);
    report
}

/// The program, to be started in a folder within its memory.
fn limited(program: &Path, folder: &Path, arguments: &[&str]) -> Command {
    let mut command = if cfg!(unix) { Command::new("sh") } else { Command::new(program) };
    if cfg!(unix) {
        command.args(["-c", &format!("ulimit -v {MOST_MEMORY} && exec \"$0\" \"$@\"")]).arg(program);
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
