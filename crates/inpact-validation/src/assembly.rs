//! Parts, instances and the assembly of a deck, and which surfaces are in them (S-44, S-74, S-75).

use crate::parameter::given_as;
use crate::references::{Definitions, components};
use crate::rule::{Context, DefinedBlock};
use crate::suggestion::did_you_mean;
use inpact_parser::deck::KeywordLine;
use inpact_parser::grammar::nearest_names;
use inpact_parser::model::Name;
use std::collections::{HashMap, HashSet};

/// Names that dotted names refer to.
#[derive(Debug, Default)]
pub(crate) struct Assembly {
    /// The name of the assembly.
    names: HashSet<Name>,
    /// The instances, each with the part it is one of.
    instances: HashMap<Name, Option<Name>>,
    /// The surfaces of every part and instance.
    surfaces: HashSet<(Name, Name)>,
}

impl Assembly {
    /// Walks through the parts and instances of the deck.
    pub(crate) fn of(context: &Context<'_>) -> Self {
        let mut assembly = Self::default();
        // The part or instance that is open.
        let mut open: Option<Name> = None;
        for block in context.defined_blocks() {
            let name = named(context, block, "NAME");
            match block.name {
                "PART" => open = name,
                "INSTANCE" => {
                    open.clone_from(&name);
                    assembly.instances.extend(name.map(|name| (name, named(context, block, "PART"))));
                }
                "ASSEMBLY" => assembly.names.extend(name),
                "END PART" | "END INSTANCE" => open = None,
                "SURFACE" => assembly.surfaces.extend(open.clone().zip(name)),
                _ => {}
            }
        }
        assembly
    }

    /// Whether a dotted name is defined: `INSTANCE.SURFACE`, or either with the assembly in front.
    ///
    /// In a deck without instances the parts of a name are unknown: its last one decides.
    pub(crate) fn has(&self, name: &Name, definitions: &Definitions) -> bool {
        let parts = components(name);
        let Some((last, [first, ..])) = parts.split_last() else { return false };
        if self.instances.is_empty() {
            return definitions.has(last);
        }
        match parts.as_slice() {
            [_, surface] if self.names.contains(first) && !self.instances.contains_key(first) => {
                definitions.has(surface)
            }
            [instance, surface] => self.is_in(instance, surface),
            [assembly, instance, surface] => self.names.contains(assembly) && self.is_in(instance, surface),
            _ => false,
        }
    }

    fn is_in(&self, instance: &Name, surface: &Name) -> bool {
        let Some(part) = self.instances.get(instance) else { return false };
        [Some(instance), part.as_ref()]
            .into_iter()
            .flatten()
            .any(|place| self.surfaces.contains(&(place.clone(), surface.clone())))
    }

    /// The fault of a dotted name: its instance, or the surface in it.
    pub(crate) fn help(&self, name: &Name, definitions: &Definitions) -> Option<String> {
        let parts = components(name);
        let [.., instance, surface] = parts.as_slice() else { return None };
        if self.instances.is_empty() {
            return None;
        }
        if !self.instances.contains_key(instance) {
            let names = self.instances.keys().map(Name::written);
            let near = nearest_names(instance.canonical().as_bytes(), names, 3);
            let meant = did_you_mean(near).unwrap_or_else(|| "check the name of the instance".to_owned());
            return Some(format!("there is no instance `{instance}`: {meant}"));
        }
        let elsewhere = definitions.has(surface);
        elsewhere
            .then(|| format!("surface `{surface}` is not in instance `{instance}` nor in its part: check both names"))
    }
}

/// Whether the deck has a complete mesh.
pub(crate) fn defines_its_mesh(context: &Context<'_>) -> bool {
    has_mesh(context) && is_whole(context)
}

/// Whether nodes or elements are defined.
pub(crate) fn has_mesh(context: &Context<'_>) -> bool {
    keywords(context).any(|(name, _)| matches!(name, "NODE" | "ELEMENT"))
}

/// Whether the whole deck is in its files: no imported part, instance of a library or restart.
pub(crate) fn is_whole(context: &Context<'_>) -> bool {
    keywords(context).all(|(name, line)| {
        let is_given = |name: &[u8]| {
            line.parameters().any(|parameter| context.deck.text(parameter.name).eq_ignore_ascii_case(name))
        };
        match name {
            "IMPORT" => false,
            "INSTANCE" => !is_given(b"LIBRARY") && !is_given(b"INSTANCE"),
            "RESTART" => !is_given(b"READ"),
            _ => true,
        }
    })
}

/// The keywords of the deck in full, with their lines.
fn keywords<'a>(context: &Context<'a>) -> impl Iterator<Item = (&'a str, &'a KeywordLine)> {
    let grammar = context.grammar;
    context.keyword_lines().filter_map(move |line| Some((grammar.keyword(line.id()?).name.as_str(), line)))
}

fn named(context: &Context<'_>, block: DefinedBlock<'_>, parameter: &str) -> Option<Name> {
    let value = given_as(block, parameter)?.value()?;
    Some(Name::new(&context.value(value)))
}
