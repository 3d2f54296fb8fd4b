//! Definition of a keyword: levels, parameters, rows. One TOML file each, read strictly.

use super::data::{Data, Layout, RowShape, first_repeated, is_description};
use super::dimension::Dimension;
use super::lookup::{Lookup, begins_with_name, is_name, lookup_among, lookup_name};
use super::nearest;
use super::release::Release;
use crate::Error;
use serde::Deserialize;

/// The definition of a keyword.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Definition {
    /// The keyword in full: upper case, single blanks between its words.
    pub name: String,
    /// Its purpose, in one line.
    pub summary: String,
    /// The levels at which it may occur; at any other it is misplaced (S-73). An empty list allows all.
    pub levels: Vec<Level>,
    /// The keywords whose block it must occur in; none when it needs no parent (S-21).
    pub parents: Vec<String>,
    /// The products that read it.
    pub products: Vec<Product>,
    /// The first release that has it, where that is known.
    pub since: Option<Release>,
    /// The last release that has it, where there is one.
    pub until: Option<Release>,
    /// Whether it is the procedure of a step (section 9.2).
    #[serde(default)]
    pub procedure: bool,
    /// Manual section, rule number.
    pub source: String,
    /// A piece of a deck that uses it and is right.
    pub example: String,
    /// All parameters are listed; otherwise one that is not listed is not an error.
    #[serde(default = "complete")]
    pub parameters_complete: bool,
    /// Its parameters, in the order of the manual.
    #[serde(default)]
    pub parameters: Vec<ParameterDefinition>,
    /// Its rows.
    pub data: Data,
    /// Matching of parameters.
    #[serde(skip)]
    matching: Matching,
}

/// Matching of names (S-13, CX-03).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Matching {
    /// As much as distinguishes it from all others, as in Abaqus.
    #[default]
    Abbreviated,
    /// All of it, as in CalculiX; flags and choices may go on after it.
    InFull,
}

/// A parameter of a keyword line.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ParameterDefinition {
    /// The name in full.
    pub name: String,
    /// The kind of its value.
    pub kind: ParameterKind,
    /// Whether the keyword line means nothing without it.
    #[serde(default)]
    pub required: bool,
    /// The value when it is left out, as it would be written.
    pub default: Option<String>,
    /// The dimension of a number.
    pub dimension: Option<Dimension>,
    /// The least number that is legal.
    pub minimum: Option<f64>,
    /// The greatest number that is legal.
    pub maximum: Option<f64>,
    /// The legal names, where the kind is a choice.
    #[serde(default)]
    pub choices: Vec<String>,
    /// Whether it may occur without a value although it can have one.
    #[serde(default)]
    pub value_optional: bool,
    /// The parameters that it must occur beside.
    #[serde(default)]
    pub needs: Vec<String>,
    /// The parameters that it must not occur beside.
    #[serde(default)]
    pub excludes: Vec<String>,
    /// The parameter of the same keyword that is meant by it, where decks have this name for it and no manual does.
    pub stands_for: Option<String>,
    /// The options that must not occur in the block that this keyword opens, beside the parameter (K-05).
    #[serde(default)]
    pub excludes_options: Vec<String>,
    /// The parameters beside which it means nothing (K-12).
    #[serde(default)]
    pub ignored_with: Vec<String>,
    /// The first release that has it, where that is known.
    pub since: Option<Release>,
    /// The last release that has it, where there is one.
    pub until: Option<Release>,
    /// One sentence without a full stop.
    pub description: String,
    /// Manual section, rule number.
    pub source: String,
    /// Matching of choices.
    #[serde(skip)]
    matching: Matching,
}

/// Kinds of values of a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ParameterKind {
    /// There is none (S-17).
    Flag,
    /// A number without a fraction (S-35).
    Integer,
    /// A number (S-34).
    Float,
    /// A name (S-40).
    Label,
    /// Any other text.
    Text,
    /// One of a few names, which may be abbreviated (S-13).
    Choice,
    /// The name of a file (S-22).
    File,
}

/// Whether a parameter has a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ValueUse {
    /// A flag.
    Never,
    /// It may occur alone.
    Optional,
    /// It must have one.
    Always,
}

/// A part of a deck in which keywords occur (S-71 to S-74).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Level {
    /// Outside of all others: model data.
    Model,
    /// Between *PART and *END PART.
    Part,
    /// Between *INSTANCE and *END INSTANCE.
    Instance,
    /// Between *ASSEMBLY and *END ASSEMBLY.
    Assembly,
    /// Between *STEP and *END STEP: history data.
    Step,
}

/// A program that reads decks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Product {
    /// Abaqus/Standard.
    Standard,
    /// Abaqus/Explicit.
    Explicit,
}

impl Definition {
    /// Reads a definition from its TOML.
    ///
    /// # Errors
    ///
    /// A text that is not TOML, has an unknown key, lacks one, or contradicts itself.
    pub fn parse(toml: &str) -> Result<Self, Error> {
        let definition: Self = toml::from_str(toml).map_err(|reason| Error::definition(reason.to_string()))?;
        match definition.contradiction() {
            Some(contradiction) => Err(Error::definition(format!("{}: {contradiction}", definition.name))),
            None => Ok(definition),
        }
    }

    /// The shape of its rows.
    pub fn rows(&self) -> RowShape {
        self.data.shape
    }

    /// Whether it may occur in the block of that keyword, given by its full name.
    pub fn has_parent(&self, keyword: &str) -> bool {
        self.parents.iter().any(|parent| parent == keyword)
    }

    /// The parameter of that full name.
    pub fn parameter(&self, name: &str) -> Option<&ParameterDefinition> {
        self.parameters.iter().find(|parameter| parameter.name == name)
    }

    /// Looks up a parameter as written in a deck for `release`; returns its index in the list (S-13, S-16).
    pub fn parameter_named_in(&self, written: &[u8], release: Release) -> Lookup<usize> {
        let parameters = self.parameters.iter().enumerate();
        if self.matching == Matching::InFull {
            return self.parameter_in_full(written);
        }
        let there = parameters.filter(|(_, parameter)| release.is_within(parameter.since, parameter.until));
        lookup_among(written, there.map(|(index, parameter)| (index, parameter.name.as_str())))
    }

    /// The parameter written in full; CalculiX compares only the letters of the name of a flag (CX-03).
    fn parameter_in_full(&self, written: &[u8]) -> Lookup<usize> {
        let is_meant = |parameter: &ParameterDefinition| match parameter.kind {
            ParameterKind::Flag => begins_with_name(written, &parameter.name),
            _ => is_name(written, &parameter.name),
        };
        self.parameters.iter().position(is_meant).map_or(Lookup::Unknown, Lookup::Exact)
    }

    /// Makes parameters and choices match as in CalculiX (CX-03).
    pub(super) fn match_in_full(&mut self) {
        self.matching = Matching::InFull;
        self.parameters.iter_mut().for_each(|parameter| parameter.matching = Matching::InFull);
    }

    /// Suggestions for a misspelt parameter, the nearest first.
    pub fn nearest_parameters(&self, written: &str, at_most: usize) -> Vec<&str> {
        nearest::nearest(written.as_bytes(), self.parameters.iter().map(|parameter| parameter.name.as_str()), at_most)
    }

    /// The layout of the rows with these parameters and this number of counted columns; see [`Data::layout`].
    pub fn layout(&self, given: impl Fn(&str) -> bool, count: usize) -> Option<Layout> {
        self.data.layout(given, count)
    }

    /// Removes all restrictions and requirements, leaving names and columns.
    ///
    /// For an Abaqus definition used for CalculiX, where the differences are unknown.
    pub(super) fn loosen(&mut self) {
        self.parameters_complete = false;
        self.levels.clear();
        self.data.required = false;
        self.data.minimum_rows = 0;
        for parameter in &mut self.parameters {
            if parameter.kind == ParameterKind::Choice {
                parameter.kind = ParameterKind::Text;
            }
            parameter.required = false;
            parameter.value_optional = parameter.kind != ParameterKind::Flag;
            (parameter.minimum, parameter.maximum) = (None, None);
            parameter.choices.clear();
            parameter.needs.clear();
            parameter.excludes.clear();
            parameter.excludes_options.clear();
            parameter.ignored_with.clear();
        }
    }

    fn contradiction(&self) -> Option<String> {
        if !is_description(&self.summary) || self.source.is_empty() || self.example.trim().is_empty() {
            return Some(
                "summary, source and example must say something, and a summary ends without a full stop".to_owned(),
            );
        }
        if self.levels.is_empty() {
            return Some("no level allows it".to_owned());
        }
        if let Some(name) = first_repeated(self.parameters.iter().map(|parameter| parameter.name.as_str())) {
            return Some(format!("duplicate parameter `{name}`"));
        }
        let has_parameter = |name: &str| self.parameter(name).is_some();
        let of_parameters = self.parameters.iter().find_map(|parameter| {
            let contradiction = parameter.contradiction(has_parameter)?;
            Some(format!("parameter `{}`: {contradiction}", parameter.name))
        });
        of_parameters.or_else(|| self.data.contradiction(has_parameter))
    }
}

impl ParameterDefinition {
    /// Whether it has a value (S-17).
    pub fn value_use(&self) -> ValueUse {
        match self.kind {
            ParameterKind::Flag => ValueUse::Never,
            _ if self.value_optional => ValueUse::Optional,
            _ => ValueUse::Always,
        }
    }

    /// Looks up a choice as written (S-13); `None` when there is none, or more than one.
    pub fn choice_named(&self, written: &[u8]) -> Option<&str> {
        if self.matching == Matching::InFull {
            return self.choices.iter().map(String::as_str).find(|choice| begins_with_name(written, choice));
        }
        let index = lookup_name(written, self.choices.iter().map(String::as_str)).found()?;
        Some(&self.choices[index])
    }

    fn contradiction(&self, has_parameter: impl Fn(&str) -> bool) -> Option<String> {
        let mut related = self.needs.iter().chain(&self.excludes).chain(&self.ignored_with).chain(&self.stands_for);
        if let Some(unknown) = related.find(|name| !has_parameter(name) || **name == self.name) {
            return Some(format!("`{unknown}` is no other parameter of the keyword"));
        }
        let is_number = matches!(self.kind, ParameterKind::Float | ParameterKind::Integer);
        let wrong = [
            (!is_description(&self.description) || self.source.is_empty(), "no description or no source"),
            ((self.kind == ParameterKind::Choice) == self.choices.is_empty(), "choices belong to the kind `choice`"),
            (self.kind == ParameterKind::Flag && self.value_optional, "a flag has no value"),
            (self.required && self.default.is_some(), "what is required has no default"),
            (!is_number && (self.minimum.is_some() || self.maximum.is_some()), "only numbers have bounds"),
            (
                self.dimension.is_some() != (self.kind == ParameterKind::Float),
                "a float has a dimension, nothing else has",
            ),
        ];
        let found = wrong.into_iter().find(|(is_wrong, _)| *is_wrong);
        found.map(|(_, message)| message.to_owned())
    }
}

fn complete() -> bool {
    true
}
