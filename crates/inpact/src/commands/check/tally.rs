//! Counts of findings, for summary and statistics.

use inpact_validation::rules::RULES;
use inpact_validation::{Diagnostic, Severity};
use std::collections::BTreeMap;

/// Counts of findings, by severity and by code.
#[derive(Debug, Default, Clone)]
pub(super) struct Tally {
    severities: BTreeMap<Severity, usize>,
    codes: BTreeMap<&'static str, usize>,
}

impl Tally {
    pub(super) fn of_findings(diagnostics: &[Diagnostic]) -> Self {
        let mut tally = Self::default();
        for found in diagnostics {
            *tally.severities.entry(found.severity).or_default() += 1;
            *tally.codes.entry(found.code).or_default() += 1;
        }
        tally
    }

    pub(super) fn add(&mut self, other: &Self) {
        for (severity, number) in &other.severities {
            *self.severities.entry(*severity).or_default() += number;
        }
        for (code, number) in &other.codes {
            *self.codes.entry(code).or_default() += number;
        }
    }

    pub(super) fn of(&self, severity: Severity) -> usize {
        self.severities.get(&severity).copied().unwrap_or(0)
    }

    pub(super) fn summary(&self, decks: usize) -> String {
        if self.codes.is_empty() {
            return format!("{}: nothing to report", count(decks, "deck"));
        }
        let of = |severity: Severity| count(self.of(severity), severity.name());
        format!("{}: {}, {}, {}", count(decks, "deck"), of(Severity::Error), of(Severity::Warning), of(Severity::Note))
    }

    /// A line a code: how often, code, name.
    pub(super) fn statistics(&self) -> String {
        let mut lines: Vec<_> = self.codes.iter().collect();
        lines.sort_by_key(|(code, number)| (std::cmp::Reverse(**number), **code));
        let name = |code: &str| RULES.iter().find(|rule| rule.code == code).map_or("", |rule| rule.name);
        lines.iter().map(|(code, number)| format!("{number:8}  {code}  {}\n", name(code))).collect()
    }
}

/// A number of things.
pub(super) fn count(number: usize, word: &str) -> String {
    format!("{number} {word}{}", if number == 1 { "" } else { "s" })
}
