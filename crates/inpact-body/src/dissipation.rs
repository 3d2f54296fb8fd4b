//! Joule heat in bodies: *JOULE HEAT FRACTION of their materials.

use crate::body::Body;
use crate::material::values_at;
use inpact_parser::mesh::BodyMaterial;
use inpact_parser::model::Name;
use inpact_parser::span::Span;
use std::collections::BTreeSet;

/// The fraction of the energy dissipated by the current in a body that becomes heat in it.
#[derive(Debug, Clone, PartialEq)]
pub enum JouleHeat {
    /// From 0 to 1, the same in all of its materials.
    Share(f64),
    /// A material of the body has no *JOULE HEAT FRACTION: its line, and its name.
    Unsaid(Span, Name),
    /// A single fraction cannot represent the body: the line and the reason.
    NotOne(Span, String),
}

impl Body {
    /// The Joule heat of each body, in the order of [`parts`](Self::parts).
    pub(crate) fn joule_heat(&self) -> Vec<JouleHeat> {
        let mut used: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); self.parts.len()];
        for block in &self.mesh.elements {
            for nodes in block.each() {
                used[self.body_of(nodes) as usize].insert(block.material);
            }
        }
        let of_body = |materials: BTreeSet<usize>| {
            let materials: Vec<&BodyMaterial> =
                materials.into_iter().filter_map(|at| self.mesh.materials.get(at)).collect();
            shared(&materials).unwrap_or_else(|heat| heat)
        };
        used.into_iter().map(of_body).collect()
    }
}

/// The fraction common to all materials; `Err` is the reason why there is none.
fn shared(materials: &[&BodyMaterial]) -> Result<JouleHeat, JouleHeat> {
    let mut found: Option<(f64, &Name)> = None;
    for BodyMaterial { name, span, joule_heat_fraction, .. } in materials {
        let property = joule_heat_fraction.as_ref().ok_or_else(|| JouleHeat::Unsaid(*span, name.clone()))?;
        let not_one = |message: String| JouleHeat::NotOne(property.span, message);
        let share = values_at(property, name, None).map_err(|fault| not_one(fault.message))?[0];
        let keyword = property.keyword;
        if !(0.0..=1.0).contains(&share) {
            return Err(not_one(format!(
                "expected *{keyword} of `{name}` from 0 to 1, found {share:?}: links take no factor between units"
            )));
        }
        let (first, of) = *found.get_or_insert((share, name));
        if first != share {
            return Err(not_one(format!("*{keyword} is {first:?} in `{of}` and {share:?} in `{name}`, in one body")));
        }
    }
    // Every body has elements; an undefined material is a separate fault.
    Ok(JouleHeat::Share(found.map_or(0.0, |(share, _)| share)))
}
