//! Nodes that represent a part of the deck's mesh, and the step whose conditions they take.

use super::{Reader, start};
use crate::scene::file::ConditionsEntry;
use crate::scene::rules::MALFORMED_SCENE;
use crate::scene::{ConditionsOfDeck, NodePart, PartKind, Scene};
use inpact_parser::model::Name;
use toml::Spanned;

/// The maximum plausible number of steps of a deck.
const MAX_STEPS: f64 = 1e6;

impl Reader<'_> {
    /// The conditions taken from the deck.
    pub(super) fn deck_conditions(&mut self, entry: Option<&Spanned<ConditionsEntry>>) -> Option<ConditionsOfDeck> {
        let entry = entry?;
        let line = self.line_of(entry);
        let Some(number) = &entry.as_ref().step else { return Some(ConditionsOfDeck { step: None, line }) };
        let value = number.value();
        if !((1.0..=MAX_STEPS).contains(&value) && value.fract() == 0.0) {
            let message = format!("`conditions.step` is {}", self.written(number));
            let help = format!("give the number of a step of the deck, from 1 to {MAX_STEPS:.0} at most");
            self.report(&MALFORMED_SCENE, number.span().start, message, &help);
            return None;
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "it is a whole number within limits"
        )]
        let step = Some(value as usize);
        Some(ConditionsOfDeck { step, line })
    }

    /// The part of the deck that a node represents.
    pub(super) fn take_part(
        &mut self,
        set: Option<Spanned<String>>,
        surface: Option<Spanned<String>>,
        node: u32,
        scene: &mut Scene,
    ) {
        let (kind, name) = match (set, surface) {
            (None, None) => return,
            (Some(set), None) => (PartKind::Set, set),
            (None, Some(surface)) => (PartKind::Surface, surface),
            (Some(_), Some(surface)) => {
                let message = format!("node `{}` has `set` and `surface`", scene.nodes[node as usize]);
                return self.report(&MALFORMED_SCENE, start(&surface), message, "a node stands for one of the two");
            }
        };
        let line = self.line_of(&name);
        scene.parts.insert(node, NodePart { kind, name: Name::new(name.as_ref()), line });
    }

    /// Reports parts without conditions, and conditions without a node.
    pub(super) fn check_parts(&mut self, scene: &Scene) {
        match (&scene.deck_conditions, scene.parts.values().next()) {
            (None, Some(part)) if !self.findings.has_errors() => {
                let message =
                    format!("the node stands for `{}` of the deck, and nothing is taken from there", part.name);
                let help = "add [conditions], so that it takes the conditions of the deck, or leave the name out";
                self.report_in_line(&MALFORMED_SCENE, part.line, message, help);
            }
            (Some(of), None) if !self.lacks_nodes && !self.findings.has_errors() => {
                let help = "add `set` or `surface` to the nodes that take conditions of the deck";
                self.report_in_line(&MALFORMED_SCENE, of.line, "no node takes the conditions of the deck", help);
            }
            _ => {}
        }
    }
}
