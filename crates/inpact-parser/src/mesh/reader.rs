//! State shared by all readers of a mesh: the options of each scope, positions of instances, and notes.

use super::MeshNote;
use super::layout::{Definitions, Entry, Layout};
use super::placement::Placement;
use super::rows::RowBytes;
use super::selected::{Kind, Selected};
use crate::deck::Deck;
use crate::grammar::{Dialect, Grammar};
use crate::model::Name;
use crate::span::Span;
use std::collections::{HashMap, HashSet};

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
    pub(super) entry: Option<Entry<'deck>>,
}

/// Reads a mesh.
pub(super) struct Reader<'deck, 'rows> {
    pub(super) rows: &'rows mut dyn RowBytes,
    pub(super) instances: Vec<Instance<'deck>>,
    pub(super) sets: HashMap<(Kind, Context, String), Selected>,
    /// The options outside of instances.
    pub(super) layout: Layout<'deck>,
    pub(super) dialect: Dialect,
    /// The instances by the canonical forms of their names, the first of each.
    by_name: HashMap<String, usize>,
    pub(super) notes: Vec<MeshNote>,
    /// The same, so that each is reported once.
    noted: HashSet<MeshNote>,
}

impl<'deck, 'rows> Reader<'deck, 'rows> {
    pub(super) fn new(deck: &'deck Deck, grammar: &Grammar, rows: &'rows mut dyn RowBytes) -> Self {
        let mut layout = Layout::of(deck, grammar);
        let model = std::mem::take(&mut layout.model);
        let mut instances = vec![Instance { name: None, chain: vec![model], placement: Placement::NONE, entry: None }];
        for instance in std::mem::take(&mut layout.instances) {
            let part = instance.part.map(|part| layout.parts[part].1.clone());
            let chain = std::iter::once(instance.own).chain(part).collect();
            instances.push(Instance {
                name: Some(instance.name),
                chain,
                placement: Placement::NONE,
                entry: Some(instance.entry),
            });
        }
        let mut by_name = HashMap::new();
        for (index, instance) in instances.iter().enumerate() {
            if let Some(name) = &instance.name {
                by_name.entry(name.canonical().to_owned()).or_insert(index);
            }
        }
        Self {
            rows,
            instances,
            by_name,
            sets: HashMap::new(),
            layout,
            dialect: grammar.dialect(),
            notes: Vec::new(),
            noted: HashSet::new(),
        }
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

    /// One note for many of a kind: the first of them, and their number.
    pub(super) fn note_first(&mut self, mut found: Vec<(Span, String)>, ending: &str) {
        if found.is_empty() {
            return;
        }
        let count = found.len();
        let (span, first) = found.swap_remove(0);
        let more = if 1 < count { format!(", and so were {} more", count - 1) } else { String::new() };
        self.note(span, format!("{first} {ending}{more}"));
    }

    /// The options in which names are looked up.
    pub(super) fn chain(&self, context: Context) -> impl Iterator<Item = &Definitions<'deck>> {
        let assembly = matches!(context, Context::Top).then_some(&self.layout.assembly);
        self.instances[context.instance()].chain.iter().chain(assembly)
    }

    /// The options of one kind in an instance.
    pub(super) fn entries_of(
        &self,
        instance: usize,
        of: for<'a> fn(&'a Definitions<'deck>) -> &'a [Entry<'deck>],
    ) -> Vec<Entry<'deck>> {
        self.chain(Context::Instance(instance)).flat_map(of).copied().collect()
    }

    pub(super) fn instance_named(&self, name: &Name) -> Option<usize> {
        self.by_name.get(name.canonical()).copied()
    }

    /// Splits the name of an instance or of the assembly from a dotted name (S-44).
    pub(super) fn without_prefix(&self, context: Context, name: Name) -> (Context, Name) {
        let written = name.canonical();
        let rest_after = |dot: usize| {
            let rest = &written[dot + 1..];
            // In quotes it is unchanged.
            (!rest.is_empty()).then(|| Name::new(&format!("\"{rest}\"")))
        };
        let assembly = self.layout.assembly_name.as_ref().map(Name::canonical);
        let dots = || written.match_indices('.').map(|(dot, _)| dot);
        if let Some(name) = dots().find(|dot| assembly == Some(&written[..*dot])).and_then(rest_after) {
            return self.without_prefix(Context::Top, name);
        }
        let of_instance = |dot| Some((*self.by_name.get(&written[..dot])?, rest_after(dot)?));
        match dots().filter_map(of_instance).min_by_key(|(instance, _)| *instance) {
            Some((instance, name)) => (Context::Instance(instance), name),
            None => (context, name),
        }
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
