//! Suggestions for names that do not exist.

use inpact_parser::grammar::nearest_names;

/// The names similar to a written one.
pub(super) fn near<'name>(written: &str, names: impl IntoIterator<Item = &'name str>) -> Vec<&'name str> {
    nearest_names(written.as_bytes(), names, 3)
}

/// The suggestion of similar names, if any, and further help.
pub(crate) fn meant_or<'name>(written: &str, names: impl IntoIterator<Item = &'name str>, else_do: &str) -> String {
    let near = near(written, names);
    if near.is_empty() {
        return else_do.to_owned();
    }
    let near: Vec<String> = near.iter().map(|name| format!("`{name}`")).collect();
    let question = format!("is {} meant?", near.join(" or "));
    let mut rest = else_do.chars();
    rest.next()
        .map_or_else(|| question.clone(), |first| format!("{question} {}{}", first.to_uppercase(), rest.as_str()))
}

/// The texts in backticks.
pub(super) fn quoted(text: &str) -> impl Iterator<Item = &str> {
    text.split('`').skip(1).step_by(2)
}

/// Names in backticks, concatenated.
pub(super) fn listed(names: &[&str]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}
