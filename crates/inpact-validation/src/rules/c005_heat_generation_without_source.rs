//! C005: heat generation where nothing dissipates energy.

use crate::rule::{Context, Report, declare_rule};
use inpact_parser::model::{Interaction, Name};
use std::collections::HashSet;

declare_rule! {
    /// *GAP HEAT GENERATION is in an interaction without friction and without electrical conductance.
    ///
    /// ## Why
    /// Heat comes from energy that friction or electric current dissipates at the interface.
    /// Without either there is none.
    ///
    /// ## What to do
    /// Give *FRICTION or *GAP ELECTRICAL CONDUCTANCE in the same interaction, or take *GAP HEAT GENERATION out.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=BRAKE
    /// *GAP HEAT GENERATION
    /// 1., 0.5
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=BRAKE
    /// *FRICTION
    /// 0.3,
    /// *GAP HEAT GENERATION
    /// 1., 0.5
    /// ```
    "C005", "heat-generation-without-source", Note, fix: None, source: "C-26, H-01, H-03"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let without: Vec<_> = context.model.all_interactions().filter(|interaction| lacks_source(interaction)).collect();
    // A keyword that nobody knows may be a misspelt *FRICTION (K001), and friction may come in a step.
    let unclear = || context.keyword_lines().any(|keyword| keyword.id().is_none());
    if without.is_empty() || context.has_unread_files() || unclear() {
        return;
    }
    let changed = changed_in_steps(context);
    for interaction in without.into_iter().filter(|interaction| !changed.contains(&interaction.name)) {
        let Some(heat) = &interaction.gap_heat_generation else { continue };
        report
            .at(heat.span, "heat generation without friction or electrical conductance")
            .label("nothing dissipates energy here")
            .also(interaction.span, "the interaction")
            .note("heat comes from the energy that friction or electric current dissipates")
            .help("give `*FRICTION` or `*GAP ELECTRICAL CONDUCTANCE` in the same interaction");
    }
}

fn lacks_source(interaction: &Interaction) -> bool {
    interaction.gap_heat_generation.is_some()
        && interaction.gap_electrical_conductance.is_none()
        && interaction.friction().is_none()
        && !interaction.has_parameter("USER")
}

/// The interactions whose friction *CHANGE FRICTION gives in a step.
fn changed_in_steps(context: &Context<'_>) -> HashSet<Name> {
    let changes = crate::references::uses_of_interactions(context);
    changes.into_iter().filter(|used| used.keyword == "CHANGE FRICTION").map(|used| used.name).collect()
}
