//! Histories of solved scenes: how long increments are where their integrals are wanted, given rates, circuits that close, and where histories start.

use crate::program::{Folder, Run};

const PRESSED: &str = "*SURFACE INTERACTION, NAME=C\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n 1., 0.\n 101., 100.\n";

/// The cells of a column of a table, a number each; those of rows that begin with `node`.
fn column(table: &str, node: &str, name: &str) -> Vec<f64> {
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().expect("a header");
    let place = header.iter().position(|column| *column == name).unwrap_or_else(|| panic!("{name} in {header:?}"));
    lines.filter(|cells| cells[0] == node).map(|cells| cells[place].parse().expect("a number")).collect()
}

fn solved(deck: &str, scene: &str) -> (Run, Folder) {
    let folder = Folder::with(&[("deck.inp", deck), ("scene.toml", scene)]);
    let run = folder.inpact(&["solve", "scene.toml", "-o", "states.csv", "--interfaces", "rows.csv"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    (run, folder)
}

/// 1 V across a conductance of 1 + 100 t: ECDT(1) = 51, of which each increment of n even ones would miss 50/n.
fn pressed(tolerance: &str, block: &str) -> String {
    format!(
        "deck = \"deck.inp\"\nprocedure = \"transient\"\n[time]\nend = 1.0\ntolerance = {tolerance}\n\
         [[node]]\nname = \"s\"\npotential = {{ fixed = 1.0 }}\n[[node]]\nname = \"m\"\npotential = {{ fixed = 0.0 }}\n{block}\
         [[interface]]\nslave = \"s\"\nmaster = \"m\"\narea = 1.0\nclosed = true\npressure = [[0.0, 0.0], [1.0, 100.0]]\n"
    )
}

#[test]
fn o_5_the_tolerance_holds_the_error_of_histories() {
    let storing = "[[node]]\nname = \"block\"\ntemperature = { capacity = 1.0, initial = 20.0 }\n";
    for block in ["", storing] {
        let error = |tolerance: &str| {
            let (run, folder) = solved(PRESSED, &pressed(tolerance, block));
            let rows = folder.read("rows.csv");
            let found = *column(&rows, "s", "ECDT").last().expect("rows");
            // The estimate is the error.
            let said = run.errors.split("estimated error ").nth(1).and_then(|text| text.split(' ').next());
            let said: f64 = said.and_then(|text| text.parse().ok()).expect("an estimate");
            assert!((said / (1.0 - 51.0 / found) - 1.0).abs() < 0.1, "{said} {found}");
            (found - 51.0) / 51.0
        };
        let errors = ["1e-2", "1e-4", "1e-6"].map(error);
        assert!(errors[2] < 2e-3 && errors[2] < errors[1] / 5.0 && errors[1] < errors[0], "{errors:?}");
    }
}

/// Without histories their error does not count.
#[test]
fn increments_follow_the_tolerance() {
    let folder = Folder::with(&[("deck.inp", PRESSED), ("scene.toml", &pressed("1e-6", ""))]);
    let run = folder.inpact(&["solve", "scene.toml"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    assert!(run.output.lines().count() < 20 && !run.errors.contains("time integrals"), "{}", run.errors);
}

/// A switch in a circuit of 10 V and 1 ohm that closes at half the time: 10 A, and 1e-4 ohm in the contact, 0.01 W.
fn switch(time: &str) -> (&'static str, String) {
    let deck = "*SURFACE INTERACTION, NAME=C\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n 1.E4, 0.\n 1.E4, 100.\n*GAP CONDUCTANCE, PRESSURE\n 10., 0.\n 10., 100.\n";
    let scene = format!(
        "deck = \"deck.inp\"\nprocedure = \"transient\"\n[time]\nend = 1.0\n{time}\n[initial]\ntemperature = 20.0\n\
         [[node]]\nname = \"battery\"\npotential = {{ fixed = 10.0 }}\n[[node]]\nname = \"slave\"\ntemperature = {{ capacity = 1.0 }}\n\
         [[node]]\nname = \"master\"\npotential = {{ fixed = 0.0 }}\ntemperature = {{ capacity = 1.0 }}\n\
         [[link]]\nnodes = [\"battery\", \"slave\"]\nelectrical = 1.0\n\
         [[interface]]\nslave = \"slave\"\nmaster = \"master\"\narea = 1.0\n\
         clearance = [[0.0, 1.0e-3], [0.45, 1.0e-3], [0.5, 0.0]]\npressure = [[0.0, 0.0], [0.5, 0.0], [0.55, 100.0]]\n"
    );
    (deck, scene)
}

#[test]
fn q_41_a_circuit_that_closes_heats_by_what_it_supplies() {
    let heat = 1e4 * (10.0_f64 / 10_001.0).powi(2);
    for step in ["0.1", "0.05", "0.025"] {
        let (deck, scene) = switch(&format!("step = {step}"));
        let (run, folder) = solved(deck, &scene);
        let (states, rows) = (folder.read("states.csv"), folder.read("rows.csv"));
        let closed = column(&rows, "slave", "ECD").iter().filter(|current| **current > 0.0).count();
        let energy = closed as f64 * step.parse::<f64>().expect("a number") * heat;
        // Both blocks take half of it, and the table says the same energy as the states.
        for node in ["slave", "master"] {
            let temperature = *column(&states, node, "temperature").last().expect("rows");
            assert!((temperature - 20.0 - 0.5 * energy).abs() < 1e-13, "{temperature} {energy}");
        }
        let total = *column(&rows, "slave", "SJDT").last().expect("rows");
        assert!((total / energy - 1.0).abs() < 1e-12, "{total} {energy}");
        assert!(!run.errors.contains("D022"), "{}", run.errors);
    }
    let (deck, scene) = switch("step = 0.1\nclosing_heat = \"manual\"");
    let (run, folder) = solved(deck, &scene);
    let total = *column(&folder.read("rows.csv"), "slave", "SJDT").last().expect("rows");
    assert!(3e4 < total && run.errors.contains("warning[D022]"), "{total} {}", run.errors);
}

/// O-5: the rate that is given fills the gap, PTL is the integral of PFL, and what contradicts it is said.
#[test]
fn o_5_a_given_rate_of_the_clearance() {
    let deck = "*SURFACE INTERACTION, NAME=J\n*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.5, CUTOFF GAP FILL=0.5\n 1.E-3, 0.\n";
    let scene = |clearance: &str| {
        format!(
            "deck = \"deck.inp\"\nprocedure = \"transient\"\n[time]\nend = 1.0\nstep = 0.5\n\
             [[node]]\nname = \"s\"\npore_pressure = {{ fixed = 0.0 }}\n[[node]]\nname = \"m\"\npore_pressure = {{ fixed = 0.0 }}\n\
             [[interface]]\nslave = \"s\"\nmaster = \"m\"\narea = 1.0\nclearance = {clearance}\nclearance_rate = -0.02\n"
        )
    };
    for clearance in ["0.1", "[[0.0, 0.1], [1.0, 0.284]]"] {
        let (run, folder) = solved(deck, &scene(clearance));
        let rows = folder.read("rows.csv");
        assert_eq!(column(&rows, "s", "PFL"), [-0.01; 3]);
        assert_eq!(column(&rows, "s", "PTL"), [0.0, -0.005, -0.01]);
        assert_eq!(run.errors.matches("warning[D021]").count(), 1, "{}", run.errors);
        // Without the table of the interfaces as well: the states follow the rate.
        let alone = folder.inpact(&["solve", "scene.toml"]);
        assert_eq!(alone.errors.matches("warning[D021]").count(), 1, "{}", alone.errors);
    }
    let (run, _) = solved(deck, &scene("[[0.0, 0.1], [1.0, 0.08]]"));
    assert!(!run.errors.contains("D021"), "{}", run.errors);
}

/// C-25: at rest the first increment has a third of the heat of its jump, and the states follow.
#[test]
fn c_25_scenes_may_start_at_rest() {
    let deck = "*SURFACE INTERACTION, NAME=C\n*GAP ELECTRICAL CONDUCTANCE\n 2., 0.\n 2., 1.\n*GAP CONDUCTANCE\n 1., 0.\n 1., 1.\n";
    let scene = |start_from: &str| {
        format!(
            "deck = \"deck.inp\"\nprocedure = \"transient\"\n[time]\nstart = 5.0\nend = 6.0\nstep = 0.25\n{start_from}\n\
             [[node]]\nname = \"s\"\npotential = {{ fixed = 3.0 }}\ntemperature = {{ capacity = 1.0, initial = 0.0 }}\n\
             [[node]]\nname = \"m\"\npotential = {{ fixed = 0.0 }}\ntemperature = {{ capacity = 1.0, initial = 0.0 }}\n\
             [[interface]]\nslave = \"s\"\nmaster = \"m\"\narea = 1.0\nclearance = 0.0\n"
        )
    };
    for (start_from, increments) in
        [("", 4.0), ("start_from = \"first-row\"", 4.0), ("start_from = \"at-rest\"", 4.0 - 2.0 / 3.0)]
    {
        let (_, folder) = solved(deck, &scene(start_from));
        let energy = 2.0 * 9.0 * 0.25 * increments;
        let total = *column(&folder.read("rows.csv"), "s", "SJDT").last().expect("rows");
        let temperature = *column(&folder.read("states.csv"), "s", "temperature").last().expect("rows");
        assert!(
            (total - energy).abs() < 1e-12 && (temperature - 0.5 * energy).abs() < 1e-12,
            "{total} {temperature} {energy}"
        );
    }
}

/// C-25: `eval` has the same choice for tables that have no row at the start.
#[test]
fn c_25_node_tables_may_start_at_rest() {
    let nodes = "node,time,clearance,epot_jump\n1,0.5,0,3\n1,1,0,3\n";
    let deck = "*SURFACE INTERACTION, NAME=C\n*GAP ELECTRICAL CONDUCTANCE\n 2., 0.\n 2., 1.\n";
    let folder = Folder::with(&[("deck.inp", deck), ("nodes.csv", nodes)]);
    let of = |start: &[&str]| {
        let arguments = [&["eval", "deck.inp", "--nodes", "nodes.csv", "--procedure", "transient"], start].concat();
        let run = folder.inpact(&arguments);
        assert_eq!(run.code, 0, "{}", run.errors);
        [column(&run.output, "1", "SJDT"), column(&run.output, "1", "ECDT")]
    };
    assert_eq!(of(&[]), [[0.0, 9.0], [0.0, 3.0]]);
    assert_eq!(of(&["--history-start", "first-row"]), [[0.0, 9.0], [0.0, 3.0]]);
    assert_eq!(of(&["--history-start", "at-rest"]), [[3.0, 12.0], [3.0, 6.0]]);
}
