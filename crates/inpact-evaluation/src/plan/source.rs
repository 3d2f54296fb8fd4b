//! Where a quantity of a law comes from: a column, or the columns of both sides.

use super::reason::Missing;
use crate::nodes::Column;

/// The source of a quantity, in terms of `C`: [`Column`]s in a plan, indices in a batch once it is compiled.
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

/// The source of a quantity that has a column of its own.
pub(crate) fn cell(column: Column, presence: impl Fn(Column) -> Presence) -> Result<Column, Missing> {
    match presence(column) {
        Presence::Full | Presence::Partial => Ok(column),
        Presence::Empty => Err(Missing::empty(vec![column])),
        Presence::Absent => Err(Missing::absent(vec![column])),
    }
}

/// The source of a quantity in one column or in those of the two sides; the single column takes precedence.
pub(crate) fn whole_or_sides(
    [whole, slave, master]: [Column; 3],
    presence: impl Fn(Column) -> Presence,
) -> Result<Source<Column>, Missing> {
    let sides = presence(slave).has_numbers() && presence(master).has_numbers();
    match (presence(whole), sides) {
        (Presence::Full, _) | (Presence::Partial, false) => return Ok(Source::Cell(whole)),
        (Presence::Partial, true) => return Ok(Source::CellOrSides(whole, slave, master)),
        (Presence::Empty | Presence::Absent, true) => return Ok(Source::Sides(slave, master)),
        (Presence::Empty | Presence::Absent, false) => {}
    }
    let lacking: Vec<Column> = [slave, master].into_iter().filter(|side| !presence(*side).has_numbers()).collect();
    let is_absent = lacking.iter().any(|side| presence(*side) == Presence::Absent);
    let missing = if is_absent { Missing::absent(lacking) } else { Missing::empty(lacking) };
    Err(missing.or(whole))
}
