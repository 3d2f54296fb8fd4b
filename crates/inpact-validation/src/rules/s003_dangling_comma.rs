//! S003: commas at the end of keyword lines that nothing continues.

use inpact_diagnostics::{Edit, FixSafety, Severity};
use crate::rule::{Context, Report, declare_rule};
use inpact_parser::grammar::Dialect;
use inpact_parser::span::Span;

declare_rule! {
    /// A keyword line ends in a comma, and the next line does not read as its continuation.
    ///
    /// A continuation has `=` in it, or its fields are flags of the keyword.
    ///
    /// ## Why
    /// A comma at the end of a keyword line says that the next line goes on with its parameters.
    /// Abaqus may take a row of data for parameters; inpact reads the row as data.
    ///
    /// ## What to do
    /// Take the comma away.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=A
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE,
    /// 1.E6, 0.
    /// 3.E7, 1.E7
    /// ```
    ///
    /// ```inp,fixed
    /// *SURFACE INTERACTION, NAME=A
    /// *GAP ELECTRICAL CONDUCTANCE, PRESSURE
    /// 1.E6, 0.
    /// 3.E7, 1.E7
    /// ```
    ///
    /// A comma that the next line answers is fine:
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=A
    /// *CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.1,
    ///  CUTOFF GAP FILL=0.2
    /// ```
    ///
    /// So is one after which a flag may occur, of a keyword whose parameters inpact does not know:
    ///
    /// ```inp
    /// *ELSET, ELSET=LEFT,
    /// GENERATE
    /// 1, 5, 1
    /// ```
    "S003", "dangling-comma", Warning, fix: Safe, source: "S-19"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for keyword in context.keyword_lines() {
        let Some(comma) = keyword.dangling_comma() else { continue };
        if let Some(most) = keyword.length_exhausted() {
            let name = context.shown(keyword.name());
            report
                .at(comma, format!("with the next line the keyword line of `*{name}` has more than {most} bytes"))
                .severity(Severity::Error)
                .label("its parameters end here")
                .note("no keyword line goes on for longer: what follows is read as rows")
                .help("write fewer parameters, each once");
            continue;
        }
        // CalculiX passes over the comma; only what was meant to continue the line is lost (CX-01).
        if context.is_for_calculix() && !is_meant_to_go_on(context, comma) {
            continue;
        }
        // Of several commas all must go: each would dangle in turn.
        let before = context.deck.text(Span::new(comma.source(), keyword.span.start(), comma.start()));
        let word_end = before.iter().rposition(|byte| !matches!(byte, b',' | b' ' | b'\t')).map_or(0, |last| last + 1);
        let first = before[word_end..].iter().position(|byte| *byte == b',').map_or(before.len(), |at| word_end + at);
        let commas = Span::new(comma.source(), keyword.span.start() + first as u64, comma.end());
        let name = context.shown(keyword.name());
        report
            .at(comma, format!("the keyword line of `*{name}` ends in a comma, and nothing continues it"))
            .label("this comma")
            .note(match context.grammar.dialect() {
                Dialect::Abaqus => {
                    "Abaqus may take the next line for parameters; inpact reads it as what it looks like"
                }
                Dialect::Calculix => "CalculiX does not continue keyword lines",
            })
            .help("take the comma away")
            .fix(FixSafety::Safe, "take the comma away", vec![Edit::delete(commas)]);
    }
}

/// Whether the line after the comma reads as parameters.
fn is_meant_to_go_on(context: &Context<'_>, comma: Span) -> bool {
    let blocks = context.deck.blocks().iter();
    let mut of_comma = blocks.filter(|block| block.keyword.as_ref().is_some_and(|keyword| keyword.span.contains(comma)));
    let first = of_comma.next().and_then(|block| context.deck.data_lines(block).find(|line| !line.is_blank()));
    first.is_some_and(|line| line.text.contains(&b'='))
}
