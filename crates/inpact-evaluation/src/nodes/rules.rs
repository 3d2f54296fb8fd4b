//! Faults of node tables: rules D001 to D010 and D020 to D022.
//!
//! The rules about other data of a deck are defined where that data is read.

use inpact_diagnostics::data_rules;

data_rules! {
    /// The rules about node tables, in the order of their codes.
    DATA_RULES;

    /// A column that an output needs is not there.
    ///
    /// The finding names the column and the output that needs it.
    /// Give the column, or ask for other outputs with `--outputs`; `inpact plan` lists what each output reads.
    ///
    /// ```inp deck.inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 0., 1.
    /// ```
    /// ```csv nodes.csv
    /// node,area
    /// 1,2.5e-6
    /// ```
    /// ```console
    /// $ inpact eval deck.inp --nodes nodes.csv --format full
    /// error[D001] missing-column
    ///
    ///   × `clearance` is missing, which the electrical law of `JOINT` needs
    ///   help: at nodes.csv, column `clearance`
    /// ```
    MISSING_COLUMN = "D001", "missing-column", Error, source: "docs/tables.md";

    /// A cell is no number, or a row has too few or too many cells.
    ///
    /// Numbers have a decimal point and no separators of thousands; an empty cell is a missing number.
    /// A row must have as many cells as the header.
    ///
    /// ```inp deck.inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 0., 1.
    /// ```
    /// ```csv nodes.csv
    /// node,clearance
    /// 1,0
    /// 2,x
    /// ```
    /// ```console
    /// $ inpact eval deck.inp --nodes nodes.csv --format full
    /// error[D002] malformed-cell
    ///
    ///   × `clearance` of row 2 is `x`, which is no number
    ///    ╭─[nodes.csv:3:3]
    ///  2 │ 1,0
    ///  3 │ 2,x
    ///    ·   ─
    ///    ╰────
    ///   help: write a number such as 1.5e-3, or leave the cell empty where there is none
    /// ```
    MALFORMED_CELL = "D002", "malformed-cell", Error, source: "docs/tables.md";

    /// A cell is NaN or infinite, and so may be the results of its row.
    ///
    /// Such a row is evaluated: what the number does not reach is right, what it reaches is NaN or infinite.
    /// Where the number was meant to be missing, leave the cell empty.
    ///
    /// ```inp deck.inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 0., 1.
    /// ```
    /// ```csv nodes.csv
    /// node,clearance
    /// 1,0
    /// 2,nan
    /// ```
    /// ```console
    /// $ inpact eval deck.inp --nodes nodes.csv --format full
    /// warning[D003] non-finite
    ///
    ///   ⚠ `clearance` is NaN or infinite in 1 row
    ///    ╭─[nodes.csv:3:3]
    ///  2 │ 1,0
    ///  3 │ 2,nan
    ///    ·   ───
    ///    ╰────
    ///   help: results of these rows are NaN or the limit; leave a cell empty where there is no number
    /// ```
    NON_FINITE = "D003", "non-finite", Warning, source: "docs/tables.md";

    /// The deck does not define the interaction.
    ///
    /// Names are compared as Abaqus does, without regard to case and blanks unless they are quoted.
    /// Mend the name in the table, or define the *SURFACE INTERACTION in the deck.
    ///
    /// ```inp deck.inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 0., 1.
    /// ```
    /// ```csv nodes.csv
    /// node,interaction,clearance
    /// 1,JIONT,0
    /// ```
    /// ```console
    /// $ inpact eval deck.inp --nodes nodes.csv --format full
    /// error[D004] unknown-interaction
    ///
    ///   × `interaction` of row 1 is `JIONT`, which the deck does not define
    ///    ╭─[nodes.csv:2:3]
    ///  1 │ node,interaction,clearance
    ///  2 │ 1,JIONT,0
    ///    ·   ─────
    ///    ╰────
    ///   help: its interactions are `JOINT`
    /// ```
    UNKNOWN_INTERACTION = "D004", "unknown-interaction", Error, source: "docs/tables.md";

    /// Two headers mean the same column.
    ///
    /// Some columns have several names, such as `clearance` and `copen`.
    /// Keep one of the two.
    ///
    /// ```inp deck.inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 0., 1.
    /// ```
    /// ```csv nodes.csv
    /// node,clearance,copen
    /// 1,0,0
    /// ```
    /// ```console
    /// $ inpact eval deck.inp --nodes nodes.csv --format full
    /// error[D005] duplicate-column
    ///
    ///   × columns `clearance` and `copen` both mean `clearance`
    ///    ╭─[nodes.csv:1:16]
    ///  1 │ node,clearance,copen
    ///    ·                ─────
    ///  2 │ 1,0,0
    ///    ╰────
    ///   help: keep one of the two
    /// ```
    DUPLICATE_COLUMN = "D005", "duplicate-column", Error, source: "docs/tables.md";

    /// Time does not rise from one row of a node to its next.
    ///
    /// Histories add up from one row of a node to its next, so times of a node must rise from row to row.
    /// Sort the table by time, or give each step of a restarted analysis a table of its own.
    ///
    /// ```inp deck.inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 0., 1.
    /// ```
    /// ```csv nodes.csv
    /// node,time,clearance
    /// 1,2,0
    /// 1,1,0
    /// ```
    /// ```console
    /// $ inpact eval deck.inp --nodes nodes.csv --format full
    /// error[D006] time-not-ascending
    ///
    ///   × `time` of node `1` is 1.0 in row 2 and 2.0 in the row before it
    ///    ╭─[nodes.csv:3:3]
    ///  2 │ 1,2,0
    ///  3 │ 1,1,0
    ///    ·   ─
    ///    ╰────
    ///   help: sort the rows by time, give nodes of different parts different labels, and leave out the
    ///         first frame of a step, which repeats the last of the step before
    /// ```
    TIME_NOT_ASCENDING = "D006", "time-not-ascending", Error, source: "docs/tables.md";

    /// Rows lie outside the range of a table.
    ///
    /// The value at the end of the table is kept, as the manual says, and not extrapolated.
    /// Extend the table in the deck if the range is meant to be reached.
    ///
    /// ```inp deck.inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 0., 1.
    /// ```
    /// ```csv nodes.csv
    /// node,clearance
    /// 1,0.5
    /// 2,1.5
    /// ```
    /// ```console
    /// $ inpact eval deck.inp --nodes nodes.csv --format full
    /// note[D007] beyond-table
    ///
    ///   ☞ 1 row lies above the last `clearance` of the table of conductance against clearance of
    ///   │ `JOINT`, 1
    ///   help: at nodes.csv, column `clearance`
    ///         the conductance is zero there
    /// ```
    BEYOND_TABLE = "D007", "beyond-table", Note, source: "T-04";

    /// An area is below zero.
    ///
    /// An area is that of the slave node, zero or more.
    /// Mend its sign.
    ///
    /// ```inp deck.inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 0., 1.
    /// ```
    /// ```csv nodes.csv
    /// node,clearance,area
    /// 1,0,-2.5e-6
    /// ```
    /// ```console
    /// $ inpact eval deck.inp --nodes nodes.csv --format full
    /// error[D008] negative-area
    ///
    ///   × `area` of row 1 is -2.5e-6, below zero
    ///    ╭─[nodes.csv:2:5]
    ///  1 │ node,clearance,area
    ///  2 │ 1,0,-2.5e-6
    ///    ·     ───────
    ///    ╰────
    ///   help: give the area of the slave node, or leave the cell empty
    /// ```
    NEGATIVE_AREA = "D008", "negative-area", Error, source: "docs/tables.md";

    /// A characteristic length or a bulk permeability is below zero.
    ///
    /// A characteristic element length and a bulk permeability are zero or more.
    /// Mend the sign.
    ///
    /// ```inp deck.inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *CONTACT PERMEABILITY
    /// 1.E-3, 0.
    /// ```
    /// ```csv nodes.csv
    /// node,clearance,por_s,por_m,char_length
    /// 1,0.1,10,20,-0.5
    /// ```
    /// ```console
    /// $ inpact eval deck.inp --nodes nodes.csv --format full
    /// error[D009] negative-property
    ///
    ///   × `char_length` of row 1 is -0.5, below zero
    ///    ╭─[nodes.csv:2:13]
    ///  1 │ node,clearance,por_s,por_m,char_length
    ///  2 │ 1,0.1,10,20,-0.5
    ///    ·             ────
    ///    ╰────
    ///   help: give a number of zero or above, or leave the cell empty
    /// ```
    NEGATIVE_PROPERTY = "D009", "negative-property", Error, source: "docs/tables.md";

    /// A user subroutine gives what is no conductance.
    ///
    /// Its conductance and the derivatives must be numbers, and the conductance not below zero.
    /// The finding says in which row it was what; mend the routine.
    ///
    /// ```inp deck.inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE, USER
    /// ```
    /// ```fortran gapelectr.f
    ///       SUBROUTINE GAPELECTR(SIGMA,D,TEMP,PREDEF,TIME,CINAME,SLNAME,
    ///      1   MSNAME,COORDS,NODE,NPRED,KSTEP,KINC)
    ///       IMPLICIT REAL*8(A-H,O-Z)
    ///       CHARACTER*80 CINAME,SLNAME,MSNAME
    ///       DIMENSION SIGMA(3),TEMP(2),PREDEF(2,*),TIME(2),COORDS(2,3)
    ///       SIGMA(1) = 20.0D0 - 40.0D0*D
    ///       RETURN
    ///       END
    /// ```
    /// ```csv nodes.csv
    /// node,clearance,temp
    /// 1,0,20
    /// 2,1,20
    /// ```
    /// ```console
    /// $ gfortran -shared -fPIC -o gapelectr.so gapelectr.f
    /// ```
    /// ```console
    /// $ inpact eval deck.inp --nodes nodes.csv --user-library gapelectr.so --format full
    /// error[D010] user-subroutine-fault
    ///
    ///   × user subroutine GAPELECTR gives a conductance below zero, SIGMA(1) = -20.0 in row 2, clearance
    ///   │ 1.0
    ///    ╭─[nodes.csv:3:1]
    ///  2 │ 1,0,20
    ///  3 │ 2,1,20
    ///    · ──────
    ///    ╰────
    ///   help: in 1 row: mend the routine, and compile it again
    /// ```
    USER_FAULT = "D010", "user-subroutine-fault", Error, source: "docs/tables.md";

    /// Nothing reads a column whose name is near to one that a node table may have.
    ///
    /// Column names are compared without regard to case and to blanks around them, and a name that means nothing is passed over.
    /// Where the near name is meant, write it so; `inpact explain columns` lists all of them.
    ///
    /// ```inp deck.inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 0., 1.
    /// ```
    /// ```csv nodes.csv
    /// node,clearance,presure
    /// 1,0,5
    /// ```
    /// ```console
    /// $ inpact eval deck.inp --nodes nodes.csv --format full
    /// warning[D020] unknown-column
    ///
    ///   ⚠ a node table has no column `presure`, and nothing reads it
    ///    ╭─[nodes.csv:1:16]
    ///  1 │ node,clearance,presure
    ///    ·                ───────
    ///  2 │ 1,0,5
    ///    ╰────
    ///   help: did you mean `pressure`?
    /// ```
    UNKNOWN_COLUMN = "D020", "unknown-column", Warning, source: "docs/tables.md";

    /// A given clearance rate and the change of the clearance disagree.
    ///
    /// Where `clearance_rate` is given, the gap fills at that rate: PFL is its flow and PTL that flow times the length of the increment.
    /// From row to row the clearance changes at another rate, by more than 1 %.
    /// The finding has the first such row with both rates.
    /// Mend the one that is wrong, or leave `clearance_rate` out, so that the rate follows from the clearance.
    ///
    /// ```inp deck.inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=1., CUTOFF GAP FILL=1.
    /// 1.E-3, 0.
    /// *STEP
    /// *SOILS, CONSOLIDATION
    /// 1., 1.
    /// *END STEP
    /// ```
    /// ```csv nodes.csv
    /// node,time,clearance,clearance_rate,por_s,por_m
    /// 1,0,0.3,-0.1,10,20
    /// 1,1,0.2,-0.1,10,20
    /// 1,2,0.2,-0.1,10,20
    /// ```
    /// ```console
    /// $ inpact eval deck.inp --nodes nodes.csv --format full
    /// warning[D021] contradictory-rate
    ///
    ///   ⚠ `clearance_rate` contradicts the clearance in 1 row of `JOINT`: the first has a rate of -0.1,
    ///   │ and its clearance has changed at 0.0
    ///    ╭─[nodes.csv:4:1]
    ///  3 │ 1,1,0.2,-0.1,10,20
    ///  4 │ 1,2,0.2,-0.1,10,20
    ///    · ──────────────────
    ///    ╰────
    ///   help: PFL and PTL go by the rate: mend it, or leave the column out so that the rate follows from
    ///         the clearance
    /// ```
    CONTRADICTORY_RATE = "D021", "contradictory-rate", Warning, source: "O-5";

    /// Rows whose heat takes the jump of the open circuit at their start.
    ///
    /// The heat of a current in a transient is a mean over the increment, (η σ/3)(Δφ₁² + Δφ₁Δφ₀ + Δφ₀²) with the conductance σ at its end.
    /// Where the interface did not conduct at the start, Δφ₀ is the jump of the open circuit: the formula then gives a heat that no circuit supplied and that grows with the length of the increment.
    /// SJD, SJDT and what follows from them hold the manual's form all the same; the finding has the first such row.
    /// Give a row right after the circuit has closed, so that the increment in which it closes is short.
    /// `inpact solve` takes Δφ₀ = Δφ₁ there, so that power balances, unless a scene says `closing_heat = "manual"` under `[time]`.
    ///
    /// ```inp deck.inp
    /// *SURFACE INTERACTION, NAME=JOINT
    /// *GAP ELECTRICAL CONDUCTANCE
    /// 20., 0.
    /// 0., 1.
    /// *STEP
    /// *COUPLED THERMAL-ELECTRICAL
    /// 1., 1.
    /// *END STEP
    /// ```
    /// ```csv nodes.csv
    /// node,time,clearance,epot_s,epot_m
    /// 1,0,1,10,0
    /// 1,1,0,0.001,0
    /// ```
    /// ```console
    /// $ inpact eval deck.inp --nodes nodes.csv --format full
    /// warning[D022] heat-of-closing
    ///
    ///   ⚠ the heat of the current takes the jump of an open circuit in 1 row of `JOINT`: the first has a
    ///   │ jump of 0.001, and its increment starts open with 10.0
    ///    ╭─[nodes.csv:3:1]
    ///  2 │ 1,0,1,10,0
    ///  3 │ 1,1,0,0.001,0
    ///    · ─────────────
    ///    ╰────
    ///   help: the manual's mean over the increment (H-08) is right where the conductance changes little:
    ///         give a row right after the circuit has closed, and count heat from there
    /// ```
    HEAT_OF_CLOSING = "D022", "heat-of-closing", Warning, source: "Q-41";
}
