//! Common helpers of the tests of scenes: scenes read from text, without files, and their problems.

#![allow(dead_code, unreachable_pub, reason = "each test file uses its own part")]

use inpact_diagnostics::{Diagnostic, Findings};
use inpact_evaluation::plan::Choices;
use inpact_network::Problem;
use inpact_network::scene::{Scene, SceneFiles, read};
use inpact_parser::deck::scan;
use inpact_parser::grammar::Grammar;
use inpact_parser::model::{self, Model};
use proptest::prelude::*;
use std::fmt::Write as _;

/// A scene with something in every place.
pub const SCENE: &str = "\
deck = \"deck.inp\"
joule_heat_fraction = 0.25
[initial]
temperature = 20.0
pore_pressure = 1.5
[[node]]
name = \"hot\"
potential = { fixed = 2.0 }
temperature = { fixed = 100.0 }
[[node]]
name = \"middle\"
temperature = { source = -3.0, capacity = 5.0, initial = 30.0 }
pore_pressure = {}
[[node]]
name = \"cold\"
potential = { source = 0.5 }
[[link]]
nodes = [\"hot\", \"middle\"]
electrical = 3.0
thermal = inf
[[link]]
nodes = [\"middle\", \"cold\"]
hydraulic = 0.0
joule_heat_fraction = 1.0
[[interface]]
interaction = \"joint 1\"
slave = \"middle\"
master = \"cold\"
area = 0.5
clearance = 0.25
pressure = -1.0
closed = true
fv = [1.0, -2.0]
temperature = 40.0
mass_flow = 6.0
shear = 7.0
slip_rate = -8.0
clearance_rate = 9.0
char_length = 0.0
perm_s = 10.0
perm_m = 11.0
";

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

/// The findings of a scene.
pub fn refused(text: &str) -> Vec<String> {
    let (scene, findings) = read_with(text, &[]);
    assert!(scene.is_none() && !findings.is_empty(), "{text}: {findings:?}");
    findings
}

/// A finding in one line: where, what, and what to do.
pub fn line(finding: &Diagnostic) -> String {
    let Diagnostic { code, name, severity, message, help, primary, .. } = finding;
    let (file, cell) = (&primary.file, finding.cell.clone().unwrap_or_default());
    let line = primary.line().map_or("-".to_owned(), |line| line.to_string());
    let row = cell.row.map_or(String::new(), |row| format!(" row {row}"));
    let column = cell.field.as_ref().map_or(String::new(), |column| format!(" column {column}"));
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

/// Findings below what they are about.
pub fn show(shown: &mut String, findings: &[String]) {
    for line in findings {
        let _ = writeln!(shown, "  {line}");
    }
}

/// Bytes of a scene exchanged, left out, doubled or cut off.
pub fn mutated(text: &'static str) -> impl Strategy<Value = String> {
    let place = any::<prop::sample::Index>();
    let what = prop_oneof![
        Just(String::new()),
        "[ -~\n]{1,3}",
        prop::sample::select(&["nan", "-inf", "1e999", "[[", "]]", "\"", "{}", "= 3", "\u{0}", "ü", "-0.0"][..])
            .prop_map(str::to_owned),
    ];
    prop::collection::vec((place, 0_usize..12, what), 1..4).prop_map(move |changes| {
        let mut text = text.to_owned();
        for (place, length, what) in changes {
            let starts: Vec<usize> = text.char_indices().map(|(start, _)| start).chain([text.len()]).collect();
            let from = place.index(starts.len());
            let to = (from + length).min(starts.len() - 1);
            text.replace_range(starts[from]..starts[to], &what);
        }
        text
    })
}
