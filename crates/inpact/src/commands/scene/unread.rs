//! Keywords of a deck that a scene ignores.

use inpact_parser::deck::Deck;
use inpact_parser::grammar::Grammar;
use inpact_parser::mesh::MeshNote;

/// Keywords that are converted, or structure the deck, or request output.
const READ: [&str; 64] = [
    "AMPLITUDE",
    "ASSEMBLY",
    "BOUNDARY",
    "CECURRENT",
    "CFLUX",
    "CLEARANCE",
    "CONDUCTIVITY",
    "CONTACT FILE",
    "CONTACT OUTPUT",
    "CONTACT PAIR",
    "CONTACT PERMEABILITY",
    "CONTACT PRINT",
    "CONTACT PROPERTY ASSIGNMENT",
    "CONTROLS",
    "COUPLED TEMPERATURE-DISPLACEMENT",
    "COUPLED THERMAL-ELECTRICAL",
    "DENSITY",
    "DFLUX",
    "DSECURRENT",
    "DSFLUX",
    "EL FILE",
    "EL PRINT",
    "ELECTRICAL CONDUCTIVITY",
    "ELEMENT",
    "ELEMENT OUTPUT",
    "ELSET",
    "END ASSEMBLY",
    "END INSTANCE",
    "END PART",
    "END STEP",
    "FILE FORMAT",
    "FILM",
    "GAP CONDUCTANCE",
    "GAP ELECTRICAL CONDUCTANCE",
    "GAP HEAT GENERATION",
    "GAP RADIATION",
    "GEOSTATIC",
    "HEADING",
    "HEAT TRANSFER",
    "INCLUDE",
    "INITIAL CONDITIONS",
    "INSTANCE",
    "JOULE HEAT FRACTION",
    "MATERIAL",
    "MONITOR",
    "NODE",
    "NODE FILE",
    "NODE OUTPUT",
    "NODE PRINT",
    "NSET",
    "ORIENTATION",
    "OUTPUT",
    "PARAMETER",
    "PART",
    "PHYSICAL CONSTANTS",
    "PREPRINT",
    "RESTART",
    "SFILM",
    "SOILS",
    "SOLID SECTION",
    "SPECIFIC HEAT",
    "STEP",
    "SURFACE",
    "SURFACE INTERACTION",
];

/// Keywords of mechanics: a scene has pressures, shears and slip rates, but not their causes.
const OF_MECHANICS: [&str; 14] = [
    "CLOAD",
    "CONTACT DAMPING",
    "CYCLIC HARDENING",
    "DAMPING",
    "DLOAD",
    "DSLOAD",
    "ELASTIC",
    "EXPANSION",
    "FRICTION",
    "PLASTIC",
    "SURFACE BEHAVIOR",
    "SURFACE SMOOTHING",
    "TRANSFORM",
    "UNCOUPLED TEMPERATURE-DISPLACEMENT",
];

/// The keywords that are neither read nor of mechanics, up to a step.
pub(super) fn unread(deck: &Deck, grammar: &Grammar, last_step: usize) -> Vec<MeshNote> {
    let mut step = 0;
    let mut notes = Vec::new();
    for keyword in deck.blocks().iter().filter_map(|block| block.keyword.as_ref()) {
        let written = deck.shown(keyword.name()).trim().to_ascii_uppercase();
        let name = keyword.id().map_or(written.as_str(), |id| grammar.keyword(id).name.as_str());
        step += usize::from(name == "STEP");
        let is_known = [&READ[..], &OF_MECHANICS[..]].iter().any(|names| names.contains(&name));
        if step <= last_step.max(1) && !is_known {
            notes.push(MeshNote { span: keyword.visible_span(deck), message: format!("*{name} is not taken over") });
        }
    }
    notes
}

#[cfg(test)]
mod tests {
    use super::{OF_MECHANICS, READ};

    #[test]
    fn names_ascend_and_occur_once() {
        for names in [&READ[..], &OF_MECHANICS[..]] {
            assert!(names.windows(2).all(|pair| pair[0] < pair[1]), "{names:?}");
        }
    }
}
