//! Counts of findings, for summary and statistics.

use crate::render::Format;
use crate::rules;
use crate::text::counted;
use inpact_diagnostics::FixSafety;
use inpact_validation::{Diagnostic, Severity};
use std::collections::BTreeMap;

/// Counts of findings, by severity and by code.
#[derive(Debug, Default, Clone)]
pub(super) struct Tally {
    severities: BTreeMap<Severity, usize>,
    codes: BTreeMap<&'static str, OfCode>,
}

/// Findings of one rule.
#[derive(Debug, Default, Clone, Copy)]
struct OfCode {
    count: usize,
    /// The number of them that `--fix` fixes.
    fixable: usize,
}

impl Tally {
    pub(super) fn of_findings(diagnostics: &[Diagnostic]) -> Self {
        let mut tally = Self::default();
        for found in diagnostics {
            *tally.severities.entry(found.severity).or_default() += 1;
            let of_code = tally.codes.entry(found.code).or_default();
            of_code.count += 1;
            of_code.fixable += usize::from(found.fix.as_ref().is_some_and(|fix| fix.safety == FixSafety::Safe));
        }
        tally
    }

    /// The same for findings without an applied fix.
    pub(super) fn without_fixes(diagnostics: &[Diagnostic]) -> Self {
        let mut tally = Self::of_findings(diagnostics);
        tally.codes.values_mut().for_each(|of_code| of_code.fixable = 0);
        tally
    }

    pub(super) fn add(&mut self, other: &Self) {
        for (severity, number) in &other.severities {
            *self.severities.entry(*severity).or_default() += number;
        }
        for (code, more) in &other.codes {
            let of_code = self.codes.entry(code).or_default();
            of_code.count += more.count;
            of_code.fixable += more.fixable;
        }
    }

    pub(super) fn of(&self, severity: Severity) -> usize {
        self.severities.get(&severity).copied().unwrap_or(0)
    }

    pub(super) fn summary(&self, decks: usize, scenes: usize) -> String {
        let checked = match (decks, scenes) {
            (_, 0) => counted(decks, "deck"),
            (0, _) => counted(scenes, "scene"),
            _ => format!("{} and {}", counted(decks, "deck"), counted(scenes, "scene")),
        };
        if self.codes.is_empty() {
            return format!("{checked}: nothing to report");
        }
        let of = |severity: Severity| counted(self.of(severity), severity.name());
        format!("{checked}: {}, {}, {}", of(Severity::Error), of(Severity::Warning), of(Severity::Note))
    }

    /// The rules with findings, the most frequent first: one line each, or a JSON array.
    ///
    /// As in ruff: where any finding can be fixed, `[*]` marks rules all of whose findings `--fix` fixes, `[-]` those of which it fixes some.
    pub(super) fn statistics(&self, format: Format) -> String {
        let mut lines: Vec<_> = self.codes.iter().collect();
        lines.sort_by_key(|(code, of_code)| (std::cmp::Reverse(of_code.count), **code));
        let name = |code: &str| rules::of_code(code).map_or("", |rule| rule.name);
        if format == Format::Json {
            let objects: Vec<String> = lines
                .iter()
                .map(|(code, OfCode { count, fixable })| {
                    let (code, name) = (serde_json::json!(code), serde_json::json!(name(code)));
                    format!("  {{\"code\":{code},\"name\":{name},\"count\":{count},\"fixable_count\":{fixable}}}")
                })
                .collect();
            return if objects.is_empty() { "[]\n".to_owned() } else { format!("[\n{}\n]\n", objects.join(",\n")) };
        }
        let has_marks = self.fixable() > 0;
        let mark = |of_code: &OfCode| match of_code.fixable {
            _ if !has_marks => "",
            0 => "[ ] ",
            fixable if fixable == of_code.count => "[*] ",
            _ => "[-] ",
        };
        let line = |(code, of_code): &(&&str, &OfCode)| {
            format!("{:8}  {code}  {}{}\n", of_code.count, mark(of_code), name(code))
        };
        lines.iter().map(line).collect()
    }

    /// The number of findings that `--fix` fixes.
    pub(super) fn fixable(&self) -> usize {
        self.codes.values().map(|of_code| of_code.fixable).sum()
    }
}
