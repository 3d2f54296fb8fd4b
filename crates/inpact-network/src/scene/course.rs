//! Numbers that may follow time.

use inpact_evaluation::numbers::between;

/// A number as it goes with time: linear between points, constant before the first and after the last.
#[derive(Debug, Clone, PartialEq)]
pub struct Course(Vec<[f64; 2]>);

impl Course {
    /// The same number at all times.
    pub fn constant(value: f64) -> Self {
        Self(vec![[0.0, value]])
    }

    /// A number that goes through points of time and value, of which there is one at least and whose times ascend.
    pub fn through(points: Vec<[f64; 2]>) -> Self {
        Self(points)
    }

    /// The number at a time.
    pub fn at(&self, time: f64) -> f64 {
        let after = self.0.partition_point(|point| point[0] <= time);
        match (after.checked_sub(1).and_then(|before| self.0.get(before)), self.0.get(after)) {
            (Some(&[start, value]), Some(&[end, next])) => between(time, (start, value), (end, next)),
            (Some([_, value]), None) | (None, Some([_, value])) => *value,
            (None, None) => f64::NAN,
        }
    }

    /// The values it goes through.
    pub fn values(&self) -> impl Iterator<Item = f64> {
        self.0.iter().map(|point| point[1])
    }

    /// The times at which its slope changes.
    pub fn corners(&self) -> impl Iterator<Item = f64> {
        let corners = if self.0.len() > 1 { self.0.as_slice() } else { &[] };
        corners.iter().map(|point| point[0])
    }
}

#[cfg(test)]
mod tests {
    use super::Course;

    #[test]
    fn a_course_is_linear_between_its_points_and_constant_outside() {
        let course = Course::through(vec![[1.0, 10.0], [3.0, 20.0]]);
        assert_eq!([0.0, 1.0, 1.5, 3.0, 9.0].map(|time| course.at(time)), [10.0, 10.0, 12.5, 20.0, 20.0]);
        assert_eq!(Course::constant(7.0).at(-3.0), 7.0);
        assert_eq!(course.corners().collect::<Vec<_>>(), [1.0, 3.0]);
        assert_eq!(Course::constant(7.0).corners().count(), 0);
    }
}
