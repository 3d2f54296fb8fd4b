//! A scene that can be solved, with its deck, or its findings: shared by `solve` and `tradeoff --scene`.

mod deck_conditions;
mod failures;

use super::findings::Reporter;
use super::laws::LawArguments;
use super::meshed::MeshedDeck;
use crate::failure::Failure;
use crate::files;
use crate::input::ReadDeck;
use crate::reach;
use crate::settings::{ReadOptions, Settings};
use inpact_diagnostics::{Diagnostic, Findings, keep_lines};
use inpact_evaluation::plan::{Choices, Currents};
use inpact_network::scene::{self, Field, Scene, SceneFiles};
use inpact_network::{Error, Problem, report_unknown_interactions};
use inpact_parser::deck::Keep;
use inpact_parser::grammar::Grammar;
use inpact_parser::model::{Model, Name, Regime};
use std::collections::HashSet;
use std::path::{Path, PathBuf};

/// A scene with the model of its deck.
pub(crate) struct SolvableScene {
    /// Severities of findings in the scene.
    pub(crate) settings: Settings,
    pub(crate) scene: Scene,
    pub(crate) model: Model,
    pub(crate) choices: Choices,
    pub(crate) name: String,
    pub(crate) deck_name: String,
    /// The text of the scene file.
    text: String,
}

/// Reasons why solving ended early: there is no solution, or the receiver of the states stopped.
pub(crate) enum Ended<T> {
    Solving(Error),
    Taking(T),
}

impl<T> From<Error> for Ended<T> {
    fn from(error: Error) -> Self {
        Self::Solving(error)
    }
}

impl SolvableScene {
    /// Reads a scene and its deck; `None` after reporting their faults.
    pub(crate) fn read(
        path: &Path,
        laws: &LawArguments,
        reading: &ReadOptions,
        reporter: &mut impl Reporter,
    ) -> Result<Option<Self>, Failure> {
        let name = path.display().to_string();
        // That of standard input, `-`, is the working folder.
        let folder = path.parent().unwrap_or(Path::new(""));
        let text = files::read_text(path)?;
        // No TOML line begins like this.
        if text.trim_start().starts_with('*') {
            return Err(Failure::Usage(format!(
                "`{name}` is a deck, where a scene is expected: `inpact scene {name}` makes one of it, and `inpact check {name}` judges it"
            )));
        }
        let mut settings = Settings::of(path, reading)?;
        reporter.confine(&mut settings, path);
        let roots = settings.include_roots.as_slice();
        let mut files = FilesBeside { folder, roots, read: vec![path.to_owned()], failures: Vec::new() };
        let (scene, found) = scene::read_as_far_as_it_goes(&text, &name, &mut files);
        let read: Vec<PathBuf> = files.read.iter().map(|file| files::whole_path(file)).collect();
        reporter.files(&read);
        let shows_lines = reporter.shows_lines();
        let quote = |found| if shows_lines { quoted(&text, &name, found) } else { found };
        let found = quote(found);
        let has_errors = reporter.data(found, &settings);
        let deck_path = scene.as_ref().map(|scene| folder.join(&scene.deck));
        if let (Some(deck), false) = (&deck_path, files.failures.is_empty()) {
            files.failures.extend(refuse_outside(deck, roots).and_then(|()| files::open_file(deck).map(drop)).err());
        }
        if !files.failures.is_empty() {
            return Err(reporter.failures(files.failures));
        }
        let Some((scene, deck_path)) = scene.zip(deck_path) else { return Ok(None) };
        refuse_outside(&deck_path, roots)?;
        if has_errors {
            // Findings of the deck on the interfaces come in the same run, where there is a deck.
            let read = Settings::of(&deck_path, reading).and_then(|mut settings| {
                reporter.confine(&mut settings, &deck_path);
                ReadDeck::read(&deck_path, Keep::Interpreted, &settings)
            });
            let mut findings = Findings::new(&name);
            if let Ok(read) = read {
                reporter.files(&read.places);
                report_unknown_interactions(&scene, &read.model, &mut findings);
            }
            reporter.data(quote(findings.into_list()), &settings);
            return Ok(None);
        }
        let mut of_deck = Settings::of(&deck_path, reading)?;
        reporter.confine(&mut of_deck, &deck_path);
        let grammar = of_deck.grammar;
        let mut scene = scene;
        let read = match scene.deck_conditions {
            None => ReadDeck::read(&deck_path, Keep::Interpreted, &of_deck)?,
            Some(wanted) => {
                let mut findings = Findings::new(&name);
                let parts = deck_conditions::targets(&scene);
                let mut step = None;
                let (meshed, surfaces) = MeshedDeck::read_parts(&deck_path, &of_deck, |read| {
                    step = deck_conditions::step(wanted, steps_of(read, grammar), &mut findings);
                    step.map(|step| (parts, step))
                })?;
                if step.is_some() {
                    deck_conditions::take(&mut scene, &meshed, &surfaces, &mut findings)?;
                }
                if reporter.data(quote(findings.into_list()), &settings) {
                    reporter.files(&meshed.read.places);
                    return Ok(None);
                }
                meshed.read
            }
        };
        reporter.files(&read.places);
        let found = read.check(&of_deck);
        let ReadDeck { deck, model, .. } = read;
        let regime = if scene.is_transient() { Regime::Transient } else { Regime::SteadyState };
        let choices = choices_of(&scene, laws.choices(&model, grammar.dialect(), Some(regime))?);
        let only = model.interactions.keys().next().filter(|_| model.interactions.len() == 1);
        let names = scene.interfaces.iter().filter_map(|interface| interface.interaction.as_ref().or(only));
        let names: Vec<&Name> = names.collect::<HashSet<_>>().into_iter().collect();
        if reporter.deck(&found, (&deck, grammar, &model), (&names, Some(regime))) {
            return Ok(None);
        }
        let deck_name = deck_path.display().to_string();
        Ok(Some(Self { settings, scene, model, choices, name, deck_name, text }))
    }

    /// The problem of the scene; `None` after reporting what is missing.
    pub(crate) fn problem(&self, reporter: &mut impl Reporter) -> Option<Problem<'_>> {
        let mut findings = Findings::new(&self.name);
        let problem = Problem::new(&self.scene, &self.model, &self.choices, &mut findings);
        let found = self.quoted(findings.into_list(), reporter);
        let has_errors = reporter.data(found, &self.settings);
        problem.filter(|_| !has_errors)
    }

    /// Findings in the scene with the lines around them, where they are shown.
    pub(crate) fn quoted(&self, found: Vec<Diagnostic>, reporter: &impl Reporter) -> Vec<Diagnostic> {
        if reporter.shows_lines() { quoted(&self.text, &self.name, found) } else { found }
    }

    /// The findings of a failure after the time of the last state.
    pub(crate) fn findings(&self, failure: &Error, after: Option<f64>) -> Vec<Diagnostic> {
        let after = after.filter(|_| self.scene.is_transient());
        failures::findings(failure, &self.scene, (&self.name, after))
    }
}

pub(crate) fn choices_of(scene: &Scene, laws: Choices) -> Choices {
    // A scene without potentials is purely thermal.
    let currents = if scene.mentions(Field::Potential) { Currents::OfTheDeck } else { Currents::None };
    let regime = if scene.is_transient() { Regime::Transient } else { Regime::SteadyState };
    Choices {
        currents,
        regime: Some(regime),
        history_start: scene.history_start(),
        closing_heat: scene.closing_heat(),
        ..laws
    }
}

pub(crate) fn steps_of(read: &ReadDeck, grammar: &Grammar) -> usize {
    let ids = read.deck.blocks().iter().filter_map(inpact_parser::deck::Block::keyword_id);
    ids.filter(|id| grammar.keyword(*id).name == "STEP").count()
}

/// Findings in a scene with the lines around them; those in its tables have theirs from their reader.
fn quoted(text: &str, name: &str, found: Vec<Diagnostic>) -> Vec<Diagnostic> {
    let (mut of_scene, others): (Vec<_>, Vec<_>) = found.into_iter().partition(|found| *found.primary.file == *name);
    // A text in memory can be read.
    let _ = keep_lines(text.as_bytes(), &mut of_scene);
    of_scene.extend(others);
    of_scene
}

/// Rejects a file named in a scene that is not a regular one, or lies outside of the roots.
fn refuse_outside(path: &Path, roots: &[PathBuf]) -> Result<(), Failure> {
    let reason = match roots.iter().find(|root| !reach::lies_in_all(path, std::slice::from_ref(*root))) {
        Some(root) => format!("it lies outside of `{}`, outside of which nothing is read", root.display()),
        None => match reach::irregular(path) {
            Some(reason) => reason.to_owned(),
            None => return Ok(()),
        },
    };
    Err(Failure::Usage(format!("`{}` is not read: {reason}", path.display())))
}

struct FilesBeside<'a> {
    folder: &'a Path,
    /// The roots, outside of which nothing is read.
    roots: &'a [PathBuf],
    /// The files that were read, the scene first.
    read: Vec<PathBuf>,
    failures: Vec<Failure>,
}

impl SceneFiles for FilesBeside<'_> {
    fn name(&self, name: &str) -> String {
        self.folder.join(name).display().to_string()
    }

    fn read(&mut self, name: &str) -> Option<Vec<u8>> {
        let path = self.folder.join(name);
        self.read.push(path.clone());
        match refuse_outside(&path, self.roots).and_then(|()| files::read_lines(&path)) {
            Ok(bytes) => Some(bytes),
            Err(failure) => {
                self.failures.push(failure);
                None
            }
        }
    }
}
