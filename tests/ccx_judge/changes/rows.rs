//! Rows of *GAP CONDUCTANCE: how many, of how many items, in which order, with what between them.

use super::{Change, card, set_rows};
use crate::cubes::Cubes;
use crate::random::Random;

pub(super) const CHANGES: &[Change] = &[
    Change { name: "empty line among the rows", apply: |cubes, random| insert(cubes, random, &["", "   ", "\t"]) },
    Change {
        name: "comment among the rows",
        apply: |cubes, random| insert(cubes, random, &["** x", "  ** x", "\t**", "***"]),
    },
    Change {
        name: "fourth item",
        apply: |cubes, random| lengthen(cubes, random, &[", 5.", ", abc", ", ", ",,", ", 5., 6., 7."]),
    },
    Change {
        name: "more than 16 items",
        apply: |cubes, random| lengthen(cubes, random, &[",1,2,3,4,5,6,7,8,9,10,11,12,13,14", ",,,,,,,,,,,,,,,,,,"]),
    },
    Change { name: "items absent", apply: absent_items },
    Change { name: "no rows", apply: |cubes, _| set_rows(cubes, "GAP CONDUCTANCE", &[]) },
    Change {
        name: "one row",
        apply: |cubes, random| {
            set_rows(cubes, "GAP CONDUCTANCE", &[random.of(&["100.", "100., 0.", "100., 500., 300."])]);
        },
    },
    Change { name: "long line", apply: long_line },
    Change {
        name: "two rows on one line",
        apply: |cubes, _| set_rows(cubes, "GAP CONDUCTANCE", &["100., 0., 293., 200., 500., 293."]),
    },
    Change {
        name: "pressures out of order",
        apply: |cubes, _| {
            set_rows(
                cubes,
                "GAP CONDUCTANCE",
                &["100., 0., 293.", "400., 1000., 293.", "200., 500., 293.", "1000., 5000., 293."],
            );
        },
    },
    Change {
        name: "a pressure twice",
        apply: |cubes, _| {
            set_rows(
                cubes,
                "GAP CONDUCTANCE",
                &["100., 0., 293.", "200., 500., 293.", "300., 500., 293.", "1000., 5000., 293."],
            );
        },
    },
    Change { name: "temperatures out of order", apply: temperatures_out_of_order },
    Change { name: "one curve of a single row", apply: single_row_curve },
    Change {
        name: "curves that share no pressures",
        apply: |cubes, _| {
            set_rows(
                cubes,
                "GAP CONDUCTANCE",
                &["100., 0., 250.", "200., 500., 250.", "300., 600., 450.", "400., 900., 450."],
            );
        },
    },
    Change { name: "curves over different pressures", apply: other_ranges },
    Change { name: "table begins above or below zero pressure", apply: other_start },
    Change {
        name: "conductance negative or zero",
        apply: |cubes, random| {
            set_rows(cubes, "GAP CONDUCTANCE", &[random.of(&["-100., 0., 293.", "0., 0., 293."]), "200., 500., 293."]);
        },
    },
    Change { name: "twenty rows", apply: twenty_rows },
    Change { name: "carriage returns", apply: carriage_returns },
];

fn insert(cubes: &mut Cubes, random: &mut Random, lines: &[&'static str]) {
    if let Some(card) = card(cubes, "GAP CONDUCTANCE") {
        card.rows.insert(random.below(card.rows.len() + 1), random.of(lines).to_owned());
    }
}

fn lengthen(cubes: &mut Cubes, random: &mut Random, items: &[&'static str]) {
    if let Some(row) = card(cubes, "GAP CONDUCTANCE").and_then(|card| card.rows.first_mut()) {
        *row += random.of(items);
    }
}

fn absent_items(cubes: &mut Cubes, random: &mut Random) {
    let row = random.of(&["100.", "100., 0.", "100., , 0.", ", 0., 0.", "100., 0., ", ",", "100.,"]);
    set_rows(cubes, "GAP CONDUCTANCE", &[row, "300., 2000."]);
}

fn long_line(cubes: &mut Cubes, random: &mut Random) {
    let blanks = " ".repeat(random.of(&[200, 300, 900]));
    if let Some(row) = card(cubes, "GAP CONDUCTANCE").and_then(|card| card.rows.first_mut()) {
        *row = row.replacen(", ", &format!(",{blanks}"), 1);
    }
}

fn temperatures_out_of_order(cubes: &mut Cubes, random: &mut Random) {
    let rows: &[&str] = if random.once_in(2) {
        &["100., 0., 450.", "200., 500., 450.", "300., 0., 250.", "400., 900., 250."]
    } else {
        &["100., 0., 250.", "300., 0., 450.", "200., 500., 250.", "400., 500., 450."]
    };
    set_rows(cubes, "GAP CONDUCTANCE", rows);
}

fn single_row_curve(cubes: &mut Cubes, random: &mut Random) {
    let single = random.of(&["100., 0., 250.", "100., 250., 250.", "100., 5000., 250."]);
    set_rows(cubes, "GAP CONDUCTANCE", &[single, "300., 0., 450.", "400., 900., 450."]);
}

fn other_ranges(cubes: &mut Cubes, random: &mut Random) {
    let first = random.of(&["300., 500., 451.", "300., 100., 451.", "300., 0., 451."]);
    set_rows(
        cubes,
        "GAP CONDUCTANCE",
        &["100., 0., 250.", "200., 1000., 250.", "1000., 5000., 250.", first, "700., 2000., 451."],
    );
}

fn other_start(cubes: &mut Cubes, random: &mut Random) {
    let first = random.of(&["100., 100., 293.", "100., -100., 293."]);
    set_rows(cubes, "GAP CONDUCTANCE", &[first, "200., 500., 293."]);
}

fn twenty_rows(cubes: &mut Cubes, _: &mut Random) {
    if let Some(card) = card(cubes, "GAP CONDUCTANCE") {
        card.rows = (0..20).map(|row| format!("{}., {}., 293.", 100 + 10 * row, 100 * row)).collect();
    }
}

fn carriage_returns(cubes: &mut Cubes, _: &mut Random) {
    for row in card(cubes, "GAP CONDUCTANCE").into_iter().flat_map(|card| &mut card.rows) {
        row.push('\r');
    }
}
