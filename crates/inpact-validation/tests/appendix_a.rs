//! Test vectors of appendix A of the semantics at the level of a deck.

use inpact_parser::deck::scan;
use inpact_parser::grammar::Grammar;
use inpact_parser::model;

/// The codes of the errors in a deck.
fn errors(text: &str) -> Vec<&'static str> {
    let grammar = Grammar::builtin();
    let deck = scan("deck", text.as_bytes(), grammar);
    let (model, problems) = model::read(&deck, grammar);
    let findings = inpact_validation::check(&deck, grammar, &model, &problems);
    let errors = findings.iter().filter(|found| found.severity == inpact_validation::Severity::Error);
    errors.map(|found| found.code).collect()
}

#[test]
fn a_40_allowed_places_of_a_sub_option() {
    let electrical = "*GAP ELECTRICAL CONDUCTANCE, PRESSURE\n1., 0.\n";
    let interaction = "*SURFACE INTERACTION, NAME=A\n";
    assert_eq!(errors(&format!("{interaction}*STEP\n{electrical}*STATIC\n*END STEP\n")), ["K013"]);
    assert_eq!(errors(&format!("{electrical}{interaction}")), ["K012"]);
    assert_eq!(errors(&format!("*PART, NAME=P\n{interaction}{electrical}*END PART\n")), ["K013"]);
    let gap = "*PART, NAME=P\n*GAP, ELSET=E\n0.1,\n*GAP CONDUCTANCE\n1., 0.\n0., 1.\n*END PART\n";
    assert_eq!(errors(gap), Vec::<&str>::new());
}

#[test]
fn a_41_a_pair_names_an_interaction_that_exists() {
    assert_eq!(errors("*SURFACE INTERACTION, NAME=A\n*CONTACT PAIR\nS, M\n"), ["R005"]);
    assert_eq!(errors("*SURFACE INTERACTION, NAME=A\n*CONTACT PAIR, INTERACTION=OTHER\nS, M\n"), ["R001"]);
    assert_eq!(errors("*SURFACE INTERACTION, NAME=A\n*CONTACT PAIR, INTERACTION=a\nS, M\n"), Vec::<&str>::new());
}
