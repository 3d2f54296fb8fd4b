//! T014: long rows written on one line.

use inpact_diagnostics::{Edit, FixSafety};
use crate::problems::first_of_each_block;
use crate::quantity::and_more;
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::{Problem, ProblemKind};
use inpact_parser::span::Span;

declare_rule! {
    /// A row that should go over several lines is on one.
    ///
    /// A line holds at most eight items.
    /// With many field variables a row goes on in the next line, and so for every row of the table.
    ///
    /// ## Why
    /// inpact reads such a row when it has exactly the items of a whole row.
    /// Abaqus may refuse it, or take the next line for its second half.
    ///
    /// ## What to do
    /// Break the rows after the eighth item; the fix does it.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=SWITCH
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=6
    ///  5.E6, 0.,   20., 0., 0.1, 8., 1., 0.5, 3.
    ///  8.E7, 1.E7, 20., 0., 0.1, 8., 1., 0.5, 3.
    /// ```
    ///
    /// ```inp,fixed
    /// *SURFACE INTERACTION, NAME=SWITCH
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE, DEPENDENCIES=6
    ///  5.E6, 0.,   20., 0., 0.1, 8., 1., 0.5
    ///  3.
    ///  8.E7, 1.E7, 20., 0., 0.1, 8., 1., 0.5
    ///  3.
    /// ```
    "T014", "row-on-one-line", Warning, fix: Safe, source: "K-52, K-53"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let is_meant = |kind: &ProblemKind| matches!(kind, ProblemKind::RowOnOneLine { .. });
    for first in first_of_each_block(context, is_meant) {
        let ProblemKind::RowOnOneLine { lines, first: on_first, following } = first.problem.kind else { continue };
        let of_block =
            context.problems[first.index..].iter().take_while(|problem| problem.keyword == first.problem.keyword);
        let edits = of_block.filter(|problem| is_meant(&problem.kind)).map(|problem| breaks(context, problem));
        let more = and_more(first.more, "row of this table does", "rows of this table do");
        let found = report.at(first.problem.span, format!("row is on one line and should go over {lines}"));
        found
            .label(format!("{on_first} items belong on the first line, {following} at most on every further one"))
            .also(context.trimmed(first.problem.keyword), "the option")
            .note(format!("a line holds eight items at most{more}"))
            .help("break the rows");
        // A line that begins with an asterisk is a keyword line, whatever row it was a part of.
        if let Some(edits) = edits.collect::<Option<Vec<_>>>() {
            found.fix(FixSafety::Safe, "break the rows of the table", edits.concat());
        }
    }
}

/// The edits that break a row: a line end in the place of a comma, and the blanks that the row begins with; `None` where
/// a line would begin with what makes it no row.
fn breaks(context: &Context<'_>, problem: &Problem) -> Option<Vec<Edit>> {
    let ProblemKind::RowOnOneLine { first, following, .. } = problem.kind else { return Some(Vec::new()) };
    let items: Vec<Span> =
        context.deck.data_lines_in(problem.span).flat_map(|line| line.items().collect::<Vec<_>>()).collect();
    let line_end = line_end_and_indentation(context, problem.span);
    let starts = (first..items.len()).step_by(following.max(1));
    let edit = |start: usize| {
        let comma = Span::new(problem.span.source(), items[start - 1].end(), items[start].start());
        let begins_row = !context.deck.text(items[start]).starts_with(b"*");
        begins_row.then(|| Edit::new(comma, line_end.clone()))
    };
    starts.filter(|start| *start > 0).map(edit).collect()
}

/// The line end of this part of the deck, and the blanks in front of the row.
fn line_end_and_indentation(context: &Context<'_>, row: Span) -> Vec<u8> {
    let (start, text) = context.deck.surroundings(row);
    let offset = |position: u64| usize::try_from(position.saturating_sub(start)).unwrap_or(text.len()).min(text.len());
    let (before, after) = (&text[..offset(row.start())], &text[offset(row.end())..]);
    let mut line_end = match after.iter().position(|byte| matches!(byte, b'\n' | b'\r')) {
        Some(at) if after[at..].starts_with(b"\r\n") => b"\r\n".to_vec(),
        Some(at) => vec![after[at]],
        None => b"\n".to_vec(),
    };
    let indentation = before.iter().rposition(|byte| !matches!(byte, b' ' | b'\t')).map_or(0, |last| last + 1);
    line_end.extend_from_slice(&before[indentation..]);
    line_end
}
