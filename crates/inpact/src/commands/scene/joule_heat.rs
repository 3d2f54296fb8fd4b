//! The heat of the current in bodies: what their links turn into heat, and what the deck does not say of it.

use super::Lines;
use super::terminals::Terminal;
use inpact_body::{BodyField, JouleHeat, Lumped};
use inpact_parser::mesh::MeshNote;

/// The heat of the current in the bodies of a scene that has both potentials and temperatures.
#[derive(Default)]
pub(super) struct JouleHeats {
    /// The share of each terminal's links; `None` where the deck gives none, or the scene has one field alone.
    shares: Vec<Option<f64>>,
    /// What the deck does not say.
    pub(super) missing: Lines,
    /// The bodies whose current makes heat.
    pub(super) heated: Lines,
}

impl JouleHeats {
    /// That of the bodies; shares that links cannot have go to the notes.
    pub(super) fn of(terminals: &[Terminal], lumped: &[Lumped], notes: &mut Vec<MeshNote>) -> Self {
        let of_field = |field: BodyField| lumped.iter().find(|of| of.field == field);
        let mut heats = Self { shares: vec![None; terminals.len()], ..Self::default() };
        let Some((electrical, _)) = of_field(BodyField::Electrical).zip(of_field(BodyField::Thermal)) else {
            return heats;
        };
        for body in electrical.bodies.iter().filter(|body| 1 < body.terminals.len()) {
            let names: Vec<String> = body.terminals.iter().map(|at| format!("`{}`", terminals[*at].name)).collect();
            let body_of = format!("the body of {}", names.join(", "));
            match &body.joule_heat {
                JouleHeat::Share(share) => {
                    body.terminals.iter().for_each(|at| heats.shares[*at] = Some(*share));
                    if 0.0 < *share {
                        heats.heated.push(format!("{body_of}: half of the heat of its current in either node of a link"));
                    }
                }
                JouleHeat::Unsaid(material) => heats.missing.push(format!(
                    "the current makes no heat in {body_of}: `{material}` has no *JOULE HEAT FRACTION (give `joule_heat_fraction` of its links, or at the top of the scene for all)"
                )),
                JouleHeat::NotOne(span, why) => {
                    let message = format!("{why}; the current makes no heat in {body_of}");
                    notes.push(MeshNote { span: *span, message });
                }
            }
        }
        heats
    }

    /// The share of the links of a terminal; 0 makes no heat and is what a link has that gives none.
    pub(super) fn share(&self, terminal: usize) -> Option<f64> {
        self.shares[terminal].filter(|share| 0.0 < *share)
    }
}
