//! What changes between two states of a file, as a unified diff.

use similar::TextDiff;

/// The unified diff of a file; empty when nothing changes.
///
/// Bytes that are not UTF-8 are shown as replacement characters: the diff is for reading.
pub(crate) fn unified(path: &str, before: &[u8], after: &[u8]) -> String {
    if before == after {
        return String::new();
    }
    let (before, after) = (String::from_utf8_lossy(before), String::from_utf8_lossy(after));
    let diff = TextDiff::from_lines(before.as_ref(), after.as_ref());
    diff.unified_diff().context_radius(3).header(&format!("a/{path}"), &format!("b/{path}")).to_string()
}
