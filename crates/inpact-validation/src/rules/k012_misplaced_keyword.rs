//! K012: sub-options outside the block they belong to.

use crate::placement::{runs, visible};
use super::k002_ambiguous_keyword::candidates;
use crate::rule::{Context, Report, declare_rule};
use crate::suggestion::alternatives;
use inpact_parser::ProblemKind;
use inpact_parser::deck::{KeywordLine, Resolved};

declare_rule! {
    /// A sub-option is where no *SURFACE INTERACTION is open.
    ///
    /// The block of a *SURFACE INTERACTION ends at the first keyword that is none of its sub-options.
    ///
    /// ## Why
    /// A sub-option belongs to the contact property whose block it is in.
    /// Outside of one it belongs to none; Abaqus refuses it.
    ///
    /// ## What to do
    /// Move it, with its rows, after the *SURFACE INTERACTION that it belongs to.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A
    /// 1.,
    /// *HEADING
    /// The block of A ends here
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// 3.E7, 1.E7
    /// ```
    ///
    /// ```inp
    /// *HEADING
    /// The block of A comes after
    /// *SURFACE INTERACTION, NAME=A
    /// 1.,
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// 3.E7, 1.E7
    /// ```
    "K012", "misplaced-keyword", Error, fix: None, source: "S-21"
}

/// For how many blocks it is found out what the line above them may mean, which costs a comparison with every keyword.
const LOOKED_UP: usize = 1000;

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    let misplaced = runs(context, |kind| matches!(kind, ProblemKind::Misplaced { .. }));
    for (number, run) in misplaced.iter().enumerate() {
        let ProblemKind::Misplaced { keyword, closed_by } = run.first.kind else { continue };
        // The line that should open the block has its own finding.
        let is_found_out = number < LOOKED_UP && run.above.is_some_and(|above| may_be_interaction(context, above));
        if is_found_out {
            continue;
        }
        let entry = context.grammar.keyword(keyword);
        let subject = run.subject(&entry.name);
        let found = report.at(run.first.span, format!("{subject} outside a `*SURFACE INTERACTION`"));
        found.help("move it after the `*SURFACE INTERACTION` that it belongs to");
        match closed_by {
            None => found.label("no `*SURFACE INTERACTION` is above"),
            Some(span) => {
                found.label("belongs to no contact property");
                found.also(visible(context, span), "the last `*SURFACE INTERACTION` ends here")
            }
        };
        let parents = entry.definition().map(|definition| &definition.parents[..]).unwrap_or_default();
        let parents: Vec<String> = parents.iter().map(|parent| format!("*{parent}")).collect();
        found.note(format!("it is a sub-option of {}", alternatives(parents.iter().map(String::as_str))));
    }
}

/// Whether an unreadable keyword line is likely meant to be a *SURFACE INTERACTION.
fn may_be_interaction(context: &Context<'_>, keyword: &KeywordLine) -> bool {
    let is_interaction = |name: &str| name == "SURFACE INTERACTION";
    match keyword.resolved {
        Resolved::Exact(_) | Resolved::Abbreviated(_) => false,
        Resolved::Ambiguous => {
            candidates(context, keyword).into_iter().any(|id| is_interaction(&context.grammar.keyword(id).name))
        }
        Resolved::Unknown => {
            let near = context.grammar.nearest_keywords(&context.deck.shown(keyword.name()), 3);
            near.into_iter().any(is_interaction)
        }
    }
}
