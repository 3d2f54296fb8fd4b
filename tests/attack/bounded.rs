//! Short runs of the attacks, so that `cargo test` tells when files are no longer safe.

use std::path::Path;

const PROGRAM: &str = env!("CARGO_BIN_EXE_inpact-under-test");

#[cfg(unix)]
#[test]
fn runs_that_are_stopped_tear_nothing_and_leave_nothing() {
    let report = inpact_attack::stops::run(Path::new(PROGRAM), 60, 1);
    assert!(report.faults.is_empty(), "{:#?}\n{}", report.faults, report.text);
}

#[test]
fn the_edit_of_another_program_is_never_lost() {
    let report = inpact_attack::edits::run(Path::new(PROGRAM), 60, 1);
    assert!(report.faults.is_empty(), "{:#?}\n{}", report.faults, report.text);
}

#[test]
fn hostile_files_are_read_or_refused() {
    let report = inpact_attack::hostile::run(Path::new(PROGRAM), 120, 1);
    assert!(report.faults.is_empty(), "{:#?}\n{}", report.faults, report.text);
}
