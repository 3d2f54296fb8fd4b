//! Newton's iteration for fields whose conductances depend on what is sought.
//!
//! Unknowns are the relative ones of each field (`linear/relative.rs`), so that the blocks of single fields are the well-scaled matrices of the linear solver;
//! beside them stand the slopes of section 8 of the semantics, which make the whole unsymmetric (J-2):
//!
//! - of a flow q = g Δ the slopes ½ g' Δ along the temperatures of both sides, ∂σ/∂θ̄ among them, and what radiation adds;
//! - of the heat of a current ∂q_g/∂Δφ and ∂q_g/∂θ̄.
//!
//! A step is taken as far as it lessens what is missing in the balances (line search by halves). Tables are piecewise linear: at a knot the slope is that of the right-hand side,
//! and a step that overshoots a knot is cut short or, where no step lessens anything, replaced by one with the conductances held, which needs no slope.
//! What the iteration ends with is a state whose conductances are right to rounding; the linear solver then finds the flows of these to the last digit.

use crate::assembly::{Capacities, Currents, HeatTerm, RowFault, RowTerms, add_heat, network, row_terms, sources};
use crate::knowledge::Knowledge;
use crate::linear::{Balance, Core, Edges, Form, LinearSolution, NONE, Origins, Series, each_part, index};
use crate::problem::FieldNodes;
use crate::scene::Field;
use faer::Col;
use faer::prelude::Solve;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::sparse::{SparseColMat, Triplet};
use inpact_evaluation::numbers::{Wide, exponent_of, scale_by_power};

/// Below that share of its flows a balance is met.
const MET: f64 = 1e-14;

/// Below that share an iteration that gains nothing more has converged: conductances are found in f64.
const GOOD_ENOUGH: f64 = 1e-10;

/// The most steps.
const MOST_STEPS: usize = 60;

/// A step is cut in halves that often before it is given up.
const MOST_HALVES: i32 = 12;

/// What came of an iteration.
#[derive(Debug, Clone)]
pub(crate) struct Iterated {
    /// How many steps were taken.
    pub(crate) steps: usize,
    /// Whether the balances are met.
    pub(crate) has_converged: bool,
    /// The largest share that is missing in a balance of each field, and the place of its node.
    pub(crate) missing: Vec<(f64, u32)>,
}

/// The fields of a stage, set up around a first solution of each.
pub(crate) struct Newton<'a> {
    fields: Vec<System<'a>>,
    kept: Option<Structure>,
}

/// The structure of a factor, good as long as the matrix has entries in the same places.
struct Structure {
    places: Vec<(u32, u32)>,
    symbolic: SymbolicLu<u32>,
}

/// One field.
struct System<'a> {
    field: Field,
    nodes: &'a FieldNodes,
    core: Core,
    origins: Origins,
    edges: Edges,
    jumps: Vec<Wide>,
    /// Where its unknowns begin among those of all fields.
    start: u32,
}

/// A field at some state.
struct Evaluated {
    terms: RowTerms,
    heat: Vec<HeatTerm>,
    balance: Balance,
    /// Flows through links, then rows, of the field.
    flows: Vec<Wide>,
}

impl<'a> Newton<'a> {
    /// Sets up the fields around solutions of linear networks with these rows.
    pub(crate) fn new(
        knowledge: &Knowledge<'a>,
        first: Vec<(Field, LinearSolution, Vec<f64>)>,
        capacities: Capacities,
    ) -> Self {
        let mut fields: Vec<System<'a>> = Vec::new();
        for (field, solution, rows) in first {
            let Some(nodes) = knowledge.problem.field(field) else { continue };
            let start = fields.last().map_or(0, |before| before.start + index(before.edges.form.count()));
            fields.extend(System::new(knowledge, field, nodes, &solution, &rows, capacities, start));
        }
        Self { fields, kept: None }
    }

    /// Iterates; what is known of temperatures and pore pressures follows the state.
    ///
    /// # Errors
    /// A row whose law fails.
    pub(crate) fn iterate(&mut self, knowledge: &mut Knowledge<'a>) -> Result<Iterated, RowFault> {
        let mut states = self.evaluate(knowledge)?;
        let mut best = f64::INFINITY;
        let mut idle = 0;
        for step in 0..=MOST_STEPS {
            let missing: Vec<(f64, u32)> = self.fields.iter().zip(&states).map(|(of, at)| of.worst(at)).collect();
            let worst = missing.iter().fold(0.0, |worst: f64, (share, _)| worst.max(*share));
            if worst < 0.5 * best {
                best = worst;
                idle = 0;
            } else {
                idle += 1;
            }
            let is_met = worst <= MET || (worst <= GOOD_ENOUGH && idle >= 2);
            let has_to_end = step == MOST_STEPS || !worst.is_finite();
            if is_met || has_to_end {
                return Ok(Iterated { steps: step, has_converged: is_met, missing });
            }
            let direction = self.direction(knowledge, &states, Slopes::All);
            let moved = match direction {
                Some(direction) => self.search(knowledge, &direction, &states)?,
                None => None,
            };
            let moved = match moved {
                Some(moved) => Some(moved),
                // Without slopes the step leads to the solution of the conductances as they are now.
                None => match self.direction(knowledge, &states, Slopes::Held) {
                    Some(direction) => self.search(knowledge, &direction, &states)?,
                    None => None,
                },
            };
            match moved {
                Some(moved) => states = moved,
                None => return Ok(Iterated { steps: step, has_converged: worst <= GOOD_ENOUGH, missing }),
            }
        }
        unreachable!("the last pass returns")
    }

    /// Asks the laws and takes the balances at the jumps as they are.
    fn evaluate(&mut self, knowledge: &mut Knowledge<'a>) -> Result<Vec<Evaluated>, RowFault> {
        for system in &self.fields {
            system.tell(knowledge);
        }
        let mut found: Vec<Evaluated> = Vec::new();
        for place in 0..self.fields.len() {
            let system = &mut self.fields[place];
            let terms = row_terms(knowledge, system.field, system.nodes)?;
            let mut sources = sources(knowledge, system.field, system.nodes);
            let mut heat = Vec::new();
            if system.field == Field::Temperature {
                // Potential stands before temperature where both are of one stage.
                let before = found.first().zip(knowledge.problem.field(Field::Potential));
                match before {
                    Some((potential, nodes)) => {
                        let currents = Currents { flows: &potential.flows, rows: &potential.terms };
                        add_heat(knowledge, nodes, currents, system.nodes, &mut sources, Some(&mut heat));
                    }
                    None => sources.iter_mut().zip(&knowledge.heat).for_each(|(sum, heat)| *sum += heat),
                }
            }
            system.set(&terms.conductances, &sources);
            let balance = system.balance();
            let flows = system.flows(&balance);
            found.push(Evaluated { terms, heat, balance, flows });
        }
        Ok(found)
    }

    /// Goes along a direction as far as that lessens what is missing; `None` where no part of it does.
    fn search(
        &mut self,
        knowledge: &mut Knowledge<'a>,
        direction: &[f64],
        states: &[Evaluated],
    ) -> Result<Option<Vec<Evaluated>>, RowFault> {
        let units: Vec<f64> = self.fields.iter().zip(states).map(|(of, at)| of.unit(at)).collect();
        let merit = |systems: &[System<'a>], states: &[Evaluated]| -> f64 {
            let of_field = |((of, at), unit): ((&System<'a>, &Evaluated), &f64)| of.merit(at, *unit);
            systems.iter().zip(states).zip(&units).map(of_field).sum()
        };
        let before = merit(&self.fields, states);
        let start: Vec<Vec<Wide>> = self.fields.iter().map(|system| system.jumps.clone()).collect();
        for halves in 0..=MOST_HALVES {
            let part = 0.5_f64.powi(halves);
            for (system, jumps) in self.fields.iter_mut().zip(&start) {
                system.go(jumps, direction, part);
            }
            let trial = self.evaluate(knowledge)?;
            let after = merit(&self.fields, &trial);
            if after < (1.0 - 1e-4 * part) * before {
                return Ok(Some(trial));
            }
        }
        for (system, jumps) in self.fields.iter_mut().zip(start) {
            system.jumps = jumps;
        }
        self.evaluate(knowledge)?;
        Ok(None)
    }

    /// The step of Newton's: the change of all unknowns, on the scale of the matrix; `None` where the matrix cannot be factored.
    fn direction(&mut self, knowledge: &Knowledge<'a>, states: &[Evaluated], slopes: Slopes) -> Option<Vec<f64>> {
        let count = self.fields.last().map_or(0, |last| last.start as usize + last.edges.form.count());
        let mut entries: Vec<Triplet<u32, u32, f64>> = Vec::new();
        let mut right = Col::<f64>::zeros(count);
        for (system, state) in self.fields.iter().zip(states) {
            let start = system.start;
            each_part(&system.core, &system.edges, |row, column, part| {
                entries.push(Triplet::new(start + row, start + column, part));
                if row != column {
                    entries.push(Triplet::new(start + column, start + row, part));
                }
            });
            let missing = state.balance.missing();
            for (unknown, flow) in (0..).zip(missing) {
                right[(start + unknown) as usize] = scale_by_power(flow, -system.half(unknown));
            }
            if slopes == Slopes::All {
                self.slopes_of_flows(system, state, knowledge, &mut entries);
                self.slopes_of_heat(system, state, knowledge, &mut entries);
            }
        }
        let scale = balance_fields(&self.fields, &mut entries, &mut right);
        let places: Vec<(u32, u32)> = entries.iter().map(|entry| (entry.row, entry.col)).collect();
        let matrix = SparseColMat::<u32, f64>::try_new_from_triplets(count, count, &entries).ok()?;
        let symbolic = match &self.kept {
            Some(kept) if kept.places == places => kept.symbolic.clone(),
            _ => SymbolicLu::try_new(matrix.symbolic()).ok()?,
        };
        let factor = Lu::try_new_with_symbolic(symbolic.clone(), matrix.as_ref()).ok()?;
        self.kept = Some(Structure { places, symbolic });
        factor.solve_in_place(right.as_mat_mut());
        let mut direction: Vec<f64> = right.iter().copied().collect();
        for system in &self.fields {
            let range = system.start as usize..system.start as usize + system.edges.form.count();
            direction[range].iter_mut().for_each(|change| *change *= scale[system.field.index()]);
        }
        direction.iter().all(|change| change.is_finite()).then_some(direction)
    }

    /// What the dependence of conductances adds to the slopes of flows through rows.
    fn slopes_of_flows(
        &self,
        system: &System<'a>,
        state: &Evaluated,
        knowledge: &Knowledge<'_>,
        entries: &mut Vec<Triplet<u32, u32, f64>>,
    ) {
        for (place, &row) in system.nodes.rows.iter().enumerate() {
            let (conducts, of) = (state.terms.slopes[place], knowledge.row(row));
            let flow = system.nodes.links.len() + place;
            let element = system.origins.of_link[flow];
            if element == NONE {
                continue;
            }
            let conductance = state.terms.conductances[place];
            let jump = if conductance > 0.0 {
                (state.flows[flow] / Wide::new(conductance)).to_f64()
            } else {
                system.jump_of_values(of.slave, of.master)
            };
            let common = 0.5 * conducts.along_temperature * jump * of.area;
            let radiation = conducts.radiation_slopes.map(|slope| slope * of.area);
            let of_own = 0.5 * conducts.along_pore_pressure * jump * of.area;
            let mut couple = |other: Field, slopes: [f64; 2]| {
                let Some(other) = self.fields.iter().find(|system| system.field == other) else { return };
                for (node, slope) in [of.slave, of.master].into_iter().zip(slopes) {
                    if slope == 0.0 {
                        continue;
                    }
                    other.on_value(node, |column, factor| {
                        system.on_element(element, |row, sign| {
                            entries.push(Triplet::new(row, column, sign * factor(slope)));
                        });
                    });
                }
            };
            couple(Field::Temperature, [common + radiation[0], common + radiation[1]]);
            couple(Field::PorePressure, [of_own; 2]);
        }
    }

    /// What the heat of currents adds to the equations of temperature.
    fn slopes_of_heat(
        &self,
        system: &System<'a>,
        state: &Evaluated,
        knowledge: &Knowledge<'_>,
        entries: &mut Vec<Triplet<u32, u32, f64>>,
    ) {
        let Some(potential) = self.fields.iter().find(|system| system.field == Field::Potential) else { return };
        for term in &state.heat {
            let element = potential.origins.of_link[term.flow];
            for &(place, share) in &term.nodes {
                system.on_place(place, |row, into| {
                    if element != NONE {
                        potential.on_jump(element, |column, factor| {
                            entries.push(Triplet::new(row, column, -into(factor(share * term.along_jump))));
                        });
                    }
                    let slope = share * term.along_temperatures;
                    let of_row = term.flow.checked_sub(potential.nodes.links.len());
                    if let Some(of_row) = of_row.filter(|_| slope != 0.0) {
                        let of = knowledge.row(potential.nodes.rows[of_row]);
                        for node in [of.slave, of.master] {
                            system.on_value(node, |column, factor| {
                                entries.push(Triplet::new(row, column, -into(factor(slope))));
                            });
                        }
                    }
                });
            }
        }
    }
}

/// Which slopes a step takes into account.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Slopes {
    All,
    /// Conductances and heat are held.
    Held,
}

impl<'a> System<'a> {
    fn new(
        knowledge: &Knowledge<'a>,
        field: Field,
        nodes: &'a FieldNodes,
        solution: &LinearSolution,
        rows: &[f64],
        capacities: Capacities,
        start: u32,
    ) -> Option<Self> {
        let no_sources = vec![0.0; nodes.nodes.len()];
        let network = network(knowledge, field, nodes, rows, &no_sources, capacities);
        let links = nodes.links.len();
        let (mut core, origins) = Core::merged(&network, &|link| link >= links).ok()?;
        // Nodes at which something depends on the state have to stay.
        let mut stays = vec![false; core.free as usize];
        let scene = knowledge.problem.scene;
        let ends = scene.interfaces.iter().flat_map(|of| [of.slave, of.master]);
        let heated = scene.links.iter().filter(|link| link.joule_heat_fraction > 0.0).flat_map(|link| link.nodes);
        for node in ends.chain(heated) {
            let place = nodes.place[node as usize];
            if place != NONE
                && let Some(stays) = stays.get_mut(origins.number[place as usize] as usize)
            {
                *stays = true;
            }
        }
        let sources = super::assembly::sources(knowledge, field, nodes);
        for (place, source) in sources.iter().enumerate() {
            if let Some(stays) = stays.get_mut(origins.number[place] as usize) {
                *stays |= *source != 0.0;
            }
        }
        let series = Series::take_out(&mut core, &|node| stays[node as usize]);
        let form = Form::choose(&core, &series.is_there, &series.is_free);
        let edges = Edges::new(&core, form, &series.is_there);
        let mut system = Self { field, nodes, core, origins, edges, jumps: Vec::new(), start };
        system.jumps = system.jumps_of(solution, rows, &network);
        Some(system)
    }

    /// The jumps along the forest of a solution: of the flows where a conductance tells, otherwise of the values.
    fn jumps_of(&self, solution: &LinearSolution, rows: &[f64], network: &crate::linear::LinearNetwork) -> Vec<Wide> {
        let mut jump_of_element = vec![None; self.core.elements.len()];
        let links = self.nodes.links.len();
        for (link, &element) in self.origins.of_link.iter().enumerate().filter(|(_, element)| **element != NONE) {
            let conductance = link.checked_sub(links).map_or(network.links[link].conductance, |row| rows[row]);
            if conductance > 0.0 {
                jump_of_element[element as usize] = Some(solution.flows[link] / Wide::new(conductance));
            }
        }
        let mut value_of_number = vec![Wide::ZERO; self.core.free as usize];
        for (&number, &value) in self.origins.number.iter().zip(&solution.values) {
            if let Some(place) = value_of_number.get_mut(number as usize) {
                *place = value;
            }
        }
        let value = |number: u32| self.core.value(&value_of_number, number);
        let form = &self.edges.form;
        let jump = |unknown: u32| {
            let number = form.hangs_by[unknown as usize];
            let element = self.core.elements[number as usize];
            let along =
                jump_of_element[number as usize].unwrap_or_else(|| value(element.ends[0]) - value(element.ends[1]));
            let is_first = element.ends[0] == form.nodes[unknown as usize];
            (if is_first { along } else { -along }).times_power_of_two(form.scale(unknown))
        };
        (0..index(form.count())).map(jump).collect()
    }

    /// Half the exponent that an unknown is scaled by.
    fn half(&self, unknown: u32) -> i32 {
        self.edges.form.scale(unknown) / 2
    }

    /// Tells what the jumps make of temperatures or pore pressures.
    fn tell(&self, knowledge: &mut Knowledge<'_>) {
        let known = match self.field {
            Field::Potential => return,
            Field::Temperature => &mut knowledge.temperatures,
            Field::PorePressure => &mut knowledge.pore_pressures,
        };
        let values = self.edges.values(&self.core, &self.jumps);
        let form = &self.edges.form;
        for (&node, &number) in self.nodes.nodes.iter().zip(&self.origins.number) {
            if !self.core.is_free(number) {
                known[node as usize] = self.core.known[(number - self.core.free) as usize].to_f64();
            } else if form.of_node[number as usize] != NONE {
                known[node as usize] = values[number as usize].to_f64();
            }
        }
    }

    /// Puts in conductances of rows and sources.
    fn set(&mut self, rows: &[f64], sources: &[f64]) {
        let links = self.nodes.links.len();
        for (&element, &conductance) in self.origins.of_link[links..].iter().zip(rows) {
            if element != NONE {
                self.core.elements[element as usize].conductance = Wide::new(conductance);
            }
        }
        self.core.sources.fill(Wide::ZERO);
        for (&number, &source) in self.origins.number.iter().zip(sources) {
            if let Some(sum) = self.core.sources.get_mut(number as usize) {
                *sum += Wide::new(source);
            }
        }
    }

    fn balance(&self) -> Balance {
        let mut balance = Balance::default();
        let sources = self.edges.sources(&self.core);
        self.edges.balance(&self.core, &self.jumps, &sources, &mut balance);
        balance
    }

    /// The flows of the field's links and rows; zero for links whose nodes are taken out.
    fn flows(&self, balance: &Balance) -> Vec<Wide> {
        let flow = |&element: &u32| if element == NONE { Wide::ZERO } else { balance.flows[element as usize] };
        self.origins.of_link.iter().map(flow).collect()
    }

    /// The largest share of its flows that is missing in a balance, and the node of the scene.
    fn worst(&self, state: &Evaluated) -> (f64, u32) {
        let mut worst = (0.0, NONE);
        let cells = state.balance.missing().zip(&state.balance.magnitudes);
        for (unknown, (missing, &magnitude)) in cells.enumerate() {
            let share = if missing == 0.0 { 0.0 } else { missing.abs() / magnitude };
            if share > worst.0 || share.is_nan() {
                let number = self.edges.form.nodes[unknown];
                let place = self.origins.number.iter().position(|&of| of == number);
                worst = (share, place.map_or(NONE, |place| self.nodes.nodes[place]));
            }
        }
        worst
    }

    /// The size of the flows of its equations, on the scale of the matrix.
    fn unit(&self, state: &Evaluated) -> f64 {
        let scaled =
            (0..).zip(&state.balance.magnitudes).map(|(unknown, &flow)| scale_by_power(flow, -self.half(unknown)));
        let unit = scaled.fold(0.0, f64::max);
        if unit > 0.0 && unit.is_finite() { unit } else { 1.0 }
    }

    /// What is missing in the balances, as the sum of squares of parts of `unit`.
    fn merit(&self, state: &Evaluated, unit: f64) -> f64 {
        let scaled =
            (0..).zip(state.balance.missing()).map(|(unknown, flow)| scale_by_power(flow, -self.half(unknown)) / unit);
        scaled.map(|share| share * share).sum()
    }

    /// Goes from `jumps` a part of the way along a direction of all fields.
    fn go(&mut self, jumps: &[Wide], direction: &[f64], part: f64) {
        let form = &self.edges.form;
        let changes: Vec<f64> = (0..index(form.count()))
            .map(|unknown| {
                let change = direction[(self.start + unknown) as usize];
                part * scale_by_power(change, self.half(unknown))
            })
            .collect();
        let changes = self.edges.changes_of_jumps(&changes);
        self.jumps = jumps.iter().zip(changes).map(|(jump, change)| *jump + Wide::new(change)).collect();
    }

    /// The jump of values between two nodes of the scene.
    fn jump_of_values(&self, slave: u32, master: u32) -> f64 {
        let values = self.edges.values(&self.core, &self.jumps);
        let value = |node: u32| {
            let number = self.origins.number[self.nodes.place[node as usize] as usize];
            self.core.value(&values, number)
        };
        (value(slave) - value(master)).to_f64()
    }

    /// Calls `take` with the row of each equation that the flow of an element is part of, and the factor it has there on the scale of the matrix.
    fn on_element(&self, element: u32, mut take: impl FnMut(u32, f64)) {
        let ends = self.edges.form.ends(&self.core, &self.core.elements[element as usize]);
        self.edges.form.on_way(ends, |unknown, sign| {
            take(self.start + unknown, scale_by_power(sign, -self.half(unknown)));
        });
    }

    /// Calls `take` with the column of each unknown that the jump of an element is made of, and what turns a slope along the jump into one along the unknown.
    fn on_jump(&self, element: u32, mut take: impl FnMut(u32, &dyn Fn(f64) -> f64)) {
        let ends = self.edges.form.ends(&self.core, &self.core.elements[element as usize]);
        self.edges.form.on_way(ends, |unknown, sign| {
            let half = self.half(unknown);
            take(self.start + unknown, &|slope| scale_by_power(sign * slope, -half));
        });
    }

    /// The same for the value of a node of the scene.
    fn on_value(&self, node: u32, take: impl FnMut(u32, &dyn Fn(f64) -> f64)) {
        let place = self.nodes.place[node as usize];
        if place != NONE {
            self.on_place(place, take);
        }
    }

    /// The same for the value of a node of the field; its balance is in the same equations, with the same factors.
    fn on_place(&self, place: u32, mut take: impl FnMut(u32, &dyn Fn(f64) -> f64)) {
        let number = self.origins.number[place as usize];
        if !self.core.is_free(number) {
            return;
        }
        let unknown = self.edges.form.of_node[number as usize];
        self.edges.form.on_way([unknown, NONE], |unknown, _| {
            let half = self.half(unknown);
            take(self.start + unknown, &|slope| scale_by_power(slope, -half));
        });
    }
}

/// Chooses the unit of each field so that what couples two fields has one size in both directions; gives the factors.
fn balance_fields(fields: &[System<'_>], entries: &mut [Triplet<u32, u32, f64>], right: &mut Col<f64>) -> [f64; 3] {
    let mut scale = [1.0; 3];
    let [first, second] = fields else { return scale };
    let is_first = |unknown: u32| unknown < second.start;
    let largest = |of_first_row: bool| {
        let coupling = entries
            .iter()
            .filter(|entry| is_first(entry.row) == of_first_row && is_first(entry.row) != is_first(entry.col));
        coupling.fold(0.0, |largest: f64, entry| largest.max(entry.val.abs()))
    };
    let (upper, lower) = (largest(true), largest(false));
    if upper > 0.0 && lower > 0.0 && upper.is_finite() && lower.is_finite() {
        let exponent = (exponent_of(upper) - exponent_of(lower)) / 2;
        let factor = scale_by_power(1.0, exponent.clamp(-1000, 1000));
        for entry in entries.iter_mut() {
            match (is_first(entry.row), is_first(entry.col)) {
                (true, false) => entry.val /= factor,
                (false, true) => entry.val *= factor,
                _ => {}
            }
        }
        for unknown in 0..second.start {
            right[unknown as usize] /= factor;
        }
        scale[first.field.index()] = factor;
    }
    scale
}
