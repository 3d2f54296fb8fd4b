//! Scenes: what is held, what conducts, and the states that follow.

use crate::errors::raise;
use crate::options::{Reading, one_of};
use crate::watch::{self, Watch};
use inpact::{Field, Method, Scene, SolveOptions};
use numpy::PyArray1;
use pyo3::prelude::*;
use std::ops::ControlFlow;
use std::path::PathBuf;

/// The states of a scene.
#[pyclass(module = "inpact", frozen)]
pub(crate) struct Solution(inpact::Solution);

const FIELDS: [(&str, Field); 3] =
    [("potential", Field::Potential), ("temperature", Field::Temperature), ("pore_pressure", Field::PorePressure)];

/// Solves the scene of a file.
#[pyfunction]
#[pyo3(signature = (path, solver, tolerance, reading, progress))]
pub(crate) fn solve(
    py: Python<'_>,
    path: PathBuf,
    solver: &str,
    tolerance: Option<f64>,
    reading: &Reading,
    progress: Option<Py<PyAny>>,
) -> PyResult<Solution> {
    let methods = [("direct", Method::Direct), ("mixed", Method::Mixed), ("iterative", Method::Iterative)];
    let mut options = SolveOptions::new().method(one_of("solver", solver, &methods)?);
    if let Some(tolerance) = tolerance {
        options = options.tolerance(tolerance);
    }
    let watch = Watch::default();
    let mut states = 0;
    let solved = watch::run(py, &watch, progress, || {
        let scene = Scene::read(&path, &reading.0)?;
        scene.solve_watched(&options, |_| {
            states += 1;
            if watch.advance(states) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })
    })?;
    solved.map(Solution).map_err(|error| raise(py, &error))
}

#[pymethods]
impl Solution {
    #[getter]
    fn nodes(&self) -> Vec<String> {
        self.0.nodes().to_vec()
    }

    #[getter]
    fn links(&self) -> Vec<(&str, &str)> {
        let name = |node: u32| self.0.nodes()[node as usize].as_str();
        self.0.links().iter().map(|[first, second]| (name(*first), name(*second))).collect()
    }

    #[getter]
    fn fields(&self) -> Vec<&'static str> {
        let is_solved = |(_, field): &&(&str, Field)| self.0.fields().contains(field);
        FIELDS.iter().filter(is_solved).map(|(name, _)| *name).collect()
    }

    #[getter]
    fn left_out(&self) -> Vec<String> {
        self.0.left_out().to_vec()
    }

    #[getter]
    fn times<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_iter(py, self.0.states().iter().map(inpact::SolvedState::time))
    }

    /// The values of a field, state after state, node after node, NaN where one is not known.
    fn flat_values<'py>(&self, py: Python<'py>, field: &str) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let field = one_of("field", field, &FIELDS)?;
        let values = self.0.states().iter().flat_map(|state| state.values(field));
        Ok(PyArray1::from_iter(py, values.map(|value| value.unwrap_or(f64::NAN)).collect::<Vec<_>>()))
    }

    /// The flows of a field through the links, state after state, link after link, NaN where one is not known.
    fn flat_flows<'py>(&self, py: Python<'py>, field: &str) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let field = one_of("field", field, &FIELDS)?;
        let flows = self.0.states().iter().flat_map(|state| state.flows(field));
        Ok(PyArray1::from_iter(py, flows.map(|flow| flow.unwrap_or(f64::NAN)).collect::<Vec<_>>()))
    }

    fn __repr__(&self) -> String {
        let (states, nodes) = (self.0.states().len(), self.0.nodes().len());
        format!("<Solution of {}: {nodes} nodes, {states} states>", self.fields().join(", "))
    }
}
