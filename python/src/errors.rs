//! Errors of the library as Python exceptions: `inpact.DeckError` with its findings, `OSError` for files, `ValueError` for wrong usage.

use crate::findings::Finding;
use pyo3::exceptions::{PyFileNotFoundError, PyOSError, PyValueError};
use pyo3::prelude::*;
use std::error::Error as _;
use std::io;

/// The exception that an error is.
pub(crate) fn raise(py: Python<'_>, error: &inpact::Error) -> PyErr {
    let message = error.to_string();
    if error.is_io() {
        let cause = error.source().and_then(|cause| cause.downcast_ref::<io::Error>());
        return match cause.map(io::Error::kind) {
            Some(io::ErrorKind::NotFound) => PyFileNotFoundError::new_err(message),
            _ => PyOSError::new_err(message),
        };
    }
    if error.is_usage() {
        return PyValueError::new_err(message);
    }
    let findings: Vec<Finding> = error.findings().iter().cloned().map(Finding::from).collect();
    // The class stands in Python, where its documentation is.
    let made = py.import("inpact._errors").and_then(|module| module.getattr("DeckError")?.call1((message, findings)));
    made.map_or_else(|error| error, |exception| PyErr::from_value(exception))
}
