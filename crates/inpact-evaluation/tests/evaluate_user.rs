//! *GAP ELECTRICAL CONDUCTANCE, USER with routines written in Rust: what they are called with, and what becomes of their answers.

mod evaluate_support;

use evaluate_support::{Run, evaluate, evaluate_with};
use inpact_evaluation::law::{
    UserConductance, UserConductancePoint, UserConductanceValue, UserFault, UserLaw, UserNames,
};
use inpact_evaluation::nodes::Column;
use inpact_evaluation::plan::{Choices, Derivatives};
use inpact_evaluation::results::Output;
use inpact_evaluation::{Accuracy, Wanted};
use std::fmt::Write;
use std::sync::{Arc, Mutex};

const DECK: &str = "\
*SURFACE INTERACTION, NAME=Weld Face
*GAP ELECTRICAL CONDUCTANCE, USER
*GAP HEAT GENERATION
0.8, 0.25
*CONTACT PAIR, INTERACTION=Weld Face
tip, \"Sheet Top\"
";

/// Notes what it is called with; σ = 100 − 10 d + θ_A + 2 θ_B, below zero where d is large.
#[derive(Clone, Default)]
struct Linear {
    calls: Arc<Mutex<String>>,
}

impl UserConductance for Linear {
    fn conductance(&self, point: &UserConductancePoint<'_>) -> Result<UserConductanceValue, UserFault> {
        let UserConductancePoint { clearance, temperatures, field_variables, time, names, coordinates, .. } = point;
        let UserNames { interaction, slave, master } = names;
        let mut calls = self.calls.lock().expect("no call panicked");
        writeln!(
            calls,
            "d {clearance:?} temp {temperatures:?} predef {field_variables:?} time {time:?} names {interaction:?} \
             {slave:?} {master:?} coords {coordinates:?} node {} step {} inc {}",
            point.node, point.step, point.increment
        )
        .expect("a string takes all");
        if *clearance == 99.0 {
            return Err(UserFault::Refused("does not like it".to_owned()));
        }
        let conductance = 100.0 - 10.0 * clearance + temperatures[0] + 2.0 * temperatures[1];
        Ok(UserConductanceValue { conductance, slopes: [1.0, 2.0] })
    }
}

fn run_with(deck: &str, nodes: &str, derivatives: Derivatives, rows_of_a_batch: usize) -> (Run, String) {
    let law = Linear::default();
    let calls = law.calls.clone();
    let choices = Choices { user_conductance: Some(UserLaw::new(law)), derivatives, ..Choices::default() };
    let run = evaluate_with(deck, nodes, &choices, rows_of_a_batch);
    let calls = calls.lock().expect("no call panicked").clone();
    (run, calls)
}

fn run(nodes: &str) -> (Run, String) {
    run_with(DECK, nodes, Derivatives::Given, 1024)
}

#[test]
fn a_routine_is_called_with_all_the_table_has_once_a_row_in_order() {
    let nodes = "node,time,step,kinc,step_time,clearance,nt11_s,nt11_m,fv1_s,fv1_m,fv2,fv4,x_s,y_s,z_s,x_m,COOR2_m,z_m,\
                 epot_s,epot_m,area\n\
                 7,1,2,1,0.5,0,20,30,1,2,5,0,1,2,3,4,5,6,1,0,2\n\
                 A.8,1,2,1,0.5,0.5,40,50,3,4,6,0,1,2,3,4,5,6,1,0,2\n\
                 7,2,2,2,1.5,1,60,70,5,6,7,0,1,2,3,4,5,6,2,0,2\n";
    let (run, calls) = run(nodes);
    insta::assert_snapshot!("calls", calls);
    insta::assert_snapshot!("plan", run.plan_text());
    assert_eq!(run.findings, Vec::<String>::new());
    // 100 − 10 d + θ_A + 2 θ_B.
    assert_eq!(run.numbers("conductance"), [180.0, 235.0, 290.0]);
    assert_eq!(run.numbers("dconductance_dtemp"), [3.0; 3]);
    assert_eq!(run.column("status"), ["closed", "open", "open"]);
    assert_eq!(run.numbers("ECD"), [180.0, 235.0, 580.0]);
    assert_eq!(run.numbers("ECDA"), [360.0, 470.0, 1160.0]);
    // Backward Euler over one unit of time, from 0 in a node's first row.
    assert_eq!(run.numbers("ECDT"), [0.0, 0.0, 580.0]);
    // η σ Δφ², with η = 0.8 and a quarter of it into the slave.
    assert_eq!(run.numbers("SJD"), [144.0, 188.0, 928.0]);
    assert_eq!(run.numbers("heat_s"), [36.0, 47.0, 232.0]);
    let tally = run.tally.expect("the table is right").whole();
    assert_eq!((tally.unnumbered_nodes, tally.incomplete, tally.user_faults), (1, 0, 0));
    for rows_of_a_batch in [1, 2] {
        assert_eq!(run_with(DECK, nodes, Derivatives::Given, rows_of_a_batch).1, calls);
    }
}

#[test]
fn what_the_table_lacks_has_a_default_and_the_plan_says_so() {
    let deck = format!("{DECK}other, tip\n*SURFACE, NAME=x\n");
    let (run, calls) = run_with(&deck, "clearance,temp,x_s\n0.5,20,7\n", Derivatives::LeftOut, 1024);
    insta::assert_snapshot!("defaults", format!("{calls}\n{}", run.plan_text()));
    assert_eq!(run.header(), "WEIGHT,conductance,status");
}

#[test]
fn a_row_that_lacks_what_the_routine_is_called_with_has_no_results() {
    let nodes = "clearance,temp,temp_s,temp_m,fv1,pressure\n0,,1,2,1,0\n,,1,2,1,5\n0,,1,,1,0\n0,9,1,,1,0\n0,,1,2,,0\n\
                 nan,,1,2,1,0\n0,,nan,2,1,0\n";
    let (run, calls) = run(nodes);
    assert_eq!(run.column("conductance"), ["105", "", "", "127", "", "NaN", "NaN"]);
    assert_eq!(calls.lines().count(), 2, "neither an empty cell nor a NaN reaches the routine: {calls}");
    assert_eq!(run.tally.expect("the table is right").whole().incomplete, 3);
}

#[test]
fn without_clearance_or_temperature_there_is_no_law() {
    for (nodes, missing) in [
        ("temp,pressure\n1,1\n", "`clearance` is missing"),
        ("clearance,temp_s\n1,1\n", "`temp_m` (or `temp`) is missing"),
        ("clearance,temp\n1,\n", "`temp_s` and `temp_m` (or `temp`) are missing"),
    ] {
        let (run, calls) = run(nodes);
        assert_eq!(calls, "");
        assert!(run.findings[0].contains(missing), "{nodes}: {:?}", run.findings);
    }
}

#[test]
fn without_a_routine_the_plan_says_how_to_give_one() {
    let run = evaluate(DECK, "clearance,temp\n0,20\n");
    let cure = "without electrical law: needs user subroutine GAPELECTR; give it with `--user-library FILE`";
    assert!(run.plan_text().contains(cure), "{}", run.plan_text());
}

#[test]
fn a_fault_is_told_with_its_row_and_the_row_has_no_results() {
    let (run, _) = run("node,clearance,temp,epot_jump\n1,0,0,1\n2,99,0,1\n3,20,0,1\n");
    assert_eq!(run.column("conductance"), ["100", "", ""]);
    assert_eq!(run.column("ECD"), ["100", "", ""]);
    assert_eq!(run.column("status"), ["closed", "", ""]);
    let mut findings = inpact_evaluation::nodes::Findings::new("nodes.csv");
    run.tally.expect("the table is right").report_user_faults(&mut findings);
    let found: Vec<_> =
        findings.into_list().into_iter().map(|found| (found.code, found.primary.line(), found.message)).collect();
    let message = |what: &str| format!("user subroutine GAPELECTR {what}");
    assert_eq!(
        found,
        [
            ("D010", Some(3), message("does not like it in row 2, clearance 99.0")),
            ("D010", Some(4), message("gives a conductance below zero, SIGMA(1) = -100.0 in row 3, clearance 20.0")),
        ]
    );
}

#[test]
fn of_many_faults_the_first_twenty_are_told_and_all_are_counted() {
    let rows = "99,0\n".repeat(1000);
    let (run, _) = run(&format!("clearance,temp\n{rows}"));
    let tally = run.tally.expect("the table is right");
    assert_eq!((tally.whole().user_faults, tally.user_faults.len()), (1000, 20));
    let mut findings = inpact_evaluation::nodes::Findings::new("nodes.csv");
    tally.report_user_faults(&mut findings);
    assert_eq!(
        findings.into_list()[0].help.as_deref(),
        Some("in 1000 rows, all told: mend the routine, and compile it again")
    );
}

#[test]
fn steps_and_increments_are_whole_numbers() {
    for (value, is_right) in [("1", true), ("2.0", true), ("1.5", false), ("3e9", false), ("nan", false), ("", true)] {
        let (run, _) = run(&format!("clearance,temp,step\n0,1,1\n0,1,{value}\n"));
        assert_eq!(run.findings.is_empty(), is_right, "{value}: {:?}", run.findings);
        if !is_right {
            assert!(run.findings[0].starts_with("3:step: error[D002"), "{:?}", run.findings);
        }
    }
}

#[test]
fn tables_beside_user_are_ignored_and_another_interaction_keeps_its_own() {
    let deck = format!("{DECK}*SURFACE INTERACTION, NAME=B\n*GAP ELECTRICAL CONDUCTANCE\n5., 0.\n4., 1.\n");
    let (run, calls) =
        run_with(&deck, "interaction,clearance,temp\nB,0,1\nweldface,0,1\nb,0.5,1\n", Derivatives::Given, 1024);
    assert_eq!(run.column("conductance"), ["5", "103", "4.5"]);
    assert_eq!(run.column("dconductance_dtemp"), ["", "3", ""]);
    assert_eq!(run.column("dconductance_dclearance"), ["-1", "", "-1"]);
    assert_eq!(calls.lines().count(), 1);
}

#[test]
fn outputs_by_name_and_accuracy_change_nothing_for_the_routine() {
    let nodes =
        "node,time,clearance,temp_s,temp_m,x_s,epot_s,epot_m,area\n3,1,0.5,20,30,9,1,0,2\n4,1,1.5,20,30,8,1,0,2\n";
    let (all, calls) = run(nodes);
    for accuracy in [Accuracy::Reference, Accuracy::Full] {
        let law = Linear::default();
        let calls_of_one = law.calls.clone();
        let user_conductance = Some(UserLaw::new(law));
        let outputs = Some(vec![Output::Conductance]);
        let choices = Choices { user_conductance, outputs, accuracy: Wanted::Mode(accuracy), ..Choices::default() };
        let one = evaluate_with(DECK, nodes, &choices, 1024);
        assert_eq!(one.header(), "node,time,conductance");
        assert_eq!(one.column("conductance"), all.column("conductance"));
        // Every row is open, so contact needs no column; the routine needs the clearance all the same.
        assert_eq!(*calls_of_one.lock().expect("no call panicked"), calls);
        let read = one.plan.expect("the table is right").selection.numbers;
        assert!(!read.iter().any(|column| matches!(column, Column::Potential(_) | Column::Area)), "{read:?}");
    }
}

#[test]
fn a_table_without_rows_or_with_a_thousand_field_variables_is_planned() {
    let header: Vec<String> = (1..=1000).map(|number| format!("fv{number}")).collect();
    let header = format!("clearance,temp,{}", header.join(","));
    let (empty, calls) = run(&format!("{header}\n"));
    assert_eq!((empty.csv.lines().count(), calls.as_str()), (1, ""));
    let cells: Vec<String> = (1..=1000).map(|number| number.to_string()).collect();
    let (_, calls) = run(&format!("{header}\n0,20,{}\n", cells.join(",")));
    assert!(calls.contains("[999.0, 999.0], [1000.0, 1000.0]] time"), "all thousand are handed over");
}
