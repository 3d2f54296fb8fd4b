//! Joule heat in bodies: the fraction that their links turn into heat, and notes where the deck does not define it.

use crate::text::in_backticks;
use inpact_body::{BodyField, JouleHeat, Lumped};
use inpact_parser::mesh::MeshNote;
use inpact_parser::model::Name;

/// The key of a link for the fraction of the dissipated energy that becomes heat.
pub(super) const JOULE_HEAT_FRACTION: &str = "joule_heat_fraction";

/// Joule heat in bodies where both potentials and temperatures are requested.
#[derive(Default)]
pub(super) struct JouleHeats {
    /// The fraction of each terminal's links; `None` where the deck gives none, or only one field is requested.
    shares: Vec<Option<f64>>,
    /// Data that the deck lacks.
    pub(super) missing: Vec<MeshNote>,
    /// Fractions that links cannot have.
    pub(super) refused: Vec<MeshNote>,
    /// The bodies with Joule heat, each with its origin.
    pub(super) heated: Vec<String>,
}

impl JouleHeats {
    pub(super) fn of(terminals: &[&Name], lumped: &[Lumped]) -> Self {
        let of_field = |field: BodyField| lumped.iter().find(|of| of.field == field);
        let mut heats = Self { shares: vec![None; terminals.len()], ..Self::default() };
        let Some((electrical, _)) = of_field(BodyField::Electrical).zip(of_field(BodyField::Thermal)) else {
            return heats;
        };
        for body in electrical.bodies.iter().filter(|body| 1 < body.terminals.len()) {
            let body_of = format!("the body of {}", in_backticks(body.terminals.iter().map(|at| terminals[*at])));
            match &body.joule_heat {
                JouleHeat::Share(share) => {
                    body.terminals.iter().for_each(|at| heats.shares[*at] = Some(*share));
                    if 0.0 < *share {
                        heats
                            .heated
                            .push(format!("{body_of}: half of the heat of its current in either node of a link"));
                    }
                }
                JouleHeat::Unsaid(span, material) => {
                    let message = format!(
                        "the current makes no heat in {body_of}: `{material}` has no *JOULE HEAT FRACTION (give `{JOULE_HEAT_FRACTION}` of its links, or at the top of the scene for all)"
                    );
                    heats.missing.push(MeshNote { span: *span, message });
                }
                JouleHeat::NotOne(span, why) => {
                    let message = format!("{why}; the current makes no heat in {body_of}");
                    heats.refused.push(MeshNote { span: *span, message });
                }
            }
        }
        heats
    }

    /// The fraction of the links of a terminal with an electrical conductance; 0 by default.
    pub(super) fn share(&self, terminal: usize) -> Option<f64> {
        self.shares[terminal].filter(|share| 0.0 < *share)
    }

    /// Whether there is any Joule heat.
    pub(super) fn is_any(&self) -> bool {
        !self.heated.is_empty()
    }
}
