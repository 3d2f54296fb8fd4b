//! Results of CalculiX in ASCII, `.frd` (`*NODE FILE`, `*EL FILE`, `*CONTACT FILE`), in the short and the long format.
//!
//! Source: CalculiX GraphiX manual, "Result Format": columns have fixed widths, and numbers may touch each other.
//! Times are total times.
//! `DISP` becomes `U`, `NDTEMP` `NT`, `FORC` `RF` and `FLUX` `HFL`, these and `RFL` with Abaqus' component names; the rest keep their names.
//! COPEN is negative where surfaces overlap; some releases write contact for all nodes, with 0 at nodes that are not on a slave surface.

use crate::collect::{self, PassedOver, Row};
use crate::error::Read;
use crate::format::Format;
use crate::lines::{Line, LineEnd, LineStream};
use crate::number;
use crate::problem::{Place, Problem, shown};
use crate::results::{Field, Frame, Region, Results};
use crate::taker::{TakeFrame, Taker, read_whole};

const CUT: &str = "the file is cut short, or the job has not ended yet; the part before is read";
const DAMAGED: &str = "the file is damaged here, or is no .frd of CalculiX; the part before is read";
const BINARY: &str = "use `*NODE FILE`, `*EL FILE` and `*CONTACT FILE` in place of `*NODE OUTPUT`, `*ELEMENT OUTPUT` and \
                      `*CONTACT OUTPUT`, which write binary numbers";

/// The characters of a value.
const VALUE: usize = 12;
/// The values of a line.
const VALUES: usize = 6;

/// Reads results of CalculiX in ASCII.
///
/// Coordinates of nodes and all blocks of values at nodes are read; elements are skipped.
///
/// # Errors
/// A line is malformed, numbers are binary, or the file ends before its last line, `9999`.
pub fn read_frd(bytes: &[u8]) -> Read {
    read_whole(bytes, frames)
}

/// The same state by state.
pub(crate) fn frames(lines: &mut LineStream<'_>, take: &mut TakeFrame<'_>) -> (Results, Result<(), Problem>) {
    let mut reader = Reader {
        results: Results::new(Format::Frd),
        taker: Taker::new(take),
        step: None,
        frame: None,
        passed_over: PassedOver::default(),
    };
    let outcome = reader.blocks(lines);
    reader.end_frame();
    reader.results.not_read = reader.passed_over.list();
    (reader.results, outcome)
}

/// Increment and step, from the line `1PSTEP`, and the bits of the time.
type FrameKey = (Option<(i64, i64)>, u64);

struct Reader<'a, 'b> {
    results: Results,
    taker: Taker<'a, 'b>,
    step: Option<(i64, i64)>,
    frame: Option<(FrameKey, Frame)>,
    passed_over: PassedOver,
}

/// Widths of labels, from the format flag of a block.
#[derive(Clone, Copy)]
enum Width {
    Short,
    Long,
}

impl Width {
    fn label(self) -> usize {
        match self {
            Self::Short => 5,
            Self::Long => 10,
        }
    }
}

impl Reader<'_, '_> {
    fn end_frame(&mut self) {
        self.taker.take(&self.results, self.frame.take().map(|(_, frame)| frame));
    }

    fn blocks(&mut self, lines: &mut LineStream<'_>) -> Result<(), Problem> {
        while let Some(line) = lines.next() {
            if self.taker.is_over {
                return Ok(());
            }
            let text = line.text.trim_ascii_start();
            if line.end == LineEnd::File && !text.starts_with(b"9999") {
                return Err(cut(line.place));
            }
            if text.is_empty() || text.starts_with(b"1C") || text.starts_with(b"1U") {
                continue;
            }
            if text.starts_with(b"1PSTEP") {
                let mut numbers = line.cells().skip(1).filter_map(|(_, cell)| number::integer(cell));
                self.step = numbers.nth(1).zip(numbers.next());
            } else if text.starts_with(b"1P") {
                self.passed_over.count(&shown(&text[..text.iter().position(|b| *b == b' ').unwrap_or(text.len())]));
            } else if text.starts_with(b"2C") {
                let width = width_of_coordinates(&line)?;
                self.coordinates(lines, width)?;
            } else if text.starts_with(b"3C") {
                self.passed_over.count("elements");
                while line_of_block(lines)?.is_some() {}
            } else if text.starts_with(b"100C") {
                let head = HeadOfValues::of(&line)?;
                self.values(lines, &head)?;
            } else if text.starts_with(b"9999") {
                return Ok(());
            } else {
                let message = format!("expected the begin of a block, found `{}`", shown(line.text));
                return Err(Problem::new(line.place, message, DAMAGED));
            }
        }
        Err(cut(lines.place()))
    }

    fn coordinates(&mut self, lines: &mut LineStream<'_>, width: Width) -> Result<(), Problem> {
        let field = self.results.coordinates.get_or_insert_with(|| {
            collect::field("COORD", Region::default(), Row::Node(0), ["COOR1", "COOR2", "COOR3"])
        });
        rows(lines, width, field)
    }

    fn values(&mut self, lines: &mut LineStream<'_>, head: &HeadOfValues) -> Result<(), Problem> {
        let HeadOfValues { time, is_eigenvalue, width } = *head;
        let key = (self.step, time.to_bits());
        if self.frame.as_ref().is_none_or(|(of, _)| *of != key) {
            self.end_frame();
            let total_time = (!is_eigenvalue).then_some(time);
            let (increment, step) = self.step.unzip();
            self.frame = Some((key, Frame { step, increment, total_time, ..Frame::default() }));
        }
        let mut field = names_of_values(lines)?;
        let outcome = rows(lines, width, &mut field);
        if let Some((_, frame)) = &mut self.frame {
            frame.fields.push(field);
        }
        outcome
    }
}

fn width_of_coordinates(head: &Line<'_>) -> Result<Width, Problem> {
    width(head, head.cells().nth(2).map_or(b"1".as_slice(), |(_, cell)| cell))
}

/// Time and width of numbers of a block of values, from its line `100C`.
struct HeadOfValues {
    time: f64,
    /// An eigenvalue is not a time.
    is_eigenvalue: bool,
    width: Width,
}

impl HeadOfValues {
    fn of(line: &Line<'_>) -> Result<Self, Problem> {
        let text = line.text;
        let time = number::real(columns(text, 12, 24)).ok_or_else(|| {
            let message = format!("expected the time of a block, found `{}`", shown(columns(text, 12, 24)));
            Problem::new(line.at(12), message, DAMAGED)
        })?;
        let flag = columns(text, 73, 75);
        let width = width(line, if flag.is_empty() { b"1" } else { flag })?;
        Ok(Self { time, is_eigenvalue: columns(text, 56, 58) == b"2", width })
    }
}

/// The lines `-4` and `-5`: the name of a field and those of its components.
fn names_of_values(lines: &mut LineStream<'_>) -> Result<Field, Problem> {
    let expected = |what: &str, line: &Line<'_>| {
        let message = format!("expected {what}, found `{}`", shown(line.text));
        Problem::new(line.place, message, DAMAGED)
    };
    let line = whole_line(lines)?;
    if !line.text.starts_with(b" -4") {
        return Err(expected("the name of a field, ` -4`", &line));
    }
    let name = String::from_utf8_lossy(columns(line.text, 5, 13)).into_owned();
    let count = number::integer(columns(line.text, 13, 18)).unwrap_or(0);
    let mut names = Vec::new();
    for _ in 0..count {
        let line = whole_line(lines)?;
        if !line.text.starts_with(b" -5") {
            return Err(expected("the name of a component, ` -5`", &line));
        }
        // Components that are to be computed, such as the size of a vector, have no values.
        if columns(line.text, 33, 38) != b"1" {
            names.push(String::from_utf8_lossy(columns(line.text, 5, 13)).into_owned());
        }
    }
    let (name, names) = as_abaqus(&name, names);
    Ok(collect::field(name, Region::default(), Row::Node(0), names))
}

/// The identifiers of Abaqus, where the quantity has one.
fn as_abaqus(name: &str, columns: Vec<String>) -> (String, Vec<String>) {
    let numbered =
        |prefix: &str, first: usize| (0..columns.len()).map(|at| format!("{prefix}{}", first + at)).collect();
    match name {
        "DISP" => ("U".to_owned(), numbered("U", 1)),
        "FORC" => ("RF".to_owned(), numbered("RF", 1)),
        "NDTEMP" => ("NT".to_owned(), numbered("NT", 11)),
        "RFL" => ("RFL".to_owned(), numbered("RFL", 11)),
        "FLUX" => ("HFL".to_owned(), numbered("HFL", 1)),
        _ => (name.to_owned(), columns),
    }
}

/// The lines `-1` and `-2` up to `-3`.
fn rows(lines: &mut LineStream<'_>, width: Width, field: &mut Field) -> Result<(), Problem> {
    let count = field.columns.len();
    let mut values = vec![0.0; count];
    while let Some(line) = line_of_block(lines)? {
        let begin = 3 + width.label();
        let label = columns(line.text, 3, begin);
        let node = match number::integer(label) {
            Some(node) if line.text.starts_with(b" -1") => node,
            _ => {
                let message = format!("expected the values of a node, ` -1`, found `{}`", shown(line.text));
                return Err(Problem::new(line.place, message, DAMAGED));
            }
        };
        let (mut line, mut within) = (line, 0);
        for (at, value) in values.iter_mut().enumerate() {
            if within == VALUES {
                line = match line_of_block(lines)? {
                    Some(line) if line.text.starts_with(b" -2") => line,
                    _ => {
                        let message = format!("node {node} has {at} values of {count}");
                        return Err(Problem::new(lines.place(), message, DAMAGED));
                    }
                };
                within = 0;
            }
            let from = begin + within * VALUE;
            let text = columns(line.text, from, from + VALUE);
            *value = number::real(text).ok_or_else(|| {
                let message = format!("expected value {} of {count} of node {node}, found `{}`", at + 1, shown(text));
                Problem::new(line.at(from), message, DAMAGED)
            })?;
            within += 1;
        }
        collect::push(field, Row::Node(node), &values);
    }
    Ok(())
}

/// The next line of a block; none where it ends, with `-3`.
fn line_of_block<'a>(lines: &'a mut LineStream<'_>) -> Result<Option<Line<'a>>, Problem> {
    let line = whole_line(lines)?;
    Ok((!line.text.starts_with(b" -3")).then_some(line))
}

/// The next complete line: a line without an end may be truncated.
fn whole_line<'a>(lines: &'a mut LineStream<'_>) -> Result<Line<'a>, Problem> {
    let place = lines.place();
    match lines.next() {
        Some(line) if line.end == LineEnd::Line => Ok(line),
        // The end of the file, or the start of an incomplete line.
        _ => Err(cut(place)),
    }
}

fn cut(place: Place) -> Problem {
    Problem::new(place, "the file ends before its last line, `9999`", CUT)
}

fn width(head: &Line<'_>, flag: &[u8]) -> Result<Width, Problem> {
    match flag {
        b"0" => Ok(Width::Short),
        b"1" => Ok(Width::Long),
        b"2" | b"3" => Err(Problem::new(head.place, "the numbers of this block are binary", BINARY)),
        other => {
            let message = format!("expected the format of a block, 0, 1, 2 or 3, found `{}`", shown(other));
            Err(Problem::new(head.place, message, DAMAGED))
        }
    }
}

/// The text in these columns, without blanks.
fn columns(text: &[u8], from: usize, to: usize) -> &[u8] {
    text.get(from.min(text.len())..to.min(text.len())).unwrap_or_default().trim_ascii()
}
