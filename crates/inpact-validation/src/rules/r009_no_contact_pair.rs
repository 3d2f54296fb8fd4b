//! R009: interactions in decks for CalculiX without any contact pair.

use crate::assembly::has_mesh;
use crate::rule::{Context, Report, declare_rule};

declare_rule! {
    /// A deck for CalculiX has a mesh, steps and an interaction, and no *CONTACT PAIR.
    ///
    /// Reported only in decks that are complete: fragments without nodes or steps are meant to be included.
    ///
    /// ## Why
    /// Without a contact pair there is no contact: CalculiX runs to its end, and no heat flows from one surface to the other.
    /// It passes over a keyword that it does not know, a misspelt *CONTACT PAIR among them, with a warning.
    ///
    /// ## What to do
    /// Define the pair, or correct its keyword.
    ///
    /// ```inp,expect,calculix
    /// *NODE, NSET=ALL
    /// 1, 0., 0., 0.
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
    /// *STEP
    /// *STATIC
    /// *END STEP
    /// ```
    ///
    /// ```inp,calculix
    /// *NODE, NSET=ALL
    /// 1, 0., 0., 0.
    /// *SURFACE, NAME=BAR-1
    /// BAR-ELEMENTS, S1
    /// *SURFACE, NAME=BAR-2
    /// LUG-ELEMENTS, S2
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
    /// *CONTACT PAIR, INTERACTION=JOINT, TYPE=SURFACE TO SURFACE
    /// BAR-1, BAR-2
    /// *STEP
    /// *STATIC
    /// *END STEP
    /// ```
    "R009", "no-contact-pair", Warning, fix: None, source: "measured with CalculiX ccx 2.20"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let model = context.model;
    if !context.is_for_calculix() || !model.contact_pairs.is_empty() || context.has_unread_files() {
        return;
    }
    let has_step = context.defined_blocks().any(|block| block.name == "STEP");
    if !has_step || !has_mesh(context) {
        return;
    }
    // An unknown keyword that names an interaction was likely meant to be the pair.
    let meant = context.keyword_lines().filter(|line| line.id().is_none()).find(|line| {
        line.parameters().any(|parameter| context.deck.text(parameter.name).eq_ignore_ascii_case(b"INTERACTION"))
    });
    for interaction in model.interactions.values() {
        let found = report
            .at(interaction.span, format!("the deck has no contact pair, so that `{}` has no effect", interaction.name))
            .label("CalculiX has no contact here, and no heat flows")
            .note("interactions act through `*CONTACT PAIR` alone");
        match meant {
            Some(line) => {
                found.also(context.trimmed(line.span), "CalculiX passes over this keyword").help("write `*CONTACT PAIR` there");
            }
            None => {
                found.help(format!("define the pair: `*CONTACT PAIR, INTERACTION={}, TYPE=SURFACE TO SURFACE`", interaction.name));
            }
        }
    }
}
