//! The deck as JSON, in two views, and back.
//!
//! [`model`] is what the deck says: schema `inpact/model/1`.
//! [`syntax`] is how it says it: schema `inpact/syntax/1`, from which the files come back byte for byte.
//! Reading is strict: an unknown field, a wrong type or a missing field is refused with its JSON path.

mod layout;
pub mod model;
pub mod syntax;

use serde::de::DeserializeOwned;
use thiserror::Error;

/// JSON that is not what it should be.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{}{message}", if path.is_empty() { String::new() } else { format!("at `{path}`: ") })]
pub struct JsonError {
    path: String,
    message: String,
}

impl JsonError {
    /// An error at a JSON path such as `interactions.STEEL.thickness`.
    pub(crate) fn new(path: impl Into<String>, message: impl Into<String>) -> Self {
        Self { path: path.into(), message: message.into() }
    }

    /// Where it is, in the form `interactions.STEEL.thickness`; empty when the text is no JSON at all.
    pub fn path(&self) -> &str {
        &self.path
    }
}

/// Which view a JSON text is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum View {
    /// `inpact/model/1`.
    Model,
    /// `inpact/syntax/1`.
    Syntax,
}

/// Reads which view a JSON text is from its `schema` field.
///
/// # Errors
/// When the text is no JSON object, or `schema` is missing or names neither view.
pub fn view_of(text: &str) -> Result<View, JsonError> {
    #[derive(serde::Deserialize)]
    struct Head {
        schema: String,
    }
    let head: Head = parse(text)?;
    match head.schema.as_str() {
        model::SCHEMA => Ok(View::Model),
        syntax::SCHEMA => Ok(View::Syntax),
        other => {
            let expected = format!("expected `{}` or `{}`", model::SCHEMA, syntax::SCHEMA);
            Err(JsonError::new("schema", format!("unknown schema `{other}`, {expected}")))
        }
    }
}

/// Parses a document; the path of what is wrong with it is in the error.
fn parse<T: DeserializeOwned>(text: &str) -> Result<T, JsonError> {
    let mut deserializer = serde_json::Deserializer::from_str(text);
    let document = serde_path_to_error::deserialize(&mut deserializer).map_err(|error| {
        let path = error.path().to_string();
        JsonError::new(if path == "." { String::new() } else { path }, error.inner().to_string())
    })?;
    deserializer.end().map_err(|error| JsonError::new("", error.to_string()))?;
    Ok(document)
}
