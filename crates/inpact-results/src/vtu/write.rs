//! Writes grids.

use super::{Array, Grid, Values};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::io::{self, Write};

/// A file of a collection and its time (T).
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// The time.
    pub time: f64,
    /// The `.vtu`, relative to the folder of the `.pvd`.
    pub file: String,
}

/// Writes a grid as `.vtu`.
///
/// Integers are written as `Int64` and all others as `Float64`, little-endian, so the round trip is exact.
///
/// # Errors
/// Writing fails; or, as [`io::ErrorKind::InvalidInput`], an array has another number of values than there are points
/// or cells, or a cell refers to a missing point.
pub fn write_grid(grid: &Grid, out: &mut impl Write) -> io::Result<()> {
    sound(grid)?;
    writeln!(out, r#"<?xml version="1.0"?>"#)?;
    writeln!(out, r#"<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">"#)?;
    writeln!(out, "<UnstructuredGrid>")?;
    if let Some(time) = grid.time {
        writeln!(out, "<FieldData>")?;
        // ParaView takes the time of a single file from here.
        write!(out, r#"<DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="binary">"#)?;
        inline(out, time.to_le_bytes().into_iter())?;
        writeln!(out, "</DataArray>\n</FieldData>")?;
    }
    writeln!(out, r#"<Piece NumberOfPoints="{}" NumberOfCells="{}">"#, grid.points.len(), grid.cells.len())?;
    writeln!(out, "<PointData>")?;
    grid.point_data.iter().try_for_each(|array| column(out, array))?;
    writeln!(out, "</PointData>\n<CellData>")?;
    grid.cell_data.iter().try_for_each(|array| column(out, array))?;
    writeln!(out, "</CellData>\n<Points>")?;
    write!(out, r#"<DataArray type="Float64" Name="Points" NumberOfComponents="3" format="binary">"#)?;
    inline(out, grid.points.iter().flatten().flat_map(|value| value.to_le_bytes()))?;
    writeln!(out, "</DataArray>\n</Points>\n<Cells>")?;
    let connectivity = grid.cells.iter().flat_map(|cell| &cell.points);
    write!(out, r#"<DataArray type="Int64" Name="connectivity" format="binary">"#)?;
    inline(out, connectivity.flat_map(|point| (*point as u64).to_le_bytes()))?;
    let offsets = grid.cells.iter().scan(0_u64, |end, cell| {
        *end += cell.points.len() as u64;
        Some(*end)
    });
    write!(out, "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"binary\">")?;
    inline(out, offsets.flat_map(u64::to_le_bytes))?;
    write!(out, "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"binary\">")?;
    inline(out, grid.cells.iter().map(|cell| cell.kind.number()))?;
    writeln!(out, "</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>")
}

/// Writes a `.pvd`: the `.vtu` files and their times.
///
/// # Errors
/// Writing fails.
pub fn write_collection(moments: &[Moment], out: &mut impl Write) -> io::Result<()> {
    writeln!(out, r#"<?xml version="1.0"?>"#)?;
    writeln!(out, r#"<VTKFile type="Collection" version="1.0" byte_order="LittleEndian">"#)?;
    writeln!(out, "<Collection>")?;
    for Moment { time, file } in moments {
        writeln!(out, r#"<DataSet timestep="{time:?}" part="0" file="{}"/>"#, escaped(file))?;
    }
    writeln!(out, "</Collection>\n</VTKFile>")
}

/// A column in its element.
fn column(out: &mut impl Write, array: &Array) -> io::Result<()> {
    let name = escaped(&array.name);
    // For 1 component meshio would make a matrix with one column.
    let components = match array.components {
        1 => String::new(),
        several => format!(r#" NumberOfComponents="{several}""#),
    };
    let of_type = match array.values {
        Values::Reals(_) => "Float64",
        Values::Integers(_) => "Int64",
    };
    write!(out, r#"<DataArray type="{of_type}" Name="{name}"{components} format="binary">"#)?;
    match &array.values {
        Values::Reals(values) => inline(out, values.iter().flat_map(|value| value.to_le_bytes()))?,
        Values::Integers(values) => inline(out, values.iter().flat_map(|value| value.to_le_bytes()))?,
    }
    writeln!(out, "</DataArray>")
}

/// The number of bytes and the bytes, in one base64 text.
fn inline(out: &mut impl Write, bytes: impl Iterator<Item = u8> + Clone) -> io::Result<()> {
    // A multiple of 3, so that pieces need no padding between them.
    const PIECE: usize = 3 << 12;
    let count = bytes.clone().count() as u64;
    let mut piece = Vec::with_capacity(PIECE);
    let mut text = String::new();
    let mut send = |piece: &mut Vec<u8>| {
        text.clear();
        STANDARD.encode_string(&*piece, &mut text);
        piece.clear();
        out.write_all(text.as_bytes())
    };
    for byte in count.to_le_bytes().into_iter().chain(bytes) {
        piece.push(byte);
        if piece.len() == PIECE {
            send(&mut piece)?;
        }
    }
    send(&mut piece)
}

fn sound(grid: &Grid) -> io::Result<()> {
    let invalid = |message: String| Err(io::Error::new(io::ErrorKind::InvalidInput, message));
    for (arrays, rows, of) in
        [(&grid.point_data, grid.points.len(), "points"), (&grid.cell_data, grid.cells.len(), "cells")]
    {
        for Array { name, components, values } in arrays {
            if *components == 0 || components.checked_mul(rows) != Some(values.len()) {
                let found = values.len();
                return invalid(format!("`{name}` has {found} values, expected {components} for each of {rows} {of}"));
            }
        }
    }
    let points = grid.points.len();
    match grid.cells.iter().flat_map(|cell| &cell.points).find(|point| points <= **point) {
        Some(point) => invalid(format!("a cell names point {point}, there are {points}")),
        None => Ok(()),
    }
}

fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            // XML has no such characters at all.
            control if control.is_control() => escaped.push('_'),
            other => escaped.push(other),
        }
    }
    escaped
}
