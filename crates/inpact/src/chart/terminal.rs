//! Panels of curves as text, for a terminal of 80 columns without colours.

use super::panel::{Scales, remarks, values_of, wrapped};
use super::scale::{Scale, ScaleKind};
use super::whole;
use crate::curves::{Figure, Panel, Reach, Side, number};
use inpact_diagnostics::visible::visible_line;
use std::fmt::Write;

const WIDTH: usize = 80;

/// Rows and columns of the axes.
const ROWS: usize = 16;
const LEFT: usize = 11;
const COLUMNS: usize = WIDTH - LEFT - 1;

/// The columns of a side without a scale.
const STUB: usize = 10;

/// One letter per curve: at its rows in upper case, between them in lower case.
const LETTERS: &[u8; 24] = b"abcdefghijklmnopqrstuvwx";

/// The figures of decks, panel by panel.
pub(crate) fn text(figures: &[Figure], scales: Scales) -> String {
    let mut out = String::new();
    for figure in figures {
        if 1 < figures.len() {
            let _ = writeln!(out, "== {} ==", visible_line(&figure.deck));
        }
        for panel in &figure.panels {
            out += &Screen::of(panel, scales).text();
            out.push('\n');
        }
        for note in &figure.notes {
            for line in wrapped(&visible_line(note), WIDTH) {
                out += &format!("{line}\n");
            }
        }
    }
    out
}

struct Screen<'a> {
    panel: &'a Panel,
    y: Scale,
    /// The number of columns of the left side.
    middle: usize,
    halves: [Scale; 2],
    cells: Vec<Vec<char>>,
}

impl<'a> Screen<'a> {
    fn of(panel: &'a Panel, scales: Scales) -> Self {
        let values = values_of(std::iter::once(panel));
        let middle = match (panel.open.has_scale, panel.closed.has_scale) {
            (true, false) => COLUMNS - STUB,
            (false, true) => STUB,
            _ => COLUMNS / 2,
        };
        let half = |side: Side| {
            let of = panel.half(side);
            let knots = panel.curves.iter().flat_map(|curve| &curve.branch(side).knots).map(|knot| knot.x);
            let least = knots.filter(|x| 0.0 < *x).fold(f64::INFINITY, f64::min) / 2.0;
            let is_logarithmic = scales.x == ScaleKind::Logarithmic && least.is_finite();
            Scale::between(of.start, of.end, is_logarithmic.then_some(least))
        };
        Self {
            panel,
            y: Scale::around(values.into_iter(), scales.y),
            middle,
            halves: Side::BOTH.map(half),
            cells: vec![vec![' '; COLUMNS]; ROWS],
        }
    }

    /// The column and the row of a place, as parts of cells.
    fn place(&self, side: Side, x: f64, y: f64) -> (f64, f64) {
        let part = self.halves[side as usize].part(x).clamp(0.0, 1.0);
        let across = match side {
            Side::Open => self.middle as f64 - 1.0 - part * (self.middle as f64 - 1.0),
            Side::Closed => self.middle as f64 + 1.0 + part * (COLUMNS - self.middle - 2) as f64,
        };
        (across, (1.0 - self.y.part(y).clamp(0.0, 1.0)) * (ROWS - 1) as f64)
    }

    fn put(&mut self, (across, down): (f64, f64), character: char) {
        let (column, row) = (whole(across), whole(down));
        if let Some(cell) = self.cells.get_mut(row).and_then(|row| row.get_mut(column)) {
            *cell = character;
        }
    }

    fn draw(&mut self) {
        for row in &mut self.cells {
            row[self.middle] = '|';
        }
        for index in 0..self.panel.curves.len() {
            let letter = char::from(LETTERS[index % LETTERS.len()]);
            let is_single = self.panel.curves.len() == 1;
            for side in Side::BOTH {
                let branch = self.panel.curves[index].branch(side);
                for pair in branch.samples.windows(2) {
                    let (from, to) = (self.place(side, pair[0].x, pair[0].y), self.place(side, pair[1].x, pair[1].y));
                    let is_within = pair[0].reach == Reach::Within && pair[1].reach == Reach::Within;
                    let steps = (from.0 - to.0).abs().max((from.1 - to.1).abs()).ceil().max(1.0);
                    for step in 0..=whole(steps) {
                        let part = step as f64 / steps;
                        let at = (from.0 + part * (to.0 - from.0), from.1 + part * (to.1 - from.1));
                        // A continuation is dotted.
                        let is_gap = !is_within && !(whole(at.0) + whole(at.1)).is_multiple_of(2);
                        if !is_gap {
                            self.put(
                                at,
                                match (is_within, is_single) {
                                    (false, _) => '.',
                                    (true, true) => '*',
                                    (true, false) => letter,
                                },
                            );
                        }
                    }
                }
            }
        }
        for index in 0..self.panel.curves.len() {
            let letter = char::from(LETTERS[index % LETTERS.len()]).to_ascii_uppercase();
            let mark = if self.panel.curves.len() == 1 { 'O' } else { letter };
            for side in Side::BOTH {
                for knot in &self.panel.curves[index].branch(side).knots {
                    self.put(self.place(side, knot.x, knot.y), mark);
                }
            }
        }
        let marks: Vec<_> = self.panel.marks.iter().map(|mark| self.place(mark.side, mark.x, mark.y)).collect();
        for at in marks {
            self.put(at, '!');
        }
    }

    fn text(mut self) -> String {
        self.draw();
        let mut out = String::new();
        let mut line = |text: &str| {
            let _ = writeln!(out, "{}", text.trim_end());
        };
        let lines_of = |text: &str| wrapped(&visible_line(text), WIDTH);
        for text in lines_of(&self.panel.title()) {
            line(&text);
        }
        line(&visible_line(&self.panel.value.title()));
        let mut labels = vec![String::new(); ROWS];
        for (tick, label) in self.y.ticks(5) {
            let row = whole((1.0 - self.y.part(tick).clamp(0.0, 1.0)) * (ROWS - 1) as f64);
            labels[row.min(ROWS - 1)] = label;
        }
        for (label, cells) in labels.iter().zip(&self.cells) {
            let axis = if label.is_empty() { '|' } else { '+' };
            line(&format!("{label:>width$} {axis}{}", cells.iter().collect::<String>(), width = LEFT - 2));
        }
        line(&format!("{:>LEFT$}{}", "+", "-".repeat(COLUMNS)));
        line(&self.abscissae());
        line(&self.sides());
        if let Some(family) = &self.panel.family {
            let curves = self.panel.curves.iter().enumerate().map(|(index, curve)| {
                format!("{}={}", char::from(LETTERS[index % LETTERS.len()]), curve.at.map_or_else(String::new, number))
            });
            for text in lines_of(&format!("{}: {}", family.title(), curves.collect::<Vec<_>>().join(" "))) {
                line(&text);
            }
        }
        let mut last = Vec::new();
        last.extend(self.panel.marks.iter().map(|mark| {
            let column = &self.panel.half(mark.side).quantity.column;
            format!("! {} at {column} {}, line {}: {}", mark.code, number(mark.x), mark.line, mark.message)
        }));
        last.extend(remarks(self.panel, self.y));
        for text in last.iter().flat_map(|text| lines_of(text)) {
            line(&text);
        }
        out
    }

    /// The labels of both sides, as many as have room.
    fn abscissae(&self) -> String {
        let mut cells = vec![' '; WIDTH + 8];
        for side in Side::BOTH {
            let half = self.panel.half(side);
            if !half.has_scale {
                continue;
            }
            let scale = self.halves[side as usize];
            for (tick, label) in scale.ticks(3) {
                let across = whole(self.place(side, tick, 0.0).0) + LEFT;
                if tick == 0.0 && side == Side::Open && self.panel.closed.has_scale {
                    continue;
                }
                let start = (across + 1).saturating_sub(label.chars().count().div_ceil(2)).max(1);
                let room = start - 1..=(start + label.len()).min(cells.len() - 1);
                if room.clone().all(|cell| cells[cell] == ' ') && start + label.len() <= WIDTH {
                    label.chars().enumerate().for_each(|(index, character)| cells[start + index] = character);
                }
            }
        }
        cells.into_iter().collect()
    }

    /// The names of both sides.
    fn sides(&self) -> String {
        let title = |side: Side| {
            let half = self.panel.half(side);
            if half.has_scale { half.quantity.title() } else { side.name().to_owned() }
        };
        let (left, right) = (title(Side::Open), title(Side::Closed));
        let left = if self.panel.open.has_scale { format!("<- {left}") } else { left };
        let right = if self.panel.closed.has_scale { format!("{right} ->") } else { right };
        let room = WIDTH - LEFT.min(WIDTH);
        let gap = room.saturating_sub(left.chars().count() + right.chars().count() + 1).max(1);
        format!("{}{}{}{}", " ".repeat(LEFT), visible_line(&left), " ".repeat(gap), visible_line(&right))
    }
}
