//! The colours of editors that have no server, `editors/vscode/syntaxes`: made from the keywords of the grammar.

use crate::program::root;
use inpact_parser::grammar::Grammar;
use serde_json::{Value, json};

/// The grammar of TextMate for decks: lines of comments, keyword lines with their parameters, rows.
fn textmate() -> Value {
    let names = Grammar::builtin().keywords().map(|(_, keyword)| keyword.name.as_str());
    // Blanks in names carry no meaning; the longest name comes first, so that *GAP does not hide *GAP FLOW.
    let mut names: Vec<String> = names.map(|name| name.replace('-', "\\-").replace(' ', "\\s*")).collect();
    names.sort_by_key(|name| (std::cmp::Reverse(name.len()), name.clone()));
    let number = "[-+]?(?:[0-9]+\\.?[0-9]*|\\.[0-9]+)(?:[EeDd][-+]?[0-9]+)?";
    let values = json!([
        {"name": "string.quoted.double.abaqus-inp", "match": "\"[^\"]*\"?"},
        {"name": "variable.parameter.abaqus-inp", "match": "<\\s*[A-Za-z_][A-Za-z0-9_]*\\s*>"},
        {"name": "constant.numeric.abaqus-inp", "match": format!("(?<![A-Za-z0-9_.\\-]){number}(?![A-Za-z0-9_.])")},
        {"name": "punctuation.separator.abaqus-inp", "match": ","},
    ]);
    json!({
        "$schema": "https://raw.githubusercontent.com/martinring/tmlanguage/master/tmlanguage.json",
        "name": "Abaqus input deck",
        "scopeName": "source.abaqus-inp",
        "fileTypes": ["inp"],
        "patterns": [
            {
                "name": "comment.line.double-asterisk.abaqus-inp",
                "match": "^\\s*\\*\\*(?:\\s*(inpact:\\s*ignore)\\s+([A-Z0-9, ]+))?.*$",
                "captures": {
                    "1": {"name": "keyword.other.directive.abaqus-inp"},
                    "2": {"name": "constant.other.rule.abaqus-inp"},
                },
            },
            {
                "name": "meta.keyword-line.abaqus-inp",
                "begin": format!("(?i)^\\s*(\\*\\s*(?:{}))(?=\\s*(?:,|$))", names.join("|")),
                "beginCaptures": {"1": {"name": "keyword.control.abaqus-inp"}},
                "end": "(?<!,)$",
                "patterns": [{"include": "#parameters"}],
            },
            {
                // An abbreviation, or a keyword that nobody knows.
                "name": "meta.keyword-line.abaqus-inp",
                "begin": "^\\s*(\\*[^,*]*)",
                "beginCaptures": {"1": {"name": "entity.name.tag.abaqus-inp"}},
                "end": "(?<!,)$",
                "patterns": [{"include": "#parameters"}],
            },
            {"include": "#values"},
        ],
        "repository": {
            "parameters": {
                "patterns": [
                    {
                        "match": "([A-Za-z_][^=,]*)(?:\\s*(=)\\s*)(\"[^\"]*\"|[^,\"]*)",
                        "captures": {
                            "1": {"name": "entity.other.attribute-name.abaqus-inp"},
                            "2": {"name": "keyword.operator.assignment.abaqus-inp"},
                            "3": {"name": "string.unquoted.abaqus-inp", "patterns": [{"include": "#values"}]},
                        },
                    },
                    {"name": "entity.other.attribute-name.abaqus-inp", "match": "[A-Za-z_][^=,]*"},
                ],
            },
            "values": {"patterns": values},
        },
    })
}

#[test]
fn textmate_grammar_is_fresh() {
    let path = root().join("editors/vscode/syntaxes/abaqus-inp.tmLanguage.json");
    let fresh = serde_json::to_string_pretty(&textmate()).expect("written") + "\n";
    if std::env::var_os("INPACT_UPDATE").is_some() {
        std::fs::write(&path, fresh).expect("writable");
        return;
    }
    let written = std::fs::read_to_string(&path).expect("readable");
    assert!(fresh == written, "the colours of editors are out of date: run this test again with INPACT_UPDATE=1");
}
