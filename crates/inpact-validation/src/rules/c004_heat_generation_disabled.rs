//! C004: heat generation in an interaction that a user subroutine gives.

use crate::rule::{Context, Report, declare_rule};

declare_rule! {
    /// *GAP HEAT GENERATION stands in a *SURFACE INTERACTION with `USER`.
    ///
    /// ## Why
    /// User subroutines UINTER and VUINTER give the whole interaction, its heat included.
    /// Abaqus then generates no heat by itself.
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
