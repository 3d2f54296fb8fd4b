//! S010: empty lines among the rows of a table.

use inpact_diagnostics::{Edit, FixSafety};
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::deck::KeywordLine;
use inpact_parser::deck::lines::next_line;
use inpact_parser::{Problem, ProblemKind};
use inpact_parser::span::Span;
use std::collections::HashSet;

declare_rule! {
    /// An empty line is among the rows of a table, or after the last of them.
    ///
    /// ## Why
    /// An empty line is no comment.
    /// The manual does not say what it means in a table: a program may skip it, or read a row of zeros.
    /// inpact skips it.
    ///
    /// ## What to do
    /// Take the line away, or turn it into a comment with `**`.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    ///
    /// 3.E7, 1.E7
    /// ```
    ///
    /// ```inp,fixed
    /// *SURFACE INTERACTION, NAME=A
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// 3.E7, 1.E7
    /// ```
    "S010", "blank-row", Warning, fix: Safe, source: "S-08, Q-19"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let ends_in_comma = |keyword: &&KeywordLine| context.deck.text(keyword.span).trim_ascii_end().ends_with(b",");
    let open: HashSet<Span> = context.keyword_lines().filter(ends_in_comma).map(|keyword| keyword.span).collect();
    // After the comma of a keyword line the line that comes up would become its continuation (S-19).
    let holds_off = |problem: &Problem| {
        let keyword = problem.keyword;
        let is_here = open.contains(&keyword) && keyword.source() == problem.span.source();
        let between = Span::new(keyword.source(), keyword.end(), problem.span.start().max(keyword.end()));
        is_here && context.deck.data_lines_in(between).all(|line| line.is_blank())
    };
    for problem in context.problems.iter().filter(|problem| problem.kind == ProblemKind::BlankRow) {
        let line = problem.span;
        // The line end follows the span of the line; the longest is CR LF.
        let after = context.deck.text(Span::new(line.source(), line.end(), line.end() + 2));
        let whole = Span::new(line.source(), line.start(), line.end() + next_line(after, 0) as u64);
        let found = report.at(line, "empty line among the rows of a table");
        found
            .label("skipped")
            .note("an empty line is no comment, and a program may read it as a row of zeros")
            .help("take the line away");
        if !holds_off(problem) {
            found.fix(FixSafety::Safe, "take the empty line away", vec![Edit::delete(whole)]);
        }
    }
}
