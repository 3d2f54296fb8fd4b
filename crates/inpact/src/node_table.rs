//! Node tables from the mesh of a deck and its job's result files.

use crate::commands::job_results::join;
use crate::commands::mesh_rows::{refuse_none, rows_of_pairs};
use crate::commands::meshed::MeshedDeck;
use crate::deck::Deck;
use crate::error::Error;
use crate::failure::Failure;
use inpact_contact::Joined;
use inpact_evaluation::arrow::array::RecordBatch;
use inpact_evaluation::results::node_record_batch;
use inpact_parser::mesh::MeshNote;
use std::path::{Path, PathBuf};

/// The node table of the contact pairs of a deck: one row per slave node and state.
#[derive(Debug, Clone)]
pub struct NodeTable {
    batches: Vec<RecordBatch>,
    notes: Vec<String>,
}

impl Deck {
    /// Makes the node table of its contact pairs: from its mesh and initial conditions, or in the states of result files of its own job.
    ///
    /// ```
    /// use inpact::arrow::array::AsArray;
    /// use inpact::arrow::datatypes::Float64Type;
    /// use inpact::{Deck, ReadOptions};
    ///
    /// // Two bricks of side 1, one 0.1 above the other.
    /// # let mut nodes = String::new();
    /// # for (layer, z) in [0.0, 1.0, 1.1, 2.1].iter().enumerate() {
    /// #     for (corner, [x, y]) in [[0, 0], [1, 0], [1, 1], [0, 1]].iter().enumerate() {
    /// #         nodes += &format!("{}, {x}, {y}, {z}\n", 4 * layer + corner + 1);
    /// #     }
    /// # }
    /// # let elements = "*ELEMENT, TYPE=C3D8, ELSET=LOWER\n1, 1, 2, 3, 4, 5, 6, 7, 8\n\
    /// #     *ELEMENT, TYPE=C3D8, ELSET=UPPER\n2, 9, 10, 11, 12, 13, 14, 15, 16\n";
    /// # let pair = "*SURFACE, NAME=TOP\nLOWER, S2\n*SURFACE, NAME=UNDERSIDE\nUPPER, S1\n\
    /// #     *SURFACE INTERACTION, NAME=JOINT\n1.,\n*CONTACT PAIR, INTERACTION=JOINT\nUNDERSIDE, TOP\n";
    /// # let text = format!("*NODE\n{nodes}{elements}{pair}");
    /// let deck = Deck::parse("bricks.inp", text, &ReadOptions::new().isolated())?;
    /// let nodes = deck.nodes::<&str>(&[])?;
    /// let column = |name| nodes.batches()[0].column_by_name(name).expect("it is there").as_primitive::<Float64Type>();
    /// assert!(column("area").values().iter().all(|area| (area - 0.25).abs() < 1e-15));
    /// assert!(column("clearance").values().iter().all(|clearance| (clearance - 0.1).abs() < 1e-15));
    /// # Ok::<(), inpact::Error>(())
    /// ```
    ///
    /// # Errors
    /// Files that cannot be read, a deck without a contact pair whose surfaces are in its mesh, result files of another mesh.
    pub fn nodes<P: AsRef<Path>>(&self, results: &[P]) -> Result<NodeTable, Error> {
        let results: Vec<PathBuf> = results.iter().map(|path| path.as_ref().to_owned()).collect();
        let meshed = MeshedDeck::read(Path::new(self.name()), &self.settings)?;
        let Joined { states, notes, .. } = join(&results, &meshed)?;
        let mut rows = rows_of_pairs(&meshed, &states)?;
        let of_mesh =
            |note: &MeshNote| format!("{}: {}", meshed.read.deck.source(note.span.source()).name(), note.message);
        let mut notes: Vec<String> = notes.iter().map(|note| format!("{}: {}", note.file, note.message)).collect();
        notes.extend(meshed.mesh.notes.iter().chain(rows.notes()).map(of_mesh));
        refuse_none(&meshed, &rows)?;
        let (keys, numbers) = (rows.keys().to_vec(), rows.numbers().to_vec());
        let mut batches = Vec::new();
        for state in &states {
            rows.write(state, |batch| -> Result<(), Failure> {
                let batch = node_record_batch(&keys, &numbers, batch);
                batches.push(batch.map_err(|error| Failure::Data(error.to_string()))?);
                Ok(())
            })?;
        }
        Ok(NodeTable { batches, notes })
    }
}

impl NodeTable {
    /// The rows; at least one batch, all of one schema.
    pub fn batches(&self) -> &[RecordBatch] {
        &self.batches
    }

    /// The rows, by value.
    pub fn into_batches(self) -> Vec<RecordBatch> {
        self.batches
    }

    /// The parts of mesh and results that were not read, with the reason, one sentence each.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }
}
