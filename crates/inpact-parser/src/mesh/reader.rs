//! The way from a deck to its mesh: surfaces, sets, elements, nodes, in this order.

use super::conditions::{StepEntry, Target};
use super::elements::RawFace;
use super::layout::{Definitions, Entry, Layout, MaterialEntries};
use super::nodes::{Placement, Wanted};
use super::pairs::Request;
use super::rows::RowBytes;
use super::selection::{Kind, Selected, Selection};
use super::surfaces::{NodePick, Picks};
use super::{Mesh, MeshNode, MeshNote};
use crate::deck::Deck;
use crate::grammar::{Dialect, Grammar};
use crate::model::{Model, Name};
use crate::span::Span;
use inpact_geometry::NodeId;
use std::collections::{HashMap, HashSet};
use std::io;
use std::ops::Range;

/// Scopes of names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Context {
    /// In the model and the assembly.
    Top,
    /// In an instance and its part, or in a model without instances.
    Instance(usize),
}

impl Context {
    /// The body that a number without an instance belongs to.
    pub(super) fn instance(self) -> usize {
        match self {
            Self::Top => 0,
            Self::Instance(instance) => instance,
        }
    }
}

/// A scope of nodes and elements: the model (always the first), or an instance.
pub(super) struct Instance<'deck> {
    pub(super) name: Option<Name>,
    /// The instance's own options, then those of its part.
    chain: Vec<Definitions<'deck>>,
    pub(super) placement: Placement,
    entry: Option<Entry<'deck>>,
}

/// Reads a mesh.
pub(super) struct Reader<'deck, 'rows> {
    pub(super) rows: &'rows mut dyn RowBytes,
    pub(super) instances: Vec<Instance<'deck>>,
    pub(super) sets: HashMap<(Kind, Context, String), Selected>,
    pub(super) clearances: Vec<Entry<'deck>>,
    pub(super) initial_conditions: Vec<Entry<'deck>>,
    pub(super) materials: Vec<MaterialEntries<'deck>>,
    pub(super) beside_elements: Vec<(&'static str, Entry<'deck>)>,
    pub(super) step_entries: Vec<Entry<'deck>>,
    pub(super) conditions: Vec<StepEntry<'deck>>,
    pub(super) amplitudes: Vec<Entry<'deck>>,
    pub(super) dialect: Dialect,
    assembly: Definitions<'deck>,
    assembly_name: Option<Name>,
    notes: Vec<MeshNote>,
    /// The same, so that each is said once.
    noted: HashSet<MeshNote>,
}

impl<'deck, 'rows> Reader<'deck, 'rows> {
    pub(super) fn new(deck: &'deck Deck, grammar: &Grammar, rows: &'rows mut dyn RowBytes) -> Self {
        let layout = Layout::of(deck, grammar);
        let mut instances =
            vec![Instance { name: None, chain: vec![layout.model], placement: Placement::NONE, entry: None }];
        for instance in layout.instances {
            let part = instance.part.map(|part| layout.parts[part].1.clone());
            let chain = std::iter::once(instance.own).chain(part).collect();
            instances.push(Instance {
                name: Some(instance.name),
                chain,
                placement: Placement::NONE,
                entry: Some(instance.entry),
            });
        }
        Self {
            rows,
            instances,
            sets: HashMap::new(),
            clearances: layout.clearances,
            initial_conditions: layout.initial_conditions,
            materials: layout.materials,
            beside_elements: layout.beside_elements,
            step_entries: layout.steps,
            conditions: layout.conditions,
            amplitudes: layout.amplitudes,
            dialect: grammar.dialect(),
            assembly: layout.assembly,
            assembly_name: layout.assembly_name,
            notes: Vec::new(),
            noted: HashSet::new(),
        }
    }

    /// Reads the contact pairs, and targets beside them; gives the positions of these among the surfaces of the mesh.
    pub(super) fn read(mut self, model: &Model, targets: &[Target]) -> io::Result<(Mesh, Vec<Option<usize>>)> {
        let Request { names, pairs } = self.request(model);
        let mut wanted: Vec<Target> = names.into_iter().map(Target::Surface).collect();
        let mut places = Vec::new();
        for target in targets {
            places.push(wanted.iter().position(|known| known.is(target)).unwrap_or_else(|| {
                wanted.push(target.clone());
                wanted.len() - 1
            }));
        }
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
            surfaces.push(self.surface(surface, name, found, &faces[from..to], &picks.nodes, &located)?);
        }
        // Pairs whose surfaces were not found stay out; a note says so.
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
        let steps = self.step_entries.iter().map(|step| step.named("NAME")).collect();
        let mesh = Mesh { points, nodes, surfaces, pairs, initial, steps, notes: self.notes };
        Ok((mesh, places.into_iter().map(|place| positions[place]).collect()))
    }

    /// Reads where the instances are.
    pub(super) fn place_instances(&mut self) -> io::Result<()> {
        for instance in 1..self.instances.len() {
            if let Some(entry) = self.instances[instance].entry {
                self.instances[instance].placement = self.placement(entry)?;
            }
        }
        Ok(())
    }

    /// The notes so far.
    pub(super) fn take_notes(&mut self) -> Vec<MeshNote> {
        self.noted.clear();
        std::mem::take(&mut self.notes)
    }

    pub(super) fn note(&mut self, span: Span, message: String) {
        let note = MeshNote { span, message };
        if self.noted.insert(note.clone()) {
            self.notes.push(note);
        }
    }

    /// One note for many of a kind: the first of them, and how many there are.
    pub(super) fn note_first(&mut self, mut found: Vec<(Span, String)>, ending: &str) {
        if found.is_empty() {
            return;
        }
        let count = found.len();
        let (span, first) = found.swap_remove(0);
        let more = if 1 < count { format!(", and so were {} more", count - 1) } else { String::new() };
        self.note(span, format!("{first} {ending}{more}"));
    }

    /// The options that names are looked up in.
    pub(super) fn chain(&self, context: Context) -> impl Iterator<Item = &Definitions<'deck>> {
        let assembly = matches!(context, Context::Top).then_some(&self.assembly);
        self.instances[context.instance()].chain.iter().chain(assembly)
    }

    pub(super) fn instance_named(&self, name: &Name) -> Option<usize> {
        self.instances.iter().position(|instance| instance.name.as_ref() == Some(name))
    }

    /// Takes the name of an instance or of the assembly from the front of a dotted name (S-44).
    pub(super) fn without_prefix(&self, context: Context, name: Name) -> (Context, Name) {
        let written = name.canonical();
        let rest = |prefix: &Name| {
            let rest = written.strip_prefix(prefix.canonical())?.strip_prefix('.')?;
            // In quotes it stays as it is.
            (!rest.is_empty()).then(|| Name::new(&format!("\"{rest}\"")))
        };
        if let Some(name) = self.assembly_name.as_ref().and_then(rest) {
            return self.without_prefix(Context::Top, name);
        }
        let instance =
            self.instances.iter().enumerate().find_map(|(i, instance)| Some((i, rest(instance.name.as_ref()?)?)));
        match instance {
            Some((instance, name)) => (Context::Instance(instance), name),
            None => (context, name),
        }
    }

    /// Finds the nodes of all faces and node surfaces.
    fn locate(&mut self, faces: &[RawFace], node_picks: &[NodePick]) -> io::Result<Located> {
        let mut located = Located { of_picks: vec![Vec::new(); node_picks.len()], ..Located::default() };
        for instance in 0..self.instances.len() {
            let of_faces = faces.iter().filter(|face| face.instance == instance);
            let mut wanted: Vec<u32> = of_faces.flat_map(|face| face.nodes().iter().copied()).collect();
            let mut here = Vec::new();
            for (i, pick) in node_picks.iter().enumerate().filter(|(_, pick)| pick.instance == instance) {
                match pick.number {
                    Some(number) => {
                        wanted.push(number);
                        located.of_picks[i] = vec![number];
                    }
                    None => here.push(i),
                }
            }
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

    /// An option that moves nodes in a way that is not read.
    fn mover(&self, instance: usize) -> Option<Span> {
        let mut makers = self.chain(Context::Instance(instance)).flat_map(|definitions| &definitions.makers);
        makers.find(|(name, _)| name == "SYSTEM").map(|(_, span)| *span)
    }

    /// The options of an instance that make or move nodes or elements and are not read.
    pub(super) fn makers_of(&self, instance: usize) -> Vec<(String, Span)> {
        self.chain(Context::Instance(instance)).flat_map(|definitions| definitions.makers.clone()).collect()
    }

    /// Names of the surfaces and node sets of the model, then those of the instances, each once.
    pub(super) fn known_names(&self) -> Vec<Name> {
        let mut names: Vec<Name> = Vec::new();
        let mut seen = HashSet::new();
        let top = self.chain(Context::Top).flat_map(named_in).map(|name| (None, name));
        let others = self.instances.iter().filter_map(|instance| Some((instance.name.as_ref()?, &instance.chain)));
        let of_instances = others
            .flat_map(|(instance, chain)| chain.iter().flat_map(named_in).map(move |name| (Some(instance), name)));
        for (instance, name) in top.chain(of_instances) {
            let name = instance.map_or(name.clone(), |instance| Name::new(&format!("{instance}.{name}")));
            if seen.insert(name.clone()) {
                names.push(name);
            }
        }
        names
    }

    /// The options of a instance that make nodes or elements and are not read, as text.
    pub(super) fn makers(&self, instance: usize) -> String {
        let mut names: Vec<&str> = self
            .chain(Context::Instance(instance))
            .flat_map(|definitions| &definitions.makers)
            .map(|(name, _)| name.as_str())
            .collect();
        names.sort_unstable();
        names.dedup();
        names.iter().map(|name| format!(" (*{name} is not read)")).collect()
    }
}

/// The names of surfaces and node sets.
fn named_in<'a>(definitions: &'a Definitions<'_>) -> impl Iterator<Item = Name> + 'a {
    let of = |entries: &'a [Entry<'_>], parameter: &'static str| {
        entries.iter().filter_map(move |entry| entry.named(parameter))
    };
    let surfaces = of(&definitions.surfaces, "NAME");
    surfaces.chain(of(&definitions.nsets, "NSET")).chain(of(&definitions.nodes, "NSET"))
}

/// The nodes that were found, numbered.
#[derive(Debug, Default)]
pub(super) struct Located {
    points: Vec<[f64; 3]>,
    nodes: Vec<MeshNode>,
    ids: HashMap<(usize, u32), NodeId>,
    /// The keyword line of the *NODE option of each.
    pub(super) options: Vec<Span>,
    /// The nodes of each instance.
    pub(super) of_instances: Vec<Range<usize>>,
    /// The numbers of the nodes of each pick.
    pub(super) of_picks: Vec<Vec<u32>>,
}

impl Located {
    fn add(&mut self, instance: usize, name: Option<&Name>, wanted: Wanted) {
        let first = self.points.len();
        for (label, point) in wanted.labels.into_iter().zip(wanted.points) {
            let Some((point, option)) = point else { continue };
            let Ok(id) = u32::try_from(self.points.len()) else { continue };
            self.ids.insert((instance, label), NodeId(id));
            self.points.push(point);
            self.options.push(option);
            self.nodes.push(MeshNode { instance: name.cloned(), label });
        }
        self.of_instances.push(first..self.points.len());
    }

    /// The number of nodes.
    pub(super) fn len(&self) -> usize {
        self.nodes.len()
    }

    /// The number of a node in its instance.
    pub(super) fn label(&self, node: usize) -> u32 {
        self.nodes[node].label
    }

    pub(super) fn id(&self, instance: usize, label: u32) -> Option<NodeId> {
        self.ids.get(&(instance, label)).copied()
    }
}
