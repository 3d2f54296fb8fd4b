//! Limits of sizes, depths and counts: whoever goes over one is told which number it is, and how to go on.

use crate::program::{Folder, Run};

const TABLE: &str = "*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n 1., 0.\n";

fn check(files: &[(&str, &str)], arguments: &[&str], expected: &[&str]) -> Run {
    let run = Folder::with(files).inpact(arguments);
    let shown: String = run.shown().chars().take(2000).collect();
    assert_eq!(run.code, 1, "{shown}");
    let said = format!("{}{}", run.output, run.errors);
    for part in expected {
        assert!(said.contains(part), "{arguments:?}: {part}\n{}", said.chars().take(2000).collect::<String>());
    }
    run
}

#[test]
fn field_variables() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, DEPENDENCIES=1001\n1., 0.\n0., 1.\n";
    check(
        &[("a.inp", deck)],
        &["check", "--format", "json", "a.inp"],
        &["K010", "above the greatest legal value 1000", "write a value within"],
    );
}

/// The cell had no value, and nothing was said of it.
#[test]
fn values_that_do_not_fit_where_they_are_used() {
    let long = "1".repeat(1000);
    let deck = |uses: usize| {
        let uses = "<b>".repeat(uses);
        format!(
            "*PARAMETER\nb = '{long}'\n*SURFACE INTERACTION, NAME=A\n1.,\n{TABLE} {uses}, 1.\n*CONTACT PAIR, INTERACTION=A\nS, M\n"
        )
    };
    let (bytes, most) = (3 * 80, 16 * 3 * 80 + 65_536);
    let message = format!("these {bytes} bytes become more than {most} with the values of their parameters");
    check(
        &[("a.inp", &deck(80))],
        &["check", "--format", "json", "a.inp"],
        &["S016", &message, "write fewer parameters here"],
    );
    let nodes = "pressure,epot_s,epot_m\n0,1,0\n";
    let files = [("a.inp", &deck(80)[..]), ("n.csv", nodes)];
    check(&files, &["eval", "a.inp", "--nodes", "n.csv", "--format", "concise"], &["S016", &message]);
    let run = Folder::with(&[("a.inp", &deck(2))]).inpact(&["check", "--format", "json", "a.inp"]);
    assert!(!run.output.contains("S016"), "{}", run.shown());
}

#[test]
fn statements_of_parameters() {
    let deck = format!("*PARAMETER\na = '{}'\nb = {}1{}\n", "x".repeat(1025), "(".repeat(201), ")".repeat(201));
    check(
        &[("a.inp", &deck)],
        &["check", "--format", "json", "a.inp"],
        &[
            "a text of 1025 bytes is longer than the 1024 allowed",
            "in several parameters",
            "the expression is nested more than 200 deep",
            "compute parts of it in parameters of their own",
        ],
    );
}

/// Each text is short: all together are too long.
#[test]
fn texts_of_all_parameters() {
    let texts = 16 * 1024;
    let deck = |count: usize| {
        let copies: String = (1..count).map(|number| format!("t{number} = t0\n")).collect();
        format!("*PARAMETER\nt0 = '{}'\n{copies}", "x".repeat(1024))
    };
    let message = "the texts of all parameters are longer than the 16777216 bytes allowed";
    check(
        &[("a.inp", &deck(texts + 1))],
        &["check", "--format", "json", "a.inp"],
        &["S016", message, "leave out texts that nothing uses"],
    );
    let run = Folder::with(&[("a.inp", &deck(texts))]).inpact(&["check", "--format", "json", "a.inp"]);
    assert!(!run.output.contains("S016"), "{}", run.shown().chars().take(2000).collect::<String>());
}

#[test]
fn files_that_are_included_again() {
    let part = format!("*NODE\n{}", "1, 0., 0., 0.\n".repeat(40_000));
    let deck = "*INCLUDE, INPUT=b.inp\n".repeat(60);
    let read_once = part.len() + deck.len();
    let most = 16 * read_once + (16 << 20);
    let again = most / part.len() * part.len();
    assert!(again < most && most < 60 * part.len());
    let message =
        format!("files that are included more than once come to {again} bytes already, and {most} are the most");
    check(
        &[("a.inp", &deck), ("b.inp", &part)],
        &["check", "--format", "json", "a.inp"],
        &["S012", &message, "include it once"],
    );
}

#[test]
fn numbers_of_steps() {
    let json = |step: usize| {
        let deck = format!(
            "*SURFACE INTERACTION, NAME=A\n1.,\n{TABLE}*STEP\n*HEAT TRANSFER, STEADY STATE\n1., 1.\n*END STEP\n"
        );
        let folder = Folder::with(&[("a.inp", &deck)]);
        folder.inpact(&["json", "a.inp"]).output.replace("\"step\": 1", &format!("\"step\": {step}"))
    };
    let message = "expected the number of a step from 0 to 100000, found 100001";
    check(&[("a.json", &json(100_001))], &["inp", "a.json"], &["procedures[0].step", message]);
    let scene = "deck = \"a.inp\"\n[conditions]\nstep = 1000001\n[[node]]\nname = \"a\"\nset = \"S\"\n";
    check(
        &[("a.toml", scene), ("a.inp", &format!("*SURFACE INTERACTION, NAME=A\n1.,\n{TABLE}"))],
        &["solve", "a.toml"],
        &["`conditions.step` is 1000001", "from 1 to 1000000 at most"],
    );
}

#[test]
fn scenes() {
    let deck = format!("*SURFACE INTERACTION, NAME=A\n1.,\n{TABLE}");
    let deep = format!("deck = \"a.inp\"\nx = {}\n", "[".repeat(100_000));
    check(
        &[("a.toml", &deep), ("a.inp", &deck)],
        &["solve", "a.toml"],
        &["D011", "lists and tables lie more than 80 deep in one another", "close each where it ends"],
    );
    let time = "deck = \"a.inp\"\nprocedure = \"transient\"\n[time]\nend = 1.0\nstep = 1e-9\n";
    check(
        &[("a.toml", time), ("a.inp", &deck)],
        &["solve", "a.toml"],
        &["makes 1000000000 increments, more than 10000000", "give a longer `step`"],
    );
}

#[test]
fn lines() {
    let deck = format!("*HEADING\n{}", "x".repeat((16 << 20) + 1));
    let run = Folder::with(&[("a.inp", &deck)]).inpact(&["check", "--format", "json", "a.inp"]);
    assert_eq!(run.code, 2, "{}", run.shown());
    assert!(
        run.errors.contains("line 2 is longer than 16777216 bytes, the most that a line may have"),
        "{}",
        run.errors
    );
}

/// A quote that is never closed.
#[test]
fn rows_of_node_tables() {
    let deck = format!("*SURFACE INTERACTION, NAME=A\n1.,\n{TABLE}");
    let table = format!("pressure,epot_s,epot_m\n\"{}", "1,1,1\n".repeat(12_000_000));
    check(
        &[("a.inp", &deck), ("n.csv", &table)],
        &["eval", "a.inp", "--nodes", "n.csv"],
        &["row 1 is longer than 67108864 bytes, the most that a row may have", "close the quote"],
    );
}
