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

#[test]
fn the_order_of_rows_changes_no_history() {
    const NODES: u32 = 60_000;
    let row = |node: u32, time: u32| {
        let jump = 1.0 + f64::from(node % 11) + 0.5 * f64::from(time);
        format!("{node},{time},{},{jump},0\n", f64::from((node + time) % 7) / 60.0)
    };
    let header = "node,time,clearance,epot_s,epot_m\n";
    let pairs = |interleaved: bool| {
        let (nodes, times): (Vec<u32>, [u32; 2]) = ((1..=NODES).collect(), [1, 2]);
        if interleaved {
            times.iter().flat_map(|time| nodes.iter().map(|node| row(*node, *time))).collect::<String>()
        } else {
            nodes.iter().flat_map(|node| times.iter().map(|time| row(*node, *time))).collect::<String>()
        }
    };
    let folder = Folder::with(&[
        ("a.inp", DECK),
        ("by_node.csv", &(header.to_owned() + &pairs(false))),
        ("by_time.csv", &(header.to_owned() + &pairs(true))),
    ]);
    let sorted = |nodes| {
        let arguments = ["eval", "a.inp", "--nodes", nodes, "--procedure", "transient", "--outputs", "ECD,ECDT,SJDT"];
        let run = folder.inpact(&arguments);
        assert_eq!(run.code, 0, "{}", run.errors);
        let mut lines: Vec<String> = run.output.lines().map(str::to_owned).collect();
        assert!(lines[0].contains("ECDT"), "{}", lines[0]);
        lines.sort_unstable();
        lines
    };
    let by_node = sorted("by_node.csv");
    assert_eq!(by_node.len(), 2 * NODES as usize + 1);
    assert!(by_node == sorted("by_time.csv"));
    let plan = |nodes| folder.inpact(&["plan", "a.inp", "--nodes", nodes, "--procedure", "transient"]).output;
    assert_eq!(plan("by_node.csv").replace("by_node", "by_time"), plan("by_time.csv"));
}

#[test]
fn a_time_that_falls_back_is_found_in_both_orders() {
    let table = |rows: &str| format!("node,time,clearance,epot_s,epot_m\n{rows}");
    let folder = Folder::with(&[
        ("a.inp", DECK),
        ("by_node.csv", &table("1,1,0,1,0\n1,2,0,1,0\n2,2,0,1,0\n2,1,0,1,0\n")),
        ("by_time.csv", &table("1,1,0,1,0\n2,2,0,1,0\n1,2,0,1,0\n2,1,0,1,0\n")),
    ]);
    for nodes in ["by_node.csv", "by_time.csv"] {
        let run = folder.inpact(&["eval", "a.inp", "--nodes", nodes, "--procedure", "transient"]);
        assert_eq!((run.code, run.output.as_str()), (1, ""));
        let expected =
            format!("{nodes}:5: error[D006] `time` of node `2` is 1.0 in row 4 and 2.0 in the row before it");
        assert!(run.errors.starts_with(&expected), "{}", run.errors);
        assert_eq!(run.errors.matches("D006").count(), 1, "{}", run.errors);
    }
}

#[test]
fn a_time_that_is_no_number_is_wrong_in_the_data() {
    let folder = Folder::with(&[("a.inp", DECK), ("a.csv", "node,time,clearance\n1,0,0\n1,late,0\n")]);
    for format in ["csv", "parquet", "arrow"] {
        let run = folder.inpact(&["eval", "a.inp", "--nodes", "a.csv", "--output-format", format, "-o", "result"]);
        assert_eq!((run.code, run.output.as_str()), (1, ""));
        let expected = "a.csv:3: error[D002] `time` of row 2 is `late`, which is no number";
        assert!(run.errors.starts_with(expected), "{}", run.errors);
        assert!(!folder.path().join("result").exists());
    }
}

#[test]
fn a_label_that_is_no_text_is_written_as_it_is_or_refused() {
    let folder = Folder::with(&[("a.inp", DECK)]);
    std::fs::write(folder.path().join("a.csv"), b"node,clearance\n\xFF,0\n").expect("writable");
    let of = |format| {
        let arguments = ["eval", "a.inp", "--nodes", "a.csv", "--output-format", format, "-o", "result"];
        folder.inpact(&arguments)
    };
    let run = of("parquet");
    assert_eq!(run.code, 1);
    assert!(run.errors.contains("`a.csv` cannot be written in this format: `node` of row 1"), "{}", run.errors);
    assert!(!folder.path().join("result").exists());
    assert_eq!(of("csv").code, 0);
    let written = std::fs::read(folder.path().join("result")).expect("written");
    assert!(written.windows(3).any(|bytes| bytes == b"\n\xFF,"));
}

#[cfg(unix)]
#[test]
fn a_named_pipe_is_read_like_a_file() {
    let folder = Folder::with(&[("a.inp", DECK)]);
    let pipe = folder.path().join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status().expect("mkfifo is there");
    assert!(made.success());
    let writer = std::thread::spawn(move || std::fs::write(pipe, nodes(",")));
    let run = folder.inpact(&["eval", "a.inp", "--nodes", "pipe"]);
    assert_eq!((run.code, run.output.as_str()), (0, RESULT), "{}", run.errors);
    writer.join().expect("no panic").expect("written");
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
