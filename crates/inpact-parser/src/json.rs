//! The deck as JSON, in two views, and back.
//!
//! [`model`] is the content of the deck: schema `inpact/model/1`.
//! [`syntax`] is its text: schema `inpact/syntax/1`, from which the files are restored byte for byte.
//! Reading is strict: an unknown field, a wrong type or a missing field is rejected with its JSON path.
//! Each view has a JSON Schema, generated from the types that are read and written.

mod layout;
pub mod model;
#[cfg(test)]
mod schema;
pub mod syntax;

use crate::Error;
use serde::de::{Deserialize, DeserializeOwned, Deserializer};

/// Views of JSON.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum View {
    /// `inpact/model/1`.
    Model,
    /// `inpact/syntax/1`.
    Syntax,
}

/// Detects the view of a JSON text from its `schema` field.
///
/// # Errors
/// A text that is not a JSON object, or whose `schema` is missing or names neither view.
pub fn view_of(text: &str) -> Result<View, Error> {
    #[derive(serde::Deserialize)]
    #[serde(expecting = "a document: an object")]
    struct Head {
        schema: String,
    }
    let head: Head = parse(text)?;
    match head.schema.as_str() {
        model::SCHEMA => Ok(View::Model),
        syntax::SCHEMA => Ok(View::Syntax),
        other => {
            let expected = format!("expected `{}` or `{}`", model::SCHEMA, syntax::SCHEMA);
            Err(Error::json("schema", format!("unknown schema `{other}`, {expected}")))
        }
    }
}

/// Parses a document; the error has the path of the fault.
fn parse<T: DeserializeOwned>(text: &str) -> Result<T, Error> {
    let mut deserializer = serde_json::Deserializer::from_str(text);
    let document = serde_path_to_error::deserialize(&mut deserializer).map_err(|error| {
        let path = error.path().to_string();
        Error::json(if path == "." { String::new() } else { path }, json_message(&error.inner().to_string()))
    })?;
    deserializer.end().map_err(|error| Error::json("", json_message(&error.to_string())))?;
    Ok(document)
}

/// The message of a wrong type, with JSON type names in place of serde's Rust type names.
fn json_message(message: &str) -> String {
    let Some((found, (expected, place))) =
        message.rsplit_once(", expected ").and_then(|(found, rest)| Some((found, rest.split_once(" at line ")?)))
    else {
        return message.to_owned();
    };
    let expected = match expected {
        "f64" => "a number",
        "i64" => "an integer",
        "u64" | "usize" => "an integer from 0",
        "u8" => "an integer from 0 to 255",
        "a sequence" => "a list",
        "a map" => "an object",
        "a boolean" => "`true` or `false`",
        other => other,
    };
    let found = match found {
        "invalid type: sequence" => "invalid type: list",
        "invalid type: map" => "invalid type: object",
        other => other,
    };
    format!("{found}, expected {expected} at line {place}")
}

/// Reads a required field, which may be `null`.
pub(crate) fn required<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    Option::deserialize(deserializer)
}

#[cfg(test)]
mod tests {
    use super::{Error, json_message, model, syntax};
    use crate::grammar::Grammar;
    use serde_json::{Value, json};

    #[test]
    fn a_wrong_type_is_said_json_message() {
        let cases = [
            (
                "invalid type: string \"1\", expected f64 at line 1 column 2",
                "invalid type: string \"1\", expected a number at line 1 column 2",
            ),
            (
                "invalid type: map, expected a sequence at line 1 column 2",
                "invalid type: object, expected a list at line 1 column 2",
            ),
            ("missing field `rows` at line 1 column 2", "missing field `rows` at line 1 column 2"),
            ("no place, expected f64", "no place, expected f64"),
        ];
        for (message, expected) in cases {
            assert_eq!(json_message(message), expected);
        }
    }

    /// No message names a Rust type, whatever value is given.
    #[test]
    fn no_message_names_a_type_of_rust() {
        let grammar = Grammar::builtin();
        let deck = crate::deck::scan("d", EVERYTHING.as_bytes(), grammar);
        let (found, _) = crate::model::read(&deck, grammar);
        check_messages(&model::write(&found, "d"), |text| model::read(text).err());
        check_messages(&syntax::write(&deck, grammar), |text| syntax::read(text, grammar).err());
    }

    /// Puts something else in the place of every value, and looks at what reading says to it.
    fn check_messages(text: &str, error_of: impl Fn(&str) -> Option<Error>) {
        let names = ["Document", "Line", "struct", "enum", "f64", "u64", "usize", "u8", "variant", "element"];
        let document: Value = serde_json::from_str(text).unwrap();
        let mut refused = 0;
        let mut places = vec![String::new()];
        while let Some(place) = places.pop() {
            match document.pointer(&place).unwrap() {
                Value::Object(fields) => places.extend(fields.keys().map(|key| format!("{place}/{key}"))),
                Value::Array(items) => places.extend((0..items.len()).map(|index| format!("{place}/{index}"))),
                _ => {}
            }
            for wrong in [json!(true), json!(-7.5), json!({}), json!([[]])] {
                let mut document = document.clone();
                *document.pointer_mut(&place).unwrap() = wrong;
                let Some(error) = error_of(&document.to_string()) else { continue };
                let message = error.to_string();
                assert!(!names.iter().any(|name| message.contains(name)), "{place}: {message}");
                refused += 1;
            }
        }
        assert!(refused > 100, "{refused}");
    }

    const EVERYTHING: &str = "*PARAMETER\na = 1\n*SURFACE INTERACTION, NAME=A\n1.,\n*GAP ELECTRICAL CONDUCTANCE, DEPENDENCIES=1\n\
        <a>, 0., 20., 1.\n0., 1., 20., 1.\n*GAP HEAT GENERATION\n1., 0.5\n\
        *CONTACT PERMEABILITY, CONSTRAINT METHOD=PENALTY, CUTOFF GAP FILL=1.\n1., 0., 0., 0.\n*FRICTION\n0.1\n\
        *CONTACT PAIR, INTERACTION=A\nS, M\n*CONTACT\n*CONTACT PROPERTY ASSIGNMENT\nS, M, A\n\
        *STEP\n*HEAT TRANSFER, STEADY STATE\n1., 1.\n*END STEP\n";
}
