//! Runs that are stopped by a signal at a random moment: every file is whole, before or after, and nothing is left after.

use crate::chance::Chance;
use crate::{Report, command, leftovers};
use rustix::process::{Pid, Resource, Rlimit, Signal, kill_process, setrlimit};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::time::{Duration, Instant};

/// Signals that end a program from outside; the last cannot be caught.
const SIGNALS: [(&str, Signal); 9] = [
    ("SIGINT", Signal::INT),
    ("SIGTERM", Signal::TERM),
    ("SIGHUP", Signal::HUP),
    ("SIGQUIT", Signal::QUIT),
    ("SIGALRM", Signal::ALARM),
    ("SIGUSR1", Signal::USR1),
    ("SIGXCPU", Signal::XCPU),
    ("SIGPIPE", Signal::PIPE),
    ("SIGKILL", Signal::KILL),
];

/// Whether a signal can be caught.
fn can_be_caught(signal: Signal) -> bool {
    signal != Signal::KILL
}

/// A run of the program that writes files.
struct Job {
    name: &'static str,
    arguments: &'static [&'static str],
    /// The files that it writes.
    targets: &'static [&'static str],
    /// The files that are written together.
    together: Together,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Together {
    All,
    EachByItself,
}

const JOBS: [Job; 5] = [
    Job {
        name: "eval -o",
        arguments: &["eval", "--isolated", "d.inp", "--nodes", "n.csv", "-o", "o.csv"],
        targets: &["o.csv"],
        together: Together::All,
    },
    Job {
        name: "check --fix",
        arguments: &["check", "--isolated", "--fix", "a.inp", "b.inp", "c.inp"],
        targets: &["a.inp", "b.inp", "c.inp"],
        together: Together::All,
    },
    Job {
        name: "fmt",
        arguments: &["fmt", "--isolated", "a.inp", "b.inp", "c.inp"],
        targets: &["a.inp", "b.inp", "c.inp"],
        together: Together::EachByItself,
    },
    Job {
        name: "json -o",
        arguments: &["json", "--isolated", "--view", "syntax", "a.inp", "-o", "o.json"],
        targets: &["o.json"],
        together: Together::All,
    },
    Job {
        name: "inp --into",
        arguments: &["inp", "i.json", "--into", "out"],
        targets: &["out/one.inp", "out/two.inp"],
        together: Together::All,
    },
];

/// Files by name; `None` where there is none.
type Files = BTreeMap<&'static str, Option<Vec<u8>>>;

/// Outcomes of the runs that one signal was sent to.
#[derive(Debug, Default)]
struct Counts {
    trials: u64,
    stopped: u64,
    finished: u64,
    torn: u64,
    left: u64,
}

/// Starts `trials` runs and sends each a signal.
///
/// # Panics
/// When the runs cannot be prepared.
pub fn run(program: &Path, trials: u64, seed: u64) -> Report {
    // The core files of SIGQUIT and SIGXCPU are none of ours.
    let _ = setrlimit(Resource::Core, Rlimit { current: Some(0), maximum: Some(0) });
    let mut chance = Chance::new(seed);
    let prepared: Vec<(Files, Duration)> = JOBS.iter().map(|job| undisturbed(program, job)).collect();
    let mut counts: BTreeMap<&str, Counts> = BTreeMap::new();
    let mut report = Report::default();
    for trial in 0..trials {
        let (name, signal) = *chance.one_of(&SIGNALS);
        let index = usize::try_from(chance.below(JOBS.len() as u64)).unwrap_or(0);
        let (job, (whole, time)) = (&JOBS[index], &prepared[index]);
        let delay = chance.time_up_to(time.mul_f64(1.1));
        let counts = counts.entry(name).or_default();
        counts.trials += 1;
        let place = format!("trial {trial}, {} after {delay:?} by {name}", job.name);
        for fault in stop(program, job, (name, signal), delay, whole, counts) {
            report.faults.push(format!("{place}: {fault}"));
        }
    }
    report.text = text(&counts, trials, seed, &report.faults);
    report
}

fn text(counts: &BTreeMap<&str, Counts>, trials: u64, seed: u64, faults: &[String]) -> String {
    let jobs: Vec<String> = JOBS.iter().map(|job| format!("`{}`", job.name)).collect();
    let mut text = format!(
        "## Runs that are stopped\n\n\
         `cargo run -p inpact-tests --bin attack -- stops --trials {trials} --seed {seed} --page docs/reliability.md`\n\n\
         Each of {trials} runs of {} gets a signal at a random moment of its time.\n\
         A file is torn when it is neither what it was before nor what a whole run makes of it; files that are written together \
         (all of one `check --fix`, all of one `inp --into`) are torn as well when some are old and some are new.\n\
         A SIGKILL, which no program can catch, may leave a temporary file, whose name begins with `.inpact-`, and may come between \
         two files of one run, each of which is whole; SIGPIPE is ignored, as writing to a closed pipe is noticed without it.\n\n\
         | signal | runs | stopped by it | finished before | torn files | temporary files left |\n|---|---|---|---|---|---|\n",
        jobs.join(", ")
    );
    for (name, _) in SIGNALS {
        if let Some(of) = counts.get(name) {
            let Counts { trials, stopped, finished, torn, left } = of;
            let _ = writeln!(text, "| {name} | {trials} | {stopped} | {finished} | {torn} | {left} |");
        }
    }
    let _ = write!(text, "\nFaults: {}.", faults.len());
    text
}

/// The files of a job that nobody stops, and its time.
fn undisturbed(program: &Path, job: &Job) -> (Files, Duration) {
    let folder = prepare();
    let start = Instant::now();
    let status = command(program, folder.path(), job.arguments).status().expect("the program starts");
    let time = start.elapsed();
    // The findings of `check` that have no fix give 1.
    assert!(matches!(status.code(), Some(0 | 1)), "{}: {status}", job.name);
    let files = files(folder.path(), job);
    assert_ne!(files, self::files(prepare().path(), job), "{} writes nothing", job.name);
    (files, time)
}

/// Runs a job and stops it; gives what is wrong then.
fn stop(
    program: &Path,
    job: &Job,
    (name, signal): (&str, Signal),
    delay: Duration,
    whole: &Files,
    counts: &mut Counts,
) -> Vec<String> {
    let folder = prepare();
    let before = files(folder.path(), job);
    let mut child = command(program, folder.path(), job.arguments).spawn().expect("the program starts");
    std::thread::sleep(delay);
    if let Some(process) = Pid::from_raw(i32::try_from(child.id()).unwrap_or(0)) {
        // A run that is over already is no longer there.
        let _ = kill_process(process, signal);
    }
    let status = child.wait().expect("it ends");
    let mut faults = Vec::new();
    match (status.signal(), status.code()) {
        (Some(by), _) if by == signal.as_raw() => counts.stopped += 1,
        (None, Some(0 | 1)) => counts.finished += 1,
        _ => faults.push(format!("ended with {status}")),
    }
    let after = files(folder.path(), job);
    let is_old = |name: &&str| after[*name] == before[*name];
    let is_new = |name: &&str| after[*name] == whole[*name];
    let torn = job.targets.iter().filter(|name| !is_old(name) && !is_new(name)).count();
    let is_mixed = !job.targets.iter().all(is_old) && !job.targets.iter().all(is_new);
    let must_be_together = job.together == Together::All && can_be_caught(signal);
    if torn > 0 || (is_mixed && must_be_together) {
        counts.torn += torn.max(1) as u64;
        faults.push(format!("{torn} files are neither old nor new"));
    }
    let left = leftovers(folder.path()).len() + leftovers(&folder.path().join("out")).len();
    counts.left += left as u64;
    if left > 0 && can_be_caught(signal) {
        faults.push(format!("{name} leaves {left} temporary files"));
    }
    faults
}

fn files(folder: &Path, job: &Job) -> Files {
    job.targets.iter().map(|name| (*name, fs::read(folder.join(name)).ok())).collect()
}

/// A folder with what the jobs read and write.
fn prepare() -> tempfile::TempDir {
    /// So many rows that a run takes a while.
    const ROWS: usize = 3000;
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("writable");
    let rows: String = (0..ROWS).map(|row| format!("{row}, {row}.\n")).collect();
    let block = "*GAP ELECTRICAL CONDUCTANCE, PRESSURE";
    write("d.inp", &format!("*SURFACE INTERACTION, NAME=A\n1.,\n{block}\n1., 0.\n2., 1.\n"));
    for name in ["a.inp", "b.inp", "c.inp"] {
        write(name, &format!("*SURFACE INTERACT, NAME=A,\n1.,\n{block},\n{rows}"));
    }
    let nodes: String = (0..ROWS).map(|row| format!("{row},{row},1,0\n")).collect();
    write("n.csv", &format!("node,pressure,epot_s,epot_m\n{nodes}"));
    for name in ["o.csv", "o.json"] {
        write(name, "an older result\n");
    }
    write("i.json", &lossless());
    folder
}

/// The lossless form of two files.
fn lossless() -> String {
    let file = |name: &str| format!(r#"{{"source":"{name}","line_end":"\n","blocks":[]}}"#);
    format!(r#"{{"schema":"inpact/syntax/1","files":[{},{}]}}"#, file("one.inp"), file("two.inp"))
}
