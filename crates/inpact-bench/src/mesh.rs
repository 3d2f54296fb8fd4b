//! Time and memory of reading the mesh around a contact pair, on blocks of bricks of any size.
//!
//! A deck has a cube of nodes and, a little above it, a single layer of bricks that lies on it. Its surfaces are faces by name, or element sets without a face,
//! whose free faces have to be found among all elements.

use crate::network::run::memory;
use inpact_parser::deck::{Keep, ScanOptions, Scanner};
use inpact_parser::grammar::Grammar;
use inpact_parser::mesh::{SeekableRows, SurfaceKind, read};
use inpact_parser::model;
use inpact_parser::span::SourceId;
use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// Definitions of the surfaces of the deck.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Surfaces {
    /// By the names of faces.
    Named,
    /// By element sets without a face.
    Free,
}

/// Time and memory of one reading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// Bytes of the deck.
    pub bytes: u64,
    /// Seconds to scan the deck into blocks.
    pub scan: f64,
    /// Seconds to read surfaces, elements and nodes after that.
    pub mesh: f64,
    /// Seconds to compute areas and clearances.
    pub contact: f64,
    /// Faces of all surfaces.
    pub faces: usize,
    /// Memory at most, in MiB; NaN where the system does not tell.
    pub peak: f64,
}

/// Writes the nodes and elements of a cube with `side` nodes along each edge and of the layer on it; returns their number of bytes.
///
/// # Errors
/// Those of writing.
pub fn write_mesh(side: u32, out: impl Write) -> io::Result<u64> {
    let mut out = Counting { out: BufWriter::with_capacity(1 << 20, out), bytes: 0 };
    let cube = side * side * side;
    let place = |i: u32| f64::from(i) / f64::from(side - 1);
    writeln!(out, "*NODE")?;
    for k in 0..side {
        for j in 0..side {
            for i in 0..side {
                let node = (k * side + j) * side + i + 1;
                writeln!(out, "{node}, {:.9}, {:.9}, {:.9}", place(i), place(j), place(k))?;
            }
        }
    }
    for (k, height) in [(0, 1.001), (1, 1.5)] {
        for j in 0..side {
            for i in 0..side {
                let node = cube + (k * side + j) * side + i + 1;
                writeln!(out, "{node}, {:.9}, {:.9}, {height}", place(i), place(j))?;
            }
        }
    }
    let bricks = |out: &mut Counting<_>, first_node: u32, first: u32, layers: u32| -> io::Result<()> {
        let mut element = first;
        for k in 0..layers {
            for j in 0..side - 1 {
                for i in 0..side - 1 {
                    let low = first_node + (k * side + j) * side + i;
                    let high = low + side * side;
                    let around = |node: u32| [node, node + 1, node + side + 1, node + side];
                    let ([a, b, c, d], [e, f, g, h]) = (around(low), around(high));
                    writeln!(out, "{element}, {a}, {b}, {c}, {d}, {e}, {f}, {g}, {h}")?;
                    element += 1;
                }
            }
        }
        Ok(())
    };
    let layer = (side - 1) * (side - 1);
    writeln!(out, "*ELEMENT, TYPE=C3D8, ELSET=CUBE")?;
    bricks(&mut out, 1, 1, side - 1)?;
    writeln!(out, "*ELEMENT, TYPE=C3D8, ELSET=LAYER")?;
    bricks(&mut out, cube + 1, layer * (side - 1) + 1, 1)?;
    writeln!(out, "*ELSET, ELSET=UPMOST, GENERATE\n{}, {}, 1", layer * (side - 2) + 1, layer * (side - 1))?;
    out.out.flush()?;
    Ok(out.bytes)
}

/// The rows after the mesh: surfaces, an interaction and the pair.
pub fn tail(surfaces: Surfaces) -> String {
    let (lower, upper) = match surfaces {
        Surfaces::Named => ("UPMOST, S2", "LAYER, S1"),
        Surfaces::Free => ("CUBE,", "LAYER,"),
    };
    format!(
        "*SURFACE, NAME=LOWER\n{lower}\n*SURFACE, NAME=UPPER\n{upper}\n*SURFACE INTERACTION, NAME=GAP\n*GAP CONDUCTANCE\n10., 0.\n0., 0.01\n*CONTACT PAIR, INTERACTION=GAP\nUPPER, LOWER\n"
    )
}

/// Reads the mesh of a deck once, in this process.
///
/// # Errors
/// Those of reading; a deck without the pair.
pub fn measure(path: &Path) -> io::Result<Measured> {
    let grammar = Grammar::builtin();
    let start = Timer::start();
    let mut file = File::open(path)?;
    let mut scanner = Scanner::new("mesh.inp", ScanOptions { grammar, keep: Keep::Interpreted });
    let mut piece = vec![0; 1 << 16];
    let mut bytes = 0;
    loop {
        let count = file.read(&mut piece)?;
        if count == 0 {
            break;
        }
        bytes += count as u64;
        scanner.push(&piece[..count]);
    }
    let deck = scanner.finish();
    let (model, _) = model::read(&deck, grammar);
    let scan = start.seconds();
    let start = Timer::start();
    file.seek(SeekFrom::Start(0))?;
    let mesh = read(&deck, grammar, &model, &mut SeekableRows::new([(SourceId::ROOT, file)]))?;
    let of_mesh = start.seconds();
    let pair = mesh.pairs.first().ok_or_else(|| io::Error::other(format!("no pair: {:?}", mesh.notes)))?;
    let start = Timer::start();
    let contact = mesh.contact(pair, 1.0).map_err(io::Error::other)?;
    let of_contact = start.seconds();
    if contact.is_empty() {
        return Err(io::Error::other("the pair has no slave node"));
    }
    let faces = mesh.surfaces.iter().map(|surface| match &surface.kind {
        SurfaceKind::Faces(faces) => faces.surface.len(),
        SurfaceKind::Nodes(_) => 0,
    });
    let peak = memory("VmHWM:").unwrap_or(f64::NAN);
    Ok(Measured { bytes, scan, mesh: of_mesh, contact: of_contact, faces: faces.sum(), peak })
}

impl Measured {
    /// As a line that [`of_line`](Self::of_line) reads.
    pub fn line(&self) -> String {
        let Self { bytes, scan, mesh, contact, faces, peak } = self;
        format!("{bytes} {scan} {mesh} {contact} {faces} {peak}")
    }

    /// Reads a line of [`line`](Self::line); `None` for anything else.
    pub fn of_line(line: &str) -> Option<Self> {
        let mut cells = line.split_whitespace();
        let mut number = || cells.next()?.parse::<f64>().ok();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "counts that were printed")]
        let counted = |number: f64| number as u64;
        let [bytes, scan, mesh, contact, faces, peak] =
            [number()?, number()?, number()?, number()?, number()?, number()?];
        Some(Self { bytes: counted(bytes), scan, mesh, contact, faces: usize::try_from(counted(faces)).ok()?, peak })
    }
}

/// Measures cubes with so many nodes along an edge, each reading in a process of its own, and gives the page of it.
///
/// # Errors
/// Those of writing decks to the folder for temporary files, and of starting this program again.
pub fn page(sides: &[u32]) -> io::Result<String> {
    let program = std::env::current_exe()?;
    let path = std::env::temp_dir().join(format!("inpact-mesh-{}.inp", std::process::id()));
    let measured = measure_all(&program, &path, sides);
    let _ = std::fs::remove_file(&path);
    let mut page = String::from(HEAD);
    let mut last: [Option<(f64, Measured)>; 2] = [None; 2];
    for (side, kind, of) in measured? {
        let nodes = f64::from(side).powi(3) + 2.0 * f64::from(side).powi(2);
        let seconds = of.scan + of.mesh;
        let (at, name) = match kind {
            Surfaces::Named => (0, "by name"),
            Surfaces::Free => (1, "free"),
        };
        let exponent = last[at].map_or_else(
            || "–".to_owned(),
            |(before, earlier)| shown((seconds / (earlier.scan + earlier.mesh)).ln() / (nodes / before).ln(), 2),
        );
        // Writing into a string cannot fail.
        let _ = writeln!(
            page,
            "| {nodes:.2e} | {name} | {} | {:.1} | {:.3} | {:.3} | {:.3} | {} | {exponent} | {:.0} |",
            of.faces,
            of.bytes as f64 / 1e6,
            of.scan,
            of.mesh,
            of.contact,
            shown(of.bytes as f64 / 1e6 / seconds, 0),
            of.peak,
        );
        last[at] = Some((nodes, of));
    }
    Ok(page)
}

/// A number; a dash for one from a time too short to be measured.
fn shown(number: f64, digits: usize) -> String {
    if number.is_finite() { format!("{number:.digits$}") } else { "–".to_owned() }
}

const HEAD: &str = "# Meshes: time and memory

Made by `inpact-bench mesh` (release), single runs, each in a process of its own.
Times are those on processors, of all threads together, so that work beside it does not count; waiting for a disk does not either (on Linux; elsewhere the time that passes).
A deck has a cube of C3D8 bricks and a layer of them on it; the surfaces of its pair are faces by name (the upmost layer, S2), or element sets without a face, whose free faces are found among all elements.
Scan is cutting the deck into blocks, mesh the reading of surfaces, elements and nodes behind it, contact areas and clearances of the slave nodes.

| nodes | surfaces | faces | MB | scan s | mesh s | contact s | MB/s (scan and mesh) | exponent | peak MiB |
|---|---|---|---|---|---|---|---|---|---|
";

fn measure_all(program: &Path, path: &Path, sides: &[u32]) -> io::Result<Vec<(u32, Surfaces, Measured)>> {
    let mut measured = Vec::new();
    for side in sides {
        let mut file = File::options().create(true).truncate(true).read(true).write(true).open(path)?;
        let length = write_mesh(*side, &mut file)?;
        for kind in [Surfaces::Named, Surfaces::Free] {
            file.set_len(length)?;
            file.seek(SeekFrom::End(0))?;
            file.write_all(tail(kind).as_bytes())?;
            let run = Command::new(program).arg("mesh-once").arg(path).output()?;
            let text = String::from_utf8_lossy(&run.stdout);
            let failed = || io::Error::other(String::from_utf8_lossy(&run.stderr).into_owned());
            measured.push((*side, kind, Measured::of_line(&text).ok_or_else(failed)?));
        }
    }
    Ok(measured)
}

/// Measures the CPU time of the threads of this process, which excludes other load; elapsed time where the system does not give it.
pub(crate) struct Timer {
    start: Instant,
    busy: Option<f64>,
}

impl Timer {
    pub(crate) fn start() -> Self {
        Self { start: Instant::now(), busy: Self::busy() }
    }

    pub(crate) fn seconds(&self) -> f64 {
        let busy = Self::busy().zip(self.busy).map(|(now, before)| now - before);
        busy.unwrap_or_else(|| self.start.elapsed().as_secs_f64())
    }

    /// The CPU time so far, in seconds, on Linux.
    fn busy() -> Option<f64> {
        let of_thread = |thread: io::Result<std::fs::DirEntry>| {
            let counts = std::fs::read_to_string(thread.ok()?.path().join("schedstat")).ok()?;
            counts.split_whitespace().next()?.parse::<f64>().ok()
        };
        let nanoseconds: Option<f64> = std::fs::read_dir("/proc/self/task").ok()?.map(of_thread).sum();
        nanoseconds.map(|nanoseconds| nanoseconds / 1e9)
    }
}

/// Counts the bytes it passes on.
struct Counting<W> {
    out: W,
    bytes: u64,
}

impl<W: Write> Write for Counting<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.out.write(bytes)?;
        self.bytes += count as u64;
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_kinds_of_surfaces_are_read_whole() {
        let folder = std::env::temp_dir().join(format!("inpact-bench-mesh-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        for (kind, faces) in [(Surfaces::Named, 2 * 16), (Surfaces::Free, 6 * 16 + 2 * 16 + 4 * 4)] {
            let path = folder.join("m.inp");
            let mut deck = Vec::new();
            let length = write_mesh(5, &mut deck).expect("a vector");
            assert_eq!(length, deck.len() as u64);
            deck.extend_from_slice(tail(kind).as_bytes());
            std::fs::write(&path, deck).expect("written");
            let measured = measure(&path).expect("read");
            assert_eq!(measured.faces, faces, "{kind:?}");
            assert_eq!(Measured::of_line(&measured.line()).map(|read| read.faces), Some(faces));
        }
        std::fs::remove_dir_all(&folder).expect("removed");
    }
}
