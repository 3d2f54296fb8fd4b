//! The axes of materials: *ORIENTATION of a section, with SYSTEM=RECTANGULAR and the coordinates of points of its axes.
//!
//! The first row has a point on the local x axis, a point in the local plane of x and y, and the origin (0 unless given; CalculiX reads none);
//! the second, where there is one, a local axis and the angle in degrees by which the system is rotated about it.

use super::layout::Entry;
use super::placement::Placement;
use super::reader::{Context, Reader};
use super::rows::number_rows;
use crate::grammar::Dialect;
use crate::model::Name;
use inpact_geometry::Point;
use std::io;

/// The axes of an orthotropic or anisotropic material in a section.
#[derive(Debug, Clone, PartialEq)]
pub enum MaterialAxes {
    /// The section says none.
    Unsaid,
    /// Unit vectors of the local axes, in the coordinates of the assembly.
    Along([Point; 3]),
    /// Those of an *ORIENTATION that is not read, and why.
    Unread(Name, String),
}

impl MaterialAxes {
    /// The same in a placed instance.
    pub(super) fn placed(self, placement: &Placement) -> Self {
        match self {
            Self::Along(axes) => Self::Along(axes.map(|axis| placement.turn(axis))),
            other => other,
        }
    }
}

impl Reader<'_, '_> {
    /// The axes of the *ORIENTATION of a section in an instance.
    pub(super) fn material_axes(&mut self, instance: usize, orientation: Option<Name>) -> io::Result<MaterialAxes> {
        let Some(name) = orientation else { return Ok(MaterialAxes::Unsaid) };
        let options = self.chain(Context::Instance(instance)).flat_map(|definitions| &definitions.orientations);
        // Of duplicate names the last one applies.
        let entry = options.filter(|entry| entry.named("NAME").as_ref() == Some(&name)).last().copied();
        let axes = match entry {
            None => Err("is not defined".to_owned()),
            Some(entry) => self.axes_of(entry)?,
        };
        Ok(axes.map_or_else(|why| MaterialAxes::Unread(name, why), MaterialAxes::Along))
    }

    fn axes_of(&mut self, entry: Entry<'_>) -> io::Result<Result<[Point; 3], String>> {
        for (parameter, only) in [("SYSTEM", "RECTANGULAR"), ("DEFINITION", "COORDINATES")] {
            if let Some(found) = entry.choice(parameter).filter(|found| found != only) {
                return Ok(Err(format!("has {parameter}={found}, which is not read")));
            }
        }
        if entry.parameter("LOCAL DIRECTIONS").is_some() {
            return Ok(Err("has LOCAL DIRECTIONS, which are not read".to_owned()));
        }
        let rows = number_rows(&mut *self.rows, entry.block)?;
        let rows: Vec<Option<Vec<f64>>> = rows.into_iter().map(|(row, _)| row).collect();
        let has_origin = self.dialect != Dialect::Calculix;
        Ok(axes(&rows, has_origin).ok_or_else(|| {
            let origin = if has_origin { ", and 3 of the origin" } else { "" };
            format!(
                "is not understood: expected 6 numbers{origin}, whose points do not lie on a line, then at most an axis 1 to 3 and an angle"
            )
        }))
    }
}

/// The axes given by rows; `None` where they give none.
fn axes(rows: &[Option<Vec<f64>>], has_origin: bool) -> Option<[Point; 3]> {
    let mut rows = rows.iter();
    let mut points = rows.next()?.clone()?;
    // A comma at the end is not a number.
    while 6 < points.len() && points.len() != 9 && points.last() == Some(&0.0) {
        points.pop();
    }
    let (first, second, origin) = match points[..] {
        [ax, ay, az, bx, by, bz] => ([ax, ay, az], [bx, by, bz], [0.0; 3]),
        [ax, ay, az, bx, by, bz, cx, cy, cz] if has_origin => ([ax, ay, az], [bx, by, bz], [cx, cy, cz]),
        _ => return None,
    };
    let from_origin = |point: Point| [0, 1, 2].map(|k| point[k] - origin[k]);
    let x = unit(from_origin(first))?;
    let z = unit(cross(x, from_origin(second)))?;
    let mut axes = [x, cross(z, x), z];
    if let Some(turn) = rows.next() {
        let turn = turn.as_deref()?;
        let axis = [1.0, 2.0, 3.0].iter().position(|axis| turn.first() == Some(axis))?;
        let (sine, cosine) = turn.get(1).copied().unwrap_or(0.0).to_radians().sin_cos();
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        let (of_next, of_last) = (axes[next], axes[last]);
        axes[next] = [0, 1, 2].map(|k| cosine * of_next[k] + sine * of_last[k]);
        axes[last] = [0, 1, 2].map(|k| cosine * of_last[k] - sine * of_next[k]);
    }
    rows.next().is_none().then_some(axes)
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The unit vector; `None` for the zero vector.
fn unit(vector: Point) -> Option<Point> {
    let length = vector.iter().map(|component| component * component).sum::<f64>().sqrt();
    (0.0 < length && length.is_finite()).then(|| vector.map(|component| component / length))
}

#[cfg(test)]
mod tests {
    use super::axes;

    fn close(found: Option<[[f64; 3]; 3]>, expected: [[f64; 3]; 3]) {
        let found = found.expect("axes");
        let pairs = found.iter().flatten().zip(expected.iter().flatten());
        pairs.for_each(|(found, expected)| assert!((found - expected).abs() < 1e-15, "{found} for {expected}"));
    }

    #[test]
    fn points_and_a_turn_about_an_axis() {
        let row = |numbers: &[f64]| Some(numbers.to_vec());
        let along_y = row(&[0.0, 2.0, 0.0, -3.0, 1.0, 0.0]);
        close(axes(std::slice::from_ref(&along_y), true), [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
        let turned = axes(&[along_y.clone(), row(&[3.0, 90.0])], true);
        close(turned, [[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]]);
        let from = row(&[1.0, 3.0, 0.0, -2.0, 2.0, 0.0, 1.0, 1.0, 0.0]);
        close(axes(std::slice::from_ref(&from), true), [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
        assert_eq!(axes(&[from], false), None);
        for wrong in [&[1.0, 0.0, 0.0, 2.0, 0.0, 0.0][..], &[0.0; 6], &[1.0, 0.0, 0.0]] {
            assert_eq!(axes(&[row(wrong)], true), None);
        }
        assert_eq!(axes(&[along_y.clone(), row(&[4.0, 90.0])], true), None);
        assert_eq!(axes(&[along_y, None], true), None);
        assert_eq!(axes(&[], true), None);
    }
}
