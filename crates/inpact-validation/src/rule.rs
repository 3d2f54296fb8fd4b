//! What a rule is, what it sees, and how it reports.

use crate::diagnostic::{Diagnostic, Label, Severity};
use inpact_parser::deck::{Block, Deck, KeywordLine};
use inpact_parser::grammar::{Definition, Grammar};
use inpact_parser::model::{Model, TableOf};
use inpact_parser::problem::Problem;
use inpact_parser::span::Span;

/// The most findings of one rule in one deck; more are counted, not shown.
const MOST_OF_ONE_RULE: usize = 1000;

/// A rule of `inpact check`: its metadata, its page and its check.
#[derive(Debug)]
pub struct Rule {
    /// The code: fixed, never used again.
    pub code: &'static str,
    /// The name: fixed.
    pub name: &'static str,
    /// How grave a finding is unless the rule or the configuration says otherwise.
    pub severity: Severity,
    /// Whether findings come with a fix, and of what kind.
    pub fix: FixKind,
    /// Which rule of the semantics it enforces.
    pub source: &'static str,
    /// Its page in Markdown: the doc comment of its file.
    pub documentation: &'static str,
    /// Looks for findings.
    pub check: fn(&Context<'_>, &mut Report<'_>),
}

/// Whether a rule offers fixes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FixKind {
    /// It offers none.
    None,
    /// A fix that changes no meaning: applied by `--fix`.
    Safe,
    /// A fix that changes the meaning: applied only when asked for by code.
    ChangesMeaning,
}

/// Declares the rule of a file: its doc comment becomes the rule's page.
macro_rules! declare_rule {
    ($(#[doc = $line:literal])+ $code:literal, $name:literal, $severity:ident, fix: $fix:ident, source: $source:literal) => {
        $(#[doc = $line])+
        pub static RULE: $crate::rule::Rule = $crate::rule::Rule {
            code: $code,
            name: $name,
            severity: $crate::diagnostic::Severity::$severity,
            fix: $crate::rule::FixKind::$fix,
            source: $source,
            documentation: concat!($($line, "\n"),+),
            check,
        };
    };
}
pub(crate) use declare_rule;

/// What a rule sees.
#[derive(Debug)]
pub struct Context<'a> {
    /// The deck as it stands in its files.
    pub deck: &'a Deck,
    /// The keyword language.
    pub grammar: &'a Grammar,
    /// The typed model.
    pub model: &'a Model,
    /// What the reader met.
    pub problems: &'a [Problem],
    /// Every table of the model, those that govern nothing too.
    pub tables: Vec<TableOf<'a>>,
}

/// A block whose keyword the grammar defines.
#[derive(Debug, Clone, Copy)]
pub struct DefinedBlock<'a> {
    /// The block.
    pub block: &'a Block,
    /// Its keyword line.
    pub keyword: &'a KeywordLine,
    /// The keyword in full.
    pub name: &'a str,
    /// What the grammar says of it.
    pub definition: &'a Definition,
}

impl<'a> Context<'a> {
    /// The keyword lines of the deck.
    pub fn keyword_lines(&self) -> impl Iterator<Item = &'a KeywordLine> {
        self.deck.blocks().iter().filter_map(|block| block.keyword.as_ref())
    }

    /// The blocks whose keyword the grammar defines.
    pub fn defined_blocks(&self) -> impl Iterator<Item = DefinedBlock<'a>> {
        let (deck, grammar) = (self.deck, self.grammar);
        deck.blocks().iter().filter_map(move |block| {
            let keyword = block.keyword.as_ref()?;
            let entry = grammar.keyword(keyword.id()?);
            Some(DefinedBlock { block, keyword, name: &entry.name, definition: entry.definition()? })
        })
    }

    /// The text of a span for a message.
    pub fn shown(&self, span: Span) -> String {
        shorten(&self.deck.shown(span))
    }

    /// The span of cell `column` of row `row` of a table, found again in the deck's text; the row's span when it is not there.
    pub fn cell(&self, of: &TableOf<'_>, row: usize, column: usize) -> Span {
        let row_span = of.table.row_span(row);
        let items = self.deck.data_lines_in(row_span).flat_map(|line| {
            // A trailing comma on a line that the row goes on behind gives no item.
            line.items().collect::<Vec<_>>()
        });
        let mut items: Vec<Span> = items.collect();
        if items.len() > of.table.width() {
            items = self.items_of_a_row_over_lines(row_span);
        }
        items.get(column).copied().unwrap_or(row_span)
    }

    /// The items of a row over several lines, empty ones at the end of a line left out.
    fn items_of_a_row_over_lines(&self, row: Span) -> Vec<Span> {
        let lines = self.deck.data_lines_in(row).map(|line| {
            let mut items: Vec<Span> = line.items().collect();
            while items.last().is_some_and(|item| item.is_empty()) {
                items.pop();
            }
            items
        });
        lines.flatten().collect()
    }
}

/// Shortens what would not fit into a message; a line end becomes a blank, any other control character a `?`.
fn shorten(text: &str) -> String {
    const MOST: usize = 80;
    let printable = |character: char| match character {
        '\t' | '\n' | '\r' => ' ',
        control if control.is_control() => '?',
        other => other,
    };
    let rest = text.chars().nth(MOST).map(|_| '…');
    text.chars().take(MOST).map(printable).chain(rest).collect()
}

/// Takes the findings of one rule.
#[derive(Debug)]
pub struct Report<'a> {
    rule: &'static Rule,
    diagnostics: &'a mut Vec<Diagnostic>,
    reported: usize,
    /// Takes what goes beyond [`MOST_OF_ONE_RULE`].
    overflow: Option<Box<Diagnostic>>,
}

impl<'a> Report<'a> {
    pub(crate) fn new(rule: &'static Rule, diagnostics: &'a mut Vec<Diagnostic>) -> Self {
        Self { rule, diagnostics, reported: 0, overflow: None }
    }

    /// Reports a finding at `span`; what comes back takes labels, help and fix.
    pub fn at(&mut self, span: Span, message: impl Into<String>) -> &mut Diagnostic {
        let diagnostic = Diagnostic {
            code: self.rule.code,
            name: self.rule.name,
            severity: self.rule.severity,
            message: message.into(),
            primary: Label::new(span, ""),
            secondary: Vec::new(),
            note: None,
            help: None,
            fix: None,
        };
        self.reported += 1;
        if self.reported > MOST_OF_ONE_RULE {
            return self.overflow.insert(Box::new(diagnostic));
        }
        self.diagnostics.push(diagnostic);
        let last = self.diagnostics.len() - 1;
        &mut self.diagnostics[last]
    }

    /// Whether further findings are only counted: nobody sees a suggestion that is dear to find.
    pub(crate) fn is_full(&self) -> bool {
        self.reported >= MOST_OF_ONE_RULE
    }

    /// Says on the last finding shown how many were not.
    pub(crate) fn finish(self) {
        let Some(hidden) = self.reported.checked_sub(MOST_OF_ONE_RULE).filter(|hidden| *hidden > 0) else { return };
        if let Some(last) = self.diagnostics.last_mut() {
            last.note(format!("{hidden} more findings of this rule in this deck are not shown"));
        }
    }
}
