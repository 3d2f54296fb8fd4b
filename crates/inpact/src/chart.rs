//! Charts of points over two logarithmic axes, as data and as pictures.
//!
//! A [`Chart`] says what there is to see; [`Chart::svg`] draws it, and `png::render` makes pixels of that drawing.
//! Knows no decks and no measurements. Text is drawn with fonts of the viewer in SVG; for PNG the font comes with the program.

mod axis;
#[cfg(feature = "png")]
pub(crate) mod png;
mod svg;

use axis::Axis;

/// Points over two logarithmic axes, some of them joined by a front, with lines across at places of note.
#[derive(Debug, Clone, Default)]
pub(crate) struct Chart {
    pub(crate) title: String,
    pub(crate) subtitle: String,
    pub(crate) x_title: String,
    pub(crate) y_title: String,
    pub(crate) points: Vec<Point>,
    /// Lines of one x, each with what it means.
    pub(crate) vertical: Vec<(f64, String)>,
    /// Lines of one y, each with what it means.
    pub(crate) horizontal: Vec<(f64, String)>,
    /// What the joined points are.
    pub(crate) front_title: String,
    /// Small print below.
    pub(crate) footnote: String,
}

/// One point, with its label.
#[derive(Debug, Clone)]
pub(crate) struct Point {
    /// Above zero, as is y.
    pub(crate) x: f64,
    pub(crate) y: f64,
    /// How far up a bar goes from it, where there is one.
    pub(crate) bar_to: Option<f64>,
    pub(crate) label: String,
    /// Whether it is joined to the others of which that is true.
    pub(crate) on_front: bool,
}

/// The size of the drawing, in pixels.
const WIDTH: f64 = 960.0;
const HEIGHT: f64 = 600.0;
/// The rectangle that the axes span.
const LEFT: f64 = 96.0;
const RIGHT: f64 = 928.0;
const TOP: f64 = 92.0;
const BOTTOM: f64 = 496.0;

/// About how wide a letter is, as a part of the size of its font.
const LETTER: f64 = 0.58;

impl Chart {
    fn axes(&self) -> (Axis, Axis) {
        let xs = self.points.iter().map(|point| point.x).chain(self.vertical.iter().map(|(x, _)| *x));
        let ys = self.points.iter().flat_map(|point| [Some(point.y), point.bar_to]).flatten();
        let ys = ys.chain(self.horizontal.iter().map(|(y, _)| *y));
        (Axis::around(xs, LEFT, RIGHT), Axis::around(ys, BOTTOM, TOP))
    }

    /// The drawing as a document of its own.
    pub(crate) fn svg(&self) -> String {
        let (x_axis, y_axis) = self.axes();
        let mut drawing = svg::Drawing::new(WIDTH, HEIGHT, &self.title);
        self.draw_grid(&mut drawing, &x_axis, &y_axis);
        self.draw_lines(&mut drawing, &x_axis, &y_axis);
        self.draw_points(&mut drawing, &x_axis, &y_axis);
        drawing.finish()
    }

    fn draw_grid(&self, drawing: &mut svg::Drawing, x_axis: &Axis, y_axis: &Axis) {
        drawing.text((LEFT, 34.0), &self.title, "title", "start");
        drawing.text((LEFT, 58.0), &self.subtitle, "note", "start");
        for tick in x_axis.ticks() {
            let x = x_axis.place(tick.at);
            drawing.line((x, TOP), (x, BOTTOM), if tick.is_decade { "grid" } else { "fine" });
            if let Some(label) = tick.label {
                drawing.text((x, BOTTOM + 20.0), &label, "tick", "middle");
            }
        }
        for tick in y_axis.ticks() {
            let y = y_axis.place(tick.at);
            drawing.line((LEFT, y), (RIGHT, y), if tick.is_decade { "grid" } else { "fine" });
            if let Some(label) = tick.label {
                drawing.text((LEFT - 8.0, y + 4.5), &label, "tick", "end");
            }
        }
        drawing.line((LEFT, BOTTOM), (RIGHT, BOTTOM), "axis");
        drawing.line((LEFT, TOP), (LEFT, BOTTOM), "axis");
        drawing.text((f64::midpoint(LEFT, RIGHT), BOTTOM + 46.0), &self.x_title, "name", "middle");
        drawing.upright_text((28.0, f64::midpoint(TOP, BOTTOM)), &self.y_title, "name");
        drawing.text((LEFT, HEIGHT - 18.0), &self.footnote, "note", "start");
    }

    fn draw_lines(&self, drawing: &mut svg::Drawing, x_axis: &Axis, y_axis: &Axis) {
        for (number, (at, meaning)) in self.vertical.iter().enumerate() {
            let x = x_axis.place(*at);
            drawing.line((x, TOP), (x, BOTTOM), "roof");
            let y = TOP + 16.0 + 18.0 * number as f64;
            let is_left = x + 14.0 + width(meaning, 13.0) < RIGHT;
            let (x, anchor) = if is_left { (x + 7.0, "start") } else { (x - 7.0, "end") };
            drawing.text((x, y), meaning, "roof-label", anchor);
        }
        for (at, meaning) in &self.horizontal {
            let y = y_axis.place(*at);
            drawing.line((LEFT, y), (RIGHT, y), "level");
            drawing.text((RIGHT - 6.0, y - 6.0), meaning, "level-label", "end");
        }
        let mut front: Vec<&Point> = self.points.iter().filter(|point| point.on_front).collect();
        front.sort_by(|a, b| a.x.total_cmp(&b.x));
        // From one point of a front to the next nothing is better than the first, so that it goes in steps.
        let mut corners = Vec::new();
        for (number, point) in front.iter().enumerate() {
            let (x, y) = (x_axis.place(point.x), y_axis.place(point.y));
            if let Some(before) = number.checked_sub(1).map(|before| front[before]) {
                corners.push((x, y_axis.place(before.y)));
            }
            corners.push((x, y));
        }
        drawing.path(&corners, "front");
    }

    fn draw_points(&self, drawing: &mut svg::Drawing, x_axis: &Axis, y_axis: &Axis) {
        for point in &self.points {
            let (x, y) = (x_axis.place(point.x), y_axis.place(point.y));
            if let Some(bar_to) = point.bar_to {
                let end = y_axis.place(bar_to);
                drawing.line((x, y), (x, end), "bar");
                drawing.line((x - 5.0, end), (x + 5.0, end), "bar");
            }
        }
        let mut taken = Vec::new();
        for point in &self.points {
            let place = (x_axis.place(point.x), y_axis.place(point.y));
            drawing.circle(place, 5.5, if point.on_front { "best" } else { "other" });
            let (at, anchor) = label_place(place, &point.label, &mut taken);
            drawing.text(at, &point.label, "label", anchor);
        }
        let marked = self.points.iter().any(|point| point.on_front);
        if marked && !self.front_title.is_empty() {
            let x = RIGHT - width(&self.front_title, 13.0) - 28.0;
            drawing.circle((x, 54.0), 5.5, "best");
            drawing.text((x + 12.0, 58.5), &self.front_title, "note", "start");
        }
    }
}

/// Where a label goes: beside its point, on the side and at the height at which it meets no other label.
fn label_place((x, y): (f64, f64), label: &str, taken: &mut Vec<(f64, f64, f64)>) -> ((f64, f64), &'static str) {
    let width = width(label, 13.0);
    let right_fits = x + 12.0 + width < RIGHT;
    let candidates = [0.0, -16.0, 16.0, -32.0, 32.0, -48.0, 48.0].into_iter().flat_map(|shift| {
        let right = ((x + 11.0, y + 4.5 + shift), "start", x + 11.0);
        let left = ((x - 11.0, y + 4.5 + shift), "end", x - 11.0 - width);
        if right_fits { [right, left] } else { [left, right] }
    });
    let is_free = |start: f64, height: f64| {
        let meets = |(other, end, other_height): &(f64, f64, f64)| {
            start < *end && *other < start + width && (height - other_height).abs() < 15.0
        };
        LEFT < start && start + width < RIGHT && TOP + 8.0 < height && height < BOTTOM && !taken.iter().any(meets)
    };
    let candidates: Vec<_> = candidates.collect();
    let chosen = candidates.iter().find(|((_, height), _, start)| is_free(*start, *height)).unwrap_or(&candidates[0]);
    let (at, anchor, start) = *chosen;
    taken.push((start, start + width, at.1));
    (at, anchor)
}

/// About how wide a text is.
fn width(text: &str, size: f64) -> f64 {
    text.chars().count() as f64 * LETTER * size
}
