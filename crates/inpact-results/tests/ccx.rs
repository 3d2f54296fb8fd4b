//! Both result files of CalculiX for a deck of ours agree, number by number.
//!
//! Without ccx the comparison does nothing and says so; where `INPACT_REQUIRE_CCX` is set, as in the gate, it fails instead.

use inpact_results::{Format, Results, read};
use std::process::Command;

/// Content of `.frd` and `.dat` after a run of `tests/data/pair.inp`; `None` without ccx.
#[expect(clippy::print_stderr, reason = "whoever runs the tests must learn that nothing was compared")]
fn run() -> Option<[Vec<u8>; 2]> {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("pair.inp"), include_str!("data/pair.inp")).expect("a file");
    match Command::new("ccx").arg("pair").current_dir(folder.path()).output() {
        Ok(output) if output.status.success() => {
            Some(["pair.frd", "pair.dat"].map(|name| std::fs::read(folder.path().join(name)).expect("written by ccx")))
        }
        Ok(output) => panic!("{}", String::from_utf8_lossy(&output.stdout)),
        Err(error) => {
            assert!(std::env::var_os("INPACT_REQUIRE_CCX").is_none(), "ccx: {error}");
            eprintln!("SKIPPED, nothing was compared with CalculiX: ccx: {error}");
            None
        }
    }
}

/// The value of a node in one of the steps.
fn value(results: &Results, step: usize, column: &str, node: i64) -> f64 {
    let (field, values) = results.frames[step].column(column).unwrap_or_else(|| panic!("no `{column}`"));
    let row = field.rows.nodes().expect("nodes").iter().position(|label| *label == node).expect("the node");
    values.values[row]
}

/// Half a unit of the sixth digit, which is the last of a `.frd`, and of the seventh, which is the last of a `.dat`.
fn close(frd: f64, dat: f64) -> bool {
    let size = frd.abs().max(dat.abs());
    size == 0.0 || (frd - dat).abs() <= 0.55e-5 * 10.0_f64.powf(size.log10().floor())
}

#[test]
fn both_files_of_ccx_say_the_same() {
    let Some([frd, dat]) = run() else { return };
    let [frd, dat] = [frd, dat].map(|bytes| read(&bytes).expect("whole"));
    assert_eq!((frd.format, dat.format), (Format::Frd, Format::Dat));
    let mut compared = 0;
    for results in [&frd, &dat] {
        let times: Vec<_> = results.frames.iter().map(|frame| frame.total_time).collect();
        assert_eq!(times, [Some(1.0), Some(2.0)]);
    }
    assert_eq!(frd.frames[1].step, Some(2));
    let all: Vec<i64> = (1..=8).chain(11..=18).collect();
    for step in [0, 1] {
        for (columns, nodes) in [
            (&["COPEN", "CSLIP1", "CSLIP2", "CPRESS", "CSHEAR1", "CSHEAR2"][..], &[11, 12, 13, 14][..]),
            (&["U1", "U2", "U3", "NT11"], &all),
            (&["RF1", "RF2", "RF3", "RFL11"], &[15, 16, 17, 18]),
        ] {
            for column in columns {
                for node in nodes {
                    let [frd, dat] = [&frd, &dat].map(|results| value(results, step, column, *node));
                    assert!(close(frd, dat), "{column} of node {node} in step {}: {frd} and {dat}", step + 1);
                    compared += 1;
                }
            }
        }
        // Closed, pressed by the upper block, and heat flows into it.
        assert!(value(&dat, step, "COPEN", 11) < 0.0 && 0.0 < value(&dat, step, "CPRESS", 11));
        assert!(0.0 < value(&dat, step, "RFL11", 15));
    }
    assert_eq!(compared, 2 * (6 * 4 + 4 * 16 + 4 * 4));
    assert!(value(&dat, 0, "CPRESS", 11) < value(&dat, 1, "CPRESS", 11));
    assert_eq!((value(&frd, 0, "NT11", 15), value(&frd, 1, "NT11", 15)), (100.0, 150.0));
}
