//! Fixed-point iteration of each value, under-relaxed or by bisection.

/// The maximum relaxation factor.
const FIRST_PART: f64 = 0.5;

/// A node that moves in one direction for longer has left the bracket of its reversals.
const LONGEST_RUN: u32 = 40;

/// Relaxation of fixed-point iteration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Relaxation {
    /// The factor is halved at a node that reverses, and increased where it continues.
    Parts,
    /// Bisection of the bracket in which a node reverses: solves a scene of one unknown at any step of its table.
    Brackets,
}

impl Relaxation {
    /// Converged when no value changes, or is bracketed, by more than this fraction of the largest.
    pub(super) fn at_rest(self) -> f64 {
        match self {
            Self::Parts => 1e-9,
            Self::Brackets => f64::EPSILON,
        }
    }
}

/// The history of a node in the iteration.
#[derive(Debug, Clone, Copy)]
pub(super) struct Walk {
    part: f64,
    last: f64,
    /// The last values from which it increased, and decreased.
    bracket: [f64; 2],
    /// The number of steps in one direction.
    run: u32,
}

impl Default for Walk {
    fn default() -> Self {
        Self { part: FIRST_PART, last: 0.0, bracket: [f64::NEG_INFINITY, f64::INFINITY], run: 0 }
    }
}

impl Walk {
    /// The step from a value that the unrelaxed iteration would change by `change`.
    pub(super) fn step(&mut self, way: Relaxation, value: f64, change: f64) -> f64 {
        let turns = change * self.last < 0.0;
        self.part = if turns { 0.5 * self.part } else { (1.1 * self.part).min(FIRST_PART) };
        self.run = if turns { 0 } else { self.run + 1 };
        self.last = change;
        if way == Relaxation::Parts {
            return self.part * change;
        }
        let goes_up = 0.0 < change;
        self.bracket[usize::from(!goes_up)] = value;
        let [lower, upper] = self.bracket;
        // Other nodes have moved the reversal point.
        if upper <= lower || LONGEST_RUN < self.run {
            self.bracket[usize::from(goes_up)] = if goes_up { f64::INFINITY } else { f64::NEG_INFINITY };
            self.run = 0;
        }
        let [lower, upper] = self.bracket;
        let aim = value + FIRST_PART * change;
        let is_inside = lower < aim && aim < upper;
        if is_inside || !lower.is_finite() || !upper.is_finite() {
            FIRST_PART * change
        } else {
            0.5 * (lower + upper) - value
        }
    }
}
