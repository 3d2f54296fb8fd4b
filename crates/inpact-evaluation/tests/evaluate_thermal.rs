//! Decks and node tables with heat: conduction, radiation, friction, their sum and its integrals, in both dialects.

mod evaluate_support;

use evaluate_support::{Run, evaluate, evaluate_with};
use inpact_evaluation::plan::{Choices, Derivatives};
use inpact_evaluation::results::Output;
use inpact_evaluation::table::Tail;
use inpact_parser::grammar::Dialect;
use proptest::prelude::*;

/// The tables of T-21.
const BOTH: &str = "\
*SURFACE INTERACTION, NAME=GAP
*GAP CONDUCTANCE
20., 0.
10., 0.1
*GAP CONDUCTANCE, PRESSURE
50., 0.
65., 100.
70., 250.
";
const RADIATION: &str = "\
*PHYSICAL CONSTANTS, ABSOLUTE ZERO=-460., STEFAN BOLTZMANN=0.1714E-8
*SURFACE INTERACTION, NAME=GAP
*GAP RADIATION
0.45167, 0.45167
1., 0.
0.5, 0.1
";

fn in_calculix(deck: &str, nodes: &str) -> Run {
    evaluate_with(deck, nodes, &Choices { dialect: Dialect::Calculix, ..Choices::default() }, 2)
}

/// What a plan left out, a line each.
fn left_out(run: &Run) -> Vec<String> {
    let plan = run.plan.as_ref().expect("a plan");
    let left_out = plan.interactions.iter().flat_map(|interaction| &interaction.left_out);
    left_out.map(|left_out| format!("{}: {}", left_out.what, left_out.reason)).collect()
}

fn notes(run: &Run) -> &[String] {
    &run.plan.as_ref().expect("a plan").interactions[0].notes
}

#[test]
fn t_21_both_branches_and_zero_beyond_the_last_clearance() {
    let nodes = "clearance,pressure,temp_s,temp_m\n0,0,70,20\n1e-9,0,70,20\n.05,0,70,20\n.1,0,70,20\n.11,0,70,20\n\
                 0,100,70,20\n0,175,70,20\n0,400,70,20\n-.01,0,20,70\n";
    // The tail is chosen for current only.
    let choices = Choices { clearance_tail: Tail::Constant, ..Choices::default() };
    let run = evaluate_with(BOTH, nodes, &choices, 4);
    let conductances = [50.0, 20.0 - 1e-7, 15.0, 10.0, 0.0, 65.0, 67.5, 70.0, 50.0];
    assert_eq!(run.numbers("thermal_conductance"), conductances);
    let heat: Vec<f64> =
        conductances.iter().zip([50.0; 8].into_iter().chain([-50.0])).map(|(k, jump)| k * jump).collect();
    assert_eq!(run.numbers("heat_conduction"), heat);
    assert_eq!(run.numbers("HFL"), heat);
    assert_eq!(run.numbers("total_heat_m"), heat);
    assert_eq!(run.column("total_heat_s")[8], "2500");
    assert_eq!(run.column("status")[3..6], ["open", "beyond_table", "closed"]);
    assert_eq!(run.column("HFL")[4], "0");
    insta::assert_snapshot!(run.findings.join("\n"), @r"
    -:clearance: note[D007 beyond-table] 1 row lies above the last `clearance` of the table of thermal conductance against clearance of `GAP`, 0.1 (it is zero there)
    -:pressure: note[D007 beyond-table] 1 row lies above the last `pressure` of the table of thermal conductance against pressure of `GAP`, 250 (the value at the end of the table is kept)
    ");
}

/// V-4: k̄ = 12.5, q = 625, 156.25 at each node of a unit square.
#[test]
fn v_4_field_variable() {
    let deck = "*SURFACE INTERACTION, NAME=GAP\n*GAP CONDUCTANCE, DEPENDENCIES=1\n10.,,,,1.\n10.,1.,,,1.\n15.,,,,2.\n15.,1.,,,2.\n";
    let run = evaluate(deck, "clearance,fv1,temp_s,temp_m,area\n0,1.5,70,20,0.25\n");
    assert_eq!(run.header(), "HFL,HFLA,thermal_conductance,heat_conduction,total_heat_s,total_heat_m,status");
    assert_eq!(run.csv.lines().nth(1), Some("625,156.25,12.5,625,-625,625,closed"));
}

/// A-30, H-06, K-41: radiation by itself, in contact too.
#[test]
fn a_30_radiation() {
    let nodes = "clearance,temp_s,temp_m\n-.01,40,-60\n.05,40,-60\n.1,-60,40\n.2,40,-60\n,40,-60\n";
    let run = evaluate(RADIATION, nodes);
    let black = 5.0e-10 * (500.0_f64.powi(4) - 400.0_f64.powi(4));
    let factors = [1.0, 0.75, -0.5];
    for (heat, factor) in run.numbers("heat_radiation").into_iter().zip(factors) {
        assert!((heat / (factor * black) - 1.0).abs() < 2e-5, "{heat}");
    }
    assert_eq!(run.numbers("heat_radiation")[3], 0.0);
    assert_eq!(run.column("heat_radiation")[4], "");
    assert_eq!(run.numbers("HFL")[..4], run.numbers("heat_radiation")[..4]);
    assert_eq!(run.column("status"), ["closed", "open", "open", "beyond_table", ""]);
    assert!(run.plan_text().contains("radiation: 4.99998"), "{}", run.plan_text());
}

/// K-41: in contact both act.
#[test]
fn k_41_conduction_and_radiation_together() {
    let deck = format!("{RADIATION}*GAP CONDUCTANCE, PRESSURE\n2., 0.\n4., 10.\n");
    let nodes = "closed,pressure,temp_s,temp_m\n1,5,40,-60\n1,10,40,-60\n";
    let run = evaluate(&deck, nodes);
    let radiation = run.numbers("heat_radiation");
    assert_eq!(run.numbers("heat_conduction"), [300.0, 400.0]);
    assert_eq!(run.numbers("HFL"), [300.0 + radiation[0], 400.0 + radiation[1]]);
    // Where a row may be open, radiation needs the clearance, and the sum with it.
    let run = evaluate(&deck, "closed,pressure,temp_s,temp_m\n1,5,40,-60\n0,0,40,-60\n");
    assert_eq!(
        left_out(&run),
        [
            "heat radiation: `clearance` is missing",
            "`HFL`, `HFLA`, `HTL`, `HTLA`, `total_heat_s`, `total_heat_m`: `clearance` is missing"
        ]
    );
    assert_eq!(run.numbers("heat_conduction"), [300.0, 0.0]);
}

/// H-02, H-05, H-08: everything at once; what goes into both sides is what is generated.
#[test]
fn h_05_all_heat() {
    let deck = format!(
        "{RADIATION}*GAP CONDUCTANCE\n2., 0.\n1., 1.\n*GAP ELECTRICAL CONDUCTANCE\n10., 0.\n5., 1.\n\
         *FRICTION\n0.3,\n*GAP HEAT GENERATION\n0.5, 0.25\n*STEP\n*COUPLED THERMAL-ELECTRICAL\n1., 2.\n*END STEP\n"
    );
    let nodes = "node,time,clearance,temp_s,temp_m,epot_jump,shear,slip_rate,area\n1,0,0,40,-60,2,8,3,2\n1,2,0,40,-60,5,8,3,2\n1,3,.5,40,-60,1,,,2\n";
    let run = evaluate(&deck, nodes);
    let (conduction, radiation) = (run.numbers("heat_conduction"), run.numbers("heat_radiation"));
    let (current, friction) = (run.numbers("SJD"), run.numbers("SFDR"));
    assert_eq!(conduction, [200.0, 200.0, 150.0]);
    // A-21 with η σ = 5, and the mean of the increment: 5/3 (25 + 10 + 4).
    assert_eq!((current[0], current[1]), (20.0, 65.0));
    // An open row that says nothing of friction has none.
    assert_eq!(friction, [12.0, 12.0, 0.0]);
    let (leaving, slave, master) = (run.numbers("HFL"), run.numbers("total_heat_s"), run.numbers("total_heat_m"));
    for row in 0..3 {
        let generated = current[row] + friction[row];
        let expected = conduction[row] + radiation[row] - 0.25 * generated;
        assert!((leaving[row] - expected).abs() < 1e-12, "{} {expected}", leaving[row]);
        assert_eq!(slave[row], -leaving[row]);
        assert!((slave[row] + master[row] - generated).abs() < 1e-12);
    }
    assert_eq!(run.column("WEIGHT"), ["0.25"; 3]);
    assert_eq!(run.numbers("heat_s"), [5.0, 16.25, current[2] * 0.25], "of the current alone");
    // O-5: backward Euler from the first row on.
    assert_eq!(run.numbers("SFDRT"), [0.0, 24.0, 24.0]);
    assert_eq!(run.numbers("SFDRTA"), [0.0, 48.0, 48.0]);
    assert_eq!(run.numbers("HTL"), [0.0, 2.0 * leaving[1], 2.0 * leaving[1] + leaving[2]]);
    assert_eq!(run.numbers("HTLA")[2], 2.0 * run.numbers("HTL")[2]);
    assert_eq!(run.numbers("HFLA"), leaving.iter().map(|heat| 2.0 * heat).collect::<Vec<_>>());
    assert_eq!((run.numbers("SFDRA")[0], left_out(&run)), (24.0, vec![]));
}

/// A row that lacks a part is no increment of the sum; the next one begins at the last row that had all.
#[test]
fn histories_with_rows_that_lack_something() {
    let deck = format!("{BOTH}*FRICTION\n0.3,\n");
    let nodes = "node,time,clearance,pressure,temp_s,temp_m,shear,slip_rate,area\n\
                 1,0,0,0,30,20,2,1,1\n1,1,0,0,30,,2,1,1\n1,3,0,0,30,20,2,1,\n1,4,0,0,30,20,,1,1\n1,6,0,0,30,20,-2,1,1\n";
    let run = evaluate(&deck, nodes);
    assert_eq!(run.column("HFL"), ["499", "", "499", "", "501"]);
    assert_eq!(run.column("HTL"), ["0", "", "1497", "", "3000"]);
    assert_eq!(run.column("HTLA"), ["0", "", "", "", ""]);
    assert_eq!(run.column("SFDR"), ["2", "2", "2", "", "-2"]);
    assert_eq!(run.column("SFDRT"), ["0", "2", "6", "", "0"]);
    assert_eq!(run.column("heat_conduction"), ["500", "", "500", "500", "500"]);
    assert_eq!(run.column("thermal_conductance"), ["50"; 5]);
    let tally = run.tally.expect("a tally").whole();
    assert_eq!((tally.incomplete, tally.incomplete_heat, tally.negative_friction), (0, 2, 1));
}

/// T-03, K-32: a mean, both sides, or one side of which half counts.
#[test]
fn k_32_mass_flow() {
    let deck = "*SURFACE INTERACTION, NAME=GAP\n*GAP CONDUCTANCE\n10., 0., 20., 0.\n10., 1., 20., 0.\n40., 0., 20., 3.\n40., 1., 20., 3.\n";
    let conductances = |nodes: &str| evaluate(deck, nodes).numbers("thermal_conductance");
    assert_eq!(conductances("clearance,mass_flow\n.5,2\n.5,-2\n"), [30.0, 30.0]);
    assert_eq!(conductances("clearance,mass_flow_s,mass_flow_m\n.5,-2,1\n.5,2,\n.5,,-2\n"), [25.0, 20.0, 20.0]);
    assert_eq!(conductances("clearance,mass_flow_m\n.5,-2\n"), [20.0]);
    assert_eq!(conductances("clearance,mass_flow,mass_flow_s\n.5,3,\n.5,,2\n"), [40.0, 20.0]);
    let run = evaluate(deck, "clearance,mass_flow_s,mass_flow_m\n.5,,\n.5,1,1\n");
    assert_eq!(run.column("thermal_conductance"), ["", "20"]);
    assert_eq!(run.tally.map(|tally| tally.whole().incomplete), Some(1));
    let run = evaluate(deck, "clearance,temp_s,temp_m\n.5,1,2\n");
    assert_eq!(left_out(&run)[0], "heat conduction: `mass_flow` is missing");
    let choices = Choices { derivatives: Derivatives::Given, ..Choices::default() };
    let run = evaluate_with(deck, "clearance,mass_flow\n.5,2\n", &choices, 1);
    assert_eq!(run.numbers("dthermal_conductance_dmass_flow"), [10.0]);
}

#[test]
fn slopes_along_every_variable() {
    let deck = "*SURFACE INTERACTION, NAME=GAP\n*GAP CONDUCTANCE, DEPENDENCIES=2\n\
                10., 0., 20., 0., 1., 5.\n6., 1., 20., 0., 1., 5.\n20., 0., 40., 0., 1., 5.\n16., 1., 40., 0., 1., 5.\n\
                30., 0., 20., 0., 3., 5.\n26., 1., 20., 0., 3., 5.\n";
    let choices = Choices { derivatives: Derivatives::Given, ..Choices::default() };
    let run = evaluate_with(deck, "clearance,temp,fv1_s,fv1_m\n.5,30,1,3\n", &choices, 1);
    assert_eq!(run.numbers("thermal_conductance"), [20.5]);
    assert_eq!(run.numbers("dthermal_conductance_dclearance"), [-4.0]);
    assert_eq!(run.numbers("dthermal_conductance_dtemp"), [0.25]);
    assert_eq!(run.numbers("dthermal_conductance_dfv1"), [7.5]);
    assert!(!run.header().contains("dthermal_conductance_dfv2"), "{}", run.header());
}

/// What is not there to be evaluated is named with its reason.
#[test]
fn what_is_left_out_and_why() {
    let nodes = "clearance,pressure,temp_s,temp_m,shear\n0,10,70,20,1\n";
    let reasons = |deck: &str| left_out(&evaluate(deck, nodes));
    let sum = "`HFL`, `HFLA`, `HTL`, `HTLA`, `total_heat_s`, `total_heat_m`";
    assert_eq!(
        reasons("*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE, USER\n")[0],
        "heat conduction: needs user subroutine GAPCON, which is not evaluated"
    );
    assert_eq!(
        reasons("*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE\n")[0],
        "heat conduction: *GAP CONDUCTANCE has no rows"
    );
    let descending = reasons("*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE\n1., 0.\n1., 2.\n1., 1.\n");
    assert_eq!(
        descending[0],
        "heat conduction: its rows form no table: row 3 has 1.0 after 2.0 in column 2, which must ascend"
    );
    // T-42.
    let no_zero = RADIATION.replace("ABSOLUTE ZERO=-460., ", "");
    assert_eq!(reasons(&no_zero)[0], "heat radiation: *PHYSICAL CONSTANTS does not give ABSOLUTE ZERO");
    let no_constants: String = RADIATION.lines().skip(1).map(|line| format!("{line}\n")).collect();
    assert_eq!(reasons(&no_constants)[0], "heat radiation: *PHYSICAL CONSTANTS does not give ABSOLUTE ZERO");
    let above_one = RADIATION.replace("0.45167,", "1.45167,");
    assert_eq!(reasons(&above_one)[0], "heat radiation: *GAP RADIATION has no two emissivities from 0 to 1");
    // A radiation that is not known takes the sum with it, conduction stays.
    let run = evaluate(&format!("{no_zero}*GAP CONDUCTANCE\n5., 0.\n5., 1.\n"), nodes);
    assert_eq!(run.header(), "thermal_conductance,heat_conduction,status");
    assert!(left_out(&run).contains(&format!("{sum}: *PHYSICAL CONSTANTS does not give ABSOLUTE ZERO")));
    // Friction: half of its columns, and a deck that does not tell of it.
    let run = evaluate(&format!("{BOTH}*FRICTION\n0.2,\n"), nodes);
    assert_eq!(left_out(&run)[1], "heat of friction: `slip_rate` is missing");
    assert_eq!(run.numbers("HFL"), [50.0 * 51.5]);
    let electrical = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n1., 0.\n1., 1.\n";
    let run = evaluate(electrical, "clearance,epot_jump,shear,slip_rate\n0,1,2,3\n");
    assert!(left_out(&run).contains(&"heat of friction: the interaction has no *FRICTION".to_owned()));
    assert!(!run.header().contains("HFL"), "{}", run.header());
}

/// K-05: a user subroutine of the interaction switches generation off, conduction stays.
#[test]
fn k_05_heat_switched_off() {
    let deck = "*SURFACE INTERACTION, NAME=A, USER\n\n*GAP CONDUCTANCE\n5., 0.\n5., 1.\n*GAP ELECTRICAL CONDUCTANCE\n1., 0.\n1., 1.\n*FRICTION\n.2,\n";
    let run = evaluate(deck, "clearance,temp_s,temp_m,epot_jump,shear,slip_rate\n0,30,20,7,2,3\n");
    assert_eq!(
        run.header(),
        "ECD,HFL,conductance,thermal_conductance,heat_conduction,total_heat_s,total_heat_m,status,electrical_status,thermal_status"
    );
    assert_eq!((run.numbers("HFL"), run.numbers("total_heat_m")), (vec![50.0], vec![50.0]));
    let switched_off = "heat generation: USER of *SURFACE INTERACTION switches heat generation off";
    assert_eq!(left_out(&run).iter().filter(|reason| *reason == switched_off).count(), 1);
    assert_eq!(notes(&run), [""; 0]);
}

/// The sum says so where it is without the heat of a current.
#[test]
fn a_current_that_is_left_out() {
    let deck = format!("{BOTH}*GAP ELECTRICAL CONDUCTANCE, USER\n");
    let run = evaluate(&deck, "clearance,pressure,temp_s,temp_m,epot_jump\n0,0,70,20,1\n");
    assert_eq!(run.header(), "thermal_conductance,heat_conduction,status");
    let sums = "`HFL`, `HFLA`, `HTL`, `HTLA`, `total_heat_s`, `total_heat_m`";
    let why = "the heat of the current is part of it and is not known: needs user subroutine GAPELECTR; give it with `--user-library FILE`";
    assert!(left_out(&run).contains(&format!("{sums}: {why}")), "{:?}", left_out(&run));
    // In a row without a jump of potential there is no sum.
    let deck = format!("{BOTH}*GAP ELECTRICAL CONDUCTANCE\n1., 0.\n1., 1.\n");
    let run = evaluate(&deck, "clearance,pressure,temp_s,temp_m,epot_jump\n0,0,70,20,1\n0,0,70,20,\n");
    assert_eq!(run.column("HFL"), ["2499.5", ""]);
    assert_eq!(run.column("heat_conduction"), ["2500", "2500"]);
}

const CUBES: &str = "\
*SURFACE INTERACTION,NAME=SI
*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR
1.e7,0.,0.001
*GAP CONDUCTANCE
100.,0.,293.
200.,500.,293.
400.,1000.,293.
1000.,5000.,293.
400.,500.,393.
800.,2000.,393.
*FRICTION
0.5,1.e7
*GAP HEAT GENERATION
0.8,0.25,3.
";

/// One deck, two laws: what ccx printed, and what the same rows are in Abaqus, where the second column is the clearance.
#[test]
fn calculix_clips_and_conducts_closed_only() {
    let nodes = "clearance,pressure,temp_s,temp_m,shear\n0,100,393,293,0\n0,1500,393,293,0\n0,4000,393,293,-500\n1e-5,0,393,293,\n";
    let run = in_calculix(CUBES, nodes);
    let printed = [30_000.0, 57_083.33, 67_500.0, 0.0];
    for (heat, printed) in run.numbers("heat_conduction").into_iter().zip(printed) {
        assert!((heat - printed).abs() <= 5e-7 * printed, "{heat} {printed}");
    }
    // η |τ| v, a quarter into the slave.
    assert_eq!(run.numbers("SFDR"), [0.0, 0.0, 1200.0, 0.0]);
    assert!((run.numbers("HFL")[2] - (67_500.0 - 300.0)).abs() < 1e-9);
    assert_eq!(run.column("status"), ["beyond_table", "closed", "beyond_table", "open"]);
    assert_eq!(run.tally.as_ref().map(|tally| tally.whole().beyond_curves), Some(2));
    let abaqus = evaluate(&CUBES.replace("0.8,0.25,3.", "0.8,0.25"), nodes);
    // Pressures as clearances: d = 0 and d = 1e-5 are all but the same, and the open row conducts.
    let found = abaqus.numbers("thermal_conductance");
    assert_eq!(found[..3], [250.0; 3]);
    assert!((found[3] - 250.000_001).abs() < 1e-9);
    insta::assert_snapshot!(run.plan_text());
}

#[test]
fn what_calculix_does_not_have() {
    let nodes = "clearance,pressure,temp_s,temp_m,shear,slip_rate\n0,10,70,20,1,-2\n";
    let without_card = CUBES.replace("*GAP HEAT GENERATION\n0.8,0.25,3.\n", "");
    assert_eq!(
        left_out(&in_calculix(&without_card, nodes))[0],
        "heat of friction: CalculiX generates heat with *GAP HEAT GENERATION only"
    );
    // Below zero the speed is computed, which is what the column is for.
    let computed = CUBES.replace("0.8,0.25,3.", "0.8,0.25,-1.");
    assert_eq!(in_calculix(&computed, nodes).numbers("SFDR"), [1.6]);
    let disjoint = "*SURFACE INTERACTION,NAME=SI\n*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=HARD\n*GAP CONDUCTANCE\n1.,0.,0.\n1.,1.,0.\n1.,2.,9.\n1.,3.,9.\n";
    assert_eq!(
        left_out(&in_calculix(disjoint, nodes))[0],
        "heat conduction: its rows form no conductance: the curves at temperatures 0.0 and 9.0 share no pressures"
    );
    // A second card overwrites the first.
    let twice = "*SURFACE INTERACTION,NAME=SI\n*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=HARD\n*GAP CONDUCTANCE\n1.,0.,0.\n*GAP CONDUCTANCE\n2.,0.,0.\n";
    assert_eq!(in_calculix(twice, nodes).numbers("thermal_conductance"), [2.0]);
}

#[test]
fn the_plan_of_all_heat() {
    let deck = format!(
        "{RADIATION}*GAP CONDUCTANCE\n20., 0., 10.\n10., 0.1, 10.\n40., 0., 90.\n20., 0.1, 90.\n*FRICTION\n.2,\n*GAP HEAT GENERATION\n1.,0.4\n"
    );
    let nodes = "node,time,clearance,temp,temp_s,temp_m,shear,slip_rate,mass_flow\n1,0,0.05,30,40,20,0,0,1\n1,1,0,30,40,20,3,2,1\n";
    let choices = Choices { derivatives: Derivatives::Given, ..Choices::default() };
    insta::assert_snapshot!(evaluate_with(&deck, nodes, &choices, 1).plan_text());
}

/// Only what outputs need is evaluated and read; the sum needs the heat of the current although nothing of the current is requested.
#[test]
fn outputs_that_are_asked_for() {
    let deck = format!(
        "{RADIATION}*GAP CONDUCTANCE\n2., 0.\n1., 1.\n*GAP ELECTRICAL CONDUCTANCE\n10., 0.\n5., 1.\n*FRICTION\n.3,\n"
    );
    let nodes = "node,time,clearance,temp_s,temp_m,epot_jump,shear,slip_rate,area\n1,0,0,40,-60,2,8,3,2\n1,2,.5,40,-60,5,8,3,2\n";
    let all = evaluate(&deck, nodes);
    let requested = |names: &[&str]| {
        let outputs = names.iter().map(|name| Output::named(name).expect("an output"));
        evaluate_with(&deck, nodes, &Choices { outputs: Some(outputs.collect()), ..Choices::default() }, 1)
    };
    let read = |run: &Run| -> Vec<String> {
        run.plan.as_ref().expect("a plan").selection.numbers.iter().map(ToString::to_string).collect()
    };
    let run = requested(&["HFL"]);
    assert_eq!((run.header(), run.column("HFL")), ("node,time,HFL", all.column("HFL")));
    assert_eq!(read(&run), ["clearance", "temp_s", "temp_m", "epot_jump", "shear", "slip_rate"]);
    let run = requested(&["SFDRT"]);
    assert_eq!(run.column("SFDRT"), all.column("SFDRT"));
    assert_eq!(read(&run), ["time", "clearance", "shear", "slip_rate"]);
    let plan = run.plan.as_ref().expect("a plan");
    assert!(plan.interactions[0].electrical.is_none());
    let run = requested(&["thermal_conductance"]);
    assert_eq!(
        (run.column("thermal_conductance"), read(&run)),
        (all.column("thermal_conductance"), vec!["clearance".to_owned()])
    );
    let run = requested(&["ECD"]);
    assert_eq!(
        (run.column("ECD"), read(&run)),
        (all.column("ECD"), vec!["clearance".to_owned(), "epot_jump".to_owned()])
    );
    assert!(run.plan.is_some_and(|plan| plan.interactions[0].thermal.is_none()));
    let run = requested(&["heat_radiation", "HTLA"]);
    assert_eq!((run.column("heat_radiation"), run.column("HTLA")), (all.column("heat_radiation"), all.column("HTLA")));
}

/// A cell: a number, now and then nothing or something that is not finite.
fn cell() -> impl Strategy<Value = String> {
    prop_oneof![
        9 => (-300..300_i32).prop_map(|number| (f64::from(number) / 100.0).to_string()),
        2 => Just("0".to_owned()),
        1 => Just(String::new()),
        1 => prop_oneof![Just("nan"), Just("inf"), Just("-inf"), Just("1e-310"), Just("1e300")].prop_map(str::to_owned),
    ]
}

proptest! {
    /// However rows are cut into batches; and in every row with a sum both sides take in what current and friction generate.
    #[test]
    fn batches_change_nothing_and_heat_is_conserved(
        rows in prop::collection::vec((0..3_u8, prop::collection::vec(cell(), 8)), 1..30), size in 1..9_usize,
    ) {
        let deck = format!(
            "{RADIATION}*GAP CONDUCTANCE\n2., 0., 0.\n1., 1., 0.\n3., 0., 2.\n2., 2., 2.\n*GAP CONDUCTANCE, PRESSURE\n5., -1.\n7., 1.\n\
             *GAP ELECTRICAL CONDUCTANCE\n10., 0.\n5., 1.\n*FRICTION\n.3,\n*GAP HEAT GENERATION\n.75, .25\n"
        );
        let lines = rows.iter().enumerate().map(|(time, (node, cells))| format!("{node},{time},{}\n", cells.join(",")));
        let header = "node,time,clearance,pressure,temp_s,temp_m,epot_jump,shear,slip_rate,mass_flow_s\n".to_owned();
        let nodes = header + &lines.collect::<String>();
        let choices = Choices { derivatives: Derivatives::Given, ..Choices::default() };
        let whole = evaluate_with(&deck, &nodes, &choices, usize::MAX);
        let pieces = evaluate_with(&deck, &nodes, &choices, size);
        prop_assert_eq!(&whole.csv, &pieces.csv);
        prop_assert_eq!(&whole.findings, &pieces.findings);
        if !whole.header().contains("HFL") || !whole.header().contains("SJD") || !whole.header().contains("SFDR") {
            return Ok(());
        }
        let column = |name: &str| if whole.header().contains(name) { whole.numbers(name) } else { vec![0.0; rows.len()] };
        let columns = ["total_heat_s", "total_heat_m", "HFL", "SJD", "SFDR", "heat_conduction", "heat_radiation"].map(column);
        for row in 0..rows.len() {
            let [slave, master, leaving, current, friction, conduction, radiation] = columns.each_ref().map(|column| column[row]);
            if ![slave, master].iter().all(|heat| heat.is_finite()) {
                continue;
            }
            let friction = if friction.is_nan() { 0.0 } else { friction };
            // Below the normal range the shares are rounded to a fixed step.
            let largest = [conduction, radiation, current, friction]
                .into_iter()
                .map(f64::abs)
                .fold(f64::MIN_POSITIVE, f64::max);
            prop_assert_eq!(slave, -leaving);
            let generated = current + friction;
            prop_assert!(((slave + master) - generated).abs() <= 8.0 * f64::EPSILON * largest, "{slave} {master} {generated}");
        }
    }
}
