//! R001: interactions that are named and not defined.

use crate::quantity::and_more;
use crate::references::{Definitions, missing, suggestion, uses_of_interactions};
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::model::Name;

declare_rule! {
    /// A contact pair, a property assignment or a *CHANGE FRICTION names an interaction that the deck does not define.
    ///
    /// Nothing is reported when the deck includes files that could not be read: the interaction may be defined there.
    ///
    /// ## Why
    /// Abaqus stops: it does not know the properties of the contact.
    ///
    /// ## What to do
    /// Correct the name, or define the interaction by *SURFACE INTERACTION.
    /// Case and blanks carry no meaning in names without quotes.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=BUSBAR
    /// 1.,
    /// *CONTACT PAIR, INTERACTION=BUSBARS
    /// BAR-1, BAR-2
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=BUSBAR
    /// 1.,
    /// *CONTACT PAIR, INTERACTION=Bus Bar
    /// BAR-1, BAR-2
    /// ```
    "R001", "undefined-interaction", Error, fix: None, source: "C-02, C-05, C-06, S-40"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let uses = uses_of_interactions(context);
    // A *SURFACE INTERACTION without a name (K006) may be the one that is meant.
    let is_nameless = |name: &Name| name.canonical().is_empty();
    if uses.is_empty()
        || context.has_unread_files()
        || context.model.all_interactions().any(|interaction| is_nameless(&interaction.name))
    {
        return;
    }
    let definitions = Definitions::interactions(context);
    for (index, (first, more)) in missing(&uses, &definitions).into_iter().enumerate() {
        let message = format!("interaction `{}` is not defined", first.name);
        let found = report.at(first.span, message);
        let more = and_more(more, "place names it", "places name it");
        found.label(format!("named by `*{}`", first.keyword));
        found.note(format!("every interaction that is named must be defined by `*SURFACE INTERACTION`{more}"));
        let define = || format!("define it: `*SURFACE INTERACTION, NAME={}`", first.name);
        found.help(suggestion(&definitions, &first.name, index).unwrap_or_else(define));
    }
}
