//! Failures found before solving: bodies without a held value, merged nodes held at different values, and laws that give no conductance.
//!
//! Laws are evaluated where they do not depend on unknowns.

use super::{FieldNodes, Problem};
use crate::assembly::row_terms;
use crate::error::{Error, ErrorKind};
use crate::knowledge::Knowledge;
use crate::linear::Sets;
use crate::scene::Field;
use std::collections::{BTreeMap, HashSet};

impl Problem<'_> {
    /// The failures that are certain before solving, field by field.
    ///
    /// An interface whose conductance depends on unknowns counts as a path: a scene without such a failure may still lack the paths it needs, which only
    /// solving shows.
    pub fn certain_failures(&self) -> Vec<Error> {
        let mut failures = Vec::new();
        for field in self.solved_fields() {
            let Some(nodes) = self.field(field) else { continue };
            failures.extend(self.held_apart(field));
            match self.sealed(field, nodes) {
                Ok(sealed) => failures.extend(self.floating(field, nodes, &sealed)),
                Err(error) => failures.push(error),
            }
        }
        failures
    }

    /// The rows with zero conductance for any values of the unknowns.
    fn sealed(&self, field: Field, nodes: &FieldNodes) -> Result<HashSet<u32>, Error> {
        let start = self.start();
        let is_known = |row: &u32| {
            let of = &self.scene.interfaces[*row as usize];
            self.laws_of(*row as usize).is_some_and(|laws| {
                let needs = Self::dependence(of, laws, field, start);
                !needs.temperature && !needs.pore_pressure
            })
        };
        let known = FieldNodes { rows: nodes.rows.iter().copied().filter(is_known).collect(), ..nodes.clone() };
        let terms = row_terms(&Knowledge::at_start(self, start), field, &known)?;
        let conductances = known.rows.iter().zip(terms.conductances);
        Ok(conductances.filter(|(_, conductance)| *conductance == 0.0).map(|(row, _)| *row).collect())
    }

    /// Bodies without a path to a fixed value, or in a transient to a capacity.
    fn floating(&self, field: Field, nodes: &FieldNodes, sealed: &HashSet<u32>) -> Option<Error> {
        let conditions = self.scene.conditions(field);
        let mut sets = Sets::new(self.scene.nodes.len());
        for link in nodes.links.iter().map(|link| &self.scene.links[*link as usize]) {
            sets.join(link.nodes[0], link.nodes[1]);
        }
        let conducting = nodes.rows.iter().filter(|row| !sealed.contains(*row));
        for row in conducting.map(|row| &self.scene.interfaces[*row as usize]) {
            sets.join(row.slave, row.master);
        }
        let mut is_held = vec![false; self.scene.nodes.len()];
        let stores = |(_, capacity): &(&u32, &f64)| self.scene.is_transient() && 0.0 < **capacity;
        let storing = conditions.capacities.iter().filter(stores).map(|(node, _)| node);
        for node in conditions.fixed.keys().chain(storing) {
            is_held[sets.of(*node) as usize] = true;
        }
        let mut components: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for node in &nodes.nodes {
            let body = sets.of(*node);
            if !is_held[body as usize] {
                components.entry(body).or_default().push(*node);
            }
        }
        let components: Vec<Vec<u32>> = components.into_values().collect();
        (!components.is_empty()).then(|| Error::from(ErrorKind::Floating { components }).of_field(field))
    }

    /// Nodes merged by infinite links and held at different values at the start.
    fn held_apart(&self, field: Field) -> Option<Error> {
        let nodes = self.field(field)?;
        let mut sets = Sets::new(self.scene.nodes.len());
        for link in nodes.links.iter().map(|link| &self.scene.links[*link as usize]) {
            if link.conductances[field.index()].is_infinite() {
                sets.join(link.nodes[0], link.nodes[1]);
            }
        }
        let mut known: BTreeMap<u32, (u32, f64)> = BTreeMap::new();
        for (node, fixed) in &self.scene.conditions(field).fixed {
            let value = fixed.at(self.start());
            let (first, of_first) = *known.entry(sets.of(*node)).or_insert((*node, value));
            if value != of_first {
                let (nodes, values) = ([first, *node], [of_first, value]);
                return Some(Error::from(ErrorKind::Contradiction { nodes, values }).of_field(field));
            }
        }
        None
    }
}
