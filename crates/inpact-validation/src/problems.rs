//! The reader's problems by block: a fault shared by all rows of a block is one finding.

use crate::rule::{Context, DefinedBlock};
use crate::tables::columns_are_unclear;
use inpact_parser::span::Span;
use inpact_parser::{Problem, ProblemKind};

/// The first problem of a kind in a block.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FirstOfBlock<'a> {
    /// The problem.
    pub(crate) problem: &'a Problem,
    /// Its place in the list of problems.
    pub(crate) index: usize,
    /// The number of further ones of the kind in the block.
    pub(crate) more: usize,
    /// The block, when the grammar defines its keyword.
    pub(crate) block: Option<DefinedBlock<'a>>,
}

/// The blocks with problems of a kind: the first problem of each, and how many there are.
///
/// The reader lists the problems block by block.
pub(crate) fn first_of_each_block<'a>(
    context: &Context<'a>,
    is_meant: impl Fn(&ProblemKind) -> bool,
) -> Vec<FirstOfBlock<'a>> {
    let mut found: Vec<FirstOfBlock<'a>> = Vec::new();
    for (index, problem) in context.problems.iter().enumerate().filter(|(_, problem)| is_meant(&problem.kind)) {
        match found.last_mut() {
            Some(last) if last.problem.keyword == problem.keyword => last.more += 1,
            _ => found.push(FirstOfBlock { problem, index, more: 0, block: None }),
        }
    }
    if !found.is_empty() {
        let blocks = BlocksByKeyword::of(context);
        for first in &mut found {
            first.block = blocks.get(first.problem.keyword);
        }
    }
    found
}

/// Those whose keyword line determines the columns: otherwise the line has a finding of its own.
pub(crate) fn of_clear_columns<'a>(
    context: &'a Context<'_>,
    found: Vec<FirstOfBlock<'a>>,
) -> impl Iterator<Item = FirstOfBlock<'a>> {
    found.into_iter().filter(|first| first.block.is_none_or(|block| !columns_are_unclear(context, block)))
}

/// The defined blocks by their keyword lines: a number for each block of the deck, which may have more blocks than anything else.
pub(crate) struct BlocksByKeyword<'a, 'c> {
    context: &'c Context<'a>,
    /// Numbers of blocks, by where these begin.
    order: Vec<u32>,
}

impl<'a, 'c> BlocksByKeyword<'a, 'c> {
    pub(crate) fn of(context: &'c Context<'a>) -> Self {
        let blocks = context.deck.blocks();
        let mut order: Vec<u32> = (0..).take(blocks.len()).collect();
        order.sort_unstable_by_key(|number| blocks[*number as usize].span_of_keyword());
        Self { context, order }
    }

    /// The block of a keyword line, where the grammar defines its keyword.
    pub(crate) fn get(&self, keyword: Span) -> Option<DefinedBlock<'a>> {
        let blocks = self.context.deck.blocks();
        let found =
            self.order.binary_search_by_key(&keyword, |number| blocks[*number as usize].span_of_keyword()).ok()?;
        self.context.defined(&blocks[self.order[found] as usize])
    }
}

/// Whether the problem is a misplaced row.
pub(crate) fn has_no_place(kind: &ProblemKind) -> bool {
    matches!(kind, ProblemKind::SurplusRow | ProblemKind::TooManyItems { allowed: 0, .. })
}
