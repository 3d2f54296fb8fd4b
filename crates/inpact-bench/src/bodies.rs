//! Time and memory of lumping a body with four terminals, beside one solution of the same equations with one right-hand side.
//!
//! The body is a block of bricks with a distorted interior; three of its terminals are parts of faces, so that the flow is nowhere uniform.

use crate::mesh::Timer;
use crate::network::run::memory;
use clap::ValueEnum;
use inpact_body::{Body, BodyField, Solution, SolutionMethod};
use inpact_parser::deck::{Keep, ScanOptions, Scanner};
use inpact_parser::grammar::Grammar;
use inpact_parser::mesh::SeekableRows;
use inpact_parser::model::Name;
use inpact_parser::span::SourceId;
use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::Path;
use std::process::Command;

const TERMINALS: [&str; 4] = ["END", "TOP", "SIDE", "FAR"];

/// How much of a body is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Work {
    /// The potential of one terminal: the matrix, and one solution.
    Single,
    /// Everything that `inpact body` gives: three solutions with one temperature a terminal, three with even flows, conductances and capacities.
    Lumped,
}

/// Time and memory of one run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// Seconds to read the deck and its bodies.
    pub read: f64,
    /// Seconds to make the matrix and to solve.
    pub solve: f64,
    /// The number of unknowns.
    pub unknowns: usize,
    /// Iterations of all solutions of one kind, or 0 with a factor.
    pub iterations: usize,
    /// Memory at most, in MiB; NaN where the system does not tell.
    pub peak: f64,
}

/// Writes a body of `cells` bricks along each edge with its terminals and its material.
///
/// # Errors
/// Those of writing.
pub fn write_body(cells: u32, out: impl Write) -> io::Result<()> {
    let mut out = BufWriter::with_capacity(1 << 20, out);
    let side = cells + 1;
    let number = |[i, j, k]: [u32; 3]| (k * side + j) * side + i + 1;
    let all = || (0..side).flat_map(move |k| (0..side).flat_map(move |j| (0..side).map(move |i| [i, j, k])));
    let share = |at: u32| f64::from(at) / f64::from(cells);
    writeln!(out, "*NODE")?;
    for at in all() {
        let [x, y, z] = at.map(share);
        // Faces stay where they are.
        let inside = 0.1 * (x * (1.0 - x) * y * (1.0 - y) * z * (1.0 - z)).cbrt() * (7.0 * x + 5.0 * y + 3.0 * z).sin();
        writeln!(out, "{}, {:.9}, {:.9}, {:.9}", number(at), 2.0 * (x + inside), y - inside, z + inside)?;
    }
    writeln!(out, "*ELEMENT, TYPE=C3D8, ELSET=ALL")?;
    let mut element = 0;
    for [i, j, k] in all().filter(|at| at.iter().all(|at| *at < cells)) {
        element += 1;
        let corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];
        write!(out, "{element}")?;
        for [a, b, c] in corners {
            write!(out, ", {}", number([i + a, j + b, k + c]))?;
        }
        writeln!(out)?;
    }
    let middle = |at: u32| (0.25..=0.75).contains(&share(at));
    let is_in = |name: &str, [i, j, k]: [u32; 3]| match name {
        "END" => i == 0,
        "TOP" => k == cells && middle(i) && middle(j),
        "SIDE" => j == 0 && middle(i) && middle(k),
        _ => i == cells && 0.5 <= share(j) && 0.5 <= share(k),
    };
    for name in TERMINALS {
        writeln!(out, "*NSET, NSET={name}")?;
        for at in all().filter(|at| is_in(name, *at)) {
            writeln!(out, "{},", number(at))?;
        }
    }
    writeln!(
        out,
        "*SOLID SECTION, ELSET=ALL, MATERIAL=STEEL\n*MATERIAL, NAME=STEEL\n*CONDUCTIVITY\n45.\n*DENSITY\n7800.\n*SPECIFIC HEAT\n500."
    )?;
    out.flush()
}

/// Reads and solves the body of a deck once, in this process.
///
/// # Errors
/// Those of reading; a deck that is none of [`write_body`].
pub fn measure(path: &Path, work: Work) -> io::Result<Measured> {
    let grammar = Grammar::builtin();
    let start = Timer::start();
    let mut file = File::open(path)?;
    let mut scanner = Scanner::new("body.inp", ScanOptions { grammar, keep: Keep::Interpreted });
    let mut piece = vec![0; 1 << 16];
    loop {
        let count = file.read(&mut piece)?;
        if count == 0 {
            break;
        }
        scanner.push(&piece[..count]);
    }
    let deck = scanner.finish();
    file.seek(SeekFrom::Start(0))?;
    let names = TERMINALS.map(Name::new);
    let mut rows = SeekableRows::new([(SourceId::ROOT, file)]);
    let body = Body::read(&deck, grammar, &names, &mut rows)?.map_err(io::Error::other)?;
    let read = start.seconds();
    let start = Timer::start();
    let solutions: Vec<Solution> = match work {
        Work::Single => vec![body.potential(BodyField::Thermal, None, 0).map_err(io::Error::other)?.1],
        Work::Lumped => body.lumped(BodyField::Thermal, None).map_err(io::Error::other)?.solutions.to_vec(),
    };
    let solve = start.seconds();
    let iterations = |solution: &Solution| match solution.method {
        SolutionMethod::Iterations(iterations) => iterations,
        SolutionMethod::Factor(_) => 0,
    };
    Ok(Measured {
        read,
        solve,
        unknowns: solutions[0].unknowns,
        iterations: solutions.iter().map(iterations).sum(),
        peak: memory("VmHWM:").unwrap_or(f64::NAN),
    })
}

impl Measured {
    /// As a line that [`of_line`](Self::of_line) reads.
    pub fn line(&self) -> String {
        let Self { read, solve, unknowns, iterations, peak } = self;
        format!("{read} {solve} {unknowns} {iterations} {peak}")
    }

    /// Reads back a line of [`line`](Self::line); `None` for anything else.
    pub fn of_line(line: &str) -> Option<Self> {
        let cells: Vec<&str> = line.split_whitespace().collect();
        let [read, solve, unknowns, iterations, peak] = cells[..] else { return None };
        Some(Self {
            read: read.parse().ok()?,
            solve: solve.parse().ok()?,
            unknowns: unknowns.parse().ok()?,
            iterations: iterations.parse().ok()?,
            peak: peak.parse().ok()?,
        })
    }
}

/// Measures bodies with so many elements along an edge, each run in a process of its own, and gives the page of it.
///
/// # Errors
/// Those of writing decks to the folder for temporary files, and of starting this program again.
pub fn page(cells: &[u32]) -> io::Result<String> {
    let program = std::env::current_exe()?;
    let path = std::env::temp_dir().join(format!("inpact-body-{}.inp", std::process::id()));
    let rows = cells.iter().map(|cells| rows(&program, &path, *cells)).collect::<io::Result<String>>();
    let _ = std::fs::remove_file(&path);
    Ok(format!("{HEAD}{}", rows?))
}

const HEAD: &str = "# Bodies: time and memory

Made by `inpact-bench bodies` (release), single runs, each in a process of its own.
Times are those on processors, so that work beside it does not count (on Linux; elsewhere the time that passes).
A body is a block of C3D8 bricks, distorted inside, with four terminals, three of them parts of faces.
*One solution* makes the matrix and solves it once, for the potential of one terminal; *lumped* is all that `inpact body` does: the same matrix, three solutions with one temperature a terminal, three with even flows, conductances and capacities.
Up to 20,000 unknowns there is a factor, beyond conjugate gradients, of which the iterations of both kinds are added.
Both read the deck first; the peak of memory is that of the whole process.

| elements | unknowns | what | read s | solve s | by one solution | iterations | peak MiB |
|---|---|---|---|---|---|---|---|
";

fn rows(program: &Path, path: &Path, cells: u32) -> io::Result<String> {
    write_body(cells, File::create(path)?)?;
    let mut rows = String::new();
    let mut single = f64::NAN;
    for (work, argument, name) in [(Work::Single, "single", "one solution"), (Work::Lumped, "lumped", "lumped")] {
        let run = Command::new(program).arg("body-once").arg(path).arg(argument).output()?;
        let text = String::from_utf8_lossy(&run.stdout);
        let failed = || io::Error::other(String::from_utf8_lossy(&run.stderr).into_owned());
        let Measured { read, solve, unknowns, iterations, peak } = Measured::of_line(&text).ok_or_else(failed)?;
        if work == Work::Single {
            single = solve;
        }
        let elements = f64::from(cells).powi(3);
        // Writing into a string cannot fail.
        let _ = writeln!(
            rows,
            "| {elements:.2e} | {unknowns} | {name} | {read:.2} | {solve:.2} | {:.2} | {} | {peak:.0} |",
            solve / single,
            if iterations == 0 { "factor".to_owned() } else { iterations.to_string() },
        );
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_body_is_solved_once_and_lumped() {
        let path = std::env::temp_dir().join(format!("inpact-bench-body-{}.inp", std::process::id()));
        write_body(6, File::create(&path).expect("a file")).expect("written");
        let [single, lumped] = [Work::Single, Work::Lumped].map(|work| measure(&path, work).expect("solved"));
        std::fs::remove_file(&path).expect("removed");
        // 7³ nodes, of which the four terminals hold 49, 9, 9 and 16.
        assert_eq!((single.unknowns, lumped.unknowns), (343 - 83, 343 - 83));
        let read = Measured::of_line(&lumped.line()).expect("a line");
        assert_eq!((read.unknowns, read.iterations), (lumped.unknowns, lumped.iterations));
    }
}
