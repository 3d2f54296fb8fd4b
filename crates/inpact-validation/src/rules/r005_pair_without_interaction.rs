//! R005: contact pairs that name no interaction.

use crate::parameter::given_as;
use crate::rule::{Context, DefinedBlock, Report, declare_rule};
use crate::tables::has_unclear_parameters;

declare_rule! {
    /// A *CONTACT PAIR of the model data has no `INTERACTION`.
    ///
    /// In a step, where contact pairs are defined in Abaqus/Explicit, it may be left out.
    ///
    /// ## Why
    /// In Abaqus/Standard a contact pair must name its interaction, even if that has no properties of its own.
    ///
    /// ## What to do
    /// Give `INTERACTION=NAME`, and define a *SURFACE INTERACTION of that name.
    ///
    /// ```inp,expect
    /// *CONTACT PAIR, SMALL SLIDING
    /// BAR-1, BAR-2
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=PLAIN
    /// *CONTACT PAIR, INTERACTION=PLAIN, SMALL SLIDING
    /// BAR-1, BAR-2
    /// ```
    "R005", "pair-without-interaction", Error, fix: None, source: "C-02, C-03"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let mut in_step = false;
    for block in context.defined_blocks() {
        match block.name {
            "STEP" => in_step = true,
            "END STEP" => in_step = false,
            "CONTACT PAIR" if (!in_step || context.is_for_calculix()) && !names_interaction(context, block) => {
                report
                    .at(context.trimmed(block.keyword.span), "contact pair without an interaction")
                    .label("`INTERACTION` is missing")
                    .note(if context.is_for_calculix() {
                        "in CalculiX every contact pair names its interaction"
                    } else {
                        "in Abaqus/Standard every contact pair names its interaction"
                    })
                    .help("give `INTERACTION=NAME` with the name of a `*SURFACE INTERACTION`");
            }
            _ => {}
        }
    }
}

/// Whether the line has INTERACTION, or a parameter that may mean it.
fn names_interaction(context: &Context<'_>, block: DefinedBlock<'_>) -> bool {
    if context.is_for_calculix() {
        return given_as(block, "INTERACTION").is_some_and(|given| given.value().is_some());
    }
    has_unclear_parameters(block.keyword) || given_as(block, "INTERACTION").is_some()
}
