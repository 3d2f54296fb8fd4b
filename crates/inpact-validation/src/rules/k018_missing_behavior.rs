//! K018: sub-options that CalculiX refuses without a *SURFACE BEHAVIOR.

use crate::rule::{Context, Report, declare_rule};
use inpact_parser::model::{ContactPair, Interaction, OptionKind};
use inpact_parser::span::Span;
use std::collections::HashSet;

declare_rule! {
    /// A *GAP CONDUCTANCE or a contact pair of a deck for CalculiX has no *SURFACE BEHAVIOR to go with.
    ///
    /// ## Why
    /// CalculiX stops at a *GAP CONDUCTANCE that is the first of its interaction, and at a contact pair by penalty whose interaction has no *SURFACE BEHAVIOR.
    /// The order counts: a *SURFACE BEHAVIOR after the *GAP CONDUCTANCE comes too late.
    ///
    /// ## What to do
    /// Give *SURFACE BEHAVIOR as the first option of the interaction.
    ///
    /// ```inp,expect,calculix
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP CONDUCTANCE
    /// 100., 0., 293.
    /// *SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
    /// ```
    ///
    /// ```inp,expect,calculix
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *CONTACT PAIR, INTERACTION=JOINT, TYPE=SURFACE TO SURFACE
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
    "K018", "missing-behavior", Error, fix: None, source: "CX-08, measured with CalculiX ccx 2.20"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    if !context.is_for_calculix() || context.has_unread_files() {
        return;
    }
    let refused = check_order(context, report);
    for pair in context.model.contact_pairs.iter().filter(|pair| is_by_penalty(pair)) {
        let Some(reference) = &pair.interaction else { continue };
        let Some(interaction) = context.model.interactions.get(&reference.name) else { continue };
        if has_behavior(interaction) || refused.contains(&interaction.span) {
            continue;
        }
        report
            .at(reference.span, format!("interaction `{}` has no `*SURFACE BEHAVIOR`", interaction.name))
            .label("CalculiX stops at this contact pair")
            .also(interaction.span, "the interaction")
            .help("give `*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=…` in the interaction");
    }
}

/// Whether the contact is one of springs, which have a stiffness; MORTAR and MASSLESS do without.
fn is_by_penalty(pair: &ContactPair) -> bool {
    let kind = pair.parameters.iter().rfind(|parameter| parameter.name == "TYPE").and_then(|kind| kind.value.as_deref());
    kind.is_some_and(|kind| {
        let kind: String = kind.split_ascii_whitespace().collect::<String>().to_ascii_uppercase();
        kind.starts_with("SURFACETOSURFACE") || kind.starts_with("NODETOSURFACE")
    })
}

fn has_behavior(interaction: &Interaction) -> bool {
    interaction.other.iter().any(|option| option.kind() == OptionKind::SurfaceBehavior)
}

/// Reports the conductances that come first; gives the interactions they are in.
fn check_order(context: &Context<'_>, report: &mut Report<'_>) -> HashSet<Span> {
    let mut refused = HashSet::new();
    let mut interaction = None;
    let mut is_first = true;
    for block in context.defined_blocks() {
        match (block.name, block.kind()) {
            ("SURFACE INTERACTION", _) => {
                interaction = Some(block.keyword.visible_span(context.deck));
                is_first = true;
            }
            // Any of these is enough for ccx here; the pair needs the *SURFACE BEHAVIOR itself.
            (_, OptionKind::SurfaceBehavior | OptionKind::Friction | OptionKind::GapHeatGeneration)
            | ("CONTACT DAMPING", _) => is_first = false,
            (_, OptionKind::GapConductance) if is_first => {
                let Some(interaction) = interaction else { continue };
                refused.insert(interaction);
                report
                    .at(context.trimmed(block.keyword.span), "`*GAP CONDUCTANCE` without `*SURFACE BEHAVIOR` before it")
                    .label("CalculiX stops here")
                    .also(interaction, "the interaction")
                    .help("put `*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=…` before it");
            }
            _ => {}
        }
    }
    refused
}
