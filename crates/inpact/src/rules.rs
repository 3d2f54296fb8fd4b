//! All rules there are: those of decks, of node tables and of scenes.

use inpact_diagnostics::Rule;
use inpact_evaluation::nodes::DATA_RULES;
use inpact_network::scene::SCENE_RULES;
use inpact_validation::rules::RULES;

/// Every rule, in the order of the codes of decks, of node tables, of scenes.
pub(crate) fn all() -> impl Iterator<Item = &'static Rule> {
    RULES.iter().chain(DATA_RULES).chain(SCENE_RULES).copied()
}
