//! Cards and their order.

use super::{Change, reword, set_rows, take};
use crate::cubes::{Card, Closure, Cubes};
use crate::random::Random;

pub(super) const CHANGES: &[Change] = &[
    Change { name: "cards after the pair", apply: cards_after_pair },
    Change { name: "cards in the step", apply: cards_in_step },
    Change { name: "interaction in the step", apply: |cubes, _| cubes.in_step.append(&mut cubes.cards) },
    Change { name: "pair before the interaction", apply: |cubes, _| cubes.pair_first = true },
    Change { name: "pair in the step", apply: pair_in_step },
    Change { name: "another card between the sub-options", apply: card_between },
    Change { name: "*SURFACE BEHAVIOR missing", apply: |cubes, _| drop(take(cubes, "SURFACE BEHAVIOR")) },
    Change { name: "*SURFACE BEHAVIOR after", apply: behavior_last },
    Change { name: "sub-options in another order", apply: shuffled },
    Change { name: "sub-option before the interaction", apply: before_the_interaction },
    Change { name: "*GAP CONDUCTANCE missing", apply: |cubes, _| drop(take(cubes, "GAP CONDUCTANCE")) },
    Change { name: "*GAP CONDUCTANCE twice", apply: second_conductance },
    Change { name: "another interaction beside it", apply: another_interaction },
    Change { name: "interaction defined twice", apply: duplicate_interaction },
    Change { name: "pair names no interaction that exists", apply: other_name },
    Change { name: "*SURFACE BEHAVIOR of another kind", apply: other_behavior },
    Change { name: "*SURFACE BEHAVIOR with rows that do not fit", apply: behavior_rows },
    Change { name: "contact type", apply: contact_type },
    Change { name: "slave and master exchanged", apply: exchanged },
    Change { name: "surfaces of the pair", apply: pair_rows },
    Change { name: "*FRICTION rows", apply: friction_rows },
    Change { name: "row under *SURFACE INTERACTION", apply: interaction_rows },
    Change { name: "*CHANGE FRICTION in the step", apply: change_friction },
    Change { name: "unknown keyword between", apply: unknown_card },
];

fn other_name(cubes: &mut Cubes, _: &mut Random) {
    reword(cubes, "CONTACT PAIR", "=SI", "=TI");
}

/// The place of one of the sub-options, where there are any.
fn sub_option(cubes: &Cubes, random: &mut Random) -> Option<usize> {
    let count = cubes.cards.len().checked_sub(1).filter(|count| 0 < *count)?;
    Some(1 + random.below(count))
}

fn cards_after_pair(cubes: &mut Cubes, random: &mut Random) {
    if let Some(place) = sub_option(cubes, random) {
        cubes.after.extend(cubes.cards.split_off(place));
    }
}

fn cards_in_step(cubes: &mut Cubes, random: &mut Random) {
    if let Some(place) = sub_option(cubes, random) {
        cubes.in_step.extend(cubes.cards.split_off(place));
    }
}

fn pair_in_step(cubes: &mut Cubes, _: &mut Random) {
    let other = Card::new("AMPLITUDE", "NAME=A", &["0., 0., 1., 1."]);
    let pair = std::mem::replace(&mut cubes.pair, other);
    cubes.in_step.push(pair);
}

fn card_between(cubes: &mut Cubes, random: &mut Random) {
    let other = match random.below(4) {
        0 => Card::new("AMPLITUDE", "NAME=AMP", &["0., 0., 1., 1."]),
        1 => Card::new("NSET", "NSET=SOME", &["1, 2"]),
        2 => Card::new("PHYSICAL CONSTANTS", "ABSOLUTE ZERO=0., STEFAN BOLTZMANN=5.67E-8", &[]),
        _ => Card::new("BOUNDARY", "", &["1, 1, 3"]),
    };
    if let Some(place) = sub_option(cubes, random) {
        cubes.cards.insert(place, other);
    }
}

fn unknown_card(cubes: &mut Cubes, random: &mut Random) {
    let other = random.of(&["CONTACT CONTROLS", "FOO BAR", "GAP ELECTRICAL CONDUCTANCE", "GAP RADIATION", "PREPRINT"]);
    let rows: &[&str] = if random.once_in(2) { &["1., 2."] } else { &[] };
    if let Some(place) = sub_option(cubes, random) {
        cubes.cards.insert(place, Card::new(other, "", rows));
    }
}

fn behavior_last(cubes: &mut Cubes, _: &mut Random) {
    if let Some(card) = take(cubes, "SURFACE BEHAVIOR") {
        cubes.cards.push(card);
    }
}

fn shuffled(cubes: &mut Cubes, random: &mut Random) {
    for place in (2..cubes.cards.len()).rev() {
        let other = 1 + random.below(place);
        cubes.cards.swap(place, other);
    }
}

fn before_the_interaction(cubes: &mut Cubes, random: &mut Random) {
    if let Some(place) = sub_option(cubes, random) {
        let card = cubes.cards.remove(place);
        cubes.cards.insert(0, card);
    }
}

fn second_conductance(cubes: &mut Cubes, _: &mut Random) {
    cubes.after.push(Card::new("GAP CONDUCTANCE", "", &["77., 0., 300.", "99., 1000., 300."]));
}

fn another_interaction(cubes: &mut Cubes, random: &mut Random) {
    let other = [
        Card::new("SURFACE INTERACTION", "NAME=OTHER", &[]),
        Card::new("SURFACE BEHAVIOR", "PRESSURE-OVERCLOSURE=LINEAR", &["2e+07, 0., 0.001"]),
        Card::new("GAP CONDUCTANCE", "", &["12., 0., 300."]),
    ];
    let place = if random.once_in(2) { &mut cubes.before } else { &mut cubes.after };
    place.extend(other);
}

fn duplicate_interaction(cubes: &mut Cubes, random: &mut Random) {
    another_interaction(cubes, random);
    for card in cubes.before.iter_mut().chain(&mut cubes.after) {
        card.line = card.line.replace("OTHER", "SI");
        if let Some(row) = card.rows.first_mut().filter(|row| row.starts_with("2e")) {
            row.replace_range(..1, "1");
        }
    }
}

fn other_behavior(cubes: &mut Cubes, random: &mut Random) {
    let exponential = |contact: f64, at_zero: f64| Closure::Exponential { rate: 100.0_f64.ln() / contact, at_zero };
    let (kind, row, closure) = match random.below(7) {
        0 => ("HARD", "", Closure::DEFAULT),
        1 => ("LINEAR", "", Closure::DEFAULT),
        2 => ("EXPONENTIAL", "1.E-3, 300.", exponential(1e-3, 300.0)),
        3 => ("TABULAR", "0., 0.\n2000., 2.E-4", Closure::Table { stiffness: 1e7, last: 2e-4 }),
        4 => ("TIED", "1.E7", Closure::Linear(1e7)),
        5 => ("LINEAR", "-1.", Closure::DEFAULT),
        _ => ("HARD", "2.E7", Closure::Linear(2e7)),
    };
    reword(cubes, "SURFACE BEHAVIOR", "LINEAR", kind);
    if row.is_empty() {
        set_rows(cubes, "SURFACE BEHAVIOR", &[]);
    } else {
        set_rows(cubes, "SURFACE BEHAVIOR", &[row]);
    }
    cubes.closure = closure;
}

fn behavior_rows(cubes: &mut Cubes, random: &mut Random) {
    let (kind, row) = random.of(&[
        ("LINEAR", "abc"),
        ("LINEAR", "1.E7, abc"),
        ("LINEAR", "1.E7, , abc"),
        ("LINEAR", "1.E7, , , abc"),
        ("LINEAR", "1.E7\n2.E7"),
        ("LINEAR", "1.E7, 0., 0.001, 5."),
        ("EXPONENTIAL", ""),
        ("EXPONENTIAL", "0., 300."),
        ("EXPONENTIAL", "1.E-3, -1."),
        ("EXPONENTIAL", "abc, 1."),
        ("TABULAR", ""),
        ("TABULAR", "abc, 1."),
        ("TABULAR", "0., 0., x"),
        ("HARD", "abc"),
        ("TIED", "abc"),
    ]);
    reword(cubes, "SURFACE BEHAVIOR", "LINEAR", kind);
    set_rows(cubes, "SURFACE BEHAVIOR", if row.is_empty() { &[] } else { std::slice::from_ref(&row) });
    if kind == "LINEAR" {
        cubes.closure = Closure::Linear(1e7);
    }
}

fn contact_type(cubes: &mut Cubes, random: &mut Random) {
    let kind = random.of(&["NODE TO SURFACE", "MASSLESS", "FOO", "SURFACE-TO-SURFACE", "surface to surface"]);
    reword(cubes, "CONTACT PAIR", "SURFACE TO SURFACE", kind);
}

fn exchanged(cubes: &mut Cubes, _: &mut Random) {
    set_rows(cubes, "CONTACT PAIR", &["SMAST, SSLAV"]);
    cubes.slave_is_upper = false;
}

fn pair_rows(cubes: &mut Cubes, random: &mut Random) {
    let row = random.of(&[
        "SSLAV",
        "SSLAV, NONE",
        "NONE, SMAST",
        ", SMAST",
        "SSLAV,",
        "",
        "SSLAV, SMAST, ORI",
        "SSLAV, SMAST,",
    ]);
    set_rows(cubes, "CONTACT PAIR", if row.is_empty() { &[] } else { std::slice::from_ref(&row) });
}

fn friction_rows(cubes: &mut Cubes, random: &mut Random) {
    let row = random.of(&[
        "0., 1.E7",
        "-0.3, 1.E7",
        "abc, 1.E7",
        "0.3, abc",
        "0.3, 1.E7, abc",
        "0.3, 1.E7, 2., 3.",
        ", 1.E7",
    ]);
    if cubes.friction.is_some() {
        set_rows(cubes, "FRICTION", &[row]);
        cubes.friction = Some(0.3);
    }
}

fn interaction_rows(cubes: &mut Cubes, random: &mut Random) {
    let row = random.of(&["1.,", "abc", "1., 2."]);
    set_rows(cubes, "SURFACE INTERACTION", &[row]);
}

fn change_friction(cubes: &mut Cubes, _: &mut Random) {
    let Some(friction) = cubes.friction else { return };
    cubes.in_step.push(Card::new("CHANGE FRICTION", "INTERACTION=SI", &[]));
    cubes.in_step.push(Card { rows: vec![format!("{friction}, 1.E7")], ..Card::new("FRICTION", "", &[]) });
}
