//! The columns of a node table and the names they go by.

use super::contract::plain_columns;
use inpact_parser::grammar::nearest_names;
use std::fmt;

/// Quantities in columns of a node table.
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
    /// `source`: where the numbers of the row come from, for a person.
    Source,
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

/// The three coordinates of a side that has them.
pub(crate) fn coordinates(part: Part) -> [Column; 3] {
    [Direction::X, Direction::Y, Direction::Z].map(|direction| Column::Coordinate(direction, part))
}

impl Column {
    /// The column that a header names, blanks around it and case aside; `None` for a name the contract does not have.
    pub fn named(header: &str) -> Option<Self> {
        let name = header.trim().to_ascii_lowercase();
        let listed = plain_columns().find(|page| page.names.contains(&name.as_str()));
        listed.map(|page| page.column).or_else(|| field_variable(&name))
    }

    /// The column whose name is so near to a header's that it may be meant; `None` for a header that names one, and where none is near.
    pub fn near(header: &str) -> Option<Self> {
        if Self::named(header).is_some() {
            return None;
        }
        let name = header.trim().to_ascii_lowercase();
        // A field variable has the number that the header has.
        let digits: String = name.chars().filter(char::is_ascii_digit).collect();
        let number = digits.parse().ok().filter(|_| name.starts_with("fv") && !digits.starts_with('0'));
        let parts = [Part::Both, Part::Slave, Part::Master];
        let fields = number.map(|number| parts.map(|part| Self::FieldVariable(number, part).to_string()));
        let names = plain_columns().flat_map(|page| page.names).copied();
        let names: Vec<&str> = names.chain(fields.iter().flatten().map(String::as_str)).collect();
        // What differs by underscores and blanks only is nearest of all.
        let plain = |name: &str| name.chars().filter(|character| character.is_alphanumeric()).collect::<String>();
        let alike = names.iter().copied().find(|known| plain(known) == plain(&name));
        Self::named(alike.or_else(|| nearest_names(name.as_bytes(), names, 1).first().copied())?)
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
        let listed = plain_columns().find(|page| page.column == *self);
        formatter.write_str(listed.map_or("", |page| page.names[0]))
    }
}

#[cfg(test)]
mod tests {
    use super::super::contract::COLUMN_PAGES;
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
        for page in COLUMN_PAGES {
            assert_eq!(page.column.to_string(), page.names[0]);
            assert!(page.names.iter().all(|name| Column::named(name) == Some(page.column)));
            assert_eq!(page.column.page(), Some(page));
        }
    }

    #[test]
    fn a_misspelt_name_is_near_to_what_is_meant() {
        let near = |header| Column::near(header).map(|column| column.to_string());
        for (header, meant) in [
            ("clearence_rate", "clearance_rate"),
            ("perm_slave", "perm_s"),
            ("perm_master", "perm_m"),
            ("presure", "pressure"),
            ("tmep_s", "temp_s"),
            ("fv3s", "fv3_s"),
            ("FV_12", "fv12"),
            ("epotjump", "epot_jump"),
        ] {
            assert_eq!(near(header).as_deref(), Some(meant), "{header}");
        }
        for header in ["clearance", "fv2_m", "", "stress_xx", "u1", "displacement"] {
            assert_eq!(near(header), None, "{header}");
        }
    }
}
