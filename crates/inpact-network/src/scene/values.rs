//! The numbers of a scene file, with their places.

use serde::Deserialize;
use std::ops::Range;
use toml::Spanned;

/// A number, and where it is written.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(transparent)]
pub(crate) struct Number(Spanned<f64>);

impl Number {
    pub(crate) fn value(&self) -> f64 {
        *self.0.as_ref()
    }

    pub(crate) fn span(&self) -> Range<usize> {
        self.0.span()
    }
}

#[cfg(test)]
impl schemars::JsonSchema for Number {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> std::borrow::Cow<'static, str> {
        f64::schema_name()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        f64::json_schema(generator)
    }
}
