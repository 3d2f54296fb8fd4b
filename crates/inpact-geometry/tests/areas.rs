//! Areas of nodes: exact where the faces are, against finer meshes where they are not.

mod common;

use common::{AREAS, Mesh, close, grid, line};
use inpact_geometry::{
    ErrorKind, Extent, Face, FaceId, FaceShape, NodeId, Placed, Shares, Surface, face_areas, node_areas, node_normals,
};
use proptest::prelude::*;

fn total(mesh: &Mesh, shares: Shares, extent: Extent<'_>) -> f64 {
    node_areas(&mesh.placed(), shares, extent).expect("areas").iter().sum()
}

#[test]
fn a_skewed_plane_has_its_area_by_every_shape() {
    for shape in AREAS {
        let mesh = grid(shape, [3, 2], |u, v| [3.0 * u + v, 2.0 * v, 7.0 + u + v]);
        // |(3, 0, 1) × (1, 2, 1)|
        let exact = (4.0_f64 + 4.0 + 36.0).sqrt();
        for shares in [Shares::Equal, Shares::ShapeFunctions] {
            close(total(&mesh, shares, Extent::Spatial), exact, 1e-13);
        }
    }
}

#[test]
fn shares_of_one_flat_face() {
    let areas = |shape: FaceShape, shares| {
        let mesh = grid(shape, [1, 1], |u, v| [76.0 * u, v, 0.0]);
        node_areas(&mesh.placed(), shares, Extent::Spatial).expect("areas")
    };
    let all = |found: Vec<f64>, expected: &[f64]| {
        assert_eq!(found.len(), expected.len());
        found.iter().zip(expected).for_each(|(a, b)| close(*a, *b, 1e-12));
    };
    all(areas(FaceShape::Quadrilateral4, Shares::Equal), &[19.0; 4]);
    all(areas(FaceShape::Quadrilateral4, Shares::ShapeFunctions), &[19.0; 4]);
    all(areas(FaceShape::Quadrilateral8, Shares::Equal), &[9.5; 8]);
    // Corners 3/76, middles 16/76 of the area: nodes of the grid go by rows.
    all(areas(FaceShape::Quadrilateral8, Shares::ShapeFunctions), &[3.0, 16.0, 3.0, 16.0, 16.0, 3.0, 16.0, 3.0]);
    // 1/19 and 16/57 of each triangle of 38; the diagonal's nodes belong to both.
    let (corner, middle) = (38.0 / 19.0, 38.0 * 16.0 / 57.0);
    all(
        areas(FaceShape::Triangle6, Shares::ShapeFunctions),
        &[2.0 * corner, middle, corner, middle, 2.0 * middle, middle, corner, middle, 2.0 * corner],
    );
}

/// ∫ N dA of a trapezium with the parallel sides 3 and 1, by hand: the two shares differ.
#[test]
fn shape_functions_weigh_a_distorted_face() {
    let nodes = [0, 1, 2, 3].map(NodeId);
    let surface = Surface::new([Face { shape: FaceShape::Quadrilateral4, nodes: &nodes }]).expect("a surface");
    let points = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let placed = Placed::new(&surface, &points).expect("points");
    // x_ξ = (3 + 1)/4 + (1 − 3)/4 η, so that the area element is (2 − η)/4: the lower nodes get ∫ (1 − η)/2 (2 − η)/4 = 7/12, the upper ones 5/12.
    let areas = node_areas(&placed, Shares::ShapeFunctions, Extent::Spatial).expect("areas");
    areas.iter().zip([7.0 / 12.0, 7.0 / 12.0, 5.0 / 12.0, 5.0 / 12.0]).for_each(|(a, b)| close(*a, b, 1e-15));
    let areas = node_areas(&placed, Shares::Equal, Extent::Spatial).expect("areas");
    for area in areas {
        close(area, 0.5, 1e-15);
    }
}

#[test]
fn lines_have_thickness_or_go_round_an_axis() {
    for shape in [FaceShape::Segment2, FaceShape::Segment3] {
        let mesh = line(shape, 2, |u| [1.0 + 3.0 * u, 4.0 * u, 0.0]);
        // 2.5 a segment.
        close(total(&mesh, Shares::Equal, Extent::Plane(&[0.5, 2.0])), 6.25, 1e-14);
        // A cone between the radii 1 and 4 with a side of 5.
        for shares in [Shares::Equal, Shares::ShapeFunctions] {
            close(total(&mesh, shares, Extent::Axisymmetric), std::f64::consts::PI * 25.0, 1e-12);
        }
    }
    // The share of the inner node of a disc of radius 1: ∫ (1 − r) 2πr dr = π/3.
    let disc = line(FaceShape::Segment2, 1, |u| [u, 0.0, 0.0]);
    let areas = node_areas(&disc.placed(), Shares::ShapeFunctions, Extent::Axisymmetric).expect("areas");
    close(areas[0], std::f64::consts::PI / 3.0, 1e-15);
    close(areas[1], std::f64::consts::PI * 2.0 / 3.0, 1e-15);
}

/// A sphere of curved faces: the error falls with the fourth power of the size, so it is the mesh's, not the rule's.
#[test]
fn a_sphere_is_approached_with_the_order_of_its_faces() {
    let octant = |shape: FaceShape, n: usize| {
        let mesh = grid(shape, [n, n], |u, v| {
            // Away from the pole, where faces fold.
            let (azimuth, height) = (u * std::f64::consts::FRAC_PI_2, 0.8 * v);
            let radius = (1.0 - height * height).sqrt();
            [radius * azimuth.cos(), radius * azimuth.sin(), height]
        });
        // Archimedes: the area of a zone is that of the cylinder around it.
        (total(&mesh, Shares::ShapeFunctions, Extent::Spatial) - 0.8 * std::f64::consts::FRAC_PI_2).abs()
    };
    for (shape, order) in [
        (FaceShape::Triangle3, 2.0),
        (FaceShape::Quadrilateral4, 2.0),
        (FaceShape::Triangle6, 4.0),
        (FaceShape::Quadrilateral8, 4.0),
    ] {
        let (coarse, fine) = (octant(shape, 8), octant(shape, 16));
        let found = (coarse / fine).log2();
        assert!((found - order).abs() < 0.25, "{shape:?}: order {found}, errors {coarse} and {fine}");
    }
}

/// The error of the rule on a warped face: halving it in both directions changes nothing that matters.
#[test]
fn the_rule_is_far_finer_than_a_warped_face() {
    for (shape, warp, tolerance) in [
        (FaceShape::Quadrilateral4, 0.3, 1e-7),
        (FaceShape::Quadrilateral8, 0.2, 1e-6),
        (FaceShape::Triangle6, 0.2, 1e-5),
    ] {
        let coarse = grid(shape, [1, 1], |u, v| [u, v, warp * u * v]);
        // The same hyperbolic paraboloid, in many faces.
        let fine = grid(shape, [16, 16], |u, v| [u, v, warp * u * v]);
        let (coarse, fine) = (
            total(&coarse, Shares::ShapeFunctions, Extent::Spatial),
            total(&fine, Shares::ShapeFunctions, Extent::Spatial),
        );
        close(coarse, fine, tolerance * fine);
    }
}

#[test]
fn what_does_not_suit_is_refused_with_its_values() {
    let flat = grid(FaceShape::Quadrilateral4, [1, 1], |u, v| [u - 1.0, v, 0.0]);
    let edge = line(FaceShape::Segment2, 1, |u| [u - 1.0, 0.0, 0.0]);
    let refused =
        |mesh: &Mesh, extent: Extent<'_>| node_areas(&mesh.placed(), Shares::Equal, extent).expect_err("refused");
    assert_eq!(refused(&flat, Extent::Axisymmetric), ErrorKind::Extent.into());
    assert_eq!(refused(&edge, Extent::Spatial), ErrorKind::Extent.into());
    assert_eq!(
        refused(&edge, Extent::Plane(&[])),
        ErrorKind::Values { what: "thickness", expected: 1, found: 0 }.into()
    );
    assert_eq!(
        refused(&edge, Extent::Axisymmetric).to_string(),
        "node 0 of an axisymmetric surface has the radius -1.0, which is negative"
    );
    let nodes = [0, 1, 2].map(NodeId);
    let short = Surface::new([Face { shape: FaceShape::Quadrilateral4, nodes: &nodes }]).expect_err("three of four");
    assert_eq!(short.to_string(), "expected 4 nodes of a face, found 3");
    let mixed =
        [Face { shape: FaceShape::Triangle3, nodes: &nodes }, Face { shape: FaceShape::Segment2, nodes: &nodes[..2] }];
    assert_eq!(Surface::new(mixed).expect_err("mixed"), ErrorKind::MixedDimensions.into());
    let points = [[0.0; 3], [f64::NAN, 0.0, 0.0], [0.0; 3]];
    let surface = Surface::new([Face { shape: FaceShape::Triangle3, nodes: &nodes }]).expect("a surface");
    assert_eq!(
        Placed::new(&surface, &points).expect_err("no number").to_string(),
        "node 1 has the coordinate NaN, whose square is no finite number"
    );
}

#[test]
fn normals_of_a_ridge_and_of_a_fold() {
    // Two squares at a right angle: along the ridge the normal is between theirs, whether or not one is cut into triangles.
    let points =
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, -1.0], [1.0, 1.0, -1.0]];
    let n = |list: &[u32]| list.iter().map(|i| NodeId(*i)).collect::<Vec<_>>();
    let (flat, down) = (n(&[0, 1, 2, 3]), n(&[1, 4, 5, 2]));
    let (first, second) = (n(&[1, 4, 5]), n(&[1, 5, 2]));
    let whole = [
        Face { shape: FaceShape::Quadrilateral4, nodes: &flat },
        Face { shape: FaceShape::Quadrilateral4, nodes: &down },
    ];
    let cut = [
        Face { shape: FaceShape::Quadrilateral4, nodes: &flat },
        Face { shape: FaceShape::Triangle3, nodes: &first },
        Face { shape: FaceShape::Triangle3, nodes: &second },
    ];
    let diagonal = std::f64::consts::FRAC_1_SQRT_2;
    for faces in [&whole[..], &cut[..]] {
        let surface = Surface::new(faces.iter().copied()).expect("a surface");
        let normals = node_normals(&Placed::new(&surface, &points).expect("points"));
        for node in [1, 2] {
            let normal = normals[node].expect("a normal");
            normal.iter().zip([diagonal, 0.0, diagonal]).for_each(|(a, b)| close(*a, b, 1e-15));
        }
    }
    // Both sides of one square cancel.
    let back = n(&[0, 3, 2, 1]);
    let both = [
        Face { shape: FaceShape::Quadrilateral4, nodes: &flat },
        Face { shape: FaceShape::Quadrilateral4, nodes: &back },
    ];
    let surface = Surface::new(both).expect("a surface");
    assert_eq!(node_normals(&Placed::new(&surface, &points).expect("points")), [None; 4]);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Areas add up to the surface, and none is negative, on faces however distorted.
    #[test]
    fn areas_add_up(
        shape in prop::sample::select(AREAS.to_vec()),
        shifts in prop::collection::vec(prop::array::uniform3(-0.2_f64..0.2), 35),
    ) {
        let mut mesh = grid(shape, [3, 2], |u, v| [3.0 * u, 2.0 * v, 0.0]);
        for (point, shift) in mesh.points.iter_mut().zip(&shifts) {
            (0..3).for_each(|k| point[k] += shift[k]);
        }
        let faces: f64 = face_areas(&mesh.placed(), Extent::Spatial).expect("areas").iter().sum();
        for shares in [Shares::Equal, Shares::ShapeFunctions] {
            let areas = node_areas(&mesh.placed(), shares, Extent::Spatial).expect("areas");
            prop_assert!(areas.iter().all(|area| 0.0 <= *area), "{areas:?}");
            prop_assert!((areas.iter().sum::<f64>() - faces).abs() <= 1e-14 * faces);
        }
    }

    /// Lines likewise, around an axis that they may touch.
    #[test]
    fn areas_of_lines_add_up(
        shape in prop::sample::select(vec![FaceShape::Segment2, FaceShape::Segment3]),
        radii in prop::collection::vec(0.0_f64..3.0, 7),
    ) {
        let mut mesh = line(shape, 3, |u| [0.0, u, 0.0]);
        mesh.points.iter_mut().zip(&radii).for_each(|(point, radius)| point[0] = *radius);
        let faces: f64 = face_areas(&mesh.placed(), Extent::Axisymmetric).expect("areas").iter().sum();
        for shares in [Shares::Equal, Shares::ShapeFunctions] {
            let areas = node_areas(&mesh.placed(), shares, Extent::Axisymmetric).expect("areas");
            prop_assert!((areas.iter().sum::<f64>() - faces).abs() <= 1e-14 * faces);
            // Between its nodes a second-order line can bulge over the axis.
            prop_assert!(shape == FaceShape::Segment3 || areas.iter().all(|area| 0.0 <= *area), "{areas:?}");
        }
    }
}

#[test]
fn faces_around_nodes() {
    let mesh = grid(FaceShape::Quadrilateral4, [2, 2], |u, v| [u, v, 0.0]);
    assert_eq!(mesh.surface.nodes().len(), 9);
    // The grid is twice as fine: its middle is node 12.
    assert_eq!(mesh.surface.faces_at(NodeId(12)), [0, 1, 2, 3].map(FaceId));
    assert_eq!(mesh.surface.faces_at(NodeId(1)), []);
    assert_eq!(
        [0, 1, 2, 3].map(|edge| mesh.surface.across(FaceId(0), edge)),
        [None, Some(FaceId(1)), Some(FaceId(2)), None]
    );
}
