//! Parts of a model beside tables that radiation and the friction of CalculiX need: constants, emissivities, a speed.

use inpact_parser::deck::scan;
use inpact_parser::grammar::{Dialect, Grammar, Release};
use inpact_parser::model::{Model, Name, PhysicalConstants, SubOption, read};

fn model_of(deck: &str, grammar: &Grammar) -> Model {
    read(&scan("deck.inp", deck.as_bytes(), grammar), grammar).0
}

#[test]
fn the_constants_of_the_deck_at_any_place() {
    let constants = |deck: &str| model_of(deck, Grammar::builtin()).constants;
    let given = |absolute_zero, stefan_boltzmann| PhysicalConstants { absolute_zero, stefan_boltzmann };
    assert_eq!(constants("*SURFACE INTERACTION, NAME=A\n"), given(None, None));
    assert_eq!(
        constants("*SURFACE INTERACTION, NAME=A\n*PHYSICAL CONSTANTS, ABS=-273.15, STEFANB=5.67D-8\n"),
        given(Some(-273.15), Some(5.67e-8))
    );
    // A parameter, and a second line that gives the other constant.
    let deck = "*PHYSICAL CONSTANTS, ABSOLUTE ZERO=<zero>\n*PARAMETER\nzero = -459.67\n\
                *PHYSICAL CONSTANTS, STEFAN BOLTZMANN=0.1714E-8\n";
    assert_eq!(constants(deck), given(Some(-459.67), Some(0.1714e-8)));
    assert_eq!(constants("*PHYSICAL CONSTANTS, ABSOLUTE ZERO=cold\n"), given(None, None));
}

#[test]
fn rows_that_are_kept_as_texts_as_numbers() {
    let deck = "*PARAMETER\nshiny = 1/4.\n*SURFACE INTERACTION, NAME=A\n*GAP RADIATION\n <shiny> , 8.D-1\n\n1.,\n,0.1,,\n0.5-1, <none>\n";
    let model = model_of(deck, Grammar::builtin());
    let option: &SubOption = &model.interactions[&Name::new("A")].other[0];
    let rows = option.numbers(&model.parameters);
    assert_eq!(rows[..3], [vec![0.25, 0.8], vec![1.0], vec![0.0, 0.1]]);
    assert!(rows[3].iter().all(|number| number.is_nan()) && rows.len() == 4);
}

#[test]
fn the_speed_of_a_row_of_calculix() {
    let grammar = Grammar::new(Dialect::Calculix, Release::NEWEST);
    let speed = |row: &str| {
        let deck = format!("*SURFACE INTERACTION,NAME=A\n*GAP HEAT GENERATION\n{row}\n");
        let model = model_of(&deck, &grammar);
        model.interactions[&Name::new("A")]
            .gap_heat_generation
            .as_ref()
            .map(|heat| (heat.fraction, heat.slave_weight, heat.given_slip_rate()))
    };
    assert_eq!(speed("0.8, 0.25, 3.0"), Some((0.8, 0.25, Some(3.0))));
    assert_eq!(speed("0.8, 0.25, 0."), Some((0.8, 0.25, Some(0.0))));
    assert_eq!(speed("0.8, 0.25, -1."), Some((0.8, 0.25, None)));
    // CX-10: an item that is absent is 0, whether a comma stands for it or nothing does.
    assert_eq!(speed("0.8"), Some((0.8, 0.0, Some(0.0))));
    assert_eq!(speed("0.8,,3."), Some((0.8, 0.0, Some(3.0))));
    // Of several rows the last counts.
    assert_eq!(speed("0.8, 0.25, 3.0\n0.5"), Some((0.5, 0.0, Some(0.0))));
    let model = model_of("*SURFACE INTERACTION, NAME=A\n*GAP HEAT GENERATION\n0.8, 0.25\n", Grammar::builtin());
    assert_eq!(model.interactions[&Name::new("A")].gap_heat_generation.as_ref().map(|heat| heat.slip_rate), Some(None));
}
