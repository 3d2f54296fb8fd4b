//! Interfaces of scenes: the rows of contact pairs in one state, one per slave node or one per pair, and the projection of each slave node.
//!
//! The numbers are those of [`NodeRows`], so that clearances and areas are the same as in node tables.

use crate::Error;
use crate::naming::across_name;
use crate::pair::across;
use crate::rows::NodeRows;
use crate::state::State;
use inpact_evaluation::law::ContactState;
use inpact_evaluation::nodes::{Column, Part};
use inpact_geometry::FaceLabel;
use inpact_parser::mesh::{MeshNode, SurfaceKind};
use inpact_parser::model::Name;
use inpact_parser::span::Span;

/// The interfaces of a deck in one state.
#[derive(Debug, Clone, PartialEq)]
pub struct Interfaces {
    /// The quantities of its rows besides the area, means of both sides where both have one.
    pub quantities: Vec<Column>,
    /// The pairs, in the order of the deck.
    pub pairs: Vec<PairInterfaces>,
}

/// The interfaces of a contact pair.
#[derive(Debug, Clone, PartialEq)]
pub struct PairInterfaces {
    /// The slave surface.
    pub slave: Name,
    /// The master surface.
    pub master: Name,
    /// The interaction.
    pub interaction: Name,
    /// The keyword line of the pair.
    pub span: Span,
    /// The slave nodes with data: with an opposite master face, or with a clearance or a pressure from a result file.
    pub rows: Vec<InterfaceRow>,
    /// The names of the slave nodes without either: nothing is conducted there.
    pub beside: Vec<String>,
    /// The projection of each slave node that has a nearest face of the master.
    pub projections: Vec<ProjectionRow>,
}

/// A slave node and the opposite point of the master.
#[derive(Debug, Clone, PartialEq)]
pub struct InterfaceRow {
    /// The name of the slave node.
    pub slave: String,
    /// The name of the point across.
    pub master: String,
    /// The area of the slave node (L²).
    pub area: f64,
    /// One value per quantity of [`Interfaces::quantities`]; `None` where it is unknown.
    pub values: Vec<Option<f64>>,
}

/// Projection of a slave node onto its master.
#[derive(Debug, Clone, PartialEq)]
pub struct ProjectionRow {
    /// The name of the slave node.
    pub slave: String,
    /// The name of the point across.
    pub master: String,
    /// The nearest element and face.
    pub face: (MeshNode, FaceLabel),
    /// The nodes of the face and their interpolation weights.
    pub weights: Vec<(MeshNode, f64)>,
    /// The distance along the master's normal, open > 0 (L).
    pub clearance: f64,
    /// The overhang of the node beyond the edge of the master (L); 0 inside.
    pub overhang: f64,
    /// Whether the node counts as opposite to the master: the overhang is within the extension of its edge.
    pub projects: bool,
}

/// A pair as one interface.
#[derive(Debug, Clone, PartialEq)]
pub struct LumpedPair {
    /// The sum of the areas of its slave nodes with data (L²).
    pub area: f64,
    /// One mean per quantity of [`Interfaces::quantities`]; `None` where no node has a value.
    pub means: Vec<Option<WeightedMean>>,
    /// The numbers of closed and of open nodes.
    pub states: [usize; 2],
}

/// The mean of a quantity, weighted by the areas of the nodes that have it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WeightedMean {
    /// The mean.
    pub mean: f64,
    /// The least value.
    pub least: f64,
    /// The largest value.
    pub largest: f64,
    /// The number of nodes with a value.
    pub nodes: usize,
}

impl NodeRows<'_> {
    /// The interfaces in a state.
    ///
    /// # Errors
    /// The displaced nodes have no valid geometry.
    pub fn interfaces(&mut self, state: &State) -> Result<Interfaces, Error> {
        let sources: Vec<(Column, Vec<usize>)> = quantities(self.numbers());
        let mut batches = Vec::new();
        self.write(state, |batch| {
            batches.push(batch.clone());
            Ok::<(), Error>(())
        })?;
        let mut pairs = Vec::new();
        for (pair, batch) in self.pairs().iter().zip(&batches) {
            let mesh = self.mesh();
            let master = &mesh.surfaces[pair.of.master];
            let master_name = master.name.written();
            let area = self.numbers().iter().position(|column| *column == Column::Area);
            let mut of = PairInterfaces {
                slave: pair.summary.slave.clone(),
                master: pair.summary.master.clone(),
                interaction: pair.summary.interaction.clone(),
                span: pair.of.span,
                rows: Vec::new(),
                beside: Vec::new(),
                projections: Vec::new(),
            };
            for (row, node) in pair.contact(mesh, state)?.iter().enumerate() {
                // A node of several pairs is one node of a scene, whatever the names of its rows in a table of histories.
                let name = mesh.nodes[node.node.index()].to_string();
                let at_master = across_name(&name, master_name);
                if let (Some(nearest), SurfaceKind::Faces(faces)) = (&node.across, &master.kind) {
                    let face = faces.surface.face(nearest.face);
                    let nodes = face.nodes.iter().map(|node| mesh.nodes[node.index()].clone());
                    of.projections.push(ProjectionRow {
                        slave: name.clone(),
                        master: at_master.clone(),
                        face: faces.elements[nearest.face.index()].clone(),
                        weights: nodes.zip(nearest.weights(face.shape)).collect(),
                        clearance: nearest.clearance,
                        overhang: nearest.overhang,
                        projects: nearest.projects,
                    });
                }
                let value = |column: usize| batch.numbers[column].get(row);
                let values: Vec<Option<f64>> = sources.iter().map(|(_, of)| mean_of(of, &value)).collect();
                let is_said = |column: &Column| matches!(column, Column::Clearance | Column::Pressure);
                let is_known =
                    sources.iter().zip(&values).any(|((column, _), value)| is_said(column) && value.is_some());
                if across(node).is_none() && !is_known {
                    of.beside.push(name);
                    continue;
                }
                let area = area.and_then(value).unwrap_or(node.area);
                of.rows.push(InterfaceRow { slave: name, master: at_master, area, values });
            }
            pairs.push(of);
        }
        let quantities = sources.into_iter().map(|(column, _)| column).collect();
        Ok(Interfaces { quantities, pairs })
    }
}

/// The quantities of interfaces, and the columns that each is the mean of.
fn quantities(numbers: &[Column]) -> Vec<(Column, Vec<usize>)> {
    let place = |wanted: Column| numbers.iter().position(|column| *column == wanted);
    let mut found = Vec::new();
    for (at, column) in numbers.iter().enumerate() {
        let (quantity, other) = match *column {
            Column::Clearance | Column::Pressure | Column::Shear | Column::SlipRate => (*column, None),
            Column::Temperature(Part::Slave) => {
                (Column::Temperature(Part::Both), place(Column::Temperature(Part::Master)))
            }
            Column::FieldVariable(number, Part::Slave) => {
                (Column::FieldVariable(number, Part::Both), place(Column::FieldVariable(number, Part::Master)))
            }
            _ => continue,
        };
        found.push((quantity, std::iter::once(at).chain(other).collect()));
    }
    found
}

/// The mean of one column or two; `None` where one of them has no value.
fn mean_of(columns: &[usize], value: &impl Fn(usize) -> Option<f64>) -> Option<f64> {
    match *columns {
        [only] => value(only),
        [slave, master] => Some(0.5 * value(slave)? + 0.5 * value(master)?),
        _ => None,
    }
}

impl Interfaces {
    /// A pair as one interface; `None` where none of its nodes has data.
    pub fn lumped(&self, pair: &PairInterfaces) -> Option<LumpedPair> {
        if pair.rows.is_empty() {
            return None;
        }
        let area = pair.rows.iter().map(|row| row.area).sum();
        let means = (0..self.quantities.len()).map(|quantity| {
            WeightedMean::of(pair.rows.iter().filter_map(|row| Some((row.area, row.values[quantity]?))))
        });
        let place = |column: Column| self.quantities.iter().position(|quantity| *quantity == column);
        let (clearance, pressure) = (place(Column::Clearance), place(Column::Pressure));
        let mut states = [0; 2];
        for row in &pair.rows {
            let value = |at: Option<usize>| at.and_then(|at| row.values[at]);
            match ContactState::of(None, value(clearance), value(pressure)) {
                Some(ContactState::Closed) => states[0] += 1,
                Some(ContactState::Open) => states[1] += 1,
                Some(ContactState::Undetermined) | None => {}
            }
        }
        Some(LumpedPair { area, means: means.collect(), states })
    }
}

impl WeightedMean {
    /// The mean of values with their weights; `None` without any.
    ///
    /// It is computed by differences from the first, so that the mean of equal values is exact.
    fn of(values: impl Iterator<Item = (f64, f64)>) -> Option<Self> {
        let mut found: Option<(Self, f64)> = None;
        let (mut weights, mut sum) = (0.0, 0.0);
        for (weight, value) in values {
            let (so_far, first) =
                found.get_or_insert((Self { mean: value, least: value, largest: value, nodes: 0 }, value));
            so_far.least = so_far.least.min(value);
            so_far.largest = so_far.largest.max(value);
            so_far.nodes += 1;
            weights += weight;
            sum += weight * (value - *first);
        }
        let (mut found, first) = found?;
        if 0.0 < weights {
            found.mean = (first + sum / weights).clamp(found.least, found.largest);
        }
        Some(found)
    }

    /// Whether all values are equal.
    pub fn is_uniform(&self) -> bool {
        self.least.to_bits() == self.largest.to_bits()
    }
}

#[cfg(test)]
mod tests {
    use super::WeightedMean;

    #[test]
    fn a_value_that_all_have_is_the_mean() {
        let mean = WeightedMean::of([0.1, 0.7, 0.3].into_iter().map(|weight| (weight, 0.1))).expect("values");
        assert_eq!((mean.mean.to_bits(), mean.nodes, mean.is_uniform()), (0.1_f64.to_bits(), 3, true));
    }

    #[test]
    fn weights_count() {
        let mean = WeightedMean::of([(1.0, 4.0), (3.0, 8.0)].into_iter()).expect("values");
        assert_eq!((mean.mean, mean.least, mean.largest, mean.is_uniform()), (7.0, 4.0, 8.0, false));
        assert_eq!(WeightedMean::of(std::iter::empty()), None);
    }
}
