//! The points at which the tables of a plan are read: for each table in force, the coordinates of the rows that reach it.
//!
//! They are the points an evaluation would read it at, kept for whoever measures tables on a user's own rows.
//! View factors of radiation and the curves of CalculiX are not among them: they are evaluated in one form only.

use super::{Row, thermal};
use crate::compile::{CompiledPore, Laws, MASS_FLOW, Needs};
use crate::law::contact::ContactState;
use crate::nodes::Batch;
use crate::numbers::mean;
use crate::plan::{Plan, RowInteractions};
use crate::results::Along;
use crate::table::PiecewiseTable;
use inpact_parser::model::Model;

/// A table in force and the points it is read at.
#[derive(Debug, Clone)]
pub struct TableReads {
    /// The place of its interaction in the model.
    pub interaction: usize,
    /// What it gives.
    pub quantity: TabulatedQuantity,
    /// The first of its variables.
    pub against: Along,
    /// The table as it is evaluated: folded along the axes on which the scene has one value.
    pub table: PiecewiseTable,
    /// The coordinates, one column an axis; empty for axes that make no difference.
    pub columns: Vec<Vec<f64>>,
}

/// What a table gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum TabulatedQuantity {
    /// Electrical conductance, C T⁻¹ L⁻² φ⁻¹.
    ElectricalConductance,
    /// Thermal conductance, M T⁻³ θ⁻¹.
    ThermalConductance,
    /// Permeability of the interface to pore fluid.
    Permeability,
}

/// Coordinates in the making.
#[derive(Debug)]
pub struct Coordinates<'a> {
    laws: &'a Laws,
    interactions: RowInteractions<'a>,
    reads: Vec<TableReads>,
}

impl<'a> Coordinates<'a> {
    /// Begins with no row; the laws are compiled from this model and plan.
    pub fn new(model: &'a Model, plan: &Plan, laws: &'a Laws) -> Self {
        let interactions = RowInteractions::new(model, plan.governed_by, laws.interaction);
        Self { laws, interactions, reads: Vec::new() }
    }

    /// Takes a row of a batch: for each table it reaches its coordinates, if it has them all.
    pub fn take(&mut self, batch: &Batch, index: usize) {
        let Some(interaction) = self.interactions.of_row(batch, index) else { return };
        let Some(laws) = &self.laws.interactions[interaction] else { return };
        let Some(state) = laws.contact.state(batch, index) else { return };
        let row = Row::new(batch, index, state, laws.contact, None);
        if let Some(law) = laws.conductance_tables()
            && let Some((against, needs)) = law.needs(state)
            && let Some(form) = if against == Along::Pressure { &law.pressure_form } else { &law.clearance_form }
        {
            let variable = |index: usize| row.fetch(law.variables.get(index)?.as_ref()?, mean);
            let of = (interaction, TabulatedQuantity::ElectricalConductance, against);
            self.keep(of, form.table(), needs, of_contact(row, against), variable);
        }
        if let Some(law) = laws.thermal.as_ref().and_then(|law| law.conduction.as_ref())
            && let Some((against, needs)) = law.needs(state)
            && let Some(form) = law.form(against)
        {
            let variable = |index: usize| match (index, law.mass_flow) {
                (MASS_FLOW, Some(source)) => thermal::mass_flow(source, row),
                _ => row.fetch(law.variables.get(index)?.as_ref()?, mean),
            };
            let of = (interaction, TabulatedQuantity::ThermalConductance, against);
            self.keep(of, form.table(), needs, of_contact(row, against), variable);
        }
        if let Some(law) = &laws.pore
            && let Some(form) = &law.form
        {
            // While open the table is read at zero pressure (P-34).
            let pressure = if state == ContactState::Open { Some(0.0) } else { row.pressure };
            let variable = |index: usize| pore_variable(law, row, index);
            let of = (interaction, TabulatedQuantity::Permeability, Along::Pressure);
            self.keep(of, form.table(), &law.needs, pressure, variable);
        }
    }

    /// The tables that vary and that a row has reached, in the order of the model.
    pub fn finish(mut self) -> Vec<TableReads> {
        self.reads.sort_by_key(|reads| (reads.interaction, reads.quantity, reads.against == Along::Pressure));
        self.reads
    }

    fn keep(
        &mut self,
        (interaction, quantity, against): (usize, TabulatedQuantity, Along),
        table: &PiecewiseTable,
        needs: &Needs,
        abscissa: Option<f64>,
        variable: impl Fn(usize) -> Option<f64>,
    ) {
        let first = needs.abscissa.then_some((0, abscissa));
        let others = needs.variables.iter().map(|&index| (index + 1, variable(index)));
        let point = first.into_iter().chain(others).map(|(axis, found)| Some((axis, found.filter(|x| !x.is_nan())?)));
        let Some(point) = point.collect::<Option<Vec<(usize, f64)>>>().filter(|point| !point.is_empty()) else {
            return;
        };
        let is_same = |reads: &&mut TableReads| {
            (reads.interaction, reads.quantity, reads.against) == (interaction, quantity, against)
        };
        let columns = if let Some(reads) = self.reads.iter_mut().find(is_same) {
            &mut reads.columns
        } else {
            let columns = vec![Vec::new(); table.axes().len()];
            self.reads.push(TableReads { interaction, quantity, against, table: table.clone(), columns });
            let last = self.reads.len() - 1;
            &mut self.reads[last].columns
        };
        for (axis, coordinate) in point {
            columns[axis].push(coordinate);
        }
    }
}

/// The first coordinate of a conductance table.
fn of_contact(row: Row<'_>, against: Along) -> Option<f64> {
    match against {
        Along::Pressure => row.pressure,
        _ => row.state.table_clearance(row.clearance),
    }
}

/// Of a permeability, variable 0 is the mean pore pressure.
fn pore_variable(law: &CompiledPore, row: Row<'_>, index: usize) -> Option<f64> {
    match index.checked_sub(1) {
        None => law.pressures.and_then(|(slave, master)| Some(mean(row.number(slave)?, row.number(master)?))),
        Some(index) => row.fetch(law.variables.get(index)?.as_ref()?, mean),
    }
}
