//! The closest point of a face: never farther than any other point of it.

mod common;

use common::{close, norm, sub};
use inpact_geometry::{FaceShape, Patch, Point};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

const SHAPES: [FaceShape; 6] = [
    FaceShape::Segment2,
    FaceShape::Segment3,
    FaceShape::Triangle3,
    FaceShape::Triangle6,
    FaceShape::Quadrilateral4,
    FaceShape::Quadrilateral8,
];

/// The face of this shape on its own reference face, in the plane z = 0.
fn reference(shape: FaceShape) -> Vec<Point> {
    let corners: Vec<Point> = shape.corner_places().iter().map(|[x, y]| [*x, *y, 0.0]).collect();
    let mut nodes = corners.clone();
    for edge in 0..shape.nodes() - shape.corners() {
        let (a, b) = (corners[edge], corners[(edge + 1) % corners.len()]);
        nodes.push([0, 1, 2].map(|k| 0.5 * (a[k] + b[k])));
    }
    nodes
}

/// Places all over the reference face, its edges and corners too.
fn places(shape: FaceShape, n: usize) -> Vec<[f64; 2]> {
    let at = |i: usize| i as f64 / n as f64;
    let mut places = Vec::new();
    for i in 0..=n {
        for j in 0..=n {
            match shape.corners() {
                2 if j == 0 => places.push([2.0 * at(i) - 1.0, 0.0]),
                3 if i + j <= n => places.push([at(i), at(j)]),
                4 => places.push([2.0 * at(i) - 1.0, 2.0 * at(j) - 1.0]),
                _ => {}
            }
        }
    }
    places
}

fn on_the_face(shape: FaceShape, [x, y]: [f64; 2]) -> bool {
    match shape.corners() {
        2 => (-1.0..=1.0).contains(&x) && y == 0.0,
        3 => 0.0 <= x && 0.0 <= y && x + y <= 1.0 + 1e-15,
        _ => (-1.0..=1.0).contains(&x) && (-1.0..=1.0).contains(&y),
    }
}

/// The closest point is on the face, as far as it says, and no sampled point is nearer.
fn judge(shape: FaceShape, nodes: &[Point], point: Point) -> Result<(), TestCaseError> {
    let patch = Patch::new(shape, nodes);
    let closest = patch.closest(point);
    prop_assert!(on_the_face(shape, closest.place), "{closest:?}");
    let size = nodes.iter().map(|node| norm(sub(*node, point))).fold(0.0, f64::max);
    prop_assert!(norm(sub(closest.point, patch.point(closest.place))) <= 1e-14 * size);
    prop_assert!((norm(sub(closest.point, point)) - closest.distance).abs() <= 1e-14 * size);
    for place in places(shape, 40) {
        let distance = norm(sub(patch.point(place), point));
        prop_assert!(
            closest.distance <= distance + 1e-13 * size,
            "{place:?} is at {distance}, nearer than {closest:?}"
        );
    }
    Ok(())
}

fn distorted(shape: FaceShape, by: f64) -> impl Strategy<Value = Vec<Point>> {
    prop::collection::vec(prop::array::uniform3(-by..by), shape.nodes()).prop_map(move |shifts| {
        let mut nodes = reference(shape);
        for (node, shift) in nodes.iter_mut().zip(shifts) {
            (0..if shape.is_line() { 2 } else { 3 }).for_each(|k| node[k] += shift[k]);
        }
        nodes
    })
}

fn any_face(by: f64) -> impl Strategy<Value = (FaceShape, Vec<Point>)> {
    prop::sample::select(SHAPES.to_vec())
        .prop_flat_map(move |shape| distorted(shape, by).prop_map(move |nodes| (shape, nodes)))
}

proptest! {
    // The same cases in every run.
    #![proptest_config(ProptestConfig { cases: 256, rng_seed: RngSeed::Fixed(12), ..ProptestConfig::default() })]

    #[test]
    fn no_point_of_a_distorted_face_is_nearer((shape, nodes) in any_face(0.3), point in prop::array::uniform3(-3.0_f64..3.0)) {
        judge(shape, &nodes, point)?;
    }

    /// Faces that no mesh should have: folded, twisted, turned over.
    #[test]
    fn no_point_of_a_wild_face_is_nearer((shape, nodes) in any_face(1.5), point in prop::array::uniform3(-3.0_f64..3.0)) {
        judge(shape, &nodes, point)?;
    }

    /// Faces whose nodes coincide.
    #[test]
    fn no_point_of_a_collapsed_face_is_nearer((shape, mut nodes) in any_face(0.3), point in prop::array::uniform3(-3.0_f64..3.0), (a, b) in (0_usize..8, 0_usize..8)) {
        let n = nodes.len();
        nodes[a % n] = nodes[b % n];
        judge(shape, &nodes, point)?;
    }

    /// A point of the face is its own closest point.
    #[test]
    fn points_of_the_face_are_found((shape, nodes) in any_face(0.1), (u, v) in (0.0_f64..1.0, 0.0_f64..1.0)) {
        let place = match shape.corners() {
            2 => [2.0 * u - 1.0, 0.0],
            3 => [u * (1.0 - v), v],
            _ => [2.0 * u - 1.0, 2.0 * v - 1.0],
        };
        let patch = Patch::new(shape, &nodes);
        let closest = patch.closest(patch.point(place));
        prop_assert!(closest.distance <= 1e-14, "{closest:?}");
        prop_assert!((closest.place[0] - place[0]).abs() + (closest.place[1] - place[1]).abs() <= 1e-12, "{closest:?} for {place:?}");
        let sum: f64 = shape.weights(closest.place).iter().sum();
        prop_assert!((sum - 1.0).abs() <= 4.0 * f64::EPSILON, "{sum}");
    }
}

#[test]
fn weights_are_one_at_their_own_node_and_none_at_the_others() {
    for shape in SHAPES {
        for (local, node) in reference(shape).iter().enumerate() {
            let weights = shape.weights([node[0], node[1]]);
            (0..shape.nodes()).for_each(|other| {
                assert_eq!(weights[other], f64::from(u8::from(other == local)), "{shape:?} {local} {other}");
            });
        }
    }
}

/// The closest point of the hyperbolic paraboloid z = xy to (0, 0, z) is its middle for |z| ≤ 1; above, there are two closest points off it.
#[test]
fn a_saddle_has_one_closest_point_below_its_radius_of_curvature_and_two_above() {
    let nodes = [[-1.0, -1.0, 1.0], [1.0, -1.0, -1.0], [1.0, 1.0, 1.0], [-1.0, 1.0, -1.0]];
    let saddle = Patch::new(FaceShape::Quadrilateral4, &nodes);
    let below = saddle.closest([0.0, 0.0, 0.75]);
    close(below.distance, 0.75, 1e-15);
    below.place.iter().for_each(|x| close(*x, 0.0, 1e-14));
    // With x = y = s the squared distance is 2 s² + (s² − z)², least at s² = z − 1.
    let above = saddle.closest([0.0, 0.0, 1.25]);
    close(above.distance, (2.0_f64 * 0.25 + 1.0).sqrt(), 1e-15);
    close(above.place[0].abs(), 0.5, 1e-12);
    close(above.place[0], above.place[1], 1e-12);
}

/// A parabola y = 1 − x² seen from (0, −1): its ends are nearer than its middle.
#[test]
fn the_ends_of_a_bow_may_be_nearer_than_its_middle() {
    let nodes = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let bow = Patch::new(FaceShape::Segment3, &nodes);
    close(bow.closest([0.0, -1.0, 0.0]).distance, 2.0_f64.sqrt(), 1e-15);
    close(bow.closest([0.0, 3.0, 0.0]).distance, 2.0, 1e-15);
    close(bow.closest([0.0, 3.0, 0.0]).place[0], 0.0, 1e-15);
}

#[test]
fn beside_and_beyond_a_square() {
    let nodes = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]];
    let square = Patch::new(FaceShape::Quadrilateral4, &nodes);
    for (point, expected) in [
        ([0.5, 1.5, 7.0], [0.5, 1.5, 0.0]),
        ([-4.0, 1.0, 0.0], [0.0, 1.0, 0.0]),
        ([5.0, 5.0, 5.0], [2.0, 2.0, 0.0]),
        ([1.25, -3.0, 1.0], [1.25, 0.0, 0.0]),
    ] {
        assert_eq!(square.closest(point).point, expected);
    }
}
