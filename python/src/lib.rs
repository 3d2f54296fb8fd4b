//! The Python module `inpact._inpact`: the front door of inpact as Python classes.
//!
//! Thin: no rule, no law and no parser of its own.
//! Python users see the package `inpact` beside it, with docstrings and types; NumPy is imported there, when it is first needed.

mod deck;
mod errors;
mod evaluate;
mod findings;
mod laws;
mod options;
mod scene;
mod watch;

use pyo3::prelude::*;
use std::ffi::OsString;
use std::process::ExitCode;

/// Runs the command line with these arguments, the name of the program first; gives the exit code.
#[pyfunction]
fn command(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    let code = py.detach(|| inpact::cli::run(arguments));
    // An exit code tells its number only as text.
    (0..=u8::MAX).find(|number| code == ExitCode::from(*number)).unwrap_or(2)
}

/// The page of a rule, a keyword or a column, as Markdown.
#[pyfunction]
fn explain(py: Python<'_>, what: &str) -> PyResult<String> {
    inpact::pages::explain(what).map_err(|error| errors::raise(py, &error))
}

#[pymodule]
fn _inpact(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<deck::Deck>()?;
    module.add_class::<deck::Fixed>()?;
    module.add_class::<deck::FixedFile>()?;
    module.add_class::<findings::Finding>()?;
    module.add_class::<findings::Fix>()?;
    module.add_class::<laws::GapConductance>()?;
    module.add_class::<evaluate::Result>()?;
    module.add_class::<options::Reading>()?;
    module.add_class::<scene::Solution>()?;
    module.add_function(wrap_pyfunction!(deck::read, module)?)?;
    module.add_function(wrap_pyfunction!(deck::parse, module)?)?;
    module.add_function(wrap_pyfunction!(deck::from_json, module)?)?;
    module.add_function(wrap_pyfunction!(scene::solve, module)?)?;
    module.add_function(wrap_pyfunction!(explain, module)?)?;
    module.add_function(wrap_pyfunction!(command, module)?)
}
