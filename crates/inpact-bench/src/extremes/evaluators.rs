//! The ways to evaluate a table, each a line of a list: the modes and their kernels.

use inpact_evaluation::table::PiecewiseTable;

/// The value of a table at a point.
pub(super) type Value<'a> = Box<dyn Fn(&[f64]) -> f64 + 'a>;

/// A way to evaluate a table.
pub(super) struct Evaluator {
    /// The mode and the kernel.
    pub(super) name: &'static str,
    /// Makes it ready for a table; `None` where it does not serve that table.
    pub(super) of: for<'a> fn(&'a PiecewiseTable) -> Option<Value<'a>>,
}

/// All of them.
pub(super) const EVALUATORS: &[Evaluator] = &[
    Evaluator { name: "`reference`", of: |table| Some(Box::new(|point| reference(table, point))) },
    Evaluator { name: "`full`, scalar", of: |table| Some(Box::new(|point| table.value(point))) },
];

fn reference(table: &PiecewiseTable, point: &[f64]) -> f64 {
    let (first, others) = point.split_first().map_or((f64::NAN, &[][..]), |(first, others)| (*first, others));
    table.reference_value_at(first, others)
}
