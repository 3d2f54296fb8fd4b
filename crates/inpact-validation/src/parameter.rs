//! Parameters as given on a keyword line, compared with the grammar.
//!
//! Shared by the rules on values (S006 to S008, K006 to K011, K014, K016, K017), so that each question is answered
//! once and one fault gives one finding.

use crate::rule::{Context, DefinedBlock};
use inpact_parser::deck::{Parameter, Resolved};
use inpact_parser::expression::substitute;
use inpact_parser::grammar::{Dialect, Lookup, ParameterDefinition, ParameterKind};
use inpact_parser::model::MAX_FIELD_VARIABLES;
use inpact_parser::number::{NumberError, float_text, read_float, read_integer};
use inpact_parser::span::Span;
use std::borrow::Cow;

/// A parameter of a keyword line that the keyword has.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GivenParameter<'a> {
    /// The block of its keyword line.
    pub(crate) block: DefinedBlock<'a>,
    /// The parameter as given.
    pub(crate) parameter: Parameter,
    /// Its definition in the grammar.
    pub(crate) definition: &'a ParameterDefinition,
}

/// The parameters of the deck that their keyword has, in reading order.
pub(crate) fn all_given<'a>(context: &Context<'a>) -> impl Iterator<Item = GivenParameter<'a>> {
    context.defined_blocks().flat_map(given)
}

/// The parameters of a keyword line that the keyword has, in the order of the line.
pub(crate) fn given(block: DefinedBlock<'_>) -> impl Iterator<Item = GivenParameter<'_>> {
    block.keyword.parameters().filter_map(move |parameter| {
        let definition = &block.definition.parameters[parameter.index()?];
        Some(GivenParameter { block, parameter, definition })
    })
}

/// Whether the definition of the keyword is that of Abaqus while the deck is for CalculiX, whose names and bounds may differ.
pub(crate) fn is_borrowed(context: &Context<'_>, block: DefinedBlock<'_>) -> bool {
    context.grammar.dialect() == Dialect::Calculix && !block.definition.parameters_complete
}

/// The parameters of a keyword line without those that occur earlier, of which there may be any number (K009).
pub(crate) fn given_once(block: DefinedBlock<'_>) -> Vec<GivenParameter<'_>> {
    let mut is_there = vec![false; block.definition.parameters.len()];
    let first = |given: &GivenParameter<'_>| {
        given.parameter.index().is_some_and(|index| !std::mem::replace(&mut is_there[index], true))
    };
    given(block).filter(first).collect()
}

/// The parameter of that full name, where the line gives it; the first of several.
pub(crate) fn given_as<'a>(block: DefinedBlock<'a>, name: &str) -> Option<GivenParameter<'a>> {
    given(block).find(|given| given.definition.name == name)
}

/// Whether the line gives the parameter of that full name, or a likely misspelling of it.
pub(crate) fn may_be_given(context: &Context<'_>, block: DefinedBlock<'_>, name: &str) -> bool {
    // CalculiX skips a misspelt parameter (CX-04): then the one that is meant is not given.
    given_as(block, name).is_some()
        || !context.is_for_calculix()
            && block.keyword.parameters().any(|parameter| match parameter.resolved {
                Resolved::Exact(_) | Resolved::Abbreviated(_) => false,
                Resolved::Ambiguous => candidates(context, block, parameter)
                    .into_iter()
                    .any(|index| block.definition.parameters[index].name == name),
                // A value without a name may be that of any parameter.
                Resolved::Unknown if parameter.name.is_empty() => true,
                Resolved::Unknown => {
                    let written = context.deck.shown(parameter.name);
                    block.definition.nearest_parameters(&written, 3).contains(&name)
                }
            })
}

/// The parameters that an ambiguous name may mean, as indices into the keyword's list; none for any other.
pub(crate) fn candidates(context: &Context<'_>, block: DefinedBlock<'_>, parameter: Parameter) -> Vec<usize> {
    if parameter.resolved != Resolved::Ambiguous {
        return Vec::new();
    }
    match context.grammar.parameter_named(block.definition, context.deck.text(parameter.name)) {
        Lookup::Ambiguous(candidates) => candidates,
        _ => Vec::new(),
    }
}

impl GivenParameter<'_> {
    /// The value; `None` where there is none, or nothing after the `=`.
    pub(crate) fn value(&self) -> Option<Span> {
        self.parameter.value.filter(|value| !value.is_empty())
    }

    /// The value with parameters substituted; `None` where there is none, or a definition is missing.
    pub(crate) fn text<'a>(&self, context: &Context<'a>) -> Option<Cow<'a, [u8]>> {
        substituted(context, self.value()?)
    }

    /// The value as a number; `None` where no number is expected.
    pub(crate) fn number(&self, context: &Context<'_>) -> Option<Result<f64, NumberError>> {
        match self.definition.kind {
            ParameterKind::Float => Some(read_float(&self.text(context)?)),
            ParameterKind::Integer => Some(integer(&self.text(context)?)),
            _ => None,
        }
    }

    /// Describes how a number lies outside its bounds, if it does.
    pub(crate) fn out_of_bounds(&self, number: f64) -> Option<String> {
        let counts_fields = self.definition.name == "DEPENDENCIES";
        let most = if counts_fields { Some(MAX_FIELD_VARIABLES as f64) } else { self.definition.maximum };
        let bound = |word: &str, bound: f64| format!("{word} {}", self.bound_text(bound));
        match (self.definition.minimum, most) {
            (Some(least), _) if number < least => Some(bound("below the least legal value", least)),
            (_, Some(most)) if number > most => Some(bound("above the greatest legal value", most)),
            _ => None,
        }
    }

    fn bound_text(&self, bound: f64) -> String {
        let text = float_text(bound);
        match self.definition.kind {
            ParameterKind::Integer => text.trim_end_matches('.').to_owned(),
            _ => text,
        }
    }
}

/// The text of a value or item with every `<name>` replaced by its value (S-62); `None` where one has none (S015).
pub(crate) fn substituted<'a>(context: &Context<'a>, span: Span) -> Option<Cow<'a, [u8]>> {
    let written = context.deck.text(span);
    if !written.contains(&b'<') {
        return Some(Cow::Borrowed(written));
    }
    let replaced = substitute(&context.deck.shown(span), &context.model.parameters).ok()?.trim().to_owned();
    Some(Cow::Owned(replaced.into_bytes()))
}

/// Reads an integer; distinguishes one that is too large from an invalid one.
fn integer(text: &[u8]) -> Result<f64, NumberError> {
    let digits = text.strip_prefix(b"-").or(text.strip_prefix(b"+")).unwrap_or(text);
    match read_integer(text) {
        Ok(number) => Ok(number as f64),
        Err(_) if !digits.is_empty() && digits.iter().all(u8::is_ascii_digit) => Err(NumberError::TooLarge),
        Err(error) => Err(error),
    }
}
