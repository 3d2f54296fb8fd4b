//! R002: interactions that nothing uses.

use crate::references::{Definitions, Found, Use, missing, uses_of_interactions};
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::model::Name;

declare_rule! {
    /// No contact pair and no property assignment names the interaction.
    ///
    /// Reported only in decks that have contact pairs or property assignments, and that are complete.
    ///
    /// ## Why
    /// Such an interaction has no effect.
    /// That is legal, but often the sign of a contact pair that names another one by mistake.
    ///
    /// ## What to do
    /// Nothing, or take the interaction out.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=BUSBAR
    /// 1.,
    /// *SURFACE INTERACTION, NAME=CONNECTOR
    /// 1.,
    /// *CONTACT PAIR, INTERACTION=BUSBAR
    /// BAR-1, BAR-2
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=BUSBAR
    /// 1.,
    /// *SURFACE INTERACTION, NAME=CONNECTOR
    /// 1.,
    /// *CONTACT PAIR, INTERACTION=BUSBAR
    /// BAR-1, BAR-2
    /// *CONTACT PROPERTY ASSIGNMENT
    /// , , CONNECTOR
    /// ```
    "R002", "unused-interaction", Note, fix: None, source: "C-08"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let model = context.model;
    let has_users = !model.contact_pairs.is_empty() || !model.property_assignments.is_empty();
    if !has_users || context.has_unread_files() {
        return;
    }
    let uses = all_uses(context);
    // A wrong or missing name (R001, R005) makes the intended interaction seem unused.
    let definitions = Definitions::interactions(context);
    let is_open = |used: &Use| used.is_unclear();
    if uses.iter().any(is_open)
        || !missing(&uses, &definitions).is_empty()
        || model.contact_pairs.iter().any(|pair| pair.interaction.is_none())
    {
        return;
    }
    let used = uses.iter().map(|used| match definitions.find(&used.name) {
        Found::QuotedOtherwise(name, _) => name,
        Found::Defined | Found::Missing => &used.name,
    });
    let used: std::collections::HashSet<&Name> = used.collect();
    for interaction in model.interactions.values() {
        if interaction.name.canonical().is_empty() || used.contains(&interaction.name) {
            continue;
        }
        report
            .at(interaction.span, format!("interaction `{}` is not used", interaction.name))
            .label("no contact pair and no property assignment names it")
            .note("an interaction that nothing names has no effect");
    }
}

/// The uses of interactions that every keyword may have: a parameter INTERACTION is taken for one anywhere.
fn all_uses(context: &Context<'_>) -> Vec<Use> {
    let mut uses = uses_of_interactions(context);
    for keyword in context.keyword_lines() {
        // *CONTACT PAIR is among the uses already; twice does no harm.
        let values = context.values_of(keyword, b"INTERACTION");
        uses.extend(values.map(|span| Use { name: context.name(span), span, keyword: "" }));
    }
    uses
}
