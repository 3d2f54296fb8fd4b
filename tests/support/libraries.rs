//! The libraries of the workspace, for tests that read their source.

use std::path::{Path, PathBuf};

/// The libraries, the lowest first.
pub(crate) const LIBRARIES: [&str; 10] = [
    "inpact-diagnostics",
    "inpact-geometry",
    "inpact-results",
    "inpact-parser",
    "inpact-validation",
    "inpact-evaluation",
    "inpact-contact",
    "inpact-network",
    "inpact-body",
    "inpact",
];

/// The folder of a library.
pub(crate) fn folder(library: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates").join(library)
}
