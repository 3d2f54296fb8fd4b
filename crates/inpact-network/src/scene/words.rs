//! What the parser of TOML says of a scene file, in the words of somebody who writes one.

use inpact_parser::grammar::nearest_names;

/// What is longer is not quoted.
const LONGEST_QUOTE: usize = 60;

/// What is wrong, and what to do, as far as that is known; what the parser says where it says it in no known way.
pub(super) fn told(error: &toml::de::Error, text: &str) -> (String, String) {
    // Some messages of the parser have several lines.
    let message = error.message().lines().collect::<Vec<_>>().join("; ");
    let written = error.span().and_then(|span| text.get(span)).map(str::trim);
    let written = written.filter(|text| !text.is_empty() && !text.contains('\n') && text.len() <= LONGEST_QUOTE);
    let known = match message.as_str() {
        "duplicate key" => {
            written.map(|key| (format!("`{key}` is given twice"), "leave one of the two out".to_owned()))
        }
        _ => unknown_key(&message)
            .or_else(|| unknown_word(&message))
            .or_else(|| missing_key(&message))
            .or_else(|| second_name(&message))
            .or_else(|| wrong_kind(&message, written)),
    };
    known.unwrap_or((message, String::new()))
}

fn unknown_key(message: &str) -> Option<(String, String)> {
    let (key, keys) = message.strip_prefix("unknown field `")?.rsplit_once("`, expected ")?;
    let keys: Vec<&str> = quoted(keys).collect();
    let help = match keys[..] {
        [only] => format!("the only key here is `{only}`"),
        _ => format!("the keys here are {}", listed(&keys)),
    };
    Some((format!("there is no key `{key}` here"), meant_or(key, keys, &help)))
}

fn unknown_word(message: &str) -> Option<(String, String)> {
    let (word, words) = message.strip_prefix("unknown variant `")?.rsplit_once("`, expected ")?;
    let words: Vec<&str> = quoted(words).collect();
    Some((format!("`{word}` is none of {}", listed(&words)), meant_or(word, words, "")))
}

fn missing_key(message: &str) -> Option<(String, String)> {
    let key = message.strip_prefix("missing field `")?.strip_suffix('`')?;
    let help = match key {
        "deck" => "begin the scene with the name of its deck, such as deck = \"joint.inp\"".to_owned(),
        _ => format!("add `{key}` to the entry that begins here"),
    };
    Some((format!("`{key}` is missing"), help))
}

/// The parser refuses what is written twice, so that this is the other name of what is there.
fn second_name(message: &str) -> Option<(String, String)> {
    let key = message.strip_prefix("duplicate field `")?.strip_suffix('`')?;
    let both = match key {
        "slave" => "`slave` and `secondary`",
        "master" => "`master` and `main`",
        _ => return None,
    };
    Some((format!("{both} are two names of one node, and both are given"), "leave one of the two out".to_owned()))
}

fn wrong_kind(message: &str, written: Option<&str>) -> Option<(String, String)> {
    let (found, expected) = if let Some(rest) = message.strip_prefix("invalid type: ") {
        rest.rsplit_once(", expected ")?
    } else if let Some(rest) = message.strip_prefix("invalid length ") {
        ("a list of another length", rest.split_once(", expected ")?.1)
    } else {
        ("something else", message.strip_prefix("expected ")?)
    };
    let expected = match expected {
        "f64" => "a number",
        "a boolean" => "`true` or `false`",
        "a string" => "a text in quotes",
        other => other,
    };
    let found = written.map_or_else(|| found.to_owned(), |written| format!("`{written}`"));
    Some((format!("{found} stands where there should be {expected}"), String::new()))
}

/// The question whether one of the names was meant, where one is near, and what else to do.
pub(crate) fn meant_or<'name>(written: &str, names: impl IntoIterator<Item = &'name str>, else_do: &str) -> String {
    let near = nearest_names(written.as_bytes(), names, 3);
    if near.is_empty() {
        return else_do.to_owned();
    }
    let near: Vec<String> = near.iter().map(|name| format!("`{name}`")).collect();
    let question = format!("is {} meant?", near.join(" or "));
    let mut rest = else_do.chars();
    rest.next()
        .map_or_else(|| question.clone(), |first| format!("{question} {}{}", first.to_uppercase(), rest.as_str()))
}

/// What stands in backticks.
pub(super) fn quoted(text: &str) -> impl Iterator<Item = &str> {
    text.split('`').skip(1).step_by(2)
}

fn listed(names: &[&str]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}
