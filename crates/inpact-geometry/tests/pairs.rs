//! Pairs of surfaces whose clearances are known, and what must not change them.

mod common;

use common::{AREAS, Mesh, close, dot, grid, line, moved, norm, sub};
use inpact_geometry::{
    DEFAULT_EXTENSION, ErrorKind, Extent, Face, FaceLabel, FaceShape, Master, NodeId, Placed, Point, Projection,
    Shares, Surface, node_areas, node_normals, node_shifts, sheet_shift,
};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

fn project(master: &Mesh, point: Point) -> Projection {
    Master::new(master.placed()).project(point, DEFAULT_EXTENSION).expect("a face")
}

/// The field f = x of the master at the closest point, by the weights.
fn interpolated(master: &Mesh, found: &Projection, k: usize) -> f64 {
    let face = master.surface.face(found.face);
    found.weights(face.shape).iter().zip(face.nodes).map(|(weight, node)| weight * master.points[node.index()][k]).sum()
}

#[test]
fn a_plane_by_every_shape() {
    for shape in AREAS {
        let master = grid(shape, [4, 3], |u, v| [4.0 * u, 3.0 * v, 2.0]);
        for (point, clearance) in
            [([1.3, 0.7, 2.5], 0.5), ([1.0, 2.0, 1.0], -1.0), ([2.0, 1.0, 2.0], 0.0), ([0.0, 0.0, 3.0], 1.0)]
        {
            let found = project(&master, point);
            close(found.clearance, clearance, 1e-15);
            assert!(found.projects);
            assert!(norm(sub(found.normal, [0.0, 0.0, 1.0])) <= 2e-16, "{shape:?} {point:?}: {found:?}");
            (0..2).for_each(|k| close(interpolated(&master, &found, k), point[k], 4e-15));
        }
    }
}

/// A point before the flat sides that approach a circle, between two of them and before the middle of one.
#[test]
fn a_cylinder_in_a_cylinder() {
    let (inner, outer, n) = (1.0, 1.5, 24);
    // Normals of the hollow point inwards.
    let hollow = |shape: FaceShape| {
        grid(shape, [n, 2], |u, v| [outer * (2.0 * PI * u).cos(), -outer * (2.0 * PI * u).sin(), 2.0 * v])
    };
    let master = hollow(FaceShape::Quadrilateral4);
    let side = outer * (PI / n as f64).cos();
    for i in 0..4 * n {
        let turn = PI * i as f64 / (2 * n) as f64;
        let point = [inner * turn.cos(), inner * turn.sin(), 1.1];
        let found = project(&master, point);
        // To the side that it faces: r cos of the angle to its middle.
        let angle = (turn.rem_euclid(2.0 * PI / n as f64) - PI / n as f64).abs();
        close(found.clearance, side - inner * angle.cos(), 1e-14);
        assert!(found.projects);
        assert!(dot(found.normal, point) < 0.0);
    }
    // Sides of second order are far closer to the circle.
    let curved = hollow(FaceShape::Quadrilateral8);
    for i in 0..60 {
        let turn = 0.1 + 0.1 * f64::from(i);
        let found = project(&curved, [inner * turn.cos(), inner * turn.sin(), 0.7]);
        close(found.clearance, outer - inner, 2e-5);
    }
}

/// Slave nodes of a sphere above a plane, and inside of it.
#[test]
fn a_sphere_on_a_plane() {
    let plane = grid(FaceShape::Triangle3, [5, 5], |u, v| [10.0 * u - 5.0, 10.0 * v - 5.0, 0.0]);
    let sphere = grid(FaceShape::Quadrilateral4, [8, 6], |u, v| {
        let (azimuth, polar) = (2.0 * PI * u, FRAC_PI_2 * (0.1 + 0.9 * v));
        [polar.sin() * azimuth.cos(), polar.sin() * azimuth.sin(), 0.875 - polar.cos()]
    });
    let master = Master::new(plane.placed());
    let points: Vec<Point> = sphere.surface.nodes().iter().map(|node| sphere.points[node.index()]).collect();
    for (point, found) in points.iter().zip(master.project_all(&points, DEFAULT_EXTENSION)) {
        let found = found.expect("a face");
        close(found.clearance, point[2], 1e-14);
        assert!(found.projects);
    }
}

/// From above a ridge the clearance is the distance to it; the side follows from both faces, not by the one that was found first.
#[test]
fn the_ridge_and_the_corner_of_a_block() {
    // The three outer faces of a unit cube's corner at the origin, normals pointing away from the cube in x, y, z < 0.
    let nodes = |list: [u32; 4]| list.map(NodeId);
    let faces = [nodes([0, 1, 3, 2]), nodes([0, 4, 5, 1]), nodes([0, 2, 6, 4])];
    let points = [
        [0.0, 0.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0],
        [-1.0, -1.0, 0.0],
        [0.0, 0.0, -1.0],
        [-1.0, 0.0, -1.0],
        [0.0, -1.0, -1.0],
    ];
    let surface =
        Surface::new(faces.iter().map(|nodes| Face { shape: FaceShape::Quadrilateral4, nodes })).expect("a surface");
    let master = Master::new(Placed::new(&surface, &points).expect("points"));
    for (point, clearance) in [
        ([3.0, 4.0, -0.5], 5.0),
        ([2.0, 3.0, 6.0], 7.0),
        ([-0.25, -0.5, 0.5], 0.5),
        // Inside the block, the nearest face decides.
        ([-0.25, -0.5, -0.5], -0.25),
        ([0.0, 0.0, -0.5], 0.0),
        ([0.0, 0.0, 0.0], 0.0),
    ] {
        let found = master.project(point, DEFAULT_EXTENSION).expect("a face");
        close(found.clearance, clearance, 1e-15);
        assert_eq!((found.projects, found.overhang), (true, 0.0), "{point:?}");
        close(norm(found.normal), 1.0, 1e-15);
        let back = [0, 1, 2].map(|k| found.point[k] + found.clearance * found.normal[k]);
        assert!(norm(sub(back, point)) <= 1e-14, "{point:?}: {found:?}");
    }
}

#[test]
fn beyond_the_outer_edge_the_extension_decides() {
    let master = grid(FaceShape::Quadrilateral4, [2, 2], |u, v| [4.0 * u, 4.0 * v, 0.0]);
    let tree = Master::new(master.placed());
    for (point, clearance, overhang) in [
        ([4.1, 1.0, 0.5], 0.5, 0.1),
        ([4.3, 1.0, -0.5], -0.5, 0.3),
        ([-0.3, -0.4, 1.0], 1.0, 0.5),
        ([4.0, 4.0, 0.25], 0.25, 0.0),
    ] {
        let found = tree.project(point, DEFAULT_EXTENSION).expect("a face");
        close(found.clearance, clearance, 1e-15);
        close(found.overhang, overhang, 1e-15);
        // Edges are of length 2.
        assert_eq!(found.projects, overhang <= 0.2, "{point:?}");
        assert!(tree.project(point, 1.0).expect("a face").projects);
    }
}

#[test]
fn lines_have_clearances_too() {
    let master = line(FaceShape::Segment2, 4, |u| [4.0 - 4.0 * u, 0.0, 0.0]);
    let found = project(&master, [1.25, 0.5, 0.0]);
    close(found.clearance, 0.5, 1e-15);
    assert_eq!(found.normal, [0.0, 1.0, 0.0]);
    // Over a kink the distance to its point, on the side that both segments agree on.
    let kinked = line(FaceShape::Segment2, 2, |u| [4.0 - 4.0 * u, -(4.0 * u - 2.0).abs(), 0.0]);
    let found = project(&kinked, [2.0, 3.0, 0.0]);
    close(found.clearance, 3.0, 1e-15);
    assert!(found.projects);
    let end = project(&kinked, [5.0, -3.0, 0.0]);
    close(end.overhang, 2.0_f64.sqrt(), 1e-15);
    assert!(!end.projects);
    let round = line(FaceShape::Segment3, 8, |u| [2.0 * (PI * u).cos(), 2.0 * (PI * u).sin(), 0.0]);
    close(project(&round, [0.6, 0.8, 0.0]).distance, 1.0, 1e-4);
}

#[test]
fn nothing_is_across_from_nothing() {
    let surface = Surface::new([]).expect("an empty surface");
    let master = Master::new(Placed::new(&surface, &[]).expect("no points"));
    assert_eq!(master.project([0.0; 3], DEFAULT_EXTENSION), None);
    let plane = grid(FaceShape::Quadrilateral4, [1, 1], |u, v| [u, v, 0.0]);
    assert_eq!(Master::new(plane.placed()).project([f64::NAN, 0.0, 0.0], DEFAULT_EXTENSION), None);
}

#[test]
fn sides_of_shells_are_shifted_by_thickness_and_offset() {
    let mesh = grid(FaceShape::Quadrilateral4, [2, 1], |u, v| [2.0 * u, v, 0.0]);
    let shifts = [sheet_shift(FaceLabel::Positive, 0.5, 0.0), sheet_shift(FaceLabel::Positive, 0.25, -0.5)];
    // Three columns of nodes: left, shared, right.
    assert_eq!(node_shifts(&mesh.surface, &shifts).expect("shifts"), [0.25, 0.25, 0.25, 0.25, 0.25, 0.25]);
    let shifts = node_shifts(&mesh.surface, &[0.125, 0.375]).expect("shifts");
    assert_eq!(shifts, [0.125, 0.25, 0.375, 0.125, 0.25, 0.375]);
    assert_eq!(
        node_shifts(&mesh.surface, &[0.1]),
        Err(ErrorKind::Values { what: "shift", expected: 2, found: 1 }.into())
    );
}

/// Two surfaces of whatever shapes, bent and distorted.
fn pair(shape: FaceShape, shifts: &[[f64; 3]]) -> (Mesh, Mesh) {
    let mut shifts = shifts.iter().cycle();
    let mut shaken = |mut mesh: Mesh| {
        for point in &mut mesh.points {
            let shift = shifts.next().expect("a cycle");
            (0..3).for_each(|k| point[k] += shift[k]);
        }
        mesh
    };
    let master = shaken(grid(shape, [4, 3], |u, v| [4.0 * u, 3.0 * v, 0.3 * (3.0 * u).sin()]));
    let slave = shaken(grid(FaceShape::Quadrilateral4, [3, 3], |u, v| {
        [4.5 * u - 0.25, 0.25 + 2.5 * (1.0 - v), 0.3 * (3.0 * u).sin() + 0.1]
    }));
    (master, slave)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// The tree finds what looking at every face finds; weights sum to 1 and give the closest point back.
    #[test]
    fn the_tree_finds_the_nearest_face(
        shape in prop::sample::select(AREAS.to_vec()),
        shifts in prop::collection::vec(prop::array::uniform3(-0.1_f64..0.1), 97),
        point in (-1.0_f64..5.0, -1.0_f64..4.0, -1.0_f64..1.0),
    ) {
        let (master, _) = pair(shape, &shifts);
        let point = [point.0, point.1, point.2];
        let found = project(&master, point);
        let placed = master.placed();
        let nearest = master.surface.faces().map(|face| placed.patch(face).closest(point).distance).fold(f64::INFINITY, f64::min);
        prop_assert!((found.distance - nearest).abs() <= 1e-14 * (1.0 + nearest));
        prop_assert!(found.clearance.abs() <= found.distance * (1.0 + 1e-14));
        let weights = found.weights(master.surface.face(found.face).shape);
        prop_assert!((weights.iter().sum::<f64>() - 1.0).abs() <= 4.0 * f64::EPSILON);
        (0..3).for_each(|k| close(interpolated(&master, &found, k), found.point[k], 1e-14));
    }

    /// Turning and shifting both surfaces together changes areas and clearances by rounding alone.
    #[test]
    fn rigid_motions_change_nothing(
        shape in prop::sample::select(AREAS.to_vec()),
        shifts in prop::collection::vec(prop::array::uniform3(-0.1_f64..0.1), 97),
        axis in prop::array::uniform3(0.1_f64..1.0),
        angle in -3.0_f64..3.0,
        shift in prop::array::uniform3(-10.0_f64..10.0),
    ) {
        let (master, slave) = pair(shape, &shifts);
        let turned = |mesh: &Mesh| Mesh { surface: mesh.surface.clone(), points: mesh.points.iter().map(|p| moved(*p, axis, angle, shift)).collect() };
        let (master_2, slave_2) = (turned(&master), turned(&slave));
        for shares in [Shares::Equal, Shares::ShapeFunctions] {
            for (first, second) in [(&master, &master_2), (&slave, &slave_2)] {
                let areas = |mesh: &Mesh| node_areas(&mesh.placed(), shares, Extent::Spatial).expect("areas");
                areas(first).iter().zip(areas(second)).for_each(|(a, b)| close(*a, b, 1e-13));
            }
        }
        for (normal, turned) in node_normals(&slave.placed()).into_iter().zip(node_normals(&slave_2.placed())) {
            let expected = moved(normal.expect("a normal"), axis, angle, [0.0; 3]);
            prop_assert!(norm(sub(expected, turned.expect("a normal"))) <= 1e-13);
        }
        let (tree, tree_2) = (Master::new(master.placed()), Master::new(master_2.placed()));
        for node in slave.surface.nodes() {
            let found = tree.project(slave.points[node.index()], DEFAULT_EXTENSION).expect("a face");
            let again = tree_2.project(slave_2.points[node.index()], DEFAULT_EXTENSION).expect("a face");
            close(found.distance, again.distance, 1e-13);
            // At equal distance from two places either may be found; its side is then not certain.
            if norm(sub(moved(found.point, axis, angle, shift), again.point)) <= 1e-6 {
                close(found.clearance, again.clearance, 1e-12);
            }
        }
    }
}
