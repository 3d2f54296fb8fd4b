//! Panels on one sheet: those of one deck in two columns, several decks side by side with the same axes.

use super::panel::{self, Plot, Scales, shortened, values_of, wrapped};
use super::svg::Drawing;
use super::whole;
use crate::curves::{Figure, LawKind, Panel};
use inpact_diagnostics::visible::visible_line;

/// The room around panels.
const MARGIN: f64 = 14.0;

/// The height of the title of a sheet.
const TITLE: f64 = 44.0;

/// The height of a line below the panels.
const LINE: f64 = 18.0;

/// The number of panels of one deck side by side.
const COLUMNS: usize = 2;

/// The figures of decks as one SVG document.
pub(crate) fn svg(figures: &[Figure], scales: Scales) -> String {
    let (rows, columns) = match figures {
        [figure] => {
            let columns = figure.panels.len().clamp(1, COLUMNS);
            let rows: Vec<Vec<Option<&Panel>>> =
                figure.panels.chunks(columns).map(|row| row.iter().map(Some).collect()).collect();
            (rows, columns)
        }
        figures => (side_by_side(figures), figures.len()),
    };
    let width = 2.0 * MARGIN + columns as f64 * panel::WIDTH;
    let notes = notes(figures, whole((width / 6.6).floor()));
    let height = TITLE + rows.len() as f64 * panel::HEIGHT + notes.len() as f64 * LINE + MARGIN;
    let names: Vec<&str> = figures.iter().map(|figure| figure.deck.as_str()).collect();
    let mut drawing = Drawing::new(width, height, &alternative(figures));
    let each = whole((panel::WIDTH / 9.4).floor());
    for (column, name) in names.iter().enumerate() {
        let x = MARGIN + 22.0 + column as f64 * panel::WIDTH;
        drawing.text((x, 30.0), &shortened(&visible_line(name), each), "sheet-title", "start");
    }
    for (row, panels) in rows.iter().enumerate() {
        let shared = values_of(panels.iter().flatten().copied());
        for (column, of) in panels.iter().enumerate() {
            let corner = (MARGIN + column as f64 * panel::WIDTH, TITLE + row as f64 * panel::HEIGHT);
            let Some(of) = of else { continue };
            // Small multiples of one law are compared, as the same law of several decks is.
            let own = if figures.len() == 1 { values_of(multiples(figures, of)) } else { Vec::new() };
            let values = if figures.len() == 1 { &own } else { &shared };
            Plot::new(of, corner, scales, values).draw(&mut drawing);
        }
    }
    for (line, note) in notes.iter().enumerate() {
        let y = TITLE + rows.len() as f64 * panel::HEIGHT + LINE * (line as f64 + 0.5);
        drawing.text((MARGIN + 22.0, y), note, "note", "start");
    }
    drawing.finish()
}

/// All panels of the law that a panel is of.
fn multiples<'a>(figures: &'a [Figure], of: &'a Panel) -> impl Iterator<Item = &'a Panel> {
    let panels = figures.iter().flat_map(|figure| &figure.panels);
    panels.filter(|panel| panel.law == of.law && panel.interaction == of.interaction)
}

/// A row for each law that any deck has; a deck without it leaves its place empty.
fn side_by_side(figures: &[Figure]) -> Vec<Vec<Option<&Panel>>> {
    let key = |panel: &Panel| (panel.interaction.to_ascii_uppercase(), panel.law, held_key(panel));
    let mut keys: Vec<(String, LawKind, String)> = Vec::new();
    for panel in figures.iter().flat_map(|figure| &figure.panels) {
        if !keys.contains(&key(panel)) {
            keys.push(key(panel));
        }
    }
    let row = |wanted: &(String, LawKind, String)| {
        figures.iter().map(|figure| figure.panels.iter().find(|panel| key(panel) == *wanted)).collect()
    };
    keys.iter().map(row).collect()
}

fn held_key(panel: &Panel) -> String {
    panel.held.iter().map(|held| format!("{}={:e};", held.quantity.column, held.at)).collect()
}

/// The parts that are not drawn, in lines.
fn notes(figures: &[Figure], width: usize) -> Vec<String> {
    let notes = figures.iter().flat_map(|figure| figure.notes.iter().map(move |note| (figure, note)));
    let lines = notes.flat_map(|(figure, note)| {
        let note = if figures.len() == 1 { note.clone() } else { format!("{}: {note}", figure.deck) };
        wrapped(&visible_line(&note), width)
    });
    lines.collect()
}

/// The alternative text of the sheet.
fn alternative(figures: &[Figure]) -> String {
    let decks = figures.iter().map(|figure| {
        let panels: Vec<String> = figure.panels.iter().map(Panel::description).collect();
        visible_line(&format!("{}: {}", figure.deck, panels.join("; "))).into_owned()
    });
    decks.collect::<Vec<_>>().join(". ")
}
