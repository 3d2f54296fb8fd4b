//! Meshes for the tests, and what is needed to compare.
#![allow(dead_code, reason = "each test uses some of it")]

use inpact_geometry::{Face, FaceShape, NodeId, Placed, Point, Surface, Vector};

/// A surface with its points.
pub(crate) struct Mesh {
    pub(crate) surface: Surface,
    pub(crate) points: Vec<Point>,
}

impl Mesh {
    pub(crate) fn placed(&self) -> Placed<'_> {
        Placed::new(&self.surface, &self.points).expect("finite points")
    }
}

/// A rectangular grid of faces of one shape over 0 ≤ u ≤ 1, 0 ≤ v ≤ 1, at `at(u, v)`; the normal is that of increasing u, then v.
pub(crate) fn grid(shape: FaceShape, [n, m]: [usize; 2], at: impl Fn(f64, f64) -> Point) -> Mesh {
    // Twice as fine, so that middles of edges are nodes of the grid; those that no face has are left over.
    let node = |i: usize, j: usize| NodeId(u32::try_from(j * (2 * n + 1) + i).expect("small"));
    let mut points = Vec::new();
    for j in 0..=2 * m {
        points.extend((0..=2 * n).map(|i| at(i as f64 / (2 * n) as f64, j as f64 / (2 * m) as f64)));
    }
    let mut faces: Vec<Vec<NodeId>> = Vec::new();
    for j in (0..2 * m).step_by(2) {
        for i in (0..2 * n).step_by(2) {
            let p = |a: usize, b: usize| node(i + a, j + b);
            match shape {
                FaceShape::Quadrilateral4 => faces.push(vec![p(0, 0), p(2, 0), p(2, 2), p(0, 2)]),
                FaceShape::Quadrilateral8 => {
                    faces.push(vec![p(0, 0), p(2, 0), p(2, 2), p(0, 2), p(1, 0), p(2, 1), p(1, 2), p(0, 1)]);
                }
                FaceShape::Triangle3 => {
                    faces.extend([vec![p(0, 0), p(2, 0), p(2, 2)], vec![p(0, 0), p(2, 2), p(0, 2)]]);
                }
                FaceShape::Triangle6 => faces.extend([
                    vec![p(0, 0), p(2, 0), p(2, 2), p(1, 0), p(2, 1), p(1, 1)],
                    vec![p(0, 0), p(2, 2), p(0, 2), p(1, 1), p(1, 2), p(0, 1)],
                ]),
                FaceShape::Segment2 | FaceShape::Segment3 => unreachable!("lines have `line`"),
            }
        }
    }
    let surface = Surface::new(faces.iter().map(|nodes| Face { shape, nodes })).expect("a surface");
    Mesh { surface, points }
}

/// A line of n segments over 0 ≤ u ≤ 1.
pub(crate) fn line(shape: FaceShape, n: usize, at: impl Fn(f64) -> Point) -> Mesh {
    let node = |i: usize| NodeId(u32::try_from(i).expect("small"));
    let points = (0..=2 * n).map(|i| at(i as f64 / (2 * n) as f64)).collect();
    let faces: Vec<Vec<NodeId>> = (0..2 * n)
        .step_by(2)
        .map(|i| {
            if shape == FaceShape::Segment2 {
                vec![node(i), node(i + 2)]
            } else {
                vec![node(i), node(i + 2), node(i + 1)]
            }
        })
        .collect();
    Mesh { surface: Surface::new(faces.iter().map(|nodes| Face { shape, nodes })).expect("a surface"), points }
}

pub(crate) const AREAS: [FaceShape; 4] =
    [FaceShape::Triangle3, FaceShape::Triangle6, FaceShape::Quadrilateral4, FaceShape::Quadrilateral8];

pub(crate) fn sub(a: Point, b: Point) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

pub(crate) fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} for {expected}, {} apart", (found - expected).abs());
}

/// Turned about an axis through the origin (Rodrigues), then shifted.
pub(crate) fn moved(point: Point, axis: Vector, angle: f64, shift: Vector) -> Point {
    let length = norm(axis);
    let [x, y, z] = axis.map(|a| a / length);
    let (sin, cos) = angle.sin_cos();
    let p = point;
    let cross = [y * p[2] - z * p[1], z * p[0] - x * p[2], x * p[1] - y * p[0]];
    let along = (x * p[0] + y * p[1] + z * p[2]) * (1.0 - cos);
    [
        p[0] * cos + cross[0] * sin + x * along + shift[0],
        p[1] * cos + cross[1] * sin + y * along + shift[1],
        p[2] * cos + cross[2] * sin + z * along + shift[2],
    ]
}
