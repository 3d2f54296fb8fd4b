//! Which form a table is evaluated in: the cheapest whose error bound is within what the user accepts.
//!
//! The choice depends on the table, the tolerance and the committed costs alone, never on a measurement of the day.

use std::fmt;

use super::cost::{Columns, Shape, cost};
use super::{Accuracy, Approximation, ErrorBound, Form, Refusal, commensurate_cells, full_bound, reference_bound};
use crate::table::PiecewiseTable;

/// The error a user accepts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tolerance {
    /// As a part of the largest magnitude among the table's values.
    RelativeToLargest(f64),
    /// As a part of the exact value at the same point.
    Pointwise(f64),
}

impl Tolerance {
    /// What of a bound is compared with the tolerance.
    fn of_bound(self, bound: &ErrorBound) -> f64 {
        match self {
            Self::RelativeToLargest(_) => bound.relative_to_largest,
            Self::Pointwise(_) => bound.pointwise,
        }
    }

    fn value(self) -> f64 {
        match self {
            Self::RelativeToLargest(value) | Self::Pointwise(value) => value,
        }
    }

    /// Why a bound is not within the tolerance, if it is not.
    fn refusal(self, bound: &ErrorBound) -> Option<Refusal> {
        let (bound, tolerance) = (self.of_bound(bound), self.value());
        if bound <= tolerance { None } else { Some(Refusal::Bound { bound, tolerance }) }
    }
}

/// What a user asks for: a mode or a tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wanted {
    /// A mode. [`Accuracy::Fast`] takes the cheapest form whose bound is within [`FAST_TOLERANCE`], and the slope form where there is none.
    Mode(Accuracy),
    /// The cheapest mode within a tolerance; the reference where nothing is.
    Within(Tolerance),
}

impl Default for Wanted {
    fn default() -> Self {
        Self::Mode(Accuracy::default())
    }
}

impl Wanted {
    /// Whether values are wanted in twice the precision of f64.
    pub fn is_reference(self) -> bool {
        self == Self::Mode(Accuracy::Reference)
    }

    /// Whether the error of one more rounding to f64 is acceptable, as a table has that is folded before it is evaluated.
    pub(crate) fn allows_folding(self) -> bool {
        match self {
            Self::Mode(accuracy) => accuracy != Accuracy::Reference,
            // The bounds of the table's own kernel are a few ulp of 2.2e-16.
            Self::Within(tolerance) => tolerance.value() >= 1e-14,
        }
    }
}

/// What [`Accuracy::Fast`] accepts where no tolerance is given: 1e-4 of the largest value of the table.
pub const FAST_TOLERANCE: Tolerance = Tolerance::RelativeToLargest(1e-4);

/// A way to evaluate a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Method {
    /// [`PiecewiseTable::reference_value_at`].
    Reference,
    /// The table's own kernel.
    Full,
    /// A fast form.
    Fast(Form),
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Reference => write!(f, "reference"),
            Self::Full => write!(f, "full"),
            Self::Fast(form) => form.fmt(f),
        }
    }
}

/// One way that was considered.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The way.
    pub method: Method,
    /// Its error bound; none where the form cannot be made.
    pub bound: Option<ErrorBound>,
    /// What a row costs in ns, by the committed measurements.
    pub cost: f64,
    /// Why it was not chosen; none for the one that was.
    pub refusal: Option<Refusal>,
}

/// What was chosen, and what was considered.
#[derive(Clone, Debug)]
pub struct Choice {
    /// The approximation, if a fast form was chosen.
    pub approximation: Option<Approximation>,
    /// All candidates, the cheapest first; exactly one has no refusal.
    pub candidates: Vec<Candidate>,
}

impl Choice {
    /// The candidate that was chosen.
    pub fn chosen(&self) -> Option<&Candidate> {
        self.candidates.iter().find(|candidate| candidate.refusal.is_none())
    }
}

/// Chooses how to evaluate `table` on f64 columns.
pub fn choose(table: &PiecewiseTable, wanted: Wanted) -> Choice {
    choose_for(table, wanted, Columns::Double)
}

/// Chooses how to evaluate `table` on `columns`.
pub fn choose_for(table: &PiecewiseTable, wanted: Wanted, columns: Columns) -> Choice {
    match wanted {
        Wanted::Mode(Accuracy::Reference) => only(table, Method::Reference, reference_bound(table), columns),
        Wanted::Mode(Accuracy::Full) => only(table, Method::Full, full_bound(table), columns),
        Wanted::Mode(Accuracy::Fast) => cheapest(table, FAST_TOLERANCE, columns, &Method::Fast(Form::Slope)),
        Wanted::Within(tolerance) => cheapest(table, tolerance, columns, &Method::Reference),
    }
}

/// The choice where a mode leaves none.
fn only(table: &PiecewiseTable, method: Method, bound: ErrorBound, columns: Columns) -> Choice {
    let cost = cost(&method, Shape::of(table), columns);
    Choice { approximation: None, candidates: vec![Candidate { method, bound: Some(bound), cost, refusal: None }] }
}

/// The cheapest candidate within the tolerance; where there is none, `otherwise`, or if that cannot be made the table's own kernel.
fn cheapest(table: &PiecewiseTable, tolerance: Tolerance, columns: Columns, otherwise: &Method) -> Choice {
    let shape = Shape::of(table);
    let mut considered = vec![
        (Method::Full, Some(full_bound(table)), None, None),
        (Method::Reference, Some(reference_bound(table)), None, None),
    ];
    let mut consider = |form: Form, made: Result<Approximation, Refusal>| match made {
        Ok(made) => considered.push((Method::Fast(form), Some(made.bound()), Some(made), None)),
        Err(refusal) => considered.push((Method::Fast(form), None, None, Some(refusal))),
    };
    consider(Form::Slope, Approximation::slope(table));
    consider(Form::Single, Approximation::single(table));
    if shape.axes >= 2 {
        let (cells, made) = grid_within(table, shape, tolerance);
        consider(Form::Grid { cells }, made);
    }
    let mut candidates = Vec::new();
    let mut made = Vec::new();
    for (method, bound, approximation, refusal) in considered {
        let refusal = refusal.or_else(|| tolerance.refusal(&bound?));
        candidates.push(Candidate { cost: cost(&method, shape, columns), method, bound, refusal });
        made.push(approximation);
    }
    let within = |index: &usize| candidates[*index].refusal.is_none();
    let by_cost = |a: &usize, b: &usize| candidates[*a].cost.total_cmp(&candidates[*b].cost);
    let fallback = |method: &Method| {
        (0..candidates.len()).find(|&index| candidates[index].method == *method && candidates[index].bound.is_some())
    };
    let chosen = (0..candidates.len()).filter(within).min_by(by_cost).or_else(|| fallback(otherwise)).unwrap_or(0);
    for (index, candidate) in candidates.iter_mut().enumerate() {
        let refusal = candidate.refusal.take().or(Some(Refusal::Slower));
        candidate.refusal = if index == chosen { None } else { refusal };
    }
    let approximation = made.swap_remove(chosen);
    candidates.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    Choice { approximation, candidates }
}

/// The grid that meets all abscissae, or the coarsest of a few within the tolerance, or the finest of these.
fn grid_within(
    table: &PiecewiseTable,
    shape: Shape,
    tolerance: Tolerance,
) -> (Vec<usize>, Result<Approximation, Refusal>) {
    const COUNTS: [usize; 5] = [8, 16, 32, 64, 128];
    if let Some(cells) = commensurate_cells(table)
        && let Ok(made) = Approximation::grid(table, &cells)
    {
        return (cells, Ok(made));
    }
    let mut best = None;
    for count in COUNTS {
        let cells = vec![count; shape.axes];
        let made = Approximation::grid(table, &cells);
        let is_within = made.as_ref().is_ok_and(|made| tolerance.refusal(&made.bound()).is_none());
        if made.is_ok() || best.is_none() {
            best = Some((cells, made));
        } else {
            break;
        }
        if is_within {
            break;
        }
    }
    best.unwrap_or_else(|| (vec![1; shape.axes], Err(Refusal::Cells)))
}
