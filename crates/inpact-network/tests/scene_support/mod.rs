//! What the tests of scenes share: scenes read from text, without files, and their problems put together.

#![allow(dead_code, unreachable_pub, reason = "each test file uses its own part")]

use inpact_evaluation::nodes::{DataDiagnostic, Findings};
use inpact_evaluation::plan::Choices;
use inpact_network::Problem;
use inpact_network::scene::{Scene, SceneFiles, read};
use inpact_parser::deck::scan;
use inpact_parser::grammar::Grammar;
use inpact_parser::model::{self, Model};

/// Files by their names.
pub struct Files<'a>(pub &'a [(&'a str, &'a [u8])]);

impl SceneFiles for Files<'_> {
    fn read(&mut self, name: &str) -> Option<Vec<u8>> {
        self.0.iter().find(|(file, _)| *file == name).map(|(_, bytes)| bytes.to_vec())
    }
}

/// A scene, where there is one, and a line for each finding.
pub fn read_with(text: &str, files: &[(&str, &[u8])]) -> (Option<Scene>, Vec<String>) {
    let (scene, findings) = read(text, "scene.toml", &mut Files(files));
    (scene, findings.iter().map(line).collect())
}

/// A scene that is right.
pub fn scene(text: &str) -> Scene {
    let (scene, findings) = read_with(text, &[]);
    scene.unwrap_or_else(|| panic!("{findings:#?}"))
}

/// What is wrong with a scene.
pub fn refused(text: &str) -> Vec<String> {
    let (scene, findings) = read_with(text, &[]);
    assert!(scene.is_none() && !findings.is_empty(), "{text}: {findings:?}");
    findings
}

/// A finding in one line: where, what, and what to do.
pub fn line(finding: &DataDiagnostic) -> String {
    let DataDiagnostic { code, name, severity, message, help, file, place } = finding;
    let line = place.line.map_or("-".to_owned(), |line| line.to_string());
    let row = place.row.map_or(String::new(), |row| format!(" row {row}"));
    let column = place.column.as_ref().map_or(String::new(), |column| format!(" column {column}"));
    let help = help.as_ref().map_or(String::new(), |help| format!("\n    help: {help}"));
    format!("{file}:{line}{row}{column}: {severity:?}[{code} {name}] {message}{help}")
}

/// The model of a deck.
pub fn model_of(deck: &str) -> Model {
    let grammar = Grammar::builtin();
    model::read(&scan("deck.inp", deck.as_bytes(), grammar), grammar).0
}

/// A scene with the laws of a deck, and a line for each finding.
pub fn problem<'a>(scene: &'a Scene, model: &Model) -> (Option<Problem<'a>>, Vec<String>) {
    let mut findings = Findings::new("scene.toml");
    let problem = Problem::new(scene, model, &Choices::default(), &mut findings);
    (problem, findings.into_list().iter().map(line).collect())
}
