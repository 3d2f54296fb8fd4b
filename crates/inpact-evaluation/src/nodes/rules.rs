//! What may be wrong with a node table: rules D001 to D010 and D020 to D022.
//!
//! The rules of other data that belongs to a deck stand where that data is read.

use inpact_diagnostics::data_rules;

data_rules! {
    /// The rules about node tables, in the order of their codes.
    DATA_RULES;

    /// A column that an output needs is not there.
    ///
    /// The finding names the column and the output that needs it.
    /// Give the column, or ask for other outputs with `--outputs`; `inpact plan` lists what each output reads.
    MISSING_COLUMN = "D001", "missing-column", Error, source: "docs/tables.md";

    /// A cell is no number, or a row has too few or too many cells.
    ///
    /// Numbers have a decimal point and no separators of thousands; an empty cell is a missing number.
    /// A row must have as many cells as the header.
    MALFORMED_CELL = "D002", "malformed-cell", Error, source: "docs/tables.md";

    /// A cell is NaN or infinite, and so may be the results of its row.
    ///
    /// Such a row is evaluated: what the number does not reach is right, what it reaches is NaN or infinite.
    /// Where the number was meant to be missing, leave the cell empty.
    NON_FINITE = "D003", "non-finite", Warning, source: "docs/tables.md";

    /// The deck does not define the interaction.
    ///
    /// Names are compared as Abaqus does, without regard to case and blanks unless they are quoted.
    /// Mend the name in the table, or define the *SURFACE INTERACTION in the deck.
    UNKNOWN_INTERACTION = "D004", "unknown-interaction", Error, source: "docs/tables.md";

    /// Two headers mean the same column.
    ///
    /// Some columns have several names, such as `clearance` and `copen`.
    /// Keep one of the two.
    DUPLICATE_COLUMN = "D005", "duplicate-column", Error, source: "docs/tables.md";

    /// Time does not rise from one row of a node to its next.
    ///
    /// Histories add up from one row of a node to its next, so times of a node must rise from row to row.
    /// Sort the table by time, or give each step of a restarted analysis a table of its own.
    TIME_NOT_ASCENDING = "D006", "time-not-ascending", Error, source: "docs/tables.md";

    /// Rows lie outside the range of a table.
    ///
    /// The value at the end of the table is kept, as the manual says, and not extrapolated.
    /// Extend the table in the deck if the range is meant to be reached.
    BEYOND_TABLE = "D007", "beyond-table", Note, source: "T-04";

    /// An area is below zero.
    ///
    /// An area is that of the slave node, zero or more.
    /// Mend its sign.
    NEGATIVE_AREA = "D008", "negative-area", Error, source: "docs/tables.md";

    /// A characteristic length or a bulk permeability is below zero.
    ///
    /// A characteristic element length and a bulk permeability are zero or more.
    /// Mend the sign.
    NEGATIVE_PROPERTY = "D009", "negative-property", Error, source: "docs/tables.md";

    /// A user subroutine gives what is no conductance.
    ///
    /// Its conductance and the derivatives must be numbers, and the conductance not below zero.
    /// The finding says in which row it was what; mend the routine.
    USER_FAULT = "D010", "user-subroutine-fault", Error, source: "docs/tables.md";

    /// Nothing reads a column whose name is near to one that a node table may have.
    ///
    /// Column names are compared without regard to case and to blanks around them, and a name that means nothing is passed over.
    /// Where the near name is meant, write it so; `inpact explain columns` lists all of them.
    UNKNOWN_COLUMN = "D020", "unknown-column", Warning, source: "docs/tables.md";

    /// A given clearance rate and the change of the clearance disagree.
    ///
    /// Where `clearance_rate` is given, the gap fills at that rate: PFL is its flow and PTL that flow times the length of the increment.
    /// From row to row the clearance changes at another rate, by more than 1 %.
    /// The finding has the first such row with both rates.
    /// Mend the one that is wrong, or leave `clearance_rate` out, so that the rate follows from the clearance.
    CONTRADICTORY_RATE = "D021", "contradictory-rate", Warning, source: "O-5";

    /// Rows whose heat takes the jump of the open circuit at their start.
    ///
    /// The heat of a current in a transient is a mean over the increment, (η σ/3)(Δφ₁² + Δφ₁Δφ₀ + Δφ₀²) with the conductance σ at its end.
    /// Where the interface did not conduct at the start, Δφ₀ is the jump of the open circuit: the formula then gives a heat that no circuit supplied and that grows with the length of the increment.
    /// SJD, SJDT and what follows from them hold the manual's form all the same; the finding has the first such row.
    /// Give a row right after the circuit has closed, so that the increment in which it closes is short.
    /// `inpact solve` takes Δφ₀ = Δφ₁ there, so that power balances, unless a scene says `closing_heat = "manual"` under `[time]`.
    HEAT_OF_CLOSING = "D022", "heat-of-closing", Warning, source: "Q-41";
}
