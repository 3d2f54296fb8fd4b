//! The columns of a node table and the names they go by.

use std::fmt;

/// What a column of a node table holds.
///
/// Its [`Display`](fmt::Display) form is its canonical name; [`Column::named`] knows the others.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Column {
    /// `node`: a label, passed through; with `time` it groups a history.
    Node,
    /// `interaction`: the *SURFACE INTERACTION that governs the row.
    Interaction,
    /// `time`: total time, T.
    Time,
    /// `clearance`, `copen`: clearance d, open > 0, L.
    Clearance,
    /// `pressure`, `cpress`: contact pressure p, F L⁻².
    Pressure,
    /// `closed`, `cstatus`: 1 in contact, 0 apart.
    Closed,
    /// `temp_s`, `nt11_s`; `temp_m`, `nt11_m`; `temp`: temperature, θ.
    Temperature(Part),
    /// `epot_s`; `epot_m`; `epot_jump`, φ_s − φ_m: electric potential, φ.
    Potential(Part),
    /// `temp_jump`, θ_s − θ_m: the difference of the temperatures, where both together would lose its digits, θ.
    TemperatureJump,
    /// `por_s`; `por_m`; `por_jump`, p_s − p_m: pore pressure, F L⁻².
    PorePressure(Part),
    /// `q_across`: pore fluid out of the master into the slave surface, where an infinite permeability leaves it to the solution of the equations, L T⁻¹.
    FlowAcross,
    /// `fvN_s`; `fvN_m`; `fvN`: field variable N, from 1.
    FieldVariable(u32, Part),
    /// `area`, `cnarea`: area of the slave node, L².
    Area,
    /// `clearance_rate`: ḋ, L T⁻¹.
    ClearanceRate,
    /// `char_length`: characteristic element length, the default of both cutoffs of pore fluid flow, L.
    CharacteristicLength,
    /// `perm_s`; `perm_m`: bulk permeability, for the shares of gap filling.
    BulkPermeability(Part),
    /// `x_s`, `y_s`, `z_s`, `x_m`, …, and `coor1_s` …: coordinates of the slave node and of the point opposite to it, for user subroutines, L.
    Coordinate(Direction, Part),
    /// `step`, `kstep`: the number of the step, for user subroutines.
    Step,
    /// `increment`, `kinc`: the number of the increment in its step, for user subroutines.
    Increment,
    /// `step_time`: time since the step began, for user subroutines, T.
    StepTime,
    /// `mass_flow_s`; `mass_flow_m`; `mass_flow`, the mean of their magnitudes: mass flow rate per area, M L⁻² T⁻¹.
    MassFlow(Part),
    /// `shear`: frictional shear stress τ, F L⁻².
    Shear,
    /// `slip_rate`: rate of relative slip γ̇ along the shear stress, L T⁻¹.
    SlipRate,
}

/// Along which axis of the global system a coordinate is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Direction {
    /// The first.
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

/// Of which side of the interface a quantity is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Part {
    /// Slave (secondary) side, `_s`.
    Slave,
    /// Master (main) side, `_m`.
    Master,
    /// Both sides together: their average, or for potentials and pore pressures the jump from master to slave.
    Both,
}

/// The columns without a number, each by its canonical name first.
const NAMES: &[(Column, &[&str])] = &[
    (Column::Node, &["node"]),
    (Column::Interaction, &["interaction"]),
    (Column::Time, &["time"]),
    (Column::Clearance, &["clearance", "copen"]),
    (Column::Pressure, &["pressure", "cpress"]),
    (Column::Closed, &["closed", "cstatus"]),
    (Column::Temperature(Part::Slave), &["temp_s", "nt11_s"]),
    (Column::Temperature(Part::Master), &["temp_m", "nt11_m"]),
    (Column::Temperature(Part::Both), &["temp"]),
    (Column::Potential(Part::Slave), &["epot_s"]),
    (Column::Potential(Part::Master), &["epot_m"]),
    (Column::Potential(Part::Both), &["epot_jump"]),
    (Column::PorePressure(Part::Slave), &["por_s"]),
    (Column::PorePressure(Part::Master), &["por_m"]),
    (Column::PorePressure(Part::Both), &["por_jump"]),
    (Column::TemperatureJump, &["temp_jump"]),
    (Column::FlowAcross, &["q_across"]),
    (Column::Area, &["area", "cnarea"]),
    (Column::ClearanceRate, &["clearance_rate"]),
    (Column::CharacteristicLength, &["char_length"]),
    (Column::BulkPermeability(Part::Slave), &["perm_s"]),
    (Column::BulkPermeability(Part::Master), &["perm_m"]),
    (Column::MassFlow(Part::Slave), &["mass_flow_s"]),
    (Column::MassFlow(Part::Master), &["mass_flow_m"]),
    (Column::MassFlow(Part::Both), &["mass_flow"]),
    (Column::Shear, &["shear"]),
    (Column::SlipRate, &["slip_rate"]),
    (Column::Coordinate(Direction::X, Part::Slave), &["x_s", "coor1_s"]),
    (Column::Coordinate(Direction::Y, Part::Slave), &["y_s", "coor2_s"]),
    (Column::Coordinate(Direction::Z, Part::Slave), &["z_s", "coor3_s"]),
    (Column::Coordinate(Direction::X, Part::Master), &["x_m", "coor1_m"]),
    (Column::Coordinate(Direction::Y, Part::Master), &["y_m", "coor2_m"]),
    (Column::Coordinate(Direction::Z, Part::Master), &["z_m", "coor3_m"]),
    (Column::Step, &["step", "kstep"]),
    (Column::Increment, &["increment", "kinc"]),
    (Column::StepTime, &["step_time"]),
];

/// The three coordinates of a side that has them.
pub(crate) fn coordinates(part: Part) -> [Column; 3] {
    [Direction::X, Direction::Y, Direction::Z].map(|direction| Column::Coordinate(direction, part))
}

impl Column {
    /// The column that a header names, blanks around it and case aside; `None` for a name the contract does not have.
    pub fn named(header: &str) -> Option<Self> {
        let name = header.trim().to_ascii_lowercase();
        let listed = NAMES.iter().find(|(_, names)| names.contains(&name.as_str()));
        listed.map(|(column, _)| *column).or_else(|| field_variable(&name))
    }

    /// Whether its cells are texts that are passed through as they stand.
    pub fn is_key(self) -> bool {
        matches!(self, Self::Node | Self::Interaction | Self::Time)
    }
}

/// `fv1`, `fv1_s`, `fv1_m`, …; numbers are written without leading zeros, so that a column has one name.
fn field_variable(name: &str) -> Option<Column> {
    let rest = name.strip_prefix("fv")?;
    let (digits, part) = match (rest.strip_suffix("_s"), rest.strip_suffix("_m")) {
        (Some(digits), _) => (digits, Part::Slave),
        (_, Some(digits)) => (digits, Part::Master),
        _ => (rest, Part::Both),
    };
    let is_number = digits.bytes().all(|digit| digit.is_ascii_digit()) && !digits.starts_with('0');
    Some(Column::FieldVariable(digits.parse().ok().filter(|_| is_number)?, part))
}

impl fmt::Display for Column {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Self::FieldVariable(number, part) = self {
            let suffix = match part {
                Part::Slave => "_s",
                Part::Master => "_m",
                Part::Both => "",
            };
            return write!(formatter, "fv{number}{suffix}");
        }
        let listed = NAMES.iter().find(|(column, _)| column == self);
        formatter.write_str(listed.map_or("", |(_, names)| names[0]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_aliases_are_found_in_any_case() {
        let found = |name| Column::named(name).map(|column| column.to_string());
        assert_eq!(found(" COPEN ").as_deref(), Some("clearance"));
        assert_eq!(found("CPress").as_deref(), Some("pressure"));
        assert_eq!(found("NT11_M").as_deref(), Some("temp_m"));
        assert_eq!(found("CNAREA").as_deref(), Some("area"));
        assert_eq!(found("Fv12_S").as_deref(), Some("fv12_s"));
        for unknown in ["fv", "fv0", "fv01", "fv1_x", "fv+1", "fv-1", "fv1_s_m", "por", "nt11", ""] {
            assert_eq!(found(unknown), None, "{unknown}");
        }
    }

    #[test]
    fn every_column_is_found_by_each_of_its_names() {
        for (column, names) in NAMES {
            assert_eq!(column.to_string(), names[0]);
            assert!(names.iter().all(|name| Column::named(name) == Some(*column)));
        }
    }
}
