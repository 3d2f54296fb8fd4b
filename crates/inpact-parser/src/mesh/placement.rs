//! The position of an instance in the assembly.

use inpact_geometry::Point;

/// The placement of an instance.
#[derive(Debug, Clone, Copy)]
pub(super) struct Placement {
    pub(super) translation: Point,
    /// Two points of the axis, and the angle in degrees.
    pub(super) rotation: Option<(Point, Point, f64)>,
}

impl Placement {
    pub(super) const NONE: Self = Self { translation: [0.0; 3], rotation: None };

    pub(super) fn is_turned(&self) -> bool {
        self.rotation.is_some()
    }

    /// A direction in the instance, rotated.
    pub(super) fn turn(&self, direction: Point) -> Point {
        let about_origin = |(a, b, angle): (Point, Point, f64)| ([0.0; 3], [0, 1, 2].map(|k| b[k] - a[k]), angle);
        Self { translation: [0.0; 3], rotation: self.rotation.map(about_origin) }.put(direction)
    }

    /// Translated, then rotated about the axis from a to b (Rodrigues), right-handed.
    pub(super) fn put(&self, point: Point) -> Point {
        let p = [0, 1, 2].map(|k| point[k] + self.translation[k]);
        let Some((a, b, angle)) = self.rotation else { return p };
        let axis = [0, 1, 2].map(|k| b[k] - a[k]);
        let length = (axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]).sqrt();
        let [x, y, z] = axis.map(|component| component / length);
        let r = [0, 1, 2].map(|k| p[k] - a[k]);
        let (sin, cos) = angle.to_radians().sin_cos();
        let cross = [y * r[2] - z * r[1], z * r[0] - x * r[2], x * r[1] - y * r[0]];
        let along = (x * r[0] + y * r[1] + z * r[2]) * (1.0 - cos);
        let axis = [x, y, z];
        [0, 1, 2].map(|k| a[k] + r[k] * cos + cross[k] * sin + axis[k] * along)
    }
}
