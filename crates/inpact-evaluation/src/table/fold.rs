//! Tables with fewer axes: a table folded along a variable that has the same value in every row of a scene.
//!
//! The table is a nested piecewise-linear function (semantics T-05, T-06), so with one variable fixed it is one of the others:
//! a group that is interpolated between two others has the abscissae of both, and at each of them the interpolated value.
//! The new values are computed in 106 bits and rounded once, so that a folded table keeps the accuracy of the original.
//!
//! Independent of scenes: the plan decides what to fold.

use super::evaluate::Place;
use super::marks::Marks;
use super::{Level, PiecewiseTable, Sides, Tail};
use crate::error::{Error, ErrorKind};
use std::ops::Range;

/// The maximum number of rows of a folded table; groups without common abscissae add up.
const MAX_ROWS: usize = 1 << 20;

impl PiecewiseTable {
    /// The table for a finite coordinate `at` along `axis`, as a table with the same axes that no longer depends on that one.
    ///
    /// At every point its value is that of the original table to within half an ulp more than the bound of the remaining axes,
    /// and exact where the original value is a row's value; a point counts as outside ([`Sides`]) exactly where it did.
    /// Slopes are those of the folded table, whose values are rounded.
    ///
    /// # Errors
    /// The remaining function cannot be written as a table.
    ///
    /// # Example
    /// ```
    /// use inpact_evaluation::table::{PiecewiseTable, Tail};
    ///
    /// let rows = [[10.0, 0.0, 300.0], [2.0, 2.0, 300.0], [20.0, 0.0, 400.0], [10.0, 4.0, 400.0]];
    /// let table = PiecewiseTable::from_rows(rows.as_flattened(), 3, Tail::Constant)?;
    /// let folded = table.folded(1, 350.0)?;
    /// assert_eq!(folded.row_count(), 3); // clearances 0, 2 and 4
    /// assert_eq!(folded.value(&[2.0, f64::NAN]), table.value(&[2.0, 350.0]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn folded(&self, axis: usize, at: f64) -> Result<Self, Error> {
        self.folded_within(axis, at, MAX_ROWS)
    }

    /// The same, with a limit of rows.
    fn folded_within(&self, axis: usize, at: f64, most: usize) -> Result<Self, Error> {
        let Some(target) = self.levels().iter().position(|level| level.axis == axis) else { return Ok(self.clone()) };
        let height = self.levels().len();
        let mut point = vec![0.0; self.axis_count()];
        point[axis] = at;
        let mut folding = Folding {
            table: self,
            target,
            point,
            sides: Sides::default(),
            ranges: vec![None; height],
            cells: Vec::new(),
            most,
        };
        let whole = 0..self.levels()[height - 1].knots.len();
        folding.fold(height, &[whole])?;
        let (sides, ranges) = (folding.sides, folding.ranges);
        let always = self.0.marks.as_ref().map_or(sides, |marks| sides.or(marks.always));
        let ranges = self.levels().iter().zip(ranges).filter(|(level, _)| level.axis != axis);
        let ranges = ranges.filter_map(|(level, range)| Some((level.axis, range?))).collect();
        // A table that no longer depends on axis 0 drops nowhere.
        let tail = if axis == 0 { Tail::Constant } else { self.tail() };
        let table = Self::from_rows(&folding.cells, self.axis_count() + 1, tail);
        Ok(table.map_err(|_| ErrorKind::TooManyRows { most })?.marked(Marks { always, ranges }))
    }
}

/// A table being folded.
struct Folding<'a> {
    table: &'a PiecewiseTable,
    /// The level of the axis that is folded away.
    target: usize,
    /// The coordinates of the next row, including that along the folded axis.
    point: Vec<f64>,
    /// On which sides of the folded axis the point lies.
    sides: Sides,
    /// For each level the bounds below and above which a point counts as outside.
    /// For the folded level only the sides of the point matter.
    ranges: Vec<Option<(f64, f64)>>,
    /// The rows of the folded table.
    cells: Vec<f64>,
    /// The limit of its rows.
    most: usize,
}

impl Folding<'_> {
    /// Adds the rows of the groups below `height` between which the folded table interpolates: one group, or after the folded axis several that are merged.
    fn fold(&mut self, height: usize, groups: &[Range<usize>]) -> Result<(), Error> {
        let Some(index) = height.checked_sub(1) else { return self.add_row() };
        let level = &self.table.levels()[index];
        if index == self.target {
            self.note_sides(level, groups)?;
            let inside = inside(level, index, groups, self.point[level.axis]);
            return self.fold(index, &inside);
        }
        let range = groups.iter().map(|group| self.range(level, group));
        let range = range.fold((f64::NEG_INFINITY, f64::INFINITY), |a, b| (a.0.max(b.0), a.1.min(b.1)));
        if self.ranges[index].replace(range).is_some_and(|before| before != range) {
            return Err(ErrorKind::RangesDiffer { axis: level.axis }.into());
        }
        let drop_of = |group: &Range<usize>| level.knots[group.end - 1];
        if level.drops && groups.iter().any(|group| drop_of(group) != drop_of(&groups[0])) {
            return Err(ErrorKind::DropsDiffer.into());
        }
        for x in common_knots(level, groups) {
            self.point[level.axis] = x;
            self.fold(index, &inside(level, index, groups, x))?;
        }
        Ok(())
    }

    /// The value at the point, rounded once from 106 bits, as a row.
    fn add_row(&mut self) -> Result<(), Error> {
        let axis = self.table.levels()[self.target].axis;
        self.cells.push(self.table.reference_value_at(self.point[0], &self.point[1..]));
        let row = self.point.iter().enumerate().map(|(of, x)| if of == axis { 0.0 } else { *x });
        self.cells.extend(row);
        if self.most * (self.point.len() + 1) < self.cells.len() {
            Err(ErrorKind::TooManyRows { most: self.most }.into())
        } else {
            Ok(())
        }
    }

    /// All groups of the folded axis must lie on the same side of the coordinate.
    fn note_sides(&mut self, level: &Level, groups: &[Range<usize>]) -> Result<(), Error> {
        for group in groups {
            let (least, greatest) = self.range(level, group);
            let mut sides = Sides::default();
            if self.point[level.axis] < least {
                sides.mark_below(level.axis);
            }
            if greatest < self.point[level.axis] {
                sides.mark_above(level.axis);
            }
            // A range of the folded level means that a group of it was processed before.
            let is_first = self.ranges[self.target].replace((least, greatest)).is_none();
            if !is_first && sides != self.sides {
                return Err(ErrorKind::RangesDiffer { axis: level.axis }.into());
            }
            self.sides = sides;
        }
        Ok(())
    }

    /// Below the first and above the second a point is outside a group.
    fn range(&self, level: &Level, group: &Range<usize>) -> (f64, f64) {
        match (&self.table.0.marks, &level.knots[group.clone()]) {
            (Some(marks), _) => marks.range(level.axis),
            (None, [first, .., last]) => (*first, *last),
            (None, [only]) if level.drops => (*only, *only),
            // Any other group of one row contains every point (T-07).
            _ => (f64::NEG_INFINITY, f64::INFINITY),
        }
    }
}

/// The groups below the level `index` that contribute to the values of some of its groups at `x`.
fn inside(level: &Level, index: usize, groups: &[Range<usize>], x: f64) -> Vec<Range<usize>> {
    let child = |knot: usize| if index == 0 { knot..knot + 1 } else { level.children_of(knot) };
    let of_group = |group: &Range<usize>| match level.place(group, x) {
        Place::Below => vec![child(group.start)],
        Place::Knot(knot) => vec![child(knot)],
        Place::Segment(left) => vec![child(left), child(left + 1)],
        Place::Above => vec![child(group.end - 1)],
    };
    groups.iter().flat_map(of_group).collect()
}

/// The union of the abscissae of some groups; a group of one row is constant and adds none (T-07).
fn common_knots(level: &Level, groups: &[Range<usize>]) -> Vec<f64> {
    let several: Vec<&Range<usize>> = groups.iter().filter(|group| group.len() > 1).collect();
    match several[..] {
        [] => vec![level.knots[groups[0].start]],
        [only] => level.knots[only.clone()].to_vec(),
        _ => {
            let mut knots: Vec<f64> =
                several.into_iter().flat_map(|group| &level.knots[group.clone()]).copied().collect();
            knots.sort_unstable_by(f64::total_cmp);
            // Abscissae are compared as numbers (T-10): −0 and 0 are one.
            knots.dedup();
            knots
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{PiecewiseTable, Tail};
    use crate::error::ErrorKind;

    #[test]
    fn a_folded_table_has_no_more_rows_than_it_may() {
        let rows = [[10.0, 0.0, 300.0], [2.0, 4.0, 300.0], [20.0, 1.0, 400.0], [10.0, 3.0, 400.0]];
        let table = PiecewiseTable::from_rows(rows.as_flattened(), 3, Tail::Constant).expect("a table");
        assert_eq!(table.folded_within(1, 350.0, 4).expect("as many as it may").row_count(), 4);
        let refusal = table.folded_within(1, 350.0, 3).expect_err("one too many");
        assert_eq!(*refusal.kind(), ErrorKind::TooManyRows { most: 3 });
        assert_eq!(refusal.to_string(), "the folded table would have more than 3 rows");
    }
}
