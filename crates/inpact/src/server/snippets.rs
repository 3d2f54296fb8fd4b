//! Snippets: a keyword as it appears in a deck, with placeholders.
//!
//! Made from the example that the grammar has for each keyword, which is checked by a test: rows of a snippet are legal rows.

use inpact_parser::deck::lines::without_line_end;
use inpact_parser::deck::{Block, Deck, KeywordLine, scan};
use inpact_parser::grammar::{Definition, Grammar, ParameterDefinition, ParameterKind, RowShape};
use inpact_parser::span::Span;

/// The keyword with its parameters and rows, as a snippet; the name alone where the example has nothing more.
pub(super) fn of_keyword(definition: &Definition, grammar: &Grammar) -> String {
    let example = format!("{}\n", definition.example.trim());
    let deck = scan("example", example.as_bytes(), grammar);
    let is_meant = |block: &&Block| block.keyword_id().is_some_and(|id| grammar.keyword(id).name == definition.name);
    let mut snippet = Snippet { text: String::new(), next: 1 };
    let Some(block) = deck.blocks().iter().find(is_meant) else { return format!("*{}", definition.name) };
    snippet.keyword(&deck, block, definition);
    let rows = deck.data_lines(block).filter(|line| !line.is_blank());
    for line in rows {
        snippet.text.push('\n');
        if definition.rows() == RowShape::Text {
            snippet.place(&deck.shown(line.span));
        } else {
            snippet.row(&deck, line.span, line.text, line.items());
        }
    }
    snippet.text
}

/// A parameter with its value, as a snippet.
pub(super) fn of_parameter(parameter: &ParameterDefinition) -> String {
    let value = match parameter.kind {
        ParameterKind::Flag => return escaped(&parameter.name),
        // Existing names and files are offered by completion.
        ParameterKind::Label | ParameterKind::File => "$1".to_owned(),
        ParameterKind::Choice => {
            let choices: Vec<String> = parameter.choices.iter().map(|choice| escaped(choice)).collect();
            format!("${{1|{}|}}", choices.join(","))
        }
        _ => {
            parameter.default.as_ref().map_or_else(|| "$1".to_owned(), |default| format!("${{1:{}}}", escaped(default)))
        }
    };
    format!("{}={value}", escaped(&parameter.name))
}

struct Snippet {
    text: String,
    /// The number of the next placeholder.
    next: usize,
}

impl Snippet {
    fn keyword(&mut self, deck: &Deck, block: &Block, definition: &Definition) {
        self.text += &format!("*{}", definition.name);
        let given = block.keyword.iter().flat_map(KeywordLine::parameters);
        for parameter in given {
            let name = parameter
                .index()
                .map_or_else(|| deck.shown(parameter.name), |index| definition.parameters[index].name.clone());
            self.text += &format!(", {}", escaped(&name));
            if let Some(value) = parameter.value {
                self.text.push('=');
                self.place(&deck.shown(value));
            }
        }
    }

    /// A row whose items are placeholders, with the text between them.
    fn row(&mut self, deck: &Deck, line: Span, text: &[u8], items: impl Iterator<Item = Span>) {
        let mut from = line.start();
        for item in items {
            self.text += &escaped(&deck.shown(Span::new(line.source(), from, item.start())));
            if !item.is_empty() {
                self.place(&deck.shown(item));
            }
            from = item.end();
        }
        let end = line.start() + without_line_end(text).len() as u64;
        self.text += escaped(&deck.shown(Span::new(line.source(), from, end))).trim_end();
    }

    fn place(&mut self, text: &str) {
        self.text += &format!("${{{}:{}}}", self.next, escaped(text));
        self.next += 1;
    }
}

/// An escaped text in a snippet.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        if matches!(character, '$' | '}' | '\\' | '|') {
            escaped.push('\\');
        }
        escaped.push(character);
    }
    escaped
}

/// A snippet without placeholders, for editors without snippet support.
pub(super) fn plain(snippet: &str) -> String {
    let mut text = String::new();
    let mut characters = snippet.chars().peekable();
    while let Some(character) = characters.next() {
        match character {
            '\\' => text.extend(characters.next()),
            '$' => {
                if characters.next_if_eq(&'{').is_none() {
                    while characters.next_if(char::is_ascii_digit).is_some() {}
                    continue;
                }
                while characters.next_if(char::is_ascii_digit).is_some() {}
                // `:` before a default, `|` before choices, of which the first is taken.
                let is_choice = characters.next() == Some('|');
                let mut is_first = true;
                while let Some(inner) = characters.next_if(|inner| *inner != '}') {
                    match inner {
                        '\\' => text.extend(characters.next().filter(|_| is_first)),
                        ',' | '|' if is_choice => is_first = false,
                        other if is_first => text.push(other),
                        _ => {}
                    }
                }
                characters.next();
            }
            other => text.push(other),
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use inpact_parser::model;
    use inpact_validation::{Severity, check};

    #[test]
    fn a_table_with_places() {
        let grammar = Grammar::builtin();
        let definition = |name: &str| grammar.keyword(grammar.id_of(name).unwrap()).definition().unwrap();
        let snippet = of_keyword(definition("GAP CONDUCTANCE"), grammar);
        assert_eq!(snippet, "*GAP CONDUCTANCE\n${1:20.}, ${2:0.}\n${3:10.}, ${4:0.1}");
        assert_eq!(plain(&snippet), "*GAP CONDUCTANCE\n20., 0.\n10., 0.1");
        let parameter = definition("CONTACT PERMEABILITY").parameter("CONSTRAINT METHOD").unwrap();
        assert_eq!(of_parameter(parameter), "CONSTRAINT METHOD=${1|DIRECT,PENALTY|}");
        assert_eq!(plain(&of_parameter(parameter)), "CONSTRAINT METHOD=DIRECT");
    }

    #[test]
    fn what_snippets_insert_is_legal() {
        let grammar = Grammar::builtin();
        for definition in grammar.keywords().filter_map(|(_, keyword)| keyword.definition()) {
            let parent =
                if definition.has_parent("SURFACE INTERACTION") { "*SURFACE INTERACTION, NAME=A\n" } else { "" };
            let text = format!("{parent}{}\n", plain(&of_keyword(definition, grammar)));
            let deck = scan("snippet", text.as_bytes(), grammar);
            let (model, problems) = model::read(&deck, grammar);
            // Its references and context are elsewhere: only rows and parameters matter.
            let of_rows = |code: &str| {
                matches!(code.as_bytes()[0], b'T') || matches!(code, "S006" | "S007" | "K004" | "K007" | "K010")
            };
            let wrong: Vec<String> = check(&deck, grammar, &model, &problems)
                .into_iter()
                .filter(|found| found.severity == Severity::Error && of_rows(found.code))
                .map(|found| format!("{} {}", found.code, found.message))
                .collect();
            assert_eq!(wrong, Vec::<String>::new(), "{text}");
        }
    }
}
