//! Reads grids: those written here, and those of VTK's own writers, with numbers as ASCII, base64 or appended raw bytes.

use super::numbers::{Encoding, NumberType, decoded, numbers_of};
use super::xml::{CUT, DAMAGED, Tag, Tags};
use super::{Array, Cell, CellKind, Grid, Values};
use crate::error::{Read, ended};
use crate::format::Format;
use crate::problem::{Problem, shown};
use crate::results::{Column, Field, Frame, Name, Region, Results, Rows};

/// Columns that hold the labels of nodes or elements: our own, VTK's, and those of common converters.
const NODE_LABELS: [&str; 4] = ["node", "GlobalNodeId", "GlobalNodeIds", "node_id"];
const ELEMENT_LABELS: [&str; 4] = ["element", "GlobalElementId", "GlobalElementIds", "element_id"];

/// Reads a `.vtu` as results: one frame, one field per array.
///
/// Labels of nodes are those of an array `node`, `GlobalNodeId` or `node_id`, else points are counted from 1; the same for
/// elements. Components of an array `U` are `U1`, `U2`, …
///
/// # Errors
/// As the problem of [`read_grid`], with the arrays before it.
pub fn read_vtu(bytes: &[u8]) -> Read {
    let (grid, problem) = read_grid(bytes);
    let mut results = Results::new(Format::Vtu);
    let nodes = labels(&grid.point_data, &NODE_LABELS, grid.points.len());
    let elements = labels(&grid.cell_data, &ELEMENT_LABELS, grid.cells.len());
    if !grid.points.is_empty() {
        let column = |at: usize| Column {
            name: format!("COOR{}", at + 1).into(),
            values: grid.points.iter().map(|point| point[at]).collect(),
        };
        let (rows, columns) = (Rows::Nodes(nodes.clone()), (0..3).map(column).collect());
        results.coordinates = Some(Field { name: "COORD".into(), region: Region::default(), rows, columns });
    }
    let at_points = grid.point_data.iter().map(|array| field(array, Rows::Nodes(nodes.clone())));
    let at_cells = grid.cell_data.iter().map(|array| field(array, Rows::Elements(elements.clone())));
    let fields =
        at_points.chain(at_cells).filter(|field| field.columns.iter().all(|c| c.values.len() == field.rows.len()));
    let frame = Frame { total_time: grid.time, fields: fields.collect(), ..Frame::default() };
    results.frames.push(frame);
    ended(results, problem.map_or(Ok(()), Err))
}

fn labels(arrays: &[Array], names: &[&str], count: usize) -> Vec<i64> {
    let found = arrays.iter().find_map(|array| match &array.values {
        Values::Integers(labels) if labels.len() == count && names.contains(&array.name.as_str()) => {
            Some(labels.clone())
        }
        _ => None,
    });
    found.unwrap_or_else(|| (1..).take(count).collect())
}

fn field(array: &Array, rows: Rows) -> Field {
    #[expect(clippy::cast_precision_loss, reason = "whole numbers of pictures are labels and states")]
    let values: Vec<f64> = match &array.values {
        Values::Reals(values) => values.clone(),
        Values::Integers(values) => values.iter().map(|value| *value as f64).collect(),
    };
    let name: Name = array.name.as_str().into();
    let columns = (0..array.components).map(|at| Column {
        name: if array.components == 1 { name.clone() } else { format!("{name}{}", at + 1).into() },
        values: values.iter().skip(at).step_by(array.components).copied().collect(),
    });
    Field { region: Region::default(), rows, columns: columns.collect(), name }
}

/// Reads a `.vtu`: the part that could be read, and the problem that ended reading, if any.
///
/// Numbers may be ASCII, base64 in their element, or raw bytes at the end of the file, and compressed with zlib.
pub fn read_grid(bytes: &[u8]) -> (Grid, Option<Problem>) {
    let mut reader = Reader {
        grid: Grid::default(),
        encoding: Encoding::default(),
        appended: appended(bytes),
        points: None,
        cells: 0,
        connectivity: Vec::new(),
        offsets: Vec::new(),
        types: Vec::new(),
    };
    let problem = reader.file(&mut Tags::new(bytes)).err();
    (reader.grid, problem)
}

/// The raw bytes at the end of the file.
fn appended(bytes: &[u8]) -> Option<&[u8]> {
    let begin = memchr::memmem::find(bytes, b"<AppendedData")?;
    let mark = begin + memchr::memchr(b'_', &bytes[begin..])?;
    // Base64 would have to be split array by array.
    memchr::memmem::find(&bytes[begin..mark], b"raw").map(|_| &bytes[mark + 1..])
}

/// The section that the next arrays belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Section {
    Elsewhere,
    Field,
    PointData,
    CellData,
    Points,
    Cells,
}

struct Reader<'a> {
    grid: Grid,
    encoding: Encoding,
    appended: Option<&'a [u8]>,
    /// The number of points of the piece, once it began.
    points: Option<usize>,
    cells: usize,
    connectivity: Vec<i64>,
    offsets: Vec<i64>,
    types: Vec<i64>,
}

impl Reader<'_> {
    fn file(&mut self, tags: &mut Tags<'_>) -> Result<(), Problem> {
        let mut section = Section::Elsewhere;
        while let Some(tag) = tags.next()? {
            match tag.name {
                b"VTKFile" => self.begin(tags, &tag)?,
                b"Piece" => self.piece(tags, &tag)?,
                b"FieldData" => section = Section::Field,
                b"PointData" => section = Section::PointData,
                b"CellData" => section = Section::CellData,
                b"Points" => section = Section::Points,
                b"Cells" => section = Section::Cells,
                b"/FieldData" | b"/PointData" | b"/CellData" | b"/Points" => section = Section::Elsewhere,
                b"/Cells" => {
                    section = Section::Elsewhere;
                    self.cells(tags)?;
                }
                b"DataArray" if section != Section::Elsewhere => self.array(tags, &tag, section)?,
                // It is followed by bytes that are not XML.
                b"AppendedData" | b"/VTKFile" => return self.end(tags),
                _ => (),
            }
            let begins_section =
                [&b"FieldData"[..], b"PointData", b"CellData", b"Points", b"Cells"].contains(&tag.name);
            if tag.empty && begins_section {
                section = Section::Elsewhere;
            }
        }
        Err(Problem::new(tags.here(), "the file ends before `</VTKFile>`", CUT))
    }

    fn begin(&mut self, tags: &Tags<'_>, tag: &Tag<'_>) -> Result<(), Problem> {
        let kind = tag.attribute("type").unwrap_or_default();
        if kind != "UnstructuredGrid" {
            let message = format!("the file is a `{}` of VTK, not an `UnstructuredGrid`", shown(kind.as_bytes()));
            let help = "save it as .vtu (in ParaView: the filter Append Datasets makes an unstructured grid)";
            return Err(Problem::new(tags.place(tag.at), message, help));
        }
        self.encoding = Encoding::of(tag).map_err(|message| {
            let help = "in ParaView, choose the compressor ZLib or none when you save";
            Problem::new(tags.place(tag.at), message, help)
        })?;
        Ok(())
    }

    fn piece(&mut self, tags: &Tags<'_>, tag: &Tag<'_>) -> Result<(), Problem> {
        if self.points.is_some() {
            let help = "join them into one (in ParaView: the filter Merge Blocks); the first is read";
            return Err(Problem::new(tags.place(tag.at), "the file has several pieces", help));
        }
        let count = |name: &str| -> Result<usize, Problem> {
            let text = tag.attribute(name).unwrap_or_default();
            text.parse().map_err(|_| {
                let message = format!("expected how many there are as `{name}`, found `{}`", shown(text.as_bytes()));
                Problem::new(tags.place(tag.at), message, DAMAGED)
            })
        };
        (self.points, self.cells) = (Some(count("NumberOfPoints")?), count("NumberOfCells")?);
        Ok(())
    }

    fn array(&mut self, tags: &mut Tags<'_>, tag: &Tag<'_>, section: Section) -> Result<(), Problem> {
        let name = tag.attribute("Name").unwrap_or_default();
        let wrong = |tags: &Tags<'_>, message: String| {
            Problem::new(tags.place(tag.at), format!("array `{}`: {message}", shown(name.as_bytes())), DAMAGED)
        };
        let of_type = tag.attribute("type").unwrap_or_default();
        let Some(of_type) = NumberType::named(&of_type) else {
            // For example texts, which cannot be a field.
            tags.text(tag)?;
            return Ok(());
        };
        let values = match tag.attribute("format").as_deref() {
            Some("appended") => {
                let offset = tag.attribute("offset").and_then(|offset| offset.parse().ok());
                let Some(source) = self.appended.zip(offset).and_then(|(bytes, at): (_, usize)| bytes.get(at..)) else {
                    let help = "in ParaView, choose the data mode Ascii or Binary, or do not encode appended data";
                    let message = format!("array `{}` has no raw bytes at the end of the file", shown(name.as_bytes()));
                    return Err(Problem::new(tags.place(tag.at), message, help));
                };
                self.encoding.numbers(source, of_type).map_err(|message| wrong(tags, message))?
            }
            Some("binary") => {
                let (text, _) = tags.text(tag)?;
                let source = decoded(text).map_err(|message| wrong(tags, message))?;
                self.encoding.numbers(&source, of_type).map_err(|message| wrong(tags, message))?
            }
            _ => {
                let (text, _) = tags.text(tag)?;
                numbers_of(text, of_type).map_err(|message| wrong(tags, message))?
            }
        };
        let components = tag.attribute("NumberOfComponents").map_or(Some(1), |count| count.parse().ok());
        let components = components.filter(|count| (1..=values.len().max(9)).contains(count));
        let Some(components) = components else {
            return Err(wrong(tags, "expected a number of components".to_owned()));
        };
        let points = self.points.unwrap_or(0);
        let rows = match section {
            Section::PointData | Section::Points => Some(points),
            Section::CellData => Some(self.cells),
            _ => None,
        };
        if let Some(rows) = rows
            && components.checked_mul(rows) != Some(values.len())
        {
            let found = values.len();
            return Err(wrong(tags, format!("expected {components} numbers for each of {rows}, found {found}")));
        }
        let array = Array { name: name.clone(), components, values };
        self.keep(array, section).map_err(|message| wrong(tags, message))
    }

    fn keep(&mut self, array: Array, section: Section) -> Result<(), String> {
        match (section, array.name.as_str(), &array.values) {
            (Section::PointData, ..) => self.grid.point_data.push(array),
            (Section::CellData, ..) => self.grid.cell_data.push(array),
            (Section::Points, _, values) => {
                if array.components != 3 {
                    return Err(format!("expected 3 coordinates a point, found {}", array.components));
                }
                let values = reals(values);
                self.grid.points = values.chunks_exact(3).map(|point| [point[0], point[1], point[2]]).collect();
            }
            (Section::Field, "TimeValue", values) => self.grid.time = reals(values).first().copied(),
            (Section::Cells, "connectivity", Values::Integers(values)) => self.connectivity.clone_from(values),
            (Section::Cells, "offsets", Values::Integers(values)) => self.offsets.clone_from(values),
            (Section::Cells, "types", Values::Integers(values)) => self.types.clone_from(values),
            (Section::Cells, "connectivity" | "offsets" | "types", _) => {
                return Err("expected whole numbers".to_owned());
            }
            _ => (),
        }
        Ok(())
    }

    /// Makes cells of the three arrays that describe them.
    fn cells(&mut self, tags: &Tags<'_>) -> Result<(), Problem> {
        let wrong = |message: String| Problem::new(tags.here(), format!("cells: {message}"), DAMAGED);
        for (name, values) in [("offsets", &self.offsets), ("types", &self.types)] {
            if values.len() != self.cells {
                return Err(wrong(format!("expected {} `{name}`, found {}", self.cells, values.len())));
            }
        }
        let points = self.points.unwrap_or(0);
        let mut begin = 0;
        for (offset, kind) in self.offsets.iter().zip(&self.types) {
            let end = usize::try_from(*offset).ok();
            let Some(of_cell) = end.and_then(|end| self.connectivity.get(begin..end)) else {
                let end = self.connectivity.len();
                return Err(wrong(format!("expected an offset from {begin} to {end}, found {offset}")));
            };
            begin += of_cell.len();
            let kind = u8::try_from(*kind).map_err(|_| wrong(format!("{kind} is no type")))?;
            let inside = |point: &i64| usize::try_from(*point).ok().filter(|point| *point < points);
            let Some(of_cell) = of_cell.iter().map(inside).collect() else {
                return Err(wrong(format!("cell {} names a point that is not there", self.grid.cells.len())));
            };
            self.grid.cells.push(Cell { kind: CellKind::from_number(kind), points: of_cell });
        }
        Ok(())
    }

    fn end(&self, tags: &Tags<'_>) -> Result<(), Problem> {
        match self.points {
            Some(points) if points == self.grid.points.len() && self.cells == self.grid.cells.len() => Ok(()),
            Some(_) => {
                Err(Problem::new(tags.here(), "the piece has no points or cells where it says that it has", DAMAGED))
            }
            None => Err(Problem::new(tags.here(), "the file has no piece", DAMAGED)),
        }
    }
}

fn reals(values: &Values) -> Vec<f64> {
    match values {
        Values::Reals(values) => values.clone(),
        #[expect(clippy::cast_precision_loss, reason = "coordinates that are whole numbers are small")]
        Values::Integers(values) => values.iter().map(|value| *value as f64).collect(),
    }
}
