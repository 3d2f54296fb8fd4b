//! `inpact check`: what a person sees, in every format, and the exit codes.

use crate::program::{Folder, inpact, inpact_with_input};

const FAULTY: &str = "decks/faulty/first-mistakes.inp";

#[test]
fn full() {
    insta::assert_snapshot!(inpact(&["check", FAULTY]).shown());
}

#[test]
fn concise() {
    insta::assert_snapshot!(inpact(&["check", "--format", "concise", FAULTY]).shown());
}

#[test]
fn json() {
    let run = inpact(&["check", "--format", "json", FAULTY]);
    for line in run.output.lines() {
        let record: serde_json::Value = serde_json::from_str(line).expect("an object a line");
        let fields: Vec<&str> = record.as_object().expect("an object").keys().map(String::as_str).collect();
        let expected = ["code", "column", "file", "help", "line", "message", "name", "severity", "span"];
        assert_eq!(fields, expected, "sorted by name");
    }
    insta::assert_snapshot!(run.shown());
}

#[test]
fn a_clean_deck_ends_with_0() {
    let run = inpact(&["check", "decks/fragments/minimal.inp"]);
    assert_eq!((run.code, run.output.as_str()), (0, ""), "{}", run.errors);
}

#[test]
fn several_decks_are_checked_in_the_order_given() {
    let folder =
        Folder::with(&[("b.inp", "*GAP CONDUCTNCE\n1., 0.\n"), ("c.inp", "*HEADING\n"), ("a.inp", "*FRICTIN\n")]);
    let of = |decks: &[&str]| folder.inpact(&[&["check", "--format", "concise"], decks].concat());
    let all = of(&["b.inp", "c.inp", "a.inp"]);
    assert!(all.output.starts_with("b.inp:1:2: error[K001] "), "{}", all.shown());
    assert_eq!((all.output, all.code), (of(&["b.inp"]).output + &of(&["a.inp"]).output, 1));
}

#[test]
fn standard_input_is_a_deck() {
    let run = inpact_with_input(&["check", "--format", "concise", "-"], b"*GAP CONDUCTNCE\n1., 0.\n");
    assert!(run.output.starts_with("-:1:2: error[K001] "), "{}", run.output);
    assert_eq!(run.code, 1);
}

#[test]
fn a_deck_that_cannot_be_read_ends_with_2_and_the_others_are_checked() {
    let run = inpact(&["check", "--format", "concise", "decks/no-such-deck.inp", FAULTY]);
    assert_eq!(run.code, 2);
    assert!(run.output.contains("error[T001]"), "{}", run.output);
    assert!(run.errors.contains("cannot read `decks/no-such-deck.inp`"), "{}", run.errors);
}

#[test]
fn wrong_usage_ends_with_2() {
    for arguments in [&["check"][..], &["check", "--format", "xml", FAULTY], &["frobnicate"], &[]] {
        let run = inpact(arguments);
        assert_eq!((run.code, run.output.as_str()), (2, ""), "{arguments:?}: {}", run.errors);
    }
}

#[test]
fn findings_go_to_a_file() {
    let folder = tempfile::tempdir().expect("a folder for the result");
    let target = folder.path().join("findings.txt");
    let run = inpact(&["check", "--format", "concise", FAULTY, "-o", target.to_str().expect("UTF-8")]);
    assert_eq!((run.code, run.output.as_str()), (1, ""));
    let written = std::fs::read_to_string(&target).expect("the file is there");
    assert_eq!(written, inpact(&["check", "--format", "concise", FAULTY]).output);
    assert_eq!(std::fs::read_dir(folder.path()).expect("readable").count(), 1, "nothing is left beside it");
    let run = inpact(&["check", FAULTY, "-o", "no-such-folder/findings.txt"]);
    assert_eq!(run.code, 2, "{}", run.errors);
}

#[cfg(unix)]
#[test]
fn a_closed_pipe_ends_quietly() {
    use std::process::{Command, Stdio};
    // Enough output that the pipe is full when nobody reads it.
    let decks = vec![FAULTY; 200];
    let mut child = Command::new(env!("CARGO_BIN_EXE_inpact-under-test"))
        .arg("check")
        .args(decks)
        .current_dir(crate::program::root())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("the program ends");
    assert_eq!((output.status.code(), String::from_utf8_lossy(&output.stderr).as_ref()), (Some(0), ""));
}
