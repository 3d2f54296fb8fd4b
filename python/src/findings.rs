//! Findings as Python objects.

use inpact::{Diagnostic, FixSafety};
use pyo3::prelude::*;

/// One finding: what is wrong, where, why, and what to do.
#[pyclass(module = "inpact", frozen)]
pub(crate) struct Finding(Diagnostic);

/// A change of the deck that makes a finding go away.
#[pyclass(module = "inpact", frozen)]
pub(crate) struct Fix(inpact::Fix);

impl From<Diagnostic> for Finding {
    fn from(found: Diagnostic) -> Self {
        Self(found)
    }
}

impl Finding {
    pub(crate) fn diagnostic(&self) -> &Diagnostic {
        &self.0
    }
}

#[pymethods]
impl Finding {
    #[getter]
    fn code(&self) -> &str {
        self.0.code
    }

    #[getter]
    fn name(&self) -> &str {
        self.0.name
    }

    #[getter]
    fn severity(&self) -> String {
        self.0.severity.to_string()
    }

    #[getter]
    fn message(&self) -> &str {
        &self.0.message
    }

    #[getter]
    fn file(&self) -> &str {
        &self.0.primary.file
    }

    #[getter]
    fn line(&self) -> Option<u64> {
        self.0.primary.line()
    }

    #[getter]
    fn column(&self) -> Option<u64> {
        self.0.primary.column()
    }

    #[getter]
    fn span(&self) -> Option<(u64, u64)> {
        self.0.primary.bytes().map(|[start, end]| (start, end))
    }

    #[getter]
    fn row(&self) -> Option<u64> {
        self.0.cell.as_ref()?.row
    }

    #[getter]
    fn field(&self) -> Option<&str> {
        self.0.cell.as_ref()?.field.as_deref()
    }

    #[getter]
    fn note(&self) -> Option<&str> {
        self.0.note.as_deref()
    }

    #[getter]
    fn help(&self) -> Option<&str> {
        self.0.help.as_deref()
    }

    #[getter]
    fn fix(&self) -> Option<Fix> {
        self.0.fix.clone().map(Fix)
    }

    fn __str__(&self) -> String {
        let Diagnostic { code, severity, message, primary, .. } = &self.0;
        let line = primary.line().map_or_else(String::new, |line| format!(":{line}"));
        let column = primary.column().map_or_else(String::new, |column| format!(":{column}"));
        format!("{}{line}{column}: {severity}[{code}] {message}", primary.file)
    }

    fn __repr__(&self) -> String {
        format!("<Finding {}>", self.__str__())
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| other.get().0 == self.0)
    }

    fn __hash__(&self) -> u64 {
        use std::hash::{DefaultHasher, Hash, Hasher};
        let mut hasher = DefaultHasher::new();
        (self.0.code, &self.0.primary.file, self.0.primary.span, &self.0.message).hash(&mut hasher);
        hasher.finish()
    }
}

#[pymethods]
impl Fix {
    #[getter]
    fn title(&self) -> &str {
        &self.0.title
    }

    #[getter]
    fn is_safe(&self) -> bool {
        self.0.safety == FixSafety::Safe
    }

    #[getter]
    fn edits(&self) -> Vec<(u64, u64, &[u8])> {
        self.0.edits.iter().map(|edit| (edit.span.start(), edit.span.end(), edit.replacement.as_slice())).collect()
    }

    fn __repr__(&self) -> String {
        format!("<Fix {:?}>", self.0.title)
    }
}
