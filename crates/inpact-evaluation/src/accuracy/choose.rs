//! Choice of the evaluation method of a table: the cheapest whose error bound is within the user's tolerance.
//!
//! The choice depends on the table and the tolerance alone, never on a measurement: the cost follows from the shape of the table ([`Shape`]).

use super::grid::Grid;
use super::{
    Accuracy, ErrorBound, FAST_TOLERANCE, Method, Refusal, Shape, Tolerance, Wanted, commensurate_cells, full_bound,
    reference_bound,
};
use crate::table::PiecewiseTable;

/// A method that was considered.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// The method.
    pub method: Method,
    /// Its error bound; `None` where it is not possible.
    pub bound: Option<ErrorBound>,
    /// The cost of a row by the shape of the table, in units of about a nanosecond.
    pub cost: f64,
    /// Why it was not chosen; `None` for the one that was.
    pub refusal: Option<Refusal>,
}

/// The choice, and the candidates.
#[derive(Clone, Debug)]
pub struct Choice {
    /// The grid, if one was chosen.
    pub(crate) grid: Option<Grid>,
    /// The chosen method.
    pub chosen: Candidate,
    /// The others, cheapest first, each with the reason.
    pub refused: Vec<Candidate>,
}

/// Chooses how to evaluate `table`.
///
/// [`Accuracy::Fast`] and a tolerance take the cheapest method whose bound is acceptable.
/// Where none is, [`Accuracy::Fast`] takes [`Method::Full`], and a tolerance the most accurate, [`Method::Reference`].
pub fn choose(table: &PiecewiseTable, wanted: Wanted) -> Choice {
    let shape = Shape::of(table);
    let full = Candidate::of(shape, Method::Full, Some(full_bound(table)));
    let reference = Candidate::of(shape, Method::Reference, Some(reference_bound(table)));
    let (tolerance, otherwise) = match wanted {
        Wanted::Mode(Accuracy::Reference) => return Choice { grid: None, chosen: reference, refused: Vec::new() },
        Wanted::Mode(Accuracy::Full) => return Choice { grid: None, chosen: full, refused: Vec::new() },
        Wanted::Mode(Accuracy::Fast) => (FAST_TOLERANCE, Method::Full),
        Wanted::Within(tolerance) => (tolerance, Method::Reference),
    };
    let (mut grid, by_grid) = grid_within(table, shape, tolerance);
    let mut candidates = vec![by_grid, full, reference];
    for candidate in &mut candidates {
        let missed = candidate.bound.and_then(|bound| tolerance.refusal(&bound));
        candidate.refusal = candidate.refusal.take().or(missed);
    }
    candidates.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let within = candidates.iter().position(|candidate| candidate.refusal.is_none());
    let chosen = within.or_else(|| candidates.iter().position(|candidate| candidate.method == otherwise)).unwrap_or(0);
    let chosen = Candidate { refusal: None, ..candidates.remove(chosen) };
    for candidate in &mut candidates {
        candidate.refusal.get_or_insert(Refusal::Slower);
    }
    if !matches!(chosen.method, Method::Grid { .. }) {
        grid = None;
    }
    Choice { grid, chosen, refused: candidates }
}

impl Candidate {
    fn of(shape: Shape, method: Method, bound: Option<ErrorBound>) -> Self {
        Self { cost: shape.cost(&method), method, bound, refusal: None }
    }
}

/// The grid that meets all abscissae, or the coarsest of a few within the tolerance, or the finest of these.
fn grid_within(table: &PiecewiseTable, shape: Shape, tolerance: Tolerance) -> (Option<Grid>, Candidate) {
    const COUNTS: [usize; 5] = [8, 16, 32, 64, 128];
    let meeting_all = if shape.axes < 2 { None } else { commensurate_cells(table) };
    let mut cells = vec![COUNTS[0]; shape.axes];
    let mut made = match &meeting_all {
        Some(meeting_all) => Grid::made(table, meeting_all),
        None => Grid::made(table, &cells),
    };
    if let (Some(meeting_all), Ok(_)) = (meeting_all, &made) {
        cells = meeting_all;
    } else {
        for count in &COUNTS[1..] {
            if made.as_ref().is_ok_and(|made| tolerance.refusal(&made.bound()).is_none()) {
                break;
            }
            let finer = Grid::made(table, &vec![*count; shape.axes]);
            if finer.is_err() && made.is_ok() {
                break;
            }
            (cells, made) = (vec![*count; shape.axes], finer);
        }
    }
    match made {
        Ok(grid) => {
            let candidate = Candidate::of(shape, Method::Grid { cells }, Some(grid.bound()));
            (Some(grid), candidate)
        }
        Err(refusal) => {
            let candidate = Candidate::of(shape, Method::Grid { cells }, None);
            (None, Candidate { refusal: Some(refusal), ..candidate })
        }
    }
}
