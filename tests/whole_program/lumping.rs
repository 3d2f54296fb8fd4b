//! What lumping costs: the measure that `inpact scene` prints beside the true error, the heat of the scene beside that of ccx, on constrictions, meshes that do not
//! match, surfaces that hang over each other, and pressures that vary.
//!
//! Without ccx the comparison does nothing and says so; where `INPACT_REQUIRE_CCX` is set, as in the gate, it fails instead.

use crate::deck_scenes::{Block, CALCULIX, STEADY, Shape, all_nodes, block, made, measure, printed, supply, type_in};
use crate::heat_balance::{WARM, twin};
use crate::nodes_results::ccx;
use crate::program::Folder;
use std::fmt::Write;

/// A bar on a plate of 60 mm, both 20 mm high.
struct Case {
    name: &'static str,
    /// Cells along an edge, and conductivity.
    plate: (u32, f64),
    /// Cells along an edge, its length and its corner, and conductivity.
    bar: (u32, f64, [f64; 2], f64),
    slave: Slave,
    /// The conductance per area at pressures of 0 and 1.E6.
    conductances: [f64; 2],
    pressure: Pressure,
}

#[derive(Clone, Copy, PartialEq)]
enum Slave {
    Bar,
    Plate,
}

#[derive(Clone, Copy, PartialEq)]
enum Pressure {
    /// 5.E5 everywhere.
    Uniform,
    /// From 5.E4 to 9.5.E5 along the bar.
    Varying,
}

const EVEN: [f64; 2] = [4000.0, 4000.0];

const CASES: [Case; 14] = [
    plain("the plate itself, 2 cells on 3", (3, 40.0), (2, 0.06, [0.0; 2], 90.0), EVEN),
    plain("the plate itself, 5 cells on 3", (3, 40.0), (5, 0.06, [0.0; 2], 90.0), EVEN),
    plain("a corner of the plate, 3 cells on 2", (4, 40.0), (3, 0.03, [0.0; 2], 90.0), EVEN),
    plain("the middle, 2 cells on 2", (4, 40.0), (2, 0.03, [0.015; 2], 90.0), EVEN),
    plain("the middle, 2 cells on 2, a perfect joint", (4, 40.0), (2, 0.03, [0.015; 2], 90.0), [1e7; 2]),
    plain("beside the edges of cells, 3 on 2.5", (5, 40.0), (3, 0.03, [0.01, 0.007], 90.0), EVEN),
    Case {
        slave: Slave::Plate,
        ..plain("the same, the plate being the slave", (5, 40.0), (3, 0.03, [0.01, 0.007], 90.0), EVEN)
    },
    plain("beside the edges, 2 on 1.5, a good joint", (3, 1.0), (2, 0.03, [0.0018, 0.0061], 82.0), [446_086.0; 2]),
    Case {
        slave: Slave::Plate,
        ..plain(
            "beside the edges, 3 on 1.5, the plate slave",
            (2, 136.0),
            (3, 0.045, [0.0018, 0.005], 645.0),
            [4880.0; 2],
        )
    },
    plain("over the edge of the plate by 12 mm", (6, 40.0), (4, 0.03, [0.042, 0.004], 90.0), EVEN),
    Case {
        slave: Slave::Plate,
        ..plain("the same, the plate being the slave", (6, 40.0), (4, 0.03, [0.042, 0.004], 90.0), EVEN)
    },
    plain("a bar within one face of the plate", (2, 40.0), (2, 0.01, [0.008, 0.012], 90.0), EVEN),
    Case {
        pressure: Pressure::Varying,
        ..plain("a pressure that varies 1:19", (3, 40.0), (3, 0.06, [0.0; 2], 90.0), [200.0, 60_000.0])
    },
    Case {
        pressure: Pressure::Varying,
        ..plain("the same, 5 cells on 3", (3, 40.0), (5, 0.06, [0.0; 2], 90.0), [200.0, 60_000.0])
    },
];

const fn plain(name: &'static str, plate: (u32, f64), bar: (u32, f64, [f64; 2], f64), conductances: [f64; 2]) -> Case {
    Case { name, plate, bar, slave: Slave::Bar, conductances, pressure: Pressure::Uniform }
}

impl Case {
    fn deck(&self) -> String {
        let (cells, conductivity) = self.plate;
        let plate = Block { first: 1000, name: "A", low: 0.0, high: 0.02, conductivity, at: [0.0; 2] };
        let mut deck = with_all_nodes(&plate, (cells, 0.06));
        let (cells, side, at, conductivity) = self.bar;
        let bar = Block { first: 5000, name: "B", low: 0.02, high: 0.04, conductivity, at };
        let of_bar = with_all_nodes(&bar, (cells, side));
        let moves = match self.pressure {
            Pressure::Uniform => "EBN, 3, 3, -5.E-7\n".to_owned(),
            Pressure::Varying => {
                let rows = of_bar.split_once("*NODE, NSET=NALL\n").expect("nodes").1;
                let rows = rows.lines().take_while(|line| !line.starts_with('*'));
                rows.map(|row| {
                    let cells: Vec<&str> = row.split(", ").collect();
                    let along = (cells[1].parse::<f64>().expect("a number") - at[0]) / side;
                    // ccx reads 20 characters of a number.
                    format!("{}, 3, 3, {:.10e}\n", cells[0], -0.05e-6 - 0.9e-6 * along)
                })
                .collect()
            }
        };
        deck += &of_bar;
        let pair = if self.slave == Slave::Bar { "SLB, SHA" } else { "SHA, SLB" };
        let [least, most] = self.conductances;
        deck + &format!(
            "*SURFACE INTERACTION, NAME=JOINT\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1.E12\n*GAP CONDUCTANCE\n{least:?}, 0.\n{most:?}, 1.E6\n\
             *CONTACT PAIR, INTERACTION=JOINT, TYPE=SURFACE TO SURFACE\n{pair}\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, 20.\n*STEP, INC=1000\n{STEADY}\
             *BOUNDARY\nEAN, 1, 3, 0.\nEBN, 1, 2, 0.\n{moves}LA, 11, 11, 20.\nHB, 11, 11, 120.\n*NODE PRINT, NSET=HB, TOTALS=ONLY\nRFL\n\
             *NODE FILE\nU, NT\n*CONTACT FILE\nCDIS, CSTR\n*END STEP\n"
        )
    }
}

/// A block with a set of all its nodes.
fn with_all_nodes(of: &Block, size: (u32, f64)) -> String {
    let text = block(of, "C3D8", Shape::Straight, size);
    let elements = format!("*ELEMENT, TYPE=C3D8, ELSET=E{}\n", of.name);
    text.replace(&elements, &format!("{}{elements}", all_nodes(&text, of.name)))
}

/// The heat of ccx at a set and that of the scene made of the same deck, and what the scene says it may be off by; `None` without ccx.
fn compared(deck: &str, set: &str, pressure: Pressure) -> Option<[f64; 3]> {
    let folder = ccx(deck)?;
    let options: &[&str] = if pressure == Pressure::Varying { &["--results", "job.frd"] } else { &[] };
    let run = made(&folder, &[&CALCULIX, options].concat());
    if pressure == Pressure::Uniform {
        type_in(&folder, "pressure = 5.0e5");
    }
    let heat: f64 = printed(&folder, set).parse().expect("a number");
    Some([heat, supply(&folder, set), measure(&run)])
}

/// A joint of which no slave node has the master across is none, and is named with its line.
#[test]
fn a_joint_without_a_slave_node_across_is_named() {
    let within = CASES.iter().find(|case| case.name == "a bar within one face of the plate").expect("the case");
    let deck = Case { slave: Slave::Plate, ..*within }.deck();
    let folder = Folder::with(&[("job.inp", &deck)]);
    let run = made(&folder, &CALCULIX);
    let line = deck.lines().position(|line| line.starts_with("*CONTACT PAIR")).expect("the pair") + 1;
    let said = format!(
        "job.inp:{line}: `SHA` on `SLB`: no slave node has the master across from it, so that there is no joint"
    );
    assert!(run.errors.contains(&said), "{}", run.errors);
    assert!(!folder.read("s.toml").contains("[[interface]]"), "{}", folder.read("s.toml"));
}

/// The error is a share of the heat of the scene, as the measure is.
#[test]
fn the_measure_is_larger_than_the_error() {
    let mut table = String::from("| case | heat of ccx | of the scene | error | measure |\n|---|---|---|---|---|\n");
    let mut wrong = Vec::new();
    let mut take = |name: &str, [heat, of_scene, measure]: [f64; 3]| {
        let error = (of_scene - heat).abs() / of_scene.abs();
        writeln!(table, "| {name} | {heat:.2} | {of_scene:.2} | {:.2} % | {:.1} % |", 100.0 * error, 100.0 * measure)
            .expect("a text");
        // ccx prints seven digits.
        if measure + 1e-6 < error {
            wrong.push(name.to_owned());
        }
    };
    for case in &CASES {
        let Some(found) = compared(&case.deck(), "HB", case.pressure) else { return };
        take(case.name, found);
    }
    let uniform = compared(&twin("SURFACE TO SURFACE", [120.0; 6]), "NTOP", Pressure::Uniform).expect("ccx ran before");
    take("the weld twin, its lower side at one temperature", uniform);
    let columns = compared(&twin("SURFACE TO SURFACE", WARM), "NTOP", Pressure::Uniform).expect("ccx ran before");
    take("the weld twin, its lower side at six", columns);
    assert!(wrong.is_empty(), "{wrong:?}\n{table}");
    insta::assert_snapshot!(table);
}
