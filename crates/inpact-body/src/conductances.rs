//! Symmetric matrices of conductances between terminals, one block per body.

/// Conductances between terminals: heat per time and temperature (M L² T⁻³ θ⁻¹), or current per potential (C T⁻¹ φ⁻¹).
///
/// The diagonal is the total conductance of a terminal to all others, so that the flows into an isothermal body are zero.
#[derive(Debug, Clone, PartialEq)]
pub struct Conductances {
    /// The block and the row of each terminal; `None` where its body has no other.
    places: Vec<Option<(usize, usize)>>,
    blocks: Vec<Block>,
}

/// The conductances within a body.
#[derive(Debug, Clone, PartialEq)]
struct Block {
    /// In ascending order.
    terminals: Vec<usize>,
    /// Row by row; the diagonal is not used.
    between: Vec<f64>,
}

impl Conductances {
    /// Zero conductances between this number of terminals, grouped by body.
    pub(crate) fn new<'a>(count: usize, groups: impl IntoIterator<Item = &'a [usize]>) -> Self {
        let mut places = vec![None; count];
        let mut blocks = Vec::new();
        for group in groups {
            for (row, terminal) in group.iter().enumerate() {
                places[*terminal] = Some((blocks.len(), row));
            }
            blocks.push(Block { terminals: group.to_vec(), between: vec![0.0; group.len() * group.len()] });
        }
        Self { places, blocks }
    }

    /// The block of two terminals and their places in it; `None` where no body has both.
    fn place(&self, a: usize, b: usize) -> Option<(usize, usize, usize)> {
        let ((block, row), (other, column)) = self.places[a].zip(self.places[b])?;
        (block == other).then_some((block, row, column))
    }

    /// Sets the conductance between two terminals of one body.
    pub(crate) fn set(&mut self, a: usize, b: usize, conductance: f64) {
        let (block, row, column) = self.place(a, b).expect("both are of one body");
        let Block { terminals, between } = &mut self.blocks[block];
        between[row * terminals.len() + column] = conductance;
        between[column * terminals.len() + row] = conductance;
    }

    /// The number of terminals.
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Whether there is no terminal.
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// The conductance between two terminals; 0 where no body has both. It is the negative of the off-diagonal entry of the matrix.
    ///
    /// # Panics
    ///
    /// The terminals do not exist, or are the same.
    pub fn between(&self, a: usize, b: usize) -> f64 {
        assert!(a != b && a < self.len() && b < self.len(), "terminals {a} and {b} of {}", self.len());
        self.place(a, b).map_or(0.0, |(block, row, column)| {
            let Block { terminals, between } = &self.blocks[block];
            between[row * terminals.len() + column]
        })
    }

    /// The total conductance of a terminal to all others: the diagonal entry.
    ///
    /// # Panics
    ///
    /// The terminal does not exist.
    pub fn to_all(&self, a: usize) -> f64 {
        self.places[a].map_or(0.0, |(block, row)| {
            let Block { terminals, between } = &self.blocks[block];
            let of_row = &between[row * terminals.len()..][..terminals.len()];
            of_row.iter().enumerate().filter(|(column, _)| *column != row).map(|(_, conductance)| conductance).sum()
        })
    }

    /// The largest magnitude of a conductance.
    pub fn largest(&self) -> f64 {
        let all = self.blocks.iter().flat_map(|block| &block.between);
        all.fold(0.0, |largest, conductance| conductance.abs().max(largest))
    }

    /// The pairs of terminals with their conductance, each once.
    pub fn pairs(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        (0..self.len()).flat_map(move |a| (a + 1..self.len()).map(move |b| (a, b, self.between(a, b))))
    }

    /// The pairs of terminals of one body with their conductance, each once, in the order of [`pairs`](Self::pairs).
    pub fn within_bodies(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        self.places.iter().enumerate().filter_map(|(a, place)| Some((a, (*place)?))).flat_map(
            move |(a, (block, row))| {
                let Block { terminals, between } = &self.blocks[block];
                let of_row = &between[row * terminals.len()..][..terminals.len()];
                terminals.iter().zip(of_row).skip(row + 1).map(move |(b, conductance)| (a, *b, *conductance))
            },
        )
    }

    /// The pairs whose conductance is negative by more than rounding, due to a coarse or distorted mesh.
    pub fn negative(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        let rounding = self.largest() * ROUNDING;
        self.within_bodies().filter(move |(_, _, conductance)| *conductance < -rounding)
    }
}

/// Conductances below this fraction of the largest may be rounding.
pub(crate) const ROUNDING: f64 = 1e-12;
