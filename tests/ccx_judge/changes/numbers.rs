//! Ways to write a number.

use super::{Change, card};
use crate::cubes::Cubes;
use crate::random::Random;

pub(super) const CHANGES: &[Change] = &[
    Change {
        name: "blanks inside a number",
        apply: |cubes, random| conductance(cubes, random, &["1 00.", "10 0", "1. 5 E 2", "1\t00."]),
    },
    Change {
        name: "exponent without its letter",
        apply: |cubes, random| conductance(cubes, random, &["1.+2", "1.5+2", "15000.-2", "1+2"]),
    },
    Change {
        name: "exponent after D, Q or e",
        apply: |cubes, random| conductance(cubes, random, &["1.D2", "1d2", "1.5e+02", "1q2", "1.E+0002", "1E02"]),
    },
    Change {
        name: "sign, point",
        apply: |cubes, random| conductance(cubes, random, &["+120.", "0120", "120", ".12E3", "+.12E+3"]),
    },
    Change {
        name: "more than 20 characters, same value",
        apply: |cubes, random| {
            conductance(
                cubes,
                random,
                &["100.00000000000000000000", "000000000000000000100.", "33.333333333333333333333"],
            );
        },
    },
    Change {
        name: "more than 20 characters, another value",
        apply: |cubes, random| {
            conductance(
                cubes,
                random,
                &[
                    "5.0000000000000000e+01",
                    "0.00000000000000000000000001e+28",
                    "000000000000000000000100.",
                    "1.00000000000000000e+02",
                ],
            );
        },
    },
    Change {
        name: "no number",
        apply: |cubes, random| {
            conductance(
                cubes,
                random,
                &[
                    "1.2.3", "abc", "1e", "0x10", "1_0", "1/2", "1e+", "1E2E2", "\"100\"", "100;", "1f2", "<h>",
                    "1e5.", "12 abc",
                ],
            );
        },
    },
    Change {
        name: "signs and points only",
        apply: |cubes, random| conductance(cubes, random, &["--1", "+-1", ".", "+", "-.", "e5"]),
    },
    Change {
        name: "not a number, infinite, too large",
        apply: |cubes, random| conductance(cubes, random, &["nan", "inf", "-infinity", "1e400", "NaN(1)"]),
    },
    Change { name: "very small number", apply: |cubes, random| conductance(cubes, random, &["1e-400", "1e-300"]) },
    Change { name: "pressure or temperature written otherwise", apply: other_items },
];

/// Writes the first conductance otherwise.
fn conductance(cubes: &mut Cubes, random: &mut Random, texts: &[&'static str]) {
    replace_item(cubes, 0, random.of(texts));
}

fn other_items(cubes: &mut Cubes, random: &mut Random) {
    let (item, text) = random.of(&[
        (1, "0 ."),
        (1, "0.+0"),
        (1, "abc"),
        (1, "0D0"),
        (2, "261.5D0"),
        (2, "26 1.5"),
        (2, "x"),
        (2, "261.5000000000000000000"),
    ]);
    replace_item(cubes, item, text);
}

fn replace_item(cubes: &mut Cubes, item: usize, text: &str) {
    let Some(row) = card(cubes, "GAP CONDUCTANCE").and_then(|card| card.rows.first_mut()) else { return };
    let mut items: Vec<&str> = row.split(',').collect();
    if let Some(place) = items.get_mut(item) {
        *place = text;
    }
    *row = items.join(",");
}
