//! Failures that are certain before anything is solved: bodies that nothing holds, and nodes that are one and held apart, whatever the laws of interfaces give.

use super::Problem;
use crate::linear::Sets;
use crate::scene::Field;
use crate::solve::SolveFailure;
use std::collections::BTreeMap;

impl Problem<'_> {
    /// The failures that no state of contact avoids, field by field.
    ///
    /// Interfaces count as paths, open or closed: a scene without such a failure may still have none of the paths it needs, which only solving shows.
    pub fn certain_failures(&self) -> Vec<SolveFailure> {
        let mut failures = Vec::new();
        for field in self.solved_fields() {
            failures.extend(self.held_apart(field));
            failures.extend(self.floating(field));
        }
        failures
    }

    /// Bodies without a path to a fixed value, or in a transient to a capacity.
    fn floating(&self, field: Field) -> Option<SolveFailure> {
        let nodes = self.field(field)?;
        let conditions = self.scene.conditions(field);
        let mut sets = Sets::new(self.scene.nodes.len());
        for link in nodes.links.iter().map(|link| &self.scene.links[*link as usize]) {
            sets.join(link.nodes[0], link.nodes[1]);
        }
        for row in nodes.rows.iter().map(|row| &self.scene.interfaces[*row as usize]) {
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
        (!components.is_empty()).then_some(SolveFailure::Floating { field, components })
    }

    /// Nodes that infinite links make one and that are held at different values at the start.
    fn held_apart(&self, field: Field) -> Option<SolveFailure> {
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
                return Some(SolveFailure::Contradiction { field, nodes: [first, *node], values: [of_first, value] });
            }
        }
        None
    }
}
