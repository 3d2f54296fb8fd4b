//! The source files of findings, as far as they are kept.

use inpact_diagnostics::{Diagnostic, Extent, Label};
use inpact_parser::deck::{Deck, Excerpts};

/// Sources of the text around findings.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Sources<'a> {
    /// The files of a deck, which keeps what is interpreted.
    Deck(&'a Deck),
    /// Node tables, scenes and their tables: a finding holds the lines around it.
    Data,
}

/// Whether the lines of a finding can be shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shown {
    Yes,
    /// They must not be: the file lies outside of the deck's folder.
    Withheld,
    /// There are none: the file has no lines, or they were not kept.
    No,
}

impl<'a> Sources<'a> {
    pub(super) fn file<'l>(self, label: &'l Label) -> &'l str
    where
        'a: 'l,
    {
        match self {
            Self::Deck(deck) => deck.source(label.span.source()).name(),
            Self::Data => &label.file,
        }
    }

    pub(super) fn shown(self, label: &Label) -> Shown {
        match self {
            Self::Deck(deck) if deck.source(label.span.source()).excerpts() == Excerpts::Shown => Shown::Yes,
            Self::Deck(_) => Shown::Withheld,
            Self::Data if label.lines.is_some() => Shown::Yes,
            Self::Data => Shown::No,
        }
    }

    /// Kept bytes around a label, and the offset of the first.
    pub(super) fn surroundings<'l>(self, label: &'l Label) -> (u64, &'l [u8])
    where
        'a: 'l,
    {
        match (self, &label.lines) {
            (Self::Deck(deck), _) => deck.surroundings(label.span),
            (Self::Data, Some(lines)) => (lines.start, &lines.bytes),
            (Self::Data, None) => (label.span.start(), &[]),
        }
    }

    /// The bytes of a label; none where they were not kept.
    pub(super) fn text<'l>(self, label: &'l Label) -> &'l [u8]
    where
        'a: 'l,
    {
        match self {
            Self::Deck(deck) => deck.text(label.span),
            Self::Data => {
                let (base, bytes) = self.surroundings(label);
                let (start, end) = place_of(label);
                let index = |offset: u64| usize::try_from(offset.saturating_sub(base)).unwrap_or(usize::MAX);
                bytes.get(index(start)..index(end)).unwrap_or_default()
            }
        }
    }

    /// The chain of *INCLUDE of a finding, the nearest first: `deck.inp:3`; empty for the deck itself and for data.
    pub(super) fn include_chain(self, found: &Diagnostic) -> Vec<String> {
        let Self::Deck(deck) = self else { return Vec::new() };
        let chain = deck.include_chain(found.primary.span.source());
        let places = deck.positions(&chain);
        let shown = chain.iter().zip(places);
        shown.map(|(span, place)| format!("{}:{}", deck.source(span.source()).name(), place.line)).collect()
    }
}

/// The bytes from start to end of a label; those of its line where only that is known.
pub(super) fn place_of(label: &Label) -> (u64, u64) {
    match (&label.lines, label.extent) {
        (Some(lines), Extent::Line) => {
            let line = &lines.bytes[lines.line.clone()];
            let blanks = line.len() - line.trim_ascii_start().len();
            let start = lines.start + (lines.line.start + blanks) as u64;
            (start, start + line.trim_ascii().len() as u64)
        }
        _ => (label.span.start(), label.span.end().max(label.span.start())),
    }
}
