//! The columns of a node table.

/// Quantities in columns of a node table.
///
/// Its [`Display`](std::fmt::Display) form is its canonical name; [`Column::named`] accepts aliases.
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

/// The side of the interface of a quantity.
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
    /// Whether its cells are texts that are passed through unchanged.
    pub fn is_key(self) -> bool {
        matches!(self, Self::Node | Self::Interaction | Self::Time)
    }
}
