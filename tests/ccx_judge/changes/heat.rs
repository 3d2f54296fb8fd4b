//! Rows and parameters of *GAP HEAT GENERATION.

use super::{Change, append, set_rows, take};
use crate::cubes::Cubes;
use crate::random::Random;

const HEAT: &str = "GAP HEAT GENERATION";

pub(super) const CHANGES: &[Change] = &[
    Change {
        name: "heat generation: items absent",
        apply: |cubes, random| row(cubes, random, &["0.8", "0.8, 0.25", "0.8,,3.", ",0.25,3.", ""]),
    },
    Change {
        name: "heat generation: fraction",
        apply: |cubes, random| row(cubes, random, &["0., 0.5, 3.", "-1., 0.5, 3.", "1.5, 0.5, 3.", "abc, 0.5, 3."]),
    },
    Change {
        name: "heat generation: share",
        apply: |cubes, random| row(cubes, random, &["1., -0.5, 3.", "1., 1.5, 3.", "1., abc, 3.", "1., 1.0000001, 3."]),
    },
    Change {
        name: "heat generation: speed",
        apply: |cubes, random| row(cubes, random, &["1., 0.5, 0.", "1., 0.5, abc", "1., 0.5, 3., 4.", "1., 0.5, 1.+1"]),
    },
    Change {
        name: "heat generation: several rows",
        apply: |cubes, random| {
            row(cubes, random, &["0.8, 0.25, 3.\n0.4, 0.25, 3.", "0.8, 0.25, 3.\n0.5", "0., 0.25, 3.\n0.4, 0.25, 3."]);
        },
    },
    Change { name: "heat generation: no rows", apply: |cubes, _| set_rows(cubes, HEAT, &[]) },
    Change { name: "heat generation without friction", apply: without_friction },
    Change { name: "heat generation: card twice", apply: twice },
    Change {
        name: "heat generation: parameter",
        apply: |cubes, random| append(cubes, HEAT, random.of(&[", FOO", ", DEPENDENCIES=1"])),
    },
];

fn row(cubes: &mut Cubes, random: &mut Random, rows: &[&'static str]) {
    set_rows(cubes, HEAT, &[random.of(rows)]);
}

fn without_friction(cubes: &mut Cubes, _: &mut Random) {
    drop(take(cubes, "FRICTION"));
}

fn twice(cubes: &mut Cubes, random: &mut Random) {
    let Some(mut card) = cubes.cards.iter().find(|card| card.of == HEAT).cloned() else { return };
    card.rows = vec![random.of(&["0.4, 0.5, 2.", "0.3"]).to_owned()];
    cubes.after.push(card);
}
