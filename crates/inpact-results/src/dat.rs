//! Printed output of CalculiX, `.dat` (`*CONTACT PRINT`, `*NODE PRINT`, `*SECTION PRINT` with FLUX).
//!
//! Source: CalculiX CrunchiX manual, *CONTACT PRINT and *NODE PRINT, and what ccx 2.20 prints.
//! A table has a title with its total time, a blank line and rows.
//! Contact of faces is printed by integration points, `slave element+face`, contact of nodes by `slave node`.
//! The clearance is negative where surfaces overlap, as CalculiX prints it; the normal force is positive in tension.
//! CalculiX titles the totals of CF, CFN and CFS alike in some releases: they keep the order of the file.
//! The total heat flux through a surface (SURFACE_FLUX) is positive where heat leaves the body of the surface.

use crate::collect::{self, PassedOver, Row};
use crate::error::Read;
use crate::format::Format;
use crate::lines::{Line, LineEnd, LineStream};
use crate::number;
use crate::problem::{Problem, shown};
use crate::results::{Column, Field, Frame, Name, Region, Results, Rows};
use crate::taker::{TakeFrame, Taker, read_whole};

const CUT: &str = "the file is cut short, or the job has not ended yet; the part before is read";
const DAMAGED: &str = "the file is damaged here, or is no .dat of CalculiX; the part before is read";

/// Reads printed output of CalculiX: relative contact displacements (CDIS), contact stresses (CSTR), contact energy (CELS),
/// statistics of contact pairs (CF) with their area, displacements, reaction forces, temperatures and heat of nodes, and the
/// flux of heat through surfaces.
///
/// # Errors
/// A row of a table that is read is malformed, or the last line has no end.
pub fn read_dat(bytes: &[u8]) -> Read {
    read_whole(bytes, frames)
}

/// The same state by state.
pub(crate) fn frames(lines: &mut LineStream<'_>, take: &mut TakeFrame<'_>) -> (Results, Result<(), Problem>) {
    let mut reader = Reader {
        results: Results::new(Format::Dat),
        taker: Taker::new(take),
        step: None,
        frame: None,
        table: Table::NotRead,
        passed_over: PassedOver::default(),
    };
    let outcome = reader.lines(lines);
    reader.end_frame();
    reader.results.not_read = reader.passed_over.list();
    (reader.results, outcome)
}

/// Whether a line is the title of a table.
pub(crate) fn is_header(text: &[u8]) -> bool {
    title(text).is_some()
}

/// The quantity of a table, and its time.
fn title(text: &[u8]) -> Option<(&str, f64)> {
    if !text.starts_with(b" ") || !text.get(1)?.is_ascii_alphabetic() {
        return None;
    }
    let text = std::str::from_utf8(text).ok()?.trim();
    let (title, time) = text.rsplit_once(" time ")?;
    let time = number::real(time.trim().as_bytes())?;
    let what = title.strip_suffix(" and").or_else(|| title.strip_suffix(" for"))?;
    Some((what, time))
}

/// The table whose rows are being read.
enum Table {
    NotRead,
    /// Rows of nodes or points, into the last field of the frame.
    Rows(Labels),
    /// Totals of a pair, into the last field of the frame; the columns of the next line of numbers.
    Totals(&'static [&'static str]),
}

#[derive(Clone, Copy)]
enum Labels {
    Node,
    ElementAndFace,
}

struct Reader<'a, 'b> {
    results: Results,
    taker: Taker<'a, 'b>,
    step: Option<i64>,
    frame: Option<Frame>,
    table: Table,
    passed_over: PassedOver,
}

impl Reader<'_, '_> {
    fn lines(&mut self, lines: &mut LineStream<'_>) -> Result<(), Problem> {
        while let Some(line) = lines.next() {
            if self.taker.is_over {
                break;
            }
            if line.end == LineEnd::File {
                return Err(Problem::new(line.place, "the last line has no end", CUT));
            }
            if line.is_blank() {
                continue;
            }
            let begins_text = line.text.trim_ascii_start().first().is_some_and(u8::is_ascii_alphabetic);
            if let Some((what, time)) = title(line.text) {
                self.begin(what, time);
            } else if begins_text && line.cells().any(|(_, cell)| number::real(cell).is_none()) {
                self.text(&line);
            } else {
                self.numbers(&line)?;
            }
        }
        Ok(())
    }

    fn end_frame(&mut self) {
        self.taker.take(&self.results, self.frame.take());
    }

    /// A line of text that is no title: the number of a step, or what the next totals are.
    fn text(&mut self, line: &Line<'_>) {
        let text = line.text.trim_ascii();
        if let Some(number) = text.strip_prefix(b"S T E P").and_then(|number| number::integer(number.trim_ascii())) {
            self.step = Some(number);
            self.end_frame();
            self.table = Table::NotRead;
        }
        if !matches!(self.table, Table::Totals(_)) {
            return;
        }
        let field = self.frame.as_mut().and_then(|frame| frame.fields.last_mut());
        let (name, columns): (Option<&str>, &[&str]) = match text {
            _ if text.starts_with(b"total surface force") => (Some("CF"), &["CF1", "CF2", "CF3", "CM1", "CM2", "CM3"]),
            _ if text.starts_with(b"total normal surface force") => {
                (Some("CFN"), &["CFN1", "CFN2", "CFN3", "CMN1", "CMN2", "CMN3"])
            }
            _ if text.starts_with(b"total shear surface force") => {
                (Some("CFS"), &["CFS1", "CFS2", "CFS3", "CMS1", "CMS2", "CMS3"])
            }
            _ if text.starts_with(b"center of gravity") => {
                (None, &["CENTER1", "CENTER2", "CENTER3", "NORMAL1", "NORMAL2", "NORMAL3"])
            }
            _ if text.starts_with(b"moment about the center of gravity") => (None, &["CMC1", "CMC2", "CMC3"]),
            _ if text.starts_with(b"area") => (None, &["CAREA", "NORMAL_FORCE", "SHEAR_FORCE"]),
            _ => (None, &[]),
        };
        if columns.is_empty() {
            self.passed_over.count(&shown(text));
        }
        if let (Some(field), Some(name)) = (field, name) {
            field.name = name.into();
        }
        self.table = Table::Totals(columns);
    }

    /// The title of a table.
    fn begin(&mut self, what: &str, time: f64) {
        if self.frame.as_ref().is_none_or(|frame| frame.total_time.map(f64::to_bits) != Some(time.to_bits())) {
            self.end_frame();
            self.frame = Some(Frame { step: self.step, total_time: Some(time), ..Frame::default() });
        }
        let components =
            what.split_once('(').and_then(|(_, rest)| rest.split_once(')')).map_or("", |(inside, _)| inside);
        let labels = if components.starts_with("slave element") { Labels::ElementAndFace } else { Labels::Node };
        let set = what.split_once(" for set ").map(|(_, set)| Name::from(set.trim()));
        let of_set = Region { set, ..Region::default() };
        let (name, region, columns): (_, _, &[&str]) = if what.starts_with("relative contact displacement") {
            ("CDIS", Region::default(), &["COPEN", "CSLIP1", "CSLIP2"])
        } else if what.starts_with("contact stress") {
            ("CSTR", Region::default(), &["CPRESS", "CSHEAR1", "CSHEAR2"])
        } else if what.starts_with("contact print energy") || what.starts_with("contact spring energy") {
            ("CELS", Region::default(), &["CELS"])
        } else if what.starts_with("displacements ") {
            ("U", of_set, &["U1", "U2", "U3"])
        } else if what.starts_with("forces ") {
            ("RF", of_set, &["RF1", "RF2", "RF3"])
        } else if what.starts_with("temperatures ") {
            ("NT", of_set, &["NT11"])
        } else if what.starts_with("heat generation ") {
            ("RFL", of_set, &["RFL11"])
        } else if let Some(pair) = what.strip_prefix("statistics for slave set ") {
            let (slave, master) = pair.split_once(", master set ").unwrap_or((pair, ""));
            let master = Some(master.trim()).filter(|master| !master.is_empty()).map(Name::from);
            let region = Region { slave: Some(slave.trim().into()), master, set: None };
            self.push(Field { name: "CF".into(), region, rows: Rows::Whole, columns: Vec::new() });
            self.table = Table::Totals(&[]);
            return;
        } else if what.starts_with("total surface flux ") {
            self.push(Field { name: "SURFACE_FLUX".into(), region: of_set, rows: Rows::Whole, columns: Vec::new() });
            self.table = Table::Totals(&["SURFACE_FLUX"]);
            return;
        } else {
            self.passed_over.count(what);
            self.table = Table::NotRead;
            return;
        };
        let kind = match labels {
            Labels::Node => Row::Node(0),
            Labels::ElementAndFace => Row::FacePoint { element: 0, face: 0 },
        };
        self.push(collect::field(name, region, kind, columns.iter().copied()));
        self.table = Table::Rows(labels);
    }

    fn push(&mut self, field: Field) {
        if let Some(frame) = &mut self.frame {
            frame.fields.push(field);
        }
    }

    fn numbers(&mut self, line: &Line<'_>) -> Result<(), Problem> {
        let Some(field) = self.frame.as_mut().and_then(|frame| frame.fields.last_mut()) else { return Ok(()) };
        let mut cells = line.cells();
        match self.table {
            Table::NotRead => (),
            Table::Rows(labels) => {
                let mut label = |what| match cells.next() {
                    Some((at, cell)) => number::integer(cell).ok_or_else(|| wrong(line, at, what, cell)),
                    None => Err(wrong(line, line.text.len(), what, b"")),
                };
                let row = match labels {
                    Labels::Node => Row::Node(label("the label of a node")?),
                    Labels::ElementAndFace => Row::FacePoint {
                        element: label("the label of an element")?,
                        face: label("the number of a face")?,
                    },
                };
                let values = values(line, cells, field.columns.len())?;
                collect::push(field, row, &values);
            }
            Table::Totals(names) => {
                if names.is_empty() {
                    return Ok(());
                }
                let values = values(line, cells, names.len())?;
                let columns = names.iter().zip(values);
                field.columns.extend(columns.map(|(name, value)| Column { name: (*name).into(), values: vec![value] }));
                self.table = Table::Totals(&[]);
            }
        }
        Ok(())
    }
}

fn values<'a>(
    line: &Line<'_>,
    cells: impl Iterator<Item = (usize, &'a [u8])>,
    count: usize,
) -> Result<Vec<f64>, Problem> {
    let values: Vec<f64> = cells
        .map(|(at, cell)| number::real(cell).ok_or_else(|| wrong(line, at, "a number", cell)))
        .collect::<Result<_, _>>()?;
    if values.len() == count {
        return Ok(values);
    }
    Err(Problem::new(line.place, format!("expected {count} values, found {}", values.len()), DAMAGED))
}

fn wrong(line: &Line<'_>, at: usize, expected: &str, found: &[u8]) -> Problem {
    Problem::new(line.at(at), format!("expected {expected}, found `{}`", shown(found)), DAMAGED)
}
