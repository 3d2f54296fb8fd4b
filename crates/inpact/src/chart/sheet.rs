//! Panels on one sheet: those of one deck in two columns, several decks side by side with the same axes.

use super::colours;
use super::panel::{self, Plot, Scales, shortened, values_of, wrapped};
use super::scale::{Scale, ScaleKind};
use super::svg::Drawing;
use super::whole;
use crate::curves::{Figure, LawKind, Panel, number};
use inpact_diagnostics::visible::visible_line;

/// The margin around panels.
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

impl Figure {
    /// The panels as an SVG document, on linear axes.
    pub fn svg(&self) -> String {
        svg(std::slice::from_ref(self), Scales::LINEAR)
    }

    /// The panels as text, for 80 columns, on linear axes.
    pub fn letters(&self) -> String {
        super::terminal::text(std::slice::from_ref(self), Scales::LINEAR)
    }
}

pub(crate) fn svg_of_panel(of: &Panel) -> String {
    let mut drawing = Drawing::new(panel::WIDTH, panel::HEIGHT, &visible_line(&of.description()));
    Plot::new(of, (0.0, 0.0), Scales::LINEAR, &values_of(std::iter::once(of))).draw(&mut drawing);
    drawing.finish()
}

/// A sum over an interface against time as an SVG document.
pub(crate) fn svg_of_history(interaction: &str, output: &str, points: &[(f64, f64)]) -> String {
    let (width, height) = (panel::WIDTH, 300.0);
    let (left, right, top, bottom) = (92.0, width - 24.0, 24.0, height - 58.0);
    let title = format!("{output} of {interaction} against time, {} times", points.len());
    let mut drawing = Drawing::new(width, height, &visible_line(&title));
    let x = Scale::around(points.iter().map(|point| point.0), ScaleKind::Linear);
    let y = Scale::around(points.iter().map(|point| point.1), ScaleKind::Linear);
    let across = |at: f64| left + x.part(at) * (right - left);
    let up = |at: f64| bottom - y.part(at) * (bottom - top);
    for (tick, label) in y.ticks(5) {
        drawing.line((left, up(tick)), (right, up(tick)), "grid");
        drawing.text((left - 8.0, up(tick) + 4.5), &label, "tick", "end");
    }
    for (tick, label) in x.ticks(7) {
        drawing.line((across(tick), bottom), (across(tick), bottom + 5.0), "tick-line");
        drawing.text((across(tick), bottom + 19.0), &label, "tick", "middle");
    }
    drawing.line((left, bottom), (right, bottom), "axis");
    drawing.line((left, top), (left, bottom), "axis");
    drawing.text((f64::midpoint(left, right), bottom + 40.0), "time", "axis-title", "middle");
    drawing.upright_text((18.0, f64::midpoint(top, bottom)), output, "axis-title");
    let places: Vec<(f64, f64)> = points.iter().map(|(time, value)| (across(*time), up(*value))).collect();
    let colour = colours::of_curve(0, 1);
    drawing.polyline(&places, &format!(r#"fill="none" stroke="{colour}" stroke-width="2""#));
    if places.len() <= 100 {
        for (place, (time, value)) in places.iter().zip(points) {
            drawing.mark(*place, 0, &colour, &format!("time {}: {}", number(*time), number(*value)));
        }
    }
    drawing.finish()
}

/// All panels of the law that a panel is of.
fn multiples<'a>(figures: &'a [Figure], of: &'a Panel) -> impl Iterator<Item = &'a Panel> {
    let panels = figures.iter().flat_map(|figure| &figure.panels);
    panels.filter(|panel| panel.law == of.law && panel.interaction == of.interaction)
}

/// A row for each law that any deck has; the cell of a deck without it is empty.
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
