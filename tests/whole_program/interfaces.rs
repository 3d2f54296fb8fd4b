//! `inpact interfaces`: interfaces of scenes from the mesh of a deck, a row a slave node or one a pair, and what is across from each slave node.

use crate::nodes::{CUBES, WELD};
use crate::program::{Folder, Run, inpact, inpact_with_input};

fn rows(run: &Run) -> Vec<Vec<String>> {
    assert_eq!(run.code, 0, "{}", run.errors);
    run.output.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

fn number(cell: &str) -> f64 {
    cell.parse().expect("a number")
}

#[test]
fn a_slave_node_over_the_edge_has_no_interface_and_is_named() {
    let folder = Folder::with(&[("a.inp", CUBES)]);
    let run = folder.inpact(&["interfaces", "a.inp", "--projections", "p.csv"]);
    let expected = "slave,master,interaction,area,clearance\n11,11@MASTER,GAP,0.2499999999999999,0.25\n14,14@MASTER,GAP,0.2499999999999999,0.25\n";
    assert_eq!((run.code, run.output.as_str()), (0, expected), "{}", run.errors);
    let said = "2 slave nodes hang over the edge of the master, so that they have no interface: 12, 13";
    assert!(run.errors.contains(said), "{}", run.errors);
    let projections = folder.read("p.csv");
    let rows: Vec<Vec<&str>> = projections.lines().map(|line| line.split(',').collect()).collect();
    let header = ["slave", "master", "master_node", "weight", "element", "face", "clearance", "overhang", "projects"];
    assert_eq!(rows[0], header);
    assert_eq!(rows.len(), 1 + 4 * 4);
    // Node 11 is over the middle of the edge from 5 to 6.
    let weights: Vec<(&str, f64)> =
        rows.iter().filter(|row| row[0] == "11").map(|row| (row[2], number(row[3]))).collect();
    assert_eq!(weights, [("5", 0.5), ("6", 0.5), ("7", 0.0), ("8", 0.0)]);
    for row in rows.iter().filter(|row| row[0] == "12") {
        assert_eq!(row[4..], ["1", "S2", "0.25", "0.5", "0"]);
    }
}

/// The sum of all areas, and the mean clearance by them; the range is said.
#[test]
fn a_lumped_pair_has_the_sum_of_the_areas_and_a_mean_whose_range_is_said() {
    let each = rows(&inpact(&["interfaces", WELD]));
    assert_eq!(each.len(), 26);
    let run = inpact(&["interfaces", WELD, "--lumped"]);
    let lumped = rows(&run);
    assert_eq!(lumped.len(), 2);
    assert_eq!(lumped[1][..3], ["UPPER-1.UNDERSIDE", "LOWER-1.TOP", "FAYING"]);
    let column = |name: &str| each[0].iter().position(|header| header == name).expect("the column");
    let (area, clearance) = (column("area"), column("clearance"));
    let sum: f64 = each[1..].iter().map(|row| number(&row[area])).sum();
    let moment: f64 = each[1..].iter().map(|row| number(&row[area]) * number(&row[clearance])).sum();
    assert!((number(&lumped[1][area]) - sum).abs() <= 1e-12 * sum);
    assert!((number(&lumped[1][clearance]) - moment / sum).abs() <= 1e-12 * moment / sum);
    let clearances = each[1..].iter().map(|row| number(&row[clearance]));
    let (least, largest) = clearances.fold((f64::MAX, f64::MIN), |(a, b), value| (a.min(value), b.max(value)));
    assert!(least < largest);
    let said =
        run.errors.lines().find(|line| line.contains("clearance: ") && line.contains("the mean by area of 25 nodes"));
    let said = said.expect("the mean and its range");
    let range = said.rsplit_once("from ").expect("a range").1.split_once(" to ").expect("to");
    assert!((number(range.0) - least).abs() < 1e-12 && (number(range.1) - largest).abs() < 1e-12, "{said}");
    assert!(run.errors.contains("1 closed and 24 open slave nodes are one interface"), "{}", run.errors);
}

/// `eval` takes the rows, and finds what it finds on the table of `nodes`; columns that it does not read are passed over.
#[test]
fn eval_takes_the_rows() {
    let of = |table: &Run| {
        let run = inpact_with_input(
            &["eval", WELD, "--nodes", "-", "--outputs", "thermal_conductance"],
            table.output.as_bytes(),
        );
        rows(&run).iter().skip(1).map(|row| row.last().expect("a cell").clone()).collect::<Vec<_>>()
    };
    assert_eq!(of(&inpact(&["interfaces", WELD])), of(&inpact(&["nodes", WELD])));
}

/// A scene takes both tables beside it.
#[test]
fn a_scene_takes_the_tables() {
    let folder = Folder::with(&[("a.inp", CUBES)]);
    let lumped = folder.inpact(&["interfaces", "a.inp", "--lumped", "-o", "lumped.csv"]);
    assert_eq!((lumped.code, lumped.output.as_str()), (0, ""), "{}", lumped.errors);
    assert_eq!(folder.inpact(&["interfaces", "a.inp", "-o", "each.csv"]).code, 0);
    let node = |name: &str, value: f64| format!("[[node]]\nname = \"{name}\"\ntemperature = {{ fixed = {value:?} }}\n");
    let scene = |table: &str, nodes: &str| format!("deck = \"a.inp\"\n{nodes}[[interface_file]]\nfile = \"{table}\"\n");
    folder.write("lumped.toml", &scene("lumped.csv", &(node("SLAVE", 100.0) + &node("MASTER", 20.0))));
    let nodes: String =
        ["11", "14"].iter().map(|name| node(name, 100.0) + &node(&format!("{name}@MASTER"), 20.0)).collect();
    folder.write("each.toml", &scene("each.csv", &nodes));
    let heat = |scene: &str| {
        let run = folder.inpact(&["solve", scene, "--interfaces", "i.csv"]);
        assert_eq!(run.code, 0, "{}", run.errors);
        let table = folder.read("i.csv");
        let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
        let at = lines.next().expect("a header").iter().position(|name| *name == "HFLA").expect("HFLA");
        lines.map(|row| number(row[at])).sum::<f64>()
    };
    // 7.5 by the table at 0.25, on half of the face.
    for scene in ["lumped.toml", "each.toml"] {
        assert!((heat(scene) - 7.5 * 0.5 * 80.0).abs() < 1e-9, "{scene}");
    }
}

/// As the rows of `nodes`: nothing is written over an input, and a deck without a pair has no interface.
#[test]
fn what_cannot_be() {
    let folder = Folder::with(&[("a.inp", CUBES), ("b.inp", "*NODE\n1, 0.\n")]);
    let run = folder.inpact(&["interfaces", "a.inp", "-o", "a.inp"]);
    assert_eq!(run.code, 2, "{}", run.errors);
    assert_eq!(folder.read("a.inp"), CUBES);
    let twice = folder.inpact(&["interfaces", "a.inp", "-o", "x.csv", "--projections", "x.csv"]);
    assert!(twice.code == 2 && twice.errors.contains("two results would go to `x.csv`"), "{}", twice.errors);
    let none = folder.inpact(&["interfaces", "b.inp"]);
    assert!(none.code == 1 && none.errors.contains("has no contact pair"), "{}", none.errors);
}

/// `--format json` says the same.
#[test]
fn the_summary_as_json() {
    let run = inpact(&["interfaces", WELD, "--lumped", "--format", "json"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    let last: serde_json::Value = serde_json::from_str(run.errors.lines().last().expect("a line")).expect("JSON");
    let pair = &last["summary"]["pairs"][0];
    assert_eq!((&last["summary"]["interfaces"], &pair["beside"]), (&1.into(), &serde_json::json!([])));
    assert_eq!(pair["lumped"]["means"]["clearance"]["nodes"], 25);
    assert_eq!((&pair["lumped"]["closed"], &pair["lumped"]["open"]), (&1.into(), &24.into()));
}
