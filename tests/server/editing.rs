//! What an editor changes on request: fixes, silence, names, layout.

use crate::client::{Client, edited, edits_for, shown};
use serde_json::{Value, json};
use std::process::Command;

/// The actions of a range of lines, or of those kinds only.
fn actions(client: &mut Client, name: &str, lines: (u64, u64), only: Option<&str>) -> Vec<Value> {
    let range = json!({"start": {"line": lines.0, "character": 0}, "end": {"line": lines.1, "character": 0}});
    let mut context = json!({"diagnostics": []});
    if let Some(only) = only {
        context["only"] = json!([only]);
    }
    let params = json!({"textDocument": {"uri": client.uri(name)}, "range": range, "context": context});
    let found = client.request("textDocument/codeAction", &params).expect("answered");
    found.as_array().expect("a list").clone()
}

/// What the program makes of a file.
fn run(client: &Client, arguments: &[&str], name: &str) -> String {
    Command::new(env!("CARGO_BIN_EXE_inpact-under-test")).args(arguments).arg(client.path(name)).output().expect("run");
    std::fs::read_to_string(client.path(name)).expect("read")
}

const FAULTY: &str = "\
*SURFACE INTERACTION, NAME=JOINT
  ** indented
*GAP COND
20., 0.

10., 0.1
*GAP ELECTRICAL CONDUCTANCE
2000., 1.E-5
4000., 0.
*SURFACE, NAME=A
E, S1
*SURFACE, NAME=B
E, S2
*CONTACT PAIR, INTERACTION=JOINT
A, B
";

#[test]
fn every_fix_is_offered_and_mends() {
    let mut client = Client::start();
    client.write_and_open("a.inp", FAULTY);
    let uri = client.uri("a.inp");
    let before = client.findings("a.inp", 1);
    let offered = actions(&mut client, "a.inp", (0, 99), Some("quickfix"));
    let line = |action: &Value| {
        format!(
            "{}{}\n{}\n",
            action["title"].as_str().unwrap(),
            if action["isPreferred"] == true { " (preferred)" } else { "" },
            edits_for(&action["edit"], &uri)
                .iter()
                .map(|edit| format!("    {} {:?}\n", shown(&edit["range"]), edit["newText"].as_str().unwrap()))
                .collect::<String>()
        )
    };
    insta::assert_snapshot!(offered.iter().map(line).collect::<String>());
    // Each of them takes its finding away.
    let mut version = 1;
    for action in offered.iter().filter(|action| action["diagnostics"].is_array()) {
        version += 1;
        client.replace("a.inp", version, &edited(FAULTY, &edits_for(&action["edit"], &uri)));
        let after = client.findings("a.inp", version);
        let code = &action["diagnostics"][0]["code"];
        let count = |found: &[Value]| found.iter().filter(|found| found["code"] == *code).count();
        assert!(count(&after) < count(&before), "{}: {after:?}", action["title"]);
    }
}

#[test]
fn all_safe_fixes_at_once_are_those_of_check_fix() {
    let mut client = Client::start();
    client.write_and_open("a.inp", FAULTY);
    let uri = client.uri("a.inp");
    for only in ["source.fixAll", "source.fixAll.inpact", "source"] {
        let offered = actions(&mut client, "a.inp", (0, 0), Some(only));
        assert_eq!(offered.len(), 1, "{only}");
        let mended = edited(FAULTY, &edits_for(&offered[0]["edit"], &uri));
        assert_ne!(mended, FAULTY);
        client.write("a.inp", FAULTY);
        assert_eq!(mended, run(&client, &["check", "--fix", "-q"], "a.inp"));
    }
    assert!(actions(&mut client, "a.inp", (0, 0), Some("source.organizeImports")).is_empty());
    // Nothing to mend, nothing offered.
    let mended = std::fs::read_to_string(client.path("a.inp")).expect("read");
    client.replace("a.inp", 2, &mended);
    assert!(actions(&mut client, "a.inp", (0, 0), Some("source.fixAll")).is_empty());
}

#[test]
fn what_the_other_solver_would_have_mended() {
    let mut client = Client::start();
    client.notify("workspace/didChangeConfiguration", &json!({"settings": {"inpact": {"dialect": "calculix"}}}));
    let deck = "*SURFACE INTERACTION, NAME=A\n  ** for Abaqus no comment\n*GAP CONDUCTANCE\n20., 0.\n0., 1.\n";
    client.open("a.inp", deck);
    let titles: Vec<String> = actions(&mut client, "a.inp", (0, 9), Some("quickfix"))
        .iter()
        .map(|action| action["title"].as_str().unwrap().to_owned())
        .collect();
    insta::assert_snapshot!(titles.join("\n"));
}

#[test]
fn formatting_is_that_of_fmt() {
    let mut client = Client::start();
    let decks = [
        "*surface interaction,name=joint\n*gap cond\n20.,0.\n10.5,.1\n*contact pair,interaction=joint\nA,B\n",
        include_str!("../../decks/faulty/first-mistakes.inp"),
        include_str!("../../decks/fragments/spellings.inp"),
        include_str!("../../decks/fragments/six-fields.inp"),
        include_str!("../../decks/fragments/ragged.inp"),
        include_str!("../../decks/fragments/parameters.inp"),
        "*SURFACE INTERACTION,NAME=A\r\n*GAP CONDUCTANCE\r\n1.,0.\r\n10.,20.\r\n",
    ];
    for (number, deck) in decks.into_iter().enumerate() {
        let name = format!("deck-{number}.inp");
        client.write_and_open(&name, deck);
        let params =
            json!({"textDocument": {"uri": client.uri(&name)}, "options": {"tabSize": 4, "insertSpaces": true}});
        let edits = client.request("textDocument/formatting", &params).expect("answered");
        let formatted = edited(deck, edits.as_array().expect("a list"));
        assert_eq!(formatted, run(&client, &["fmt"], &name), "{name}");
    }
}

#[test]
fn a_selection_is_formatted_by_its_blocks() {
    let mut client = Client::start();
    let deck = "*surface interaction,name=joint\n*gap cond\n20.,0.\n10.5,.1\n*contact pair,interaction=joint\nA,B\n";
    client.open("a.inp", deck);
    let range = json!({"start": {"line": 2, "character": 1}, "end": {"line": 2, "character": 3}});
    let params = json!({"textDocument": {"uri": client.uri("a.inp")}, "range": range, "options": {"tabSize": 4, "insertSpaces": true}});
    let edits = client.request("textDocument/rangeFormatting", &params).expect("answered");
    let formatted = edited(deck, edits.as_array().expect("a list"));
    assert_eq!(
        formatted,
        "*surface interaction,name=joint\n*gap cond\n20.,  0.\n10.5,  .1\n*contact pair,interaction=joint\nA,B\n"
    );
}

const MAIN: &str = "\
*SURFACE, NAME=TOP
SOLID, S1
*SURFACE, NAME=LOW
SOLID, S2
*NSET, NSET=HOT
1,
*INCLUDE, INPUT=joint.inp
*CONTACT PAIR, INTERACTION=Joint
TOP, LOW
*BOUNDARY
HOT, 11, 11, <t_end>
Part-1.HOT, 1
*MODEL CHANGE, REMOVE, TYPE=CONTACT PAIR
TOP, LOW
";

const JOINT: &str = "\
*PARAMETER
t_end = 20.
t_half = t_end/2 # of t_end
*SURFACE INTERACTION, NAME=JOINT
*GAP CONDUCTANCE
<t_end>, 0.
0., <t_half>
*CHANGE FRICTION, INTERACTION=\"JOINT\"
";

/// Renames what is at a place; gives both files as they are then.
fn rename(place: (&str, u64, u64), new_name: &str) -> Result<(String, String), String> {
    let mut client = Client::start();
    client.write_and_open("main.inp", MAIN);
    client.write_and_open("joint.inp", JOINT);
    let (file, line, character) = place;
    let params = json!({
        "textDocument": {"uri": client.uri(file)},
        "position": {"line": line, "character": character},
        "newName": new_name,
    });
    let edit = client
        .request("textDocument/rename", &params)
        .map_err(|error| error["message"].as_str().unwrap().to_owned())?;
    let changed = |name: &str, text: &str| edited(text, &edits_for(&edit, &client.uri(name)));
    Ok((changed("main.inp", MAIN), changed("joint.inp", JOINT)))
}

#[test]
fn names_are_changed_in_all_files() {
    let (main, joint) = rename(("main.inp", 7, 30), "CONTACT-1").expect("renamed");
    assert_eq!(main, MAIN.replace("=Joint", "=CONTACT-1"));
    assert_eq!(joint, JOINT.replace("NAME=JOINT", "NAME=CONTACT-1").replace("\"JOINT\"", "CONTACT-1"));
    let (main, joint) = rename(("main.inp", 0, 16), "UPPER").expect("renamed");
    assert_eq!((main, joint), (MAIN.replace("TOP", "UPPER"), JOINT.to_owned()));
    let (main, joint) = rename(("main.inp", 10, 1), "WARM").expect("renamed");
    assert_eq!((main, joint), (MAIN.replace("HOT", "WARM"), JOINT.to_owned()));
    let (main, joint) = rename(("joint.inp", 2, 11), "last").expect("renamed");
    assert_eq!(main, MAIN.replace("t_end", "last"));
    // Not in a comment.
    assert_eq!(joint, JOINT.replace("t_end", "last").replace("of last", "of t_end"));
}

#[test]
fn names_that_cannot_be_changed() {
    let cases = [
        (("main.inp", 7, 30), "2x"),
        (("main.inp", 7, 30), "a,b"),
        (("main.inp", 7, 30), ""),
        (("main.inp", 0, 16), "LOW"),
        (("joint.inp", 1, 1), "t half"),
        (("joint.inp", 1, 1), "t_half"),
        (("main.inp", 5, 0), "X"),
        (("main.inp", 1, 1), "X"),
    ];
    let messages: Vec<String> = cases
        .into_iter()
        .map(|(place, name)| format!("{place:?} {name}: {}", rename(place, name).expect_err("refused")))
        .collect();
    insta::assert_snapshot!(messages.join("\n"));
}

#[test]
fn a_name_of_two_things_is_not_changed_by_guessing() {
    let mut client = Client::start();
    client.open("a.inp", "*NSET, NSET=TOP\n1,\n*SURFACE, NAME=TOP\nE, S1\n*BOUNDARY\nTOP, 1\n");
    let place = |line: u64, character: u64| json!({"textDocument": {"uri": "URI"}, "position": {"line": line, "character": character}, "newName": "X"});
    let mut asked = place(0, 13);
    asked["textDocument"]["uri"] = json!(client.uri("a.inp"));
    let error = client.request("textDocument/rename", &asked).expect_err("refused");
    insta::assert_snapshot!(error["message"].as_str().unwrap());
    client.open("b.inp", "*PART, NAME=P\n*NSET, NSET=S\n1,\n*END PART\n*PART, NAME=Q\n*NSET, NSET=S\n2,\n*END PART\n");
    let mut asked = place(1, 12);
    asked["textDocument"]["uri"] = json!(client.uri("b.inp"));
    let error = client.request("textDocument/prepareRename", &asked).expect_err("refused");
    insta::assert_snapshot!(error["message"].as_str().unwrap());
}
