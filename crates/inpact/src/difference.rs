//! Changes between two states of a file, as a unified diff.

use similar::TextDiff;
use std::time::Duration;

/// The time limit of the search for the shortest diff, after which a longer one is returned: files with a million changes would need hours.
const PATIENCE: Duration = Duration::from_secs(2);

/// The unified diff of a file; empty when nothing changes.
///
/// Bytes that are not UTF-8 are shown as replacement characters: the diff is for reading.
pub(crate) fn unified(path: &str, before: &[u8], after: &[u8]) -> String {
    if before == after {
        return String::new();
    }
    let (before, after) = (String::from_utf8_lossy(before), String::from_utf8_lossy(after));
    // The names below `a/` and `b/` are relative, whatever the path.
    let path = path.trim_start_matches('/');
    let diff = TextDiff::configure().timeout(PATIENCE).diff_lines(before.as_ref(), after.as_ref());
    diff.unified_diff().context_radius(3).header(&format!("a/{path}"), &format!("b/{path}")).to_string()
}

#[cfg(test)]
mod tests {
    use super::unified;

    #[test]
    fn only_what_changes_is_shown() {
        let before: String = (0..100).map(|line| format!("{line}\n")).collect();
        let after = before.replace("\n50\n", "\nfifty\n");
        let expected = "--- a/x.inp\n+++ b/x.inp\n@@ -48,7 +48,7 @@\n 47\n 48\n 49\n-50\n+fifty\n 51\n 52\n 53\n";
        assert_eq!(unified("x.inp", before.as_bytes(), after.as_bytes()), expected);
        assert_eq!(unified("x.inp", before.as_bytes(), before.as_bytes()), "");
    }

    #[test]
    fn line_ends_and_a_missing_one_are_shown() {
        let expected = "--- a/x\n+++ b/x\n@@ -1,2 +1,2 @@\n-a\r\n+A\r\n \u{FFFD}b\n\\ No newline at end of file\n";
        assert_eq!(unified("x", b"a\r\n\xFFb", b"A\r\n\xFFb"), expected);
    }

    #[test]
    fn many_changes_take_bounded_time() {
        let lines = |word: &str| (0..200_000).map(|line| format!("{line}{word}\n")).collect::<String>();
        let start = std::time::Instant::now();
        let diff = unified("x", lines(" a").as_bytes(), lines(",a").as_bytes());
        assert_eq!(diff.lines().filter(|line| line.starts_with('+')).count(), 200_001);
        assert!(start.elapsed().as_secs() < 60);
    }
}
