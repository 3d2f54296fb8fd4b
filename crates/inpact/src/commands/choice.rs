//! Values of arguments that are chosen by name.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

/// The name of a value, the value, and its description in `--help`.
pub(crate) type Choice<T> = (&'static str, T, &'static str);

/// Reads a value by its name.
pub(crate) fn one_of<T: Copy + Send + Sync>(choices: &'static [Choice<T>]) -> impl TypedValueParser<Value = T> {
    let named = choices.iter().map(|(name, _, help)| {
        let value = PossibleValue::new(*name);
        if help.is_empty() { value } else { value.help(*help) }
    });
    PossibleValuesParser::new(named).try_map(|name| {
        let chosen = choices.iter().find(|(known, ..)| *known == name);
        chosen.map(|(_, value, _)| *value).ok_or("there is no such value")
    })
}
