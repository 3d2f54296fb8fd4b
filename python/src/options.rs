//! Names that Python users give as texts.

use inpact::{Dialect, ReadOptions, RelativeTo, Release};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::path::PathBuf;

/// How a deck is read, as the keyword arguments of Python say it.
#[pyclass(frozen, module = "inpact._inpact")]
pub(crate) struct Reading(pub(crate) ReadOptions);

#[pymethods]
impl Reading {
    #[new]
    #[pyo3(signature = (dialect=None, release=None, include_dirs=Vec::new(), include_root=None, relative_to=None, config=None, isolated=false))]
    fn new(
        dialect: Option<&str>,
        release: Option<&str>,
        include_dirs: Vec<PathBuf>,
        include_root: Option<PathBuf>,
        relative_to: Option<&str>,
        config: Option<PathBuf>,
        isolated: bool,
    ) -> PyResult<Self> {
        let mut options = ReadOptions::new();
        if let Some(dialect) = dialect {
            let dialects = [("abaqus", Dialect::Abaqus), ("calculix", Dialect::Calculix)];
            options = options.dialect(one_of("dialect", dialect, &dialects)?);
        }
        if let Some(release) = release {
            options =
                options.release(release.parse::<Release>().map_err(|error| PyValueError::new_err(error.to_string()))?);
        }
        for folder in include_dirs {
            options = options.include_dir(folder);
        }
        if let Some(folder) = include_root {
            options = options.include_root(folder);
        }
        if let Some(relative_to) = relative_to {
            let choices = [("deck", RelativeTo::Deck), ("including-file", RelativeTo::IncludingFile)];
            options = options.relative_to(one_of("relative_to", relative_to, &choices)?);
        }
        match (config, isolated) {
            (Some(_), true) => return Err(PyValueError::new_err("`config` and `isolated` exclude one another")),
            (Some(file), false) => options = options.configuration(file),
            (None, true) => options = options.isolated(),
            (None, false) => {}
        }
        Ok(Self(options))
    }
}

/// The choice of a name.
pub(crate) fn one_of<T: Copy>(argument: &str, name: &str, choices: &[(&str, T)]) -> PyResult<T> {
    choices.iter().find(|(choice, _)| *choice == name).map(|(_, value)| *value).ok_or_else(|| {
        let names: Vec<String> = choices.iter().map(|(choice, _)| format!("`{choice}`")).collect();
        PyValueError::new_err(format!("`{argument}`: expected {}, found `{name}`", names.join(" or ")))
    })
}
