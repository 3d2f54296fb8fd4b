//! Decks: reading, checking, fixing, JSON.

use crate::errors::raise;
use crate::evaluate::{self, Result};
use crate::findings::Finding;
use crate::laws::GapConductance;
use crate::options::{Reading, one_of};
use inpact::{Dialect, Fixes, Format};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;

/// A deck with everything it includes.
#[pyclass(module = "inpact", frozen)]
pub(crate) struct Deck(pub(crate) Arc<inpact::Deck>);

/// The outcome of fixing a deck.
#[pyclass(module = "inpact", frozen)]
pub(crate) struct Fixed(inpact::Fixed);

/// A file that fixing changes.
#[pyclass(module = "inpact", frozen)]
pub(crate) struct FixedFile(inpact::FixedFile);

fn deck_of(py: Python<'_>, read: std::result::Result<inpact::Deck, inpact::Error>) -> PyResult<Deck> {
    read.map(|deck| Deck(Arc::new(deck))).map_err(|error| raise(py, &error))
}

/// Reads a deck from a file.
#[pyfunction]
#[pyo3(signature = (path, reading, keep_everything))]
pub(crate) fn read(py: Python<'_>, path: PathBuf, reading: &Reading, keep_everything: bool) -> PyResult<Deck> {
    let options = reading.0.clone();
    let options = if keep_everything { options.keep_everything() } else { options };
    deck_of(py, py.detach(|| inpact::Deck::read(&path, &options)))
}

/// Reads a deck from a text.
#[pyfunction]
#[pyo3(signature = (text, name, reading))]
pub(crate) fn parse(py: Python<'_>, text: Vec<u8>, name: PathBuf, reading: &Reading) -> PyResult<Deck> {
    let options = reading.0.clone().keep_everything();
    deck_of(py, py.detach(|| inpact::Deck::parse(&name, text, &options)))
}

/// Makes a deck from JSON, either view.
#[pyfunction]
#[pyo3(signature = (json, reading))]
pub(crate) fn from_json(py: Python<'_>, json: &str, reading: &Reading) -> PyResult<Deck> {
    let options = reading.0.clone().keep_everything();
    deck_of(py, py.detach(|| inpact::Deck::from_json(json, &options)))
}

#[pymethods]
impl Deck {
    #[getter]
    fn name(&self) -> &str {
        self.0.name()
    }

    #[getter]
    fn files(&self) -> Vec<PathBuf> {
        self.0.files().to_vec()
    }

    #[getter]
    fn dialect(&self) -> &'static str {
        match self.0.grammar().dialect() {
            Dialect::Abaqus => "abaqus",
            Dialect::Calculix => "calculix",
        }
    }

    #[getter]
    fn release(&self) -> String {
        self.0.grammar().release().to_string()
    }

    #[getter]
    fn interaction_names(&self) -> Vec<&str> {
        self.0.model().interactions.keys().map(|name| name.written()).collect()
    }

    /// The name as the deck writes it, of one that may be written in another case; `None` where there is none.
    fn interaction_named(&self, name: &str) -> Option<&str> {
        let found = self.0.model().interactions.get(&inpact::Name::new(name))?;
        Some(found.name.written())
    }

    fn check(&self, py: Python<'_>) -> Vec<Finding> {
        py.detach(|| self.0.check()).into_iter().map(Finding::from).collect()
    }

    fn render(&self, findings: Vec<PyRef<'_, Finding>>, format: &str) -> PyResult<String> {
        let formats = [
            ("full", Format::Full),
            ("concise", Format::Concise),
            ("json", Format::Json),
            ("sarif", Format::Sarif),
            ("github", Format::Github),
        ];
        let findings: Vec<_> = findings.iter().map(|found| found.diagnostic().clone()).collect();
        Ok(self.0.render(&findings, one_of("format", format, &formats)?))
    }

    fn fix(&self, py: Python<'_>, codes: Option<Vec<String>>, also: Vec<String>, included: bool) -> PyResult<Fixed> {
        let mut fixes = codes.map_or_else(Fixes::safe, Fixes::of).also(also);
        if included {
            fixes = fixes.in_every_included_file();
        }
        py.detach(|| self.0.fix(&fixes)).map(Fixed).map_err(|error| raise(py, &error))
    }

    fn to_json(&self, py: Python<'_>) -> String {
        py.detach(|| self.0.to_json())
    }

    fn to_syntax_json(&self, py: Python<'_>) -> PyResult<String> {
        py.detach(|| self.0.to_syntax_json()).map_err(|error| raise(py, &error))
    }

    fn to_inp(&self, py: Python<'_>) -> PyResult<String> {
        py.detach(|| self.0.to_inp()).map_err(|error| raise(py, &error))
    }

    fn electrical(&self, py: Python<'_>, interaction: &str) -> PyResult<Option<GapConductance>> {
        let gap = self.0.electrical_conductance(interaction).map_err(|error| raise(py, &error))?;
        Ok(gap.map(|gap| GapConductance::new(interaction, gap)))
    }

    fn evaluate_table(
        &self,
        py: Python<'_>,
        table: &Bound<'_, PyAny>,
        arguments: &Bound<'_, PyDict>,
        progress: Option<Py<PyAny>>,
        user_conductance: Option<Py<PyAny>>,
    ) -> PyResult<Result> {
        evaluate::evaluate(py, &self.0, table, arguments, progress, user_conductance)
    }

    /// The node table of its contact pairs.
    fn nodes(&self, py: Python<'_>, results: Vec<PathBuf>) -> PyResult<Result> {
        let nodes = py.detach(|| self.0.nodes(&results)).map_err(|error| raise(py, &error))?;
        let notes = nodes.notes().to_vec();
        Ok(Result::of_nodes(nodes.into_batches(), notes))
    }

    fn __repr__(&self) -> String {
        let interactions = self.0.model().interactions.len();
        let plural = if interactions == 1 { "" } else { "s" };
        format!("<Deck {:?}: {interactions} interaction{plural}>", self.0.name())
    }
}

#[pymethods]
impl Fixed {
    #[getter]
    fn findings(&self) -> usize {
        self.0.findings()
    }

    #[getter]
    fn left(&self) -> Vec<String> {
        self.0.left().to_vec()
    }

    #[getter]
    fn files(&self) -> Vec<FixedFile> {
        self.0.files().iter().cloned().map(FixedFile).collect()
    }

    #[getter]
    fn deck(&self, py: Python<'_>) -> PyResult<Deck> {
        deck_of(py, py.detach(|| self.0.deck()))
    }

    fn diff(&self) -> String {
        self.0.files().iter().map(inpact::FixedFile::difference).collect()
    }

    fn write(&self, py: Python<'_>) -> PyResult<()> {
        py.detach(|| self.0.write()).map_err(|error| raise(py, &error))
    }

    fn __repr__(&self) -> String {
        format!("<Fixed: {} findings in {} files>", self.0.findings(), self.0.files().len())
    }
}

#[pymethods]
impl FixedFile {
    #[getter]
    fn path(&self) -> PathBuf {
        self.0.path().to_owned()
    }

    #[getter]
    fn before(&self) -> &[u8] {
        self.0.before()
    }

    #[getter]
    fn after(&self) -> &[u8] {
        self.0.after()
    }

    fn __repr__(&self) -> String {
        format!("<FixedFile {:?}>", self.0.path())
    }
}
