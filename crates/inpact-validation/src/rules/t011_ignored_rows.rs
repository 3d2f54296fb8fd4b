//! T011: rows beside USER.

use crate::parameter::given_as;
use crate::quantity::count;
use crate::rule::{Context, Report, declare_rule};

declare_rule! {
    /// An option with `USER` has rows.
    ///
    /// ## Why
    /// The user subroutine gives the law; Abaqus ignores the rows.
    /// Readers of the deck may think that they count.
    ///
    /// ## What to do
    /// Take the rows out, or `USER`.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=WELD
    /// *GAP ELECTRICAL CONDUCTANCE, USER
    /// 1.E6, 0.
    /// 2.E6, 1.E6
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=WELD
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// 2.E6, 1.E6
    /// ```
    "T011", "ignored-rows", Warning, fix: None, source: "Q-25"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for block in context.defined_blocks() {
        let mut ignoring = block.definition.data.ignored_with.iter().filter_map(|name| given_as(block, name));
        let Some(ignoring) = ignoring.next() else { continue };
        let mut rows = context.rows(block);
        let Some(first) = rows.next() else { continue };
        let name = &ignoring.definition.name;
        let message = format!("{} beside `{name}` in `*{}`", count(1 + rows.count(), "row"), block.name);
        report
            .at(context.trimmed(first.span), message)
            .label("ignored")
            .also(ignoring.parameter.span(), "the law comes from a user subroutine")
            .note(format!("Abaqus ignores the rows when `{name}` is given"))
            .help(format!("take the rows or `{name}` out"));
    }
}
