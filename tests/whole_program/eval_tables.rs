//! `inpact eval` on node tables and result tables of every format, through files and standard streams.

use crate::program::{Folder, command, run};
use std::process::Stdio;

const DECK: &str = "\
*SURFACE INTERACTION, NAME=A
*GAP ELECTRICAL CONDUCTANCE
20., 0.
10., 0.1
";
const RESULT: &str = "\
node,ECD,SJD,WEIGHT,conductance,heat_s,heat_m,status
7,40,80,0.5,20,40,40,closed
8,30,60,0.5,15,30,30,open
9,20,40,0.5,10,20,20,beyond_table
";

fn nodes(separator: &str) -> String {
    "node,clearance,epot_s,epot_m\n7,-1e-3,3,1\n8,.05,3,1\n9,.2,3,1\n".replace(',', separator)
}

#[test]
fn semicolons_and_tabs_separate_cells_too() {
    for separator in [",", ";", "\t"] {
        let folder = Folder::with(&[("a.inp", DECK), ("a.csv", &nodes(separator))]);
        let run = folder.inpact(&["eval", "a.inp", "--nodes", "a.csv"]);
        assert_eq!((run.code, run.output.as_str()), (0, RESULT), "{}", run.errors);
    }
}

#[test]
fn a_decimal_comma_is_refused_with_what_to_do() {
    let folder = Folder::with(&[("a.inp", DECK), ("a.csv", "node;clearance\n1;0,5\n")]);
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "a.csv"]);
    assert_eq!((run.code, run.output.as_str()), (1, ""));
    let expected =
        "a.csv:2: error[D002] `clearance` of row 1 is `0,5`, which is no number (write numbers with a decimal point";
    assert!(run.errors.starts_with(expected), "{}", run.errors);
}

#[test]
fn a_quote_that_is_not_closed_is_refused() {
    let folder = Folder::with(&[("a.inp", DECK), ("a.csv", "node,clearance\n1,0\n\"2,0\n3,0\n")]);
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "a.csv"]);
    assert_eq!((run.code, run.output.as_str()), (1, ""));
    assert!(run.errors.contains("error[D002] a quote in row 2 is not closed"), "{}", run.errors);
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let mut table = "node,time,clearance,epot_s,epot_m\n".to_owned();
    for row in 0..30_000_u32 {
        table += &format!("{},{},{},{},1\n", row % 100, row / 100, f64::from(row % 7) / 60.0, f64::from(row) / 3.0);
    }
    let folder = Folder::with(&[("a.inp", DECK), ("a.csv", &table)]);
    let of = |threads| {
        folder.inpact(&["eval", "a.inp", "--nodes", "a.csv", "--procedure", "transient", "--threads", threads])
    };
    let one = of("1");
    assert_eq!((one.code, one.output.lines().count()), (0, 30_001), "{}", one.errors);
    for threads in ["2", "3", "8"] {
        assert!(of(threads).output == one.output, "{threads} threads");
    }
    assert_eq!(of("0").code, 2);
}

/// Turns a result table into another format: its columns are a node table that lacks what a law needs, but for `conductance`.
fn converted(folder: &Folder, format: &str) -> Vec<u8> {
    let arguments = ["eval", "a.inp", "--nodes", "a.csv", "--output-format", format, "-o", "-"];
    let output = command(folder.path(), &arguments).stdin(Stdio::null()).output().expect("the program starts");
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

#[test]
fn results_go_to_files_and_standard_output_in_every_format() {
    let folder = Folder::with(&[("a.inp", DECK), ("a.csv", &nodes(","))]);
    for (format, name, magic) in [
        ("csv", "r.csv", &b"node"[..]),
        ("parquet", "r.PARQUET", b"PAR1"),
        ("arrow", "r.arrow", b"ARROW1"),
        ("arrow", "r.feather", b"ARROW1"),
    ] {
        let bytes = converted(&folder, format);
        assert!(bytes.starts_with(magic), "{format}");
        let run = folder.inpact(&["eval", "a.inp", "--nodes", "a.csv", "-o", name]);
        assert_eq!((run.code, run.output.as_str()), (0, ""), "{}", run.errors);
        assert_eq!(std::fs::read(folder.path().join(name)).expect("written"), bytes, "{name}");
    }
    assert_eq!(folder.inpact(&["eval", "a.inp", "--nodes", "a.csv", "-o", "r.txt", "--output-format", "csv"]).code, 0);
    assert_eq!(folder.read("r.txt"), RESULT);
}

#[test]
fn tables_of_every_format_are_known_by_their_first_bytes() {
    // A result table has `node`, which is all that the plan needs to say that the rest is missing.
    let folder = Folder::with(&[("a.inp", DECK), ("a.csv", &nodes(","))]);
    for format in ["parquet", "arrow"] {
        let bytes = converted(&folder, format);
        std::fs::write(folder.path().join("table"), &bytes).expect("writable");
        for (nodes, input) in [("table", &b""[..]), ("-", bytes.as_slice())] {
            let run = run(command(folder.path(), &["plan", "a.inp", "--nodes", nodes]), input);
            assert!(
                run.output.contains("3 rows") && run.output.contains("conductance"),
                "{}{}",
                run.output,
                run.errors
            );
            let run = run_eval(&folder, nodes, input);
            assert_eq!(run.0, 1);
            assert!(run.1.contains("error[D001] `clearance` is missing"), "{}", run.1);
        }
    }
}

fn run_eval(folder: &Folder, nodes: &str, input: &[u8]) -> (i32, String) {
    let run = run(command(folder.path(), &["eval", "a.inp", "--nodes", nodes]), input);
    (run.code, run.errors)
}

#[test]
fn files_that_are_cut_short_cannot_be_read() {
    let folder = Folder::with(&[("a.inp", DECK), ("a.csv", &nodes(","))]);
    for (format, what) in [("parquet", "it is no sound Parquet table"), ("arrow", "it is no sound Arrow table")] {
        let bytes = converted(&folder, format);
        std::fs::write(folder.path().join("table"), &bytes[..bytes.len() / 2]).expect("writable");
        let (code, errors) = run_eval(&folder, "table", b"");
        assert_eq!(code, 2);
        assert!(errors.starts_with(&format!("error: cannot read `table`: {what}")), "{errors}");
    }
}
