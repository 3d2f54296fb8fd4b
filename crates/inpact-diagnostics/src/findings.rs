//! Findings about data: those of one table or scene, collected while it is read.

use crate::diagnostic::{Cell, Diagnostic, Extent, Label};
use crate::rule::Rule;
use crate::severity::Severity;
use crate::span::{Position, SourceId, Span};
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

/// The maximum number of findings of one rule in one table; more are only counted.
const MAX_OF_ONE_RULE: usize = 20;

/// A place in a table or a scene as known to a reader; parts that do not apply are `None`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Place {
    /// The row, counted from 1 below the header.
    pub row: Option<u64>,
    /// The line of the file, from 1.
    pub line: Option<u64>,
    /// The header of the column.
    pub column: Option<String>,
    /// Its bytes in the file, and the column of the first of them, in characters from 1.
    pub exact: Option<(Range<u64>, u64)>,
}

impl Place {
    /// A line, from 1.
    pub fn of_line(line: u64) -> Self {
        Self { line: Some(line), ..Self::default() }
    }

    /// The place as a label.
    pub fn label(&self, file: &Arc<str>) -> Label {
        let extent = match (&self.exact, self.line) {
            (Some(_), Some(_)) => Extent::Span,
            (_, Some(_)) => Extent::Line,
            (_, None) => Extent::File,
        };
        let (bytes, column) = self.exact.clone().unwrap_or((0..0, 1));
        Label {
            file: Arc::clone(file),
            span: Span::new(SourceId::ROOT, bytes.start, bytes.end),
            position: Position { line: self.line.unwrap_or(1), column },
            extent,
            text: String::new(),
            lines: None,
        }
    }
}

/// Collects the findings of one table: the first of each rule, and counts.
#[derive(Debug)]
pub struct Findings {
    file: Arc<str>,
    kept: Vec<Diagnostic>,
    /// The number of findings of each rule, by its code.
    reported: BTreeMap<&'static str, usize>,
}

impl Findings {
    /// No findings yet, for the table of that name.
    pub fn new(file: &str) -> Self {
        Self { file: Arc::from(file), kept: Vec::new(), reported: BTreeMap::new() }
    }

    /// Reports a finding; an empty `help` means none.
    pub fn report(&mut self, rule: &Rule, place: Place, message: impl Into<String>, help: impl Into<String>) {
        self.report_as(rule.severity, rule, place, message, help);
    }

    /// Reports a finding with another severity than its rule.
    pub fn report_as(
        &mut self,
        severity: Severity,
        rule: &Rule,
        place: Place,
        message: impl Into<String>,
        help: impl Into<String>,
    ) {
        let count = self.reported.entry(rule.code).or_default();
        *count += 1;
        if *count > MAX_OF_ONE_RULE {
            return;
        }
        let mut found = Diagnostic::new(rule, message, place.label(&self.file));
        found.severity = severity;
        found.help = Some(help.into()).filter(|help| !help.is_empty());
        found.cell = Some(Cell { row: place.row, field: place.column });
        self.kept.push(found);
    }

    /// The findings that are kept, in the order they were reported.
    pub fn list(&self) -> &[Diagnostic] {
        &self.kept
    }

    /// Whether one of them is an error.
    pub fn has_errors(&self) -> bool {
        self.kept.iter().any(|found| found.severity == Severity::Error)
    }

    /// The findings in the order they were reported; the last of a rule gives the number left out.
    pub fn into_list(mut self) -> Vec<Diagnostic> {
        for (code, count) in self.reported {
            let Some(hidden) = count.checked_sub(MAX_OF_ONE_RULE).filter(|hidden| *hidden > 0) else { continue };
            if let Some(last) = self.kept.iter_mut().rfind(|found| found.code == code) {
                let more = format!("{hidden} more findings of this rule in this table are not shown");
                last.help = Some(last.help.take().map_or_else(|| more.clone(), |help| format!("{help}; {more}")));
            }
        }
        self.kept
    }
}
