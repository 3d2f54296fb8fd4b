//! Reads the mesh of a deck: surfaces, sets, elements, nodes, in this order.

use super::Mesh;
use super::conditions::Target;
use super::elements::RawFace;
use super::located::Located;
use super::nodes::Wanted;
use super::pairs::Request;
use super::reader::{Context, Reader};
use super::selected::Selection;
use super::surfaces::{NodePick, Picks};
use crate::model::Model;
use crate::span::Span;
use std::io;

impl Reader<'_, '_> {
    /// Reads the contact pairs, and further targets; returns the positions of these among the surfaces of the mesh.
    pub(super) fn read(mut self, model: &Model, targets: &[Target]) -> io::Result<(Mesh, Vec<Option<usize>>)> {
        let Request { surfaces: mut wanted, pairs } = self.request(model);
        let places: Vec<usize> = targets.iter().map(|target| wanted.position(target.clone())).collect();
        let wanted = wanted.list;
        let mut picks = Picks::default();
        let mut found = Vec::new();
        for (surface, target) in wanted.iter().enumerate() {
            found.push(self.pick_target(surface, target, &mut picks)?);
        }
        for pick in &mut picks.faces {
            pick.elements.labels.sort();
        }
        let faces = self.faces(&picks.faces)?;
        self.place_instances()?;
        let located = self.locate(&faces, &picks.nodes)?;
        let mut surfaces = Vec::new();
        for (surface, (target, found)) in wanted.iter().zip(found).enumerate() {
            let name = target.reference().clone();
            let from = faces.partition_point(|face| face.surface < surface);
            let to = faces.partition_point(|face| face.surface <= surface);
            // Surfaces were selected in order.
            let first = picks.nodes.partition_point(|pick| pick.surface < surface);
            let end = picks.nodes.partition_point(|pick| pick.surface <= surface);
            let of_nodes = picks.nodes[first..end].iter().zip(&located.of_picks[first..end]);
            surfaces.push(self.surface(name, found, &faces[from..to], of_nodes, &located)?);
        }
        // Pairs whose surfaces were not found are left out, with a note.
        let positions: Vec<Option<usize>> = surfaces
            .iter()
            .scan(0, |next, surface| {
                let at = surface.is_some().then_some(*next);
                *next += usize::from(surface.is_some());
                Some(at)
            })
            .collect();
        let pairs = pairs.into_iter().filter_map(|pair| pair.with_surfaces(&positions)).collect();
        let initial = self.initial(&located)?;
        let Located { points, nodes, .. } = located;
        let surfaces = surfaces.into_iter().flatten().collect();
        let steps = self.layout.steps.iter().map(|step| step.named("NAME")).collect();
        let mesh = Mesh { points, nodes, surfaces, pairs, initial, steps, notes: self.notes };
        Ok((mesh, places.into_iter().map(|place| positions[place]).collect()))
    }

    /// Reads the placements of instances.
    pub(super) fn place_instances(&mut self) -> io::Result<()> {
        for instance in 1..self.instances.len() {
            if let Some(entry) = self.instances[instance].entry {
                self.instances[instance].placement = self.placement(entry)?;
            }
        }
        Ok(())
    }

    /// Finds the nodes of all faces and node surfaces.
    fn locate(&mut self, faces: &[RawFace], node_picks: &[NodePick]) -> io::Result<Located> {
        let mut located = Located::default();
        located.of_picks = vec![Vec::new(); node_picks.len()];
        // The requests for each instance: node numbers, and selections of more than one.
        let mut of_instances: Vec<(Vec<u32>, Vec<usize>)> = vec![Default::default(); self.instances.len()];
        for face in faces {
            of_instances[face.instance].0.extend_from_slice(face.nodes());
        }
        for (i, pick) in node_picks.iter().enumerate() {
            let (wanted, here) = &mut of_instances[pick.instance];
            match pick.number {
                Some(number) => {
                    wanted.push(number);
                    located.of_picks[i] = vec![number];
                }
                None => here.push(i),
            }
        }
        for (instance, (wanted, here)) in of_instances.into_iter().enumerate() {
            let mut wanted = Wanted::new(wanted);
            let selections: Vec<&Selection> = here.iter().map(|i| &node_picks[*i].nodes).collect();
            let selected = if let Some(maker) =
                self.mover(instance).filter(|_| !wanted.labels.is_empty() || !selections.is_empty())
            {
                self.note(maker, "nodes of which some follow *SYSTEM are not read".to_owned());
                vec![Vec::new(); selections.len()]
            } else {
                self.read_nodes(instance, &mut wanted, &selections)?
            };
            for (i, labels) in here.into_iter().zip(selected) {
                located.of_picks[i] = labels;
            }
            located.add(instance, self.instances[instance].name.as_ref(), wanted);
        }
        Ok(located)
    }

    /// An option that moves nodes and is not read.
    fn mover(&self, instance: usize) -> Option<Span> {
        let mut makers = self.chain(Context::Instance(instance)).flat_map(|definitions| &definitions.makers);
        makers.find(|(name, _)| name == "SYSTEM").map(|(_, span)| *span)
    }
}
