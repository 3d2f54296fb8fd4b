//! The evaluation vectors of appendix A of the semantics, from text to text.

mod evaluate_support;

use evaluate_support::{evaluate, evaluate_with};
use inpact_evaluation::plan::Choices;
use inpact_evaluation::table::Tail;
use inpact_parser::model::Regime;

const CLEARANCE: &str = "*SURFACE INTERACTION, NAME=GAP\n*GAP ELECTRICAL CONDUCTANCE\n20., 0.\n10., 0.1\n";
const PRESSURE: &str = "*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n50., 0.\n65., 100.\n70., 250.\n";

fn zero_tail() -> Choices {
    Choices { clearance_tail: Tail::Zero, ..Choices::default() }
}

fn transient() -> Choices {
    Choices { regime: Some(Regime::Transient), ..Choices::default() }
}

#[test]
fn a_10_clearance_table_and_its_tail() {
    let nodes = "clearance\n-1e-3\n0\n.05\n.1\n.2\n";
    let run = evaluate(CLEARANCE, nodes);
    assert_eq!(run.column("conductance"), ["20", "20", "15", "10", "10"]);
    assert_eq!(run.column("status"), ["closed", "closed", "open", "open", "beyond_table"]);
    assert!(run.findings[0].contains("warning[D007 beyond-table] 1 row lies above"), "{:?}", run.findings);
    let run = evaluate_with(CLEARANCE, nodes, &zero_tail(), 2);
    assert_eq!(run.column("conductance"), ["20", "20", "15", "10", "0"]);
}

#[test]
fn a_11_both_branches() {
    let nodes = "clearance,pressure\n0,0\n0,-5\n1e-9,0\n.05,0\n-1e-6,100\n0,175\n0,400\n";
    let run = evaluate(&format!("{CLEARANCE}{PRESSURE}"), nodes);
    let conductance = run.numbers("conductance");
    assert_eq!(conductance[..2], [50.0, 50.0]);
    assert!(conductance[2] < 20.0 && conductance[2] > 19.999_999, "{}", conductance[2]);
    assert_eq!(conductance[3..], [15.0, 65.0, 67.5, 70.0]);
    let status = ["closed", "beyond_table", "open", "open", "closed", "closed", "beyond_table"];
    assert_eq!(run.column("status"), status);
}

#[test]
fn a_12_pressure_table_alone() {
    let deck = "*SURFACE INTERACTION, NAME=GAP\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n50., 0.\n65., 100.\n";
    let run = evaluate(deck, "clearance,pressure\n0.1,0\n0,50\n0,1e6\n");
    assert_eq!(run.column("conductance"), ["0", "57.5", "65"]);
    assert_eq!(run.column("status"), ["open", "closed", "beyond_table"]);
}

#[test]
fn a_13_ragged_groups_at_their_own_abscissae() {
    let deck = "*SURFACE INTERACTION, NAME=GAP\n*GAP ELECTRICAL CONDUCTANCE\n10.,0.,300.\n6.,1.,300.\n2.,2.,300.\n\
                20.,0.,400.\n10.,4.,400.\n";
    let nodes = "clearance,temp_s,temp_m\n2,340,360\n3,340,360\n";
    assert_eq!(evaluate(deck, nodes).column("conductance"), ["8.5", "7.25"]);
    let zero = evaluate_with(deck, nodes, &zero_tail(), 1);
    assert_eq!(zero.column("conductance"), ["8.5", "6.25"]);
}

#[test]
fn a_20_current_and_heat() {
    let deck = "*SURFACE INTERACTION, NAME=GAP\n*GAP ELECTRICAL CONDUCTANCE\n10., 0.\n10., 1.\n\
                *GAP HEAT GENERATION\n0.5, 0.25\n";
    let run = evaluate(deck, "clearance,epot_s,epot_m,area\n0,3,1,2\n");
    for (output, expected) in [
        ("ECD", "20"),
        ("ECDA", "40"),
        ("SJD", "20"),
        ("SJDA", "40"),
        ("WEIGHT", "0.25"),
        ("heat_s", "5"),
        ("heat_m", "15"),
    ] {
        assert_eq!(run.column(output), [expected], "{output}");
    }
}

#[test]
fn a_21_transient_heat_over_an_increment() {
    let deck = "*SURFACE INTERACTION, NAME=GAP\n*GAP ELECTRICAL CONDUCTANCE\n3., 0.\n3., 1.\n";
    let nodes = "node,time,clearance,epot_jump\n1,0,0,2\n1,0.5,0,5\n";
    let run = evaluate_with(deck, nodes, &transient(), 1024);
    // In a first row the jump at the start is its own (C-25): 3·2².
    assert_eq!(run.column("SJD"), ["12", "39"]);
    assert_eq!(run.column("SJDT"), ["0", "19.5"]);
    assert_eq!(run.column("ECDT"), ["0", "7.5"]);
    let steady = evaluate(deck, nodes);
    assert_eq!(steady.column("SJD"), ["12", "75"]);
}

#[test]
fn a_22_flow_across_a_closed_interface() {
    let deck = "*SURFACE INTERACTION, NAME=GAP\n*CONTACT PERMEABILITY\n1.E-3, 0.\n";
    let run = evaluate_with(deck, "clearance,clearance_rate,por_s,por_m\n0,0,10,30\n", &transient(), 1024);
    for (output, expected) in
        [("q_across", "0.02"), ("q_s", "0.02"), ("q_m", "-0.02"), ("PFL", "-0.02"), ("permeability", "0.001")]
    {
        assert_eq!(run.column(output), [expected], "{output}");
    }
}

#[test]
fn a_23_gap_filling_and_its_shares() {
    // Slightly open, so that there is a gap to close.
    let option = "*SURFACE INTERACTION, NAME=GAP\n*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=1., CUTOFF GAP FILL=1.\n";
    let (infinite, finite) = (option, format!("{option}1.E-3, 0.\n"));
    let nodes = "clearance,clearance_rate,por_s,por_m,perm_s,perm_m\n0.1,-2e-3,5,5,3,1\n";
    let run = evaluate_with(infinite, nodes, &transient(), 1024);
    assert_eq!(run.column("q_gap_s"), ["0.001"]);
    assert_eq!(run.column("q_gap_m"), ["0.001"]);
    // The flow across is an unknown there, and so is all that it is part of.
    assert_eq!(run.column("q_across"), [""]);
    assert_eq!(run.column("PFL"), [""]);
    assert_eq!(run.column("status"), ["constrained"]);
    assert_eq!(evaluate(infinite, nodes).column("q_gap_s"), ["0"]);

    let run = evaluate_with(&finite, nodes, &transient(), 1024);
    assert_eq!(run.column("q_gap_s"), ["0.0015"]);
    assert_eq!(run.column("q_gap_m"), ["0.0005"]);
    assert_eq!(run.column("PFL"), ["-0.0015"]);
}

#[test]
fn a_24_cutoff_of_flow_across() {
    let deck =
        |cutoff: &str| format!("*SURFACE INTERACTION, NAME=GAP\n*CONTACT PERMEABILITY{cutoff}\n1., 0.\n3., 10.\n");
    let nodes = "clearance,pressure,por_s,por_m\n0.5,0,1,3\n0,5,1,3\n";
    let run = evaluate(&deck(", CUTOFF FLOW ACROSS=0.4"), nodes);
    assert_eq!(run.column("q_across"), ["0", "4"]);
    assert_eq!(run.column("status"), ["cutoff", "closed"]);
    let run = evaluate(&deck(", CUTOFF FLOW ACROSS=0.5"), nodes);
    assert_eq!(run.column("permeability"), ["1", "2"]);
    assert_eq!(run.column("q_across"), ["2", "4"]);
    // The default cutoff is not known: only the closed row has a flow.
    let run = evaluate(&deck(""), nodes);
    assert_eq!(run.column("q_across"), ["", "4"]);
    assert_eq!(run.tally.as_ref().map(|tally| tally.total(|of| of.needs_length)), Some(1));
    let notes = &run.plan.as_ref().expect("a plan").interactions[0].notes;
    assert!(notes[0].starts_with("1 row with a clearance above zero"), "{notes:?}");
    let chosen = Choices { characteristic_length: Some(0.6), ..Choices::default() };
    assert_eq!(evaluate_with(&deck(""), nodes, &chosen, 1).column("q_across"), ["2", "4"]);
    let with_column = "clearance,pressure,por_s,por_m,char_length\n0.5,0,1,3,0.4\n0.5,0,1,3,0.6\n";
    assert_eq!(evaluate(&deck(""), with_column).column("q_across"), ["0", "2"]);
}

#[test]
fn a_25_the_cutoffs_are_independent() {
    let deck = "*SURFACE INTERACTION, NAME=GAP\n\
                *CONTACT PERMEABILITY, CUTOFF GAP FILL=0.1, CUTOFF FLOW ACROSS=1.\n2., 0.\n";
    let run = evaluate_with(deck, "clearance,clearance_rate,por_s,por_m\n0.5,-1,1,3\n", &transient(), 1024);
    assert_eq!(run.column("q_gap_s"), ["0"]);
    assert_eq!(run.column("q_gap_m"), ["0"]);
    assert_eq!(run.column("q_across"), ["4"]);
    assert_eq!(run.column("status"), ["open"]);
}

#[test]
fn a_43_the_procedures_decide_between_steady_and_transient() {
    let deck = |procedure: &str| {
        format!("{CLEARANCE}*STEP\n{procedure}\n*END STEP\n*STEP\n*COUPLED TEMPERATURE-DISPLACEMENT\n*END STEP\n")
    };
    let nodes = "node,time,clearance,epot_jump\n1,0,0,0\n1,1,0,3\n";
    let heat = |procedure: &str| evaluate(&deck(procedure), nodes).numbers("SJD")[1];
    assert_eq!(heat("*COUPLED THERMAL-ELECTRICAL"), 60.0);
    assert_eq!(heat("*COUPLED THERMAL-ELECTRICAL, STEADY STATE"), 180.0);
    assert_eq!(heat("*STATIC"), 180.0);
    let chosen = evaluate_with(&deck("*COUPLED THERMAL-ELECTRICAL, STEADY STATE"), nodes, &transient(), 1024);
    assert_eq!(chosen.numbers("SJD")[1], 60.0);
}
