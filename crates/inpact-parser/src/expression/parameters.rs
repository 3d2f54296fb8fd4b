//! The parameters of a deck: every definition, and the final value.

use super::division::{Division, IntegerDivision};
use super::value::Value;
use crate::grammar::Release;
use crate::span::Span;
use std::collections::HashMap;

/// One executed statement `name = expression`.
#[derive(Debug, Clone, PartialEq)]
pub struct Definition {
    /// The name; upper and lower case differ (S-60).
    pub name: String,
    /// The expression after the `=`, without comment, continuation lines joined.
    pub expression: String,
    /// The statement, from the name to the end of the expression, as far as it lies in one file.
    pub span: Span,
    /// Its value; `None` when the statement has a problem, or uses a parameter whose statement has one.
    pub value: Option<Value>,
}

/// All definitions of a deck; the last one of a name counts everywhere (S-61).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Parameters {
    definitions: Vec<Definition>,
    last_of_name: HashMap<String, usize>,
    /// The names with capitals, by their lower case, for suggestions.
    of_lower_case: HashMap<String, usize>,
    /// The bytes of all text values.
    pub(super) text_bytes: usize,
    division: Division,
    /// The divisions of integers that leave a remainder, in the order of execution.
    pub(super) integer_divisions: Vec<IntegerDivision>,
}

impl Parameters {
    /// No parameter, in the newest release.
    pub fn new() -> Self {
        Self::default()
    }

    /// No parameter, in the Python version of a release (S-60).
    pub fn of_release(release: Release) -> Self {
        Self { division: Division::of_release(release), ..Self::default() }
    }

    /// Division of integers.
    pub fn division(&self) -> Division {
        self.division
    }

    /// The divisions of integers with a remainder, whose result depends on the release (S019).
    pub fn integer_divisions(&self) -> &[IntegerDivision] {
        &self.integer_divisions
    }

    /// Every definition, in the order of execution.
    pub fn definitions(&self) -> &[Definition] {
        &self.definitions
    }

    /// The definition of `name` in force: the last one.
    pub fn definition(&self, name: &str) -> Option<&Definition> {
        self.last_of_name.get(name).map(|index| &self.definitions[*index])
    }

    /// The value of `name`: that of its last definition; `None` also when that one has none.
    pub fn value(&self, name: &str) -> Option<&Value> {
        self.definition(name)?.value.as_ref()
    }

    /// A defined name that differs from `name` only in case.
    pub fn name_in_other_case(&self, name: &str) -> Option<&str> {
        let lower_case = name.to_ascii_lowercase();
        let index = self.of_lower_case.get(&lower_case).or_else(|| self.last_of_name.get(&lower_case))?;
        Some(self.definitions[*index].name.as_str()).filter(|other| *other != name)
    }

    /// The definitions in force, one per name.
    pub fn final_definitions(&self) -> impl Iterator<Item = &Definition> {
        let is_last =
            |(index, definition): &(usize, &Definition)| self.last_of_name.get(&definition.name) == Some(index);
        self.definitions.iter().enumerate().filter(is_last).map(|(_, definition)| definition)
    }

    /// Clears the places of the definitions, so that equal definitions of two decks compare equal.
    pub(crate) fn forget_places(&mut self) {
        self.definitions.iter_mut().for_each(|definition| definition.span = Span::default());
        self.integer_divisions.clear();
    }

    pub(super) fn push(&mut self, definition: Definition) {
        if let Some(Value::Text(text)) = &definition.value {
            self.text_bytes += text.len();
        }
        let index = self.definitions.len();
        self.last_of_name.insert(definition.name.clone(), index);
        if definition.name.bytes().any(|byte| byte.is_ascii_uppercase()) {
            self.of_lower_case.insert(definition.name.to_ascii_lowercase(), index);
        }
        self.definitions.push(definition);
    }
}
