//! An editor that is wrong about everything: places beyond the text, ranges that run backwards, documents that are not open, parameters of any shape.
//!
//! Every request is answered, no answer and no line of the log speaks of a fault of inpact, and the server ends by itself when it is told to.
//! `INPACT_HOSTILE=5000` asks for that many documents instead of a few.

use crate::client::Client;
use inpact_attack::chance::Chance;
use serde_json::{Value, json};

const PIECES: [&str; 24] = [
    "*SURFACE INTERACTION, NAME=A\n1.,\n*GAP ELECTRICAL CONDUCTANCE\n4000., 0.\n0., 2.E-5\n",
    "*CONTACT PAIR, INTERACTION=A\nS, M\n",
    "*INCLUDE, INPUT=a.inp\n",
    "*INCLUDE, INPUT=../../etc/passwd\n",
    "*PARAMETER\na = 1/0\nb = a**a\n",
    "<a>, <b\n",
    "*NODE\n1, 0., 0., 0.\n",
    "*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n",
    "*PART, NAME=P\n*END PART\n*ASSEMBLY\n",
    "** inpact: ignore T005\n",
    "deck = \"a.inp\"\n[[node]]\nname = \"a\"\n",
    "{\"schema\": \"inpact/model/1\"}",
    "*",
    ",",
    "=",
    "\"",
    "\r",
    "\n",
    "\0",
    "é😀",
    "\u{202e}",
    "9999999999999999999999999",
    "1e999",
    "\t            ",
];

const METHODS: [&str; 19] = [
    "textDocument/hover",
    "textDocument/completion",
    "textDocument/definition",
    "textDocument/references",
    "textDocument/documentHighlight",
    "textDocument/documentSymbol",
    "textDocument/documentLink",
    "textDocument/codeAction",
    "textDocument/codeLens",
    "textDocument/foldingRange",
    "textDocument/formatting",
    "textDocument/rangeFormatting",
    "textDocument/inlayHint",
    "textDocument/prepareRename",
    "textDocument/rename",
    "textDocument/selectionRange",
    "textDocument/semanticTokens/full",
    "workspace/executeCommand",
    "inpact/nothing",
];

/// How the server speaks of a panic, which it catches.
const FAULT: &str = "fault of inpact";

#[test]
fn every_request_of_a_hostile_editor_is_answered() {
    let documents = std::env::var("INPACT_HOSTILE").ok().map_or(30, |count| count.parse().expect("a number"));
    let mut chance = Chance::new(0x15);
    let mut client = Client::start();
    for document in 0..documents {
        let uri = match chance.below(5) {
            0 => format!("untitled:Untitled-{document}"),
            1 => String::from("file:///none/a%20b%ff.inp"),
            2 => client.uri("s.toml"),
            _ => client.uri("a.inp"),
        };
        let opened = json!({"uri": uri, "languageId": "inp", "version": 1, "text": text(20, &mut chance)});
        client.notify("textDocument/didOpen", &json!({"textDocument": opened}));
        for _ in 0..chance.below(8) {
            let changes: Vec<Value> = (0..chance.below(3)).map(|_| change(&mut chance)).collect();
            let named = json!({"uri": uri, "version": number(&mut chance)});
            client.notify("textDocument/didChange", &json!({"textDocument": named, "contentChanges": changes}));
            let (method, params) = request(&uri, &mut chance);
            let id = client.ask(method, &params);
            if chance.below(10) == 0 {
                client.notify("$/cancelRequest", &json!({"id": id}));
            }
            let answer = client.answer(&json!(id));
            let message = answer.err().map(|error| error["message"].to_string()).unwrap_or_default();
            assert!(!message.contains(FAULT), "{method} {params}: {message}");
        }
        if chance.below(4) != 0 {
            client.notify("textDocument/didClose", &json!({"textDocument": {"uri": uri}}));
        }
    }
    client.request("shutdown", &Value::Null).expect("shut down");
    let logged: Vec<&Value> = client.others.iter().filter(|message| message.to_string().contains(FAULT)).collect();
    assert!(logged.is_empty(), "{logged:?}");
    client.notify("exit", &Value::Null);
    assert_eq!(client.wait(), Some(0));
}

fn text(most: u64, chance: &mut Chance) -> String {
    (0..chance.below(most)).map(|_| *chance.one_of(&PIECES)).collect()
}

/// A change whose range need not be in the document, nor its start before its end.
fn change(chance: &mut Chance) -> Value {
    let new = text(4, chance);
    if chance.below(10) == 0 {
        return json!({"text": new});
    }
    json!({"range": range(chance), "text": new})
}

fn range(chance: &mut Chance) -> Value {
    json!({"start": position(chance), "end": position(chance)})
}

fn position(chance: &mut Chance) -> Value {
    json!({"line": number(chance), "character": number(chance)})
}

/// Small numbers mostly, and the greatest that the protocol has.
fn number(chance: &mut Chance) -> u64 {
    match chance.below(12) {
        0 => *chance.one_of(&[i32::MAX as u64, u64::from(u32::MAX), u64::from(u32::MAX) - 1]),
        1 => chance.below(1000),
        _ => chance.below(30),
    }
}

/// A method with parameters that fit it in most cases.
fn request(uri: &str, chance: &mut Chance) -> (&'static str, Value) {
    let uri = if chance.below(20) == 0 { "file:///none/closed.inp" } else { uri };
    let fitting = json!({
        "textDocument": {"uri": uri},
        "position": position(chance),
        "positions": [position(chance), position(chance)],
        "range": range(chance),
        "context": {"includeDeclaration": true, "triggerKind": 1, "diagnostics": []},
        "options": {"tabSize": number(chance), "insertSpaces": true},
        "newName": chance.one_of(&["B", "", "a b", "é,", "=", "*STEP\n"]),
        "command": "none",
    });
    let params = match chance.below(15) {
        0 => chance.one_of(&[json!(null), json!([]), json!({"textDocument": 3}), json!("a")]).clone(),
        _ => fitting,
    };
    (*chance.one_of(&METHODS), params)
}
