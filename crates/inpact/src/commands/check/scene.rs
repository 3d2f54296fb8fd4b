//! Scenes among the inputs: checked as `solve` checks them, with their tables and the part of their deck that they need, but not solved.

use super::tally::Tally;
use super::{CheckArguments, Checked};
use crate::commands::findings::{Reporter, errors_elsewhere};
use crate::commands::solvable::SolvableScene;
use crate::failure::Failure;
use crate::files;
use crate::fixing::Need;
use crate::input::Kind;
use crate::render::{self, Format, Sources, Style};
use crate::settings::Settings;
use inpact_diagnostics::{Diagnostic, FixSafety};
use inpact_parser::deck::Deck;
use std::path::{Path, PathBuf};

/// Receives what is found in a scene, and in its deck, and makes a text of it.
struct Judge<'a> {
    format: Format,
    style: Style,
    /// Whether the text is wanted, not only the counts.
    has_text: bool,
    separator: &'a str,
    text: String,
    tally: Tally,
    places: Vec<PathBuf>,
    remarks: Vec<String>,
}

impl Reporter for Judge<'_> {
    fn confine(&self, settings: &mut Settings, path: &Path) {
        self.format.confine(settings, path);
    }

    fn shows_lines(&self) -> bool {
        self.has_text && self.format.shows_lines()
    }

    fn files(&mut self, files: &[PathBuf]) {
        for file in files {
            if !self.places.contains(file) {
                self.places.push(file.clone());
            }
        }
    }

    fn take(&mut self, found: &[Diagnostic], sources: Sources<'_>) {
        self.tally.add(&Tally::without_fixes(found));
        if self.has_text {
            let text = render::diagnostics(found, sources, self.format, self.style);
            if !self.text.is_empty() && !text.is_empty() {
                self.text += self.separator;
            }
            self.text += &text;
        }
    }

    fn beside(&mut self, found: &[Diagnostic], shown: &[Diagnostic], deck: &Deck) {
        let deck = deck.sources().first().map_or("the deck", |source| source.name());
        self.remarks.extend(errors_elsewhere(found, shown, &format!("inpact check {deck}")));
        let is_mendable = |found: &Diagnostic| found.fix.as_ref().is_some_and(|fix| fix.safety == FixSafety::Safe);
        if shown.iter().any(is_mendable) {
            self.remarks.push(format!("what is found in the deck of a scene is mended by `inpact check --fix {deck}`"));
        }
    }
}

/// Judges a scene.
pub(super) fn check<'a>(path: &'a Path, arguments: &CheckArguments) -> Result<Checked<'a>, Failure> {
    let mut judge = Judge {
        format: arguments.format,
        style: arguments.style(),
        has_text: arguments.shows_findings(),
        separator: render::document(arguments.format).separator,
        text: String::new(),
        tally: Tally::default(),
        places: Vec::new(),
        remarks: Vec::new(),
    };
    let reading = arguments.reading.options();
    if let Some(scene) = SolvableScene::read(path, &arguments.laws, &reading, &mut judge)?
        && let Some(problem) = scene.problem(&mut judge)
    {
        for failure in problem.certain_failures() {
            let found = scene.quoted(scene.findings(&failure, None), &judge);
            judge.data(found, &scene.settings);
        }
        judge.remarks.extend(problem.left_out.iter().map(|left_out| format!("left out: {left_out}")));
    }
    if arguments.geometry {
        judge.remarks.push("the geometry of a scene is that of its deck: name the deck".to_owned());
    }
    let name = path.display();
    let remarks = judge.remarks.iter().map(|remark| format!("{name}: {remark}")).collect();
    // A table that cannot be read was a failure: what is left are files that were.
    let mut places = judge.places;
    if places.is_empty() {
        places.push(files::whole_path(path));
    }
    Ok(Checked {
        path,
        kind: Kind::Scene,
        settings: arguments.reading.settings(path)?,
        text: judge.text,
        tally: judge.tally,
        remarks,
        places,
        need: Need::Nothing,
        held: None,
    })
}
