//! From the text of a deck and bytes of result files to the rows of a node table.
#![allow(dead_code, reason = "each test uses some of it")]

#[path = "../../../inpact-results/tests/common/mod.rs"]
pub(crate) mod files;

use inpact_contact::{Error, Join, Joined, NodeRows, State};
use inpact_evaluation::nodes::Column;
use inpact_parser::deck::scan;
use inpact_parser::grammar::Grammar;
use inpact_parser::mesh::{KeptRows, Mesh, read};
use inpact_parser::model::{self, Model};

/// A deck with its mesh.
pub(crate) struct Read {
    pub(crate) model: Model,
    pub(crate) mesh: Mesh,
}

pub(crate) fn deck(text: &str) -> Read {
    let grammar = Grammar::builtin();
    let scanned = scan("a.inp", text.as_bytes(), grammar);
    let (model, _) = model::read(&scanned, grammar);
    let mesh = read(&scanned, grammar, &model, &mut KeptRows(&scanned)).expect("rows");
    assert_eq!(mesh.notes, [], "the deck is read whole");
    Read { model, mesh }
}

impl Read {
    pub(crate) fn join(&self, files: &[(&str, &[u8])]) -> Result<Joined, Error> {
        let mut join = Join::new(&self.mesh, &self.model);
        for (name, bytes) in files {
            join.add(name, &inpact_results::read(bytes).expect("whole"))?;
        }
        join.finish()
    }

    pub(crate) fn table(&self, states: &[State]) -> Table {
        let mut rows = NodeRows::new(&self.mesh, &self.model, states).expect("a geometry");
        let names = rows.keys().iter().chain(rows.numbers()).map(ToString::to_string).collect();
        let mut cells = Vec::new();
        for state in states {
            let taken = rows.write(state, |batch| -> Result<(), Error> {
                for row in 0..batch.rows {
                    let labels =
                        batch.labels.iter().map(|column| String::from_utf8_lossy(column.get(row)).into_owned());
                    let numbers = batch.numbers.iter().map(|column| column.get(row));
                    let numbers = numbers.map(|number| number.map_or_else(String::new, |number| format!("{number:?}")));
                    cells.push(labels.chain(numbers).collect());
                }
                Ok(())
            });
            taken.expect("a geometry");
        }
        Table { names, cells }
    }
}

/// A node table as text.
pub(crate) struct Table {
    names: Vec<String>,
    pub(crate) cells: Vec<Vec<String>>,
}

impl Table {
    /// A cell by the node, the number of its row among those of the node, and the column.
    pub(crate) fn text(&self, node: &str, row: usize, column: &str) -> &str {
        let at = self
            .names
            .iter()
            .position(|name| name == column)
            .unwrap_or_else(|| panic!("no `{column}`: {:?}", self.names));
        let mut rows = self.cells.iter().filter(|cells| cells[0] == node);
        &rows.nth(row).unwrap_or_else(|| panic!("no row {row} of `{node}`"))[at]
    }

    /// The number in a cell.
    pub(crate) fn number(&self, node: &str, row: usize, column: &str) -> f64 {
        let text = self.text(node, row, column);
        text.parse().unwrap_or_else(|_| panic!("`{column}` of {node} is `{text}`"))
    }

    pub(crate) fn has(&self, column: Column) -> bool {
        self.names.contains(&column.to_string())
    }
}

pub(crate) fn messages(joined: &Joined) -> Vec<String> {
    joined.notes.iter().map(|note| format!("{}: {}", note.file, note.message)).collect()
}

/// Two blocks of one element each; the upper one, a quarter as long, is 0.25 above the lower one.
pub(crate) const FLAT: &str = "\
*NODE
1, 0., 0., 0.\n2, 2., 0., 0.\n3, 2., 1., 0.\n4, 0., 1., 0.
5, 0., 0., 1.\n6, 2., 0., 1.\n7, 2., 1., 1.\n8, 0., 1., 1.
11, .5, 0., 1.25\n12, 1., 0., 1.25\n13, 1., 1., 1.25\n14, .5, 1., 1.25
15, .5, 0., 2.25\n16, 1., 0., 2.25\n17, 1., 1., 2.25\n18, .5, 1., 2.25
*ELEMENT, TYPE=C3D8, ELSET=LOWER
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=C3D8, ELSET=UPPER
2, 11, 12, 13, 14, 15, 16, 17, 18
*SURFACE, NAME=MASTER
LOWER, S2
*SURFACE, NAME=SLAVE
UPPER, S1
*SURFACE INTERACTION, NAME=GAP
*GAP CONDUCTANCE
10., 0.
0., 1.
*CONTACT PAIR, INTERACTION=GAP
SLAVE, MASTER
*INITIAL CONDITIONS, TYPE=TEMPERATURE
5, 20.\n6, 20.\n7, 20.\n8, 20.\n11, 30.\n12, 30.\n13, 30.\n14, 30.
*STEP, NAME=PRESS
*COUPLED TEMPERATURE-DISPLACEMENT
1., 2.
*END STEP
*STEP
*COUPLED TEMPERATURE-DISPLACEMENT
1., 1.
*END STEP
";

/// The same as two instances of parts, whose nodes have the same labels: the lower one is moved by 10 along x, and the upper one by as much.
pub(crate) const INSTANCES: &str = "\
*PART, NAME=LOWER
*NODE
1, 0., 0., 0.\n2, 2., 0., 0.\n3, 2., 1., 0.\n4, 0., 1., 0.
5, 0., 0., 1.\n6, 2., 0., 1.\n7, 2., 1., 1.\n8, 0., 1., 1.
*ELEMENT, TYPE=C3D8, ELSET=ALL
1, 1, 2, 3, 4, 5, 6, 7, 8
*SURFACE, NAME=TOP
ALL, S2
*END PART
*PART, NAME=UPPER
*NODE
1, 0., 0., 0.\n2, 2., 0., 0.\n3, 2., 1., 0.\n4, 0., 1., 0.
5, 0., 0., 1.\n6, 2., 0., 1.\n7, 2., 1., 1.\n8, 0., 1., 1.
*ELEMENT, TYPE=C3D8, ELSET=ALL
1, 1, 2, 3, 4, 5, 6, 7, 8
*SURFACE, NAME=BOTTOM
ALL, S1
*END PART
*ASSEMBLY, NAME=A
*INSTANCE, NAME=Low-1, PART=LOWER
10., 0., 0.
*END INSTANCE
*INSTANCE, NAME=Up-1, PART=UPPER
10., 0., 1.
*END INSTANCE
*END ASSEMBLY
*SURFACE INTERACTION, NAME=GAP
*GAP CONDUCTANCE
10., 0.
0., 1.
*CONTACT PAIR, INTERACTION=GAP
Up-1.BOTTOM, Low-1.TOP
*STEP
*COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL
1., 1.
*END STEP
";
