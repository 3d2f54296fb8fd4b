//! What is known of the nodes of a mesh at one time.

use inpact_geometry::Vector;
use inpact_parser::mesh::{InitialQuantity, Mesh};

/// What is known of the nodes at one time; every column is in the order of [`Mesh::nodes`].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct State {
    /// The total time (T); `None` for the beginning, which is a table without times.
    pub time: Option<f64>,
    /// How far the nodes have moved since the beginning (L); `None` where they have not, or nothing says so.
    pub displacements: Option<Vec<Vector>>,
    /// Contact pressure of slave nodes (F L⁻²).
    pub pressure: Option<Pressure>,
    /// What else is known, each quantity once.
    pub fields: Vec<NodeField>,
}

/// Contact pressure.
#[derive(Debug, Clone, PartialEq)]
pub struct Pressure {
    /// A value a node; `None` where it is not known.
    pub values: Vec<Option<f64>>,
    /// Where it comes from, for a person.
    pub source: String,
}

/// A quantity of the nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct NodeField {
    /// Which.
    pub quantity: InitialQuantity,
    /// A value a node; `None` where it is not known.
    pub values: Vec<Option<f64>>,
    /// Where it comes from, for a person: `*INITIAL CONDITIONS`, or the name of a file.
    pub source: String,
}

impl State {
    /// The beginning, as *INITIAL CONDITIONS says.
    pub fn initial(mesh: &Mesh) -> Self {
        let mut state = Self::default();
        state.complete(mesh);
        state
    }

    /// Adds from *INITIAL CONDITIONS the quantities that nothing else says.
    pub fn complete(&mut self, mesh: &Mesh) {
        for field in &mesh.initial {
            if self.field(field.quantity).is_none() {
                self.fields.push(NodeField {
                    quantity: field.quantity,
                    values: field.values.clone(),
                    source: "*INITIAL CONDITIONS".to_owned(),
                });
            }
        }
        self.fields.sort_by_key(|field| field.quantity);
    }

    /// A quantity, where it is known.
    pub fn field(&self, quantity: InitialQuantity) -> Option<&NodeField> {
        self.fields.iter().find(|field| field.quantity == quantity)
    }
}
