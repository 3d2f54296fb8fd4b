//! What is measured: the tables in force and, as columns, the coordinates of the rows that reach them.

use crate::commands::scene::Scene;
use crate::failure::Failure;
use inpact_evaluation::law::contact::{Clearance, ContactPressure, ContactState};
use inpact_evaluation::nodes::{Batch, Column, Findings, NodeReader, Part};
use inpact_evaluation::numbers::mean;
use inpact_evaluation::plan::{InteractionPlan, Plan, RowInteractions, Source, TablePlan};
use inpact_evaluation::results::Along;
use inpact_evaluation::table::PiecewiseTable;
use inpact_parser::model::{Interaction, Model, Table};
use std::path::Path;

/// A table with the coordinates of the rows that reach it.
pub(super) struct Subject {
    /// The interaction and what the table is.
    pub(super) name: String,
    /// The table as it is evaluated: folded along the axes on which the scene has one value.
    pub(super) table: PiecewiseTable,
    /// One column an axis; of axes that make no difference the columns are empty.
    pub(super) columns: Vec<Vec<f64>>,
}

/// The rows that are measured on.
pub(super) struct Sample {
    /// The tables that vary and are reached by a row.
    pub(super) subjects: Vec<Subject>,
    /// How many rows the node table has.
    pub(super) rows: u64,
    /// One of so many was taken.
    pub(super) one_of: u64,
}

/// A subject in the making.
struct Gathering<'a> {
    interaction: usize,
    planned: &'a InteractionPlan,
    /// The state that a row must have to reach the table.
    state: Option<ContactState>,
    /// Where the coordinate of each axis comes from; `None` where it makes no difference.
    axes: Vec<Option<Coordinate>>,
    subject: Subject,
}

/// Where the coordinate of an axis comes from, in places of a batch.
#[derive(Clone, Copy)]
enum Coordinate {
    /// Overclosure counts as zero clearance (J-5).
    Clearance(usize),
    Pressure(usize),
    /// Zero while open (P-34).
    PressureOfPores(Option<usize>),
    Variable(Source<usize>),
}

impl Subject {
    /// How many rows reach it.
    pub(super) fn rows(&self) -> usize {
        self.columns.iter().map(Vec::len).max().unwrap_or(0)
    }

    /// How many axes make a difference.
    pub(super) fn axes(&self) -> usize {
        self.columns.iter().filter(|column| !column.is_empty()).count()
    }
}

/// Reads the node table and keeps, of at most `most` rows, the coordinates that tables in force are read at.
pub(super) fn gather(
    scene: &mut Scene,
    nodes_path: &Path,
    most: u64,
    findings: &mut Findings,
) -> Result<Sample, Failure> {
    let Scene { model, plan, nodes, .. } = scene;
    let mut gatherings: Vec<Gathering<'_>> =
        plan.interactions.iter().flat_map(|interaction| gatherings(model, plan, interaction)).collect();
    let one_of = plan.rows.div_ceil(most).max(1);
    let unreadable = |error| Failure::read(nodes_path, error);
    let mut reader = NodeReader::open(nodes.reader(nodes_path)?, findings).map_err(unreadable)?;
    reader.select(&plan.selection);
    let mut interactions = RowInteractions::new(model, plan.governed_by, plan.selection.label(Column::Interaction));
    let mut batch = Batch::default();
    while reader.read_batch(&mut batch, findings).map_err(unreadable)? {
        for row in (0..batch.rows).filter(|row| (batch.first_row + *row as u64).is_multiple_of(one_of)) {
            let Some(interaction) = interactions.of_row(&batch, row) else { continue };
            for gathering in gatherings.iter_mut().filter(|gathering| gathering.interaction == interaction) {
                gathering.take(plan, &batch, row);
            }
        }
    }
    let subjects = gatherings.into_iter().map(|gathering| gathering.subject).filter(|subject| subject.rows() > 0);
    Ok(Sample { subjects: subjects.collect(), rows: plan.rows, one_of })
}

/// The tables of an interaction that vary, before any row.
fn gatherings<'a>(model: &Model, plan: &Plan, planned: &'a InteractionPlan) -> Vec<Gathering<'a>> {
    let Some((_, interaction)) = model.interactions.get_index(planned.index) else { return Vec::new() };
    let mut gatherings = Vec::new();
    let mut add = |table: &TablePlan, what: &str, state, variables: &[Option<Source<Column>>]| {
        let Some(compiled) = compiled(interaction, table) else { return };
        let place = |column| plan.selection.number(column).unwrap_or_default();
        let place_of = |column: Option<Column>| column.and_then(|column| plan.selection.number(column));
        let is_pore = what == "permeability";
        let coordinate = |axis: usize, along: Along| match along {
            Along::Clearance => place_of(planned.contact.clearance).map(Coordinate::Clearance),
            Along::Pressure if is_pore => Some(Coordinate::PressureOfPores(place_of(planned.contact.pressure))),
            Along::Pressure => place_of(planned.contact.pressure).map(Coordinate::Pressure),
            Along::PorePressure => {
                let sides = [Part::Slave, Part::Master].map(Column::PorePressure).map(place);
                Some(Coordinate::Variable(Source::Sides(sides[0], sides[1])))
            }
            // Of no table that is measured.
            Along::MassFlow => None,
            Along::Temperature | Along::FieldVariable(_) => {
                let source = variables.get(axis.checked_sub(if is_pore { 2 } else { 1 })?)?.as_ref()?;
                Some(Coordinate::Variable(source.map(place)))
            }
        };
        let of_axis = |(axis, summary): (usize, &inpact_evaluation::table::AxisSummary)| {
            let along = table.axes.get(axis)?.along;
            coordinate(axis, along).filter(|_| summary.matters())
        };
        let axes: Vec<_> = compiled.axes().iter().enumerate().map(of_axis).collect();
        if axes.iter().all(Option::is_none) {
            return;
        }
        gatherings.push(Gathering {
            interaction: planned.index,
            planned,
            state,
            subject: Subject {
                name: format!("{}: {what}", planned.name),
                table: compiled,
                columns: vec![Vec::new(); axes.len()],
            },
            axes,
        });
    };
    if let Some(law) = &planned.electrical {
        let option = interaction.gap_electrical_conductance.as_ref();
        let has_both = option.is_some_and(|option| option.clearance.is_some() && option.pressure.is_some());
        for table in &law.tables {
            let (what, state) = match table.against {
                Along::Clearance => ("conductance against clearance", has_both.then_some(ContactState::Open)),
                _ => ("conductance against pressure", Some(ContactState::Closed)),
            };
            add(table, what, state, &law.variables);
        }
    }
    if let Some(law) = &planned.pore
        && let Some(table) = &law.table
    {
        add(table, "permeability", None, &law.variables);
    }
    gatherings
}

/// A planned table, folded as the plan says.
fn compiled(interaction: &Interaction, planned: &TablePlan) -> Option<PiecewiseTable> {
    let electrical = interaction.gap_electrical_conductance.as_ref();
    let permeability = || interaction.contact_permeability.as_ref()?.table.as_ref();
    let is_pore = planned.axes.get(1).is_some_and(|axis| axis.along == Along::PorePressure);
    let table: &Table = match planned.against {
        Along::Clearance => electrical?.clearance.as_ref()?,
        _ if is_pore => permeability()?,
        _ => electrical.and_then(|option| option.pressure.as_ref()).or_else(permeability)?,
    };
    let mut table = PiecewiseTable::from_rows(&table.values, table.width(), planned.tail).ok()?;
    for (axis, of) in planned.axes.iter().enumerate().rev() {
        if let Some(at) = of.fold {
            table = table.folded(axis, at).ok()?;
        }
    }
    Some(table)
}

impl Gathering<'_> {
    /// Takes the coordinates of a row, if it reaches the table and has them all.
    fn take(&mut self, plan: &Plan, batch: &Batch, row: usize) {
        let state = contact_state(plan, self.planned, batch, row);
        if state.is_none() || (self.state.is_some() && state != self.state) {
            return;
        }
        let number = |place: usize| batch.numbers[place].get(row).filter(|number| !number.is_nan());
        let mut coordinates = [0.0; 64];
        for (axis, coordinate) in self.axes.iter().enumerate().take(coordinates.len()) {
            let Some(coordinate) = coordinate else { continue };
            let found = match *coordinate {
                Coordinate::Clearance(place) => number(place).map(|clearance| clearance.max(0.0)),
                Coordinate::Pressure(place) => number(place),
                Coordinate::PressureOfPores(_) if state == Some(ContactState::Open) => Some(0.0),
                Coordinate::PressureOfPores(place) => place.and_then(number),
                Coordinate::Variable(Source::Cell(cell)) => number(cell),
                Coordinate::Variable(Source::Sides(slave, master)) => sides(number(slave), number(master)),
                Coordinate::Variable(Source::CellOrSides(cell, slave, master)) => {
                    number(cell).or_else(|| sides(number(slave), number(master)))
                }
            };
            let Some(found) = found else { return };
            coordinates[axis] = found;
        }
        for (axis, column) in self.subject.columns.iter_mut().enumerate() {
            if self.axes[axis].is_some() {
                column.push(coordinates[axis]);
            }
        }
    }
}

fn sides(slave: Option<f64>, master: Option<f64>) -> Option<f64> {
    Some(mean(slave?, master?))
}

/// Closed or open, as the plan tells it (T-22).
fn contact_state(plan: &Plan, planned: &InteractionPlan, batch: &Batch, row: usize) -> Option<ContactState> {
    let contact = planned.contact;
    if contact.state.is_some() {
        return contact.state;
    }
    let number = |column: Option<Column>| batch.numbers[plan.selection.number(column?)?].get(row);
    if let Some(closed) = number(contact.closed) {
        return Some(if closed == 0.0 { ContactState::Open } else { ContactState::Closed });
    }
    let pressure = number(contact.pressure);
    // Without a clearance, pressure alone tells that a row is closed.
    let clearance = number(contact.clearance).or_else(|| pressure.filter(|pressure| *pressure != 0.0))?;
    let state =
        ContactState::from_clearance_and_pressure(Clearance(clearance), ContactPressure(pressure.unwrap_or(0.0)));
    (state != ContactState::Undetermined).then_some(state)
}
