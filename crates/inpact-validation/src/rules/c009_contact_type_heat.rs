//! C009: heat across contact of a type for which CalculiX does not use the table as it is meant.

use crate::parameter::given_as;
use crate::rule::{Context, DefinedBlock, Report, declare_rule};
use inpact_parser::model::{Interaction, Name, OptionKind};
use inpact_parser::span::Span;
use std::collections::HashMap;

declare_rule! {
    /// A contact pair of a deck for CalculiX that is node-to-surface or massless has a *GAP CONDUCTANCE or a *GAP HEAT GENERATION.
    ///
    /// ## Why
    /// In such contact CalculiX 2.20 takes a conductance from another place of the table than the contact pressure says, and generates no heat of friction.
    /// `eval` gives the heat of face-to-face contact, which is another one.
    ///
    /// ## What to do
    /// Use `TYPE=SURFACE TO SURFACE` where heat matters.
    ///
    /// ```inp,expect,calculix
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
    /// *GAP CONDUCTANCE
    /// 100., 0., 293.
    /// *CONTACT PAIR, INTERACTION=JOINT, TYPE=NODE TO SURFACE
    /// BAR-1, BAR-2
    /// ```
    ///
    /// ```inp,calculix
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
    /// *GAP CONDUCTANCE
    /// 100., 0., 293.
    /// *CONTACT PAIR, INTERACTION=JOINT, TYPE=SURFACE TO SURFACE
    /// BAR-1, BAR-2
    /// ```
    "C009", "contact-type-heat", Warning, fix: None, source: "CX-10, measured with CalculiX ccx 2.20"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    if !context.is_for_calculix() {
        return;
    }
    // The first pair of each interaction whose type is one of these.
    let mut pairs: HashMap<Name, (Span, &str)> = HashMap::new();
    for block in context.defined_blocks().filter(|block| block.name == "CONTACT PAIR") {
        let Some((kind, span)) = kind_of(context, block) else { continue };
        let Some(value) = given_as(block, "INTERACTION").and_then(|given| given.value()) else { continue };
        pairs.entry(context.name(value)).or_insert((span, kind));
    }
    for interaction in context.model.interactions.values() {
        let Some((pair, kind)) = pairs.get(&interaction.name) else { continue };
        for (option, kind_of_option) in heat_options(interaction) {
            let (message, label) = if kind_of_option == OptionKind::GapConductance {
                ("reads the table at another pressure", "the heat of CalculiX is not that of this table")
            } else {
                ("generates no heat", "has no effect")
            };
            report
                .at(option, format!("{kind} contact {message}"))
                .label(label)
                .also(*pair, "the contact pair")
                .note("`inpact eval` gives the heat of face-to-face contact")
                .help("write `TYPE=SURFACE TO SURFACE` in the contact pair");
        }
    }
}

/// The type of a pair where it is one of those that do not conduct as the table says, and where it is given.
fn kind_of(context: &Context<'_>, block: DefinedBlock<'_>) -> Option<(&'static str, Span)> {
    let given = given_as(block, "TYPE")?;
    let kind = match given.definition.choice_named(&given.text(context)?)? {
        "NODE TO SURFACE" => "node-to-surface",
        "MASSLESS" => "massless",
        _ => return None,
    };
    Some((kind, given.parameter.span()))
}

/// The options of an interaction that give heat, with their keywords.
fn heat_options(interaction: &Interaction) -> impl Iterator<Item = (Span, OptionKind)> {
    let conductance = interaction.gap_conductance().into_iter().flat_map(|conductance| conductance.spans);
    let conductance = conductance.map(|span| (span, OptionKind::GapConductance));
    conductance.chain(interaction.gap_heat_generation.iter().map(|heat| (heat.span, OptionKind::GapHeatGeneration)))
}
