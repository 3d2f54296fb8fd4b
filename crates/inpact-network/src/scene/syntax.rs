//! Syntax errors in the TOML of a scene file: all of them in one pass, with our messages.
//!
//! The TOML parser recovers from errors and gives their places; the message is derived from the text there.
//! Faulty lines are read as empty, so that the rest of the scene can be read and its problems reported in the same run.

use super::rules::MALFORMED_SCENE;
use super::shape::{Part, Problem, expected_of};
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::ops::Range;
use toml::de::DeTable;

/// The maximum length of a quotation.
const LONGEST_QUOTE: usize = 40;

/// The text of a scene file with faulty lines removed.
pub(super) struct Sound<'t> {
    /// The text; faulty lines are blanked, so that offsets are unchanged. `None` where there are too many faults.
    pub(super) text: Option<Cow<'t, str>>,
    /// The removed lines, in ascending order.
    pub(super) without: Vec<usize>,
    /// The problems, in the order of the text.
    pub(super) problems: Vec<Problem>,
}

/// The maximum number of parses of the text: after a key without a value the parser sees further keys and values only once it is removed.
const MAX_PASSES: usize = 4;

/// The maximum number of places reported; more of a kind are counted.
const MAX_SAID: usize = 100;

/// The maximum nesting of lists and tables, which is that of the TOML parser.
const DEEPEST: usize = 80;

/// Finds syntax errors of TOML.
pub(super) fn sound(text: &str) -> Sound<'_> {
    let mut sound = Sound { text: None, without: Vec::new(), problems: Vec::new() };
    let mut rest = Cow::Borrowed(text);
    for _ in 0..MAX_PASSES {
        let places = places(&rest);
        if places.is_empty() {
            sound.text = Some(rest);
            break;
        }
        let Some(sounder) = take_out(text, rest.into_owned(), places, &mut sound) else { break };
        rest = Cow::Owned(sounder);
    }
    sound.problems.sort_by_key(|problem| problem.at);
    sound
}

/// Reports the faults at some places, and blanks their lines; `None` where there is nothing left to remove.
fn take_out(text: &str, rest: String, places: Vec<Range<usize>>, sound: &mut Sound<'_>) -> Option<String> {
    let mut rest = rest.into_bytes();
    let before = sound.without.len();
    let mut without: BTreeSet<usize> = std::mem::take(&mut sound.without).into_iter().collect();
    for place in places {
        let line = line_at(text, place.start);
        // The rest of a faulty line is not reported.
        if !without.insert(line.start) {
            continue;
        }
        // More are only counted.
        let is_seen = sound.problems.len() < MAX_SAID;
        let (message, help) = if is_seen { said(text, &line, &place) } else { ("no TOML".to_owned(), String::new()) };
        sound.problems.push(Problem { at: place.start, rule: &MALFORMED_SCENE, message, help });
        rest[line.clone()].fill(b' ');
    }
    sound.without.extend(without);
    // Whole lines of UTF-8 were replaced.
    String::from_utf8(rest).ok().filter(|_| before < sound.without.len())
}

/// The places of parse errors, in ascending order.
fn places(text: &str) -> Vec<Range<usize>> {
    let (_, errors) = DeTable::parse_recoverable(text);
    let mut places: Vec<_> = errors.iter().map(|error| error.span().unwrap_or(text.len()..text.len())).collect();
    places.sort_by_key(|place| (place.start, place.end));
    places
}

/// The line of a byte, without its end; the last non-empty one at the end of the text.
fn line_at(text: &str, at: usize) -> Range<usize> {
    let end = if at < text.len() { at } else { text.trim_end().len() };
    let start = text[..floor(text, end)].rfind('\n').map_or(0, |before| before + 1);
    let end = text[start..].find('\n').map_or(text.len(), |length| start + length);
    start..end
}

/// The last character boundary at or before a byte.
fn floor(text: &str, at: usize) -> usize {
    (0..=at.min(text.len())).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0)
}

/// The problem at a place of a line, and its help.
fn said(text: &str, line: &Range<usize>, place: &Range<usize>) -> (String, String) {
    let written = &text[line.clone()];
    let at = floor(written, place.start.clamp(line.start, line.end) - line.start);
    let none = String::new();
    if written.trim_start().starts_with('[') && !written[..at].contains('=') {
        return heading(written, &text[..line.start], at, place);
    }
    let Some(equals) = equals_before(written, at) else { return key(written, at, place) };
    let open = open_brackets(&written[..at]);
    if DEEPEST <= open.len() {
        return (
            format!("lists and tables lie more than {DEEPEST} deep in one another, the most that is read"),
            "no value of a scene lies deeper than three lists: close each where it ends".to_owned(),
        );
    }
    let open = open.last().copied();
    if open == Some('{') && written[..at].trim_end().ends_with(['{', ',']) {
        return key(written, at, place);
    }
    let name = written[..equals].trim_end().rsplit([' ', '\t', '{', ',']).next().unwrap_or_default();
    let rest = &written[equals + 1..];
    if let Some(quote) = open_quote(rest) {
        return (format!("`{}` has no closing `{quote}`", quoted(rest.trim())), format!("close it with `{quote}`"));
    }
    let value = written[equals + 1..at].trim();
    let found = word(&written[at..]);
    let found = if found.is_empty() { "the end of the line".to_owned() } else { format!("`{}`", quoted(found)) };
    let is_open = value.is_empty() || value.ends_with(['[', '{', ',']);
    if is_open || !place.is_empty() {
        // The place may lie inside of a number.
        let whole = if place.is_empty() { found } else { whole_word(written, equals + 1, at).unwrap_or(found) };
        let part = if value.contains('[') { Part::Inside } else { Part::Whole };
        let expected = expected_of(heading_before(&text[..line.start]), name, part);
        let expected = expected.unwrap_or_else(|| "a number, a text in quotes, a list or a table".to_owned());
        return (format!("expected {expected}, found {whole}"), none);
    }
    let expected = match open {
        Some('[') => "`,` or `]`".to_owned(),
        Some(_) => "`,` or `}`".to_owned(),
        None => format!("the end of the line after the value of `{}`", quoted(name)),
    };
    (format!("expected {expected}, found {found}"), none)
}

/// The name of the last heading of a text.
fn heading_before(text: &str) -> Option<&str> {
    let last = text.lines().map(str::trim_start).rfind(|line| line.starts_with('['))?;
    last.trim_start_matches('[').split([']', '.', '#']).next().map(str::trim)
}

/// The problem of a heading.
fn heading(written: &str, before: &str, at: usize, place: &Range<usize>) -> (String, String) {
    let shown = quoted(written.trim());
    let is_whole = place.len() == whole_key(&written[at..])
        && !place.is_empty()
        && written[at + place.len()..].trim_start().starts_with(']');
    let is_repeated = before.lines().any(|line| line.trim() == written.trim());
    if is_whole {
        let help = if is_repeated {
            "leave one of the two out"
        } else {
            "a name is either that of one table, `[…]`, or that of a list of tables, `[[…]]`"
        };
        return (format!("`{shown}` is given twice"), help.to_owned());
    }
    (format!("expected a heading such as `[time]` or `[[node]]`, found `{shown}`"), String::new())
}

/// The problem where a key should be.
fn key(written: &str, at: usize, place: &Range<usize>) -> (String, String) {
    let length = whole_key(&written[at..]);
    let rest = written[at + length..].trim_start();
    let is_key = 0 < length && place.len() == length && rest.starts_with(['=', '.']);
    let is_alone = written.matches('=').count() < 2;
    if is_key {
        return (
            format!("`{}` is given twice", quoted(&written[at..at + length])),
            "leave one of the two out".to_owned(),
        );
    }
    let shown = quoted(written.trim());
    match written.split_once('=').filter(|_| is_alone) {
        Some((key, _)) if key.trim().is_empty() => {
            (format!("expected a key before `=`, found `{shown}`"), String::new())
        }
        Some((key, _)) => {
            (format!("expected a key of letters, digits, `_` and `-`, found `{}`", quoted(key.trim())), String::new())
        }
        None => (format!("expected a key with `=` and its value, found `{shown}`"), String::new()),
    }
}

/// The last `=` before a place of a line, outside of quotes.
fn equals_before(written: &str, at: usize) -> Option<usize> {
    let mut open = None;
    let mut found = None;
    for (place, character) in written[..at].char_indices() {
        match (open, character) {
            (None, '"' | '\'') => open = Some(character),
            (Some(quote), _) if quote == character => open = None,
            (None, '=') => found = Some(place),
            _ => {}
        }
    }
    found
}

/// The open brackets of a part of a line, innermost last.
fn open_brackets(before: &str) -> Vec<char> {
    let mut open = Vec::new();
    let mut quote = None;
    for character in before.chars() {
        match (quote, character) {
            (None, '"' | '\'') => quote = Some(character),
            (Some(closing), _) if closing == character => quote = None,
            (None, '[' | '{') => open.push(character),
            (None, ']' | '}') => drop(open.pop()),
            _ => {}
        }
    }
    open
}

/// The unclosed quote.
fn open_quote(text: &str) -> Option<char> {
    let mut open = None;
    let mut is_escaped = false;
    for character in text.chars() {
        match (open, character) {
            (Some('"'), '\\') if !is_escaped => {
                is_escaped = true;
                continue;
            }
            (None, '#') => return None,
            (None, '"' | '\'') => open = Some(character),
            (Some(quote), _) if quote == character && !is_escaped => open = None,
            _ => {}
        }
        is_escaped = false;
    }
    open
}

/// The value at a place, up to its separator.
fn whole_word(written: &str, from: usize, at: usize) -> Option<String> {
    let start = written[from..at].rfind([' ', '\t', ',', '[', '{', '=']).map_or(from, |before| from + before + 1);
    let found = word(&written[start..]);
    (!found.is_empty()).then(|| format!("`{}`", quoted(found)))
}

/// The beginning of a text, up to a comma, a closing bracket or a comment.
fn word(text: &str) -> &str {
    let text = text.trim_start();
    let end = match text.chars().next() {
        Some(bracket @ ('[' | '{' | ']' | '}' | ',')) => bracket.len_utf8(),
        _ => text.find([',', ']', '}', '#']).unwrap_or(text.len()),
    };
    text[..end].trim_end()
}

/// The length of the key, bare or in quotes, that a text begins with.
fn whole_key(text: &str) -> usize {
    match text.chars().next() {
        Some(quote @ ('"' | '\'')) => text[1..].find(quote).map_or(0, |end| end + 2),
        _ => text.find(|end: char| !(end.is_ascii_alphanumeric() || matches!(end, '_' | '-'))).unwrap_or(text.len()),
    }
}

/// The beginning of a text, for a message.
fn quoted(text: &str) -> Cow<'_, str> {
    if text.chars().count() <= LONGEST_QUOTE {
        return Cow::Borrowed(text);
    }
    Cow::Owned(text.chars().take(LONGEST_QUOTE).chain(['…']).collect())
}

#[cfg(test)]
mod tests {
    use super::sound;

    fn said(text: &str) -> Vec<String> {
        sound(text).problems.into_iter().map(|problem| format!("{}: {}", problem.at, problem.message)).collect()
    }

    fn check(text: &str, expected: &[&str]) {
        assert_eq!(said(text), expected, "{text}");
    }

    /// Checks the message about a line of an interface.
    fn in_interface(line: &str, expected: &str) {
        let text = format!("[[interface]]\n{line}\nslave = \"a\"\n");
        let found = sound(&text).problems;
        assert_eq!(found.len(), 1, "{text}");
        assert_eq!(found[0].message, expected, "{text}");
    }

    #[test]
    fn values() {
        in_interface("area = x", "expected a number, found `x`");
        in_interface("area = 1.0.0", "expected a number, found `1.0.0`");
        in_interface("area = # none", "expected a number, found the end of the line");
        in_interface("area =", "expected a number, found the end of the line");
        in_interface("area = 1 2", "expected a number, found `1 2`");
        in_interface(
            "interaction = \"a\" \"b\"",
            "expected the end of the line after the value of `interaction`, found `\"b\"`",
        );
        in_interface("clearance = { fixed = 1.0, fixed = 2.0 }", "`fixed` is given twice");
        in_interface("closed = yes", "expected `true` or `false`, found `yes`");
        in_interface("interaction = \"COND", "`\"COND` has no closing `\"`");
        in_interface("fv = [1.0 2.0]", "expected a number, found `1.0 2.0`");
        in_interface("clearance = [[0.0, 1.0] [2.0, x]]", "expected `,` or `]`, found `[`");
        in_interface("foo = bar", "expected a number, a text in quotes, a list or a table, found `bar`");
        check("deck = joint.inp\n", &["7: expected a text in quotes, found `joint.inp`"]);
        check("[initial]\ntemperature = 1.0.0\n", &["27: expected a number, found `1.0.0`"]);
        let course = "a number, or points of time and value such as [[0.0, 20.0], [1.0, 80.0]]";
        check("[[node]]\ntemperature = { fixed = warm }\n", &[&format!("33: expected {course}, found `warm`")]);
    }

    #[test]
    fn keys_and_headings() {
        check("area\n", &["4: expected a key with `=` and its value, found `area`"]);
        check("= 5\n", &["0: expected a key before `=`, found `= 5`"]);
        check("a b = 5\n", &["2: expected a key of letters, digits, `_` and `-`, found `a b`"]);
        check("area = 1\narea = 2\n", &["9: `area` is given twice"]);
        check("[time]\nend = 1\n[time]\n", &["16: `[time]` is given twice"]);
        check("[[node]\nname = \"a\"\n", &["7: expected a heading such as `[time]` or `[[node]]`, found `[[node]`"]);
    }

    #[test]
    fn values_that_lie_too_deep() {
        for (open, close) in [("[", "]"), ("{ a = ", "}")] {
            let text = |deep: usize| format!("x = {}1{}\n", open.repeat(deep), close.repeat(deep));
            let found = said(&text(super::DEEPEST + 1));
            assert!(
                found[0].ends_with("lists and tables lie more than 80 deep in one another, the most that is read"),
                "{found:?}"
            );
            check(&text(super::DEEPEST - 1), &[]);
        }
    }

    /// All places in one pass, and the rest is kept.
    #[test]
    fn all_of_them() {
        let text = "deck = joint.inp\n[[node]]\nname = \"a\"\narea\n[[node]]\nname = \"b\"\narea = ü\n";
        let sound = sound(text);
        assert_eq!(sound.problems.len(), 3);
        let rest = sound.text.expect("the rest is sound");
        assert_eq!(rest.len(), text.len());
        assert_eq!(rest.matches("[[node]]").count(), 2);
        assert_eq!(sound.without.len(), 3);
    }
}
