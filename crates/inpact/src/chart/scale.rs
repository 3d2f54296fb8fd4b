//! Scales of curves: map the numbers of an axis to fractions of its length, for all finite numbers.

use crate::curves::{number, range};

/// Scales of an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Scale {
    /// Linear.
    Linear { least: f64, greatest: f64 },
    /// Logarithmic for each sign, with zero in an interval between them.
    Logarithmic {
        /// The smallest and the largest magnitude.
        least: f64,
        greatest: f64,
        signs: Signs,
    },
}

/// Signs of the numbers of a logarithmic axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Signs {
    Positive,
    PositiveAndZero,
    All,
}

/// Whether an axis is linear or logarithmic.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ScaleKind {
    Linear,
    Logarithmic,
}

/// The part of a logarithmic axis around zero.
const ZERO_PART: f64 = 0.08;

impl Scale {
    /// A scale for these numbers, including zero where it is linear.
    pub(crate) fn around(numbers: impl Iterator<Item = f64>, kind: ScaleKind) -> Self {
        let numbers: Vec<f64> = numbers.filter(|number| number.is_finite()).collect();
        match kind {
            ScaleKind::Linear => {
                let least = numbers.iter().copied().fold(0.0_f64, f64::min);
                let greatest = numbers.iter().copied().fold(0.0_f64, f64::max);
                if least == greatest {
                    return Self::Linear { least: 0.0, greatest: 1.0 };
                }
                // A twentieth of the range on the sides that have numbers.
                let room = greatest / 20.0 - least / 20.0;
                let end = |end: f64, room: f64| if end == 0.0 { 0.0 } else { (end + room).clamp(f64::MIN, f64::MAX) };
                Self::Linear { least: end(least, -room), greatest: end(greatest, room) }
            }
            ScaleKind::Logarithmic => Self::logarithmic(&numbers),
        }
    }

    fn logarithmic(numbers: &[f64]) -> Self {
        let magnitudes = numbers.iter().map(|number| number.abs()).filter(|magnitude| 0.0 < *magnitude);
        let Some((least, greatest)) = range(magnitudes) else { return Self::Linear { least: 0.0, greatest: 1.0 } };
        let signs = if numbers.iter().any(|number| *number < 0.0) {
            Signs::All
        } else if numbers.contains(&0.0) {
            Signs::PositiveAndZero
        } else {
            Signs::Positive
        };
        // Half a decade around a single magnitude, and a little around several.
        let room = if least == greatest { 3.0 } else { (greatest.log10() / 40.0 - least.log10() / 40.0).exp() };
        let least = (least / room).max(f64::from_bits(1));
        Self::Logarithmic { least, greatest: (greatest * room).min(f64::MAX), signs }
    }

    /// A linear scale between two numbers, or a logarithmic one down to `least_above_zero`.
    pub(crate) fn between(start: f64, end: f64, least_above_zero: Option<f64>) -> Self {
        match least_above_zero {
            Some(least) if least < end => {
                let signs = if start < 0.0 { Signs::All } else { Signs::PositiveAndZero };
                Self::Logarithmic { least, greatest: end, signs }
            }
            _ => Self::Linear { least: start, greatest: end },
        }
    }

    /// The position of a number, as a fraction of the axis: 0 at its start, 1 at its end.
    pub(crate) fn part(self, number: f64) -> f64 {
        match self {
            Self::Linear { least, greatest } => {
                let power = power_of(least.abs().max(greatest.abs()));
                let [least, greatest, number] = [least, greatest, number].map(|of| scaled(of, -power));
                (number - least) / (greatest - least)
            }
            Self::Logarithmic { least, greatest, signs } => {
                let (low, high) = (least.log10(), greatest.log10());
                let of_magnitude = |magnitude: f64| ((magnitude.log10() - low) / (high - low)).clamp(0.0, 1.0);
                let is_zero = number.abs() < least;
                match signs {
                    Signs::Positive => of_magnitude(number.abs().max(least)),
                    Signs::PositiveAndZero if is_zero || number < 0.0 => ZERO_PART * (number.abs() / least).min(1.0),
                    Signs::PositiveAndZero => ZERO_PART + (1.0 - ZERO_PART) * of_magnitude(number),
                    Signs::All => {
                        let half = 0.5 * (1.0 - ZERO_PART);
                        let from_middle = if is_zero {
                            0.5 * ZERO_PART * (number.abs() / least)
                        } else {
                            0.5 * ZERO_PART + half * of_magnitude(number.abs())
                        };
                        0.5 + if number < 0.0 { -from_middle } else { from_middle }
                    }
                }
            }
        }
    }

    /// Numbers to mark, about `most` of them, each with its label.
    pub(crate) fn ticks(self, most: usize) -> Vec<(f64, String)> {
        let ticks = match self {
            Self::Linear { least, greatest } => linear_ticks(least, greatest, most),
            Self::Logarithmic { least, greatest, signs } => logarithmic_ticks(least, greatest, signs, most),
        };
        let is_inside = |tick: &f64| (-1e-9..=1.0 + 1e-9).contains(&self.part(*tick));
        ticks.into_iter().filter(is_inside).map(|tick| (tick, number(tick))).collect()
    }
}

/// The exponent of two of a magnitude.
#[expect(clippy::cast_possible_truncation, reason = "logarithms of f64 are below 2000")]
fn power_of(magnitude: f64) -> i32 {
    if magnitude == 0.0 { 0 } else { (magnitude.log2().floor() as i32).clamp(-1074, 1023) }
}

/// `number` times a power of two, which itself may be out of range.
fn scaled(number: f64, power: i32) -> f64 {
    let first = power / 2;
    number * 2f64.powi(first) * 2f64.powi(power - first)
}

/// Multiples of 1, 2 or 5 times a power of ten; each is the number that its decimal digits mean.
#[expect(
    clippy::cast_possible_truncation,
    reason = "logarithms of f64 are below 400, and multiples below 1e300 are refused by their count"
)]
fn linear_ticks(least: f64, greatest: f64, most: usize) -> Vec<f64> {
    let span = greatest / 2.0 - least / 2.0;
    let rough = span / most.max(1) as f64 * 2.0;
    let rough = if rough == 0.0 || !rough.is_finite() { span.max(f64::MIN_POSITIVE) } else { rough };
    let mut exponent = rough.log10().floor() as i32;
    let digits = rough / parsed(1, exponent);
    let step = if digits <= 1.0 {
        1
    } else if digits <= 2.0 {
        2
    } else if digits <= 5.0 {
        5
    } else {
        exponent += 1;
        1
    };
    let unit = parsed(step, exponent);
    let (first, last) = ((least / unit).ceil(), (greatest / unit).floor());
    if !(first.is_finite() && last.is_finite() && last - first < 1000.0) {
        return vec![least, greatest];
    }
    (first as i64..=last as i64)
        .map(|multiple| parsed(multiple * step, exponent))
        .filter(|tick| tick.is_finite())
        .collect()
}

fn parsed(digits: i64, exponent: i32) -> f64 {
    format!("{digits}e{exponent}").parse().unwrap_or(f64::NAN)
}

/// Powers of ten, all or every n-th; zero and the negative ones where there are any.
#[expect(clippy::cast_possible_truncation, reason = "logarithms of f64 are below 400")]
fn logarithmic_ticks(least: f64, greatest: f64, signs: Signs, most: usize) -> Vec<f64> {
    let (first, last) = (least.log10().floor() as i32, greatest.log10().ceil() as i32);
    let most = if signs == Signs::All { most.div_ceil(2) } else { most }.clamp(2, 20);
    let most = i32::try_from(most).unwrap_or(20);
    let decades = last - first;
    let mut powers: Vec<f64> = Vec::new();
    if decades <= 2 {
        let digits: &[i64] = if decades <= 1 { &[1, 2, 3, 4, 6, 8] } else { &[1, 2, 5] };
        powers.extend((first..=last).flat_map(|power| digits.iter().map(move |digit| parsed(*digit, power))));
    } else {
        let rough = (decades + most - 1) / most;
        let step = [1, 2, 3, 5, 10, 20, 50, 100, 200].into_iter().find(|step| rough <= *step).unwrap_or(rough);
        powers.extend((first..=last).filter(|power| power.rem_euclid(step) == 0).map(|power| parsed(1, power)));
    }
    powers.retain(|power| least <= *power && *power <= greatest);
    match signs {
        Signs::Positive => powers,
        Signs::PositiveAndZero => std::iter::once(0.0).chain(powers).collect(),
        Signs::All => {
            let negative: Vec<f64> = powers.iter().rev().map(|power| -power).collect();
            negative.into_iter().chain([0.0]).chain(powers).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(scale: Scale, most: usize) -> Vec<String> {
        scale.ticks(most).into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn ticks_are_round() {
        let scale = |least, greatest| Scale::Linear { least, greatest };
        assert_eq!(labels(scale(0.0, 1.15e-5), 4), ["0", "5e-6", "1e-5"]);
        assert_eq!(labels(scale(0.0, 2.3e7), 5), ["0", "5e6", "1e7", "1.5e7", "2e7"]);
        assert_eq!(labels(scale(-3.0, 4.0), 4), ["-2", "0", "2", "4"]);
    }

    #[test]
    fn all_finite_numbers_have_a_place() {
        let extremes = [f64::MIN, -1.0, 0.0, f64::from_bits(1), 1e-300, 1.0, 1e300, f64::MAX];
        for kind in [ScaleKind::Linear, ScaleKind::Logarithmic] {
            for &a in &extremes {
                for &b in &extremes {
                    let scale = Scale::around([a, b].into_iter(), kind);
                    let (at_a, at_b) = (scale.part(a), scale.part(b));
                    assert!((-1e-9..=1.0 + 1e-9).contains(&at_a), "{kind:?} {a:e} {b:e}: {scale:?} {at_a}");
                    assert!(a == b || (a < b) == (at_a < at_b) || at_a == at_b, "{kind:?} {a:e} {b:e}");
                    let ticks = scale.ticks(5);
                    assert!(ticks.len() < 14, "{kind:?} {a:e} {b:e}: {ticks:?}");
                }
            }
        }
    }

    #[test]
    fn numbers_that_are_none_do_not_count() {
        let scale = Scale::around([f64::NAN, f64::INFINITY, 3.0].into_iter(), ScaleKind::Linear);
        assert!(0.9 < scale.part(3.0));
        assert!(!Scale::around(std::iter::empty(), ScaleKind::Logarithmic).ticks(4).is_empty());
    }

    #[test]
    fn six_hundred_decades_have_few_labels() {
        let scale = Scale::around([1e-300, 1e300, 0.0].into_iter(), ScaleKind::Logarithmic);
        let labels = labels(scale, 6);
        assert!(labels.len() <= 9 && labels.contains(&"0".to_owned()), "{labels:?}");
        assert!(scale.part(0.0) < scale.part(1e-300));
    }
}
