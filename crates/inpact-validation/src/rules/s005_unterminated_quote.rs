//! S005: quotes that do not close.

use crate::rule::{Context, Report, declare_rule};
use inpact_parser::deck::RowsKept;
use inpact_parser::grammar::RowShape;
use inpact_parser::span::Span;

declare_rule! {
    /// A quote opens and does not close before the line ends.
    ///
    /// ## Why
    /// Everything after the quote becomes part of the name, commas and parameters too.
    /// A quoted name cannot hold a quote itself.
    ///
    /// ## What to do
    /// Close the quote, or take it away.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME="Lid to can
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME="Lid to can"
    /// ```
    "S005", "unterminated-quote", Error, fix: None, source: "S-41"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    // For CalculiX a quote is a letter, but around the name of a file (CX-02).
    if context.is_for_calculix() {
        let includes = context.defined_blocks().filter(|block| block.name == "INCLUDE");
        return includes.filter_map(|block| block.keyword.unterminated_quote()).for_each(|quote| say(quote, report));
    }
    for keyword in context.keyword_lines() {
        if let Some(quote) = keyword.unterminated_quote() {
            say(quote, report);
        }
    }
    for block in context.defined_blocks() {
        let is_interpreted =
            !matches!(block.definition.rows(), RowShape::None | RowShape::Text | RowShape::Uninterpreted)
                // The rows of a table in order are numbers.
                && block.block.rows_kept != RowsKept::Ends;
        // Almost no table has a quote, and then no line is cut.
        let mut rows = block.block.all_rows();
        if !is_interpreted || !rows.any(|rows| context.deck.text(rows).contains(&b'"')) {
            continue;
        }
        for line in context.deck.data_lines(block.block) {
            if let Some(at) = open_quote(line.text) {
                let start = line.span.start() + at as u64;
                say(Span::new(line.span.source(), start, start + 1), report);
            }
        }
    }
}

/// The offset of the quote that does not close.
pub(super) fn open_quote(text: &[u8]) -> Option<usize> {
    let is_open = text.iter().fold(false, |open, byte| open ^ (*byte == b'"'));
    if is_open { text.iter().rposition(|byte| *byte == b'"') } else { None }
}

fn say(quote: Span, report: &mut Report<'_>) {
    report
        .at(quote, "a quote opens and does not close")
        .label("opens here")
        .note("everything up to the end of the line is taken for the quoted text")
        .help("close the quote on the same line, or take it away");
}
