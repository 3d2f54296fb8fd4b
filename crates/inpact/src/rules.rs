//! All rules: those of decks, of their geometry, of node tables, of scenes and of bodies.

use inpact_body::BODY_RULES;
use inpact_contact::GEOMETRY_RULES;
use inpact_diagnostics::{Rule, Severity};
use inpact_evaluation::nodes::DATA_RULES;
use inpact_network::scene::SCENE_RULES;
use inpact_validation::RULES;

/// Every rule, in the order of the codes of decks, of geometry, of node tables, of scenes, of bodies.
pub(crate) fn all() -> impl Iterator<Item = &'static Rule> {
    RULES.iter().chain(GEOMETRY_RULES).chain(DATA_RULES).chain(SCENE_RULES).chain(BODY_RULES).copied()
}

pub(crate) fn of_code(code: &str) -> Option<&'static Rule> {
    all().find(|rule| rule.code == code)
}

/// Whether data with a finding of a rule cannot be evaluated, whatever its configured severity.
pub(crate) fn is_final(rule: &Rule) -> bool {
    let mut of_data = DATA_RULES.iter().chain(SCENE_RULES).chain(BODY_RULES);
    rule.severity == Severity::Error && of_data.any(|of_data| of_data.code == rule.code)
}
