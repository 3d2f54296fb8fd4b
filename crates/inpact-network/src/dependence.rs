//! Dependence of the laws of a row: the quantities that a scene must give, and the fields that a law couples.

use crate::scene::Field;
use inpact_evaluation::law::{Branch, ContactState, ElectricalSource, InterfaceLaws, Permeability, ThermalConductance};
use inpact_evaluation::table::{AxisSummary, PiecewiseTable};

/// The variables without which a row's law has no value.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Dependence {
    pub(crate) clearance: bool,
    pub(crate) pressure: bool,
    pub(crate) temperature: bool,
    pub(crate) mass_flow: bool,
    pub(crate) pore_pressure: bool,
    /// Field variables by their number, from 1.
    pub(crate) fields: Vec<usize>,
}

/// The dependence of the electrical conductance of a row.
pub(crate) fn dependence_of_electrical(source: &ElectricalSource, state: ContactState) -> Dependence {
    match source {
        ElectricalSource::User(..) => Dependence { clearance: true, temperature: true, ..Dependence::default() },
        ElectricalSource::Tables(tables) => {
            let mut dependence = Dependence::default();
            let branch = tables.branch_in(state);
            if let Some((branch, table)) = branch {
                dependence.first(branch == Branch::Pressure, table);
                dependence.temperature = matters(table, 1);
                dependence.fields = fields(table, 2);
            }
            dependence
        }
    }
}

/// The dependence of the thermal conductance of a row.
pub(crate) fn dependence_of_thermal(laws: &InterfaceLaws, state: ContactState) -> Dependence {
    let mut dependence = Dependence::default();
    match &laws.thermal {
        Some(ThermalConductance::Tables(tables)) => {
            if let Some((branch, table)) = tables.branch_in(state) {
                dependence.first(branch == Branch::Pressure, table);
                dependence.temperature = matters(table, 1);
                dependence.mass_flow = matters(table, 2);
                dependence.fields = fields(table, 3);
            }
        }
        Some(ThermalConductance::Calculix(curves)) if state == ContactState::Closed => {
            dependence.pressure = matters(curves.rows(), 0);
            dependence.temperature = curves.depends_on_temperature();
        }
        _ => {}
    }
    if let Some(law) = &laws.radiation {
        dependence.temperature = true;
        dependence.clearance |= matters(&law.view_factor, 0) && state == ContactState::Open;
    }
    dependence
}

/// The dependence of the permeability of a row.
pub(crate) fn dependence_of_pore(laws: &InterfaceLaws, state: ContactState) -> Dependence {
    let mut dependence = Dependence { clearance: state != ContactState::Closed, ..Dependence::default() };
    let law = laws.pore.as_ref().map(|law| &law.permeability);
    if let Some(Permeability::Finite(table)) = law {
        dependence.clearance = true;
        dependence.pressure = matters(table, 0) && state == ContactState::Closed;
        dependence.pore_pressure = matters(table, 1);
        dependence.temperature = matters(table, 2);
        dependence.fields = fields(table, 3);
    }
    dependence
}

/// The range of temperatures, or pore pressures, over which the table of a row's law varies with its unknown; `None` where it does not.
pub(crate) fn range_of_unknown(laws: &InterfaceLaws, field: Field, state: ContactState) -> Option<[f64; 2]> {
    let table = match field {
        Field::Potential => match laws.electrical.as_ref()? {
            ElectricalSource::Tables(tables) => tables.branch_in(state)?.1,
            ElectricalSource::User(..) => return None,
        },
        Field::Temperature => match laws.thermal.as_ref()? {
            ThermalConductance::Tables(tables) => tables.branch_in(state)?.1,
            ThermalConductance::Calculix(curves) => curves.rows(),
        },
        Field::PorePressure => match &laws.pore.as_ref()?.permeability {
            Permeability::Finite(table) => table,
            Permeability::Infinite => return None,
        },
    };
    let axis = table.axes().get(1).filter(|axis| axis.matters())?;
    Some([axis.least, axis.greatest])
}

impl Dependence {
    /// The union of both dependences.
    pub(crate) fn or(mut self, other: Self) -> Self {
        self.clearance |= other.clearance;
        self.pressure |= other.pressure;
        self.temperature |= other.temperature;
        self.mass_flow |= other.mass_flow;
        self.pore_pressure |= other.pore_pressure;
        self.fields.extend(other.fields);
        self.fields.sort_unstable();
        self.fields.dedup();
        self
    }

    fn first(&mut self, is_pressure: bool, table: &PiecewiseTable) {
        *(if is_pressure { &mut self.pressure } else { &mut self.clearance }) = matters(table, 0);
    }
}

fn matters(table: &PiecewiseTable, axis: usize) -> bool {
    table.axes().get(axis).is_some_and(AxisSummary::matters)
}

fn fields(table: &PiecewiseTable, first: usize) -> Vec<usize> {
    (first..table.axis_count()).filter(|&axis| matters(table, axis)).map(|axis| axis + 1 - first).collect()
}
