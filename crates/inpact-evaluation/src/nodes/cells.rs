//! The numbers of a column, or of two that are combined, some of which may be missing.

use super::batch::{Batch, NumberColumn};
use crate::plan::Source;
use std::borrow::Cow;

/// Numbers, NaN where one is missing, with flags of those present.
#[derive(Debug, Clone)]
pub(crate) struct Cells<'a> {
    pub(crate) values: Cow<'a, [f64]>,
    /// `None` where it is known that none is missing.
    pub(crate) present: Option<Cow<'a, [bool]>>,
}

impl<'a> Cells<'a> {
    fn of(column: &'a NumberColumn) -> Self {
        Self { values: Cow::Borrowed(column.values()), present: column.presence().map(Cow::Borrowed) }
    }

    /// The numbers of column number `place` of a batch.
    pub(crate) fn at(batch: &'a Batch, place: usize) -> Self {
        Self::of(&batch.numbers[place])
    }

    /// The numbers of a source; `combine` combines slave and master.
    pub(crate) fn of_source(batch: &'a Batch, source: &Source<usize>, combine: impl Fn(f64, f64) -> f64) -> Self {
        let sides = |slave, master| Self::at(batch, slave).combined(&Self::at(batch, master), &combine);
        match *source {
            Source::Cell(cell) => Self::at(batch, cell),
            Source::Sides(slave, master) => sides(slave, master),
            Source::CellOrSides(cell, slave, master) => Self::at(batch, cell).or(&sides(slave, master)),
        }
    }

    fn combined(&self, other: &Self, combine: impl Fn(f64, f64) -> f64) -> Cells<'static> {
        let values = self.values.iter().zip(&*other.values).map(|(a, b)| combine(*a, *b)).collect();
        let present = match (&self.present, &other.present) {
            (None, None) => None,
            (Some(one), None) | (None, Some(one)) => Some(Cow::Owned(one.to_vec())),
            (Some(a), Some(b)) => Some(a.iter().zip(&**b).map(|(a, b)| *a && *b).collect()),
        };
        Cells { values: Cow::Owned(values), present }
    }

    /// These, or the other where one is missing.
    fn or(self, other: &Self) -> Self {
        let Some(present) = &self.present else { return self };
        let values = present.iter().zip(&*self.values).zip(&*other.values);
        let values = values.map(|((is_there, value), other)| if *is_there { *value } else { *other }).collect();
        let present = other
            .present
            .as_ref()
            .map(|of_other| present.iter().zip(&**of_other).map(|(is_there, other)| *is_there || *other).collect());
        Self { values: Cow::Owned(values), present }
    }

    /// Whether the number of a row is present.
    #[inline]
    pub(crate) fn has(&self, row: usize) -> bool {
        self.present.as_ref().is_none_or(|present| present[row])
    }

    /// Whether none is missing.
    pub(crate) fn is_full(&self) -> bool {
        self.present.as_ref().is_none_or(|present| present.iter().all(|present| *present))
    }
}
