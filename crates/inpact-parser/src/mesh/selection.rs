//! Nodes or elements of a set (*NSET, *ELSET with GENERATE and INSTANCE, NSET on *NODE, ELSET on *ELEMENT), in each instance.

use super::layout::{Entry, Gives, canonical};
use super::reader::{Context, Reader};
use super::rows::data_lines;
use super::selected::{Kind, Selected, Selection};
use crate::deck::items;
use crate::model::Name;
use crate::span::Span;
use std::collections::BTreeMap;
use std::io;

impl<'deck> Reader<'deck, '_> {
    /// Selects by an item of a row: a number, the name of a set, or either after the name of an instance and a dot.
    pub(super) fn select(&mut self, kind: Kind, context: Context, item: &str, span: Span) -> io::Result<Selected> {
        let name = Name::new(item);
        let (context, name) = self.without_prefix(context, name);
        if let Ok(label) = name.canonical().parse() {
            let mut selection = Selection::default();
            selection.labels.add(label);
            selection.labels.sort();
            return Ok(BTreeMap::from([(context.instance(), selection)]));
        }
        let key = (kind, context, name.canonical().to_owned());
        if let Some(known) = self.sets.get(&key) {
            return Ok(known.clone());
        }
        // A set that names itself adds nothing to itself.
        self.sets.insert(key.clone(), Selected::new());
        let (sets, options) = self.definitions_of(kind, context, &name);
        if sets.is_empty() && options.is_empty() {
            let what = if kind == Kind::Elements { "element" } else { "node" };
            self.note(span, format!("the {what} set `{name}` is not defined here, so that nothing of it was read"));
        }
        let mut selected = Selected::new();
        for option in options {
            selected.entry(context.instance()).or_default().options.push(option);
        }
        for set in sets {
            self.read_set(kind, context, set, &mut selected)?;
        }
        for selection in selected.values_mut() {
            selection.labels.sort();
        }
        self.sets.insert(key, selected.clone());
        Ok(selected)
    }

    /// The sets of this name, and the *NODE or *ELEMENT options that put their rows into it.
    pub(super) fn definitions_of(&self, kind: Kind, context: Context, name: &Name) -> (Vec<Entry<'deck>>, Vec<Span>) {
        let (of_sets, of_rows) = match kind {
            Kind::Elements => (Gives::ElementSet, Gives::Elements),
            Kind::Nodes => (Gives::NodeSet, Gives::Nodes),
        };
        let mut sets = Vec::new();
        let mut options = Vec::new();
        for definitions in self.chain(context) {
            sets.extend_from_slice(definitions.called(of_sets, name));
            options.extend(definitions.called(of_rows, name).iter().map(|entry| entry.keyword.span));
        }
        (sets, options)
    }

    fn read_set(&mut self, kind: Kind, context: Context, set: Entry<'_>, selected: &mut Selected) -> io::Result<()> {
        let context = match set.named("INSTANCE") {
            None => context,
            Some(instance) => match self.instance_named(&instance) {
                Some(instance) => Context::Instance(instance),
                None => {
                    self.note(
                        set.span(),
                        format!("the instance `{instance}` is not defined, so that its part of the set was not read"),
                    );
                    return Ok(());
                }
            },
        };
        let is_of_elements =
            canonical(set.deck.text(set.keyword.name())).starts_with("NSET") && set.parameter("ELSET").is_some();
        if is_of_elements {
            self.note(set.span(), "a node set made of an element set (ELSET) is not read".to_owned());
            return Ok(());
        }
        let generated = set.parameter("GENERATE").is_some();
        let own = selected.entry(context.instance()).or_default();
        let mut others: Vec<(String, Span)> = Vec::new();
        data_lines(&mut *self.rows, set.block, &mut |line, span| {
            if generated {
                let numbers: Vec<Option<u32>> = items(line).map(|item| unsigned(&line[item])).collect();
                match numbers[..] {
                    [Some(first), Some(last)] | [Some(first), Some(last), None] => own.labels.add_steps(first, last, 1),
                    [Some(first), Some(last), Some(step), ..] => own.labels.add_steps(first, last, step),
                    _ => others.push((String::from_utf8_lossy(line).into_owned(), span)),
                }
                return;
            }
            for item in items(line).map(|item| &line[item]).filter(|item| !item.is_empty()) {
                match unsigned(item) {
                    Some(label) => own.labels.add(label),
                    None => others.push((String::from_utf8_lossy(item).into_owned(), span)),
                }
            }
        })?;
        for (item, span) in others {
            if generated {
                self.note(
                    span,
                    format!("expected first, last and step of a set, found `{}`, which was not read", item.trim()),
                );
                continue;
            }
            for (instance, selection) in self.select(kind, context, &item, span)? {
                selected.entry(instance).or_default().add_all(&selection);
            }
        }
        Ok(())
    }
}

/// An unsigned number of nothing but digits.
pub(super) fn unsigned(text: &[u8]) -> Option<u32> {
    let mut value: u32 = 0;
    for byte in text {
        let digit = byte.wrapping_sub(b'0');
        if 9 < digit {
            return None;
        }
        value = value.checked_mul(10)?.checked_add(u32::from(digit))?;
    }
    (!text.is_empty()).then_some(value)
}
