//! Keyword lines of a scan: their keyword, their parameters, and the lines that continue them (S-19).

use crate::deck::lines::{LineKind, line_kind};
use crate::deck::parameter::{AfterName, LastComma, Place, PlacedParameter};
use crate::deck::{KeywordLine, Resolved, items, keyword_line};
use crate::grammar::{Dialect, Grammar, KeywordId, Lookup, RowShape, ValueUse};
use crate::span::{SourceId, Span};
use std::num::NonZeroU32;

/// Lines after a comma at the end of a keyword line that do not continue it (S-19).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum AfterComma {
    /// Nothing continues the comma.
    NoParameters,
    /// Names that may be flags of a keyword whose parameters are not all known here, or that another file may go on with.
    ///
    /// The line is read as a row, and the comma in front of it is nothing to complain about: without it a flag would be one.
    PerhapsFlags,
    /// The next line would make it exceed this number of bytes.
    TooLong(u32),
}

/// The reading of `line` after a keyword line; `None` where it goes on with its parameters: these have `=`, or are flags the keyword knows (S-19).
pub(super) fn after_comma(keyword: Option<KeywordId>, line: &[u8], grammar: &Grammar) -> Option<AfterComma> {
    let definition = keyword.and_then(|id| grammar.keyword(id).definition());
    let knows_all = definition.is_some_and(|definition| definition.parameters_complete);
    match line_kind(line) {
        // No manual says what a blank line means here.
        LineKind::Blank if !knows_all => return Some(AfterComma::PerhapsFlags),
        LineKind::Data => {}
        _ => return Some(AfterComma::NoParameters),
    }
    let is_parameter = |item: &[u8]| {
        let name = item.split(|byte| *byte == b'=').next().unwrap_or(item);
        let known = definition.map_or(Lookup::Unknown, |definition| grammar.parameter_named(definition, name));
        let has_value = item.contains(&b'=');
        match (definition, known) {
            (Some(definition), Lookup::Exact(index) | Lookup::Abbreviated(index)) => {
                has_value || definition.parameters[index].value_use() != ValueUse::Always
            }
            // Rows of free text may hold `=` without being parameters: `x = 5` after `*PARAMETER,`.
            (Some(definition), _) => has_value && (definition.rows() != RowShape::Text || !knows_all),
            (None, _) => has_value,
        }
    };
    let has_value = line.contains(&b'=');
    let mut fields = items(line).map(|range| &line[range]).filter(|item| !item.is_empty()).peekable();
    let is_empty = fields.peek().is_none();
    let mut perhaps = !knows_all && !is_empty;
    let continues = if has_value {
        fields.any(is_parameter)
    } else {
        !is_empty
            && fields.fold(true, |all, word| {
                perhaps &= is_like_a_flag(word);
                all && is_parameter(word)
            })
    };
    match (continues, perhaps) {
        (true, _) => None,
        (false, true) => Some(AfterComma::PerhapsFlags),
        (false, false) => Some(AfterComma::NoParameters),
    }
}

/// Whether a word could be the name of a parameter: letters first, then letters, digits, blanks and dashes.
pub(super) fn is_like_a_flag(word: &[u8]) -> bool {
    let is_inside = |byte: &u8| byte.is_ascii_alphanumeric() || matches!(byte, b' ' | b'\t' | b'-' | b'_');
    word.first().is_some_and(u8::is_ascii_alphabetic) && word.iter().all(is_inside)
}

/// Resolves the pieces of a keyword line that begins at `start` in the file.
pub(super) fn resolve(
    text: &[u8],
    (id, start): (SourceId, u64),
    after_comma: AfterComma,
    grammar: &Grammar,
) -> KeywordLine {
    let pieces = match grammar.dialect() {
        Dialect::Abaqus => keyword_line::parse(text),
        Dialect::Calculix => keyword_line::parse_unprotected(text),
    };
    // An asterisk stands before both.
    let point = |at: usize| u32::try_from(at).ok().and_then(NonZeroU32::new);
    let resolved = Resolved::from(grammar.keyword_named(&text[pieces.name.clone()]));
    let definition = resolved.found().and_then(|id| grammar.keyword(id).definition());
    let parameters = pieces.parameters.into_iter().map(|parameter| {
        let resolved =
            definition.map_or(Lookup::Unknown, |known| grammar.parameter_named(known, &text[parameter.name.clone()]));
        PlacedParameter::new(parameter.name, parameter.value, resolved)
    });
    let last_comma = pieces.final_comma.and_then(point).and_then(|at| match after_comma {
        AfterComma::NoParameters => Some(LastComma { at, most: None }),
        AfterComma::PerhapsFlags => None,
        AfterComma::TooLong(most) => Some(LastComma { at, most: NonZeroU32::new(most) }),
    });
    KeywordLine {
        span: Span::new(id, start, start + text.len() as u64),
        name: Place::of(pieces.name),
        resolved,
        after_name: AfterName::new(parameters, pieces.unterminated_quote.and_then(point), last_comma),
    }
}
