//! Rules: their input, and how they report.

use crate::lost::LostLine;
use inpact_diagnostics::{Diagnostic, Label, Rule};
use inpact_parser::Problem;
use inpact_parser::deck::{Block, DataLine, Deck, IncludeOutcome, KeywordLine, Parameter};
use inpact_parser::expression::substitute;
use inpact_parser::grammar::{Definition, Dialect, Grammar};
use inpact_parser::model::{Model, Name, OptionKind, Table, TableKind, TableOf};
use inpact_parser::span::Span;
use std::cell::OnceCell;
use std::collections::HashSet;

/// The maximum number of findings of one rule in one deck; more are only counted.
const MAX_OF_ONE_RULE: usize = 1000;

/// The check function of a rule.
pub(crate) type Check = fn(&Context<'_>, &mut Report<'_>);

/// Declares the rule of a file: its doc comment becomes the rule's page.
macro_rules! declare_rule {
    ($(#[doc = $line:literal])+ $code:literal, $name:literal, $severity:ident, fix: $fix:ident, source: $source:literal) => {
        $(#[doc = $line])+
        pub(crate) static RULE: inpact_diagnostics::Rule = inpact_diagnostics::Rule {
            code: $code,
            name: $name,
            severity: inpact_diagnostics::Severity::$severity,
            fix: inpact_diagnostics::FixKind::$fix,
            source: $source,
            documentation: concat!($($line, "\n"),+),
        };

        pub(crate) const CHECK: $crate::rule::Check = check;
    };
}
pub(crate) use declare_rule;

/// The input of rules.
#[derive(Debug)]
pub(crate) struct Context<'a> {
    /// The deck.
    pub(crate) deck: &'a Deck,
    /// The keyword language.
    pub(crate) grammar: &'a Grammar,
    /// The typed model.
    pub(crate) model: &'a Model,
    /// The problems that the reader found.
    pub(crate) problems: &'a [Problem],
    /// The view factors of every *GAP RADIATION.
    pub(crate) radiation: Vec<Table>,
    /// The rows that match keyword lines exactly (S021).
    pub(crate) lost_lines: Vec<LostLine<'a>>,
    /// The keyword lines of tables whose rows do not match their columns.
    pub(crate) misread: OnceCell<HashSet<Span>>,
}

/// A block whose keyword the grammar defines.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DefinedBlock<'a> {
    /// The block.
    pub(crate) block: &'a Block,
    /// Its keyword line.
    pub(crate) keyword: &'a KeywordLine,
    /// The keyword in full.
    pub(crate) name: &'a str,
    /// Its definition in the grammar.
    pub(crate) definition: &'a Definition,
}

impl DefinedBlock<'_> {
    /// The kind of the option of an interaction that it is.
    pub(crate) fn kind(self) -> OptionKind {
        OptionKind::of(self.name)
    }
}

impl<'a> Context<'a> {
    /// Every table of the model, including those without effect, and the view factors of *GAP RADIATION.
    pub(crate) fn tables(&self) -> impl Iterator<Item = TableOf<'_>> {
        let keyword = OptionKind::GapRadiation.keyword();
        let of = move |table| TableOf { kind: TableKind::ViewFactor, keyword, interaction: None, table };
        self.model.tables().chain(self.radiation.iter().map(of))
    }

    /// The keyword lines of the deck.
    pub(crate) fn keyword_lines(&self) -> impl Iterator<Item = &'a KeywordLine> {
        self.deck.blocks().iter().filter_map(|block| block.keyword.as_ref())
    }

    /// The blocks whose keyword the grammar defines.
    pub(crate) fn defined_blocks(&self) -> impl Iterator<Item = DefinedBlock<'a>> {
        let grammar = self.grammar;
        self.deck.blocks().iter().filter_map(move |block| defined(grammar, block))
    }

    /// A block with its definition, where the grammar has one.
    pub(crate) fn defined(&self, block: &'a Block) -> Option<DefinedBlock<'a>> {
        defined(self.grammar, block)
    }

    /// Whether the deck is for CalculiX, and judged as ccx reads it (semantics, section 12).
    pub(crate) fn is_for_calculix(&self) -> bool {
        self.grammar.dialect() == Dialect::Calculix
    }

    /// The text of a span for a message.
    pub(crate) fn shown(&self, span: Span) -> String {
        shorten(&self.deck.shown(span))
    }

    /// The text of a value or an item with every `<parameter>` in it replaced (S-62); one without a value is unchanged.
    pub(crate) fn value(&self, span: Span) -> String {
        let text = self.deck.shown(span);
        match substitute(&text, &self.model.parameters) {
            Ok(replaced) => replaced.trim().to_owned(),
            Err(_) => text,
        }
    }

    /// The name that a value or an item is in the dialect of the deck.
    pub(crate) fn name(&self, span: Span) -> Name {
        Name::in_dialect(&self.value(span), self.grammar.dialect())
    }

    /// The span of cell `column` of row `row` of a table, found again in the deck's text; the row's span when it is not there.
    pub(crate) fn cell(&self, of: TableOf<'_>, row: usize, column: usize) -> Span {
        let row_span = of.table.row_span(row);
        let mut lines = self.deck.data_lines_in(row_span).filter(|line| !line.is_blank());
        let (first_line, following) = self.items_on_lines(of);
        let (Some(first), second) = (lines.next(), lines.next()) else { return row_span };
        let found = match (column.checked_sub(first_line), second) {
            // A row on one line that should span several (K-53) has all its items there.
            (None, _) | (_, None) => first.items().nth(column),
            (Some(offset), Some(second)) => {
                let mut further = std::iter::once(second).chain(lines);
                further.nth(offset / following).and_then(|line| line.items().nth(offset % following))
            }
        };
        found.unwrap_or(row_span)
    }

    /// The number of items on the first line of a row and on every further one (K-52).
    fn items_on_lines(&self, of: TableOf<'_>) -> (usize, usize) {
        let width = of.table.width();
        let definition = self.grammar.id_of(of.keyword).and_then(|id| self.grammar.keyword(id).definition());
        let counted = definition.and_then(|definition| definition.data.counted.as_ref());
        counted.map_or((width, width), |counted| {
            let lead = width - of.table.dependencies().min(width);
            (lead + counted.first_line, counted.following)
        })
    }

    /// Whether the deck includes files that were not read: they may define any name.
    pub(crate) fn has_unread_files(&self) -> bool {
        let included = self.defined_blocks().filter(|block| block.name == "INCLUDE").count();
        let read = self.deck.includes().iter().filter(|include| matches!(include.outcome, IncludeOutcome::Read(_)));
        included > read.count()
    }

    /// The span without blanks and line ends around it, for labels.
    pub(crate) fn trimmed(&self, span: Span) -> Span {
        trimmed(self.deck, span)
    }

    /// The data lines of a block that are not blank.
    pub(crate) fn rows(&self, block: DefinedBlock<'a>) -> impl Iterator<Item = DataLine<'a>> {
        self.deck.data_lines(block.block).filter(|line| !line.is_blank())
    }

    /// The values of a parameter on a keyword line, whether or not the keyword has one of that name; abbreviations are other names.
    pub(crate) fn values_of(&self, line: &KeywordLine, name: &[u8]) -> impl Iterator<Item = Span> {
        let is_meant = |given: &Parameter| self.deck.text(given.name).eq_ignore_ascii_case(name);
        line.parameters().filter(is_meant).filter_map(|given| given.value)
    }
}

fn defined<'a>(grammar: &'a Grammar, block: &'a Block) -> Option<DefinedBlock<'a>> {
    let keyword = block.keyword.as_ref()?;
    let entry = grammar.keyword(keyword.id()?);
    Some(DefinedBlock { block, keyword, name: &entry.name, definition: entry.definition()? })
}

/// Shortens a text for a message; a line end becomes a blank, any other control character a `?`.
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

/// Collects the findings of one rule.
#[derive(Debug)]
pub(crate) struct Report<'a> {
    rule: &'static Rule,
    diagnostics: &'a mut Vec<Diagnostic>,
    reported: usize,
    most: usize,
    /// Counts findings beyond `most`.
    overflow: Option<Box<Diagnostic>>,
}

impl<'a> Report<'a> {
    pub(crate) fn new(rule: &'static Rule, diagnostics: &'a mut Vec<Diagnostic>) -> Self {
        Self { rule, diagnostics, reported: 0, most: MAX_OF_ONE_RULE, overflow: None }
    }

    /// Keeps every finding, for fixing instead of showing.
    pub(crate) fn without_limit(rule: &'static Rule, diagnostics: &'a mut Vec<Diagnostic>) -> Self {
        Self { most: usize::MAX, ..Self::new(rule, diagnostics) }
    }

    /// Reports a finding at `span`; labels, help and fix are added to the returned value.
    pub(crate) fn at(&mut self, span: Span, message: impl Into<String>) -> &mut Diagnostic {
        let diagnostic = Diagnostic::new(self.rule, message, Label::new(span, ""));
        self.reported += 1;
        if self.reported > self.most {
            return self.overflow.insert(Box::new(diagnostic));
        }
        self.diagnostics.push(diagnostic);
        let last = self.diagnostics.len() - 1;
        &mut self.diagnostics[last]
    }

    /// Whether further findings are only counted: a costly suggestion would not be shown.
    pub(crate) fn is_full(&self) -> bool {
        self.reported >= self.most
    }

    /// Notes on the last finding shown the number of further ones.
    pub(crate) fn finish(self) {
        let Some(hidden) = self.reported.checked_sub(self.most).filter(|hidden| *hidden > 0) else { return };
        if let Some(last) = self.diagnostics.last_mut() {
            last.note(format!("{hidden} more findings of this rule in this deck are not shown"));
        }
    }
}

/// The span without blanks and line ends around it.
pub(crate) fn trimmed(deck: &Deck, span: Span) -> Span {
    let text = deck.text(span);
    let start = span.start() + (text.len() - text.trim_ascii_start().len()) as u64;
    Span::new(span.source(), start, start + text.trim_ascii().len() as u64)
}
