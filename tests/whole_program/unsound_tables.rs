//! Node tables that are no sound Parquet or Arrow: exit code 2 and a message, never a panic, an abort or gigabytes.
//!
//! Many more are read in `inpact-evaluation`, `tests/nodes_mutated.rs`; these go through the whole program, where a panic in a
//! thread or memory that cannot be had would end it by a signal.

use crate::program::{Folder, Run, command, run};

const DECK: &str = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n20., 0.\n10., 0.1\n";

/// Evaluates with so much memory that no file of some kilobytes has a reason to want more.
fn eval(folder: &Folder, nodes: &str) -> Run {
    let arguments = ["eval", "a.inp", "--nodes", nodes, "--threads", "1"];
    let plain = command(folder.path(), &arguments);
    if !cfg!(target_os = "linux") {
        return run(plain, b"");
    }
    let mut limited = std::process::Command::new("prlimit");
    limited.arg(format!("--as={}", 512 << 20)).arg(plain.get_program()).args(arguments);
    limited.current_dir(folder.path()).env("NO_COLOR", "1");
    run(limited, b"")
}

#[test]
fn a_few_bytes_that_say_they_are_gigabytes_are_refused() {
    let parquet = |footer: u32| [b"PAR1".as_slice(), &[0; 12], &footer.to_le_bytes(), b"PAR1"].concat();
    let arrow = |footer: u32| [b"ARROW1\0\0".as_slice(), &[0; 16], &footer.to_le_bytes(), b"ARROW1"].concat();
    // A footer of Thrift whose schema, or whose groups of rows, would be a list of two thousand million.
    let list = |field: u8| {
        let footer = [field << 4 | 9, 0xFC, 0xFF, 0xFF, 0xFF, 0xFF, 0x07, 0];
        [b"PAR1".as_slice(), &footer, &8_u32.to_le_bytes(), b"PAR1"].concat()
    };
    let files: [(&str, Vec<u8>); 11] = [
        ("Arrow", vec![0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x7F]),
        ("Arrow", [vec![0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x7F], vec![0; 60]].concat()),
        ("Arrow", vec![0xFF, 0xFF, 0xFF, 0xFF, 0x10, 0, 0, 0, 1]),
        ("Arrow", b"ARROW1".to_vec()),
        ("Arrow", arrow(u32::MAX)),
        ("Arrow", arrow(i32::MAX as u32)),
        ("Parquet", b"PAR1".to_vec()),
        ("Parquet", parquet(u32::MAX)),
        ("Parquet", parquet(4)),
        ("Parquet", list(2)),
        ("Parquet", list(4)),
    ];
    for (kind, bytes) in files {
        let folder = Folder::with(&[("a.inp", DECK)]);
        std::fs::write(folder.path().join("nodes"), &bytes).expect("written");
        let run = eval(&folder, "nodes");
        assert_eq!(run.code, 2, "{bytes:?}: {}", run.shown());
        assert!(
            run.errors.starts_with(&format!("error: cannot read `nodes`: it is no sound {kind} table (")),
            "{}",
            run.errors
        );
        assert_eq!(run.errors.lines().count(), 1, "{}", run.errors);
    }
}

#[test]
fn sound_tables_with_lengths_that_are_not_true_are_refused_or_read() {
    let rows: String = (1..=200).map(|node| format!("n{node},0.0{node},{node},1\n")).collect();
    let folder = Folder::with(&[("a.inp", DECK), ("a.csv", &format!("node,clearance,epot_s,epot_m\n{rows}"))]);
    for table in ["a.parquet", "a.arrow"] {
        // A result has its node labels and columns of numbers: with another header it is a node table.
        let written = folder.inpact(&["eval", "a.inp", "--nodes", "a.csv", "-o", table]);
        assert_eq!(written.code, 0, "{}", written.shown());
        let sound = std::fs::read(folder.path().join(table)).expect("readable");
        let mut refused = 0;
        for place in 0..60 {
            // The ends of a file have what it says of itself.
            let at = sound.len() - 1 - place * sound.len().min(1200) / 60;
            for replaced in [[0xFF, 0xFF, 0xFF, 0x7F], [0x80, 0x80, 0x80, 0x80]] {
                let mut bytes = sound.clone();
                let end = (at + 4).min(bytes.len());
                bytes[at..end].copy_from_slice(&replaced[..end - at]);
                std::fs::write(folder.path().join("nodes"), &bytes).expect("written");
                let run = eval(&folder, "nodes");
                // 1 where it is a table, but not one that can be evaluated.
                assert!((0..=2).contains(&run.code), "byte {at} of {table}: {}", run.shown());
                assert!(!run.errors.contains("panicked"), "byte {at} of {table}: {}", run.shown());
                refused += usize::from(run.code == 2);
            }
        }
        assert!(refused > 0, "{table}: nothing that was said of it mattered");
    }
}
