//! Quantities compared in addition to outputs: clearances and areas of the deformed mesh, heat conducted by the bodies, and sums over a pair.

use super::CompareArguments;
use super::measure::{Quantity, RowsOf};
use crate::commands::evaluable::Evaluable;
use crate::commands::meshed::MeshedDeck;
use crate::commands::picture::Drawn;
use crate::failure::Failure;
use inpact_contact::{ContactQuantity, NodeRows, State, TotalQuantity};
use inpact_evaluation::nodes::Column;
use inpact_evaluation::results::Output;

#[derive(Debug)]
struct PairOfRows {
    /// Its position among those of the mesh.
    index: usize,
    name: String,
    /// Its rows in a state.
    rows: std::ops::Range<usize>,
}

/// Pairs, areas, contact and normals of the rows, from the mesh.
#[derive(Debug, Default)]
pub(super) struct Geometry {
    pairs: Vec<PairOfRows>,
    /// The number of rows of a state.
    rows: usize,
    /// For each row of all states: the area, and whether it is in contact.
    areas: Vec<Option<f64>>,
    closed: Vec<bool>,
    /// The averaged normals of the slave, where the heat flux in bodies is compared.
    normals: Vec<Option<[f64; 3]>>,
}

/// The quantities of node tables that the mesh also gives.
const OF_MESH: [ContactQuantity; 2] = [ContactQuantity::Clearance, ContactQuantity::Area];

impl Geometry {
    /// The geometry as far as the results have values to compare, with clearances and areas beside those of the solver.
    pub(super) fn of(arguments: &CompareArguments, prepared: &Evaluable) -> Result<(Self, Vec<Quantity>), Failure> {
        let nothing = || Ok((Self::default(), Vec::new()));
        let Some(made) = &prepared.made else { return nothing() };
        let drawn = &made.drawn;
        let says_contact = |state: &State| state.contact.iter().any(|field| OF_MESH.contains(&field.quantity));
        let says_heat = drawn.states.iter().any(|state| state.heat_flux.is_some());
        let says_totals = drawn.states.iter().any(|state| !state.totals.is_empty());
        if !says_heat && !says_totals && !drawn.states.iter().any(says_contact) {
            return nothing();
        }
        let settings = arguments.reading.settings(&arguments.deck)?;
        let meshed = MeshedDeck::read(&arguments.deck, &settings)?;
        let mut geometry = Self::default();
        if says_totals {
            geometry.read_pairs(&meshed, drawn)?;
        }
        if says_heat {
            let rows = NodeRows::new(&meshed.mesh, &meshed.read.model, &drawn.states)?;
            for state in &drawn.states {
                geometry.normals.extend(rows.normals(state)?);
            }
        }
        Ok((geometry, of_mesh(&meshed, drawn)?))
    }

    /// The pairs, with the areas and the contact of their rows.
    fn read_pairs(&mut self, meshed: &MeshedDeck, drawn: &Drawn) -> Result<(), Failure> {
        for (row, (index, ..)) in drawn.faces.rows().enumerate() {
            match self.pairs.last_mut() {
                Some(last) if last.index == index => last.rows.end = row + 1,
                _ => {
                    let pair = &meshed.mesh.pairs[index];
                    let name = |surface: usize| meshed.mesh.surfaces[surface].name.written();
                    let name = format!("{} on {}", name(pair.slave), name(pair.master));
                    self.pairs.push(PairOfRows { index, name, rows: row..row + 1 });
                }
            }
        }
        self.rows = drawn.faces.points();
        let mut rows = NodeRows::new(&meshed.mesh, &meshed.read.model, &drawn.states)?;
        let place = |rows: &NodeRows<'_>, column| rows.numbers().iter().position(|other| *other == column);
        let places = [Column::Area, Column::Clearance, Column::Pressure].map(|column| place(&rows, column));
        for batch in rows.batches(&drawn.states) {
            let batch = batch?;
            for row in 0..batch.rows {
                let [area, clearance, pressure] =
                    places.map(|place| place.and_then(|place| batch.numbers[place].get(row)));
                self.areas.push(area);
                let is_closed = |clearance: f64| clearance <= 0.0;
                let is_pressed = |pressure: f64| pressure < 0.0 || 0.0 < pressure;
                self.closed.push(clearance.is_some_and(is_closed) || pressure.is_some_and(is_pressed));
            }
        }
        Ok(())
    }

    /// The heat into the slave surface by the flux in its body: against the outward normal.
    pub(super) fn heat_into_slave(&self, drawn: &Drawn) -> Option<Quantity> {
        if self.normals.is_empty() {
            return None;
        }
        let mut normals = self.normals.iter();
        let of_rows = drawn.states.iter().flat_map(|state| drawn.faces.rows().map(move |(_, node, _)| (state, node)));
        let solvers = of_rows.map(|(state, node)| {
            let normal = (*normals.next()?)?;
            let flux = state.heat_flux.as_ref()?.vectors[node.index()]?;
            Some(-(0..3).map(|k| flux[k] * normal[k]).sum::<f64>())
        });
        let solvers = solvers.collect();
        let source = drawn.states.iter().find_map(|state| state.heat_flux.as_ref()).map(|flux| &flux.source);
        let source = source.map(|source| format!("{source} against the normal of the slave, as taken to its nodes"));
        Some(Quantity { solvers, source: source.unwrap_or_default(), ..Quantity::of_output(Output::TotalHeatSlave) })
    }

    /// Sums over pairs beside those of the solver; `heat` is the flux into slave and master per area, one per row.
    pub(super) fn totals(&self, drawn: &Drawn, heat: [&[Option<f64>]; 2]) -> Vec<Quantity> {
        let [into_slave, into_master] = heat;
        let ones: Vec<Option<f64>> = self.closed.iter().map(|closed| Some(f64::from(u8::from(*closed)))).collect();
        let wanted = [
            (TotalQuantity::ContactArea, "area in contact", "L²", &ones[..]),
            (TotalQuantity::HeatIntoSlave, "heat into slave", "M L² T⁻³", into_slave),
            (TotalQuantity::HeatIntoMaster, "heat into master", "M L² T⁻³", into_master),
        ];
        let mut quantities = Vec::new();
        for (quantity, name, dimension, by_area) in wanted {
            let said =
                || drawn.states.iter().flat_map(|state| &state.totals).filter(|total| total.quantity == quantity);
            let Some(first) = said().next() else { continue };
            let mut compared = Quantity::new(name.to_owned(), dimension, first.source.to_string());
            compared.rows_of = RowsOf::Pairs;
            for (at, state) in drawn.states.iter().enumerate() {
                for pair in &self.pairs {
                    let said = state.totals.iter().find(|total| (total.quantity, total.pair) == (quantity, pair.index));
                    compared.solvers.push(said.map(|total| total.value));
                    let rows = at * self.rows + pair.rows.start..at * self.rows + pair.rows.end;
                    // Unknown where a term is unknown.
                    compared.ours.push(rows.map(|row| Some((*by_area.get(row)?)? * (*self.areas.get(row)?)?)).sum());
                }
            }
            quantities.push(compared);
        }
        quantities
    }

    /// The names of the pairs, for each row of all states, and their times.
    pub(super) fn names_and_times(&self, drawn: &Drawn) -> (Vec<String>, Vec<Option<f64>>) {
        let of_states = drawn.states.iter().flat_map(|state| self.pairs.iter().map(move |pair| (pair, state)));
        of_states.map(|(pair, state)| (pair.name.clone(), state.moment.time)).unzip()
    }
}

/// Clearances and areas of the deformed mesh beside those of the solver.
fn of_mesh(meshed: &MeshedDeck, drawn: &Drawn) -> Result<Vec<Quantity>, Failure> {
    // Without the solver's values the rows have those of the mesh.
    let states: Vec<State> = drawn.states.iter().cloned().map(|state| State { contact: Vec::new(), ..state }).collect();
    let mut rows = NodeRows::new(&meshed.mesh, &meshed.read.model, &states)?;
    let fields =
        |kind| drawn.states.iter().flat_map(|state| &state.contact).filter(move |field| field.quantity == kind);
    let mut quantities = Vec::new();
    let mut places = Vec::new();
    for kind in OF_MESH {
        let Some(field) = fields(kind).next() else { continue };
        let column = kind.column();
        let dimension = column.page().map_or("", |page| page.unit);
        let mut quantity = Quantity::new(column.to_string(), dimension, field.source.to_string());
        quantity.solvers = drawn.rows(|state, pair, node| state.contact(kind, pair, node).map(|(value, _)| value));
        quantities.push(quantity);
        places.push(rows.numbers().iter().position(|other| *other == column));
    }
    for batch in rows.batches(&states) {
        let batch = batch?;
        for row in 0..batch.rows {
            for (quantity, place) in quantities.iter_mut().zip(&places) {
                quantity.ours.push(place.and_then(|place| batch.numbers[place].get(row)));
            }
        }
    }
    Ok(quantities)
}
