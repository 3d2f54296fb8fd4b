//! Interfaces in space, face by face in the colour of a result.

use super::colours;
use super::scale::Scale;
use super::svg::Drawing;
use crate::text::counted;
use inpact_diagnostics::visible::visible_line;

/// Faces of interfaces with a value each, seen along the direction of their smallest extent.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Surface {
    /// The output, such as `HFL`.
    pub(crate) output: String,
    /// The time of the state, where it has one.
    pub(crate) time: Option<f64>,
    /// The two axes that are drawn, to the right and upwards: 0 for x, 1 for y, 2 for z.
    pub(crate) directions: [usize; 2],
    /// The corners of each face (L), and the mean of the values at its nodes.
    pub(crate) faces: Vec<(Vec<[f64; 2]>, f64)>,
}

const AXES: [char; 3] = ['x', 'y', 'z'];

const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 460.0;
const LEFT: f64 = 24.0;
const RIGHT: f64 = WIDTH - 150.0;
const TOP: f64 = 24.0;
const BOTTOM: f64 = HEIGHT - 60.0;

/// The number of stripes of the colour scale.
const STRIPES: usize = 24;

impl Surface {
    /// The axes to draw: all except that of the smallest extent.
    pub(crate) fn directions(points: &[[f64; 3]]) -> [usize; 2] {
        let extent = |axis: usize| {
            let values = points.iter().map(|point| point[axis]);
            values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
        };
        let extents = [0, 1, 2].map(extent);
        let thinnest = [2, 1, 0].into_iter().min_by(|a, b| extents[*a].total_cmp(&extents[*b])).unwrap_or(2);
        match thinnest {
            0 => [1, 2],
            1 => [0, 2],
            _ => [0, 1],
        }
    }

    /// The drawing, described in words.
    pub(crate) fn description(&self) -> String {
        let time = self.time.map_or_else(String::new, |time| format!(" at time {}", crate::curves::number(time)));
        let [least, greatest] = self.range().map(crate::curves::number);
        let [across, up] = self.directions.map(|axis| AXES[axis]);
        let count = counted(self.faces.len(), "face");
        format!("{} on {count}{time}, from {least} to {greatest}; {across} to the right, {up} upwards", self.output)
    }

    fn range(&self) -> [f64; 2] {
        let values = self.faces.iter().map(|(_, value)| *value);
        [values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max)]
    }

    /// The drawing as an SVG document.
    pub(crate) fn svg(&self) -> String {
        let mut drawing = Drawing::new(WIDTH, HEIGHT, &visible_line(&self.description()));
        let corners = || self.faces.iter().flat_map(|(corners, _)| corners);
        let ends = |axis: usize| {
            let values = corners().map(|corner| corner[axis]);
            (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max))
        };
        let ((left, right), (bottom, top)) = (ends(0), ends(1));
        // The same scale in both directions.
        let scale = ((RIGHT - LEFT) / (right - left)).min((BOTTOM - TOP) / (top - bottom));
        let scale = if scale.is_finite() { scale } else { 1.0 };
        let place = |corner: &[f64; 2]| (LEFT + (corner[0] - left) * scale, BOTTOM - (corner[1] - bottom) * scale);
        let [least, greatest] = self.range();
        let part = |value: f64| {
            let spread = greatest / 2.0 - least / 2.0;
            if 0.0 < spread { (value / 2.0 - least / 2.0) / spread } else { 0.5 }
        };
        for (corners, value) in &self.faces {
            let places: Vec<(f64, f64)> = corners.iter().map(place).collect();
            drawing.face(&places, &colours::of_part(part(*value)));
        }
        self.draw_scale(&mut drawing, (least, greatest));
        let [across, up] = self.directions.map(|axis| AXES[axis]);
        drawing.text((LEFT, HEIGHT - 22.0), &format!("{across} to the right, {up} upwards"), "tick", "start");
        drawing.finish()
    }

    fn draw_scale(&self, drawing: &mut Drawing, (least, greatest): (f64, f64)) {
        let (left, top, height) = (RIGHT + 26.0, TOP + 30.0, 260.0);
        drawing.text((left, TOP + 12.0), &self.output, "axis-title", "start");
        let stripe = height / STRIPES as f64;
        for index in 0..STRIPES {
            let at = top + height - (index + 1) as f64 * stripe;
            drawing.stripe((left, at), (16.0, stripe + 0.4), &colours::of_part(index as f64 / (STRIPES - 1) as f64));
        }
        let scale = Scale::between(least, greatest, None);
        let ticks = if least < greatest { scale.ticks(6) } else { vec![(least, crate::curves::number(least))] };
        for (tick, label) in ticks {
            let part = if least < greatest { scale.part(tick) } else { 0.5 };
            drawing.text((left + 24.0, top + height - part * height + 4.5), &label, "tick", "start");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn surface(values: [f64; 2]) -> Surface {
        let face = |left: f64| vec![[left, 0.0], [left + 1.0, 0.0], [left + 1.0, 1.0], [left, 1.0]];
        let faces = values.into_iter().enumerate().map(|(index, value)| (face(index as f64), value)).collect();
        Surface { output: "HFL".to_owned(), time: Some(2.0), directions: [0, 2], faces }
    }

    #[test]
    fn faces_have_the_colours_of_their_values() {
        let svg = surface([0.0, 5.0]).svg();
        assert!(svg.contains(&format!("fill=\"{}\" stroke=\"#ffffff\"", colours::of_part(0.0))));
        assert!(svg.contains(&format!("fill=\"{}\" stroke=\"#ffffff\"", colours::of_part(1.0))));
        assert!(svg.contains("HFL on 2 faces at time 2, from 0 to 5; x to the right, z upwards"));
    }

    #[test]
    fn any_finite_values_have_a_drawing() {
        for values in [[7.0, 7.0], [f64::MIN, f64::MAX], [0.0, f64::from_bits(1)]] {
            let svg = surface(values).svg();
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{values:?}");
        }
    }

    #[test]
    fn a_surface_is_seen_along_its_thinnest_direction() {
        assert_eq!(Surface::directions(&[[0.0, 0.0, 1.0], [2.0, 3.0, 1.0]]), [0, 1]);
        assert_eq!(Surface::directions(&[[0.0, 5.0, 1.0], [2.0, 5.0, 4.0]]), [0, 2]);
    }
}
