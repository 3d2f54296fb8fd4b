//! Names of interactions and surfaces: quotes, digits, periods, blanks, case, length.

use super::{Change, reword, set_rows};
use crate::cubes::Cubes;
use crate::random::Random;

pub(super) const CHANGES: &[Change] = &[
    Change {
        name: "name in quotes",
        apply: |cubes, random| rename(cubes, random, &[["\"SI\""; 2], ["\"s i\"", "\"S I\""]]),
    },
    Change {
        name: "name in quotes on one side",
        apply: |cubes, random| rename(cubes, random, &[["\"SI\"", "SI"], ["SI", "\"SI\""]]),
    },
    Change { name: "name with digits, periods, dashes, parentheses", apply: odd_name },
    Change {
        name: "name in another case or with blanks",
        apply: |cubes, random| rename(cubes, random, &[["Steel Gap", "STEELGAP"], ["si", "SI"], ["S\tI", "si"]]),
    },
    Change {
        name: "name with a quote or comma inside",
        apply: |cubes, random| rename(cubes, random, &[["S\"I"; 2], ["S'I"; 2], ["\"A,B\""; 2]]),
    },
    Change { name: "long name", apply: long_name },
    Change { name: "names of surfaces", apply: surface_names },
];

fn rename(cubes: &mut Cubes, random: &mut Random, names: &[[&'static str; 2]]) {
    let [defined, used] = random.of(names);
    reword(cubes, "CONTACT PAIR", "INTERACTION=SI", &format!("INTERACTION={used}"));
    if reword(cubes, "SURFACE INTERACTION", "NAME=SI", &format!("NAME={defined}")) {
        // CalculiX cuts a name at a comma.
        defined.split(',').next().unwrap_or_default().clone_into(&mut cubes.interaction);
    }
}

fn odd_name(cubes: &mut Cubes, random: &mut Random) {
    let names = ["1SI", "S.I", "S-1", "(SI)", "_SI", "S/I", "S=I", "__SI__", "123"];
    rename(cubes, random, &names.map(|name| [name; 2]));
}

fn long_name(cubes: &mut Cubes, random: &mut Random) {
    let length = random.of(&[79, 80, 81, 100]);
    let name = "N".repeat(length);
    reword(cubes, "CONTACT PAIR", "INTERACTION=SI", &format!("INTERACTION={name}"));
    if reword(cubes, "SURFACE INTERACTION", "NAME=SI", &format!("NAME={name}")) {
        cubes.interaction = name;
    }
}

fn surface_names(cubes: &mut Cubes, random: &mut Random) {
    let (defined, used) = random.of(&[
        ("\"S M\"", "\"SM\""),
        ("\"SM\"", "SM"),
        ("S M", "sm"),
        ("1SM", "1SM"),
        ("S.M", "S.M"),
        ("M-1", "M-1"),
        ("SM", "S"),
        ("SM", "SMM"),
    ]);
    defined.clone_into(&mut cubes.surfaces[0]);
    set_rows(cubes, "CONTACT PAIR", &[&format!("SSLAV, {used}")]);
}
