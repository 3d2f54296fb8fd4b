//! Quadrature points and weights of faces.
//!
//! Flat faces with straight edges are integrated exactly, to rounding; the area element of warped or curved ones is the square root of a polynomial, and the quadrature error is far
//! below the discretisation error of the mesh (the tests measure it).

use crate::FaceShape;
use std::sync::OnceLock;

/// A place on the face and its weight; the weights sum to the area of the reference face (2, 1/2 or 4).
pub(crate) struct Node {
    pub(crate) place: [f64; 2],
    pub(crate) weight: f64,
}

/// The rule of a shape.
pub(crate) fn rule(shape: FaceShape) -> &'static [Node] {
    static RULES: [OnceLock<Vec<Node>>; 6] = [const { OnceLock::new() }; 6];
    RULES[shape as usize].get_or_init(|| match shape {
        FaceShape::Segment2 => line(2),
        FaceShape::Segment3 => line(8),
        FaceShape::Triangle3 => triangle(&MIDDLES),
        FaceShape::Triangle6 => triangle(&DUNAVANT_8),
        FaceShape::Quadrilateral4 => square(4),
        FaceShape::Quadrilateral8 => square(6),
    })
}

fn line(points: usize) -> Vec<Node> {
    gauss(points).into_iter().map(|(x, weight)| Node { place: [x, 0.0], weight }).collect()
}

fn square(points: usize) -> Vec<Node> {
    let line = gauss(points);
    let mut nodes = Vec::with_capacity(points * points);
    for &(y, weight_y) in &line {
        nodes.extend(line.iter().map(|&(x, weight)| Node { place: [x, y], weight: weight * weight_y }));
    }
    nodes
}

/// Gauss–Legendre points and weights: roots of the polynomial by Newton's iteration from Chebyshev points.
pub(crate) fn gauss(points: usize) -> Vec<(f64, f64)> {
    let n = points as f64;
    (0..points)
        .map(|i| {
            let mut x = -(std::f64::consts::PI * (i as f64 + 0.75) / (n + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..8 {
                let (mut value, mut before) = (x, 1.0);
                for k in 2..=points {
                    let k = k as f64;
                    (value, before) = (((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k, value);
                }
                slope = n * (x * value - before) / (x * x - 1.0);
                x -= value / slope;
            }
            (x, 2.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}

/// A weight (they sum to 1) and the barycentric coordinates of one of the points that it belongs to: all their permutations are points.
type Orbit = (f64, [f64; 3]);

/// The middles of the edges: exact to the second degree.
const MIDDLES: [Orbit; 1] = [(1.0 / 3.0, [0.0, 0.5, 0.5])];

/// Exact to the eighth degree, with 16 points, all inside and all weights positive (D. A. Dunavant, High degree efficient symmetrical Gaussian quadrature rules
/// for the triangle, Int. J. Numer. Methods Eng. 21, 1985).
const DUNAVANT_8: [Orbit; 5] = [
    (0.144_315_607_677_787, [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0]),
    (0.095_091_634_267_285, [0.081_414_823_414_554, 0.459_292_588_292_723, 0.459_292_588_292_723]),
    (0.103_217_370_534_718, [0.658_861_384_496_480, 0.170_569_307_751_760, 0.170_569_307_751_760]),
    (0.032_458_497_623_198, [0.898_905_543_365_938, 0.050_547_228_317_031, 0.050_547_228_317_031]),
    (0.027_230_314_174_435, [0.008_394_777_409_958, 0.263_112_829_634_638, 0.728_492_392_955_404]),
];

fn triangle(orbits: &[Orbit]) -> Vec<Node> {
    let mut nodes: Vec<Node> = Vec::new();
    for &(weight, [a, b, c]) in orbits {
        let mut places: Vec<[f64; 2]> = Vec::new();
        for place in [[a, b], [b, c], [c, a], [b, a], [c, b], [a, c]] {
            if !places.contains(&place) {
                places.push(place);
            }
        }
        nodes.extend(places.into_iter().map(|place| Node { place, weight: 0.5 * weight }));
    }
    nodes
}

#[cfg(test)]
mod tests {
    use super::rule;
    use crate::FaceShape;

    fn integral(shape: FaceShape, [i, j]: [i32; 2]) -> f64 {
        rule(shape).iter().map(|node| node.weight * node.place[0].powi(i) * node.place[1].powi(j)).sum()
    }

    #[test]
    fn powers_are_integrated_exactly_to_the_degree_that_areas_need() {
        let line = |i: i32| if i % 2 == 0 { 2.0 / f64::from(i + 1) } else { 0.0 };
        let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
        let triangle = |i: i32, j: i32| factorial(i) * factorial(j) / factorial(i + j + 2);
        let close = |found: f64, expected: f64, what: &str| {
            assert!((found - expected).abs() <= 2e-15, "{what}: {found} for {expected}");
        };
        for (shape, degree) in [(FaceShape::Segment2, 3), (FaceShape::Segment3, 15)] {
            (0..=degree).for_each(|i| close(integral(shape, [i, 0]), line(i), "line"));
        }
        for (shape, degree) in [(FaceShape::Triangle3, 2), (FaceShape::Triangle6, 8)] {
            for i in 0..=degree {
                (0..=degree - i).for_each(|j| close(integral(shape, [i, j]), triangle(i, j), "triangle"));
            }
        }
        for (shape, degree) in [(FaceShape::Quadrilateral4, 7), (FaceShape::Quadrilateral8, 11)] {
            for i in 0..=degree {
                (0..=degree).for_each(|j| close(integral(shape, [i, j]), line(i) * line(j), "square"));
            }
        }
    }
}
