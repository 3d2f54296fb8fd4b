//! Test vectors of appendix A of the semantics that need a whole deck; the others stand beside what they test.

use inpact_parser::deck::scan;
use inpact_parser::grammar::Grammar;
use inpact_parser::model::{self, Model};

fn model_of(deck: &str) -> Model {
    let (model, problems) = model::read(&scan("deck", deck.as_bytes(), Grammar::builtin()), Grammar::builtin());
    assert_eq!(problems, []);
    model
}

#[test]
fn a_07_one_text_means_two_things_under_two_keywords() {
    let model = model_of(
        "*SURFACE INTERACTION, NAME=A\n*GAP ELECTRICAL CONDUCTANCE, DEPENDENCIES=1\n10.,,,1.\n\
         *GAP CONDUCTANCE, DEPENDENCIES=1\n10.,,,1.\n",
    );
    let interaction = &model.interactions[0];
    let electrical = interaction.gap_electrical_conductance.as_ref().and_then(|law| law.clearance.as_deref());
    let electrical = electrical.expect("a table");
    assert_eq!(*electrical.columns, ["conductance", "clearance", "temp", "fv1"]);
    assert_eq!(electrical.row(0), [10., 0., 0., 1.]);
    let thermal = interaction.other[0].table.as_ref().expect("a table");
    assert_eq!(*thermal.columns, ["conductance", "clearance", "temp", "mass_flow", "fv1"]);
    assert_eq!(thermal.row(0), [10., 0., 0., 1., 0.]);
}

/// The interaction of a pair of surfaces follows from these lines, the last one first.
#[test]
fn a_42_the_lines_of_a_property_assignment() {
    let model = model_of("*CONTACT PROPERTY ASSIGNMENT\n, , P1\nS1, S1, P2\nS2, S3,\n, S4, P3\n");
    let name = |reference: &Option<model::Reference>| reference.as_ref().map(|found| found.name.to_string());
    let lines = model.property_assignments.iter();
    let lines: Vec<_> = lines.map(|line| (name(&line.first), name(&line.second), name(&line.interaction))).collect();
    let text = |text: &str| Some(text.to_owned());
    let expected = [
        (None, None, text("P1")),
        (text("S1"), text("S1"), text("P2")),
        (text("S2"), text("S3"), None),
        (None, text("S4"), text("P3")),
    ];
    assert_eq!(lines, expected);
}
