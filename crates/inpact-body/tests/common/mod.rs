//! Decks of blocks of every type of solid element, and how they are read.

#![allow(dead_code, reason = "each test file uses some of it")]

use inpact_body::{Body, Error};
use inpact_geometry::{ElementShape, Point};
use inpact_parser::deck::scan;
use inpact_parser::grammar::{Dialect, Grammar, Release};
use inpact_parser::mesh::KeptRows;
use inpact_parser::model::Name;
use std::collections::BTreeMap;

/// The types whose conduction is tested, with their names.
pub(crate) const TYPES: [(&str, ElementShape); 8] = [
    ("C3D4", ElementShape::Tetrahedron4),
    ("C3D10", ElementShape::Tetrahedron10),
    ("C3D6", ElementShape::Wedge6),
    ("C3D15", ElementShape::Wedge15),
    ("C3D8", ElementShape::Hexahedron8),
    ("DC3D8", ElementShape::Hexahedron8),
    ("C3D20", ElementShape::Hexahedron20),
    ("C3D20R", ElementShape::Hexahedron20),
];

/// Nodes in the middle of edges.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Edges {
    /// Half way between the corners.
    Straight,
    /// Where the map puts them.
    Curved,
}

/// A block of cells, whose points are those of the unit cube before they are mapped.
pub(crate) struct Block {
    pub(crate) type_name: &'static str,
    pub(crate) shape: ElementShape,
    pub(crate) cells: [usize; 3],
    pub(crate) edges: Edges,
    pub(crate) map: Box<dyn Fn(Point) -> Point>,
}

/// The mesh of a block: nodes by number, with their places in the unit cube and where they are; elements.
pub(crate) struct Meshed {
    pub(crate) nodes: BTreeMap<usize, (Point, Point)>,
    pub(crate) elements: Vec<Vec<usize>>,
    pub(crate) type_name: &'static str,
}

/// Corners of the elements of a cell.
fn cells(shape: ElementShape) -> Vec<Vec<[usize; 3]>> {
    let square = [[0, 0], [1, 0], [1, 1], [0, 1]];
    match shape {
        ElementShape::Hexahedron8 | ElementShape::Hexahedron20 => {
            vec![[0, 1].iter().flat_map(|&z| square.map(|[x, y]| [x, y, z])).collect()]
        }
        ElementShape::Wedge6 | ElementShape::Wedge15 => [[0, 1, 2], [0, 2, 3]]
            .iter()
            .map(|triangle| {
                [0, 1].iter().flat_map(|&z| triangle.map(|at: usize| [square[at][0], square[at][1], z])).collect()
            })
            .collect(),
        _ => [[0, 1, 2], [1, 2, 0], [2, 0, 1], [1, 0, 2], [0, 2, 1], [2, 1, 0]]
            .iter()
            .enumerate()
            .map(|(number, order)| {
                let mut corners = vec![[0, 0, 0]];
                for axis in order {
                    let mut next = corners[corners.len() - 1];
                    next[*axis] = 1;
                    corners.push(next);
                }
                if 3 <= number {
                    corners.swap(1, 2);
                }
                corners
            })
            .collect(),
    }
}

impl Block {
    pub(crate) fn mesh(&self) -> Meshed {
        let fine = self.cells.map(|cells| 2 * cells);
        let number = |[i, j, k]: [usize; 3]| 1 + i + (fine[0] + 1) * (j + (fine[1] + 1) * k);
        let place = |at: [usize; 3]| [0, 1, 2].map(|k| at[k] as f64 / fine[k] as f64);
        let mut nodes = BTreeMap::new();
        let mut elements = Vec::new();
        for cell in (0..self.cells.iter().product()).map(|cell: usize| {
            [cell % self.cells[0], cell / self.cells[0] % self.cells[1], cell / self.cells[0] / self.cells[1]]
        }) {
            for corners in cells(self.shape) {
                let mut of_element: Vec<[usize; 3]> =
                    corners.iter().map(|corner| [0, 1, 2].map(|k| 2 * (cell[k] + corner[k]))).collect();
                of_element.resize(self.shape.nodes(), [usize::MAX; 3]);
                for at in &of_element[..corners.len()] {
                    nodes.insert(number(*at), (place(*at), (self.map)(place(*at))));
                }
                for face in self.shape.faces() {
                    let count = face.shape.corners();
                    for (edge, middle) in face.nodes[count..].iter().enumerate() {
                        let [a, b] =
                            [face.nodes[edge], face.nodes[(edge + 1) % count]].map(|at| of_element[usize::from(at)]);
                        let at = [0, 1, 2].map(|k| usize::midpoint(a[k], b[k]));
                        of_element[usize::from(*middle)] = at;
                        let [a, b] = [a, b].map(|end| (self.map)(place(end)));
                        let straight = [0, 1, 2].map(|k| 0.5 * (a[k] + b[k]));
                        let point = if self.edges == Edges::Curved { (self.map)(place(at)) } else { straight };
                        nodes.insert(number(at), (place(at), point));
                    }
                }
                elements.push(of_element.into_iter().map(number).collect());
            }
        }
        Meshed { nodes, elements, type_name: self.type_name }
    }
}

impl Meshed {
    /// The nodes whose places in the unit cube are such.
    pub(crate) fn nodes_where(&self, is_such: impl Fn(Point) -> bool) -> Vec<usize> {
        self.nodes.iter().filter(|(_, (place, _))| is_such(*place)).map(|(number, _)| *number).collect()
    }

    /// *NODE, *ELEMENT and the section, with the material `SOLID`.
    pub(crate) fn deck(&self, material: &str) -> String {
        let mut text = "*NODE\n".to_owned();
        for (number, (_, [x, y, z])) in &self.nodes {
            text += &format!("{number}, {x:?}, {y:?}, {z:?}\n");
        }
        text += &format!("*ELEMENT, TYPE={}, ELSET=ALL\n", self.type_name);
        for (number, nodes) in (1..).zip(&self.elements) {
            let items: Vec<String> = std::iter::once(&number).chain(nodes).map(ToString::to_string).collect();
            for (at, line) in items.chunks(10).enumerate() {
                let is_last = (at + 1) * 10 >= items.len();
                text += &format!("{}{}\n", line.join(", "), if is_last { "" } else { "," });
            }
        }
        text + "*SOLID SECTION, ELSET=ALL, MATERIAL=SOLID\n*MATERIAL, NAME=SOLID\n" + material
    }
}

/// A node set as text.
pub(crate) fn set(name: &str, nodes: &[usize]) -> String {
    let rows: Vec<String> =
        nodes.chunks(8).map(|row| row.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")).collect();
    format!("*NSET, NSET={name}\n{}\n", rows.join("\n"))
}

/// The bodies of a deck.
pub(crate) fn read(deck: &str, terminals: &[&str]) -> Result<Body, Error> {
    read_as(Dialect::Abaqus, deck, terminals)
}

/// The bodies of a deck of a dialect.
pub(crate) fn read_as(dialect: Dialect, deck: &str, terminals: &[&str]) -> Result<Body, Error> {
    let grammar = Grammar::new(dialect, Release::default());
    let deck = scan("body.inp", deck.as_bytes(), &grammar);
    let names: Vec<Name> = terminals.iter().map(|name| Name::new(name)).collect();
    Body::read(&deck, &grammar, &names, &mut KeptRows(&deck)).expect("rows in memory")
}

/// Moves what is inside of the unit cube; faces stay where they are, and edges between nodes of a face in it.
pub(crate) fn distorted([x, y, z]: Point) -> Point {
    let bump = |t: f64| t * (1.0 - t);
    let inside = 10.0 * bump(x) * bump(y) * bump(z);
    let on_sides = 1.2 * bump(z);
    [
        x + 0.3 * inside * (5.0 * y + 2.0 * z).sin(),
        y + 0.3 * inside * (4.0 * z + 3.0 * x).sin(),
        z + 0.1 * on_sides * (6.0 * x + 5.0 * y).sin(),
    ]
}
