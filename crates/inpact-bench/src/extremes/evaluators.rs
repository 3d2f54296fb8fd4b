//! The ways to evaluate a table: the modes and their kernels.

use inpact_evaluation::table::{
    ErrorBound, Grid, InstructionSet, PiecewiseTable, Refusal, TableKernel, commensurate_cells, full_bound,
    reference_bound,
};

/// The value of a table at a point.
pub(super) type Value<'a> = Box<dyn Fn(&[f64]) -> f64 + 'a>;

/// A way to evaluate a table.
pub(super) struct Evaluator {
    /// The mode and the kernel.
    pub(super) name: &'static str,
    /// Prepares it for a table, or returns why it does not support that table.
    pub(super) of: for<'a> fn(&'a PiecewiseTable) -> Result<Ready<'a>, String>,
}

/// A way made ready for a table.
pub(super) struct Ready<'a> {
    pub(super) value: Value<'a>,
    /// The bound of the error of a value of the table.
    pub(super) bound: ErrorBound,
}

/// All of them.
pub(super) const EVALUATORS: &[Evaluator] = &[
    Evaluator {
        name: "`reference`",
        of: |table| Ok(Ready { value: Box::new(|point| reference(table, point)), bound: reference_bound(table) }),
    },
    Evaluator {
        name: "`full`, scalar",
        of: |table| Ok(Ready { value: Box::new(|point| table.value(point)), bound: full_bound(table) }),
    },
    Evaluator { name: "`full`, every instruction set", of: |table| Ok(of_every_set(table)) },
    Evaluator { name: "`grid`, commensurate", of: grid },
];

fn reference(table: &PiecewiseTable, point: &[f64]) -> f64 {
    let (first, others) = point.split_first().map_or((f64::NAN, &[][..]), |(first, others)| (*first, others));
    table.reference_value_at(first, others)
}

/// The kernel with each instruction set of this machine; where they do not agree bitwise, the value is NaN, which is never accepted.
fn of_every_set(table: &PiecewiseTable) -> Ready<'_> {
    /// A whole vector of the widest set, and a part of one.
    const ROWS: usize = 11;
    let kernel = TableKernel::new(table);
    let sets = InstructionSet::available();
    let value = move |point: &[f64]| {
        let columns: Vec<[f64; ROWS]> = point.iter().map(|&coordinate| [coordinate; ROWS]).collect();
        let columns: Vec<&[f64]> = columns.iter().map(<[f64; ROWS]>::as_slice).collect();
        let mut found = None;
        for set in &sets {
            let mut values = [f64::NAN; ROWS];
            kernel.values_with(*set, &columns, &mut values);
            let first = *found.get_or_insert(values[0]);
            if values.iter().any(|value| value.to_bits() != first.to_bits()) {
                return f64::NAN;
            }
        }
        found.unwrap_or(f64::NAN)
    };
    Ready { value: Box::new(value), bound: full_bound(table) }
}

/// The grid whose lines contain all abscissae.
fn grid(table: &PiecewiseTable) -> Result<Ready<'_>, String> {
    if table.axes().iter().filter(|axis| axis.matters()).count() < 2 {
        return Err(Refusal::OneAxis.to_string());
    }
    let cells = commensurate_cells(table).ok_or("no regular grid that stays in cache meets all abscissae")?;
    let grid = Grid::new(table, &cells).map_err(|refusal| refusal.to_string())?;
    let bound = grid.bound();
    Ok(Ready { value: Box::new(move |point| grid.value(point)), bound })
}
