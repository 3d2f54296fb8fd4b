//! K005: abbreviated parameters that may mean several.

use crate::parameter::candidates;
use crate::rule::{Context, Report, declare_rule};
use crate::suggestion::alternatives;

declare_rule! {
    /// A parameter is the beginning of several that the keyword has.
    ///
    /// Only keywords whose parameters inpact knows completely are looked at.
    ///
    /// ## Why
    /// A parameter may be cut short as long as what is left begins no other parameter of the keyword.
    /// The parameter cannot be determined, so it is left out.
    ///
    /// ## What to do
    /// Write the parameter in full.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A, P=0.1
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=A, PAD=0.1
    /// ```
    "K005", "ambiguous-parameter", Error, fix: None, source: "S-13, S-16"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for block in context.defined_blocks().filter(|block| block.definition.parameters_complete) {
        for parameter in block.keyword.parameters() {
            let candidates = candidates(context, block, parameter);
            if candidates.is_empty() {
                continue;
            }
            let names = candidates.iter().map(|index| block.definition.parameters[*index].name.as_str());
            let written = context.shown(parameter.name);
            report
                .at(
                    parameter.name,
                    format!("`{written}` may mean {} parameters of `*{}`", candidates.len(), block.name),
                )
                .label("the beginning of several")
                .help(format!("write out which is meant: {}", alternatives(names)));
        }
    }
}
