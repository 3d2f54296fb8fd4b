//! R006: names that are quoted in one place and not in the other.

use inpact_diagnostics::Severity;
use crate::references::{Definitions, Found, Use, uses_of_interactions, uses_of_surfaces};
use crate::rule::{Context, Report, declare_rule};

declare_rule! {
    /// A name is quoted where it is defined and not where it is used, or the other way round.
    ///
    /// ## Why
    /// Quotes keep case and blanks; without them a name is read in upper case and without blanks.
    /// So `"Steel Gap"` and `Steel Gap` are two names.
    /// Abaqus needs the quotes wherever a name that was defined with them is used.
    ///
    /// ## What to do
    /// Write the name in the same way in both places.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME="Steel Gap"
    /// 1.,
    /// *CONTACT PAIR, INTERACTION=Steel Gap
    /// BAR-1, BAR-2
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME="Steel Gap"
    /// 1.,
    /// *CONTACT PAIR, INTERACTION="Steel Gap"
    /// BAR-1, BAR-2
    /// ```
    "R006", "quoted-name-mix", Warning, fix: None, source: "S-41, Q-22"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let interactions = uses_of_interactions(context);
    if !interactions.is_empty() {
        check_uses(context, report, interactions, &Definitions::interactions(context));
    }
    let mut surfaces = uses_of_surfaces(context).peekable();
    if surfaces.peek().is_some() {
        check_uses(context, report, surfaces, &Definitions::surfaces(context));
    }
}

fn check_uses(
    context: &Context<'_>,
    report: &mut Report<'_>,
    uses: impl IntoIterator<Item = Use>,
    definitions: &Definitions,
) {
    for used in uses {
        let Found::QuotedOtherwise(defined, span) = definitions.find(&used.name) else { continue };
        let (here, there) = if used.name.is_quoted() { ("quoted", "unquoted") } else { ("unquoted", "quoted") };
        let found = report
            .at(used.span, format!("`{}` is {here} here and {there} where it is defined", used.name))
            .label(here)
            .also(span, format!("{there}: `{defined}`"))
            .note("quotes keep case and blanks, so that the two are different names")
            .help(format!("write `{defined}` here"));
        if context.is_for_calculix() {
            found.severity(Severity::Error).note("for CalculiX quotes are letters of the name, so that the two are different names");
        }
    }
}
