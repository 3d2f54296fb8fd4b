//! `inpact eval` with accuracy, tolerance and outputs by name: what a user trades, and what is said of it.

use crate::program::{Folder, inpact};

const DECK: &str = "decks/spot-weld/spot-weld.inp";
const NODES: &str = "decks/spot-weld/spot-weld-nodes.csv";

/// The numbers of a column of a result; NaN where a cell is empty.
fn numbers(csv: &str, name: &str) -> Vec<f64> {
    let mut lines = csv.lines();
    let place = lines.next().and_then(|header| header.split(',').position(|header| header == name));
    let place = place.expect("the column is there");
    lines.map(|line| line.split(',').nth(place).expect("a cell").parse().unwrap_or(f64::NAN)).collect()
}

fn eval(arguments: &[&str]) -> (String, String) {
    let run = inpact(&[&["eval", DECK, "--nodes", NODES], arguments].concat());
    assert_eq!(run.code, 0, "{}", run.errors);
    (run.output, run.errors)
}

#[test]
fn every_mode_keeps_its_word_on_a_sample() {
    let (reference, _) = eval(&["--accuracy", "reference"]);
    let reference = numbers(&reference, "conductance");
    let largest = reference.iter().fold(0.0_f64, |largest, value| largest.max(*value));
    let modes: [(&[&str], f64); 6] = [
        (&[], 1e-15),
        (&["--accuracy", "full"], 1e-15),
        (&["--accuracy", "fast"], 1e-4),
        (&["--tolerance", "1e-2"], 1e-2),
        (&["--tolerance", "1e-6"], 1e-6),
        (&["--tolerance", "1e-17"], 1e-15),
    ];
    for (arguments, tolerance) in modes {
        let (result, _) = eval(arguments);
        let found = numbers(&result, "conductance");
        for (found, reference) in found.iter().zip(&reference) {
            assert!((found - reference).abs() <= tolerance * largest, "{arguments:?}: {found} for {reference}");
        }
    }
}

#[test]
fn a_pointwise_tolerance_holds_at_every_row() {
    let (reference, _) = eval(&["--accuracy", "reference"]);
    let (result, _) = eval(&["--tolerance-relative", "1e-9"]);
    for (found, reference) in numbers(&result, "conductance").iter().zip(numbers(&reference, "conductance")) {
        assert!((found - reference).abs() <= 1e-9 * reference, "{found} for {reference}");
    }
}

#[test]
fn the_summary_says_mode_bound_and_largest_error_seen() {
    for (name, arguments) in [("reference", ["--accuracy", "reference"]), ("tolerance", ["--tolerance", "1e-4"])] {
        let (_, errors) = eval(&arguments);
        let of_interest: Vec<&str> = errors
            .lines()
            .filter(|line| line.contains("error at most") || line.contains("largest error seen"))
            .collect();
        insta::assert_snapshot!(format!("summary_{name}"), of_interest.join("\n"));
    }
}

#[test]
fn the_plan_says_why_a_form_was_not_chosen() {
    let run = inpact(&["plan", DECK, "--nodes", NODES, "--tolerance", "1e-12", "--outputs", "conductance"]);
    assert_eq!(run.code, 0, "{}", run.errors);
    let before_the_tree = run.output.split("\nbefore, ").next().unwrap_or_default();
    insta::assert_snapshot!(before_the_tree);
}

#[test]
fn outputs_by_name_are_all_that_comes_out() {
    let (result, _) = eval(&["--outputs", "sjd,ECD"]);
    assert_eq!(result.lines().next(), Some("node,interaction,time,ECD,SJD"));
    let (all, _) = eval(&[]);
    assert_eq!(numbers(&result, "ECD"), numbers(&all, "ECD"));
    assert_eq!(numbers(&result, "SJD"), numbers(&all, "SJD"));
}

#[test]
fn what_cannot_be_had_is_an_error() {
    let run = inpact(&["eval", DECK, "--nodes", NODES, "--outputs", "ECD,PFL"]);
    assert_eq!((run.code, run.output.as_str()), (1, ""));
    insta::assert_snapshot!(run.errors);
    let folder = Folder::with(&[
        ("a.inp", "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n10., 0.\n"),
        ("n.csv", "closed,pressure\n1,1\n"),
    ]);
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "n.csv", "--outputs", "ECD"]);
    assert_eq!(run.code, 1);
    assert!(
        run.errors
            .contains("`ECD` is asked for and cannot be given: `epot_s` and `epot_m` (or `epot_jump`) are missing"),
        "{}",
        run.errors
    );
}

#[test]
fn wrong_choices_are_wrong_usage() {
    let wrong: [&[&str]; 6] = [
        &["--accuracy", "exact"],
        &["--tolerance", "0"],
        &["--tolerance", "nan"],
        &["--tolerance", "1e-4", "--accuracy", "fast"],
        &["--tolerance", "1e-4", "--tolerance-relative", "1e-4"],
        &["--outputs", "ECD,current"],
    ];
    for arguments in wrong {
        let run = inpact(&[&["eval", DECK, "--nodes", NODES], arguments].concat());
        assert_eq!((run.code, run.output.as_str()), (2, ""), "{arguments:?}: {}", run.errors);
    }
}
