//! C004: heat generation in an interaction that a user subroutine gives.

use crate::rule::{Context, Report, declare_rule};
use inpact_parser::model::Interaction;

declare_rule! {
    /// *GAP HEAT GENERATION is in a *SURFACE INTERACTION with `USER`; in a deck for CalculiX, its speed is 0 or absent.
    ///
    /// ## Why
    /// User subroutines UINTER and VUINTER give the whole interaction, its heat included.
    /// Abaqus then generates no heat by itself.
    /// CalculiX multiplies by a relative speed, the third item, and reads 0 where it is absent.
    ///
    /// ## What to do
    /// Take *GAP HEAT GENERATION out and let the subroutine give the heat, or give the interaction without `USER`.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=COATED, USER
    /// *GAP HEAT GENERATION
    /// 1., 0.5
    /// ```
    ///
    /// ```inp,expect,calculix
    /// *SURFACE INTERACTION, NAME=COATED
    /// *SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
    /// *FRICTION
    /// 0.3, 1.E7
    /// *GAP HEAT GENERATION
    /// 1., 0.5
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=COATED
    /// *FRICTION
    /// 0.3,
    /// *GAP HEAT GENERATION
    /// 1., 0.5
    /// ```
    "C004", "heat-generation-disabled", Warning, fix: None, source: "K-05"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for interaction in context.model.all_interactions() {
        if context.is_for_calculix() {
            check_speed(interaction, report);
            continue;
        }
        let user = interaction.parameters.iter().find(|parameter| parameter.name == "USER");
        let (Some(user), Some(heat)) = (user, &interaction.gap_heat_generation) else { continue };
        report
            .at(heat.span, "heat generation is switched off by `USER` of the interaction")
            .label("has no effect")
            .also(user.span, "a user subroutine gives the whole interaction")
            .note("Abaqus generates no heat in an interaction that a user subroutine gives")
            .help("take the option out and let the subroutine give the heat");
    }
}

/// CalculiX reads an absent speed as 0, not as one that it computes (CX-10).
fn check_speed(interaction: &Interaction, report: &mut Report<'_>) {
    let heat = interaction.gap_heat_generation.as_ref().filter(|heat| heat.slip_rate == Some(0.0));
    let Some(heat) = heat else { return };
    report
        .at(heat.row.unwrap_or(heat.span), "heat generation at speed 0: there is no heat")
        .label("the third item is the relative speed, absent it is 0")
        .also(heat.span, "the option")
        .help("give the speed, or `-1.` to have CalculiX compute it");
}
