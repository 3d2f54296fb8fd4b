//! The bytes of whole runs, held by their hashes: every sample, and random decks and node tables with all laws, in every mode.
//!
//! The hashes in `bytes/hashes.txt` were taken before rows were evaluated in columns and on several threads; `full` and `reference` must keep them.
//! `INPACT_UPDATE=1` writes them anew, for a change that is meant to change results; the difference then shows which cases it concerns.

use crate::program::{Folder, Run, inpact, root, sample_decks};
use crate::table_judge::Random;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

#[allow(dead_code, reason = "the judge of the laws uses all of it")]
#[path = "../../crates/inpact-evaluation/tests/evaluation_judge/scene.rs"]
mod scene;

use scene::Scene;

/// The number of random decks.
const DECKS: u64 = 200;

/// Accuracies of tables; one deck after the other takes the next.
const MODES: [&[&str]; 4] =
    [&["--accuracy", "full"], &["--accuracy", "reference"], &["--accuracy", "fast"], &["--tolerance", "1e-3"]];

/// Further options; one deck after the other takes the next.
const OPTIONS: [&[&str]; 7] = [
    &[],
    &["--derivatives"],
    &["--history-start", "at-rest"],
    &["--clearance-tail", "zero", "--char-length", "0.25"],
    &["--procedure", "steady"],
    &["--procedure", "transient"],
    &["--threads", "2"],
];

/// The hash of a text (FNV-1a).
fn hash(text: &str) -> u64 {
    let step = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    text.bytes().fold(0xcbf2_9ce4_8422_2325, step)
}

/// The fingerprint of a run: its exit code, the hash of its output and that of its messages, without the time it took.
fn fingerprint(run: &Run) -> String {
    let mut said = String::new();
    for line in run.errors.lines() {
        let untimed =
            line.rsplit_once(", ").filter(|(_, time)| time.ends_with(" s")).map_or(line, |(before, _)| before);
        let _ = writeln!(said, "{untimed}");
    }
    format!("{} {:016x} {:016x}", run.code, hash(&run.output), hash(&said))
}

/// Runs that need no folder of their own, with their names.
fn samples() -> Vec<Vec<String>> {
    let owned = |arguments: &[&str]| arguments.iter().map(|argument| (*argument).to_owned()).collect::<Vec<_>>();
    let mut runs = Vec::new();
    for deck in sample_decks() {
        let nodes = format!("{}-nodes.csv", deck.strip_suffix(".inp").unwrap_or(&deck));
        if deck.contains("user-law") || !root().join(&nodes).exists() {
            continue;
        }
        runs.push(owned(&["plan", &deck, "--nodes", &nodes]));
        for mode in MODES {
            runs.push(owned(&[&["eval", &deck, "--nodes", &nodes, "--derivatives"], mode].concat()));
        }
    }
    for scene in ["closing-gap", "cooling", "four-nodes", "plates", "pressed", "seepage", "two-bodies"] {
        let file = format!("decks/scenes/{scene}.toml");
        runs.push(owned(&["solve", &file, "--links", "--interfaces", "/dev/stdout"]));
    }
    runs
}

/// A deck and a node table in a folder whose settings let thermal tables of one row pass.
fn folder(deck: &str, nodes: &str) -> Folder {
    Folder::with(&[("a.inp", deck), ("a.csv", nodes), ("inpact.toml", "[rules]\nT008 = \"off\"\n")])
}

/// A random deck with its node table, evaluated.
fn random_deck(index: u64) -> (String, Run) {
    let mut random = Random::new(0x17_5eed ^ (index << 20));
    let scene = Scene::random(&mut random, index % 3 == 2);
    let number = usize::try_from(index).unwrap_or(0);
    let (mode, options) = (MODES[number % MODES.len()], OPTIONS[number % OPTIONS.len()]);
    let folder = folder(&scene.deck(), &scene.nodes());
    let run = folder.inpact(&[&["eval", "a.inp", "--nodes", "a.csv"], mode, options].concat());
    (format!("random {index:03} {}", [mode, options].concat().join(" ")), run)
}

/// Long tables made of the rows of a random one, each repeated for so many nodes: node after node, then time after time.
fn long_table(index: u64, copies: usize, order: &str) -> (String, Run) {
    let mut random = Random::new(0x1096_5eed ^ (index << 20));
    let scene = loop {
        let scene = Scene::random(&mut random, false);
        if scene.has_nodes && scene.rows.len() > 9 && scene.columns.contains(&"clearance") {
            break scene;
        }
    };
    let text = scene.nodes();
    let mut lines = text.lines();
    let header = lines.next().unwrap_or_default();
    let rows: Vec<&str> = lines.collect();
    let mut table = format!("{header}\n");
    let mut add = |copy: usize, row: usize| {
        let _ = writeln!(table, "{copy}-{}", rows[row]);
    };
    if order == "by node" {
        (0..copies).for_each(|copy| (0..rows.len()).for_each(|row| add(copy, row)));
    } else {
        (0..rows.len()).for_each(|row| (0..copies).for_each(|copy| add(copy, row)));
    }
    let folder = folder(&scene.deck(), &table);
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "a.csv", "--threads", "2"]);
    (format!("long {index} {order}"), run)
}

/// One of the runs of this test.
enum Case {
    Sample(Vec<String>),
    Random(u64),
    Long(u64, usize, &'static str),
}

impl Case {
    fn run(&self) -> (String, Run) {
        match self {
            Self::Sample(arguments) => {
                let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
                (arguments.join(" "), inpact(&arguments))
            }
            Self::Random(index) => random_deck(*index),
            Self::Long(index, copies, order) => long_table(*index, *copies, order),
        }
    }
}

#[test]
fn whole_runs_keep_their_bytes() {
    let long = (0..4).flat_map(|index| [Case::Long(index, 400, "by node"), Case::Long(index, 400, "by time")]);
    let cases: Vec<Case> =
        samples().into_iter().map(Case::Sample).chain((0..DECKS).map(Case::Random)).chain(long).collect();
    let next = AtomicUsize::new(0);
    let work = || {
        let mut found = Vec::new();
        while let Some(case) = cases.get(next.fetch_add(1, Ordering::Relaxed)) {
            let (name, run) = case.run();
            found.push((name, fingerprint(&run)));
        }
        found
    };
    let found: BTreeMap<String, String> = thread::scope(|scope| {
        let workers: Vec<_> = (0..2).map(|_| scope.spawn(work)).collect();
        workers.into_iter().flat_map(|worker| worker.join().expect("no case panics")).collect()
    });
    assert_eq!(found.len(), cases.len(), "every case has a name of its own");
    let evaluated = found.iter().filter(|(name, run)| name.starts_with("random") && run.starts_with('0')).count();
    assert!(evaluated > 150, "only {evaluated} random decks could be evaluated");
    let text: String = found.iter().map(|(name, run)| format!("{name}: {run}\n")).collect();
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("whole_program/bytes/hashes.txt");
    if std::env::var_os("INPACT_UPDATE").is_some() {
        std::fs::write(&file, &text).expect("writable");
    }
    let kept = std::fs::read_to_string(&file).expect("readable");
    let changed: Vec<(&str, &str)> = kept.lines().zip(text.lines()).filter(|(kept, now)| kept != now).collect();
    assert!(
        changed.is_empty() && kept.lines().count() == text.lines().count(),
        "{} runs have changed: {changed:#?}",
        changed.len()
    );
}
