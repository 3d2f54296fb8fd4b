//! Memory that `check` takes for decks of many small options, held against the length of the deck.

use crate::program::{Folder, command};
use std::process::{Child, Stdio};
use std::time::Duration;

const COUNT: usize = 60_000;

/// The most memory in bytes that the program has taken until it opens a pipe, which it is given after the deck.
fn peak_after(deck: &str) -> u64 {
    let folder = Folder::with(&[("a.inp", deck)]);
    let pipe = folder.path().join("b.inp");
    let mode = rustix::fs::Mode::RUSR | rustix::fs::Mode::WUSR;
    rustix::fs::mkfifoat(rustix::fs::CWD, &pipe, mode).expect("a pipe");
    // On one thread the decks are checked one after the other.
    let mut check = command(folder.path(), &["check", "--exit-zero", "a.inp", "b.inp"]);
    check.env("RAYON_NUM_THREADS", "1").stdout(Stdio::null()).stderr(Stdio::null());
    let mut running = check.spawn().expect("the program runs");
    let flags = rustix::fs::OFlags::WRONLY | rustix::fs::OFlags::NONBLOCK;
    let writer = loop {
        // Nobody can write before somebody reads.
        match rustix::fs::open(&pipe, flags, rustix::fs::Mode::empty()) {
            Ok(writer) => break writer,
            Err(error) => assert_eq!(error, rustix::io::Errno::NXIO),
        }
        assert!(running.try_wait().expect("its state").is_none(), "it ended before it read the pipe");
        std::thread::sleep(Duration::from_millis(5));
    };
    let peak = peak_of(&running);
    drop(writer);
    assert!(running.wait().expect("its end").success());
    peak
}

fn peak_of(process: &Child) -> u64 {
    let status = std::fs::read_to_string(format!("/proc/{}/status", process.id())).expect("its status");
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).expect("the peak of its memory");
    let kibibytes: u64 = line.trim().trim_end_matches(" kB").parse().expect("a number");
    kibibytes * 1024
}

/// The memory beyond that of an empty deck, by the length of the deck, is at most `most`.
fn takes(what: &str, option: impl Fn(usize) -> String, most: f64) {
    let deck: String = (0..COUNT).map(option).collect();
    let (empty, peak) = (peak_after(""), peak_after(&deck));
    let multiple = peak.saturating_sub(empty) as f64 / deck.len() as f64;
    // The text of the deck is kept, so that less than once would be a peak of something else.
    assert!((1.0..=most).contains(&multiple), "{what}: {multiple:.1} × the {} bytes of the deck", deck.len());
}

#[test]
fn decks_of_many_small_interactions_take_eight_times_their_length_at_most() {
    let named = |number| format!("*SURFACE INTERACTION, NAME=N{number}\n");
    let table = "*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n 1., 0.\n 2., 1.\n";
    takes("names", named, 8.0);
    takes("tables", |number| format!("{} 1.,\n{table}", named(number)), 8.0);
}

#[test]
fn options_that_are_not_interpreted_take_ten_times_their_length_at_most() {
    let named = |number| format!("*SURFACE INTERACTION, NAME=N{number}\n1.,\n");
    takes("friction", |number| format!("{}*FRICTION\n0.1,\n", named(number)), 10.0);
    let usual = "*FRICTION, SLIP TOLERANCE=0.005\n0.1,\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n*GAP CONDUCTANCE\n1., 0.\n0., 1.\n";
    takes("usual interactions", |number| format!("{}{usual}", named(number)), 10.0);
    takes("steps", |_| "*STEP\n*HEAT TRANSFER\n1., 1.\n*END STEP\n".to_owned(), 10.0);
}
