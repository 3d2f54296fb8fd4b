//! Lines, circles and text as an SVG document.
//!
//! Colours are attributes of each shape, so that every viewer and renderer draws them alike on a light background.

use std::fmt::Write;

/// A drawing that grows shape by shape.
#[derive(Debug)]
pub(super) struct Drawing {
    text: String,
}

/// Attributes of SVG by kind of shape.
const LOOKS: &[(&str, &str)] = &[
    ("grid", r##"stroke="#cfd6dd" stroke-width="1""##),
    ("fine", r##"stroke="#edf0f3" stroke-width="1""##),
    ("axis", r##"stroke="#3a434c" stroke-width="1.5""##),
    ("roof", r##"stroke="#b3541e" stroke-width="2" stroke-dasharray="7 5""##),
    ("level", r##"stroke="#7b8794" stroke-width="1.2" stroke-dasharray="2 4""##),
    ("bar", r##"stroke="#8fa3b5" stroke-width="1.5""##),
    ("front", r##"fill="none" stroke="#0b6e99" stroke-width="2.2" stroke-opacity="0.75""##),
    ("best", r##"fill="#0b6e99" stroke="#ffffff" stroke-width="1.5""##),
    ("other", r##"fill="#ffffff" stroke="#5b6b7a" stroke-width="2""##),
    ("title", r##"fill="#16202a" font-size="21" font-weight="bold""##),
    ("name", r##"fill="#16202a" font-size="15""##),
    ("tick", r##"fill="#3a434c" font-size="13""##),
    ("note", r##"fill="#4d5965" font-size="13""##),
    ("label", r##"fill="#16202a" font-size="13""##),
    ("roof-label", r##"fill="#8f3f12" font-size="13""##),
    ("level-label", r##"fill="#5b6b7a" font-size="12""##),
];

/// Attributes of SVG by kind of shape in panels of curves.
const PANEL_LOOKS: &[(&str, &str)] = &[
    ("panel-title", r##"fill="#16202a" font-size="15" font-weight="bold""##),
    ("axis-title", r##"fill="#16202a" font-size="13""##),
    ("contact", r##"stroke="#3a434c" stroke-width="1.2""##),
    ("tick-line", r##"stroke="#3a434c" stroke-width="1""##),
    ("error", r##"fill="#a3161f" font-size="12" font-weight="bold""##),
    ("warning", r##"fill="#8f4a00" font-size="12" font-weight="bold""##),
    ("remark", r##"fill="#33475b" font-size="12" font-weight="bold""##),
    ("error-note", r##"fill="#a3161f" font-size="12""##),
    ("sheet-title", r##"fill="#16202a" font-size="17" font-weight="bold""##),
];

impl Drawing {
    /// A light background of that size, in pixels; `title` is the text for screen readers.
    pub(super) fn new(width: f64, height: f64, title: &str) -> Self {
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"DejaVu Sans, Verdana, sans-serif\" role=\"img\">\n\
             <title>{}</title>\n<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n",
            escaped(title)
        );
        Self { text }
    }

    pub(super) fn line(&mut self, from: (f64, f64), to: (f64, f64), look: &str) {
        let [x1, y1, x2, y2] = [from.0, from.1, to.0, to.1].map(short);
        self.add(&format!(r#"<line x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}" {}/>"#, looks(look)));
    }

    pub(super) fn circle(&mut self, (x, y): (f64, f64), radius: f64, look: &str) {
        self.add(&format!(r#"<circle cx="{}" cy="{}" r="{radius}" {}/>"#, short(x), short(y), looks(look)));
    }

    /// A polyline; nothing for fewer than two points.
    pub(super) fn path(&mut self, corners: &[(f64, f64)], look: &str) {
        self.polyline(corners, looks(look));
    }

    /// A text whose start, middle or end (`anchor`) is at a place.
    pub(super) fn text(&mut self, (x, y): (f64, f64), text: &str, look: &str, anchor: &str) {
        if text.is_empty() {
            return;
        }
        let (x, y, text) = (short(x), short(y), escaped(text));
        self.add(&format!(r#"<text x="{x}" y="{y}" text-anchor="{anchor}" {}>{text}</text>"#, looks(look)));
    }

    /// A text that runs upwards, its middle at a place.
    pub(super) fn upright_text(&mut self, (x, y): (f64, f64), text: &str, look: &str) {
        let (x, y, text) = (short(x), short(y), escaped(text));
        let turn = format!("translate({x} {y}) rotate(-90)");
        self.add(&format!(r#"<text transform="{turn}" text-anchor="middle" {}>{text}</text>"#, looks(look)));
    }

    /// A polyline with its own style.
    pub(super) fn polyline(&mut self, corners: &[(f64, f64)], look: &str) {
        if 1 < corners.len() {
            self.add(&format!(r#"<polyline points="{}" {look}/>"#, points(corners)));
        }
    }

    /// A mark of curve `index`: circle, square, triangle, diamond in turn, so that curves are distinguished without colours; `title` is shown on hover.
    pub(super) fn mark(&mut self, (x, y): (f64, f64), index: usize, colour: &str, title: &str) {
        let look = format!(r##"fill="{colour}" stroke="#ffffff" stroke-width="0.8""##);
        let polygon = |corners: &[(f64, f64)]| {
            let corners: Vec<(f64, f64)> = corners.iter().map(|(dx, dy)| (x + dx, y + dy)).collect();
            format!(r#"<polygon points="{}" {look}"#, points(&corners))
        };
        let shape = match index % 4 {
            0 => format!(r#"<circle cx="{}" cy="{}" r="4" {look}"#, short(x), short(y)),
            1 => polygon(&[(-3.6, -3.6), (3.6, -3.6), (3.6, 3.6), (-3.6, 3.6)]),
            2 => polygon(&[(0.0, -4.8), (4.4, 3.4), (-4.4, 3.4)]),
            _ => polygon(&[(0.0, -5.2), (4.6, 0.0), (0.0, 5.2), (-4.6, 0.0)]),
        };
        if title.is_empty() {
            self.add(&format!("{shape}/>"));
        } else {
            let tag = if shape.starts_with("<circle") { "circle" } else { "polygon" };
            self.add(&format!("{shape}><title>{}</title></{tag}>", escaped(title)));
        }
    }

    /// A ring around a finding; `title` is shown on hover.
    pub(super) fn ring(&mut self, (x, y): (f64, f64), look: &str, title: &str) {
        let colour = looks(look).split('"').nth(1).unwrap_or("#000000");
        let at = format!(r#"cx="{}" cy="{}""#, short(x), short(y));
        let look = format!(r#"fill="none" stroke="{colour}" stroke-width="2""#);
        self.add(&format!(r#"<circle {at} r="9" {look}><title>{}</title></circle>"#, escaped(title)));
    }

    /// A small point among many.
    pub(super) fn dot(&mut self, (x, y): (f64, f64)) {
        let look = r##"fill="#16202a" fill-opacity="0.35""##;
        self.add(&format!(r#"<circle cx="{}" cy="{}" r="2" {look}/>"#, short(x), short(y)));
    }

    /// A face of a surface; of fewer than three corners a line or a point.
    pub(super) fn face(&mut self, corners: &[(f64, f64)], colour: &str) {
        match corners {
            [] => {}
            [(x, y)] => self.add(&format!(r#"<circle cx="{}" cy="{}" r="4" fill="{colour}"/>"#, short(*x), short(*y))),
            [_, _] => self.polyline(corners, &format!(r#"fill="none" stroke="{colour}" stroke-width="5""#)),
            _ => {
                let look = format!(r##"fill="{colour}" stroke="#ffffff" stroke-width="0.5""##);
                self.add(&format!(r#"<polygon points="{}" {look}/>"#, points(corners)));
            }
        }
    }

    pub(super) fn bar(&mut self, at: (f64, f64), size: (f64, f64)) {
        self.rectangle(at, size, r##"fill="#7b8794" fill-opacity="0.45""##);
    }

    /// A stripe of a scale of colours.
    pub(super) fn stripe(&mut self, at: (f64, f64), size: (f64, f64), colour: &str) {
        self.rectangle(at, size, &format!(r#"fill="{colour}""#));
    }

    fn rectangle(&mut self, (x, y): (f64, f64), (width, height): (f64, f64), look: &str) {
        let [x, y, width, height] = [x, y, width, height].map(short);
        self.add(&format!(r#"<rect x="{x}" y="{y}" width="{width}" height="{height}" {look}/>"#));
    }

    pub(super) fn finish(mut self) -> String {
        self.text += "</svg>\n";
        self.text
    }

    fn add(&mut self, shape: &str) {
        // Writing into a string cannot fail.
        let _ = writeln!(self.text, "{shape}");
    }
}

fn looks(name: &str) -> &'static str {
    LOOKS.iter().chain(PANEL_LOOKS).find(|(known, _)| *known == name).map_or("", |(_, attributes)| attributes)
}

fn points(corners: &[(f64, f64)]) -> String {
    corners.iter().map(|(x, y)| format!("{},{}", short(*x), short(*y))).collect::<Vec<_>>().join(" ")
}

/// A coordinate to a tenth of a pixel.
fn short(coordinate: f64) -> String {
    format!("{:.1}", coordinate + 0.0).trim_end_matches(".0").to_owned()
}

/// An escaped text, without characters that are invalid in XML.
fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for character in text.chars() {
        match character {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '"' => escaped += "&quot;",
            '\u{fffe}' | '\u{ffff}' => {}
            character if character.is_control() => escaped.push(' '),
            character => escaped.push(character),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_of_xml_are_escaped() {
        assert_eq!(escaped("a<b & \"c\" > \u{7}d"), "a&lt;b &amp; &quot;c&quot; &gt;  d");
    }

    #[test]
    fn every_look_is_known() {
        let chart = crate::chart::Chart {
            title: "t".to_owned(),
            subtitle: "s".to_owned(),
            x_title: "x".to_owned(),
            y_title: "y".to_owned(),
            points: [(1.0, 2.0, true), (3.0, 1.0, true), (4.0, 4.0, false)]
                .map(|(x, y, on_front)| crate::chart::Point {
                    x,
                    y,
                    bar_to: Some(9.0),
                    label: "l".to_owned(),
                    on_front,
                })
                .into(),
            vertical: vec![(2.0, "v".to_owned())],
            horizontal: vec![(2.0, "h".to_owned())],
            footnote: "n".to_owned(),
        };
        let svg = chart.svg();
        for (name, attributes) in LOOKS {
            assert!(svg.contains(attributes), "{name}");
        }
        assert!(!svg.contains(" />"), "a shape without a look");
    }
}
