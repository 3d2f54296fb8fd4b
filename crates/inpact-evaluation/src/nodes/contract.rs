//! The contract of node tables: each column with its names, its meaning, its unit and what reads it.
//!
//! The single definition of the columns, for the reader, `explain` and the documentation.
//! Units are by dimension: M mass, L length, T time, θ temperature, φ electric potential, C charge.

use super::column::{Column, Direction, Part};

/// The page of a column of node tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ColumnPage {
    /// The column; of the columns of field variables those of the first.
    pub column: Column,
    /// Its names, the canonical one first.
    pub names: &'static [&'static str],
    /// Its meaning.
    pub meaning: &'static str,
    /// Its unit by dimension; `1` for a pure number, empty for a text.
    pub unit: &'static str,
    /// Which laws and outputs read it.
    pub read_by: &'static str,
    /// Where the rule stands.
    pub source: &'static str,
}

/// Whether a column is one of those that have a number in their names.
fn is_field(column: Column) -> bool {
    matches!(column, Column::FieldVariable(..))
}

/// The columns whose names hold no number.
pub(super) fn plain_columns() -> impl Iterator<Item = &'static ColumnPage> {
    COLUMN_PAGES.iter().filter(|page| !is_field(page.column))
}

impl Column {
    /// Its page; field variables of any number have that of the first.
    pub fn page(self) -> Option<&'static ColumnPage> {
        let column = match self {
            Self::FieldVariable(_, part) => Self::FieldVariable(1, part),
            column => column,
        };
        COLUMN_PAGES.iter().find(|page| page.column == column)
    }
}

const ELECTRICAL: &str = "electrical law: all but `conductance`";
const THERMAL: &str = "thermal law: conduction, radiation; tables that depend on the mean temperature";
const PORE: &str = "pore fluid law";
const TABLES: &str = "tables that depend on it";
const USER: &str = "user subroutine GAPELECTR";

/// The columns of node tables, in the order of the documentation.
pub const COLUMN_PAGES: &[ColumnPage] = &[
    page(
        Column::Node,
        &["node"],
        "label of the slave node, passed through; with `time` it groups a history",
        "",
        "histories; GAPELECTR",
        "C-25",
    ),
    page(
        Column::Interaction,
        &["interaction"],
        "the *SURFACE INTERACTION that governs the row; not needed where there is one, or with `--interaction`",
        "",
        "all laws",
        "S-40, S-41",
    ),
    page(
        Column::Time,
        &["time"],
        "total time; rows of one node in ascending time are increments of its history",
        "T",
        "time integrals, heat of transient increments, rate of the clearance",
        "O-5, C-25",
    ),
    page(
        Column::Clearance,
        &["clearance", "copen"],
        "clearance d between the surfaces, above zero when open",
        "L",
        "all laws, for the rows that are open",
        "T-22, J-5, Q-36",
    ),
    page(
        Column::Pressure,
        &["pressure", "cpress"],
        "contact pressure p, above zero in compression",
        "M L⁻¹ T⁻²",
        "all laws, for the rows that are closed",
        "T-22",
    ),
    page(
        Column::Closed,
        &["closed", "cstatus"],
        "1 in contact, 0 apart; without it a row is closed when d ≤ 0 or p ≠ 0",
        "1",
        "all laws",
        "T-22, Q-12",
    ),
    page(
        Column::Temperature(Part::Slave),
        &["temp_s", "nt11_s"],
        "temperature of the slave surface",
        "θ",
        THERMAL,
        "H-06",
    ),
    page(
        Column::Temperature(Part::Master),
        &["temp_m", "nt11_m"],
        "temperature of the master surface",
        "θ",
        THERMAL,
        "H-06",
    ),
    page(
        Column::Temperature(Part::Both),
        &["temp"],
        "mean temperature of both surfaces; it is taken before `temp_s` and `temp_m` where a table depends on the mean",
        "θ",
        TABLES,
        "T-03",
    ),
    page(
        Column::TemperatureJump,
        &["temp_jump"],
        "θ_s − θ_m, where the difference of both would lose its digits, or alone where only it is known",
        "θ",
        "thermal law: conduction, radiation",
        "H-06",
    ),
    page(
        Column::Potential(Part::Slave),
        &["epot_s"],
        "electric potential of the slave surface",
        "φ",
        ELECTRICAL,
        "H-01",
    ),
    page(
        Column::Potential(Part::Master),
        &["epot_m"],
        "electric potential of the master surface",
        "φ",
        ELECTRICAL,
        "H-01",
    ),
    page(Column::Potential(Part::Both), &["epot_jump"], "φ_s − φ_m, instead of both", "φ", ELECTRICAL, "H-01"),
    page(
        Column::PorePressure(Part::Slave),
        &["por_s"],
        "pore pressure at the slave surface",
        "M L⁻¹ T⁻²",
        PORE,
        "P-31",
    ),
    page(
        Column::PorePressure(Part::Master),
        &["por_m"],
        "pore pressure at the master surface",
        "M L⁻¹ T⁻²",
        PORE,
        "P-31",
    ),
    page(
        Column::PorePressure(Part::Both),
        &["por_jump"],
        "p_s − p_m, where the difference of both would lose its digits, or alone where only it is known",
        "M L⁻¹ T⁻²",
        PORE,
        "P-31",
    ),
    page(
        Column::FlowAcross,
        &["q_across"],
        "pore fluid out of the master into the slave surface, where an infinite permeability leaves it to the solution of the equations",
        "L T⁻¹",
        "pore fluid law without a table",
        "P-30",
    ),
    page(
        Column::FieldVariable(1, Part::Slave),
        &["fv1_s"],
        "field variable 1 on the slave surface; `fv2_s` and so on alike",
        "any",
        TABLES,
        "T-03",
    ),
    page(
        Column::FieldVariable(1, Part::Master),
        &["fv1_m"],
        "field variable 1 on the master surface; `fv2_m` and so on alike",
        "any",
        TABLES,
        "T-03",
    ),
    page(
        Column::FieldVariable(1, Part::Both),
        &["fv1"],
        "mean of field variable 1 over both surfaces; `fv2` and so on alike",
        "any",
        TABLES,
        "T-03",
    ),
    page(
        Column::Area,
        &["area", "cnarea"],
        "area of the slave node",
        "L²",
        "outputs that end in `A`, and the totals of an interface",
        "O-1",
    ),
    page(
        Column::ClearanceRate,
        &["clearance_rate"],
        "rate ḋ of the clearance; where a cell is empty it comes from the history, 0 in its first row",
        "L T⁻¹",
        "pore fluid law in a transient",
        "P-12, Q-37, O-5",
    ),
    page(
        Column::CharacteristicLength,
        &["char_length"],
        "characteristic element length, the default of both cutoffs of pore fluid; `--char-length` gives it for all rows",
        "L",
        PORE,
        "P-20, Q-5",
    ),
    page(
        Column::BulkPermeability(Part::Slave),
        &["perm_s"],
        "permeability of the material behind the slave surface, for the shares of gap filling",
        "any, as `perm_m`",
        "pore fluid law in a transient",
        "P-42",
    ),
    page(
        Column::BulkPermeability(Part::Master),
        &["perm_m"],
        "permeability of the material behind the master surface",
        "any, as `perm_s`",
        "pore fluid law in a transient",
        "P-42",
    ),
    page(
        Column::MassFlow(Part::Slave),
        &["mass_flow_s"],
        "mass flow rate per area on the slave side; a side without one stands still",
        "M L⁻² T⁻¹",
        TABLES,
        "K-32",
    ),
    page(
        Column::MassFlow(Part::Master),
        &["mass_flow_m"],
        "mass flow rate per area on the master side",
        "M L⁻² T⁻¹",
        TABLES,
        "K-32",
    ),
    page(
        Column::MassFlow(Part::Both),
        &["mass_flow"],
        "mean of the magnitudes of both mass flow rates",
        "M L⁻² T⁻¹",
        TABLES,
        "K-32",
    ),
    page(Column::Shear, &["shear"], "frictional shear stress τ", "M L⁻¹ T⁻²", "heat of friction", "H-03"),
    page(
        Column::SlipRate,
        &["slip_rate"],
        "rate of relative slip γ̇ along the shear stress",
        "L T⁻¹",
        "heat of friction",
        "H-03",
    ),
    page(
        Column::Coordinate(Direction::X, Part::Slave),
        &["x_s", "coor1_s"],
        "first coordinate of the slave node",
        "L",
        USER,
        "7.1",
    ),
    page(
        Column::Coordinate(Direction::Y, Part::Slave),
        &["y_s", "coor2_s"],
        "second coordinate of the slave node",
        "L",
        USER,
        "7.1",
    ),
    page(
        Column::Coordinate(Direction::Z, Part::Slave),
        &["z_s", "coor3_s"],
        "third coordinate of the slave node",
        "L",
        USER,
        "7.1",
    ),
    page(
        Column::Coordinate(Direction::X, Part::Master),
        &["x_m", "coor1_m"],
        "first coordinate of the point opposite to it",
        "L",
        USER,
        "7.1",
    ),
    page(
        Column::Coordinate(Direction::Y, Part::Master),
        &["y_m", "coor2_m"],
        "second coordinate of the point opposite to it",
        "L",
        USER,
        "7.1",
    ),
    page(
        Column::Coordinate(Direction::Z, Part::Master),
        &["z_m", "coor3_m"],
        "third coordinate of the point opposite to it",
        "L",
        USER,
        "7.1",
    ),
    page(Column::Step, &["step", "kstep"], "number of the step, from 1", "1", USER, "7.1"),
    page(Column::Increment, &["increment", "kinc"], "number of the increment in its step, from 1", "1", USER, "7.1"),
    page(Column::StepTime, &["step_time"], "time since the step began", "T", USER, "7.1"),
    page(
        Column::Source,
        &["source"],
        "where the numbers of the row come from, such as `clearance=COPEN temp_s=NT11`: `inpact nodes` writes it",
        "",
        "nothing",
        "",
    ),
];

const fn page(
    column: Column,
    names: &'static [&'static str],
    meaning: &'static str,
    unit: &'static str,
    read_by: &'static str,
    source: &'static str,
) -> ColumnPage {
    ColumnPage { column, names, meaning, unit, read_by, source }
}
