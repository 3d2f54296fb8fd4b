//! Tables in included files.

use super::{Change, card};
use crate::cubes::Cubes;
use crate::random::Random;

pub(super) const CHANGES: &[Change] = &[
    Change {
        name: "included table",
        apply: |cubes, random| {
            include(cubes, random, &["INPUT=table.inc", "FILE=table.inc", "input = table.inc"], "table.inc");
        },
    },
    Change {
        name: "included table, name in quotes",
        apply: |cubes, _| include_as(cubes, "INPUT=\"table.inc\"", "table.inc"),
    },
    Change {
        name: "included table, name with blanks",
        apply: |cubes, random| include(cubes, random, &["INPUT=\"my table.inc\"", "INPUT=my table.inc"], "mytable.inc"),
    },
    Change {
        name: "included table, file with blanks in its name",
        apply: |cubes, _| include_as(cubes, "INPUT=\"my table.inc\"", "my table.inc"),
    },
    Change { name: "included file missing", apply: |cubes, _| include_as(cubes, "INPUT=none.inc", "table.inc") },
    Change {
        name: "*INCLUDE without a name",
        apply: |cubes, random| include(cubes, random, &["INPUT", "INPUT=", "INPUT=\"table.inc"], "table.inc"),
    },
    Change { name: "included table, other case", apply: |cubes, _| include_as(cubes, "INPUT=Table.Inc", "Table.Inc") },
    Change { name: "included files in included files", apply: nested },
];

fn include(cubes: &mut Cubes, random: &mut Random, parameters: &[&'static str], file: &str) {
    include_as(cubes, random.of(parameters), file);
}

/// Moves the rows of the table into a file.
fn include_as(cubes: &mut Cubes, parameter: &str, file: &str) {
    let Some(card) = card(cubes, "GAP CONDUCTANCE") else { return };
    let rows: String = card.rows.drain(..).map(|row| row + "\n").collect();
    card.rows.push(format!("*INCLUDE, {parameter}"));
    cubes.files.push((file.to_owned(), rows));
}

fn nested(cubes: &mut Cubes, random: &mut Random) {
    let levels = random.of(&[2, 5, 6, 8, 9, 10, 12]);
    include_as(cubes, "INPUT=1.inc", &format!("{levels}.inc"));
    let links = (1..levels).map(|level| (format!("{level}.inc"), format!("*INCLUDE, INPUT={}.inc\n", level + 1)));
    cubes.files.extend(links);
}
