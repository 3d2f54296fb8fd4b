//! What a row costs in each form: measured once and committed, so that a choice is the same in every run and on every machine.
//!
//! `cargo run --release -p inpact-bench -- costs` measures the numbers anew and prints the table below.
//! They are the least of several rounds over 10⁶ random rows on one thread, x86-64 with AVX-512; what they are used for is their order, not their size.

use super::{Form, Method};
use crate::table::PiecewiseTable;

/// What of a table decides how fast it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shape {
    /// How many axes the value depends on.
    pub axes: usize,
    /// How many abscissae an axis has on average: the largest whole number whose power is not above the number of rows.
    pub knots: usize,
}

impl Shape {
    /// The shape of a table.
    pub fn of(table: &PiecewiseTable) -> Self {
        let axes = table.axes().iter().filter(|axis| axis.matters()).count();
        let rows = table.row_count();
        let power = |knots: usize| (0..axes).fold(1_usize, |power, _| power.saturating_mul(knots));
        let mut knots = 1;
        while axes > 0 && power(knots + 1) <= rows {
            knots += 1;
        }
        Self { axes, knots }
    }
}

/// What the numbers of a query's columns are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Columns {
    /// f64.
    #[default]
    Double,
    /// f32, and so are the values asked for. The f32 form takes them as they are; the other forms cost what they cost with f64.
    Single,
}

/// Measured costs of one shape, in ns a row.
struct Measured {
    axes: usize,
    /// The most abscissae an axis may have for this line to apply.
    knots: usize,
    reference: f64,
    full: f64,
    slope: f64,
    /// f32 form, f64 columns.
    single: f64,
    /// f32 form, f32 columns.
    of_single_columns: f64,
    grid: f64,
}

/// The cost of a row in nanoseconds, by the committed measurements; 0 for a table that depends on nothing.
///
/// A shape between two measured ones costs as the larger.
pub fn cost(method: &Method, shape: Shape, columns: Columns) -> f64 {
    if shape.axes == 0 {
        return 0.0;
    }
    let last_axes = MEASURED[MEASURED.len() - 1].axes;
    let axes = shape.axes.min(last_axes);
    let of_axes = || MEASURED.iter().filter(|line| line.axes == axes);
    let Some(line) = of_axes().find(|line| shape.knots <= line.knots).or_else(|| of_axes().next_back()) else {
        return f64::INFINITY;
    };
    match method {
        Method::Reference => line.reference,
        Method::Full => line.full,
        Method::Fast(Form::Slope) => line.slope,
        Method::Fast(Form::Single) if columns == Columns::Single => line.of_single_columns,
        Method::Fast(Form::Single) => line.single,
        Method::Fast(Form::Grid { .. }) => line.grid,
    }
}

include!("cost_measured.rs");
