//! A logarithmic axis: its range, its ticks and their labels.

use crate::curves::range;

/// A logarithmic axis over a stretch of the drawing.
#[derive(Debug, Clone, Copy)]
pub(super) struct Axis {
    /// The decimal logarithms of its ends.
    least: f64,
    greatest: f64,
    /// The positions of its ends, px.
    start: f64,
    end: f64,
}

/// A mark on an axis.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tick {
    pub(super) at: f64,
    /// Whether it is a power of ten.
    pub(super) is_decade: bool,
    pub(super) label: Option<String>,
}

/// The most decades of which each has a label.
const MAX_LABELS: i32 = 9;

/// The most decades between which 2 and 5 have labels as well.
const MAX_DECADES_WITH_DIGITS: f64 = 2.5;

impl Axis {
    /// An axis that holds these numbers above zero with some room at its ends.
    pub(super) fn around(numbers: impl Iterator<Item = f64>, start: f64, end: f64) -> Self {
        let logarithms = numbers.filter(|number| 0.0 < *number && number.is_finite()).map(f64::log10);
        let (mut least, mut greatest) = range(logarithms).unwrap_or((0.0, 0.0));
        // A decade at least, and a tenth of the range on both sides.
        let missing = (1.0 - (greatest - least)).max(0.0) / 2.0;
        (least, greatest) = (least - missing, greatest + missing);
        let room = 0.1 * (greatest - least);
        Self { least: least - room, greatest: greatest + room, start, end }
    }

    /// The position of a number above zero.
    pub(super) fn place(&self, number: f64) -> f64 {
        let part = (number.log10() - self.least) / (self.greatest - self.least);
        self.start + part * (self.end - self.start)
    }

    /// Powers of ten, and between them 2 to 9 where there is room; 2 and 5 have labels where decades are few.
    #[expect(clippy::cast_possible_truncation, reason = "logarithms of f64 are below 400")]
    pub(super) fn ticks(&self) -> Vec<Tick> {
        let (first, last) = (self.least.floor() as i32, self.greatest.ceil() as i32);
        let decades = last - first;
        let step = 1 + decades / (MAX_LABELS + 1);
        let are_few = self.greatest - self.least <= MAX_DECADES_WITH_DIGITS;
        let mut ticks = Vec::new();
        for decade in first..=last {
            let power = 10f64.powi(decade);
            let label = (decade.rem_euclid(step) == 0).then(|| written(power));
            ticks.push(Tick { at: power, is_decade: true, label });
            if decades <= MAX_LABELS {
                ticks.extend((2..10).map(|digit| {
                    let at = f64::from(digit) * power;
                    let label = (are_few && (digit == 2 || digit == 5)).then(|| written(at));
                    Tick { at, is_decade: false, label }
                }));
            }
        }
        ticks.retain(|tick| self.least <= tick.at.log10() && tick.at.log10() <= self.greatest);
        ticks
    }
}

/// `0.1`, `20`, `1e-16`.
fn written(number: f64) -> String {
    let exponent = number.log10();
    if (-3.01..4.99).contains(&exponent) {
        let digits = if exponent < -0.001 { (-exponent).ceil() } else { 0.0 };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 4")]
        return format!("{number:.*}", digits as usize);
    }
    format!("{number:.0e}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_holds_its_numbers_with_room() {
        let axis = Axis::around([3.0, 700.0].into_iter(), 100.0, 900.0);
        assert!(100.0 < axis.place(3.0) && axis.place(700.0) < 900.0);
        let downwards = Axis::around([1e-17, 1e-3].into_iter(), 500.0, 100.0);
        assert!(downwards.place(1e-3) < downwards.place(1e-17));
    }

    #[test]
    fn an_axis_of_one_number_or_none_has_a_range() {
        for numbers in [vec![], vec![5.0], vec![0.0, f64::INFINITY, f64::NAN]] {
            let axis = Axis::around(numbers.into_iter(), 0.0, 1.0);
            assert!(axis.place(5.0).is_finite() && axis.ticks().len() > 1);
        }
    }

    #[test]
    fn labels_are_few_and_short() {
        let labels = |least, greatest| -> Vec<String> {
            let axis = Axis::around([least, greatest].into_iter(), 0.0, 1.0);
            axis.ticks().into_iter().filter_map(|tick| tick.label).collect()
        };
        assert_eq!(labels(1.0, 100.0), ["1", "2", "5", "10", "20", "50", "100"]);
        assert_eq!(labels(0.2, 1.5), ["0.2", "0.5", "1", "2"]);
        assert!(labels(1e-17, 1e-2).len() < 11);
        assert!(labels(1e-300, 1e300).len() < 11);
    }
}
