//! C006: radiation without the physical constants it needs.

use inpact_parser::model::OptionKind;
use crate::parameter::given_as;
use crate::quantity::and_more;
use crate::rule::{Context, DefinedBlock, Report, declare_rule};
use crate::tables::has_unclear_parameters;
use inpact_parser::deck::KeywordLine;
use inpact_parser::grammar::lookup_name;

declare_rule! {
    /// The deck has *GAP RADIATION and lacks the absolute zero or the Stefan-Boltzmann constant.
    ///
    /// Nothing is reported when the deck includes files that could not be read.
    ///
    /// ## Why
    /// Both constants depend on the units of the deck, so they have no default.
    /// Abaqus stops without them.
    ///
    /// ## What to do
    /// Give both on *PHYSICAL CONSTANTS; in SI units and degrees Celsius `ABSOLUTE ZERO=-273.15, STEFAN BOLTZMANN=5.67E-8`.
    ///
    /// ```inp,expect
    /// *PHYSICAL CONSTANTS, ABSOLUTE ZERO=-273.15
    /// *SURFACE INTERACTION, NAME=FURNACE
    /// *GAP RADIATION
    /// 0.8, 0.3
    /// 1., 0.
    /// 0., 0.1
    /// ```
    ///
    /// ```inp
    /// *PHYSICAL CONSTANTS, ABSOLUTE ZERO=-273.15, STEFAN BOLTZMANN=5.67E-8
    /// *SURFACE INTERACTION, NAME=FURNACE
    /// *GAP RADIATION
    /// 0.8, 0.3
    /// 1., 0.
    /// 0., 0.1
    /// ```
    "C006", "radiation-constants-missing", Error, fix: None, source: "2.6, T-42, H-06"
}

/// The constants of radiation.
const CONSTANTS: [&str; 2] = ["ABSOLUTE ZERO", "STEFAN BOLTZMANN"];

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let mut options = context.defined_blocks().filter(|block| block.kind() == OptionKind::GapRadiation);
    let Some(first) = options.next() else { return };
    let missing: Vec<&str> = CONSTANTS.into_iter().filter(|name| !is_given(context, name)).collect();
    if missing.is_empty() || context.has_unread_files() {
        return;
    }
    let names: Vec<String> = missing.iter().map(|name| format!("`{name}`")).collect();
    let more = and_more(options.count(), "option of this deck needs them", "options of this deck need them");
    let found = report
        .at(context.trimmed(first.keyword.span), format!("radiation without {} in the deck", names.join(" and ")));
    found.label("needs both constants");
    if let Some(constants) = context.defined_blocks().find(|block| is_constants(block)) {
        found.also(context.trimmed(constants.keyword.span), "the constants that are given");
    }
    found.note(format!("radiation needs the absolute zero and the Stefan-Boltzmann constant{more}"));
    found.help("give `*PHYSICAL CONSTANTS, ABSOLUTE ZERO=…, STEFAN BOLTZMANN=…` in the units of the deck");
}

fn is_constants(block: &DefinedBlock<'_>) -> bool {
    block.name == "PHYSICAL CONSTANTS"
}

/// Whether a line gives the constant, or leaves open whether it does (K001, K004).
fn is_given(context: &Context<'_>, constant: &str) -> bool {
    let in_options = context
        .defined_blocks()
        .filter(is_constants)
        .any(|block| has_unclear_parameters(block.keyword) || given_as(block, constant).is_some());
    in_options || {
        let unknown = context.keyword_lines().filter(|keyword| keyword.id().is_none());
        let mut parameters = unknown.flat_map(KeywordLine::parameters);
        parameters.any(|parameter| lookup_name(context.deck.text(parameter.name), CONSTANTS).found().is_some())
    }
}
