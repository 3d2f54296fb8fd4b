//! Histories of nodes: where they start (C-25), given rates of the clearance (O-5, D021), circuits that close (Q-41, D022).

mod evaluate_support;

use evaluate_support::{Run, evaluate_with};
use inpact_evaluation::HistoryStart;
use inpact_evaluation::law::ClosingHeat;
use inpact_evaluation::plan::Choices;
use inpact_parser::model::Regime;

const JOINT: &str =
    "*SURFACE INTERACTION, NAME=J\n*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.5, CUTOFF GAP FILL=0.5\n1.E-3, 0.\n";
const CONTACT: &str = "*SURFACE INTERACTION, NAME=C\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n1.E4, 0.\n1.E4, 100.\n\
                       *GAP CONDUCTANCE\n2., 0.\n2., 1.\n";

fn run(deck: &str, nodes: &str, choices: Choices) -> Run {
    evaluate_with(deck, nodes, &Choices { regime: Some(Regime::Transient), ..choices }, 2)
}

/// O-5: with a given rate PTL is the integral of PFL, whatever the clearance does; that they disagree is said once, with the first row.
#[test]
fn o_5_ptl_is_the_integral_of_pfl_where_a_rate_is_given() {
    let nodes =
        "node,time,clearance,clearance_rate,por_s,por_m\n1,0,0.1,-0.02,0,0\n1,0.5,0.1,-0.02,0,0\n1,1,0.1,-0.02,0,0\n";
    let found = run(JOINT, nodes, Choices::default());
    assert_eq!(found.column("PFL"), ["-0.01", "-0.01", "-0.01"]);
    assert_eq!(found.column("PTL"), ["0", "-0.005", "-0.01"]);
    let said: Vec<&String> = found.findings.iter().filter(|found| found.contains("D021")).collect();
    assert_eq!(
        said,
        ["3:-: warning[D021 contradictory-rate] `clearance_rate` contradicts the clearance in 2 rows of `J`: \
          the first has a rate of -0.02, and its clearance has changed at 0.0 \
          (PFL and PTL go by the rate: mend it, or leave the column out so that the rate follows from the clearance)"]
    );
}

/// A rate within 1 % of the change of the clearance contradicts nothing, and a steady state has no rate to contradict.
#[test]
fn d_021_rates_that_agree() {
    let nodes = "node,time,clearance,clearance_rate,por_s,por_m\n1,0,0.1,-9,0,0\n1,1,0.2,0.1005,0,0\n";
    assert!(run(JOINT, nodes, Choices::default()).findings.iter().all(|found| !found.contains("D021")));
    let nodes = nodes.replace("0.1005", "7");
    let steady = evaluate_with(JOINT, &nodes, &Choices { regime: Some(Regime::SteadyState), ..Choices::default() }, 9);
    assert!(steady.findings.iter().all(|found| !found.contains("D021")), "{:?}", steady.findings);
}

/// the manual's form, 1e4/3 (1e-6 + 1e-3 · 10 + 100) at the row that closes the circuit, and a warning; a balance has σ Δφ₁² there.
#[test]
fn q_41_rows_that_close_a_circuit_are_counted() {
    let nodes = "node,time,closed,pressure,clearance,epot_jump\n1,0,0,0,1,10\n1,1,1,5,0,0.001\n1,2,1,5,0,0.001\n";
    let manual = run(CONTACT, nodes, Choices::default());
    let open_circuit = 1e4 / 3.0 * (1e-6 + 1e-2 + 100.0);
    let heat = manual.numbers("SJD");
    assert!((heat[1] / open_circuit - 1.0).abs() < 1e-15 && (heat[2] - 0.01).abs() < 1e-17, "{heat:?}");
    let said: Vec<&String> = manual.findings.iter().filter(|found| found.contains("D022")).collect();
    assert!(said.len() == 1 && said[0].contains("in 1 row of `C`: the first has a jump of 0.001"), "{said:?}");
    let balanced = run(CONTACT, nodes, Choices { closing_heat: ClosingHeat::Balanced, ..Choices::default() });
    assert!((balanced.numbers("SJD")[1] - 0.01).abs() < 1e-17);
    assert!(balanced.findings.iter().all(|found| !found.contains("D022")), "{:?}", balanced.findings);
}

/// C-25: with n increments of a constant current the heat is 1 − 2/(3 n) of that of the first row's own jump.
#[test]
fn c_25_a_history_at_rest_lacks_two_thirds_of_its_first_increment() {
    for increments in [1_u32, 2, 4, 10, 20, 100] {
        let row = |number: u32| format!("1,{number},1,5,0,0.5,3,1\n");
        let rows: String = (1..=increments).map(row).collect();
        let nodes = format!("node,time,closed,pressure,clearance,epot_jump,temp_s,temp_m\n{rows}");
        let at_rest = HistoryStart::AtRest { time: 0.0 };
        let found = run(CONTACT, &nodes, Choices { history_start: at_rest, ..Choices::default() });
        let last = |name: &str| found.numbers(name)[increments as usize - 1];
        let count = f64::from(increments);
        let whole = 1e4 * 0.25 * count;
        assert!((last("SJDT") / whole - (1.0 - 2.0 / (3.0 * count))).abs() < 1e-14, "{increments}");
        assert_eq!(last("ECDT"), 5e3 * count);
        let first_row = run(CONTACT, &nodes, Choices::default());
        assert_eq!(first_row.numbers("SJDT")[increments as usize - 1], 1e4 * 0.25 * (count - 1.0));
        assert_eq!(first_row.numbers("SJDT")[0], 0.0);
        // HTL takes the heat of the current as the row has it.
        assert!(found.numbers("HTL")[0] != 0.0 && first_row.numbers("HTL")[0] == 0.0);
    }
}
