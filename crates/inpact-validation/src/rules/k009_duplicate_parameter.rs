//! K009: duplicate parameters on one line.

use crate::parameter::given;
use crate::rule::{Context, Report, declare_rule};

declare_rule! {
    /// A keyword line gives one parameter twice.
    ///
    /// Abbreviations count: `DEP=1, DEPENDENCIES=2` is the same parameter twice.
    ///
    /// ## Why
    /// Abaqus uses one of the two and ignores the other; the manual does not say which.
    /// inpact uses the last.
    ///
    /// ## What to do
    /// Take one of them away.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A, NAME=B
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=A
    /// ```
    "K009", "duplicate-parameter", Error, fix: None, source: "S-18, Q-7"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for block in context.defined_blocks().filter(|block| block.keyword.parameters().len() > 1) {
        // The last place of each parameter, by its index in the definition.
        let mut earlier = vec![None; block.definition.parameters.len()];
        for given in given(block) {
            let Some(index) = given.parameter.index() else { continue };
            let name = &given.definition.name;
            if let Some(first) = earlier[index].replace(given.parameter.span()) {
                // CalculiX takes the first name of an interaction (surfaceinteractions.f), of all else the last.
                let first_counts = context.is_for_calculix() && (block.name, name.as_str()) == ("SURFACE INTERACTION", "NAME");
                let [label, before] =
                    if first_counts { ["passed over", "this one is used"] } else { ["this one is used here", "given before"] };
                report
                    .at(given.parameter.span(), format!("`{name}` of `*{}` is given twice", block.name))
                    .label(label)
                    .also(first, before)
                    .note(if context.is_for_calculix() {
                        "CalculiX takes the last of several values that it knows, of NAME the first"
                    } else {
                        "Abaqus ignores one of the two, and the manual does not say which"
                    })
                    .help("take one of them away");
            }
        }
    }
}
