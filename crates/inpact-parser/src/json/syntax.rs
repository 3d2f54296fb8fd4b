//! The lossless view: every line of every file, unchanged.
//!
//! A line is a string when it is UTF-8 and has the most common line end of its file; otherwise it is an object with
//! its bytes or its line end. Derived fields (`keyword`, `parameters`) are for readers;
//! when the JSON is read back they must still agree with the lines, so that an edit to them is rejected rather than ignored.
//! `schema/syntax.schema.json` is generated from the types here, and a test keeps it up to date.

use super::{layout, parse, required};
use crate::Error;
use crate::deck::lines::{lines, without_line_end};
use crate::deck::{Block, Deck, scan};
use crate::grammar::Grammar;
use serde::{Deserialize, Serialize};

/// The value of the `schema` field.
pub const SCHEMA: &str = "inpact/syntax/1";

/// The lossless view of a deck: every line of every file as it is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Lossless view of a deck"))]
#[serde(deny_unknown_fields, expecting = "a document: an object")]
struct Document {
    /// The kind of document, and the number of its form.
    #[cfg_attr(test, schemars(extend("const" = SCHEMA)))]
    schema: String,
    /// The deck, then the files it includes.
    files: Vec<File>,
}

/// One source file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "file"))]
#[serde(deny_unknown_fields, expecting = "a file: an object")]
struct File {
    /// The name of the file.
    source: String,
    /// The line end of every line that does not say another.
    line_end: String,
    /// The blocks, in order; the lines of all of them are the file.
    blocks: Vec<BlockDocument>,
}

/// A keyword line and the lines after it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "block"))]
#[serde(deny_unknown_fields, expecting = "a block: an object")]
struct BlockDocument {
    /// The keyword in full, for reading only: it follows from the lines. `null` when it is unknown or there is none.
    #[serde(deserialize_with = "required")]
    keyword: Option<String>,
    /// The parameters of the keyword line, for reading only: they follow from the lines.
    parameters: Vec<ParameterDocument>,
    /// The physical lines of the keyword line.
    keyword_lines: Vec<Line>,
    /// The lines after it, up to the next keyword line, comments included.
    rows: Vec<Line>,
}

/// A parameter as it is written.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "parameter"))]
#[serde(deny_unknown_fields, expecting = "a parameter: an object")]
struct ParameterDocument {
    /// Its name.
    name: String,
    /// Its value; `null` for a flag.
    #[serde(deserialize_with = "required")]
    value: Option<String>,
}

/// A line: a text, or an object where its line end or its bytes have to be said.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "line"))]
#[serde(untagged, expecting = "expected a line: a text, an object of `text` and `end`, or one of `bytes` and `end`")]
enum Line {
    Plain(String),
    Ended(EndedLine),
    Bytes(ByteLine),
}

/// A line with a line end of its own.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "line_with_its_end"))]
#[serde(deny_unknown_fields, expecting = "a line with its end: an object")]
struct EndedLine {
    /// The line without its end.
    text: String,
    /// Its end; empty for a last line without one.
    end: String,
}

/// A line that is not UTF-8.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "line_of_bytes"))]
#[serde(deny_unknown_fields, expecting = "a line of bytes: an object")]
struct ByteLine {
    /// The bytes of the line without its end.
    bytes: Vec<u8>,
    /// Its end; empty for a last line without one.
    end: String,
}

/// The lossless view of a deck that was scanned with everything kept, as pretty-printed JSON.
pub fn write(deck: &Deck, grammar: &Grammar) -> String {
    let mut blocks_of: Vec<Vec<&Block>> = vec![Vec::new(); deck.sources().len()];
    for block in deck.blocks() {
        blocks_of[block.rows().source().0 as usize].push(block);
    }
    let files = deck.sources().iter().zip(blocks_of).map(|(source, blocks)| {
        let line_end = usual_line_end(deck, &blocks);
        let mut documents: Vec<BlockDocument> = Vec::new();
        for block in blocks {
            let document = block_document(deck, grammar, block, line_end);
            match documents.last_mut() {
                // Rows after an *INCLUDE go on with another block (S-51), but in their file they follow its line.
                Some(before) if block.keyword.is_none() => before.rows.extend(document.rows),
                _ => documents.push(document),
            }
        }
        File { source: source.name().to_owned(), line_end: line_end.to_owned(), blocks: documents }
    });
    let document = Document { schema: SCHEMA.to_owned(), files: files.collect() };
    layout::to_string(&document)
}

/// Reads the lossless view back: the files by name, each with its bytes.
///
/// # Errors
/// JSON that is not of this view, or whose `keyword` and `parameters` say something else than its lines.
pub fn read(text: &str, grammar: &Grammar) -> Result<Vec<(String, Vec<u8>)>, Error> {
    let document: Document = parse(text)?;
    if document.schema != SCHEMA {
        return Err(Error::json("schema", format!("expected `{SCHEMA}`, found `{}`", document.schema)));
    }
    let files = document.files.into_iter().enumerate().map(|(number, file)| {
        let mut bytes = Vec::new();
        for block in &file.blocks {
            for line in block.keyword_lines.iter().chain(&block.rows) {
                line.write(&file.line_end, &mut bytes);
            }
        }
        compare(&file, &scan(&file.source, &bytes, grammar), grammar, number)?;
        Ok((file.source, bytes))
    });
    files.collect()
}

/// Refuses a file whose derived fields do not follow from its lines.
fn compare(file: &File, deck: &Deck, grammar: &Grammar, number: usize) -> Result<(), Error> {
    let path = format!("files[{number}].blocks");
    if deck.blocks().len() != file.blocks.len() {
        let found = format!("the lines form {} blocks, not {}", deck.blocks().len(), file.blocks.len());
        return Err(Error::json(path, found));
    }
    for (index, (block, stated)) in deck.blocks().iter().zip(&file.blocks).enumerate() {
        let derived = block_document(deck, grammar, block, &file.line_end);
        let path = format!("{path}[{index}]");
        let says = "does not agree with the lines of the block: change the lines instead";
        if derived.keyword != stated.keyword {
            return Err(Error::json(format!("{path}.keyword"), says));
        }
        if derived.parameters != stated.parameters {
            return Err(Error::json(format!("{path}.parameters"), says));
        }
        if derived.keyword_lines.len() != stated.keyword_lines.len() {
            return Err(Error::json(format!("{path}.keyword_lines"), "these lines are no keyword line"));
        }
    }
    Ok(())
}

fn block_document(deck: &Deck, grammar: &Grammar, block: &Block, line_end: &str) -> BlockDocument {
    let keyword = block.keyword.as_ref();
    let parameters = keyword.iter().flat_map(|keyword| keyword.parameters()).map(|parameter| ParameterDocument {
        name: deck.shown(parameter.name),
        value: parameter.value.map(|value| deck.shown(value)),
    });
    BlockDocument {
        keyword: block.keyword_id().map(|id| grammar.keyword(id).name.clone()),
        parameters: parameters.collect(),
        keyword_lines: keyword.map_or_else(Vec::new, |keyword| line_documents(deck.text(keyword.span), line_end)),
        rows: line_documents(deck.text(block.rows()), line_end),
    }
}

fn line_documents(text: &[u8], line_end: &str) -> Vec<Line> {
    lines(text).map(|range| Line::of(&text[range], line_end)).collect()
}

/// The line end that most lines of a file have.
fn usual_line_end(deck: &Deck, blocks: &[&Block]) -> &'static str {
    let (mut line_feeds, mut pairs, mut returns) = (0_u64, 0_u64, 0_u64);
    for block in blocks {
        let keyword = block.keyword.as_ref().map_or(&[][..], |keyword| deck.text(keyword.span));
        for text in [keyword, deck.text(block.rows())] {
            for line in lines(text) {
                match &text[line] {
                    [.., b'\r', b'\n'] => pairs += 1,
                    [.., b'\r'] => returns += 1,
                    [.., b'\n'] => line_feeds += 1,
                    _ => {}
                }
            }
        }
    }
    match () {
        () if pairs > line_feeds && pairs >= returns => "\r\n",
        () if returns > line_feeds => "\r",
        () => "\n",
    }
}

impl Line {
    fn of(line: &[u8], line_end: &str) -> Self {
        let content = without_line_end(line);
        // A line end is ASCII.
        let end = String::from_utf8_lossy(&line[content.len()..]).into_owned();
        match std::str::from_utf8(content) {
            Ok(text) if end == line_end => Self::Plain(text.to_owned()),
            Ok(text) => Self::Ended(EndedLine { text: text.to_owned(), end }),
            Err(_) => Self::Bytes(ByteLine { bytes: content.to_vec(), end }),
        }
    }

    fn write(&self, line_end: &str, bytes: &mut Vec<u8>) {
        match self {
            Self::Plain(text) => bytes.extend_from_slice(format!("{text}{line_end}").as_bytes()),
            Self::Ended(line) => bytes.extend_from_slice(format!("{}{}", line.text, line.end).as_bytes()),
            Self::Bytes(line) => {
                bytes.extend_from_slice(&line.bytes);
                bytes.extend_from_slice(line.end.as_bytes());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_schema_is_fresh() {
        crate::json::schema::check::<super::Document>("syntax.schema.json");
    }
}
