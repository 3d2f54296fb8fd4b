//! What a plan says of small scenes, as it is printed.

mod evaluate_support;

use evaluate_support::{evaluate, evaluate_with, model_of};
use inpact_evaluation::plan::{Choices, Derivatives, concerning};
use inpact_evaluation::table::Tail;
use inpact_parser::deck::scan;
use inpact_parser::grammar::Grammar;
use inpact_parser::model::{Name, Regime, read};

const ELECTRICAL: &str = "\
*SURFACE INTERACTION, NAME=GAP
*GAP ELECTRICAL CONDUCTANCE, DEPENDENCIES=2
20., 0., 20., 1., 5.
10., 0.1, 20., 1., 5.
30., 0., 20., 2., 5.
15., 0.1, 20., 2., 5.
*GAP ELECTRICAL CONDUCTANCE, PRESSURE
50., 0., 20.
65., 100., 20.
40., 0., 80.
55., 100., 80.
*GAP HEAT GENERATION
0.9, 0.3
";
const PORE: &str = "\
*SURFACE INTERACTION, NAME=SEAL
*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.2
1.E-3, 0., 0.
5.E-4, 10., 0.
2.E-3, 0., 100.
1.E-3, 10., 100.
";

#[test]
fn both_branches_and_what_nothing_needs() {
    let nodes = "node,time,COPEN,cpress,temp_s,temp_m,fv1,fv2,epot_s,epot_m,epot_jump,Notes,por_s\n\
                 1,0,0.05,0,20,30,1.5,5,0,1,,first,\n1,1,0,40,25,35,1.5,5,0,1,1,second,\n";
    let choices = Choices { derivatives: Derivatives::Given, ..Choices::default() };
    insta::assert_snapshot!(evaluate_with(ELECTRICAL, nodes, &choices, 1).plan_text());
}

#[test]
fn a_branch_that_no_row_reaches() {
    let nodes = "clearance,pressure,fv1_s,fv1_m\n0.05,0,1,2\n0.2,0,1,2\n";
    insta::assert_snapshot!("no_row_closed", evaluate(ELECTRICAL, nodes).plan_text());
    let nodes = "closed,pressure,temp\n1,10,40\n";
    insta::assert_snapshot!("no_row_open", evaluate(ELECTRICAL, nodes).plan_text());
}

#[test]
fn a_law_that_lacks_a_column() {
    let nodes = "clearance,pressure,fv1_s,fv1_m,temp_s\n0.05,0,1,2,20\n0,10,1,2,20\n";
    insta::assert_snapshot!(evaluate(ELECTRICAL, nodes).plan_text());
}

#[test]
fn two_interactions_with_laws_of_their_own() {
    let deck = format!("{ELECTRICAL}{PORE}*SURFACE INTERACTION, NAME=IDLE\n");
    let nodes = "node,interaction,clearance,pressure,temp,fv1,epot_jump,por_s,por_m,area,char_length,perm_s,perm_m\n\
                 1,GAP,0.05,0,20,1,2,,,1,,,\n2,SEAL,0,5,,,,10,30,2,0.1,1,2\n3,seal,0.3,0,,,,10,30,2,0.1,1,2\n";
    let choices = Choices { regime: Some(Regime::Transient), clearance_tail: Tail::Zero, ..Choices::default() };
    insta::assert_snapshot!(evaluate_with(&deck, nodes, &choices, 1).plan_text());
}

#[test]
fn a_user_subroutine_and_other_laws() {
    let deck = "*SURFACE INTERACTION, NAME=WELD\n*GAP ELECTRICAL CONDUCTANCE, USER\n*GAP CONDUCTANCE\n1., 0.\n0., 1.\n\
                *GAP RADIATION\n0.5, 0.5\n1., 0.\n0., 1.\n";
    insta::assert_snapshot!(evaluate(deck, "clearance,epot_s,epot_m\n0,1,2\n").plan_text());
}

#[test]
fn heat_generation_that_user_switches_off() {
    let deck = "*SURFACE INTERACTION, NAME=GAP, USER\n1.\n*GAP ELECTRICAL CONDUCTANCE\n20., 0.\n10., 0.1\n";
    insta::assert_snapshot!(evaluate(deck, "clearance,epot_jump,area\n0,1,2\n").plan_text());
}

#[test]
fn pore_pressure_on_one_side_only() {
    insta::assert_snapshot!("one_sided", evaluate(PORE, "clearance,pressure,por_m\n0,5,10\n").plan_text());
    let nodes = "clearance,pressure,por_s,por_m\n0,5,,10\n";
    insta::assert_snapshot!("one_side_empty", evaluate(PORE, nodes).plan_text());
    insta::assert_snapshot!("no_pore_pressure", evaluate(PORE, "clearance,pressure\n0,5\n").plan_text());
}

#[test]
fn an_interface_without_permeability_in_a_pore_analysis() {
    let deck = "*SURFACE INTERACTION, NAME=BARE\n*STEP\n*SOILS, CONSOLIDATION\n*END STEP\n";
    let nodes = "node,time,clearance,por_s,por_m\n1,0,0,1,1\n1,1,0.5,1,1\n";
    insta::assert_snapshot!("infinite", evaluate(deck, nodes).plan_text());
    let elsewhere = "*SURFACE INTERACTION, NAME=BARE\n*STEP\n*STATIC\n*END STEP\n";
    insta::assert_snapshot!("no_pore_analysis", evaluate(elsewhere, nodes).plan_text());
}

#[test]
fn procedures_that_disagree() {
    let step = |procedure: &str| format!("*STEP\n{procedure}\n*END STEP\n");
    let deck = [
        ELECTRICAL,
        &step("*COUPLED THERMAL-ELECTRICAL, STEADY STATE"),
        &step("*COUPLED THERMAL-ELECTRICAL"),
        &step("*HEAT TRANSFER, STEADY STATE"),
    ];
    let plan = evaluate(&deck.concat(), "clearance,fv1\n0.05,1\n").plan.expect("a plan");
    let regime = &plan.interactions[0].electrical.as_ref().expect("a law").regime;
    let said = "transient by *COUPLED THERMAL-ELECTRICAL of step 2, the last that solves its field; 1 procedure before it is of the other kind";
    assert_eq!(regime.to_string(), said);
}

#[test]
fn rows_that_break_the_order_form_no_table() {
    let deck = "*SURFACE INTERACTION, NAME=GAP\n*GAP ELECTRICAL CONDUCTANCE\n20., 0.\n10., 0.1\n5., 0.05\n";
    let text = evaluate(deck, "clearance\n0\n").plan_text();
    assert!(text.contains("without electrical law: its rows form no table: row 3 has 0.05 after 0.1"), "{text}");
}

#[test]
fn findings_concern_the_interaction_they_lie_in() {
    let deck = "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n1., 0.1\n2., 0.05\n*GAP ELECTRICL CONDUCTANCE\n\
                *SURFACE INTERACTION, NAME=B\n*GAP ELECTRICAL CONDUCTANCE\n1., 0.\n0., 1.\n\
                *CONTACT PAIR, INTERACTION=C\nS1, S2\n*SURFACE INTERACTION, NAME=A\n*GAP HEAT GENERATION\n1., 2.\n";
    let grammar = Grammar::builtin();
    let scanned = scan("deck.inp", deck.as_bytes(), grammar);
    let (model, problems) = read(&scanned, grammar);
    let found = inpact_validation::check(&scanned, grammar, &model, &problems);
    let codes = |name: &str| {
        let name = Name::new(name);
        let concerning = concerning(&found, &scanned, grammar, &model, &[&name], None);
        let errors = concerning.iter().filter(|found| found.severity == inpact_validation::Severity::Error);
        errors.map(|found| found.code).collect::<Vec<_>>()
    };
    // A is defined twice: what is wrong with either definition concerns it, a misspelt sub-option too.
    let of_a = codes("A");
    for code in ["T001", "K001", "R003", "P003"] {
        assert!(of_a.contains(&code), "{code} of {of_a:?}");
    }
    assert_eq!(codes("B"), Vec::<&str>::new());
    assert!(found.iter().any(|found| found.code == "R001"), "the pair names no interaction, which concerns neither");
    assert_eq!(model_of(deck).interactions.len(), 2);
}

/// the procedure that says whether a law is steady or transient feeds it, unless the run says so itself.
#[test]
fn findings_on_the_deciding_procedure_concern_the_interaction() {
    let step = |procedure: &str| format!("*STEP\n{procedure}\n*END STEP\n");
    let deck = [
        "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE\n1., 0.\n0., 1.\n*SURFACE INTERACTION, NAME=B\n"
            .to_owned(),
        step("*COUPLED THERMAL-ELECTRICAL, STEDY STATE"),
        step("*COUPLED THERMAL-ELECTRICAL, STEAYD STATE"),
        step("*HEAT TRANSFER, STEEDY STATE"),
    ];
    let grammar = Grammar::builtin();
    let deck = deck.concat();
    let scanned = scan("deck.inp", deck.as_bytes(), grammar);
    let (model, problems) = read(&scanned, grammar);
    let found = inpact_validation::check(&scanned, grammar, &model, &problems);
    let lines = |name: &str, chosen: Option<Regime>| {
        let concerning = concerning(&found, &scanned, grammar, &model, &[&Name::new(name)], chosen);
        concerning.iter().map(|found| (found.code, found.primary.position.line)).collect::<Vec<_>>()
    };
    assert_eq!(lines("A", None), [("K004", 10)]);
    assert_eq!(lines("A", Some(Regime::Transient)), []);
    assert_eq!(lines("B", None), []);
}
