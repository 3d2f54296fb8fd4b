//! Structure of a deck: model, parts, instances, assembly, and the mesh options in each (S-71 to S-75).

use super::condition_keywords::{condition, is_called};
use crate::deck::{Block, Deck, KeywordLine};
use crate::grammar::{Grammar, Level};
use crate::model::Name;
use crate::span::Span;
use std::collections::HashMap;

/// An option of the deck with its rows.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry<'deck> {
    pub(super) deck: &'deck Deck,
    pub(super) keyword: &'deck KeywordLine,
    pub(super) block: &'deck Block,
}

/// A keyword of a step with the step's number.
#[derive(Debug, Clone)]
pub(super) struct StepEntry<'deck> {
    pub(super) step: usize,
    pub(super) keyword: &'static str,
    pub(super) entry: Entry<'deck>,
}

impl<'deck> Entry<'deck> {
    /// The value of a parameter; a parameter without a value has an empty one. Names may be shortened to three letters.
    pub(super) fn parameter(&self, name: &str) -> Option<&'deck str> {
        self.keyword.parameters().find_map(|parameter| {
            let written = canonical(self.deck.text(parameter.name));
            let matches = written == name || (3 <= written.len() && name.starts_with(&written));
            let text = || parameter.value.map_or(&b""[..], |value| self.deck.text(value));
            matches.then(|| std::str::from_utf8(text()).unwrap_or(""))
        })
    }

    /// The value of a parameter in upper case, without blanks.
    pub(super) fn choice(&self, parameter: &str) -> Option<String> {
        self.parameter(parameter).map(|text| canonical(text.as_bytes()))
    }

    /// The value of a parameter as a name.
    pub(super) fn named(&self, parameter: &str) -> Option<Name> {
        self.parameter(parameter).map(Name::new)
    }

    /// NAME, which is empty where it is not given.
    fn name(&self) -> Name {
        self.named("NAME").unwrap_or_else(|| Name::new(""))
    }

    /// The keyword line.
    pub(super) fn span(&self) -> Span {
        self.keyword.visible_span(self.deck)
    }
}

/// The options of one model, part, instance or assembly.
#[derive(Debug, Clone, Default)]
pub(super) struct Definitions<'deck> {
    pub(super) nodes: Vec<Entry<'deck>>,
    pub(super) elements: Vec<Entry<'deck>>,
    pub(super) nsets: Vec<Entry<'deck>>,
    pub(super) surfaces: Vec<Entry<'deck>>,
    pub(super) sections: Vec<Entry<'deck>>,
    pub(super) orientations: Vec<Entry<'deck>>,
    /// Options that generate or move nodes or elements, and are not read.
    pub(super) makers: Vec<(String, Span)>,
    /// Options by the names that they give: a deck may have more of them than anything else.
    called: HashMap<(Gives, Name), Vec<Entry<'deck>>>,
}

/// Options that name a set.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Gives {
    /// ELSET of *ELEMENT.
    Elements,
    /// *ELSET.
    ElementSet,
    /// NSET of *NODE.
    Nodes,
    /// *NSET.
    NodeSet,
    /// *SURFACE.
    Surface,
}

/// A part that was placed.
#[derive(Debug, Clone)]
pub(super) struct Instance<'deck> {
    pub(super) name: Name,
    pub(super) entry: Entry<'deck>,
    pub(super) part: Option<usize>,
    pub(super) own: Definitions<'deck>,
}

/// A *MATERIAL with its options for conduction and capacity.
#[derive(Debug, Clone)]
pub(super) struct MaterialEntries<'deck> {
    pub(super) name: Name,
    pub(super) entry: Entry<'deck>,
    /// By the canonical names of their keywords.
    pub(super) properties: Vec<(String, Entry<'deck>)>,
}

/// The structure of the deck by level.
#[derive(Debug, Clone, Default)]
pub(super) struct Layout<'deck> {
    pub(super) model: Definitions<'deck>,
    pub(super) assembly: Definitions<'deck>,
    pub(super) parts: Vec<(Name, Definitions<'deck>)>,
    pub(super) instances: Vec<Instance<'deck>>,
    pub(super) clearances: Vec<Entry<'deck>>,
    pub(super) initial_conditions: Vec<Entry<'deck>>,
    pub(super) assembly_name: Option<Name>,
    pub(super) materials: Vec<MaterialEntries<'deck>>,
    /// Options that join nodes beside the elements, or let heat out by radiation, by their names.
    pub(super) beside_elements: Vec<(&'static str, Entry<'deck>)>,
    /// The *STEP options.
    pub(super) steps: Vec<Entry<'deck>>,
    /// Blocks that may hold conditions, in the order of the deck.
    pub(super) conditions: Vec<StepEntry<'deck>>,
    pub(super) amplitudes: Vec<Entry<'deck>>,
}

impl<'deck> Layout<'deck> {
    pub(super) fn of(deck: &'deck Deck, grammar: &Grammar) -> Self {
        let mut layout = Self::default();
        let mut level = Level::Model;
        for block in deck.blocks() {
            let Some(keyword) = &block.keyword else { continue };
            let Some(id) = keyword.id() else { continue };
            let entry = Entry { deck, keyword, block };
            let name = canonical(grammar.keyword(id).name.as_bytes());
            match name.as_str() {
                "PART" => {
                    layout.parts.push((entry.name(), Definitions::default()));
                    level = Level::Part;
                }
                "INSTANCE" => {
                    let part = entry.named("PART");
                    let part = part.and_then(|part| layout.parts.iter().position(|(name, _)| *name == part));
                    layout.instances.push(Instance { name: entry.name(), entry, part, own: Definitions::default() });
                    level = Level::Instance;
                }
                "ASSEMBLY" => {
                    layout.assembly_name = entry.named("NAME");
                    level = Level::Assembly;
                }
                "ENDINSTANCE" => level = Level::Assembly,
                "ENDPART" | "ENDASSEMBLY" => level = Level::Model,
                "STEP" => layout.steps.push(entry),
                "AMPLITUDE" => layout.amplitudes.push(entry),
                "CLEARANCE" => layout.clearances.push(entry),
                "INITIALCONDITIONS" => layout.initial_conditions.push(entry),
                "MATERIAL" => {
                    layout.materials.push(MaterialEntries { name: entry.name(), entry, properties: Vec::new() });
                }
                "CONDUCTIVITY" | "ELECTRICALCONDUCTIVITY" | "DENSITY" | "SPECIFICHEAT" | "JOULEHEATFRACTION" => {
                    if let Some(material) = layout.materials.last_mut() {
                        material.properties.push((name, entry));
                    }
                }
                _ => {
                    let beside = BESIDE_ELEMENTS.into_iter().find(|keyword| is_called(keyword, &name));
                    layout.beside_elements.extend(beside.map(|keyword| (keyword, entry)));
                    if let Some(keyword) = condition(&name) {
                        layout.conditions.push(StepEntry { step: layout.steps.len(), keyword, entry });
                    } else if beside.is_none() {
                        layout.at(level).add(&name, entry);
                    }
                }
            }
        }
        layout
    }

    fn at(&mut self, level: Level) -> &mut Definitions<'deck> {
        match level {
            Level::Part => self.parts.last_mut().map_or(&mut self.model, |(_, definitions)| definitions),
            Level::Instance => self.instances.last_mut().map_or(&mut self.model, |instance| &mut instance.own),
            Level::Assembly => &mut self.assembly,
            Level::Model | Level::Step => &mut self.model,
        }
    }
}

impl<'deck> Definitions<'deck> {
    fn add(&mut self, name: &str, entry: Entry<'deck>) {
        match name {
            "NODE" => {
                self.nodes.push(entry);
                self.call(Gives::Nodes, entry, "NSET");
            }
            "ELEMENT" => {
                self.elements.push(entry);
                self.call(Gives::Elements, entry, "ELSET");
            }
            "NSET" => {
                self.nsets.push(entry);
                self.call(Gives::NodeSet, entry, "NSET");
            }
            "ELSET" => self.call(Gives::ElementSet, entry, "ELSET"),
            "SURFACE" => {
                self.surfaces.push(entry);
                self.call(Gives::Surface, entry, "NAME");
            }
            "SOLIDSECTION" | "SHELLSECTION" | "SHELLGENERALSECTION" | "MEMBRANESECTION" => self.sections.push(entry),
            "ORIENTATION" => self.orientations.push(entry),
            "NGEN" | "NFILL" | "NCOPY" | "NMAP" | "ELGEN" | "ELCOPY" | "SYSTEM" => {
                self.makers.push((name.to_owned(), entry.span()));
            }
            _ => {}
        }
    }

    fn call(&mut self, gives: Gives, entry: Entry<'deck>, parameter: &str) {
        if let Some(name) = entry.named(parameter) {
            self.called.entry((gives, name)).or_default().push(entry);
        }
    }

    /// The options that give this name, in the order of the deck.
    pub(super) fn called(&self, gives: Gives, name: &Name) -> &[Entry<'deck>] {
        self.called.get(&(gives, name.clone())).map_or(&[], Vec::as_slice)
    }
}

/// Options that join nodes beside the elements, or let heat out by radiation.
const BESIDE_ELEMENTS: [&str; 12] = [
    "TIE",
    "EQUATION",
    "MPC",
    "COUPLING",
    "EMBEDDED ELEMENT",
    "SHELL TO SOLID COUPLING",
    "RIGID BODY",
    "RADIATE",
    "SRADIATE",
    "CRADIATE",
    "CAVITY DEFINITION",
    "RADIATION VIEWFACTOR",
];

/// Upper case, without blanks.
pub(super) fn canonical(text: &[u8]) -> String {
    text.iter().filter(|byte| !byte.is_ascii_whitespace()).map(|byte| char::from(byte.to_ascii_uppercase())).collect()
}
