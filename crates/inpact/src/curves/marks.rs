//! Findings of a check, located on the curves.

use super::rows::LawRows;
use super::{Figure, Panel, Side};
use inpact_diagnostics::{Diagnostic, Extent, Severity};
use inpact_parser::model::Model;
use inpact_parser::span::Span;

/// A finding at a row of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// On which side of contact.
    pub side: Side,
    /// Clearance or contact pressure of the row.
    pub x: f64,
    /// The value of the row.
    pub y: f64,
    /// The code of the rule, such as `T001`.
    pub code: &'static str,
    /// Its severity.
    pub severity: Severity,
    /// The fault.
    pub message: String,
    /// The line of the deck, from 1.
    pub line: u64,
}

/// Marks the findings of a check on the panels of a deck.
pub fn mark_findings(figure: &mut Figure, model: &Model, found: &[Diagnostic]) {
    let in_deck: Vec<&Diagnostic> = found.iter().filter(|found| found.primary.extent == Extent::Span).collect();
    for panel in &mut figure.panels {
        let Some(interaction) = model.interactions.values().find(|of| of.name.written() == panel.interaction) else {
            continue;
        };
        let rows = LawRows::of(model, interaction, panel.law);
        let marks = Side::BOTH.into_iter().flat_map(|side| {
            let of_side = rows.side(side);
            let marks = in_deck.iter().filter_map(|found| {
                let rows = of_side?;
                let row = row_at(&rows.spans, found.primary.span)?;
                let cells = rows.row(row);
                let (y, x) = (*cells.first()?, *cells.get(1)?);
                (is_drawn(panel, side, row) && x.is_finite() && y.is_finite()).then(|| Mark {
                    side,
                    x,
                    y,
                    code: found.code,
                    severity: found.severity,
                    message: found.message.clone(),
                    line: found.primary.position.line,
                })
            });
            marks.collect::<Vec<_>>()
        });
        panel.marks = marks.collect();
    }
}

fn row_at(spans: &[Span], place: Span) -> Option<usize> {
    spans.iter().position(|span| span.contains(place))
}

/// Whether a row lies on a curve of the panel; too many rows are not marked.
fn is_drawn(panel: &Panel, side: Side, row: usize) -> bool {
    panel.curves.iter().any(|curve| {
        let branch = curve.branch(side);
        branch.knots.iter().any(|knot| knot.row == row) || (branch.knots.is_empty() && 0 < branch.knot_count)
    })
}
