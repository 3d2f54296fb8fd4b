//! K011: parameters that mean nothing beside another.

use crate::parameter::{given_as, given_once};
use crate::rule::{Context, Report, declare_rule};

declare_rule! {
    /// A parameter means nothing, because another one on the same line makes it void.
    ///
    /// With USER, for one, the conductance comes from a user subroutine: PRESSURE and DEPENDENCIES are ignored.
    ///
    /// ## Why
    /// Abaqus accepts the line and ignores the parameter without a word.
    ///
    /// ## What to do
    /// Take one of the two away.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A
    /// *GAP CONDUCTANCE, USER, PRESSURE
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=A
    /// *GAP CONDUCTANCE, PRESSURE
    /// 500., 0.
    /// 5000., 1.E7
    /// ```
    "K011", "ignored-parameter", Warning, fix: None, source: "K-12"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for given in context.defined_blocks().flat_map(given_once) {
        let voiding = given.definition.ignored_with.iter().find_map(|other| given_as(given.block, other));
        let Some(other) = voiding else { continue };
        let (name, other_name) = (&given.definition.name, &other.definition.name);
        report
            .at(given.parameter.span(), format!("`{name}` of `*{}` is ignored beside `{other_name}`", given.block.name))
            .label("ignored")
            .also(other.parameter.span(), format!("`{other_name}` is here"))
            .note(format!("`{other_name}`: {}", other.definition.description))
            .help(format!("take `{name}` away"));
    }
}
