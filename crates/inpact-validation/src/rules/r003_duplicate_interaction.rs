//! R003: interactions of the same name.

use crate::rule::{Context, Report, declare_rule};
use inpact_parser::model::{SetAsideItem, SetAsideReason};

declare_rule! {
    /// Two *SURFACE INTERACTION have the same name.
    ///
    /// Case and blanks carry no meaning in names without quotes.
    ///
    /// ## Why
    /// Both cannot govern, and the manual does not say which one does.
    /// inpact evaluates the last one; in a deck for CalculiX the first, which is what ccx takes.
    ///
    /// ## What to do
    /// Rename one of them, or put their options under one *SURFACE INTERACTION.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=STEEL GAP
    /// *FRICTION
    /// 0.2,
    /// *SURFACE INTERACTION, NAME=SteelGap
    /// *FRICTION
    /// 0.3,
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=STEEL GAP
    /// *FRICTION
    /// 0.2,
    /// *SURFACE INTERACTION, NAME="Steel Gap"
    /// *FRICTION
    /// 0.3,
    /// ```
    "R003", "duplicate-interaction", Error, fix: None, source: "Q-8, K-06, S-40"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for aside in &context.model.set_aside {
        let SetAsideItem::Interaction(interaction) = &aside.item else { continue };
        let (later, earlier, note) = match aside.reason {
            SetAsideReason::ReplacedBy(later) => (later, interaction.span, "both cannot govern; inpact evaluates the last"),
            SetAsideReason::Shadowed { first } => {
                (interaction.span, first, "both cannot govern; CalculiX takes the first for a contact pair")
            }
            SetAsideReason::Misplaced => continue,
        };
        // Interactions without a name are K006.
        if interaction.name.canonical().is_empty() {
            continue;
        }
        report
            .at(later, format!("interaction `{}` is defined twice", interaction.name))
            .label("defined again")
            .also(earlier, "defined here before")
            .note(note)
            .help("rename one of them, or put their options under one `*SURFACE INTERACTION`");
    }
}
