//! The parameters of a keyword line in compact form: a deck may consist of short lines only.
//!
//! They are stored by their offsets in the line, and returned with their spans.

use super::KeywordLine;
use crate::grammar::{Definition, Dialect, Lookup};
use crate::span::Span;
use std::num::{NonZeroU16, NonZeroU32};
use std::ops::Range;

/// The default limit of bytes of a keyword line with its continuation lines: the rest is read as rows.
pub(super) const LONGEST_KEYWORD_LINE: u32 = 1 << 30;

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

    /// Whether it is the parameter of that full name; `definition` is that of its keyword.
    pub fn is(&self, name: &str, definition: &Definition) -> bool {
        self.index().is_some_and(|index| definition.parameters[index].name == name)
    }

    /// Name and value.
    pub fn span(&self) -> Span {
        self.value.map_or(self.name, |value| self.name.to(value))
    }
}

/// The parameter that a name on a keyword line resolves to (S-13); the grammar says what an ambiguous one may mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Resolved<T> {
    /// The name in full.
    Exact(T),
    /// A unique prefix of one name.
    Abbreviated(T),
    /// A prefix of several names.
    Ambiguous,
    /// A prefix of no name.
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

    /// The match in a dialect: CalculiX has no abbreviations, so an Abaqus abbreviation is another name there, or none.
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

/// The stored form of a parameter.
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
pub(super) struct Place {
    at: NonZeroU32,
    length: u32,
}

impl Place {
    /// Those bytes; an asterisk stands before them.
    pub(super) fn of(range: Range<usize>) -> Self {
        // No line is longer than LONGEST_KEYWORD_LINE and one line more.
        let number = |bytes: usize| u32::try_from(bytes).unwrap_or(u32::MAX);
        Self { at: NonZeroU32::new(number(range.start)).unwrap_or(NonZeroU32::MIN), length: number(range.len()) }
    }

    pub(super) fn span(self, line: Span) -> Span {
        let start = line.start() + u64::from(self.at.get());
        Span::new(line.source(), start, start + u64::from(self.length))
    }
}

/// The parameters of a keyword line: none or one on nearly every line, stored inline.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum AfterName {
    Nothing,
    OneParameter(ShortParameter),
    More(Box<More>),
}

/// Parameters and faults of a line with more than one of either.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct More {
    parameters: Box<[PlacedParameter]>,
    /// The offset in the line of the quote that does not close on it (S-41).
    pub(super) open_quote: Option<NonZeroU32>,
    /// The offset in the line of the comma at its end, when the next line is not its continuation (S-19).
    pub(super) last_comma: Option<LastComma>,
}

/// A comma at the end of a keyword line that nothing continues.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LastComma {
    /// Its offset in the line.
    pub(super) at: NonZeroU32,
    /// The limit of bytes of a keyword line, where the next one would have exceeded it.
    pub(super) most: Option<NonZeroU32>,
}

/// A parameter within the first 64 KiB of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ShortParameter {
    name: ShortPlace,
    value: Option<ShortPlace>,
    resolved: Resolved<u16>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct ShortPlace {
    at: NonZeroU16,
    length: u16,
}

impl ShortPlace {
    fn of(place: Place) -> Option<Self> {
        Some(Self { at: place.at.try_into().ok()?, length: u16::try_from(place.length).ok()? })
    }

    fn whole(self) -> Place {
        Place { at: self.at.into(), length: self.length.into() }
    }
}

impl ShortParameter {
    fn of(parameter: PlacedParameter) -> Option<Self> {
        let value = match parameter.value {
            Some(value) => Some(ShortPlace::of(value)?),
            None => None,
        };
        Some(Self { name: ShortPlace::of(parameter.name)?, value, resolved: parameter.resolved })
    }

    fn whole(self) -> PlacedParameter {
        PlacedParameter { name: self.name.whole(), value: self.value.map(ShortPlace::whole), resolved: self.resolved }
    }
}

impl AfterName {
    /// The parameters of a line, the offsets of a quote that does not close, and of a comma that nothing follows.
    pub(super) fn new(
        parameters: impl ExactSizeIterator<Item = PlacedParameter>,
        open_quote: Option<NonZeroU32>,
        last_comma: Option<LastComma>,
    ) -> Self {
        let mut parameters = parameters.peekable();
        if open_quote.is_none() && last_comma.is_none() {
            match (parameters.len(), parameters.peek().copied().and_then(ShortParameter::of)) {
                (0, _) => return Self::Nothing,
                (1, Some(only)) => return Self::OneParameter(only),
                _ => {}
            }
        }
        Self::More(Box::new(More { parameters: parameters.collect(), open_quote, last_comma }))
    }

    fn count(&self) -> usize {
        match self {
            Self::Nothing => 0,
            Self::OneParameter(_) => 1,
            Self::More(more) => more.parameters.len(),
        }
    }

    fn get(&self, index: usize) -> Option<PlacedParameter> {
        match self {
            Self::Nothing => None,
            Self::OneParameter(only) => (index == 0).then(|| only.whole()),
            Self::More(more) => more.parameters.get(index).copied(),
        }
    }
}

impl KeywordLine {
    /// The parameters in the order of the line.
    ///
    /// # Panics
    /// Never.
    pub fn parameters(&self) -> impl DoubleEndedIterator<Item = Parameter> + ExactSizeIterator + Clone {
        let line = self.span;
        (0..self.after_name.count()).map(move |index| {
            let kept = self.after_name.get(index).expect("fewer than counted");
            Parameter {
                name: kept.name.span(line),
                value: kept.value.map(|value| value.span(line)),
                resolved: kept.resolved,
            }
        })
    }

    /// The last setting of the parameter of that full name, which counts; `definition` is that of the keyword.
    pub fn given(&self, name: &str, definition: &Definition) -> Option<Parameter> {
        self.parameters().rev().find(|given| given.is(name, definition))
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
        assert_eq!((size_of::<KeywordLine>(), size_of::<Block>()), (48, 64));
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

    /// A single parameter has another form than several, and than one at a large offset.
    #[test]
    fn a_parameter_comes_back_from_anywhere() {
        for blanks in [0, 65_510, 65_520, 65_535, 65_536, 70_000] {
            for value in ["", "= v", "= \"v", "=v,"] {
                let text = format!("*SURFACE INTERACTION,{}NAME{value}\n", " ".repeat(blanks));
                let deck = scan("d", text.as_bytes(), Grammar::builtin());
                let keyword = deck.blocks()[0].keyword.as_ref().expect("a keyword");
                let mut parameters = keyword.parameters();
                let only = parameters.next_back().expect("a parameter");
                assert!(parameters.next().is_none());
                assert_eq!(
                    (deck.shown(keyword.name()), deck.shown(only.name)),
                    ("SURFACE INTERACTION".into(), "NAME".into())
                );
                let expected = value.strip_prefix('=').map(|value| value.trim_matches([' ', ',']).to_owned());
                assert_eq!(only.value.map(|value| deck.shown(value)), expected);
                assert_eq!(keyword.unterminated_quote().is_some(), value.contains('"'));
                assert_eq!(keyword.dangling_comma().is_some(), value.ends_with(','));
            }
        }
    }
}
