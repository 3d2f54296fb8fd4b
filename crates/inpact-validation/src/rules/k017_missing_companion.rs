//! K017: parameters that need another beside them.

use crate::parameter::{given_once, is_borrowed, may_be_given};
use crate::rule::{Context, Report, declare_rule};

declare_rule! {
    /// A parameter lacks another that it needs.
    ///
    /// DEPVAR, PROPERTIES and UNSYMM of *SURFACE INTERACTION, for three, say something about a user subroutine: they need USER.
    ///
    /// ## Why
    /// The parameter alone means nothing; Abaqus may refuse the line.
    ///
    /// ## What to do
    /// Add the other parameter, or take this one away.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A, UNSYMM
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=A
    /// ```
    "K017", "missing-companion", Error, fix: None, source: "2.1"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let blocks = context.defined_blocks().filter(|block| !is_borrowed(context, *block));
    for given in blocks.flat_map(given_once) {
        let needed = given.definition.needs.iter().find(|needed| !may_be_given(context, given.block, needed));
        let Some(needed) = needed else { continue };
        let (name, keyword) = (&given.definition.name, given.block.name);
        report
            .at(given.parameter.span(), format!("`{name}` of `*{keyword}` needs `{needed}` beside it"))
            .label(format!("`{needed}` is missing"))
            .note(format!("`{name}`: {}", given.definition.description))
            .help(format!("add `{needed}`, or take `{name}` away"));
    }
}
