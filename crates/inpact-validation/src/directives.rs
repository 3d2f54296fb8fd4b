//! Suppression comments: `** inpact: ignore T005, P008 -- reason` silences these rules for the next block.

use crate::rules::RULES;
use inpact_diagnostics::Diagnostic;
use inpact_parser::deck::{Block, Deck};
use inpact_parser::span::Span;

/// An ignore comment.
#[derive(Debug)]
pub(crate) struct Ignore {
    /// The codes it names, and where.
    pub(crate) codes: Vec<IgnoredCode>,
    /// The block it silences; `None` at the end of a file.
    block: Option<Vec<Span>>,
}

/// A code of an ignore comment.
#[derive(Debug)]
pub(crate) struct IgnoredCode {
    /// The code as written.
    pub(crate) code: String,
    /// Its place.
    pub(crate) span: Span,
    /// Whether it silenced anything.
    pub(crate) is_used: bool,
}

/// Directives.
#[derive(Debug)]
pub(crate) enum Directive {
    /// `ignore CODE, …`.
    Ignore(Ignore),
    /// Something else: inpact does not know it.
    Unknown(Span),
}

/// Reads the directives of a deck, in the order of their files.
pub(crate) fn read(deck: &Deck) -> Vec<Directive> {
    if deck.directives().is_empty() {
        return Vec::new();
    }
    let with_keyword = |block: &&Block| block.keyword.is_some();
    let mut blocks: Vec<&Block> = deck.blocks().iter().filter(with_keyword).collect();
    blocks.sort_by_key(|block| (block.rows().source(), block.span_of_keyword().start()));
    let next_block = |span: Span| {
        let next = blocks.partition_point(|block| {
            (block.rows().source(), block.span_of_keyword().start()) < (span.source(), span.start())
        });
        let block = blocks.get(next).filter(|block| block.rows().source() == span.source())?;
        Some(std::iter::once(block.span()).chain(block.continued_in().iter().copied()).collect())
    };
    deck.directives().iter().map(|span| read_one(deck, *span, next_block)).collect()
}

fn read_one(deck: &Deck, span: Span, next_block: impl Fn(Span) -> Option<Vec<Span>>) -> Directive {
    let text = deck.shown(span);
    let Some((_, said)) = text.split_once("inpact:") else { return Directive::Unknown(span) };
    let before_reason = said.split_once("--").map_or(said, |(codes, _)| codes);
    let Some(list) = before_reason.trim_start().strip_prefix("ignore") else { return Directive::Unknown(span) };
    let list_start = text.len() - said.len() + (before_reason.len() - list.len());
    let mut codes = Vec::new();
    let mut from = 0;
    for word in list.split([' ', '\t', ',']) {
        if !word.is_empty() {
            let start = span.start() + (list_start + from) as u64;
            let code = IgnoredCode {
                code: word.to_owned(),
                span: Span::new(span.source(), start, start + word.len() as u64),
                is_used: false,
            };
            codes.push(code);
        }
        from += word.len() + 1;
    }
    if codes.is_empty() {
        Directive::Unknown(span)
    } else {
        Directive::Ignore(Ignore { codes, block: next_block(span) })
    }
}

impl IgnoredCode {
    /// Whether there is a rule of that code.
    pub(crate) fn is_known(&self) -> bool {
        RULES.iter().any(|rule| rule.code == self.code)
    }
}

impl Ignore {
    /// Whether the comment silences a finding; it is then marked as used.
    pub(crate) fn silences(&mut self, found: &Diagnostic) -> bool {
        let span = found.primary.span;
        if !self.block.iter().flatten().any(|part| part.contains(span)) {
            return false;
        }
        match self.codes.iter_mut().find(|code| code.code == found.code) {
            Some(code) => {
                code.is_used = true;
                true
            }
            None => false,
        }
    }
}
