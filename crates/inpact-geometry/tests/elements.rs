//! Faces of elements against the lists of the Elements Guide, and against the elements' own geometry.

mod common;

use common::{dot, sub};
use inpact_geometry::{ElementShape, ElementSpace, ElementType, FaceLabel, Patch, Point};

/// The corners of an element of this shape, right-handed, in the order of Abaqus.
fn corners(shape: ElementShape) -> Vec<Point> {
    let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let raised = |points: &[Point]| points.iter().map(|p| [p[0], p[1], 1.0]).collect::<Vec<_>>();
    match shape {
        ElementShape::Tetrahedron4 | ElementShape::Tetrahedron10 => [&triangle[..], &[[0.0, 0.0, 1.0]]].concat(),
        ElementShape::Wedge6 | ElementShape::Wedge15 => [&triangle[..], &raised(&triangle)].concat(),
        ElementShape::Hexahedron8 | ElementShape::Hexahedron20 => [&square[..], &raised(&square)].concat(),
        ElementShape::Triangle3 | ElementShape::Triangle6 | ElementShape::Shell3 | ElementShape::Shell6 => {
            triangle.to_vec()
        }
        ElementShape::Quadrilateral4 | ElementShape::Quadrilateral8 | ElementShape::Shell4 | ElementShape::Shell8 => {
            square.to_vec()
        }
        ElementShape::Line2 | ElementShape::Line3 => vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]],
    }
}

/// The edges whose middles are nodes, from 1, in the order of the nodes that follow the corners.
fn edges(shape: ElementShape) -> &'static [[usize; 2]] {
    match shape {
        ElementShape::Tetrahedron10 => &[[1, 2], [2, 3], [3, 1], [1, 4], [2, 4], [3, 4]],
        ElementShape::Wedge15 => &[[1, 2], [2, 3], [3, 1], [4, 5], [5, 6], [6, 4], [1, 4], [2, 5], [3, 6]],
        ElementShape::Hexahedron20 => {
            &[[1, 2], [2, 3], [3, 4], [4, 1], [5, 6], [6, 7], [7, 8], [8, 5], [1, 5], [2, 6], [3, 7], [4, 8]]
        }
        ElementShape::Triangle6 | ElementShape::Shell6 => &[[1, 2], [2, 3], [3, 1]],
        ElementShape::Quadrilateral8 | ElementShape::Shell8 => &[[1, 2], [2, 3], [3, 4], [4, 1]],
        _ => &[],
    }
}

fn nodes(shape: ElementShape) -> Vec<Point> {
    if shape == ElementShape::Line3 {
        return vec![[0.0, 0.0, 0.0], [0.5, 0.0, 0.0], [1.0, 0.0, 0.0]];
    }
    let mut nodes = corners(shape);
    for [a, b] in edges(shape) {
        let (a, b) = (nodes[a - 1], nodes[b - 1]);
        nodes.push([0, 1, 2].map(|k| 0.5 * (a[k] + b[k])));
    }
    nodes
}

const SHAPES: [ElementShape; 16] = [
    ElementShape::Tetrahedron4,
    ElementShape::Tetrahedron10,
    ElementShape::Wedge6,
    ElementShape::Wedge15,
    ElementShape::Hexahedron8,
    ElementShape::Hexahedron20,
    ElementShape::Triangle3,
    ElementShape::Triangle6,
    ElementShape::Quadrilateral4,
    ElementShape::Quadrilateral8,
    ElementShape::Shell3,
    ElementShape::Shell6,
    ElementShape::Shell4,
    ElementShape::Shell8,
    ElementShape::Line2,
    ElementShape::Line3,
];

#[test]
fn middles_lie_between_the_corners_of_their_face() {
    for shape in SHAPES {
        let nodes = nodes(shape);
        assert_eq!(nodes.len(), shape.nodes(), "{shape:?}");
        for face in shape.faces() {
            assert_eq!(face.nodes.len(), face.shape.nodes(), "{shape:?} {}", face.label);
            let n = face.shape.corners();
            let of = |local: usize| nodes[usize::from(face.nodes[local])];
            for middle in n..face.nodes.len() {
                let (a, b) = (of(middle - n), of((middle - n + 1) % n));
                assert_eq!(
                    of(middle),
                    [0, 1, 2].map(|k| 0.5 * (a[k] + b[k])),
                    "{shape:?} {} node {middle}",
                    face.label
                );
            }
        }
    }
}

#[test]
fn normals_point_out_of_the_element_or_to_the_side_of_a_sheet() {
    for shape in SHAPES {
        let nodes = nodes(shape);
        let centre = [0, 1, 2].map(|k| nodes.iter().map(|node| node[k]).sum::<f64>() / nodes.len() as f64);
        for face in shape.faces() {
            let points: Vec<Point> = face.nodes.iter().map(|local| nodes[usize::from(*local)]).collect();
            let patch = Patch::new(face.shape, &points);
            let middle = face.shape.middle();
            let normal = patch.normal(middle).expect("an area");
            match face.label {
                FaceLabel::Numbered(_) => {
                    assert!(0.0 < dot(normal, sub(patch.point(middle), centre)), "{shape:?} {}", face.label);
                }
                // Counter-clockwise from above is towards z; of a line along x, to the left is towards y.
                FaceLabel::Positive => {
                    assert_eq!(normal, if face.shape.is_line() { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] });
                }
                FaceLabel::Negative => {
                    assert_eq!(normal, if face.shape.is_line() { [0.0, -1.0, 0.0] } else { [0.0, 0.0, -1.0] });
                }
            }
        }
    }
}

/// Corners of each face as the Elements Guide lists them; where they begin and which way round they go is left aside.
#[test]
fn faces_have_the_corners_of_the_elements_guide() {
    let lists: [(ElementShape, &[&str]); 5] = [
        (ElementShape::Tetrahedron10, &["123", "142", "243", "341"]),
        (ElementShape::Wedge15, &["123", "465", "1452", "2563", "3641"]),
        (ElementShape::Hexahedron20, &["1234", "5876", "1562", "2673", "3784", "4851"]),
        (ElementShape::Triangle6, &["12", "23", "31"]),
        (ElementShape::Quadrilateral8, &["12", "23", "34", "41"]),
    ];
    for (shape, faces) in lists {
        for (number, corners) in (1..).zip(faces) {
            let face = shape.face(FaceLabel::Numbered(number)).expect("a face");
            let mut expected: Vec<u8> = corners.bytes().map(|digit| digit - b'1').collect();
            let mut found = face.nodes[..face.shape.corners()].to_vec();
            expected.sort_unstable();
            found.sort_unstable();
            assert_eq!(found, expected, "{shape:?} S{number}");
        }
        assert_eq!(shape.faces().len(), faces.len());
    }
}

#[test]
fn first_order_faces_are_the_corners_of_second_order_ones() {
    let pairs = [
        (ElementShape::Tetrahedron4, ElementShape::Tetrahedron10),
        (ElementShape::Wedge6, ElementShape::Wedge15),
        (ElementShape::Hexahedron8, ElementShape::Hexahedron20),
        (ElementShape::Triangle3, ElementShape::Triangle6),
        (ElementShape::Quadrilateral4, ElementShape::Quadrilateral8),
        (ElementShape::Shell3, ElementShape::Shell6),
        (ElementShape::Shell4, ElementShape::Shell8),
    ];
    for (first, second) in pairs {
        for (a, b) in first.faces().iter().zip(second.faces()) {
            assert_eq!((a.label, a.nodes), (b.label, &b.nodes[..a.nodes.len()]), "{first:?}");
        }
    }
}

#[test]
fn names_of_types() {
    use ElementSpace::{Axisymmetric, Planar, Plane, Spatial};
    let known = [
        ("C3D4 C3D4H C3D4T C3D4E C3D4P", ElementShape::Tetrahedron4, Spatial),
        ("C3D6 C3D6T DC3D6 DC3D6E Q3D6", ElementShape::Wedge6, Spatial),
        ("C3D8 c3d8r C3D8IH C3D8RPHT DC3D8 DC3D8E DCC3D8D Q3D8RH", ElementShape::Hexahedron8, Spatial),
        ("C3D10 C3D10M C3D10MHT C3D10HS DC3D10", ElementShape::Tetrahedron10, Spatial),
        ("C3D15 C3D15H DC3D15E", ElementShape::Wedge15, Spatial),
        ("C3D20 C3D20RHT C3D20RP DC3D20E Q3D20RH", ElementShape::Hexahedron20, Spatial),
        ("CPE3 CPS3T DC2D3E", ElementShape::Triangle3, Plane),
        ("CPE4 CPS4R CPEG4RHT CPE4I DC2D4 DCC2D4D", ElementShape::Quadrilateral4, Plane),
        ("CPE6MH CPS6 DC2D6", ElementShape::Triangle6, Plane),
        ("CPE8RP CPEG8T DC2D8E", ElementShape::Quadrilateral8, Plane),
        ("CAX3 DCAX3E", ElementShape::Triangle3, Axisymmetric),
        ("CAX4RH CGAX4T DCAX4 DCCAX4D", ElementShape::Quadrilateral4, Axisymmetric),
        ("CAX8RHT DCAX8E", ElementShape::Quadrilateral8, Axisymmetric),
        ("S3 S3RS STRI3 DS3 M3D3 R3D3", ElementShape::Shell3, Spatial),
        ("S4 S4R5 S4RSW S4T DS4 M3D4R R3D4 SFM3D4R", ElementShape::Shell4, Spatial),
        ("STRI65 DS6 S6", ElementShape::Shell6, Spatial),
        ("S8R S8R5 S8RT DS8 S8", ElementShape::Shell8, Spatial),
        ("SAX1 DSAX1 RAX2", ElementShape::Line2, Axisymmetric),
        ("SAX2 SAX2T DSAX2", ElementShape::Line3, Axisymmetric),
        ("R2D2", ElementShape::Line2, Planar),
    ];
    for (names, shape, space) in known {
        for name in names.split(' ') {
            assert_eq!(ElementType::named(name), Some(ElementType { shape, space }), "{name}");
        }
    }
    for name in "AC3D8 C3D5 C3D27 C3D15V C3D 8 SC8R COH3D8 GK3D8 DCCAX2 B31 T3D2 S9R5 CAXA4R1 EC3D8R PC3D U1 C3D8X DC1D2 SPRINGA".split(' ') {
        assert_eq!(ElementType::named(name), None, "{name}");
    }
}

#[test]
fn labels_of_faces() {
    for text in ["S1", "S2", "S3", "S4", "S5", "S6", "SPOS", "SNEG"] {
        assert_eq!(text.parse::<FaceLabel>().expect("a label").to_string(), text);
        assert_eq!(text.to_lowercase().parse::<FaceLabel>().expect("a label").to_string(), text);
    }
    for text in ["", "S", "S0", "S7", "S11", "1", "E1", "SPO", "END1"] {
        assert_eq!(
            text.parse::<FaceLabel>().expect_err(text).to_string(),
            "expected a face: `S1` to `S6`, `SPOS` or `SNEG`"
        );
    }
}
