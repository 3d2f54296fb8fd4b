//! The error type of this crate.

use thiserror::Error as ThisError;

/// An invalid text: JSON of neither view, a model that no deck can express, a definition of a keyword, a dimension, a release.
///
/// A fault of a deck is a [`Problem`](crate::Problem), not an error.
///
/// ```
/// let error = inpact_parser::json::view_of(r#"{"schema": "inpact/model/9"}"#).unwrap_err();
/// assert_eq!(error.json_path(), Some("schema"));
/// assert!(error.to_string().starts_with("at `schema`: unknown schema `inpact/model/9`"));
/// ```
#[derive(Debug, Clone, PartialEq, Eq, ThisError)]
#[error(transparent)]
pub struct Error(Kind);

#[derive(Debug, Clone, PartialEq, Eq, ThisError)]
enum Kind {
    #[error("{}{message}", if path.is_empty() { String::new() } else { format!("at `{path}`: ") })]
    Json { path: String, message: String },
    #[error("no deck can say this: {what} reads back as something else")]
    Unprintable { what: String },
    #[error("{0}")]
    Definition(String),
    #[error("`{written}` is no dimension: {reason}")]
    Dimension { written: String, reason: &'static str },
    #[error("`{written}` is no release: there are 6.11, 6.14, 2016, 2017, 2022 and 2024")]
    Release { written: String },
}

impl Error {
    /// The place in JSON, in the form `interactions.STEEL.thickness`; empty where the text is not JSON at all, `None` for errors of other texts.
    pub fn json_path(&self) -> Option<&str> {
        match &self.0 {
            Kind::Json { path, .. } => Some(path),
            _ => None,
        }
    }

    pub(crate) fn json(path: impl Into<String>, message: impl Into<String>) -> Self {
        Self(Kind::Json { path: path.into(), message: message.into() })
    }

    /// A model of which this part reads back differently.
    pub(crate) fn unprintable(what: impl Into<String>) -> Self {
        Self(Kind::Unprintable { what: what.into() })
    }

    pub(crate) fn definition(message: impl Into<String>) -> Self {
        Self(Kind::Definition(message.into()))
    }

    pub(crate) fn dimension(written: &str, reason: &'static str) -> Self {
        Self(Kind::Dimension { written: written.to_owned(), reason })
    }

    pub(crate) fn release(written: &str) -> Self {
        Self(Kind::Release { written: written.to_owned() })
    }
}
