//! K016: parameters that must not occur beside one another.

use crate::parameter::{given_once, is_borrowed};
use crate::rule::{Context, Report, declare_rule};

declare_rule! {
    /// Two parameters of a keyword line exclude each other.
    ///
    /// ## Why
    /// Each means something else, as ROUGH (no slip at all) and SLIP TOLERANCE (a little) do; Abaqus refuses the line.
    ///
    /// ## What to do
    /// Take one of the two away.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A
    /// *FRICTION, ROUGH, SLIP TOLERANCE=0.005
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=A
    /// *FRICTION, ROUGH
    /// ```
    /// Options can be excluded as well: a user subroutine gives the pressure and the friction of an interaction.
    ///
    /// ```inp,expect
    /// ** inpact: ignore C002 -- UINTER is in weld.f
    /// *SURFACE INTERACTION, NAME=WELD, USER
    /// 1.,
    /// *SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
    /// ```
    "K016", "conflicting-parameters", Error, fix: None, source: "K-05, S-17"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    check_options(context, report);
    for block in context.defined_blocks().filter(|block| !is_borrowed(context, *block)) {
        // Each finding is about a parameter and an earlier one, so that a pair is found once.
        let given = given_once(block);
        for (place, later) in given.iter().enumerate() {
            let excluded = given[..place].iter().find(|earlier| {
                later.definition.excludes.contains(&earlier.definition.name)
                    || earlier.definition.excludes.contains(&later.definition.name)
            });
            let Some(earlier) = excluded else { continue };
            let (name, other) = (&later.definition.name, &earlier.definition.name);
            report
                .at(later.parameter.span(), format!("`{name}` and `{other}` of `*{}` exclude each other", block.name))
                .label(format!("conflicts with `{other}`"))
                .also(earlier.parameter.span(), format!("`{other}` is here"))
                .note(format!("`{name}`: {}", later.definition.description))
                .help("take one of them away");
        }
    }
}

/// Options in the block of an interaction that one of its parameters excludes (K-05).
fn check_options(context: &Context<'_>, report: &mut Report<'_>) {
    let definition = context.grammar.id_of("SURFACE INTERACTION").and_then(|id| context.grammar.keyword(id).definition());
    let Some(definition) = definition else { return };
    for interaction in context.model.all_interactions() {
        for given in &interaction.parameters {
            let Some(known) = definition.parameter(&given.name) else { continue };
            for option in interaction.other.iter().filter(|option| known.excludes_options.iter().any(|excluded| option.keyword == **excluded)) {
                let (keyword, name) = (&option.keyword, &given.name);
                report
                    .at(option.span, format!("`*{keyword}` conflicts with `{name}` of its interaction"))
                    .label(format!("excluded by `{name}`"))
                    .also(given.span, format!("`{name}` is here"))
                    .note(format!("`{name}`: {}", known.description))
                    .help(format!("take `*{keyword}` out, or `{name}`"));
            }
        }
    }
}
