//! Misplaced keywords, in runs: a sub-option belongs where the keyword before it belongs.
//!
//! Shared by the rules on places (K012, K013), so that a misplaced block gives one finding and not one per keyword.

use crate::rule::Context;
use inpact_parser::deck::KeywordLine;
use inpact_parser::span::Span;
use inpact_parser::{Problem, ProblemKind};
use std::collections::HashMap;

/// A keyword at a wrong place, and the sub-options after it that are there because of it.
#[derive(Debug)]
pub(crate) struct Run<'a> {
    /// The first of them.
    pub(crate) first: &'a Problem,
    /// The number of misplaced sub-options after it.
    pub(crate) further: usize,
    /// The last keyword line above that is not a sub-option.
    pub(crate) above: Option<&'a KeywordLine>,
}

impl Run<'_> {
    /// The beginning of a message about it, for the keyword of its first one: `` `*FRICTION` is``.
    pub(crate) fn subject(&self, keyword: &str) -> String {
        match self.further {
            0 => format!("`*{keyword}` is"),
            1 => format!("`*{keyword}` and the sub-option after it are"),
            more => format!("`*{keyword}` and {more} sub-options after it are"),
        }
    }
}

/// The runs of the problems that are meant, in reading order.
pub(crate) fn runs<'a>(context: &Context<'a>, is_meant: impl Fn(&ProblemKind) -> bool) -> Vec<Run<'a>> {
    let meant = context.problems.iter().filter(|problem| is_meant(&problem.kind));
    let problems: HashMap<Span, &Problem> = meant.map(|problem| (problem.keyword, problem)).collect();
    let mut runs: Vec<Run<'a>> = Vec::new();
    if problems.is_empty() {
        return runs;
    }
    // A sub-option would belong to the last run.
    let mut is_open = false;
    let mut above = None;
    for keyword in context.keyword_lines() {
        let name = keyword.id().map(|id| context.grammar.keyword(id).name.as_str());
        let is_sub_option = keyword.id().is_some_and(|id| context.grammar.is_interaction_option(id));
        let stays_open = is_sub_option || matches!(name, None | Some("INCLUDE" | "PARAMETER"));
        match (problems.get(&keyword.span), runs.last_mut()) {
            (Some(_), Some(run)) if is_open && is_sub_option => run.further += 1,
            (Some(first), _) => {
                runs.push(Run { first, further: 0, above });
                is_open = is_sub_option || name == Some("SURFACE INTERACTION");
            }
            (None, _) => is_open &= stays_open,
        }
        if !is_sub_option {
            above = Some(keyword);
        }
    }
    runs
}

/// A keyword line without its line end, for labels.
pub(crate) fn visible(context: &Context<'_>, line: Span) -> Span {
    let length = context.deck.text(line).trim_ascii_end().len() as u64;
    Span::new(line.source(), line.start(), line.start() + length)
}
