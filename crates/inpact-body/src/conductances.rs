//! Symmetric matrices of conductances between terminals.

/// Conductances between terminals: heat per time and temperature (M L² T⁻³ θ⁻¹), or current per potential (C T⁻¹ φ⁻¹).
///
/// The diagonal is what a terminal conducts to all others together, so that the flows into a body at one temperature are zero.
#[derive(Debug, Clone, PartialEq)]
pub struct Conductances {
    count: usize,
    /// Row by row; the diagonal is not used.
    between: Vec<f64>,
}

impl Conductances {
    pub(crate) fn new(count: usize) -> Self {
        Self { count, between: vec![0.0; count * count] }
    }

    pub(crate) fn set(&mut self, a: usize, b: usize, conductance: f64) {
        self.between[a * self.count + b] = conductance;
        self.between[b * self.count + a] = conductance;
    }

    /// The number of terminals.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there is no terminal.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The conductance between two terminals; 0 where no body has both. It is the negative of the entry of the matrix beside the diagonal.
    ///
    /// # Panics
    ///
    /// There are no such terminals, or they are the same.
    pub fn between(&self, a: usize, b: usize) -> f64 {
        assert!(a != b && a < self.count && b < self.count, "terminals {a} and {b} of {}", self.count);
        self.between[a * self.count + b]
    }

    /// The conductance of a terminal to all others together: the entry on the diagonal.
    ///
    /// # Panics
    ///
    /// There is no such terminal.
    pub fn to_all(&self, a: usize) -> f64 {
        (0..self.count).filter(|b| *b != a).map(|b| self.between(a, b)).sum()
    }

    /// The largest magnitude of a conductance.
    pub fn largest(&self) -> f64 {
        self.between.iter().fold(0.0, |largest, conductance| conductance.abs().max(largest))
    }

    /// The pairs of terminals with what is between them, each once.
    pub fn pairs(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        (0..self.count).flat_map(move |a| (a + 1..self.count).map(move |b| (a, b, self.between(a, b))))
    }

    /// The pairs whose conductance is below zero by more than rounding: a mesh so coarse or distorted that a terminal cools where another is heated.
    pub fn negative(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        let rounding = self.largest() * ROUNDING;
        self.pairs().filter(move |(_, _, conductance)| *conductance < -rounding)
    }
}

/// Conductances below this share of the largest may be rounding.
pub(crate) const ROUNDING: f64 = 1e-12;
