//! Keyword lines: parameters and keywords that are unknown, abbreviated, too long, given twice or not at all.

use super::{Change, any, append, card, reword};
use crate::cubes::Cubes;
use crate::random::Random;

pub(super) const CHANGES: &[Change] = &[
    Change { name: "unknown parameter", apply: unknown_parameter },
    Change { name: "unknown parameter of the Abaqus keyword", apply: abaqus_parameter },
    Change { name: "abbreviated parameter", apply: abbreviated_parameter },
    Change { name: "abbreviated parameter value", apply: abbreviated_value },
    Change { name: "parameter value with more letters", apply: longer_value },
    Change { name: "parameter with more letters", apply: longer_parameter },
    Change { name: "keyword with more letters", apply: longer_keyword },
    Change { name: "abbreviated keyword", apply: abbreviated_keyword },
    Change { name: "misspelt keyword", apply: misspelt_keyword },
    Change { name: "parameter missing", apply: missing_parameter },
    Change { name: "parameter without its value", apply: without_value },
    Change { name: "parameter given twice", apply: twice },
    Change {
        name: "comma at the end of a keyword line",
        apply: |cubes, random| append(cubes, any(cubes, random), ","),
    },
    Change { name: "two commas in a keyword line", apply: |cubes, random| append(cubes, any(cubes, random), ",,FOO") },
    Change { name: "blanks and small letters in a keyword line", apply: blanks },
    Change { name: "keyword line over two lines", apply: continued },
    Change { name: "keyword after blanks", apply: indented },
];

fn unknown_parameter(cubes: &mut Cubes, random: &mut Random) {
    let parameters = random.of(&[", FOO", ", FOO=1", ", FOO=BAR BAR", ", 12", ", =3"]);
    append(cubes, any(cubes, random), parameters);
}

fn abaqus_parameter(cubes: &mut Cubes, random: &mut Random) {
    let (of, parameters) = random.of(&[
        ("GAP CONDUCTANCE", ", PRESSURE"),
        ("GAP CONDUCTANCE", ", DEPENDENCIES=1"),
        ("SURFACE INTERACTION", ", TRACKING THICKNESS=1."),
        ("SURFACE INTERACTION", ", UNSYMM"),
        ("SURFACE BEHAVIOR", ", AUGMENTED LAGRANGE"),
        ("SURFACE BEHAVIOR", ", NO SEPARATION"),
        ("SURFACE BEHAVIOR", ", DIRECT"),
        ("FRICTION", ", LAGRANGE"),
        ("FRICTION", ", SLIP TOLERANCE=0.005"),
        ("CONTACT PAIR", ", CPSET=A"),
        ("CONTACT PAIR", ", SMOOTH=0.2"),
        ("CONTACT PAIR", ", SMALL SLIDING"),
        ("CONTACT PAIR", ", ADJUST=0.0"),
        ("CONTACT PAIR", ", ADJUST=NOSET"),
        ("CONTACT PAIR", ", NO THICKNESS"),
    ]);
    append(cubes, of, parameters);
}

fn abbreviated_parameter(cubes: &mut Cubes, random: &mut Random) {
    let (of, from, to) = random.of(&[
        ("SURFACE INTERACTION", "NAME=", "N="),
        ("SURFACE INTERACTION", "NAME=", "NAM="),
        ("CONTACT PAIR", "INTERACTION=", "INT="),
        ("CONTACT PAIR", "TYPE=", "TYP="),
        ("SURFACE BEHAVIOR", "PRESSURE-OVERCLOSURE=", "PRESSURE="),
        ("SURFACE BEHAVIOR", "PRESSURE-OVERCLOSURE=", "PRESS="),
    ]);
    reword(cubes, of, from, to);
}

fn abbreviated_value(cubes: &mut Cubes, random: &mut Random) {
    let (of, from, to) = random.of(&[
        ("CONTACT PAIR", "SURFACE TO SURFACE", "SURF"),
        ("CONTACT PAIR", "SURFACE TO SURFACE", "SURFACE"),
        ("SURFACE BEHAVIOR", "LINEAR", "LIN"),
        ("SURFACE BEHAVIOR", "LINEAR", "L"),
    ]);
    reword(cubes, of, from, to);
}

fn longer_value(cubes: &mut Cubes, random: &mut Random) {
    let (of, from, to) = random.of(&[
        ("CONTACT PAIR", "SURFACE TO SURFACE", "SURFACE TO SURFACES"),
        ("SURFACE BEHAVIOR", "LINEAR", "LINEARLY"),
    ]);
    reword(cubes, of, from, to);
}

fn longer_parameter(cubes: &mut Cubes, random: &mut Random) {
    let (of, from, to) = random.of(&[
        ("SURFACE INTERACTION", "NAME=", "NAMES="),
        ("CONTACT PAIR", "INTERACTION=", "INTERACTIONS="),
        ("SURFACE BEHAVIOR", "OVERCLOSURE=", "OVERCLOSURES="),
        ("CONTACT PAIR", "TYPE=SURFACE TO SURFACE", "TYPE=SURFACE TO SURFACE, SMALL SLIDINGS"),
    ]);
    reword(cubes, of, from, to);
}

fn longer_keyword(cubes: &mut Cubes, random: &mut Random) {
    let of = any(cubes, random);
    let longer = random.of(&["S", "X", "ING", " CARD"]);
    reword(cubes, of, of, &format!("{of}{longer}"));
}

fn abbreviated_keyword(cubes: &mut Cubes, random: &mut Random) {
    let of = any(cubes, random);
    reword(cubes, of, of, &of[..of.len() - random.of(&[1, 2, 4])]);
}

fn misspelt_keyword(cubes: &mut Cubes, random: &mut Random) {
    let of = any(cubes, random);
    let (from, to) = random.of(&[("C", "K"), ("A", "AA"), ("I", "Y"), ("N", "")]);
    reword(cubes, of, of, &of.replacen(from, to, 1));
}

fn missing_parameter(cubes: &mut Cubes, random: &mut Random) {
    let (of, parameters) = random.of(&[
        ("SURFACE INTERACTION", ", NAME=SI"),
        ("CONTACT PAIR", ", INTERACTION=SI"),
        ("CONTACT PAIR", ", TYPE=SURFACE TO SURFACE"),
        ("SURFACE BEHAVIOR", ", PRESSURE-OVERCLOSURE=LINEAR"),
    ]);
    reword(cubes, of, parameters, "");
}

fn without_value(cubes: &mut Cubes, random: &mut Random) {
    let (of, from, to) = random.of(&[
        ("SURFACE INTERACTION", "NAME=SI", "NAME"),
        ("SURFACE INTERACTION", "NAME=SI", "NAME="),
        ("CONTACT PAIR", "INTERACTION=SI", "INTERACTION"),
        ("CONTACT PAIR", "INTERACTION=SI", "INTERACTION="),
        ("CONTACT PAIR", "TYPE=SURFACE TO SURFACE", "TYPE"),
        ("SURFACE BEHAVIOR", "=LINEAR", ""),
        ("SURFACE BEHAVIOR", "=LINEAR", "="),
    ]);
    reword(cubes, of, from, to);
}

fn twice(cubes: &mut Cubes, random: &mut Random) {
    let (of, parameters) = random.of(&[
        ("SURFACE INTERACTION", ", NAME=SI"),
        ("SURFACE INTERACTION", ", NAME=TI"),
        ("CONTACT PAIR", ", INTERACTION=SI"),
        ("CONTACT PAIR", ", INTERACTION=TI"),
        ("CONTACT PAIR", ", TYPE=SURFACE TO SURFACE"),
        ("CONTACT PAIR", ", TYPE=FOO"),
        ("SURFACE BEHAVIOR", ", PRESSURE-OVERCLOSURE=LINEAR"),
        ("SURFACE BEHAVIOR", ", PRESSURE-OVERCLOSURE=FOO"),
    ]);
    append(cubes, of, parameters);
}

fn blanks(cubes: &mut Cubes, random: &mut Random) {
    let of = any(cubes, random);
    let Some(card) = card(cubes, of) else { return };
    card.line = match random.below(3) {
        0 => card.line.to_ascii_lowercase(),
        1 => card.line.replace(' ', "").replace('=', " = \t"),
        _ => card.line.replace('*', "*  ").replace('-', " - "),
    };
}

fn continued(cubes: &mut Cubes, random: &mut Random) {
    let of = any(cubes, random);
    reword(cubes, of, ", ", ",\n");
}

fn indented(cubes: &mut Cubes, random: &mut Random) {
    let of = any(cubes, random);
    reword(cubes, of, "*", random.of(&["  *", "\t*"]));
}
