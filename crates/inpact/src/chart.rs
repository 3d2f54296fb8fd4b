//! Pictures: points over two logarithmic axes, and panels of curves.
//!
//! A [`Chart`] is the content of a trade-off diagram; [`Chart::svg`] draws it. [`sheet`] draws [`crate::curves`], a [`panel`] a law, [`terminal`] as text.
//! `png::render` rasterises a drawing. Independent of decks and measurements. Text uses fonts of the viewer in SVG; for PNG the font is embedded in the program.

mod axis;
mod colours;
pub(crate) mod panel;
#[cfg(feature = "png")]
pub(crate) mod png;
pub(crate) mod scale;
pub(crate) mod sheet;
pub(crate) mod surface;
mod svg;
pub(crate) mod terminal;

use axis::Axis;

/// Points over two logarithmic axes, some of them joined by a front, with annotated reference lines.
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
    /// Small print below.
    pub(crate) footnote: String,
}

#[derive(Debug, Clone)]
pub(crate) struct Point {
    /// Above zero, as is y.
    pub(crate) x: f64,
    pub(crate) y: f64,
    /// The upper end of its bar, where there is one.
    pub(crate) bar_to: Option<f64>,
    pub(crate) label: String,
    /// Whether it is on the front.
    pub(crate) on_front: bool,
}

/// A count from a length: rounded, not below zero.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "rounded on purpose; `as` saturates")]
fn whole(length: f64) -> usize {
    length.round() as usize
}

/// The size of the drawing, in pixels.
const WIDTH: f64 = 960.0;
const HEIGHT: f64 = 600.0;
/// The rectangle that the axes span.
const LEFT: f64 = 96.0;
const RIGHT: f64 = 928.0;
const TOP: f64 = 92.0;
const BOTTOM: f64 = 496.0;

/// The size of the font of labels.
const SIZE: f64 = 13.0;

/// The meaning of the joined points.
const FRONT: &str = "Pareto front";

/// The approximate width of a letter, relative to the font size.
const LETTER: f64 = 0.58;

impl Chart {
    fn axes(&self) -> (Axis, Axis) {
        let xs = self.points.iter().map(|point| point.x).chain(self.vertical.iter().map(|(x, _)| *x));
        let ys = self.points.iter().flat_map(|point| [Some(point.y), point.bar_to]).flatten();
        let ys = ys.chain(self.horizontal.iter().map(|(y, _)| *y));
        (Axis::around(xs, LEFT, RIGHT), Axis::around(ys, BOTTOM, TOP))
    }

    /// The drawing as a standalone document.
    pub(crate) fn svg(&self) -> String {
        let (x_axis, y_axis) = self.axes();
        let mut drawing = svg::Drawing::new(WIDTH, HEIGHT, &self.title);
        self.draw_grid(&mut drawing, &x_axis, &y_axis);
        let mut taken = Vec::new();
        self.draw_verticals(&mut drawing, &x_axis, &mut taken);
        self.draw_front(&mut drawing, &x_axis, &y_axis, &mut taken);
        self.draw_bars(&mut drawing, &x_axis, &y_axis, &mut taken);
        self.draw_horizontals(&mut drawing, &y_axis, &mut taken);
        self.draw_points(&mut drawing, &x_axis, &y_axis, &mut taken);
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

    /// Lines of one x, each with its meaning written along its left side.
    fn draw_verticals(&self, drawing: &mut svg::Drawing, x_axis: &Axis, taken: &mut Vec<Area>) {
        for (at, meaning) in &self.vertical {
            let x = x_axis.place(*at);
            drawing.line((x, TOP), (x, BOTTOM), "roof");
            let length = width(meaning, SIZE);
            drawing.upright_text((x - 6.0, TOP + 12.0 + length / 2.0), meaning, "roof-label");
            taken.push(Area { left: x - 2.0, right: x + 2.0, top: TOP, bottom: BOTTOM });
            taken.push(Area { left: x - SIZE - 6.0, right: x, top: TOP, bottom: TOP + 16.0 + length });
        }
    }

    /// Lines of one y, each with its meaning where there is room along it.
    fn draw_horizontals(&self, drawing: &mut svg::Drawing, y_axis: &Axis, taken: &mut Vec<Area>) {
        for (at, meaning) in &self.horizontal {
            let y = y_axis.place(*at);
            drawing.line((LEFT, y), (RIGHT, y), "level");
            let places = (0..40).flat_map(|step| {
                let left = LEFT + 8.0 + 20.0 * f64::from(step);
                [(left, y - 6.0), (left, y + SIZE + 4.0)]
            });
            let place = places.into_iter().find(|(left, base)| is_free(&Area::of_text(*left, *base, meaning), taken));
            let (left, base) = place.unwrap_or((LEFT + 8.0, y - 6.0));
            drawing.text((left, base), meaning, "level-label", "start");
            taken.push(Area::of_text(left, base, meaning));
            taken.push(Area { left: LEFT, right: RIGHT, top: y - 1.0, bottom: y + 1.0 });
        }
    }

    /// The front as a step line: between two of its points the first is the best.
    fn draw_front(&self, drawing: &mut svg::Drawing, x_axis: &Axis, y_axis: &Axis, taken: &mut Vec<Area>) {
        let mut front: Vec<&Point> = self.points.iter().filter(|point| point.on_front).collect();
        front.sort_by(|a, b| a.x.total_cmp(&b.x));
        let mut corners = Vec::new();
        for (number, point) in front.iter().enumerate() {
            let (x, y) = (x_axis.place(point.x), y_axis.place(point.y));
            if let Some(before) = number.checked_sub(1).map(|before| front[before]) {
                corners.push((x, y_axis.place(before.y)));
            }
            corners.push((x, y));
        }
        drawing.path(&corners, "front");
        for step in corners.windows(2) {
            let ((x, y), (end_x, end_y)) = (step[0], step[1]);
            let (left, right) = (x.min(end_x) - 2.0, x.max(end_x) + 2.0);
            taken.push(Area { left, right, top: y.min(end_y) - 2.0, bottom: y.max(end_y) + 2.0 });
        }
    }

    fn draw_bars(&self, drawing: &mut svg::Drawing, x_axis: &Axis, y_axis: &Axis, taken: &mut Vec<Area>) {
        for point in &self.points {
            let (x, y) = (x_axis.place(point.x), y_axis.place(point.y));
            taken.push(Area { left: x - 7.0, right: x + 7.0, top: y - 7.0, bottom: y + 7.0 });
            if let Some(bar_to) = point.bar_to {
                let end = y_axis.place(bar_to);
                drawing.line((x, y), (x, end), "bar");
                drawing.line((x - 5.0, end), (x + 5.0, end), "bar");
                taken.push(Area { left: x - 5.0, right: x + 5.0, top: end, bottom: y });
            }
        }
    }

    fn draw_points(&self, drawing: &mut svg::Drawing, x_axis: &Axis, y_axis: &Axis, taken: &mut Vec<Area>) {
        for point in &self.points {
            let place = (x_axis.place(point.x), y_axis.place(point.y));
            drawing.circle(place, 5.5, if point.on_front { "best" } else { "other" });
            let (at, anchor) = label_place(place, &point.label, taken);
            drawing.text(at, &point.label, "label", anchor);
        }
        let marked = self.points.iter().any(|point| point.on_front);
        if marked {
            let x = RIGHT - width(FRONT, SIZE) - 28.0;
            drawing.circle((x, 54.0), 5.5, "best");
            drawing.text((x + 12.0, 58.5), FRONT, "note", "start");
        }
    }
}

/// An occupied area of the drawing.
#[derive(Debug, Clone, Copy)]
struct Area {
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

impl Area {
    /// The area of a text of usual size that starts at `left`, on this base line.
    fn of_text(left: f64, base: f64, text: &str) -> Self {
        Self { left, right: left + width(text, SIZE), top: base - SIZE, bottom: base + 3.0 }
    }

    fn meets(&self, other: &Self) -> bool {
        self.left < other.right && other.left < self.right && self.top < other.bottom && other.top < self.bottom
    }

    fn is_inside_the_axes(&self) -> bool {
        LEFT < self.left && self.right < RIGHT && TOP < self.top && self.bottom < BOTTOM
    }
}

/// Whether an area is empty and within the axes.
fn is_free(area: &Area, taken: &[Area]) -> bool {
    area.is_inside_the_axes() && !taken.iter().any(|other| area.meets(other))
}

/// The position of a label: beside its point, without overlap.
fn label_place((x, y): (f64, f64), label: &str, taken: &mut Vec<Area>) -> ((f64, f64), &'static str) {
    let width = width(label, SIZE);
    let candidates = [0.0, -16.0, 16.0, -24.0, 24.0, -32.0, 32.0, -40.0, 40.0, -48.0, 48.0, -64.0, 64.0, -80.0, 80.0]
        .into_iter()
        .flat_map(|shift| {
            let base = y + 4.5 + shift;
            [((x + 11.0, base), "start", x + 11.0), ((x - 11.0, base), "end", x - 11.0 - width)]
        });
    let candidates: Vec<_> = candidates.collect();
    let is_free =
        |candidate: &&((f64, f64), &str, f64)| is_free(&Area::of_text(candidate.2, candidate.0.1, label), taken);
    let fits = |candidate: &&((f64, f64), &str, f64)| Area::of_text(candidate.2, y, label).is_inside_the_axes();
    let chosen = candidates.iter().find(is_free).or_else(|| candidates.iter().find(fits)).unwrap_or(&candidates[0]);
    let (at, anchor, left) = *chosen;
    taken.push(Area::of_text(left, at.1, label));
    (at, anchor)
}

/// The approximate width of a text.
fn width(text: &str, size: f64) -> f64 {
    text.chars().count() as f64 * LETTER * size
}
