//! Element matrices: patch tests on distorted elements of every type, closed forms, what no motion changes.

use inpact_geometry::{Conductivity, ElementShape, Error, ErrorKind, Integration, Point, SolidElement, SolidIntegrals};

const ORTHOTROPIC: Conductivity = [[3.0, 0.5, 0.0], [0.5, 2.0, -0.25], [0.0, -0.25, 1.0]];

/// Nodes of the reference elements, from the faces that the element library gives: corners, then middles as means of corners.
fn reference(shape: ElementShape) -> Vec<Point> {
    let corners: Vec<Point> = match shape {
        ElementShape::Tetrahedron4 | ElementShape::Tetrahedron10 => {
            vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        }
        ElementShape::Wedge6 | ElementShape::Wedge15 => {
            vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]]
        }
        _ => {
            let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
            [0.0, 1.0].iter().flat_map(|&z| square.map(|[x, y]| [x, y, z])).collect()
        }
    };
    let mut points = corners;
    points.resize(shape.nodes(), [f64::NAN; 3]);
    for face in shape.faces() {
        let corners = face.shape.corners();
        for (edge, middle) in face.nodes[corners..].iter().enumerate() {
            let [a, b] = [face.nodes[edge], face.nodes[(edge + 1) % corners]].map(|node| points[usize::from(node)]);
            points[usize::from(*middle)] = [0, 1, 2].map(|k| 0.5 * (a[k] + b[k]));
        }
    }
    points
}

/// Moves every node a little, middles off their edges as well.
fn distorted(shape: ElementShape) -> Vec<Point> {
    let mut points = reference(shape);
    for (i, point) in points.iter_mut().enumerate() {
        for (k, coordinate) in point.iter_mut().enumerate() {
            *coordinate += 0.06 * ((7 * i + 3 * k) as f64 * 1.7).sin();
        }
    }
    points
}

const ELEMENTS: [(ElementShape, Integration); 7] = [
    (ElementShape::Tetrahedron4, Integration::Full),
    (ElementShape::Tetrahedron10, Integration::Full),
    (ElementShape::Wedge6, Integration::Full),
    (ElementShape::Wedge15, Integration::Full),
    (ElementShape::Hexahedron8, Integration::Full),
    (ElementShape::Hexahedron20, Integration::Full),
    (ElementShape::Hexahedron20, Integration::Reduced),
];

fn conduct(shape: ElementShape, integration: Integration, points: &[Point], k: &Conductivity) -> SolidIntegrals {
    let element = SolidElement::new(shape, integration).expect("a solid");
    let mut integrals = element.integrals();
    element.conduct(points, k, &mut integrals).expect("not inverted");
    integrals
}

/// x·K·y.
fn form(integrals: &SolidIntegrals, x: &[f64], y: &[f64]) -> f64 {
    let row = |i: usize| (0..y.len()).map(|j| integrals.conductance(i, j) * y[j]).sum::<f64>();
    (0..x.len()).map(|i| x[i] * row(i)).sum()
}

#[test]
fn a_linear_field_has_the_energy_of_its_gradient_on_distorted_elements_of_every_type() {
    let gradients = [[0.7, -1.3, 0.4], [-0.2, 0.9, 1.1]];
    for (shape, integration) in ELEMENTS {
        let points = distorted(shape);
        let integrals = conduct(shape, integration, &points, &ORTHOTROPIC);
        let volume: f64 = integrals.volumes().iter().sum();
        let [x, y] = gradients.map(|g| points.iter().map(|p| 5.0 + g[0] * p[0] + g[1] * p[1] + g[2] * p[2]).collect());
        let (x, y): (Vec<f64>, Vec<f64>) = (x, y);
        let flux = |k: usize| (0..3).map(|l| ORTHOTROPIC[k][l] * gradients[1][l]).sum::<f64>();
        let expected = volume * (0..3).map(|k| gradients[0][k] * flux(k)).sum::<f64>();
        let found = form(&integrals, &x, &y);
        assert!((found - expected).abs() < 1e-13, "{shape:?}: {found} for {expected}");
        // One temperature everywhere drives nothing through any node.
        for i in 0..shape.nodes() {
            let flow: f64 = (0..shape.nodes()).map(|j| integrals.conductance(i, j)).sum();
            assert!(flow.abs() < 1e-13, "{shape:?}: row {i} sums to {flow}");
        }
    }
}

#[test]
fn no_field_but_a_constant_is_without_energy() {
    for (shape, integration) in ELEMENTS {
        let points = distorted(shape);
        let integrals = conduct(shape, integration, &points, &ORTHOTROPIC);
        // A Cholesky factor without the last node has every pivot above zero.
        let n = shape.nodes() - 1;
        let mut factor = vec![vec![0.0; n]; n];
        for i in 0..n {
            for j in 0..=i {
                let sum: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
                let left = integrals.conductance(i, j) - sum;
                if i == j {
                    assert!(1e-6 < left, "{shape:?}: pivot {i} is {left}");
                    factor[i][i] = left.sqrt();
                } else {
                    factor[i][j] = left / factor[j][j];
                }
            }
        }
    }
}

#[test]
fn moving_and_turning_an_element_changes_nothing() {
    let (sin, cos) = 0.6_f64.sin_cos();
    let turn = |[x, y, z]: Point| [cos * x - sin * y + 100.0, sin * x + cos * y - 50.0, z + 7.0];
    let isotropic = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]];
    for (shape, integration) in ELEMENTS {
        let points = distorted(shape);
        let turned: Vec<Point> = points.iter().map(|point| turn(*point)).collect();
        let (before, after) =
            (conduct(shape, integration, &points, &isotropic), conduct(shape, integration, &turned, &isotropic));
        for i in 0..shape.nodes() {
            for j in 0..=i {
                let (before, after) = (before.conductance(i, j), after.conductance(i, j));
                assert!((before - after).abs() < 1e-11, "{shape:?} {i} {j}: {before} and {after}");
            }
        }
    }
}

/// The trilinear cube: conductances k·a/12 over the diagonals of its faces and of itself, none along its edges.
#[test]
fn the_cube_has_the_links_of_the_textbook() {
    let points = reference(ElementShape::Hexahedron8);
    let k = [[12.0, 0.0, 0.0], [0.0, 12.0, 0.0], [0.0, 0.0, 12.0]];
    let integrals = conduct(ElementShape::Hexahedron8, Integration::Full, &points, &k);
    for i in 0..8 {
        for j in 0..i {
            let apart = (0..3).filter(|k| points[i][*k] != points[j][*k]).count();
            let expected = if apart == 1 { 0.0 } else { -1.0 };
            assert!((integrals.conductance(i, j) - expected).abs() < 1e-14, "{i} {j}");
        }
    }
    integrals.volumes().iter().for_each(|volume| assert!((volume - 0.125).abs() < 1e-15));
}

#[test]
fn elements_that_are_inside_out_or_flat_are_refused() {
    for (shape, integration) in ELEMENTS {
        let element = SolidElement::new(shape, integration).expect("a solid");
        let mut integrals = element.integrals();
        let mirrored: Vec<Point> = reference(shape).into_iter().map(|[x, y, z]| [x, y, -z]).collect();
        let flat: Vec<Point> = reference(shape).into_iter().map(|[x, y, _]| [x, y, 0.0]).collect();
        for points in [mirrored, flat] {
            let refused = element.hold(&points, &mut integrals);
            assert!(
                matches!(refused.as_ref().map_err(Error::kind), Err(ErrorKind::Inverted { determinant }) if *determinant <= 0.0),
                "{shape:?}: {refused:?}"
            );
        }
    }
    assert!(SolidElement::new(ElementShape::Quadrilateral4, Integration::Full).is_none());
}
