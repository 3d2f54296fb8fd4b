//! Detects the format of a file from its bytes, never from its name.

use crate::format::Format;
use crate::lines::Lines;
use crate::problem::{Place, Problem};

/// The number of bytes examined.
pub(crate) const HEAD: usize = 1 << 16;

/// The supported formats, for a message.
const READ: &str = "expected .fil in ASCII or .rpt of Abaqus, .frd in ASCII or .dat of CalculiX, or .vtu of ParaView";

/// Detects the format of a file from its first bytes. An unsupported file is rejected with its likely format, and how to get a supported one.
pub(crate) fn recognise(bytes: &[u8]) -> Result<Format, Problem> {
    let head = &bytes[..bytes.len().min(HEAD)];
    if let Some((message, help)) = foreign(head) {
        return Err(Problem::new(Place { byte: 0, line: 1 }, message, help));
    }
    let text = head.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(head);
    let begin = text.trim_ascii_start();
    if begin.starts_with(b"*I ") {
        return Ok(Format::Fil);
    }
    if begin.starts_with(b"<") && contains(head, b"<VTKFile") {
        return Ok(Format::Vtu);
    }
    if [&b"1C"[..], b"1U", b"2C"].iter().any(|key| begin.starts_with(key)) && text.starts_with(b" ") {
        return Ok(Format::Frd);
    }
    if contains(head, b"Field Output Report") || contains(head, b"Field Output reported at") || is_history(head) {
        return Ok(Format::Rpt);
    }
    if Lines::new(head).any(|line| crate::dat::is_header(line.text)) {
        return Ok(Format::Dat);
    }
    let (message, help) = other_text(begin);
    Err(Problem::new(Place { byte: 0, line: 1 }, message, help))
}

/// Whether the first lines are the head of an XY report: `X`, names, numbers.
fn is_history(head: &[u8]) -> bool {
    let mut lines = Lines::new(head).filter(|line| !line.is_blank());
    lines.next().is_some_and(|line| line.cells().next().is_some_and(|(_, cell)| cell == b"X"))
}

fn contains(text: &[u8], part: &[u8]) -> bool {
    memchr::memmem::find(text, part).is_some()
}

/// An unsupported format, recognised by its first bytes.
fn foreign(head: &[u8]) -> Option<(&'static str, &'static str)> {
    const FIL: &str = "put `*FILE FORMAT, ASCII` into the deck, or convert the file with `abaqus ascfil job=NAME`";
    if head.trim_ascii().is_empty() {
        return Some(("the file is empty", "let the job run to its end, or name another file"));
    }
    let known: [(&[u8], &str, &str); 10] = [
        (b"\xFF\xFE", "the file is in UTF-16", "save it as UTF-8 or ASCII"),
        (b"\xFE\xFF", "the file is in UTF-16", "save it as UTF-8 or ASCII"),
        (b"\x00\x10\x00\x00", "the file is a binary results file of Abaqus", FIL),
        (b"\x00\x00\x10\x00", "the file is a binary results file of Abaqus", FIL),
        (b"\x89HDF", "the file is in HDF5", "convert it with `meshio convert` to .vtu"),
        (b"CDF", "the file is in NetCDF (Exodus)", "convert it with `meshio convert` to .vtu"),
        (b"\x1F\x8B", "the file is compressed (gzip)", "unpack it"),
        (b"PK\x03\x04", "the file is compressed (zip)", "unpack it"),
        (b"# vtk DataFile", "the file is in the old format of VTK", "convert it with `meshio convert` to .vtu"),
        (b"SQLite format 3", "the file is a database", READ),
    ];
    if let Some((_, what, help)) = known.iter().find(|(magic, ..)| head.starts_with(magic)) {
        return Some((what, help));
    }
    let begin = &head[..head.len().min(512)];
    if begin.contains(&0) {
        let every_second = 8 <= begin.len() && begin.chunks_exact(2).all(|pair| (pair[0] == 0) != (pair[1] == 0));
        return Some(if every_second {
            ("the file is in UTF-16", "save it as UTF-8 or ASCII")
        } else {
            ("the kind of this binary file is unknown (.odb files are not read)", READ)
        });
    }
    None
}

/// The likely format of an unsupported text.
fn other_text(begin: &[u8]) -> (&'static str, &'static str) {
    if begin.starts_with(b"*") {
        return (
            "the file is a deck, not results",
            "name the results that a job wrote: .fil, .rpt, .frd, .dat or .vtu",
        );
    }
    if contains(begin, b"Abaqus") || contains(begin, b"ABAQUS") || contains(begin, b"A B A Q U S") {
        return (
            "the file is printed by Abaqus (.dat, .msg, .sta), which is not read",
            "ask for `*CONTACT FILE` and `*NODE FILE` with `*FILE FORMAT, ASCII` and name the .fil",
        );
    }
    ("the kind of this file is unknown", READ)
}
