//! The speed and memory of `inpact check` on large decks of tables.
//!
//! Times are CPU times, user plus system; memory is the peak resident set, less that of an empty deck.
//! Both are measured by GNU time once the process has ended.

use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::deck::{self, Content, DeckRequest};
use crate::size::Counted;

/// The decks measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// Two tables of ten temperatures an interaction, numbers of thirteen digits.
    Temperatures,
    /// A table of one axis and short numbers an interaction.
    Short,
    /// The same, but no table ends at zero: a finding each.
    Findings,
    /// The same, but in each two rows are exchanged: an error each.
    OutOfOrder,
    /// A mesh, with a few interactions.
    Mesh,
}

impl Kind {
    const ALL: [Self; 5] = [Self::Temperatures, Self::Short, Self::Findings, Self::OutOfOrder, Self::Mesh];

    fn name(self) -> &'static str {
        match self {
            Self::Temperatures => "two tables of ten temperatures each, numbers of 13 digits",
            Self::Short => "a table of one axis each, short numbers",
            Self::Findings => "the same, a note on the last row of each (P008)",
            Self::OutOfOrder => "the same, two rows of each exchanged (T001)",
            Self::Mesh => "a mesh of 100 MB and 10 interactions",
        }
    }
}

/// Resources of a run.
#[derive(Debug, Clone, Copy)]
struct Used {
    seconds: f64,
    kilobytes: f64,
}

/// Measures a program on decks of this many interactions and rows per table, the best of this many runs each, and returns
/// the page.
///
/// # Errors
/// Those of writing decks to the folder for temporary files; a program, or GNU time, that cannot be run.
pub fn page(program: &Path, interactions: usize, rows: usize, rounds: usize) -> io::Result<String> {
    let path = std::env::temp_dir().join(format!("inpact-decks-{}.inp", std::process::id()));
    let page = measure_all(program, &path, (interactions, rows), rounds);
    let _ = std::fs::remove_file(&path);
    page
}

fn measure_all(program: &Path, path: &PathBuf, size: (usize, usize), rounds: usize) -> io::Result<String> {
    std::fs::write(path, "*HEADING\n")?;
    let empty = best(program, path, rounds)?;
    let mut page = format!(
        "# Speed of `check`\n\n\
        Made by `inpact-bench decks PROGRAM`: `inpact check --isolated -q` on decks of {} interactions, {} rows a table, the best of {rounds} runs each.\n\
        Times are those on processors, user and system together; memory is the most that was resident, less that of a deck with nothing in it.\n\
        Of a large table in order the first and the last row of each group stay in memory, and three lines of text at either end; a table with something wrong in it stays whole.\n\n\
        | deck | MB | CPU s | MB/s | memory MB | × the file |\n|---|---|---|---|---|---|\n",
        size.0, size.1
    );
    for kind in Kind::ALL {
        let mut out = Counted::new(BufWriter::new(File::create(path)?));
        write_deck(kind, size, &mut out)?;
        out.flush()?;
        let megabytes = out.bytes() as f64 / 1e6;
        let used = best(program, path, rounds)?;
        let memory = (used.kilobytes - empty.kilobytes).max(0.0) * 1024.0 / 1e6;
        // Writing into a string cannot fail.
        let _ = writeln!(
            page,
            "| {} | {megabytes:.1} | {:.2} | {:.0} | {memory:.1} | {:.2} |",
            kind.name(),
            used.seconds,
            megabytes / used.seconds.max(0.01),
            memory / megabytes,
        );
    }
    Ok(page)
}

fn write_deck(kind: Kind, (interactions, rows): (usize, usize), out: &mut impl Write) -> io::Result<()> {
    let request = |content, interactions| DeckRequest { content, interactions, rows, seed: 1 };
    match kind {
        Kind::Temperatures => deck::write(&request(Content::Tables, interactions), out).map(|_| ()),
        Kind::Mesh => deck::write(&request(Content::Mesh { bytes: 100_000_000 }, 10), out).map(|_| ()),
        Kind::Short | Kind::Findings | Kind::OutOfOrder => {
            writeln!(out, "*HEADING\nTables of one axis")?;
            for number in 1..=interactions {
                write!(out, "*SURFACE INTERACTION, NAME=A{number}\n*GAP ELECTRICAL CONDUCTANCE\n")?;
                let least = if kind == Kind::Findings { 0.5 } else { 0.0 };
                for row in 0..rows {
                    let point = match (kind, row) {
                        (Kind::OutOfOrder, 1) => 2,
                        (Kind::OutOfOrder, 2) => 1,
                        _ => row,
                    };
                    let value = least + ((rows - 1 - point) * (10 + number % 7)) as f64;
                    writeln!(out, "{value:?}, {}e-3", 5 * point)?;
                }
            }
            Ok(())
        }
    }
}

fn best(program: &Path, path: &Path, rounds: usize) -> io::Result<Used> {
    let mut best = Used { seconds: f64::INFINITY, kilobytes: f64::INFINITY };
    for _ in 0..rounds {
        let used = run(program, path)?;
        best.seconds = best.seconds.min(used.seconds);
        best.kilobytes = best.kilobytes.min(used.kilobytes);
    }
    Ok(best)
}

/// Checks a deck once.
fn run(program: &Path, path: &Path) -> io::Result<Used> {
    let output = Command::new("/usr/bin/time")
        .args(["-q", "-f", "%U %S %M"])
        .arg(program)
        .args(["check", "--isolated", "-q", "--exit-zero"])
        .arg(path)
        .stdout(Stdio::null())
        .output()
        .map_err(|error| io::Error::new(error.kind(), format!("`/usr/bin/time` (GNU time) cannot be run: {error}")))?;
    let said = String::from_utf8_lossy(&output.stderr);
    let numbers: Vec<f64> = said.split_whitespace().filter_map(|number| number.parse().ok()).collect();
    match numbers[..] {
        [user, system, kilobytes] if output.status.success() => Ok(Used { seconds: user + system, kilobytes }),
        _ => Err(io::Error::other(format!("`{}` ended with {}: {said}", program.display(), output.status))),
    }
}
