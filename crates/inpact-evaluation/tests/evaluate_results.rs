//! Results of small scenes: histories, mixed tables, slopes, and what comes out where something is missing.

mod evaluate_support;

use evaluate_support::{evaluate, evaluate_with};
use inpact_evaluation::law::CutoffBoundary;
use inpact_evaluation::plan::{Choices, Derivatives};
use inpact_evaluation::results::Output;
use inpact_parser::model::Regime;

const WELD: &str = "\
*SURFACE INTERACTION, NAME=WELD
*GAP ELECTRICAL CONDUCTANCE
20., 0., 20.
10., 0.1, 20.
40., 0., 100.
20., 0.1, 100.
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
50., 0., 20.
66., 100., 20.
80., 0., 100.
90., 100., 100.
*GAP HEAT GENERATION
0.5, 0.25
";
const SEAL: &str = "\
*SURFACE INTERACTION, NAME=SEAL
*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.2, CUTOFF GAP FILL=0.3
0.5, 0.
0.25, 10.
";

fn transient() -> Choices {
    Choices { regime: Some(Regime::Transient), ..Choices::default() }
}

#[test]
fn histories_of_an_electrical_interface() {
    // Two nodes, sorted by time; node 2 has no area, and node 1 lacks its potential once.
    let nodes = "node,time,clearance,pressure,temp,epot_s,epot_m,area\n\
                 1,0,0.05,0,20,1,0,2\n2,0,0,25,60,2,0,\n1,0.5,0,0,20,3,0,2\n2,0.5,0,50,60,0,2,\n\
                 1,1,0,0,20,,0,2\n2,1,0,200,120,1,0,\n1,2,0,0,20,3,0,2\n";
    insta::assert_snapshot!("electrical_transient", evaluate_with(WELD, nodes, &transient(), 1024).csv);
    insta::assert_snapshot!("electrical_steady", evaluate(WELD, nodes).csv);
}

#[test]
fn histories_of_a_pore_fluid_interface() {
    let nodes = "node,time,clearance,pressure,por_s,por_m,perm_s,perm_m,area,clearance_rate\n\
                 1,0,0,10,1,3,3,1,2,\n1,2,0.1,0,1,3,3,1,2,\n1,4,0.25,0,1,3,3,1,2,\n1,6,0.5,0,1,3,3,1,2,\n\
                 1,8,0.1,0,1,3,3,1,2,-5\n1,10,0,5,3,1,3,1,2,\n";
    insta::assert_snapshot!("pore_transient", evaluate_with(SEAL, nodes, &transient(), 1024).csv);
    insta::assert_snapshot!("pore_steady", evaluate(SEAL, nodes).csv);
}

#[test]
fn an_infinite_permeability_has_no_number() {
    let deck = "*SURFACE INTERACTION, NAME=OPEN\n*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.1, CUTOFF GAP FILL=1.\n";
    let nodes = "node,time,clearance,por_s,por_m\n1,0,0.5,3,1\n1,1,0.2,3,1\n1,2,0.1,1,1\n1,3,0.2,3,1\n";
    let run = evaluate_with(deck, nodes, &transient(), 1024);
    insta::assert_snapshot!(run.csv);
    assert!(!run.csv.contains("inf"), "{}", run.csv);
}

#[test]
fn a_mixed_table_leaves_empty_what_does_not_apply() {
    let deck = format!("{WELD}{SEAL}*SURFACE INTERACTION, NAME=IDLE\n");
    let nodes = "interaction,node,clearance,pressure,temp,epot_jump,por_s,por_m\n\
                 WELD,1,0,50,20,1,,\nSEAL,1,0,5,,,1,2\nIDLE,1,0,5,20,1,1,2\nweld,2,0.05,0,60,1,,\nSEAL,2,0.5,0,,,1,2\n";
    insta::assert_snapshot!(evaluate(&deck, nodes).csv);
}

#[test]
fn an_interaction_with_both_laws_gives_both() {
    let deck = WELD.to_owned() + SEAL.split_once('\n').expect("two lines").1;
    let nodes = "clearance,pressure,temp,epot_jump,por_s,por_m\n\
                 0,5,20,1,1,2\n0,500,20,1,1,2\n0.05,0,20,1,1,2\n0.15,0,20,1,1,2\n0.25,0,20,1,1,2\n0,5,200,1,1,2\n";
    let run = evaluate(&deck, nodes);
    insta::assert_snapshot!(run.csv);
    // Of two laws the status that says more: beyond a table before a cutoff, a cutoff before contact.
    let status = ["closed", "beyond_table", "open", "beyond_table", "beyond_table", "beyond_table"];
    assert_eq!(run.column("status"), status);
}

#[test]
fn slopes_of_the_segment_that_holds_the_point() {
    let choices = Choices { derivatives: Derivatives::Given, ..Choices::default() };
    let nodes = "clearance,pressure,temp\n0.05,0,60\n0.1,0,20\n0,0,20\n0,50,60\n0,100,60\n-1,50,100\n";
    let run = evaluate_with(WELD, nodes, &choices, 1024);
    // Right-hand at a knot, zero at the last knot, in overclosure and for the branch that does not hold (4.4).
    assert_eq!(run.column("dconductance_dclearance"), ["-150", "0", "0", "0", "0", "0"]);
    assert_eq!(run.column("dconductance_dpressure"), ["0", "0", "0.16", "0.13", "0", "0.1"]);
    let temperature = run.numbers("dconductance_dtemp");
    assert_eq!(temperature[..5], [0.1875, 0.125, 0.375, 27.0 / 80.0, 0.3]);
    assert_eq!(temperature[5], 0.0);

    let nodes = "clearance,pressure,por_s,por_m\n0,5,1,1\n0.1,5,1,1\n0.1,0,1,1\n0.5,0,1,1\n";
    let run = evaluate_with(SEAL, nodes, &choices, 1024);
    // Row 2 is closed by its pressure (T-22).
    assert_eq!(run.column("dpermeability_dpressure"), ["-0.025", "-0.025", "0", "0"]);
}

#[test]
fn slopes_along_fields_and_mean_pore_pressure() {
    let choices = Choices { derivatives: Derivatives::Given, ..Choices::default() };
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, DEPENDENCIES=2\n1.,0.,,1.,0.\n2.,0.,,2.,0.\n\
                4.,0.,,1.,10.\n8.,0.,,2.,10.\n\
                *CONTACT PERMEABILITY, DEPENDENCIES=1\n1.,,0.,,1.\n3.,,10.,,1.\n2.,,0.,,5.\n6.,,10.,,5.\n";
    let run = evaluate_with(deck, "clearance,fv1,fv2_s,fv2_m,por_s,por_m\n0,1.5,4,6,2,8\n", &choices, 1024);
    assert_eq!(run.column("dconductance_dfv1"), ["2.5"]);
    assert_eq!(run.column("dconductance_dfv2"), ["0.45"]);
    assert_eq!(run.column("dpermeability_dpor"), ["0.225"]);
    assert_eq!(run.column("dpermeability_dfv1"), ["0.5"]);
    let header = "ECD";
    assert!(!run.header().contains(header), "no potentials, no current");
}

#[test]
fn the_cutoff_boundary_can_be_chosen() {
    let nodes = "clearance,pressure,por_s,por_m\n0.2,0,1,3\n";
    assert_eq!(evaluate(SEAL, nodes).column("q_across"), ["1"]);
    let choices = Choices { cutoff_boundary: CutoffBoundary::Exclusive, ..Choices::default() };
    let run = evaluate_with(SEAL, nodes, &choices, 1024);
    assert_eq!(run.column("q_across"), ["0"]);
    assert_eq!(run.column("status"), ["cutoff"]);
}

#[test]
fn contact_is_told_by_what_is_there() {
    let deck = "*SURFACE INTERACTION, NAME=LAP\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n50., 0.\n65., 100.\n";
    let rows = |nodes: &str| evaluate(deck, nodes).column("status").join(" ");
    assert_eq!(rows("pressure\n10\n-10\n"), "closed beyond_table");
    // Without clearance and flag a pressure of zero tells nothing.
    assert_eq!(evaluate(deck, "pressure\n10\n0\n").column("conductance"), ["51.5", ""]);
    assert_eq!(rows("pressure,closed\n0,1\n0,0\n10,0\n"), "closed open open");
    assert_eq!(rows("pressure,clearance\n0,0\n0,1\n10,1\n0,-1\n"), "closed open closed closed");
    assert_eq!(rows("pressure,clearance,closed\n0,1,\n0,1,1\n"), "open closed");
}

#[test]
fn rows_that_depend_on_each_other_are_those_of_one_node() {
    let nodes = "node,time,clearance,epot_jump,temp,pressure\n";
    let first = "a,0,0,1,20,0\na,1,0,2,20,0\na,3,0,4,20,0\n";
    let second = "b,0,0,5,20,0\nb,2,0,1,20,0\n";
    let by_node = evaluate_with(WELD, &format!("{nodes}{first}{second}"), &transient(), 1024);
    let lines: Vec<&str> = first.lines().collect();
    let others: Vec<&str> = second.lines().collect();
    let mixed = [lines[0], others[0], lines[1], others[1], lines[2]].join("\n");
    let by_time = evaluate_with(WELD, &format!("{nodes}{mixed}\n"), &transient(), 1024);
    let mut sorted: Vec<&str> = by_time.csv.lines().collect();
    sorted[1..].sort_unstable();
    assert_eq!(sorted, by_node.csv.lines().collect::<Vec<_>>());
}

/// Totals are those of the latest time, whatever the order of the rows and the size of the batches.
#[test]
fn totals_are_those_of_the_latest_time() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n10., 0.\n";
    let rows = ["1,0,1,1,2,0.5", "1,1,1,1,3,0.5", "2,0,1,1,5,0.25", "2,1,1,1,7,0.25", "3,1,1,1,1,1e-17"];
    for order in [[0, 1, 2, 3, 4], [4, 0, 2, 1, 3], [0, 2, 3, 4, 1]] {
        let nodes: Vec<&str> = order.iter().map(|row| rows[*row]).collect();
        let nodes = format!("node,time,closed,pressure,epot_jump,area\n{}\n", nodes.join("\n"));
        for batch in [1, 2, 5] {
            let run = evaluate_with(deck, &nodes, &Choices::default(), batch);
            let tally = run.tally.as_ref().expect("rows that can be evaluated");
            let totals = &tally.interactions[0].totals;
            assert_eq!((totals.time, totals.rows), (Some(1.0), 3));
            assert_eq!(tally.summed, [Output::Ecda, Output::Sjda]);
            assert_eq!(totals.values().collect::<Vec<f64>>(), [10.0 * 3.25, 10.0 * 16.75]);
        }
    }
}
