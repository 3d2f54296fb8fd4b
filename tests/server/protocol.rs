//! The session itself: its beginning and end, units of columns, clients that send nonsense, requests that are cancelled.

use crate::client::Client;
use serde_json::{Value, json};
use std::time::Instant;

#[test]
fn what_the_server_offers() {
    let mut client = Client::launch();
    let result = client.request("initialize", &json!({"capabilities": {}})).expect("answered");
    let mut result = result;
    result["serverInfo"]["version"] = json!("VERSION");
    insta::assert_snapshot!(serde_json::to_string_pretty(&result).unwrap());
    assert_eq!(client.finish(), Some(0));
}

#[test]
fn columns_are_counted_as_the_client_asks() {
    let text = "*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE\n\"é温😀\", 1.\n20., 0.\n";
    for (encodings, expected, column) in [
        (json!(["utf-8", "utf-16"]), "utf-8", 11),
        (json!(["utf-32"]), "utf-32", 5),
        (json!(["utf-7", "utf-16"]), "utf-16", 6),
        (json!([]), "utf-16", 6),
    ] {
        let mut client = Client::launch();
        let capabilities = json!({"general": {"positionEncodings": encodings}});
        let result = client.request("initialize", &json!({"capabilities": capabilities})).expect("answered");
        assert_eq!(result["capabilities"]["positionEncoding"], expected);
        client.open("a.inp", text);
        let found = client.findings("a.inp", 1);
        let number = found.iter().find(|found| found["code"] == "S006").expect("a malformed number");
        assert_eq!(number["range"]["end"], json!({"line": 2, "character": column}), "{expected}");
        // The same place is understood when it comes back.
        let hover = client.at("textDocument/hover", "a.inp", (2, column)).expect("answered");
        assert_eq!(hover["range"]["end"]["character"], column, "{hover}");
    }
}

#[test]
fn nonsense_is_answered_and_nothing_is_lost() {
    let mut client = Client::start();
    client.open("a.inp", "*SURFACE INTERACTION\n");
    assert_eq!(client.findings("a.inp", 1).len(), 1);
    let bodies: [(&str, i64); 5] =
        [("{", -32700), ("[]", -32600), ("7", -32600), ("{\"jsonrpc\":\"2.0\"}", -32600), ("{\"id\":[]}", -32600)];
    for (body, code) in bodies {
        client.send_raw(format!("Content-Length: {}\r\n\r\n{body}", body.len()).as_bytes());
        let error = client.answer(&Value::Null).expect_err("refused");
        assert_eq!(error["code"], code, "{body}");
    }
    client.send_raw(b"GET / HTTP/1.1\r\nHost: here\r\n\r\n\0\0\r\n");
    for (method, params, code) in [
        ("textDocument/hover", json!({}), -32602),
        (
            "textDocument/hover",
            json!({"textDocument": {"uri": "file:///no"}, "position": {"line": 0, "character": 0}}),
            -32602,
        ),
        ("textDocument/rename", json!(["x"]), -32602),
        ("no/such", json!(null), -32601),
        ("initialize", json!({"capabilities": {}}), -32600),
    ] {
        let error = client.request(method, &params).expect_err("refused");
        assert_eq!(error["code"], code, "{method}: {error}");
    }
    // Notifications that make no sense are passed over, and places that are nowhere are at the nearest end.
    client.notify(
        "textDocument/didChange",
        &json!({"textDocument": {"uri": "file:///no", "version": 2}, "contentChanges": []}),
    );
    client.notify("textDocument/didChange", &json!("x"));
    client.notify("textDocument/didOpen", &json!({}));
    client.notify("no/such", &json!({}));
    let far = 4_000_000_000_u32;
    let end = json!({"line": far, "character": far});
    client.change(
        "a.inp",
        2,
        &json!([{"range": {"start": end, "end": {"line": 0, "character": far}}, "text": ", NAME=A\n"}]),
    );
    let found = client.findings("a.inp", 2);
    assert_eq!(found.iter().filter(|found| found["code"] == "K006").count(), 0, "{found:?}");
    let hover = client.at("textDocument/hover", "a.inp", (u64::from(far), 0)).expect("answered");
    assert_eq!(hover, Value::Null);
    assert_eq!(client.finish(), Some(0));
}

#[test]
fn cancelled_requests_are_answered_as_such() {
    let mut client = Client::start();
    let rows = "1., 2., 3.\n".repeat(200_000);
    client.open("a.inp", &format!("*NODE\n{rows}*SURFACE INTERACTION, NAME=A\n"));
    let document = json!({"textDocument": {"uri": client.uri("a.inp")}});
    // Both are sent while the deck is being read for the first.
    let first = client.ask("textDocument/documentSymbol", &document);
    let second = client.ask("textDocument/documentSymbol", &document);
    client.notify("$/cancelRequest", &json!({"id": second}));
    assert!(client.answer(&json!(first)).is_ok());
    let answer = client.answer(&json!(second));
    // It may have been answered before the cancellation came; mostly it has not.
    if let Err(error) = answer {
        assert_eq!(error["code"], -32800);
    }
    client.notify("$/cancelRequest", &json!({"id": 9999}));
    let third = client.ask("textDocument/documentSymbol", &document);
    assert!(client.answer(&json!(third)).is_ok());
}

/// A name is looked for in many files before it may be renamed, which takes long; cancelled in the midst of it, the request is answered at once.
#[test]
fn work_on_a_cancelled_request_is_given_up() {
    let mut client = Client::start();
    let rows = "SIDE-1, SIDE-2, SIDE-3, SIDE-4, SIDE-5, SIDE-6\n".repeat(20_000);
    let sets: String = (1..=6).map(|number| format!("*ELSET, ELSET=SIDE-{number}\n{number}\n")).collect();
    let mut deck = sets;
    for number in 0..4 {
        client.write(&format!("part-{number}.inc"), &format!("*ELSET, ELSET=ALL-{number}\n{rows}"));
        deck += &format!("*INCLUDE, INPUT=part-{number}.inc\n");
    }
    client.write_and_open("a.inp", &deck);
    client.findings("a.inp", 1);
    // The answer is short, so that the time is that of the work.
    let method = "textDocument/prepareRename";
    let at = (0, 17);
    let start = Instant::now();
    let found = client.at(method, "a.inp", at).expect("answered");
    let whole = start.elapsed();
    assert_eq!(found["placeholder"], "SIDE-1");
    let params = json!({
        "textDocument": {"uri": client.uri("a.inp")},
        "position": {"line": at.0, "character": at.1},
    });
    // A machine that does other work may be late once, and never always.
    let mut times = Vec::new();
    let is_soon = (0..5).any(|_| {
        let id = client.ask(method, &params);
        std::thread::sleep(whole / 10);
        let start = Instant::now();
        client.notify("$/cancelRequest", &json!({"id": id}));
        // It may have been answered before the cancellation came.
        let Err(error) = client.answer(&json!(id)) else { return false };
        assert_eq!(error["code"], -32800);
        times.push(start.elapsed());
        start.elapsed() < whole / 4
    });
    assert!(is_soon, "cancelled after {times:?}, whole after {whole:?}");
    // What was given up is answered when it is asked for again.
    assert_eq!(client.at(method, "a.inp", at).expect("answered"), found);
}

#[test]
fn a_request_that_was_cancelled_before_it_came_is_not_answered() {
    let mut client = Client::start();
    client.open("a.inp", "*SURFACE INTERACTION, NAME=A\n");
    client.notify("$/cancelRequest", &json!({"id": "mine"}));
    let params = json!({"textDocument": {"uri": client.uri("a.inp")}});
    client.send(&json!({"jsonrpc": "2.0", "id": "mine", "method": "textDocument/documentSymbol", "params": params}));
    assert_eq!(client.answer(&json!("mine")).expect_err("cancelled")["code"], -32800);
    // The number may be used again.
    client.send(&json!({"jsonrpc": "2.0", "id": "mine", "method": "textDocument/documentSymbol", "params": params}));
    assert!(client.answer(&json!("mine")).is_ok());
}

#[test]
fn the_session_ends_with_the_client() {
    let mut before = Client::launch();
    let error = before.request("textDocument/hover", &json!({})).expect_err("refused");
    assert_eq!(error["code"], -32002);
    assert_eq!(before.wait(), Some(0), "the input ended");

    let mut after = Client::start();
    after.request("shutdown", &Value::Null).expect("shut down");
    assert_eq!(after.request("textDocument/hover", &json!({})).expect_err("refused")["code"], -32600);
    after.notify("exit", &Value::Null);
    assert_eq!(after.wait(), Some(0));

    let mut hasty = Client::start();
    hasty.notify("exit", &Value::Null);
    assert_eq!(hasty.wait(), Some(1), "exit without shutdown");
}
