//! S004: rows before the first keyword line.

use super::s011_not_a_deck::{Reading, leading_lines, reading};
use crate::rule::{Context, Report, declare_rule};

declare_rule! {
    /// Rows come before the first keyword line of the deck.
    ///
    /// ## Why
    /// A row means something only after the keyword line it belongs to.
    /// inpact keeps these rows and reads nothing from them.
    ///
    /// ## What to do
    /// Put the keyword line before them that they belong to, or turn a remark into a comment with `**`.
    /// A file of rows that is meant for *INCLUDE is fine: check the deck that includes it instead.
    ///
    /// ```inp,expect
    /// 1.E6, 0.
    /// *SURFACE INTERACTION, NAME=A
    /// ```
    ///
    /// ```inp
    /// ** A comment may occur first.
    /// *SURFACE INTERACTION, NAME=A
    /// 1.,
    /// ```
    "S004", "data-before-keyword", Warning, fix: None, source: "S-03, S-30"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let Some(first) = leading_lines(context).next() else { return };
    let is_lost = context.lost_lines.iter().any(|line| line.span == first.span);
    if is_lost || reading(context) == Reading::NoDeck {
        return;
    }
    let found = report.at(first.span, "data before the first keyword line belongs to no option");
    found.label("this is the first such line").note("these lines are kept, and nothing is read from them");
    if context.keyword_lines().next().is_none() {
        found.help("if the file is meant for `*INCLUDE`, check the deck that includes it");
    } else if first.text.contains(&b'*') {
        found.help("if it is a comment, begin it with `**` in the first column");
    } else {
        found.help("put the keyword line before them that they belong to");
    }
}
