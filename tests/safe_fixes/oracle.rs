//! A second reading of a deck, line by line, written from the semantics and not from the parser.
//!
//! It knows lines (S-02 to S-08), keyword lines and their continuation (S-10 to S-19), titles (S-70, S-72), and the rows of
//! the contact tables (K-50 to K-55); every other row is its text.
//! The flags of a keyword are read from the keyword files, as text.

use super::mutation::project;
use std::collections::{HashMap, HashSet};

/// A reading of a deck: its options in order.
pub(crate) type Reading = Vec<OptionRead>;

/// A keyword line with what stands after it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct OptionRead {
    /// The keyword in full, without blanks.
    keyword: String,
    /// Its parameters, without blanks.
    parameters: Vec<String>,
    /// A line after a comma at the end of the keyword line that may be a flag of it, for all that is known.
    may_go_on: Option<String>,
    /// The rows of a table, or the lines as they are.
    rows: Vec<String>,
}

/// The part of a keyword file on which a continuation depends.
#[derive(Debug, Default)]
struct Flags {
    names: Vec<String>,
    all: HashSet<String>,
    is_complete: bool,
    is_text: bool,
}

/// The keyword language as the oracle knows it.
pub(crate) struct Language {
    names: Vec<String>,
    flags: HashMap<String, Flags>,
}

impl Language {
    /// Reads the lists and files of the project.
    pub(crate) fn read() -> Self {
        let names = std::fs::read_to_string(project().join("grammar/names/abaqus.txt")).expect("the list of names");
        let names = names.lines().filter(|line| !line.starts_with('#')).map(squeezed).filter(|name| !name.is_empty());
        let mut flags = HashMap::new();
        for text in super::mutation::files(&project().join("grammar/keywords"), "toml") {
            let (name, found) = flags_of(&String::from_utf8(text).expect("UTF-8"));
            flags.insert(name, found);
        }
        Self { names: names.collect(), flags }
    }

    /// The keyword in full that a word begins (S-13).
    fn in_full(&self, written: &str) -> String {
        if self.names.iter().any(|name| name == written) || written.is_empty() {
            return written.to_owned();
        }
        let mut begun = self.names.iter().filter(|name| name.starts_with(written));
        match (begun.next(), begun.next()) {
            (Some(only), None) => only.clone(),
            _ => written.to_owned(),
        }
    }

    /// The reading of the line after a comma (S-19): as parameters, perhaps as such, or not.
    fn after_comma(&self, keyword: &str, line: &str) -> NextLine {
        let known = self.flags.get(keyword);
        let is_complete = known.is_some_and(|known| known.is_complete);
        let items: Vec<&str> = split(line).into_iter().map(trimmed).filter(|item| !item.is_empty()).collect();
        if items.is_empty() {
            let is_blank = trimmed(line).is_empty();
            return if is_blank && !is_complete { NextLine::Perhaps } else { NextLine::Rows };
        }
        let begins = |item: &str| {
            let word = squeezed(item.split('=').next().unwrap_or(item));
            let known = known?;
            if let Some(exact) = known.names.iter().find(|name| **name == word) {
                return Some(exact.clone());
            }
            let mut begun = known.names.iter().filter(|name| !word.is_empty() && name.starts_with(&word));
            match (begun.next(), begun.next()) {
                (Some(only), None) => Some(only.clone()),
                _ => None,
            }
        };
        let is_parameter = |item: &&str| match (begins(item), item.contains('=')) {
            (Some(_), true) => true,
            (Some(name), false) => known.is_some_and(|known| known.all.contains(&name)),
            (None, has_value) => has_value && !(is_complete && known.is_some_and(|known| known.is_text)),
        };
        if items.iter().any(|item| item.contains('=')) {
            return if items.iter().any(is_parameter) { NextLine::Parameters } else { NextLine::Rows };
        }
        if items.iter().all(is_parameter) {
            return NextLine::Parameters;
        }
        let like_a_flag = |item: &&str| {
            item.starts_with(|first: char| first.is_ascii_alphabetic())
                && item.chars().all(|letter| letter.is_ascii_alphanumeric() || " \t-_".contains(letter))
        };
        if !is_complete && items.iter().all(like_a_flag) { NextLine::Perhaps } else { NextLine::Rows }
    }
}

/// Whether the lines after a keyword are its title (S-70, S-72).
fn is_title(keyword: &str) -> bool {
    matches!(keyword, "HEADING" | "STEP")
}

/// Readings of a line after a comma.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum NextLine {
    Parameters,
    Perhaps,
    Rows,
}

/// Reads a deck.
pub(crate) fn read(bytes: &[u8], language: &Language) -> Reading {
    // A byte order mark at the beginning is no part of the text.
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    // Every byte is a character, so that nothing depends on an encoding.
    let text: String = bytes.iter().copied().map(char::from).collect();
    let text = text.replace("\r\n", "\n").replace('\r', "\n");
    let lines: Vec<&str> = text.split('\n').collect();
    let mut reading = vec![OptionRead { keyword: String::new(), parameters: vec![], may_go_on: None, rows: vec![] }];
    let mut at = 0;
    while at < lines.len() {
        let line = lines[at];
        at += 1;
        let begun = trimmed_start(line);
        let open = reading.last_mut().expect("there is always one");
        let is_title = is_title(&open.keyword);
        match () {
            () if line.starts_with("**") => {}
            () if begun.starts_with("**") && !is_title => {}
            () if begun.starts_with("**") => open.rows.push(trimmed(line).to_owned()),
            () if begun.starts_with('*') => {
                let (option, next) = keyword_line(&lines, at - 1, language);
                reading.push(option);
                at = next;
            }
            // A blank line is a line of a title, and of *SURFACE INTERACTION (K-02); among other rows it is skipped (S-08).
            () if begun.is_empty() && !is_title && open.keyword != "SURFACEINTERACTION" => {}
            () => open.rows.push(trimmed(line).to_owned()),
        }
    }
    for option in &mut reading {
        in_table_rows(option);
        if option.rows.last().is_some_and(String::is_empty) {
            // There is no line after the last line end.
            option.rows.pop();
        }
    }
    reading
}

/// A keyword line with the lines that continue it, and the number of the line after.
fn keyword_line(lines: &[&str], first: usize, language: &Language) -> (OptionRead, usize) {
    let mut logical = trimmed(lines[first]).to_owned();
    let name = |logical: &str| {
        let word =
            split(logical.trim_start_matches([' ', '\t', '\x0C'])).first().map_or(String::new(), |word| squeezed(word));
        language.in_full(word.strip_prefix('*').unwrap_or(&word))
    };
    let keyword = name(&logical);
    let mut next = first + 1;
    let mut may_go_on = None;
    while logical.ends_with(',') {
        let after = (next..lines.len()).find(|at| !trimmed_start(lines[*at]).starts_with("**"));
        // There is no line after the last line end.
        let Some(at) = after.filter(|at| *at + 1 < lines.len() || !lines[*at].is_empty()) else { break };
        if trimmed_start(lines[at]).starts_with('*') {
            break;
        }
        match language.after_comma(&keyword, lines[at]) {
            NextLine::Parameters => {
                logical += " ";
                logical += trimmed(lines[at]);
                next = at + 1;
            }
            NextLine::Perhaps => {
                may_go_on = Some(trimmed(lines[at]).to_owned());
                break;
            }
            NextLine::Rows => break,
        }
    }
    let parameters = split(&logical).into_iter().skip(1).map(without_blanks).filter(|item| !item.is_empty());
    (OptionRead { keyword, parameters: parameters.collect(), may_go_on, rows: Vec::new() }, next)
}

/// Puts the rows of a contact table together from their lines (K-50 to K-55).
fn in_table_rows(option: &mut OptionRead) {
    let lead = match option.keyword.as_str() {
        "GAPELECTRICALCONDUCTANCE" => 3,
        "GAPCONDUCTANCE" | "CONTACTPERMEABILITY" | "GAPDIFFUSIVITY" => 4,
        _ => return,
    };
    let count = option.parameters.iter().rev().find_map(|parameter| {
        let (name, value) = parameter.split_once('=')?;
        "DEPENDENCIES".starts_with(&name.to_ascii_uppercase()).then(|| value.to_owned())
    });
    let Ok(count) = count.unwrap_or_else(|| "0".to_owned()).parse::<usize>() else { return };
    let width = lead + count;
    let lines = 1 + width.saturating_sub(8).div_ceil(8);
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut line_of_row = 0;
    for line in std::mem::take(&mut option.rows) {
        let mut items: Vec<String> = split(&line).iter().map(|item| trimmed(item).to_owned()).collect();
        while items.last().is_some_and(String::is_empty) {
            items.pop();
        }
        let is_whole = lines > 1 && line_of_row == 0 && items.len() == width;
        let room = if line_of_row == 0 { width.min(8) } else { (width - 8 * line_of_row).min(8) };
        if !is_whole && items.len() < room {
            items.resize(room, String::new());
        }
        if line_of_row == 0 {
            rows.push(Vec::new());
        }
        rows.last_mut().expect("a row has begun").extend(items);
        line_of_row = if is_whole || line_of_row + 1 == lines { 0 } else { line_of_row + 1 };
    }
    option.rows = rows.into_iter().map(|row| row.join("|")).collect();
}

/// The parameters of a keyword file: a few keys, read line by line.
fn flags_of(toml: &str) -> (String, Flags) {
    let mut flags = Flags { is_complete: true, ..Flags::default() };
    let (mut keyword, mut section, mut parameter) = (String::new(), String::new(), String::new());
    for line in toml.lines() {
        if line.starts_with('[') {
            line.clone_into(&mut section);
        }
        let Some((key, value)) = line.split_once(" = ") else { continue };
        let value = value.trim_matches('"');
        match (section.as_str(), key) {
            ("", "name") => keyword = squeezed(value),
            ("", "parameters_complete") => flags.is_complete = value == "true",
            ("[[parameters]]", "name") => {
                parameter = squeezed(value);
                flags.names.push(parameter.clone());
            }
            ("[[parameters]]", "kind") if value == "flag" => drop(flags.all.insert(parameter.clone())),
            ("[[parameters]]", "value_optional") if value == "true" => drop(flags.all.insert(parameter.clone())),
            ("[data]", "shape") => flags.is_text = value == "text",
            _ => {}
        }
    }
    (keyword, flags)
}

/// The items between commas that stand neither in quotes nor in closed parentheses.
fn split(line: &str) -> Vec<&str> {
    let mut items = Vec::new();
    let (mut start, mut at) = (0, 0);
    let bytes = line.as_bytes();
    while at < bytes.len() {
        match bytes[at] {
            b',' => {
                items.push(&line[start..at]);
                start = at + 1;
            }
            b'"' => at = line[at + 1..].find('"').map_or(bytes.len(), |end| at + 1 + end),
            b'(' if trimmed_start(line).starts_with('*') => {
                at = line[at + 1..].find(')').map_or(at, |end| at + 1 + end);
            }
            _ => {}
        }
        at += 1;
    }
    items.push(&line[start.min(line.len())..]);
    items
}

fn is_blank(character: char) -> bool {
    matches!(character, ' ' | '\t' | '\x0C')
}

fn trimmed(line: &str) -> &str {
    line.trim_matches(is_blank)
}

fn trimmed_start(line: &str) -> &str {
    line.trim_start_matches(is_blank)
}

/// Upper case, without blanks.
fn squeezed(text: &str) -> String {
    text.chars().filter(|character| !is_blank(*character)).map(|character| character.to_ascii_uppercase()).collect()
}

/// Without the blanks outside quotes.
fn without_blanks(text: &str) -> String {
    let mut quoted = false;
    let keeps = |character: &char| {
        quoted ^= *character == '"';
        quoted || !is_blank(*character)
    };
    text.chars().filter(keeps).collect()
}
