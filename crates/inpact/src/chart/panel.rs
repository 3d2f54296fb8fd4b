//! A panel of curves as in figure 37.3.1-1 of the Analysis User's Guide: clearance to the left of contact, pressure to the right, one axis of values.

use super::colours;
use super::scale::{Scale, ScaleKind};
use super::svg::Drawing;
use super::whole;
use crate::curves::{Panel, Reach, Sample, Side, number};
use inpact_diagnostics::Severity;
use inpact_diagnostics::visible::visible_line;
use std::collections::BTreeSet;

/// The logarithmic axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Scales {
    pub(crate) x: ScaleKind,
    pub(crate) y: ScaleKind,
}

impl Scales {
    /// None is.
    pub(crate) const LINEAR: Self = Self { x: ScaleKind::Linear, y: ScaleKind::Linear };
}

/// The size of a panel.
pub(crate) const WIDTH: f64 = 640.0;
pub(crate) const HEIGHT: f64 = 420.0;

const LEFT: f64 = 92.0;
const RIGHT: f64 = WIDTH - 128.0;
const TOP: f64 = 66.0;
const BOTTOM: f64 = HEIGHT - 84.0;

/// The width of a side without rows, relative to the whole.
const STUB: f64 = 0.16;

/// The maximum number of curves with a legend entry each.
const MAX_LEGEND: usize = 10;

/// The number of bars of a histogram along a whole axis.
const BARS: usize = 40;

/// The length of the longest bar.
const BAR: f64 = 26.0;

/// A panel with its axes in place.
pub(super) struct Plot<'a> {
    panel: &'a Panel,
    /// Its upper left corner.
    corner: (f64, f64),
    y: Scale,
    halves: [HalfPlot; 2],
}

/// One side of contact in place.
#[derive(Debug, Clone, Copy)]
struct HalfPlot {
    /// The ends of its axis, from contact.
    from: f64,
    to: f64,
    scale: Scale,
}

impl<'a> Plot<'a> {
    /// A panel with its upper left corner at a position; `values` are those that its axis must include.
    pub(super) fn new(panel: &'a Panel, corner: (f64, f64), scales: Scales, values: &[f64]) -> Self {
        let middle = contact(panel);
        let half = |side: Side| {
            let of = panel.half(side);
            let least = (scales.x == ScaleKind::Logarithmic).then(|| least_above_zero(panel, side)).flatten();
            let (from, to) = match side {
                Side::Open => (middle, LEFT),
                Side::Closed => (middle, RIGHT),
            };
            HalfPlot { from, to, scale: Scale::between(of.start, of.end, least) }
        };
        let y = Scale::around(values.iter().copied(), scales.y);
        Self { panel, corner, y, halves: Side::BOTH.map(half) }
    }

    fn half(&self, side: Side) -> HalfPlot {
        self.halves[side as usize]
    }

    /// The position of a value.
    fn place(&self, side: Side, x: f64, y: f64) -> (f64, f64) {
        (self.across(side, x), self.up(y))
    }

    fn across(&self, side: Side, x: f64) -> f64 {
        let half = self.half(side);
        self.corner.0 + half.from + half.scale.part(x).clamp(0.0, 1.0) * (half.to - half.from)
    }

    fn up(&self, y: f64) -> f64 {
        self.corner.1 + BOTTOM - self.y.part(y).clamp(0.0, 1.0) * (BOTTOM - TOP)
    }

    fn at(&self, x: f64, y: f64) -> (f64, f64) {
        (self.corner.0 + x, self.corner.1 + y)
    }

    pub(super) fn draw(&self, drawing: &mut Drawing) {
        self.draw_titles(drawing);
        self.draw_axes(drawing);
        self.draw_nodes(drawing);
        let count = self.panel.curves.len();
        for index in 0..count {
            self.draw_curve(drawing, index, &colours::of_curve(index, count));
        }
        self.draw_marks(drawing);
        self.draw_legend(drawing);
        self.draw_footnotes(drawing);
    }

    fn draw_titles(&self, drawing: &mut Drawing) {
        let title = shortened(&visible_line(&self.panel.title()), 68);
        drawing.text(self.at(LEFT - 70.0, 26.0), &title, "panel-title", "start");
    }

    fn draw_axes(&self, drawing: &mut Drawing) {
        for (tick, label) in self.y.ticks(6) {
            let y = self.up(tick) - self.corner.1;
            drawing.line(self.at(LEFT, y), self.at(RIGHT, y), "grid");
            drawing.text(self.at(LEFT - 8.0, y + 4.5), &label, "tick", "end");
        }
        for side in Side::BOTH {
            self.draw_abscissae(drawing, side);
        }
        drawing.line(self.at(LEFT, BOTTOM), self.at(RIGHT, BOTTOM), "axis");
        drawing.line(self.at(LEFT, TOP), self.at(LEFT, BOTTOM), "axis");
        let middle = self.half(Side::Open).from;
        drawing.line(self.at(middle, TOP - 8.0), self.at(middle, BOTTOM), "contact");
        drawing.text(self.at(middle, TOP - 13.0), "contact", "tick", "middle");
        let title = shortened(&visible_line(&self.panel.value.title()), 46);
        drawing.upright_text(self.at(18.0, f64::midpoint(TOP, BOTTOM)), &title, "axis-title");
    }

    fn draw_abscissae(&self, drawing: &mut Drawing, side: Side) {
        let half = self.half(side);
        let of = self.panel.half(side);
        let width = (half.to - half.from).abs();
        if of.has_scale {
            let ticks = half.scale.ticks(whole((width / 62.0).floor()));
            let mut before = f64::INFINITY;
            for (tick, label) in ticks {
                let x = self.across(side, tick) - self.corner.0;
                let is_at_contact = (x - half.from).abs() < 1.0;
                drawing.line(self.at(x, BOTTOM), self.at(x, BOTTOM + 5.0), "tick-line");
                // At contact both sides share zero: only the label of the right side is kept.
                let is_crowded = (x - before).abs() < 7.5 * label.chars().count() as f64 + 6.0;
                if is_crowded || (is_at_contact && side == Side::Open && self.panel.closed.has_scale) {
                    continue;
                }
                if !is_at_contact {
                    drawing.line(self.at(x, TOP), self.at(x, BOTTOM), "fine");
                }
                drawing.text(self.at(x, BOTTOM + 19.0), &label, "tick", "middle");
                before = x;
            }
        }
        let title = if of.has_scale { of.quantity.title() } else { side.name().to_owned() };
        let most = whole((width / 7.2).floor());
        drawing.text(
            self.at(f64::midpoint(half.from, half.to), BOTTOM + 39.0),
            &shortened(&visible_line(&title), most),
            "axis-title",
            "middle",
        );
    }

    fn draw_curve(&self, drawing: &mut Drawing, index: usize, colour: &str) {
        let curve = &self.panel.curves[index];
        for side in Side::BOTH {
            let branch = curve.branch(side);
            for (points, reach) in pieces(&branch.samples) {
                let points: Vec<(f64, f64)> =
                    points.iter().map(|sample| self.place(side, sample.x, sample.y)).collect();
                let dashes = if reach == Reach::Continued { r#" stroke-dasharray="5 4""# } else { "" };
                let look = format!(r#"fill="none" stroke="{colour}" stroke-width="2" stroke-linejoin="round"{dashes}"#);
                drawing.polyline(&points, &look);
            }
            for knot in &branch.knots {
                let quantity = &self.panel.half(side).quantity.column;
                let title = format!("{quantity} {}: {}", number(knot.x), number(knot.y));
                drawing.mark(self.place(side, knot.x, knot.y), index, colour, &title);
            }
        }
        let ends = Side::BOTH.map(|side| curve.branch(side).samples.first().filter(|sample| sample.x <= 0.0));
        if let [Some(open), Some(closed)] = ends
            && self.panel.fault.is_none()
        {
            let (from, to) = (self.place(Side::Open, open.x, open.y), self.place(Side::Closed, closed.x, closed.y));
            if 1.0 < (from.1 - to.1).abs() {
                let look = format!(r#"fill="none" stroke="{colour}" stroke-width="1.3" stroke-dasharray="1 3""#);
                drawing.polyline(&[from, to], &look);
            }
        }
    }

    fn draw_nodes(&self, drawing: &mut Drawing) {
        let Some(nodes) = &self.panel.nodes else { return };
        for side in Side::BOTH {
            let half = self.half(side);
            let width = (half.to - half.from).abs();
            let bars = whole(BARS as f64 * width / (RIGHT - LEFT)).max(1);
            let parts = nodes.sample.iter().filter(|node| node.side == side).map(|node| half.scale.part(node.x));
            for (bar, height) in histogram(parts, bars) {
                let x = half.from + (bar as f64 + 0.5) / bars as f64 * (half.to - half.from);
                let y = BOTTOM - height * BAR;
                drawing.bar(self.at(x - 0.4 * width / bars as f64, y), (0.8 * width / bars as f64, height * BAR));
            }
        }
        let bars = whole(BARS as f64 * (BOTTOM - TOP) / (RIGHT - LEFT));
        for (bar, height) in histogram(nodes.sample.iter().map(|node| self.y.part(node.y)), bars) {
            let step = (BOTTOM - TOP) / bars as f64;
            let y = BOTTOM - (bar as f64 + 0.9) * step;
            drawing.bar(self.at(RIGHT, y), (height * BAR, 0.8 * step));
        }
        for node in &nodes.sample {
            drawing.dot(self.place(node.side, node.x, node.y));
        }
    }

    fn draw_marks(&self, drawing: &mut Drawing) {
        let mut taken: Vec<(f64, f64)> = Vec::new();
        for mark in &self.panel.marks {
            let (x, y) = self.place(mark.side, mark.x, mark.y);
            let look = match mark.severity {
                Severity::Error => "error",
                Severity::Warning => "warning",
                Severity::Note => "remark",
            };
            let title = format!("{} {}: line {}: {}", mark.severity, mark.code, mark.line, mark.message);
            drawing.ring((x, y), look, &visible_line(&title));
            // Several findings at one row are stacked.
            let mut label = (x, y - 14.0);
            while taken.iter().any(|other| (other.0 - label.0).abs() < 36.0 && (other.1 - label.1).abs() < 13.0) {
                label.1 -= 13.0;
            }
            let anchor = if x + 20.0 < self.corner.0 + RIGHT { "middle" } else { "end" };
            drawing.text(label, mark.code, look, anchor);
            taken.push(label);
        }
    }

    fn draw_legend(&self, drawing: &mut Drawing) {
        let curves = &self.panel.curves;
        let Some(family) = self.panel.family.as_ref().filter(|_| curves.iter().any(|curve| curve.at.is_some())) else {
            return;
        };
        let right = RIGHT + 12.0 + if self.panel.nodes.is_some() { BAR } else { 0.0 };
        let mut y = TOP + 4.0;
        let most = if self.panel.nodes.is_some() { 12 } else { 15 };
        for line in wrapped(&visible_line(&family.title()), most) {
            drawing.text(self.at(right, y), &line, "tick", "start");
            y += 16.0;
        }
        y += 6.0;
        let label = |index: usize| curves[index].at.map_or_else(String::new, number);
        if curves.len() <= MAX_LEGEND {
            for index in (0..curves.len()).rev() {
                let colour = colours::of_curve(index, curves.len());
                let look = format!(r#"fill="none" stroke="{colour}" stroke-width="2""#);
                drawing.polyline(&[self.at(right, y), self.at(right + 22.0, y)], &look);
                drawing.mark(self.at(right + 11.0, y), index, &colour, "");
                drawing.text(self.at(right + 29.0, y + 4.5), &shortened(&label(index), 10), "tick", "start");
                y += 19.0;
            }
            return;
        }
        // A colour scale with one stripe per curve, the largest on top.
        let height = 180.0 / curves.len() as f64;
        for index in 0..curves.len() {
            let top = y + 180.0 - (index + 1) as f64 * height;
            drawing.stripe(self.at(right, top), (14.0, height + 0.3), &colours::of_curve(index, curves.len()));
        }
        for part in [0, 1, 2, 3, 4] {
            let index = part * (curves.len() - 1) / 4;
            let at = y + 180.0 - (index as f64 + 0.5) * height;
            drawing.text(self.at(right + 20.0, at + 4.5), &shortened(&label(index), 11), "tick", "start");
        }
    }

    /// Draws the remarks of the panel, in two lines below the axes.
    fn draw_footnotes(&self, drawing: &mut Drawing) {
        let notes = remarks(self.panel, self.y);
        let look = if self.panel.fault.is_some() { "error-note" } else { "note" };
        for (line, text) in wrapped(&visible_line(&notes.join("; ")), 92).into_iter().take(2).enumerate() {
            drawing.text(self.at(LEFT - 70.0, BOTTOM + 61.0 + 16.0 * line as f64), &text, look, "start");
        }
    }
}

/// The remarks of a panel: why it is not evaluated, where its nodes are, what is not drawn.
pub(super) fn remarks(panel: &Panel, y: Scale) -> Vec<String> {
    let fault = panel.fault.iter().map(|fault| format!("not evaluated, the rows as written: {fault}"));
    let nodes = panel.nodes.iter().map(|nodes| format!("node table: {}", nodes.summary()));
    let decades = panel.decades().filter(|decades| 3.0 < *decades && matches!(y, Scale::Linear { .. }));
    let decades = decades.map(|decades| format!("values over {decades:.0} decades: `--log` tells them apart"));
    fault.chain(nodes).chain(panel.notes.iter().cloned()).chain(decades).collect()
}

/// The position of contact: in the middle where both sides have a scale, otherwise near the side that has none.
fn contact(panel: &Panel) -> f64 {
    let part = match (panel.open.has_scale, panel.closed.has_scale) {
        (true, false) => 1.0 - STUB,
        (false, true) => STUB,
        _ => 0.5,
    };
    LEFT + part * (RIGHT - LEFT)
}

/// The smallest abscissa of a side that has a logarithm, with some room before it.
fn least_above_zero(panel: &Panel, side: Side) -> Option<f64> {
    let knots = panel.curves.iter().flat_map(|curve| &curve.branch(side).knots).map(|knot| knot.x);
    let nodes = panel.nodes.iter().flat_map(|nodes| &nodes.sample).filter(|node| node.side == side).map(|node| node.x);
    let above = knots.chain(nodes).filter(|x| 0.0 < *x).fold(f64::INFINITY, f64::min);
    let above = if above.is_finite() { above } else { panel.half(side).end * 1e-3 };
    let above = above / 2.0;
    (0.0 < above && panel.half(side).has_scale).then_some(above)
}

/// A curve split into pieces within the table and continuations; each begins at the end of the previous one.
///
/// A step up to a continued value is part of the continuation.
fn pieces(samples: &[Sample]) -> Vec<(&[Sample], Reach)> {
    let mut pieces = Vec::new();
    let mut start = 0;
    // The reach of the segment that ends in a sample.
    let of_segment = |end: usize| match (samples[end - 1].reach, samples[end].reach) {
        (Reach::Within, Reach::Within) => Reach::Within,
        _ => Reach::Continued,
    };
    for end in 1..samples.len() {
        let is_last = end + 1 == samples.len();
        if is_last || of_segment(end) != of_segment(end + 1) {
            pieces.push((&samples[start..=end], of_segment(end)));
            start = end;
        }
    }
    pieces
}

/// The bars of a histogram that are not empty, each with its height as a part of the highest.
fn histogram(parts: impl Iterator<Item = f64>, bars: usize) -> Vec<(usize, f64)> {
    let mut counts = vec![0_u32; bars];
    for part in parts.filter(|part| part.is_finite()) {
        let bar = whole((part.clamp(0.0, 1.0) * bars as f64).floor());
        counts[bar.min(bars - 1)] += 1;
    }
    let most = counts.iter().copied().max().unwrap_or(0).max(1);
    counts
        .iter()
        .enumerate()
        .filter(|(_, count)| 0 < **count)
        .map(|(bar, count)| (bar, f64::from(*count) / f64::from(most)))
        .collect()
}

/// A text truncated to a number of characters with `…`.
pub(crate) fn shortened(text: &str, most: usize) -> String {
    if text.chars().count() <= most {
        return text.to_owned();
    }
    let kept: String = text.chars().take(most.saturating_sub(1)).collect();
    format!("{}…", kept.trim_end())
}

/// A text wrapped to lines of a number of characters; longer words are truncated.
pub(crate) fn wrapped(text: &str, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        let word = shortened(word, most);
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= most => {
                line.push(' ');
                line.push_str(&word);
            }
            _ => lines.push(word),
        }
    }
    lines
}

/// Values of all panels that are compared.
pub(crate) fn values_of<'a>(panels: impl Iterator<Item = &'a Panel>) -> Vec<f64> {
    let values: BTreeSet<u64> = panels.flat_map(Panel::values).map(f64::to_bits).collect();
    values.into_iter().map(f64::from_bits).collect()
}
