//! The slope form, in f64 or f32: y = yᵢ + (x − xᵢ)·sᵢ with one fused operation, and plain linear interpolation across the outer axes.
//!
//! The slopes are computed beforehand, and so are the inverse widths of the outer axes' segments: no division at a query.
//! Coordinates are brought into the range of their group first, which gives the constant ends of T-04.
//! Whether a coordinate lies beyond the last row of a table with [`Tail::Zero`] is decided in f64 before it is rounded, so that the jump is where the table has it.

use super::Refusal;
use super::number::Number;
use super::search::{Group, Key, index};
use crate::numbers::slope;
use crate::table::{PiecewiseTable, Tail};

/// A table in slope form.
#[derive(Clone, Debug)]
pub(super) struct Flat<T> {
    /// The levels of the table, innermost first.
    pub(super) levels: Vec<FlatLevel<T>>,
    /// For each group of the innermost level what it is zero beyond; infinite where it has no such end.
    pub(super) zero_beyond: Vec<f64>,
}

/// One axis the value depends on.
#[derive(Clone, Debug)]
pub(super) struct FlatLevel<T> {
    pub(super) axis: usize,
    pub(super) knots: Vec<Knot<T>>,
    /// Group j belongs to knot j of the level outside.
    pub(super) groups: Vec<Group<T>>,
    key: Key,
    buckets: Vec<u32>,
}

/// One knot and what is needed on the segment to its right.
#[derive(Clone, Copy, Debug)]
pub(super) struct Knot<T> {
    pub(super) at: T,
    /// The slope of the segment, or on outer axes its inverse width; zero at the last knot of a group.
    pub(super) rate: T,
    /// The row's value; unused on outer axes.
    pub(super) value: T,
}

/// The most axes a fast form is made for. Each doubles the number of segments that take part in a value.
pub(super) const MOST_AXES: usize = 4;

impl<T: Number> Flat<T> {
    /// The slope form of a table of one to four axes that matter.
    pub(super) fn new(table: &PiecewiseTable) -> Result<Self, Refusal> {
        match table.levels.len() {
            0 => return Err(Refusal::Constant),
            1..=MOST_AXES => {}
            count => return Err(Refusal::TooManyAxes(count)),
        }
        let values = table.values.iter().map(|&value| rounded::<T>(value)).collect::<Result<Vec<_>, _>>()?;
        let mut levels: Vec<FlatLevel<T>> = Vec::new();
        for (level_index, level) in table.levels.iter().enumerate() {
            let at = level.knots.iter().map(|&knot| rounded::<T>(knot)).collect::<Result<Vec<_>, _>>()?;
            let whole = [0, level.knots.len()];
            let starts = table.levels.get(level_index + 1).map_or(&whole[..], |outer| &outer.children);
            let ranges: Vec<(usize, usize)> = starts.windows(2).map(|range| (range[0], range[1] - 1)).collect();
            let mut knots = Vec::new();
            for &(first, last) in &ranges {
                for knot in first..=last {
                    let value = if level_index == 0 { values[knot] } else { T::ZERO };
                    let rate = if knot == last { T::ZERO } else { rate_of(level_index, &at, &values, knot)? };
                    knots.push(Knot { at: at[knot], rate, value });
                }
            }
            let (key, groups, buckets) = index(&at, &ranges);
            levels.push(FlatLevel { axis: level.axis, knots, groups, key, buckets });
        }
        let zero_beyond = zero_beyond(table, &levels[0].groups);
        Ok(Self { levels, zero_beyond })
    }

    /// The memory the form takes, in bytes.
    pub(super) fn bytes(&self) -> usize {
        let of_level = |level: &FlatLevel<T>| {
            size_of_val(&level.knots[..]) + size_of_val(&level.groups[..]) + size_of_val(&level.buckets[..])
        };
        self.levels.iter().map(of_level).sum::<usize>() + size_of_val(&self.zero_beyond[..])
    }

    /// The value of a table of one level at a coordinate.
    #[inline(always)]
    fn at_1(&self, group: usize, [x, ..]: [f64; MOST_AXES]) -> T {
        let level = &self.levels[0];
        let (x_rounded, knot) = level.place(group, x);
        let knot = level.knots[knot];
        let value = (x_rounded - knot.at).fused(knot.rate, knot.value);
        if x > self.zero_beyond[group] { T::ZERO } else { value }
    }

    #[inline(always)]
    fn at_2(&self, group: usize, x: [f64; MOST_AXES]) -> T {
        let (left, right, part) = self.levels[1].segment(group, x[1]);
        let (a, b) = (self.at_1(left, x), self.at_1(right, x));
        part.fused(b - a, a)
    }

    #[inline(always)]
    fn at_3(&self, group: usize, x: [f64; MOST_AXES]) -> T {
        let (left, right, part) = self.levels[2].segment(group, x[2]);
        let (a, b) = (self.at_2(left, x), self.at_2(right, x));
        part.fused(b - a, a)
    }

    #[inline(always)]
    fn at_4(&self, group: usize, x: [f64; MOST_AXES]) -> T {
        let (left, right, part) = self.levels[3].segment(group, x[3]);
        let (a, b) = (self.at_3(left, x), self.at_3(right, x));
        part.fused(b - a, a)
    }

    /// The values at the points of `columns`, one column an axis of the table; `convert` says what to do with each.
    #[inline(always)]
    pub(super) fn each<Q: Copy + Into<f64>, V>(&self, columns: &[&[Q]], values: &mut [V], convert: impl Fn(T) -> V) {
        let rows = values.len();
        let column = |level: usize| &columns[self.levels[level].axis][..rows];
        let x = column(0);
        match self.levels.len() {
            1 => {
                for (value, &x) in values.iter_mut().zip(x) {
                    *value = convert(self.at_1(0, [x.into(), 0.0, 0.0, 0.0]));
                }
            }
            2 => {
                for (value, (&x, &y)) in values.iter_mut().zip(x.iter().zip(column(1))) {
                    *value = convert(self.at_2(0, [x.into(), y.into(), 0.0, 0.0]));
                }
            }
            3 => {
                let (y, z) = (column(1), column(2));
                for (row, value) in values.iter_mut().enumerate() {
                    *value = convert(self.at_3(0, [x[row].into(), y[row].into(), z[row].into(), 0.0]));
                }
            }
            _ => {
                let (y, z, w) = (column(1), column(2), column(3));
                for (row, value) in values.iter_mut().enumerate() {
                    *value = convert(self.at_4(0, [x[row].into(), y[row].into(), z[row].into(), w[row].into()]));
                }
            }
        }
    }
}

impl<T: Number> FlatLevel<T> {
    /// `x` rounded and brought into the range of the group, and the last knot not above it.
    #[inline(always)]
    fn place(&self, group: usize, x: f64) -> (T, usize) {
        let group = &self.groups[group];
        let x = T::nearest(x).bounded(group.least, group.greatest);
        (x, group.find(self.key, |knot| self.knots[knot].at, &self.buckets, x))
    }

    /// The two knots around `x`, and how far it is from the first to the second; twice the last knot at its end.
    #[inline(always)]
    fn segment(&self, group: usize, x: f64) -> (usize, usize, T) {
        let (x, left) = self.place(group, x);
        let knot = self.knots[left];
        (left, (left + 1).min(self.groups[group].last), (x - knot.at) * knot.rate)
    }
}

/// `value` in `T`, if it can be used there.
fn rounded<T: Number>(value: f64) -> Result<T, Refusal> {
    let rounded = T::nearest(value);
    if value.abs() > T::SAFE_TO_ADD {
        return Err(Refusal::TooLarge(value));
    }
    if value != 0.0 && rounded.exact().abs() < T::LEAST_NORMAL {
        return Err(Refusal::TooSmall(value));
    }
    Ok(rounded)
}

/// The slope from knot `left` to the next on the innermost level, the inverse of their distance on the others.
fn rate_of<T: Number>(level: usize, at: &[T], values: &[T], left: usize) -> Result<T, Refusal> {
    let (x0, x1) = (at[left].exact(), at[left + 1].exact());
    if x1 <= x0 {
        return Err(Refusal::Merged(x0));
    }
    let rate =
        if level == 0 { slope((x0, values[left].exact()), (x1, values[left + 1].exact())) } else { 1.0 / (x1 - x0) };
    rounded(rate).map_err(|_| Refusal::Slope(rate))
}

/// For each group of the innermost level what it is zero beyond. A group of one row has no end (T-07).
fn zero_beyond<T>(table: &PiecewiseTable, groups: &[Group<T>]) -> Vec<f64> {
    let level = &table.levels[0];
    let drops = level.axis == 0 && table.tail == Tail::Zero;
    groups
        .iter()
        .map(|group| if drops && group.first < group.last { level.knots[group.last] } else { f64::INFINITY })
        .collect()
}
