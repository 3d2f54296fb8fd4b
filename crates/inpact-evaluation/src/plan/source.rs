//! Where a quantity of a law comes from: a column, or the columns of both sides.

/// The source of a quantity, in terms of `C`: [`Column`](crate::nodes::Column)s in a plan, indices in a batch once it is compiled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source<C> {
    /// One cell.
    Cell(C),
    /// The cells of slave and master: their mean, or for potentials their difference.
    Sides(C, C),
    /// One cell, and where it is empty those of slave and master.
    CellOrSides(C, C, C),
}

/// The coverage of a column in the rows of an interaction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Presence {
    /// There is no such column.
    Absent,
    /// Its cells are empty.
    Empty,
    /// Some cells are empty.
    Partial,
    /// Every cell has a number.
    Full,
}

impl Presence {
    /// Whether there is any number.
    pub fn has_numbers(self) -> bool {
        matches!(self, Self::Partial | Self::Full)
    }
}

impl<C: Copy> Source<C> {
    /// The cells it consists of.
    pub fn cells(&self) -> impl Iterator<Item = C> {
        let cells = match *self {
            Self::Cell(cell) => [Some(cell), None, None],
            Self::Sides(slave, master) => [Some(slave), Some(master), None],
            Self::CellOrSides(cell, slave, master) => [Some(cell), Some(slave), Some(master)],
        };
        cells.into_iter().flatten()
    }

    /// The same source in other terms.
    pub fn map<D>(&self, to: impl Fn(C) -> D) -> Source<D> {
        match *self {
            Self::Cell(cell) => Source::Cell(to(cell)),
            Self::Sides(slave, master) => Source::Sides(to(slave), to(master)),
            Self::CellOrSides(cell, slave, master) => Source::CellOrSides(to(cell), to(slave), to(master)),
        }
    }
}
