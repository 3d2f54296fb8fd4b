//! Findings while typing: in open documents and in what they include, saved or not, by the configuration that counts.

use crate::client::{Client, file_of, shown};
use serde_json::{Value, json};

/// Findings in a few words a line.
fn list(client: &Client, found: &[Value]) -> String {
    let one = |found: &Value| {
        let related: Vec<String> = found["relatedInformation"]
            .as_array()
            .into_iter()
            .flatten()
            .map(|related| {
                let location = &related["location"];
                format!(
                    "\n    {}:{} {}",
                    file_of(&location["uri"]),
                    shown(&location["range"]),
                    related["message"].as_str().unwrap()
                )
            })
            .collect();
        let tags = if found["tags"].is_array() { " (without effect)" } else { "" };
        format!(
            "{} {} {}{tags}: {}\n    {}{}\n",
            shown(&found["range"]),
            found["severity"],
            found["code"].as_str().unwrap_or("-"),
            found["message"].as_str().unwrap().replace('\n', "\n    "),
            found["codeDescription"]["href"].as_str().unwrap_or("-"),
            related.concat()
        )
    };
    client.without_folder(&found.iter().map(one).collect::<String>())
}

fn codes(found: &[Value]) -> Vec<&str> {
    found.iter().map(|found| found["code"].as_str().unwrap_or("-")).collect()
}

const JOINT: &str = "\
*SURFACE INTERACTION, NAME=JOINT
*GAP ELECTRICAL CONDUCTANCE
4000., 0.
2000., 1.E-5
2000., 1.E-5
*INCLUDE, INPUT=pairs.inp
";

#[test]
fn findings_with_their_related_places() {
    let mut client = Client::start();
    client.write("pairs.inp", "*SURFACE, NAME=UPPER\nE, S1\n*CONTACT PAIR, INTERACTION=JOINTS\nUPPER, LOWER\n");
    client.write_and_open("joint.inp", JOINT);
    let own = client.findings("joint.inp", 1);
    let included = client.wait_for("pairs.inp", |found| !found.is_empty());
    insta::assert_snapshot!(format!("joint.inp\n{}\npairs.inp\n{}", list(&client, &own), list(&client, &included)));
}

#[test]
fn what_is_included_counts_as_it_is_in_the_editor() {
    let mut client = Client::start();
    client.write("pairs.inp", "*CONTACT PAIR, INTERACTION=OTHER\nA, A\n");
    client.write_and_open("joint.inp", JOINT);
    client.wait_for("pairs.inp", |found| codes(found) == ["R001"]);
    // Opened: it is judged where it stands, not by itself.
    client.open("pairs.inp", "*CONTACT PAIR, INTERACTION=OTHER\nA, A\n");
    assert_eq!(codes(&client.findings("pairs.inp", 1)), ["R001"]);
    // Edited and not saved.
    client.replace("pairs.inp", 2, "*SURFACE, NAME=A\nE, S1\n*CONTACT PAIR, INTERACTION=JOINT\nA, A\n");
    assert_eq!(codes(&client.findings("pairs.inp", 2)), Vec::<&str>::new());
    // Closed without saving: what is on disk counts again.
    client.close("pairs.inp");
    client.wait_for("pairs.inp", |found| codes(found) == ["R001"]);
    // The deck closed: nothing is said of either any more.
    client.close("joint.inp");
    client.wait_for("pairs.inp", <[Value]>::is_empty);
    client.wait_for("joint.inp", <[Value]>::is_empty);
}

#[test]
fn a_file_that_is_not_saved_yet_can_be_included() {
    let mut client = Client::start();
    client.write_and_open("joint.inp", JOINT);
    assert!(codes(&client.findings("joint.inp", 1)).contains(&"S012"));
    client.open("pairs.inp", "*CONTACT PAIR, INTERACTION=OTHER\nA, A\n");
    client.wait_for("joint.inp", |found| !codes(found).contains(&"S012"));
    client.wait_for("pairs.inp", |found| codes(found) == ["R001"]);
}

#[test]
fn files_that_come_go_and_change_under_the_server() {
    let mut client = Client::start();
    client.write_and_open("joint.inp", JOINT);
    assert!(codes(&client.findings("joint.inp", 1)).contains(&"S012"));
    assert!(
        client.others.iter().any(|message| message["method"] == "client/registerCapability"),
        "the server asks to be told of files"
    );
    let watched = |client: &mut Client, name: &str, kind: u64| {
        let changes = json!({"changes": [{"uri": client.uri(name), "type": kind}]});
        client.notify("workspace/didChangeWatchedFiles", &changes);
    };
    client.write("pairs.inp", "*CONTACT PAIR, INTERACTION=OTHER\nA, A\n");
    watched(&mut client, "pairs.inp", 1);
    client.wait_for("joint.inp", |found| !codes(found).contains(&"S012"));
    client.wait_for("pairs.inp", |found| codes(found) == ["R001"]);
    // Changed on disk, and renamed, without a word: the next keystroke finds out.
    client.write("pairs.inp", "*SURFACE, NAME=A\nE, S1\n*CONTACT PAIR, INTERACTION=JOINT\nA, A\n");
    client.replace("joint.inp", 2, JOINT);
    client.wait_for("pairs.inp", <[Value]>::is_empty);
    std::fs::rename(client.path("pairs.inp"), client.path("gone.inp")).expect("renamed");
    client.replace("joint.inp", 3, JOINT);
    assert!(codes(&client.findings("joint.inp", 3)).contains(&"S012"));
    client.wait_for("pairs.inp", <[Value]>::is_empty);
    // The document itself deleted under the server: it stays open.
    std::fs::remove_file(client.path("joint.inp")).expect("removed");
    client.replace("joint.inp", 4, "*SURFACE INTERACTION\n");
    assert_eq!(codes(&client.findings("joint.inp", 4)), ["K006"]);
}

#[test]
fn the_configuration_counts_and_is_watched() {
    let mut client = Client::start();
    client.write_and_open("a.inp", "*SURFACE INTERACTION, NAME=A\n  ** x\n");
    assert_eq!(codes(&client.findings("a.inp", 1)), ["S009"], "the sample brings up one rule");
    client.write("inpact.toml", "[rules]\nS009 = \"off\"\n");
    let saved = json!({"changes": [{"uri": client.uri("inpact.toml"), "type": 1}]});
    client.notify("workspace/didChangeWatchedFiles", &saved);
    client.wait_for("a.inp", <[Value]>::is_empty);
    // One that says what it cannot say: its own finding, and the deck is judged without it.
    client.write("inpact.toml", "[rules]\nK999 = \"off\"\n");
    client.notify("workspace/didChangeWatchedFiles", &saved);
    let wrong = client.wait_for("inpact.toml", |found| !found.is_empty());
    assert!(wrong[0]["message"].as_str().unwrap().contains("there is no rule `K999`"), "{wrong:?}");
    client.wait_for("a.inp", |found| codes(found) == ["S009"]);
    std::fs::remove_file(client.path("inpact.toml")).expect("removed");
    client.notify("workspace/didChangeWatchedFiles", &saved);
    client.wait_for("inpact.toml", <[Value]>::is_empty);
    // The settings of the editor.
    let text =
        "*SURFACE INTERACTION, NAME=A\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n*GAP COND\n1., 0.\n0., 1.\n";
    client.replace("a.inp", 2, text);
    let abaqus = codes(&client.findings("a.inp", 2)).join(" ");
    client.notify("workspace/didChangeConfiguration", &json!({"settings": {"inpact": {"dialect": "calculix"}}}));
    client.wait_for("a.inp", |found| codes(found).join(" ") != abaqus);
    client.notify("workspace/didChangeConfiguration", &json!({"settings": {"inpact": {"dialect": "nastran"}}}));
    while !client.others.iter().any(|message| message["method"] == "window/logMessage") {
        client.next();
    }
}

#[test]
fn a_document_without_a_file() {
    let mut client = Client::start();
    let document = json!({"uri": "untitled:Untitled-1", "languageId": "abaqus-inp", "version": 1, "text": "*SURFACE INTERACTION\n"});
    client.notify("textDocument/didOpen", &json!({"textDocument": document}));
    loop {
        if let Some((Some(1), found)) = client.published.get("untitled:Untitled-1") {
            assert_eq!(codes(found), ["K006"]);
            break;
        }
        client.next();
    }
}

#[test]
fn two_decks_that_include_one_file_and_one_another() {
    let mut client = Client::start();
    client.write("pairs.inp", "*CONTACT PAIR, INTERACTION=OTHER\nA, A\n");
    client.open("a.inp", "*SURFACE INTERACTION, NAME=JOINT\n*INCLUDE, INPUT=pairs.inp\n");
    client.open("b.inp", "*SURFACE INTERACTION, NAME=JOINT\n*INCLUDE, INPUT=pairs.inp\n");
    // What both find there is said once.
    client.findings("b.inp", 1);
    client.wait_for("pairs.inp", |found| codes(found) == ["R001"]);
    client.open("ring.inp", "*INCLUDE, INPUT=around.inp\n");
    client.open("around.inp", "*INCLUDE, INPUT=ring.inp\n");
    let found = client.findings("around.inp", 1);
    client.findings("ring.inp", 1);
    assert!(codes(&found).contains(&"S013"), "the files include one another: {found:?}");
}
