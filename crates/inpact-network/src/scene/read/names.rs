//! Node numbers by name: definitions, references, and suggestions for unknown names.

use super::Reader;
use crate::linear::index;
use crate::scene::Scene;
use crate::scene::nearest::meant_or;
use crate::scene::rules::{DUPLICATE_NODE, UNKNOWN_NODE};
use crate::scene::usable::{self, Refusal};

impl Reader<'_> {
    /// The number of a new node, or of the existing one with that name.
    pub(super) fn define(&mut self, name: &str, scene: &mut Scene) -> Result<u32, u32> {
        if let Some(&number) = self.numbers.get(name) {
            return Err(number);
        }
        let number = index(scene.nodes.len());
        scene.nodes.push(name.to_owned());
        self.numbers.insert(name.to_owned(), number);
        Ok(number)
    }

    pub(super) fn number_or_new(&mut self, name: &str, scene: &mut Scene) -> u32 {
        match self.define(name, scene) {
            Ok(number) | Err(number) => number,
        }
    }

    /// The number of a new node defined by a source in a line.
    pub(super) fn define_at(
        &mut self,
        name: &str,
        (source, line): (usize, u64),
        scene: &mut Scene,
    ) -> Result<u32, Refusal> {
        let number = self.define(name, scene).map_err(|number| {
            let (first_source, first) = self.origins[number as usize];
            let file =
                if first_source == source { String::new() } else { format!(" of `{}`", self.sources[first_source]) };
            let message = format!("node `{name}` is defined twice, first in line {first}{file}");
            Refusal::new(&DUPLICATE_NODE, message, "give every node a name of its own")
        })?;
        self.origins.push((source, line));
        Ok(number)
    }

    /// The number of a node whose name begins at a byte of the scene file.
    pub(super) fn number(&mut self, name: &str, at: usize, what: &str, scene: &Scene) -> Option<u32> {
        let is_named = usable::node_name(name, || what.to_owned());
        let number = is_named.and_then(|()| self.known(name, scene));
        number.unwrap_or_else(|refusal| {
            self.refuse(at, refusal);
            None
        })
    }

    /// The number of a node; `None` where a rejected file may define it.
    pub(super) fn known(&mut self, name: &str, scene: &Scene) -> Result<Option<u32>, Refusal> {
        let number = self.numbers.get(name).copied();
        if number.is_some() || self.lacks_nodes {
            return Ok(number);
        }
        let left = self.comparisons.checked_sub(scene.nodes.len());
        self.comparisons = left.unwrap_or(self.comparisons);
        let compared = if left.is_some() { &scene.nodes[..] } else { &[] };
        let meant = meant_or(name, compared.iter().map(String::as_str), "");
        let otherwise = if meant.is_empty() { "add" } else { " Otherwise add" };
        let help = format!("{meant}{otherwise} a [[node]] of that name");
        Err(Refusal::new(&UNKNOWN_NODE, format!("the scene defines no node `{name}`"), help))
    }
}
