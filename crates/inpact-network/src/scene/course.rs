//! Numbers that may vary with time.

use inpact_evaluation::numbers::between;

/// A number as a function of time: linear between points, constant before the first and after the last.
#[derive(Debug, Clone, PartialEq)]
pub struct Course(Vec<[f64; 2]>);

impl Course {
    /// The same number at all times.
    pub fn constant(value: f64) -> Self {
        Self(vec![[0.0, value]])
    }

    /// A number through points of time and value, at least one, with ascending times.
    pub fn through(points: Vec<[f64; 2]>) -> Self {
        Self(points)
    }

    /// Its points of time and value; a single one, whose time is meaningless, where it is constant.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.0
    }

    /// A linear combination of numbers that vary with time; 0 without any.
    pub fn sum(parts: &[(f64, Self)]) -> Self {
        let mut times: Vec<f64> = parts.iter().flat_map(|(_, course)| course.corners()).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        let at = |time: f64| parts.iter().map(|(factor, course)| factor * course.at(time)).sum();
        if times.is_empty() {
            Self::constant(at(0.0))
        } else {
            Self(times.into_iter().map(|time| [time, at(time)]).collect())
        }
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

    /// Its values at its points.
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
        let sum = Course::sum(&[
            (2.0, course),
            (1.0, Course::constant(1.0)),
            (1.0, Course::through(vec![[2.0, 0.0], [4.0, 8.0]])),
        ]);
        assert_eq!(sum.points(), [[1.0, 21.0], [2.0, 31.0], [3.0, 45.0], [4.0, 49.0]]);
        assert_eq!(Course::sum(&[]), Course::constant(0.0));
    }
}
