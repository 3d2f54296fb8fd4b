//! `inpact json` and `inpact inp`: both views, and back.

use crate::program::{Folder, dialect_of, inpact, inpact_with_input, root, sample_decks};

#[test]
fn the_model_view() {
    insta::assert_snapshot!(inpact(&["json", "decks/busbar-joint/busbar-joint.inp"]).output);
}

#[test]
fn the_syntax_view() {
    insta::assert_snapshot!(inpact(&["json", "--view", "syntax", "decks/fragments/minimal.inp"]).output);
}

#[test]
fn every_sample_comes_back_byte_for_byte_from_the_syntax_view() {
    for deck in sample_decks() {
        let json = inpact(&["json", "--view", "syntax", &deck]);
        let folder = Folder::with(&[("deck.json", &json.output)]);
        let back = folder.inpact(&["inp", "deck.json", "--into", "again"]);
        assert_eq!(back.code, 0, "{deck}: {}", back.errors);
        let document: serde_json::Value = serde_json::from_str(&json.output).expect("JSON");
        let files = document["files"].as_array().expect("files");
        for source in files.iter().map(|file| file["source"].as_str().expect("a name")) {
            let text = std::fs::read_to_string(root().join(source)).expect("readable");
            assert_eq!(folder.read(&format!("again/{source}")), text, "{source}");
        }
        if let [_] = files.as_slice() {
            let back = inpact_with_input(&["inp", "-"], json.output.as_bytes());
            assert_eq!((back.code, back.output), (0, folder.read(&format!("again/{deck}"))), "{}", back.errors);
        }
    }
}

#[test]
fn every_sample_means_the_same_after_the_model_view() {
    let faulty = |deck: &String| deck.starts_with("decks/faulty/");
    // The model view does not tell its dialect, and `inp` prints what Abaqus reads.
    let foreign = |deck: &String| !dialect_of(deck).is_empty();
    for deck in sample_decks().iter().filter(|deck| !faulty(deck) && !foreign(deck)) {
        let json = inpact(&["json", deck]);
        let back = inpact_with_input(&["inp", "-"], json.output.as_bytes());
        assert_eq!(back.code, 0, "{deck}: {}", back.errors);
        let again = inpact_with_input(&["json", "-"], back.output.as_bytes());
        assert_eq!(without_places(&json.output), without_places(&again.output), "{deck}");
    }
}

/// The document without what depends on where things stand.
fn without_places(json: &str) -> serde_json::Value {
    let mut document: serde_json::Value = serde_json::from_str(json).expect("JSON");
    document["source"] = "".into();
    for interaction in document["interactions"].as_object_mut().expect("interactions").values_mut() {
        interaction["span"] = serde_json::Value::Null;
    }
    document
}

#[test]
fn json_that_is_not_right_is_refused_with_its_path() {
    let json = inpact(&["json", "decks/busbar-joint/busbar-joint.inp"]).output;
    let thickness = "\"thickness\": 1.0";
    let cases = [
        (json.replacen(thickness, "\"thickness\": 1.0, \"colour\": 2", 1), "an unknown field"),
        (json.replacen(thickness, "\"thickness\": \"1.0\"", 1), "a wrong type"),
        (json.replacen(&format!("{thickness},"), "", 1), "a missing field"),
        (json.replacen("\"conductance\"", "\"conductanse\"", 1), "an unknown column"),
        (json.replacen("inpact/model/1", "inpact/model/9", 1), "another schema"),
        (json.replacen("\"procedures\": [", "\"procedures\": [ 7, ", 1), "no procedure"),
        ("{".to_owned(), "no JSON"),
        ("[1, 2]".to_owned(), "no document"),
    ];
    let mut shown = String::new();
    for (text, what) in &cases {
        let run = inpact_with_input(&["inp", "-"], text.as_bytes());
        assert_eq!((run.code, run.output.as_str()), (1, ""), "{what}");
        shown += &format!("{what}:\n  {}", run.errors);
    }
    insta::assert_snapshot!(shown);
}

#[test]
fn a_model_that_no_deck_can_hold_is_refused() {
    let json = inpact(&["json", "decks/fragments/minimal.inp"]).output;
    let mut document: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    let interactions = document["interactions"].as_object_mut().expect("interactions");
    let key = interactions.keys().next().expect("one interaction").clone();
    let mut interaction = interactions.remove(&key).expect("it is there");
    // Without quotes the comma ends the name.
    interaction["name"] = "X, Y".into();
    interactions.insert("X, Y".to_owned(), interaction);
    let run = inpact_with_input(&["inp", "-"], document.to_string().as_bytes());
    assert_eq!((run.code, run.output.as_str()), (1, ""), "{}", run.errors);
    assert!(run.errors.contains("no deck can say this"), "{}", run.errors);
}

/// Parts with errors may be missing from the model: they are reported, and the exit code says so too.
#[test]
fn the_errors_of_a_deck_are_said_beside_its_model() {
    let run = inpact_with_input(&["json", "-"], b"*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTNCE\n1., 0.\n");
    assert_eq!(run.code, 1);
    assert!(run.errors.starts_with("-:2:2: error[K001]"), "{}", run.errors);
    let document: serde_json::Value = serde_json::from_str(&run.output).expect("the model all the same");
    assert_eq!(document["interactions"]["A"]["other"], serde_json::json!([]));
}
