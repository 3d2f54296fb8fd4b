//! Areas and clearances beside CalculiX: two blocks whose curved, distorted faces do not match, all displacements and temperatures held.
//!
//! With a conductance of 1 and a difference of 1 between the blocks the heat that a slave node takes is its area; `CDIS` is the clearance.
//! Without ccx the comparison does nothing and says so; where `INPACT_REQUIRE_CCX` is set, as in the gate, it fails instead.

use inpact_geometry::{ContactNode, NodeId, Point};
use inpact_parser::deck::scan;
use inpact_parser::grammar::{Dialect, Grammar, Release};
use inpact_parser::mesh::{KeptRows, Mesh, SurfaceKind, read};
use inpact_parser::model;
use std::collections::BTreeMap;
use std::io::Write;
use std::process::Command;

/// A block of one layer of bricks with its corner at x = y = `corner`; its lower face is `low` and its upper one `high` above a curved surface.
struct Block {
    first: usize,
    faces: [usize; 2],
    corner: f64,
    side: f64,
    heights: [f64; 2],
    phase: f64,
}

const MASTER: Block = Block { first: 1, faces: [5, 4], corner: -0.2, side: 2.4, heights: [-1.0, 0.0], phase: 0.3 };

/// Overclosed by 0.02 up and down, so that every slave node conducts.
const SLAVE: Block = Block { first: 1001, faces: [4, 5], corner: 0.0, side: 2.0, heights: [-0.02, 1.0], phase: 1.1 };

impl Block {
    fn nodes(&self) -> String {
        let [n, m] = self.faces;
        let mut text = String::new();
        for (layer, height) in self.heights.iter().enumerate() {
            for j in 0..=m {
                for i in 0..=n {
                    let (u, v) = (i as f64 / n as f64, j as f64 / m as f64);
                    let x = self.corner
                        + self.side * (u + 0.03 * (5.0 * u + self.phase).sin() * (7.0 * v + 2.0 * self.phase).sin());
                    let y = self.corner
                        + self.side * (v + 0.03 * (3.0 * u + 1.3 * self.phase).sin() * (6.0 * v + self.phase).sin());
                    let z = 0.1 * x * x - 0.07 * y * y + 0.05 * x * y + height;
                    text +=
                        &format!("{}, {x:?}, {y:?}, {z:?}\n", self.first + layer * (n + 1) * (m + 1) + j * (n + 1) + i);
                }
            }
        }
        text
    }

    fn elements(&self) -> String {
        let [n, m] = self.faces;
        let mut text = String::new();
        for j in 0..m {
            for i in 0..n {
                let low = self.first + j * (n + 1) + i;
                let square = |from: usize| format!("{from}, {}, {}, {}", from + 1, from + n + 2, from + n + 1);
                text += &format!("{}, {}, {}\n", self.first + j * n + i, square(low), square(low + (n + 1) * (m + 1)));
            }
        }
        text
    }

    fn layer(&self) -> usize {
        (self.faces[0] + 1) * (self.faces[1] + 1)
    }
}

/// The deck; a block beside the two has temperatures that are not held, since ccx wants something to solve.
fn deck(discretisation: &str) -> String {
    let (of_master, of_slave) = (2 * MASTER.layer(), 2 * SLAVE.layer());
    format!(
        "*NODE, NSET=HELD
{master_nodes}{slave_nodes}*NODE, NSET=FREE
9001, 10., 0., 0.\n9002, 11., 0., 0.\n9003, 11., 1., 0.\n9004, 10., 1., 0.
9005, 10., 0., 1.\n9006, 11., 0., 1.\n9007, 11., 1., 1.\n9008, 10., 1., 1.
*ELEMENT, TYPE=C3D8, ELSET=LOWER
{master_elements}*ELEMENT, TYPE=C3D8, ELSET=UPPER
{slave_elements}*ELEMENT, TYPE=C3D8, ELSET=BESIDE
9000, 9001, 9002, 9003, 9004, 9005, 9006, 9007, 9008
*NSET, NSET=COLD, GENERATE
1, {of_master}, 1
*NSET, NSET=WARM, GENERATE
1001, {last}, 1
*NSET, NSET=FACE, GENERATE
1001, {last_of_face}, 1
*SURFACE, NAME=MASTER
LOWER, S2
*SURFACE, NAME=SLAVE
UPPER, S1
*MATERIAL, NAME=STEEL
*ELASTIC
1000., 0.3
*CONDUCTIVITY
1.
*SOLID SECTION, ELSET=LOWER, MATERIAL=STEEL
*SOLID SECTION, ELSET=UPPER, MATERIAL=STEEL
*SOLID SECTION, ELSET=BESIDE, MATERIAL=STEEL
*SURFACE INTERACTION, NAME=TOUCH
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
1000., 1.
*GAP CONDUCTANCE
1., 0., 0.
*CONTACT PAIR, INTERACTION=TOUCH, TYPE={discretisation}
SLAVE, MASTER
*INITIAL CONDITIONS, TYPE=TEMPERATURE
HELD, 0.
FREE, 0.
*STEP
*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE
1., 1.
*BOUNDARY
HELD, 1, 3
9001, 1, 3\n9002, 1, 3\n9003, 1, 3\n9004, 1, 3
COLD, 11, 11, 0.
WARM, 11, 11, 1.
9001, 11, 11, 1.
*NODE PRINT, NSET=FACE
RFL
*CONTACT PRINT
CDIS
*END STEP
",
        master_nodes = MASTER.nodes(),
        slave_nodes = SLAVE.nodes(),
        master_elements = MASTER.elements(),
        slave_elements = SLAVE.elements(),
        last = 1000 + of_slave,
        last_of_face = 1000 + SLAVE.layer(),
    )
}

/// Output of ccx: by node, the first number after it; `None` without ccx.
struct Printed {
    areas: BTreeMap<u32, String>,
    clearances: BTreeMap<u32, String>,
}

fn ccx(deck: &str) -> Option<Printed> {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("pair.inp"), deck).expect("written");
    match Command::new("ccx").arg("pair").current_dir(folder.path()).output() {
        Ok(output) if output.status.success() => {
            let dat = std::fs::read_to_string(folder.path().join("pair.dat")).expect("printed");
            Some(Printed {
                areas: rows_below(&dat, "heat generation"),
                clearances: rows_below(&dat, "relative contact displacement"),
            })
        }
        Ok(output) => panic!("{}", String::from_utf8_lossy(&output.stdout)),
        Err(error) => {
            assert!(std::env::var_os("INPACT_REQUIRE_CCX").is_none(), "ccx: {error}");
            let _ = writeln!(std::io::stderr(), "SKIPPED, nothing was compared with CalculiX: ccx: {error}");
            None
        }
    }
}

fn rows_below(dat: &str, title: &str) -> BTreeMap<u32, String> {
    let mut found = BTreeMap::new();
    let mut here = false;
    for line in dat.lines().map(str::trim).filter(|line| !line.is_empty()) {
        if line.starts_with(|first: char| first.is_alphabetic()) {
            here = line.starts_with(title);
        } else if here {
            let mut cells = line.split_whitespace();
            let node = cells.next().and_then(|cell| cell.parse().ok()).expect("a node");
            found.insert(node, cells.next().expect("a number").to_owned());
        }
    }
    found
}

/// Our own, by node, and what ccx sums up: two Gauss points each way on each slave face, in equal shares.
struct Ours {
    nodes: BTreeMap<u32, ContactNode>,
    by_two_points: BTreeMap<u32, f64>,
}

fn ours(deck: &str) -> Ours {
    let grammar = Grammar::new(Dialect::Calculix, Release::default());
    let scanned = scan("pair.inp", deck.as_bytes(), &grammar);
    let (model, problems) = model::read(&scanned, &grammar);
    assert!(problems.is_empty(), "{problems:?}");
    let mesh: Mesh = read(&scanned, &grammar, &model, &mut KeptRows(&scanned)).expect("rows");
    assert_eq!(mesh.notes, []);
    let label = |node: NodeId| mesh.nodes[node.index()].label;
    let mut by_two_points: BTreeMap<u32, f64> = BTreeMap::new();
    let SurfaceKind::Faces(slave) = &mesh.surfaces[mesh.pairs[0].slave].kind else { panic!("faces") };
    for face in slave.surface.faces() {
        let nodes = slave.surface.face(face).nodes;
        let area = area_by_two_points([0, 1, 2, 3].map(|i| mesh.points[nodes[i].index()]));
        for node in nodes {
            *by_two_points.entry(label(*node)).or_default() += 0.25 * area;
        }
    }
    let found = mesh.contact(&mesh.pairs[0], 1.0).expect("a geometry");
    Ours { nodes: found.into_iter().map(|node| (label(node.node), node)).collect(), by_two_points }
}

fn area_by_two_points(corners: [Point; 4]) -> f64 {
    let at = 1.0 / 3.0_f64.sqrt();
    let mut area = 0.0;
    for [x, y] in [[-at, -at], [at, -at], [at, at], [-at, at]] {
        let along = [-(1.0 - y), 1.0 - y, 1.0 + y, -(1.0 + y)];
        let across = [-(1.0 - x), -(1.0 + x), 1.0 + x, 1.0 - x];
        let sum = |slopes: [f64; 4], k: usize| (0..4).map(|i| 0.25 * slopes[i] * corners[i][k]).sum::<f64>();
        let (a, b) = ([0, 1, 2].map(|k| sum(along, k)), [0, 1, 2].map(|k| sum(across, k)));
        let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        area += cross.iter().map(|c| c * c).sum::<f64>().sqrt();
    }
    area
}

fn to_the_last_digit(found: f64, printed: &str) {
    within(found, printed, 0.5);
}

/// So many units of the seventh digit, which is the last that ccx prints.
fn within(found: f64, printed: &str, units: f64) {
    let value: f64 = printed.parse().expect("a number");
    let (_, exponent) = printed.split_once('E').expect("an exponent");
    let unit = 10.0_f64.powi(exponent.parse::<i32>().expect("an exponent") - 6);
    assert!((found - value).abs() <= units * unit, "{found} for {printed}");
}

#[test]
fn areas_and_clearances_of_node_to_surface_to_every_digit() {
    let deck = deck("NODE TO SURFACE");
    let Some(printed) = ccx(&deck) else { return };
    let ours = ours(&deck);
    assert_eq!((printed.areas.len(), printed.clearances.len(), ours.nodes.len()), (30, 30, 30));
    for (label, node) in &ours.nodes {
        // Node to surface, ccx integrates a warped face with 2 × 2 points, which we do with more: its digits are those of the former, and ours are within a
        // unit of the last one.
        let by_two_points = ours.by_two_points[label];
        to_the_last_digit(by_two_points, &printed.areas[label]);
        within(node.area, &printed.areas[label], 1.0);
        let across = node.across.as_ref().expect("a face");
        assert!(across.projects, "{label}");
        to_the_last_digit(across.clearance, &printed.clearances[label]);
    }
}

#[test]
fn areas_of_surface_to_surface_to_every_digit() {
    let deck = deck("SURFACE TO SURFACE");
    let Some(printed) = ccx(&deck) else { return };
    let ours = ours(&deck);
    assert_eq!((printed.areas.len(), ours.nodes.len()), (30, 30));
    for (label, node) in &ours.nodes {
        to_the_last_digit(node.area, &printed.areas[label]);
    }
}
