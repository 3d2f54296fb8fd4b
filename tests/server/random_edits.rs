//! Edits by chance, in any order and of any characters: afterwards the server finds what `check` finds in the same text.
//!
//! Chance begins at the same number in every run; `INPACT_EDITS=10000` asks for that many edits instead of a few hundred.

use crate::client::Client;
use inpact::{Deck, Diagnostic, ReadOptions};
use inpact_attack::chance::Chance;
use serde_json::{Value, json};
use std::path::Path;
use std::process::Command;

/// What is typed: pieces of decks, and characters of every length in every encoding.
const PIECES: [&str; 26] = [
    "*SURFACE INTERACTION, NAME=A\n",
    "*GAP ELECTRICAL CONDUCTANCE\n",
    "4000., 0.\n",
    "0., 2.E-5\n",
    "*CONTACT PAIR, INTERACTION=A\n",
    "S, M\n",
    "*SURFACE, NAME=",
    "*INCLUDE, INPUT=b.inp\n",
    "*PARAMETER\nk = 2*3\n",
    "<k>, 1.\n",
    "*NODE\n1, 0., 0.\n",
    "** inpact: ignore T001\n",
    "** a comment\n",
    "\r\n",
    "\r",
    "\n",
    "*",
    ",",
    "é",
    "温度",
    "😀",
    "\u{202e}\u{0}",
    "\"Steel Gap\"",
    "1.5-3",
    " ",
    "*STEP\n*END STEP\n",
];

#[test]
fn findings_are_those_of_check() {
    let edits = std::env::var("INPACT_EDITS").ok().and_then(|edits| edits.parse().ok()).unwrap_or(400);
    let mut chance = Chance::new(0x14);
    let mut client = Client::start();
    let mut texts = [start(&mut chance), String::from("*CONTACT PAIR, INTERACTION=A\nS, M\n")];
    for (name, text) in ["a.inp", "b.inp"].into_iter().zip(&texts) {
        client.write_and_open(name, text);
    }
    let mut versions = [1, 1];
    for edit in 0..edits {
        let which = usize::from(chance.below(4) == 0);
        let name = ["a.inp", "b.inp"][which];
        let count = 1 + chance.below(3);
        let changes: Vec<Value> = (0..count).map(|_| change(&mut texts[which], &mut chance)).collect();
        versions[which] += 1;
        client.change(name, versions[which], &json!(changes));
        if edit % 5 != 0 && edit + 1 != edits {
            continue;
        }
        client.write(name, &texts[which]);
        client.write(["b.inp", "a.inp"][which], &texts[1 - which]);
        for (name, version) in ["a.inp", "b.inp"].into_iter().zip(versions) {
            client.findings(name, version);
        }
        compare(&client, &texts, edit);
        if edit % 100 == 0 {
            compare_with_program(&client, edit);
        }
    }
    assert_eq!(client.finish(), Some(0));
}

fn start(chance: &mut Chance) -> String {
    (0..30).map(|_| *chance.one_of(&PIECES)).collect()
}

/// A change of a text, made in it and given as the protocol has it.
fn change(text: &mut String, chance: &mut Chance) -> Value {
    let new: String = (0..chance.below(3)).map(|_| *chance.one_of(&PIECES)).collect();
    if chance.below(50) == 0 || text.len() > 4000 {
        *text = start(chance);
        return json!({"text": text.clone()});
    }
    let boundary = |text: &str, at: usize| (0..=at).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0);
    let pick = |chance: &mut Chance, most: usize| usize::try_from(chance.below(most as u64 + 1)).unwrap_or(0);
    // No place is in the middle of a CR LF: an editor has none there.
    let outside = |text: &str, at: usize| {
        if text[..at].ends_with('\r') && text[at..].starts_with('\n') { at + 1 } else { at }
    };
    let start = outside(text, boundary(text, pick(chance, text.len())));
    let end = outside(text, boundary(text, (start + pick(chance, 40)).min(text.len()))).max(start);
    let range = json!({"start": position(text, start), "end": position(text, end)});
    text.replace_range(start..end, &new);
    json!({"range": range, "text": new})
}

/// The place of a byte in lines and UTF-16, counted here once more.
fn position(text: &str, offset: usize) -> Value {
    let before = &text[..offset];
    let ends = before.replace("\r\n", "\n").replace('\r', "\n");
    let line = ends.matches('\n').count();
    let last = ends.rsplit('\n').next().unwrap_or("");
    json!({"line": line, "character": last.encode_utf16().count()})
}

/// Holds what was published against what the library finds in the files on disk.
fn compare(client: &Client, texts: &[String; 2], edit: u64) {
    let deck = Deck::read(client.path("a.inp"), &ReadOptions::new()).expect("read");
    let is_included = deck.files().contains(&client.path("b.inp"));
    let mut expected: Vec<(String, Value)> = described(&deck.check(), client, texts);
    if !is_included {
        let by_itself = Deck::read(client.path("b.inp"), &ReadOptions::new()).expect("read");
        // Unless it includes the other one, which is a deck already.
        expected.extend(described(&by_itself.check(), client, texts));
    }
    let mut found: Vec<(String, Value)> = Vec::new();
    for name in ["a.inp", "b.inp"] {
        let (_, diagnostics) = &client.published[&client.uri(name)];
        found.extend(diagnostics.iter().map(|found| {
            let message = found["message"].as_str().unwrap().lines().next().unwrap_or_default().to_owned();
            let start = &found["range"]["start"];
            (format!("{name} {} {message}", found["code"].as_str().unwrap()), start.clone())
        }));
    }
    let key = |(text, place): &(String, Value)| (text.clone(), place["line"].as_u64(), place["character"].as_u64());
    expected.sort_by_key(key);
    expected.dedup();
    found.sort_by_key(key);
    found.dedup();
    assert_eq!(found, expected, "after edit {edit}:\n{texts:?}");
}

/// Findings as text and place; those of files that both include come once.
fn described(found: &[Diagnostic], client: &Client, texts: &[String; 2]) -> Vec<(String, Value)> {
    let describe = |found: &Diagnostic| {
        let name = Path::new(&*found.primary.file).file_name().expect("a name").to_string_lossy().into_owned();
        let text = &texts[usize::from(name == "b.inp")];
        let start = usize::try_from(found.primary.span.start()).expect("an offset").min(text.len());
        let message = found.message.lines().next().unwrap_or_default();
        assert!(client.path(&name).exists());
        (format!("{name} {} {message}", found.code), position(text, start))
    };
    found.iter().map(describe).collect()
}

/// Holds the library against the program: the number of findings in the deck and what it includes.
fn compare_with_program(client: &Client, edit: u64) {
    let deck = Deck::read(client.path("a.inp"), &ReadOptions::new()).expect("read");
    let output = Command::new(env!("CARGO_BIN_EXE_inpact-under-test"))
        .args(["check", "--format", "json", "--exit-zero", "-q"])
        .arg(client.path("a.inp"))
        .output()
        .expect("run");
    let lines = String::from_utf8(output.stdout).expect("text");
    assert_eq!(lines.lines().count(), deck.check().len(), "after edit {edit}");
}
