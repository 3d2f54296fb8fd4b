//! The meshed parts of a generated deck: plates of C3D8 elements, one on top of the other.
//!
//! Neighbouring plates touch, so a deck of *n* interactions has *n* + 1 plates, and its mesh has the
//! requested size.
//! The text is laid out as Abaqus/CAE writes it: labels and coordinates in columns, 16 labels a line
//! in a set, `generate` where a set is a range.

use std::io::{self, Write};

use crate::random::Random;

/// The edge of an element, m.
const EDGE: f64 = 1e-3;
/// Labels on a line of a set.
const LABELS_A_LINE: u64 = 16;

/// A plate: elements along x, y and z.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Plate {
    /// Elements along x.
    pub along_x: u64,
    /// Elements along y.
    pub along_y: u64,
    /// Layers of elements.
    pub layers: u64,
}

impl Plate {
    /// The smallest plate.
    pub const UNIT: Self = Self { along_x: 1, along_y: 1, layers: 1 };

    /// The largest plate whose part fits into `bytes`, or the smallest one where
    /// nothing fits.
    pub fn fitting(bytes: u64) -> Self {
        // An element and a node of its own take about 140 bytes; a plate is about a quarter as thick as wide.
        let elements = bytes / 140;
        let thickest = largest(|layers| 16 * layers * layers * layers <= elements);
        // A row of elements can be a few percent of the plate, so several shapes are tried.
        (thickest.div_ceil(2)..=thickest)
            .flat_map(|layers| (2 * layers..=6 * layers).map(move |along_x| (layers, along_x)))
            .map(|(layers, along_x)| {
                let sized = |along_y| Self { along_x, along_y, layers };
                sized(largest(|along_y| sized(along_y).bytes() <= bytes))
            })
            .filter(|plate| plate.bytes() <= bytes)
            .max_by_key(|plate| plate.bytes())
            .unwrap_or(Self::UNIT)
    }

    /// Number of nodes.
    pub fn nodes(self) -> u64 {
        self.nodes_a_layer() * (self.layers + 1)
    }

    /// Number of elements.
    pub fn elements(self) -> u64 {
        self.elements_a_layer() * self.layers
    }

    /// The bytes of its part, without the lines whose length does not depend on the plate.
    fn bytes(self) -> u64 {
        let label = self.label_width() as u64;
        let node_line = label + 3 * 15 + 1;
        let element_line = 9 * label + 8 * 2 + 1;
        let layer = self.nodes_a_layer();
        // A comma and a blank behind each label, or the line end alone.
        let top_set = layer * (label + 2) - layer.div_ceil(LABELS_A_LINE);
        self.nodes() * node_line + self.elements() * element_line + top_set
    }

    fn nodes_a_layer(self) -> u64 {
        (self.along_x + 1) * (self.along_y + 1)
    }

    fn elements_a_layer(self) -> u64 {
        self.along_x * self.along_y
    }

    /// Eight columns as far as they reach: a width that followed the largest label closely would let
    /// the size of the mesh jump with every new digit.
    fn label_width(self) -> usize {
        self.nodes().to_string().len().max(8)
    }
}

/// Writes the plate of the given number, counted from 0, as a part: nodes, elements, sets, section.
///
/// # Errors
/// Those of the writer.
pub fn write_part(out: &mut impl Write, plate: Plate, number: usize, seed: u64) -> io::Result<()> {
    writeln!(out, "*Part, name=Plate-{}", number + 1)?;
    write_nodes(out, plate, Random::of_item(!seed, number as u64))?;
    write_elements(out, plate)?;
    let width = plate.label_width();
    writeln!(out, "*Nset, nset=Plate, generate\n {:>width$}, {:>width$}, 1", 1, plate.nodes())?;
    writeln!(out, "*Elset, elset=Plate, generate\n {:>width$}, {:>width$}, 1", 1, plate.elements())?;
    writeln!(out, "*Nset, nset=Top")?;
    let first = plate.nodes() - plate.nodes_a_layer() + 1;
    for label in first..=plate.nodes() {
        let last_on_line = (label - first + 1).is_multiple_of(LABELS_A_LINE) || label == plate.nodes();
        write!(out, "{label:>width$}{}", if last_on_line { "\n" } else { ", " })?;
    }
    writeln!(out, "** Section: Section-1\n*Solid Section, elset=Plate, material=Steel\n,\n*End Part\n**  ")
}

/// Writes the plate's instance in the assembly, raised to `height` (m).
///
/// # Errors
/// Those of the writer.
pub fn write_instance(out: &mut impl Write, number: usize, height: f64) -> io::Result<()> {
    let number = number + 1;
    writeln!(out, "*Instance, name=Plate-{number}-1, part=Plate-{number}")?;
    writeln!(out, "{:>13}, {:>13}, {height:>13.9}\n*End Instance\n**  ", "0.", "0.")
}

/// Writes the surfaces `Bottom-n` and `Top-n` of the plate's instance.
///
/// # Errors
/// Those of the writer.
pub fn write_surfaces(out: &mut impl Write, plate: Plate, number: usize) -> io::Result<()> {
    let number = number + 1;
    let layer = plate.elements_a_layer();
    let top = plate.elements() - layer + 1;
    for (side, face, first) in [("Bottom", "S1", 1), ("Top", "S2", top)] {
        let set = format!("_{side}-{number}_{face}");
        writeln!(out, "*Elset, elset={set}, internal, instance=Plate-{number}-1, generate")?;
        writeln!(out, " {first}, {}, 1", first + layer - 1)?;
        writeln!(out, "*Surface, type=ELEMENT, name={side}-{number}\n{set}, {face}")?;
    }
    Ok(())
}

/// The height of a plate, m.
pub fn height(plate: Plate) -> f64 {
    EDGE * plate.layers as f64
}

/// Nodes of a grid, those inside moved by up to a tenth of an edge as in a free mesh.
fn write_nodes(out: &mut impl Write, plate: Plate, mut random: Random) -> io::Result<()> {
    writeln!(out, "*Node")?;
    let width = plate.label_width();
    let mut coordinate = |index: u64, last: u64| {
        let inside = index > 0 && index < last;
        let shift = if inside { random.between(-0.1, 0.1) } else { 0.0 };
        EDGE * (index as f64 + shift)
    };
    let mut label = 0_u64;
    for k in 0..=plate.layers {
        for j in 0..=plate.along_y {
            for i in 0..=plate.along_x {
                label += 1;
                let x = coordinate(i, plate.along_x);
                let y = coordinate(j, plate.along_y);
                let z = coordinate(k, plate.layers);
                writeln!(out, "{label:>width$}, {x:>13.9}, {y:>13.9}, {z:>13.9}")?;
            }
        }
    }
    Ok(())
}

/// C3D8 elements: face S1 is the lower side, S2 the upper one.
fn write_elements(out: &mut impl Write, plate: Plate) -> io::Result<()> {
    writeln!(out, "*Element, type=C3D8")?;
    let width = plate.label_width();
    let row = plate.along_x + 1;
    let layer = plate.nodes_a_layer();
    let mut element = 0_u64;
    for k in 0..plate.layers {
        for j in 0..plate.along_y {
            for i in 0..plate.along_x {
                element += 1;
                let corner = 1 + i + j * row + k * layer;
                write!(out, "{element:>width$}")?;
                for above in [0, layer] {
                    for step in [0, 1, row + 1, row] {
                        write!(out, ", {:>width$}", corner + above + step)?;
                    }
                }
                writeln!(out)?;
            }
        }
    }
    Ok(())
}

/// The largest number from 1 on for which `holds`, which must hold up to some number and never after;
/// 1 where it never holds.
fn largest(holds: impl Fn(u64) -> bool) -> u64 {
    let mut beyond = 2;
    while holds(beyond) {
        beyond *= 2;
    }
    let mut within = beyond / 2;
    while beyond - within > 1 {
        let middle = within.midpoint(beyond);
        if holds(middle) {
            within = middle;
        } else {
            beyond = middle;
        }
    }
    within
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::size::measure;

    #[test]
    fn the_size_of_a_part_is_foreseen() {
        for bytes in [1_000, 20_000, 300_000, 2_000_000] {
            let plate = Plate::fitting(bytes);
            let written = measure(|out| write_part(out, plate, 0, 1)).expect("a sink takes all");
            let fixed = written - plate.bytes();
            assert!((200..300).contains(&fixed), "{plate:?}: {fixed} bytes that do not depend on it");
        }
    }

    #[test]
    fn a_fitting_plate_takes_what_it_is_given_within_a_percent_or_a_few_elements() {
        let mut bytes = 5_000;
        while bytes < 2_000_000_000 {
            let taken = Plate::fitting(bytes).bytes();
            assert!(taken <= bytes && bytes - taken < (bytes / 100).max(2_000), "{taken} of {bytes}");
            bytes += bytes / 11;
        }
        assert_eq!(Plate::fitting(10), Plate::UNIT);
    }

    #[test]
    fn a_unit_plate_reads_as_cae_writes_it() {
        let mut text = Vec::new();
        write_part(&mut text, Plate::UNIT, 2, 1).expect("a vector takes all");
        let text = String::from_utf8(text).expect("ASCII");
        assert!(text.starts_with("*Part, name=Plate-3\n*Node\n       1,   0.000000000,"), "{text}");
        assert!(text.contains("\n       8,   0.001000000,   0.001000000,   0.001000000\n"), "{text}");
        assert!(text.contains("*Element, type=C3D8\n       1,        1,        2,        4,        3,"), "{text}");
        assert!(text.contains("*Nset, nset=Top\n       5,        6,        7,        8\n"), "{text}");
    }
}
