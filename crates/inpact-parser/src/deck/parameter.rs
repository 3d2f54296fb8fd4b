//! The parameters of a keyword line, in little memory: a deck may be nothing but short lines.
//!
//! They are kept by their places in the line, and given out with their spans.

use super::KeywordLine;
use crate::grammar::{Dialect, Lookup};
use crate::span::Span;
use std::num::NonZeroU32;
use std::ops::Range;

/// The most bytes of a keyword line with the lines that continue it: what follows is read as rows.
pub(super) const LONGEST_KEYWORD_LINE: usize = 1 << 30;

/// `NAME` or `NAME=VALUE` on a keyword line (S-17).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameter {
    /// The name, without blanks around it.
    pub name: Span,
    /// The value; `None` when there is no `=`.
    pub value: Option<Span>,
    /// The parameter that the name resolves to, as an index into the keyword's list; unknown where the grammar has no definition.
    pub resolved: Resolved<u16>,
}

impl Parameter {
    /// The parameter's index in the keyword's definition, when the name means exactly one.
    pub fn index(&self) -> Option<usize> {
        self.resolved.found().map(usize::from)
    }

    /// Name and value.
    pub fn span(&self) -> Span {
        self.value.map_or(self.name, |value| self.name.to(value))
    }
}

/// What a name on a keyword line resolves to (S-13); the grammar says what an ambiguous one may mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Resolved<T> {
    /// The name in full.
    Exact(T),
    /// The beginning of one name and of no other.
    Abbreviated(T),
    /// The beginning of several names.
    Ambiguous,
    /// The beginning of none.
    Unknown,
}

impl<T> Resolved<T> {
    /// The thing found, when it is one.
    pub fn found(self) -> Option<T> {
        match self {
            Self::Exact(found) | Self::Abbreviated(found) => Some(found),
            Self::Ambiguous | Self::Unknown => None,
        }
    }

    /// The thing found in a dialect: CalculiX knows no abbreviations, and what is one for Abaqus is another name there, or none.
    pub(crate) fn found_in(self, dialect: Dialect) -> Option<T> {
        match (self, dialect) {
            (Self::Exact(found), _) | (Self::Abbreviated(found), Dialect::Abaqus) => Some(found),
            _ => None,
        }
    }
}

impl<T> From<Lookup<T>> for Resolved<T> {
    fn from(lookup: Lookup<T>) -> Self {
        match lookup {
            Lookup::Exact(found) => Self::Exact(found),
            Lookup::Abbreviated(found) => Self::Abbreviated(found),
            Lookup::Ambiguous(_) => Self::Ambiguous,
            Lookup::Unknown => Self::Unknown,
        }
    }
}

/// A parameter as it is kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PlacedParameter {
    name: Place,
    value: Option<Place>,
    resolved: Resolved<u16>,
}

impl PlacedParameter {
    /// The parameter at these bytes of its line; an asterisk stands before them.
    pub(super) fn new(name: Range<usize>, value: Option<Range<usize>>, resolved: Lookup<usize>) -> Self {
        // A keyword has fewer than 65536 parameters.
        let resolved = match Resolved::from(resolved) {
            Resolved::Exact(index) => u16::try_from(index).map_or(Resolved::Unknown, Resolved::Exact),
            Resolved::Abbreviated(index) => u16::try_from(index).map_or(Resolved::Unknown, Resolved::Abbreviated),
            Resolved::Ambiguous => Resolved::Ambiguous,
            Resolved::Unknown => Resolved::Unknown,
        };
        Self { name: Place::of(name), value: value.map(Place::of), resolved }
    }
}

/// Some bytes of a keyword line.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Place {
    at: NonZeroU32,
    length: u32,
}

impl Place {
    fn of(range: Range<usize>) -> Self {
        // No line is longer than LONGEST_KEYWORD_LINE and one line more.
        let number = |bytes: usize| u32::try_from(bytes).unwrap_or(u32::MAX);
        Self { at: NonZeroU32::new(number(range.start)).unwrap_or(NonZeroU32::MIN), length: number(range.len()) }
    }

    fn span(self, line: Span) -> Span {
        let start = line.start() + u64::from(self.at.get());
        Span::new(line.source(), start, start + u64::from(self.length))
    }
}

impl KeywordLine {
    /// The parameters in the order of the line.
    pub fn parameters(&self) -> impl DoubleEndedIterator<Item = Parameter> + ExactSizeIterator + Clone {
        let line = self.span;
        self.parameters.iter().map(move |kept| Parameter {
            name: kept.name.span(line),
            value: kept.value.map(|value| value.span(line)),
            resolved: kept.resolved,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{Parameter, PlacedParameter, Resolved};
    use crate::deck::{Block, KeywordLine, scan};
    use crate::grammar::Grammar;

    #[test]
    fn blocks_and_parameters_take_little_memory() {
        assert_eq!(size_of::<PlacedParameter>(), 20);
        assert!(size_of::<KeywordLine>() <= 64 && size_of::<Block>() <= 96, "{}", size_of::<Block>());
    }

    #[test]
    fn spans_come_back() {
        let text = "*HEADING\n* Surface Interaction, USER,\n** why\n name = A b \n";
        let deck = scan("d", text.as_bytes(), Grammar::builtin());
        let parameters: Vec<Parameter> = deck.blocks()[1].keyword.as_ref().expect("a keyword").parameters().collect();
        let shown: Vec<_> = parameters
            .iter()
            .map(|found| (deck.shown(found.name), found.value.map(|value| deck.shown(value))))
            .collect();
        assert_eq!(shown, [("USER".to_owned(), None), ("name".to_owned(), Some("A b".to_owned()))]);
        assert!(parameters.iter().all(|found| matches!(found.resolved, Resolved::Exact(_))));
    }
}
