//! Bodies whose conductances are known: bars, orthotropic blocks, cylinders and spherical shells; patch tests on distorted meshes of every element type.

mod common;

use common::{Block, Edges, TYPES, distorted, read, set};
use inpact_body::BodyField;
use inpact_geometry::{ElementShape, Point};
use std::f64::consts::PI;

const COPPER: &str = "*CONDUCTIVITY\n400.\n*ELECTRICAL CONDUCTIVITY\n6e7\n*DENSITY\n8900.\n*SPECIFIC HEAT\n385.\n";

fn assert_close(found: f64, expected: f64, relative: f64, what: &str) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{what}: {found} for {expected}");
}

/// A bar of length 3 and section 2 × 0.5 along z.
fn bar(type_name: &'static str, shape: ElementShape, cells: [usize; 3]) -> Block {
    let map = |place: Point| {
        let [x, y, z] = distorted(place);
        [2.0 * x, 0.5 * y, 3.0 * z]
    };
    Block { type_name, shape, cells, edges: Edges::Straight, map: Box::new(map) }
}

#[test]
fn a_distorted_bar_conducts_k_a_over_l_with_every_element_type() {
    for (type_name, shape) in TYPES {
        let mesh = bar(type_name, shape, [2, 3, 3]).mesh();
        let deck = mesh.deck(COPPER)
            + &set("LOW", &mesh.nodes_where(|place| place[2] == 0.0))
            + &set("HIGH", &mesh.nodes_where(|place| place[2] == 1.0));
        let body = read(&deck, &["LOW", "HIGH"]).expect("a body");
        for (field, k) in [(BodyField::Thermal, 400.0), (BodyField::Electrical, 6e7)] {
            let lumped = body.lumped(field, None).expect("lumped");
            assert_close(lumped.isothermal.between(0, 1), k / 3.0, 1e-12, type_name);
            // The flow through a bar is even.
            assert_close(lumped.even.between(0, 1), k / 3.0, 1e-12, type_name);
            for terminal in &lumped.terminals {
                assert!(terminal.relative() < 1e-12 && terminal.range < 1e-12, "{type_name}: {terminal:?}");
                assert_close(terminal.area.expect("faces"), 1.0, 1e-14, type_name);
            }
            assert_close(lumped.bodies[0].volume, 3.0, 1e-12, type_name);
        }
        let lumped = body.lumped(BodyField::Thermal, None).expect("lumped");
        let total = 3.0 * 8900.0 * 385.0;
        for capacity in lumped.capacities.iter().map(|capacity| capacity.expect("density and specific heat")) {
            // The mesh is no mirror image of itself, so that only wholes are exact where the rule is not.
            assert_close(capacity, total / 2.0, 1e-3, type_name);
        }
        assert_close(lumped.bodies[0].capacity.expect("a capacity"), total, 1e-12, type_name);
    }
}

#[test]
fn an_orthotropic_block_conducts_by_its_axes_and_an_anisotropic_one_by_its_tensor() {
    let orthotropic = "*CONDUCTIVITY, TYPE=ORTHO\n2., 3., 5.\n";
    for (type_name, shape) in TYPES {
        for (axis, k) in [2.0, 3.0, 5.0].into_iter().enumerate() {
            // The block is turned so that its bar lies along each axis; every motion of it has a positive determinant.
            let map = move |place: Point| {
                let [x, y, z] = distorted(place);
                let mut point = [0.0; 3];
                (point[axis], point[(axis + 1) % 3], point[(axis + 2) % 3]) = (3.0 * z, 2.0 * x, 0.5 * y);
                point
            };
            let mesh = Block { type_name, shape, cells: [2, 2, 3], edges: Edges::Straight, map: Box::new(map) }.mesh();
            let deck = mesh.deck(orthotropic)
                + &set("LOW", &mesh.nodes_where(|place| place[2] == 0.0))
                + &set("HIGH", &mesh.nodes_where(|place| place[2] == 1.0));
            let lumped =
                read(&deck, &["LOW", "HIGH"]).expect("a body").lumped(BodyField::Thermal, None).expect("lumped");
            assert_close(lumped.isothermal.between(0, 1), k / 3.0, 1e-12, type_name);
        }
    }
    // With flow along x alone held in by its sides, a thin plate conducts by the inverse of the resistivity.
    let mesh = bar("C3D20", ElementShape::Hexahedron20, [1, 1, 60]).mesh();
    let deck = mesh.deck("*CONDUCTIVITY, TYPE=ANISO\n2., 0., 3., 0.5, 0., 5.\n")
        + &set("LOW", &mesh.nodes_where(|place| place[2] == 0.0))
        + &set("HIGH", &mesh.nodes_where(|place| place[2] == 1.0));
    let lumped = read(&deck, &["LOW", "HIGH"]).expect("a body").lumped(BodyField::Thermal, None).expect("lumped");
    // Between the block's own k and that of a bar so long that nothing flows across it: 5 and 5 − 0.5²/2.
    let k = 3.0 * lumped.isothermal.between(0, 1);
    assert!(4.875 < k && k < 5.0, "{k}");
}

/// A quarter of a hollow cylinder, height 2, radii 1 and 3.
#[test]
fn a_hollow_cylinder_conducts_by_the_logarithm_of_its_radii() {
    let map = |[x, y, z]: Point| {
        let (radius, angle) = (3.0_f64.powf(x), 0.5 * PI * y);
        [radius * angle.cos(), radius * angle.sin(), 2.0 * z]
    };
    let expected = 400.0 * 0.5 * PI * 2.0 / 3.0_f64.ln();
    for (type_name, shape, relative) in [
        ("C3D20", ElementShape::Hexahedron20, 2e-5),
        ("C3D20R", ElementShape::Hexahedron20, 2e-5),
        ("C3D15", ElementShape::Wedge15, 1e-4),
        ("C3D10", ElementShape::Tetrahedron10, 1e-4),
        ("C3D8", ElementShape::Hexahedron8, 1e-2),
    ] {
        let mesh = Block { type_name, shape, cells: [6, 8, 1], edges: Edges::Curved, map: Box::new(map) }.mesh();
        let deck = mesh.deck(COPPER)
            + &set("INNER", &mesh.nodes_where(|place| place[0] == 0.0))
            + &set("OUTER", &mesh.nodes_where(|place| place[0] == 1.0));
        let lumped =
            read(&deck, &["INNER", "OUTER"]).expect("a body").lumped(BodyField::Thermal, None).expect("lumped");
        assert_close(lumped.isothermal.between(0, 1), expected, relative, type_name);
        assert!(lumped.terminals[0].relative() < 10.0 * relative, "{type_name}: {:?}", lumped.terminals[0]);
    }
}

/// A sixth of a spherical shell, radii 1 and 2: a cube's face blown up.
#[test]
fn a_spherical_shell_conducts_by_the_difference_of_its_inverse_radii() {
    let map = |[x, y, z]: Point| {
        let direction = [(0.25 * PI * (2.0 * x - 1.0)).tan(), (0.25 * PI * (2.0 * y - 1.0)).tan(), 1.0];
        let length = direction.iter().map(|component| component * component).sum::<f64>().sqrt();
        // Shells nearer to the middle are thinner.
        let radius = 2.0 / (2.0 - z);
        direction.map(|component| radius * component / length)
    };
    let expected = 400.0 * (4.0 * PI / 6.0) / (1.0 - 0.5);
    for (type_name, shape, relative) in [
        ("C3D20", ElementShape::Hexahedron20, 1e-4),
        ("C3D10", ElementShape::Tetrahedron10, 1e-3),
        ("C3D8", ElementShape::Hexahedron8, 2e-2),
    ] {
        let mesh = Block { type_name, shape, cells: [6, 6, 5], edges: Edges::Curved, map: Box::new(map) }.mesh();
        let deck = mesh.deck(COPPER)
            + &set("INNER", &mesh.nodes_where(|place| place[2] == 0.0))
            + &set("OUTER", &mesh.nodes_where(|place| place[2] == 1.0));
        let lumped =
            read(&deck, &["INNER", "OUTER"]).expect("a body").lumped(BodyField::Thermal, None).expect("lumped");
        assert_close(lumped.isothermal.between(0, 1), expected, relative, type_name);
    }
}

/// A joint of uniform conductance h on both ends of a body conducts, without the joints, between what both ways of lumping say.
#[test]
fn what_a_uniform_joint_has_a_body_conduct_lies_between_both_ways() {
    // A block that is wide beside its lower terminal: the flow contracts into it.
    let map = |[x, y, z]: Point| [4.0 * x, y, 2.0 * z];
    let mesh = Block {
        type_name: "C3D8",
        shape: ElementShape::Hexahedron8,
        cells: [8, 1, 4],
        edges: Edges::Straight,
        map: Box::new(map),
    }
    .mesh();
    let low = mesh.nodes_where(|place| place[2] == 0.0 && place[0] <= 0.25);
    let high = mesh.nodes_where(|place| place[2] == 1.0);
    let deck = mesh.deck(COPPER) + &set("LOW", &low) + &set("HIGH", &high);
    let lumped = read(&deck, &["LOW", "HIGH"]).expect("a body").lumped(BodyField::Thermal, None).expect("lumped");
    let (lower, upper) = (lumped.terminals[0].lower, lumped.terminals[0].upper);
    assert!(lumped.terminals[0].relative() > 0.01, "{:?}", lumped.terminals[0]);
    for h in [1e-2, 1.0, 1e2, 1e4] {
        // The joint is a layer of bricks of its own below the terminal, so stiff along itself as it is thin.
        let thickness = 1e-3;
        let mut joined = mesh.nodes.clone();
        let mut layer = String::new();
        let mut bottom = Vec::new();
        for node in &low {
            let (place, [x, y, z]) = joined[node];
            bottom.push(node + 100_000);
            joined.insert(node + 100_000, (place, [x, y, z - thickness]));
        }
        let (n, across) = (low.len() / 2, &low);
        for i in 0..n - 1 {
            let face = [across[i], across[i + 1], across[i + 1 + n], across[i + n]];
            let nodes: Vec<String> =
                face.iter().map(|node| node + 100_000).chain(face).map(|node| node.to_string()).collect();
            layer += &format!("{}, {}\n", 900_001 + i, nodes.join(", "));
        }
        let with_layer = common::Meshed { nodes: joined, elements: mesh.elements.clone(), type_name: "C3D8" };
        let deck = with_layer.deck(COPPER)
            + &format!(
                "*ELEMENT, TYPE=C3D8, ELSET=LAYER\n{layer}*SOLID SECTION, ELSET=LAYER, MATERIAL=JOINT\n*MATERIAL, NAME=JOINT\n*CONDUCTIVITY, TYPE=ORTHO\n1e-12, 1e-12, {:?}\n",
                h * thickness
            )
            + &set("BOTTOM", &bottom)
            + &set("HIGH", &high);
        let whole = read(&deck, &["BOTTOM", "HIGH"]).expect("a body").lumped(BodyField::Thermal, None).expect("lumped");
        let resistance = 1.0 / whole.isothermal.between(0, 1) - 1.0 / h;
        // The subtraction leaves few digits where the joint is all there is; the upper terminal is at one temperature.
        let rounding = 1e-9 / h;
        assert!(1.0 / upper - rounding <= resistance, "h = {h}: {resistance} below {}", 1.0 / upper);
        assert!(resistance <= 1.0 / lower + rounding, "h = {h}: {resistance} above {}", 1.0 / lower);
    }
}
