//! `inpact eval` on the sample decks, and what goes in and comes out by which stream and option.

use crate::program::{Folder, Run, inpact, root};

const DECK: &str = "\
*SURFACE INTERACTION, NAME=A
*GAP ELECTRICAL CONDUCTANCE
20., 0.
10., 0.1
";
const NODES: &str = "node,clearance,epot_s,epot_m\n7,-1e-3,3,1\n8,.05,3,1\n9,.2,3,1\n";
const RESULT: &str = "\
node,ECD,SJD,WEIGHT,conductance,heat_s,heat_m,status
7,40,80,0.5,20,40,40,closed
8,30,60,0.5,15,30,30,open
9,20,40,0.5,10,20,20,beyond_table
";

fn scene() -> Folder {
    Folder::with(&[("a.inp", DECK), ("a.csv", NODES)])
}

/// Standard error of a run, without the time it took.
fn summary(run: &Run) -> String {
    let untimed = |line: &str| match line.rsplit_once(", ") {
        Some((before, time)) if time.ends_with(" s") => format!("{before}, TIME s\n"),
        _ => format!("{line}\n"),
    };
    run.errors.lines().map(untimed).collect()
}

/// Evaluates a sample: as many rows out as in, with the same keys in the same order.
/// Gives the header, the first rows, every sixtieth row after them, and the summary.
fn sample(name: &str) -> String {
    let (deck, nodes) = (format!("decks/{name}/{name}.inp"), format!("decks/{name}/{name}-nodes.csv"));
    let run = inpact(&["eval", &deck, "--nodes", &nodes]);
    assert_eq!(run.code, 0, "{}", run.errors);
    let table = std::fs::read_to_string(root().join(&nodes)).expect("readable");
    let keys = |text: &str| -> Vec<Vec<String>> {
        let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
        let header = lines.next().expect("a header");
        let places: Vec<usize> = ["node", "interaction", "time"]
            .iter()
            .filter_map(|key| header.iter().position(|column| column == key))
            .collect();
        lines
            .map(|cells| {
                assert_eq!(cells.len(), header.len());
                places.iter().map(|place| cells[*place].clone()).collect()
            })
            .collect()
    };
    assert_eq!(keys(&run.output), keys(&table));
    let shown = run.output.lines().enumerate().filter(|(line, _)| *line < 12 || line % 60 == 0);
    let shown: String = shown.map(|(_, line)| format!("{line}\n")).collect();
    format!("{shown}--- standard error\n{}", summary(&run))
}

#[test]
fn spot_weld() {
    insta::assert_snapshot!(sample("spot-weld"));
}

#[test]
fn busbar_joint() {
    insta::assert_snapshot!(sample("busbar-joint"));
}

#[test]
fn brake_disc() {
    insta::assert_snapshot!(sample("brake-disc"));
}

#[test]
fn retaining_wall() {
    insta::assert_snapshot!(sample("retaining-wall"));
}

#[test]
fn deck_or_nodes_may_come_from_standard_input_but_not_both() {
    let folder = scene();
    let run = folder.inpact_with_input(&["eval", "-", "--nodes", "a.csv"], DECK.as_bytes());
    assert_eq!((run.code, run.output.as_str()), (0, RESULT), "{}", run.errors);
    let run = folder.inpact_with_input(&["eval", "a.inp", "--nodes", "-"], NODES.as_bytes());
    assert_eq!((run.code, run.output.as_str()), (0, RESULT), "{}", run.errors);
    let run = folder.inpact_with_input(&["eval", "-", "--nodes", "-"], DECK.as_bytes());
    assert_eq!((run.code, run.output.as_str()), (2, ""), "{}", run.errors);
    assert!(run.errors.contains("cannot both be read from standard input"), "{}", run.errors);
}

#[test]
fn the_result_goes_to_a_file() {
    let folder = scene();
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "a.csv", "-o", "result.csv"]);
    assert_eq!((run.code, run.output.as_str()), (0, ""), "{}", run.errors);
    assert_eq!(folder.read("result.csv"), RESULT);
    assert_eq!(folder.names(), ["a.csv", "a.inp", "result.csv"], "nothing is left beside it");
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "a.csv", "-o", "nowhere/result.csv"]);
    assert_eq!((run.code, run.output.as_str()), (2, ""), "{}", run.errors);
}

#[test]
fn what_cannot_be_read_and_wrong_usage_end_with_2() {
    let folder = scene();
    let cases: [&[&str]; 6] = [
        &["eval", "a.inp"],
        &["eval", "nothing.inp", "--nodes", "a.csv"],
        &["eval", "a.inp", "--nodes", "nothing.csv"],
        &["eval", "a.inp", "--nodes", "a.csv", "--clearance-tail", "linear"],
        &["eval", "a.inp", "--nodes", "a.csv", "--procedure", "static"],
        &["eval", "a.inp", "--nodes", "a.csv", "--char-length", "wide"],
    ];
    for arguments in cases {
        let run = folder.inpact(arguments);
        assert_eq!((run.code, run.output.as_str()), (2, ""), "{arguments:?}: {}", run.errors);
        assert!(!run.errors.is_empty(), "{arguments:?}");
    }
}

#[test]
fn the_summary_as_text_and_as_json() {
    let folder = scene();
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "a.csv"]);
    insta::assert_snapshot!(summary(&run));
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "a.csv", "--format", "json"]);
    assert_eq!(run.output, RESULT);
    let records: Vec<serde_json::Value> =
        run.errors.lines().map(|line| serde_json::from_str(line).expect("an object a line")).collect();
    assert_eq!(records.len(), 2);
    assert_eq!((records[0]["code"].as_str(), records[0]["field"].as_str()), (Some("D007"), Some("clearance")));
    let summary = &records[1]["summary"];
    assert_eq!((summary["rows_in"].as_u64(), summary["rows_out"].as_u64()), (Some(3), Some(3)));
    let of = &summary["interactions"][0];
    assert_eq!((of["name"].as_str(), of["closed"].as_u64(), of["open"].as_u64()), (Some("A"), Some(1), Some(2)));
    assert_eq!(of["beyond_table"].as_u64(), Some(1));
}

#[test]
fn headers_are_read_without_case_by_their_aliases_after_a_byte_order_mark() {
    let folder = scene();
    folder.write("b.csv", "\u{FEFF}Node,COPEN,EPOT_S,Epot_M\r\n7,-1e-3,3,1\r\n8,.05,3,1\r\n9,.2,3,1\r\n");
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "b.csv"]);
    // The keys keep the names that the contract gives them.
    assert_eq!((run.code, run.output.as_str()), (0, RESULT), "{}", run.errors);
}

#[test]
fn a_table_without_rows_gives_a_result_without_rows() {
    let folder = scene();
    folder.write("none.csv", "node,clearance,epot_s,epot_m\n");
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "none.csv"]);
    let header = RESULT.lines().next().expect("a header");
    assert_eq!((run.code, run.output.trim_end()), (0, header), "{}", run.errors);
    assert!(run.errors.contains("0 rows in, 0 rows out"), "{}", run.errors);
}

#[test]
fn one_of_several_interactions_is_chosen_by_option_or_column() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n10., 0.\n\
                *SURFACE INTERACTION, NAME=Steel Gap\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n20., 0.\n";
    let nodes = "node,clearance,pressure\n1,0,1\n";
    let folder = Folder::with(&[("two.inp", deck), ("n.csv", nodes)]);
    let conductance = |name: &str| {
        let run = folder.inpact(&["eval", "two.inp", "--nodes", "n.csv", "--interaction", name]);
        assert_eq!(run.code, 0, "{}", run.errors);
        run.output
    };
    assert_eq!(conductance("A"), "node,WEIGHT,conductance,status\n1,0.5,10,closed\n");
    // labels are compared without blanks and case.
    assert_eq!(conductance("steelgap"), "node,WEIGHT,conductance,status\n1,0.5,20,closed\n");
    folder.write("n.csv", "node,interaction,clearance,pressure\n1,steel gap,0,1\n2,A,0,1\n1,STEELGAP,0,1\n");
    let run = folder.inpact(&["eval", "two.inp", "--nodes", "n.csv"]);
    let rows: Vec<&str> = run.output.lines().skip(1).collect();
    assert_eq!(rows, ["1,steel gap,0.5,20,closed", "2,A,0.5,10,closed", "1,STEELGAP,0.5,20,closed"], "{}", run.errors);
}

#[test]
fn the_procedure_of_the_deck_decides_unless_it_is_given() {
    let step = |procedure: &str| {
        format!(
            "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n3., 0.\n*STEP\n{procedure}\n1., 1.\n*END STEP\n"
        )
    };
    let folder = Folder::with(&[
        ("steady.inp", &step("*COUPLED THERMAL-ELECTRICAL, STEADY STATE")),
        ("transient.inp", &step("*COUPLED THERMAL-ELECTRICAL")),
        ("n.csv", "node,time,clearance,pressure,epot_jump\n1,0,0,0,2\n1,1,0,0,5\n"),
    ]);
    let last_heat = |arguments: &[&str]| {
        let run = folder.inpact(&[&["eval", "--nodes", "n.csv"], arguments].concat());
        assert_eq!(run.code, 0, "{}", run.errors);
        let header: Vec<&str> = run.output.lines().next().expect("a header").split(',').collect();
        let column = header.iter().position(|name| *name == "SJD").expect("SJD");
        run.output.lines().last().expect("a row").split(',').nth(column).expect("a cell").to_owned()
    };
    assert_eq!(last_heat(&["steady.inp"]), "75", "H-07: 3 (5)^2");
    assert_eq!(last_heat(&["transient.inp"]), "39", "H-08: 25 + 10 + 4");
    assert_eq!(last_heat(&["steady.inp", "--procedure", "transient"]), "39");
    assert_eq!(last_heat(&["transient.inp", "--procedure", "steady"]), "75");
}

#[test]
fn columns_stand_in_any_order_and_labels_may_hold_commas() {
    let folder = scene();
    // A given jump is used, as the difference would lose its digits.
    folder.write("n.csv", "epot_jump,clearance,node,epot_s,epot_m,remark\n2,.05,\"PART-1,8\",5,5,\"a, b\"\n");
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "n.csv"]);
    let header = RESULT.lines().next().expect("a header");
    assert_eq!(run.output, format!("{header}\n\"PART-1,8\",30,60,0.5,15,30,30,open\n"), "{}", run.errors);
}
