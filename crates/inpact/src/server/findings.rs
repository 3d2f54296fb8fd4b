//! Findings as LSP diagnostics.

use super::analysis::{Analysis, Fault};
use super::workspace::{View, Workspace};
use gen_lsp_types::{
    CodeDescription, Diagnostic, DiagnosticRelatedInformation, DiagnosticSeverity, DiagnosticTag, Location, Position,
    Range, Uri,
};
use inpact_diagnostics::{self as found, Severity};
use inpact_parser::span::{SourceId, Span};
use std::collections::BTreeMap;

/// Rules whose findings concern text without effect.
const WITHOUT_EFFECT: [&str; 5] = ["R002", "C001", "K011", "T011", "S018"];

/// Findings in every file, by its URI, with the version of the document; including documents without findings.
pub(super) fn by_file(workspace: &Workspace) -> BTreeMap<String, (Option<i32>, Vec<Diagnostic>)> {
    let mut files: BTreeMap<String, (Option<i32>, Vec<Diagnostic>)> = BTreeMap::new();
    for analysis in workspace.analyses() {
        for place in analysis.places() {
            if let Some(version) = workspace.version(place) {
                files.entry(workspace.uri(place).0).or_default().0 = Some(version);
            }
        }
        for finding in &analysis.findings {
            let view = View { workspace, analysis, source: finding.primary.span.source() };
            let place = analysis.place(view.source);
            let entry = files.entry(workspace.uri(place).0).or_default();
            let diagnostic = diagnostic(view, finding);
            merge(&mut entry.1, diagnostic);
        }
    }
    for Fault { place, message } in workspace.faults() {
        let entry = files.entry(workspace.uri(place).0).or_default();
        let diagnostic = of_configuration(message);
        merge(&mut entry.1, diagnostic);
    }
    files
}

/// Adds a finding; one in a file that two decks include occurs twice, and is reported once with the places of both.
fn merge(diagnostics: &mut Vec<Diagnostic>, found: Diagnostic) {
    let is_same = |other: &&mut Diagnostic| {
        (&other.range, &other.code, &other.message) == (&found.range, &found.code, &found.message)
    };
    let Some(other) = diagnostics.iter_mut().find(is_same) else {
        diagnostics.push(found);
        return;
    };
    for related in found.related_information.into_iter().flatten() {
        let known = other.related_information.get_or_insert_default();
        if !known.contains(&related) {
            known.push(related);
        }
    }
}

/// A finding in the terms of the protocol.
pub(super) fn diagnostic(view: View<'_>, finding: &found::Diagnostic) -> Diagnostic {
    let severity = match finding.severity {
        Severity::Error => DiagnosticSeverity::Error,
        Severity::Warning => DiagnosticSeverity::Warning,
        Severity::Note => DiagnosticSeverity::Information,
    };
    let mut message = finding.message.clone();
    if !finding.primary.text.is_empty() && finding.primary.text != finding.message {
        message += &format!("\n{}", finding.primary.text);
    }
    for (word, text) in [("help", &finding.help), ("note", &finding.note)] {
        if let Some(text) = text {
            message += &format!("\n{word}: {text}");
        }
    }
    let secondary = finding.secondary.iter().map(|label| (label.span, label.text.clone()));
    let chain = view.analysis.deck.include_chain(finding.primary.span.source());
    let chain = chain.into_iter().map(|span| (span, "included here".to_owned()));
    let related = secondary.chain(chain).map(|(span, message)| DiagnosticRelatedInformation {
        location: Location { uri: view.uri(span.source()), range: visible_range(view, span) },
        message: if message.is_empty() { "see here".to_owned() } else { message },
    });
    let related: Vec<_> = related.collect();
    Diagnostic {
        range: visible_range(view, finding.primary.span),
        severity: Some(severity),
        code: Some(finding.code.to_owned().into()),
        code_description: page_of(finding.code).map(|href| CodeDescription { href }),
        source: Some("inpact".to_owned()),
        message: message.into(),
        tags: WITHOUT_EFFECT.contains(&finding.code).then(|| vec![DiagnosticTag::Unnecessary]),
        related_information: Some(related).filter(|related| !related.is_empty()),
        data: None,
    }
}

fn page_of(code: &str) -> Option<Uri> {
    let rule = crate::rules::of_code(code)?;
    let anchor = format!("{}-{}", rule.code.to_lowercase(), rule.name);
    Some(Uri(format!("{}/blob/main/docs/rules.md#{anchor}", env!("CARGO_PKG_REPOSITORY"))))
}

/// A span without the final line end, for underlining.
fn visible_range(view: View<'_>, span: Span) -> Range {
    let trimmed = view.text_of(span.source()).map_or(span.len(), |text| {
        let bytes = text.bytes(span.start()..span.end());
        // Only the end of a long span matters.
        bytes.trim_ascii_end().len() as u64
    });
    let end = if trimmed == 0 { span.end() } else { span.start() + trimmed };
    view.range(Span::new(span.source(), span.start(), end))
}

/// An invalid configuration, reported at its beginning.
fn of_configuration(message: &str) -> Diagnostic {
    let start = Position { line: 0, character: 0 };
    Diagnostic {
        range: Range { start, end: Position { line: 1, character: 0 } },
        severity: Some(DiagnosticSeverity::Error),
        source: Some("inpact".to_owned()),
        message: message.to_owned().into(),
        ..Diagnostic::default()
    }
}

/// The findings of a deck that are in one of its files and touch some bytes of it.
pub(super) fn touching(analysis: &Analysis, bytes: Span) -> impl Iterator<Item = &found::Diagnostic> {
    analysis.findings.iter().filter(move |finding| finding.primary.span.touches(bytes))
}

/// The whole of a file of a deck.
pub(super) fn whole(view: View<'_>, source: SourceId) -> Span {
    Span::new(source, 0, view.text_of(source).map_or(0, inpact_parser::deck::EditedText::length))
}
