//! `inpact plan`: what would be evaluated and what is left out, for a person and for a program.

use crate::program::{Folder, inpact};

fn plan(name: &str, format: &str) -> String {
    let (deck, nodes) = (format!("decks/{name}/{name}.inp"), format!("decks/{name}/{name}-nodes.csv"));
    let run = inpact(&["plan", &deck, "--nodes", &nodes, "--format", format]);
    assert_eq!((run.code, run.errors.as_str()), (0, ""));
    run.output
}

#[test]
fn spot_weld() {
    insta::assert_snapshot!("spot_weld_text", plan("spot-weld", "text"));
    insta::assert_snapshot!("spot_weld_json", plan("spot-weld", "json"));
}

#[test]
fn busbar_joint() {
    insta::assert_snapshot!("busbar_joint_text", plan("busbar-joint", "text"));
    insta::assert_snapshot!("busbar_joint_json", plan("busbar-joint", "json"));
}

#[test]
fn brake_disc() {
    insta::assert_snapshot!("brake_disc_text", plan("brake-disc", "text"));
    insta::assert_snapshot!("brake_disc_json", plan("brake-disc", "json"));
}

#[test]
fn retaining_wall() {
    insta::assert_snapshot!("retaining_wall_text", plan("retaining-wall", "text"));
    insta::assert_snapshot!("retaining_wall_json", plan("retaining-wall", "json"));
}

#[test]
fn the_plan_names_the_columns_that_eval_writes() {
    for name in ["spot-weld", "busbar-joint", "brake-disc", "retaining-wall"] {
        let plan: serde_json::Value = serde_json::from_str(&plan(name, "json")).expect("JSON");
        let outputs: Vec<&str> =
            plan["outputs"].as_array().expect("outputs").iter().filter_map(serde_json::Value::as_str).collect();
        let (deck, nodes) = (format!("decks/{name}/{name}.inp"), format!("decks/{name}/{name}-nodes.csv"));
        let run = inpact(&["eval", &deck, "--nodes", &nodes]);
        assert_eq!(run.output.lines().next(), Some(outputs.join(",").as_str()), "{name}");
    }
}

#[test]
fn what_the_rows_do_not_need_is_left_out_with_a_reason() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n20., 0., 300.\n10., .1, 300.\n\
                *GAP ELECTRICAL CONDUCTANCE, PRESSURE\n50., 0., 300.\n65., 100., 300.\n*SURFACE INTERACTION, NAME=B\n";
    let nodes = "node,interaction,clearance,pressure,temp,colour\n1,A,.1,0,300,3\n2,A,.2,0,300,3\n";
    let folder = Folder::with(&[("a.inp", deck), ("n.csv", nodes)]);
    let run = folder.inpact(&["plan", "a.inp", "--nodes", "n.csv"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    insta::assert_snapshot!(run.output);
}

#[test]
fn streams_and_files_are_as_for_eval() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n10., 0.\n";
    let folder = Folder::with(&[("a.inp", deck), ("n.csv", "node,clearance,pressure\n1,0,1\n")]);
    let run = folder.inpact_with_input(&["plan", "-", "--nodes", "-"], deck.as_bytes());
    assert_eq!((run.code, run.output.as_str()), (2, ""));
    let shown = folder.inpact(&["plan", "a.inp", "--nodes", "n.csv"]);
    let run = folder.inpact(&["plan", "a.inp", "--nodes", "n.csv", "-o", "plan.txt"]);
    assert_eq!((run.code, run.output.as_str(), folder.read("plan.txt")), (0, "", shown.output));
    folder.write("n.csv", "node,clearance,pressure\n1,0,x\n");
    assert_eq!(folder.inpact(&["plan", "a.inp", "--nodes", "n.csv"]).code, 1);
}

/// The cuts are the difference between the trees, for any outputs.
#[test]
fn the_cuts_add_up() {
    let options: [&[&str]; 5] = [
        &[],
        &["--outputs", "ECD,status"],
        &["--accuracy", "fast"],
        &["--accuracy", "reference"],
        &["--tolerance", "1e-9"],
    ];
    for name in ["spot-weld", "busbar-joint", "retaining-wall", "brake-disc"] {
        for option in options {
            let (deck, nodes) = (format!("decks/{name}/{name}.inp"), format!("decks/{name}/{name}-nodes.csv"));
            let run = inpact(&[&["plan", &deck, "--nodes", &nodes, "--format", "json"], option].concat());
            if run.code != 0 {
                // Not every sample has a current.
                assert!(option.contains(&"ECD,status"), "{name} {option:?}: {}", run.errors);
                continue;
            }
            let plan: serde_json::Value = serde_json::from_str(&run.output).expect("JSON");
            let number = |value: &serde_json::Value| value.as_f64().expect("a number");
            let cuts: f64 = plan["cuts"].as_array().expect("cuts").iter().map(|cut| number(&cut["saved"])).sum();
            let (before, after) = (number(&plan["before"]["cost"]), number(&plan["after"]["cost"]));
            assert!((before - cuts - after).abs() < 1e-9 * before, "{name} {option:?}: {before} - {cuts} = {after}");
        }
    }
}
