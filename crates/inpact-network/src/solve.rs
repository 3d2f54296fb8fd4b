//! Solves a scene at one time stage by stage, each field with the results of the previous stages.

mod relaxation;

use crate::assembly::{Capacities, Currents, RowTerms, add_heat, network, row_terms, sources};
use crate::error::{Error, ErrorKind};
use crate::knowledge::{Guess, Increment, Knowledge};
use crate::linear::{Clock, LAST_DIGIT, LinearSolution, Method, Solver, Work};
use crate::newton::{Iterated, Newton};
use crate::problem::{FieldNodes, Problem, Stage};
use crate::scene::Field;
use crate::state::{FieldState, StageReport, State};
use inpact_evaluation::numbers::DoubleDouble;
use relaxation::{Relaxation, Walk};

/// Conductances within this relative distance of those of the solution count as equal.
const CONSISTENT: f64 = 1e-14;

/// Conductances that come no closer are accepted within this distance, which is reported.
const CONSISTENT_ENOUGH: f64 = 1e-10;

/// Equations with a smaller relative residual are not named when others are not met.
const MET: f64 = 1e-10;

/// This many units in the last place of a temperature or a pore pressure do not count as an inconsistency of a conductance.
const DIGITS: f64 = 4.0;

/// The maximum number of passes of fixed-point iteration, and of nodes in all of them together.
const MAX_PASSES: usize = 2_000;
const MAX_RELAXED_NODES: usize = 1_000_000;

/// The number of nodes from which factors are not kept for reuse.
const LARGE: usize = 10_000;

/// The number of fixed-point iterations of a nonlinear stage before Newton's iteration.
const FIRST_PASSES: usize = 2;

/// Solves a scene at successive times, reusing work from one to the next.
pub struct Equations<'a> {
    problem: &'a Problem<'a>,
    solvers: [Solver; 3],
    histories: Histories,
}

/// Time integrals of the rows, whose error limits the length of increments where they are requested.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Histories {
    /// No.
    #[default]
    NotWanted,
    /// ECDT, SJDT, HTL, PTL and those times the area.
    Wanted,
}

impl<'a> Equations<'a> {
    /// Equations that are solved by a method, within a tolerance of the relative error of every flow.
    pub fn new(problem: &'a Problem<'a>, method: Method, tolerance: f64) -> Self {
        let solvers = std::array::from_fn(|_| Solver::new(method, tolerance));
        Self { problem, solvers, histories: Histories::default() }
    }

    /// The same, with or without error control of time integrals.
    #[must_use]
    pub fn with(self, histories: Histories) -> Self {
        Self { histories, ..self }
    }

    /// The same, with the times of [`work`](Self::work) measured by the caller's clock; without one they are 0.
    #[must_use]
    pub fn timed_by(self, clock: Clock) -> Self {
        Self { solvers: self.solvers.map(|solver| solver.timed_by(clock)), ..self }
    }

    /// Whether time integrals are requested.
    pub(crate) fn histories(&self) -> Histories {
        self.histories
    }

    /// The problem.
    pub fn problem(&self) -> &'a Problem<'a> {
        self.problem
    }

    /// Total work of all linear networks solved so far.
    pub fn work(&self) -> Work {
        let mut work = Work::default();
        self.solvers.iter().for_each(|solver| work += solver.work());
        work
    }

    /// The steady state.
    ///
    /// # Errors
    /// See [`Error`].
    pub fn steady(&mut self) -> Result<State, Error> {
        let knowledge = Knowledge::at_start(self.problem, 0.0);
        self.solve(knowledge, Capacities::None)
    }

    /// The state at the start of a transient: nodes with a capacity have their initial values, all others the values that follow from them.
    ///
    /// # Errors
    /// See [`Error`].
    pub fn start(&mut self, time: f64) -> Result<State, Error> {
        let knowledge = Knowledge::at_start(self.problem, time);
        self.solve(knowledge, Capacities::Held)
    }

    /// The state one increment after another, by backward Euler.
    ///
    /// # Errors
    /// See [`Error`].
    pub fn step(&mut self, before: &State, time: f64) -> Result<State, Error> {
        let increment = Increment { before, duration: time - before.time };
        let knowledge = Knowledge::in_increment(self.problem, increment, time);
        self.solve(knowledge, Capacities::Stored)
    }

    fn solve(&mut self, knowledge: Knowledge<'_>, capacities: Capacities) -> Result<State, Error> {
        let (time, increment) = (knowledge.time, knowledge.number);
        let state = State { time, increment, fields: [None, None, None], reports: Vec::new() };
        let mut at = At { knowledge, capacities, state };
        for stage in &self.problem.stages {
            let (iterations, inconsistency) = if stage.is_linear {
                self.solve_fields(stage, &mut at)?;
                (0, 0.0)
            } else {
                self.solve_nonlinear(stage, &mut at)?
            };
            let linear = stage.fields.iter().filter_map(|field| at.state.field(*field));
            let linear = linear.map(|field| field.solution.report.clone()).collect();
            at.state.reports.push(StageReport { fields: stage.fields.clone(), iterations, inconsistency, linear });
            if stage.fields.contains(&Field::Temperature) {
                self.refuse_cold(&at.state)?;
            }
        }
        Ok(at.state)
    }

    /// Rejects temperatures below absolute zero: the laws are not defined there, and a balance would be met by accident.
    fn refuse_cold(&self, state: &State) -> Result<(), Error> {
        let (Some(zero), Some(nodes), Some(field)) =
            (self.problem.absolute_zero, self.problem.field(Field::Temperature), state.field(Field::Temperature))
        else {
            return Ok(());
        };
        let coldest = nodes.nodes.iter().zip(field.values()).min_by(|one, other| one.1.total_cmp(&other.1));
        match coldest.filter(|(_, value)| *value < zero) {
            Some((&node, value)) => Err(ErrorKind::BelowAbsoluteZero { node, value, zero }.into()),
            None => Ok(()),
        }
    }

    /// Solves the fields of a stage in turn, each with the conductances at the known values; then their own values are known.
    fn solve_fields(&mut self, stage: &Stage, at: &mut At<'_>) -> Result<(), Error> {
        let At { knowledge, capacities, state } = at;
        for &field in &stage.fields {
            let Some(nodes) = self.problem.field(field) else { continue };
            let terms = row_terms(knowledge, field, nodes)?;
            let mut sources = sources(knowledge, field, nodes);
            if field == Field::Temperature {
                sources.iter_mut().zip(&knowledge.heat).for_each(|(sum, heat)| *sum += heat);
            }
            let network = network(knowledge, field, nodes, &terms.conductances, &sources, *capacities);
            let solution =
                self.solvers[field.index()].solve(&network).map_err(|error| error.in_field(field, &nodes.nodes))?;
            if field == Field::Potential {
                knowledge.heat = self.heat_of(knowledge, nodes, &solution, &terms);
            }
            // At the start of a transient infinite conductances may have been opened.
            let rows = network.links[nodes.links.len()..].iter().map(|link| link.conductance).collect();
            state.fields[field.index()] = Some(FieldState { solution, rows, sources });
            knowledge.take(field, state);
        }
        Ok(())
    }

    /// The heat of currents, by index among the nodes of temperature; empty where no temperature is solved for.
    fn heat_of(
        &self,
        knowledge: &Knowledge<'_>,
        nodes: &FieldNodes,
        solution: &LinearSolution,
        terms: &RowTerms,
    ) -> Vec<f64> {
        let Some(temperature) = self.problem.field(Field::Temperature) else { return Vec::new() };
        let mut heat = vec![0.0; temperature.nodes.len()];
        let currents = Currents { flows: &solution.flows, rows: terms };
        add_heat(knowledge, nodes, currents, temperature, &mut heat, None);
        heat
    }

    /// Solves a stage in which fields depend on themselves or on each other; returns the number of Newton steps, and the consistency of the conductances.
    ///
    /// A failure with a loose tolerance is tried again to the last digit, as consistent conductances may require it.
    fn solve_nonlinear(&mut self, stage: &Stage, at: &mut At<'_>) -> Result<(usize, f64), Error> {
        let begin = at.knowledge.clone();
        let found = self.solve_within(stage, at);
        let is_rough = self.solvers.iter().any(|solver| LAST_DIGIT < solver.tolerance());
        let is_short =
            |error: &Error| matches!(error.kind(), ErrorKind::NotConverged { .. } | ErrorKind::NotSolved { .. });
        if !is_rough || !found.as_ref().is_err_and(is_short) {
            return found;
        }
        at.knowledge = begin;
        let tolerances = self.solvers.each_mut().map(|solver| solver.set_tolerance(LAST_DIGIT));
        let found = self.solve_within(stage, at);
        for (solver, tolerance) in self.solvers.iter_mut().zip(tolerances) {
            solver.set_tolerance(tolerance);
        }
        found
    }

    /// Solves the fields with the conductances at an initial guess; where nothing flows there, with those elsewhere in the tables.
    fn solve_first(&mut self, stage: &Stage, at: &mut At<'_>) -> Result<(), Error> {
        match self.solve_fields(stage, at) {
            Err(error) if matches!(error.kind(), ErrorKind::Floating { .. }) => {
                at.knowledge.guess = Guess::WhereRowsConduct;
                let solved = self.solve_fields(stage, at);
                at.knowledge.guess = Guess::AsItIs;
                solved
            }
            solved => solved,
        }
    }

    /// Solves a nonlinear stage within the tolerance of the solvers: by Newton's iteration and, where that fails, again from the result of fixed-point iteration.
    fn solve_within(&mut self, stage: &Stage, at: &mut At<'_>) -> Result<(usize, f64), Error> {
        for _ in 0..FIRST_PASSES {
            self.solve_first(stage, at)?;
        }
        let begin = at.knowledge.clone();
        let mut steps = 0;
        let mut attempt = self.converge(stage, at, &mut steps)?;
        if attempt.is_short() {
            // From the initial state, as the iteration may have diverged.
            let mut ways = [Relaxation::Parts, Relaxation::Brackets].into_iter();
            while attempt.is_short()
                && let Some(way) = ways.next()
            {
                let mut relaxed = At { knowledge: begin.clone(), capacities: at.capacities, state: at.state.clone() };
                // A failure of the last resort is not reported: the failure is that of Newton's iteration.
                if let Ok(true) = self.relax(way, stage, &mut relaxed, &mut steps)
                    && let Ok(again) = self.converge(stage, &mut relaxed, &mut steps)
                    && !again.is_short()
                {
                    (*at, attempt) = (relaxed, again);
                }
            }
        }
        let Attempt { iterated, inconsistency, .. } = &attempt;
        if !attempt.is_short() {
            return Ok((steps, *inconsistency));
        }
        let inconsistency = iterated.has_converged.then_some(*inconsistency);
        let worst = stage
            .fields
            .iter()
            .zip(&iterated.missing)
            .map(|(&field, &(share, node))| (field, share, Some(node).filter(|node| *node != crate::linear::NONE)));
        let worst: Vec<(Field, f64, Option<u32>)> = worst.collect();
        let is_unmet = |(_, share, _): &(Field, f64, Option<u32>)| share.is_nan() || MET < *share;
        let unmet: Vec<_> = worst.iter().copied().filter(is_unmet).collect();
        Err(ErrorKind::NotConverged { steps, worst: if unmet.is_empty() { worst } else { unmet }, inconsistency }
            .into())
    }

    /// Newton's iteration, until the conductances are consistent with its state.
    fn converge(&mut self, stage: &Stage, at: &mut At<'_>, steps: &mut usize) -> Result<Attempt, Error> {
        let (mut inconsistency, mut beyond) = (f64::INFINITY, f64::INFINITY);
        loop {
            let iterated = self.iterate(stage, at)?;
            *steps += iterated.steps;
            if !iterated.has_converged {
                return Ok(Attempt { iterated, inconsistency, beyond });
            }
            // The flows with these conductances, to the last digit; the conductances at that solution measure their error.
            self.solve_fields(stage, at)?;
            let before = inconsistency;
            (inconsistency, beyond) = self.inconsistency(stage, at)?;
            if inconsistency <= CONSISTENT || 0.5 * before <= inconsistency {
                return Ok(Attempt { iterated, inconsistency, beyond });
            }
        }
    }

    /// Fixed-point iteration with the current conductances, relaxed at each node. Whether it converged.
    fn relax(&mut self, way: Relaxation, stage: &Stage, at: &mut At<'_>, steps: &mut usize) -> Result<bool, Error> {
        let unknowns: usize = stage.fields.iter().map(|field| self.problem.nodes_of(*field).len()).sum();
        let passes = (MAX_RELAXED_NODES / unknowns.max(1)).min(MAX_PASSES);
        let nodes = at.knowledge.temperatures.len();
        let mut walks = vec![Walk::default(); 2 * nodes];
        for _ in 0..passes {
            *steps += 1;
            let before = [at.knowledge.temperatures.clone(), at.knowledge.pore_pressures.clone()];
            self.solve_first(stage, at)?;
            let (mut largest, mut size) = (0.0_f64, f64::MIN_POSITIVE);
            let found = [&mut at.knowledge.temperatures, &mut at.knowledge.pore_pressures];
            for ((found, before), walks) in found.into_iter().zip(&before).zip(walks.chunks_mut(nodes.max(1))) {
                for ((found, before), walk) in found.iter_mut().zip(before).zip(walks) {
                    let change = (*found - *before).to_f64();
                    if change.is_finite() && change != 0.0 {
                        size = size.max(found.to_f64().abs());
                        let step = walk.step(way, before.to_f64(), change);
                        largest = largest.max(if way == Relaxation::Parts { change.abs() } else { step.abs() });
                        *found = *before + DoubleDouble::new(step);
                    }
                }
            }
            if largest <= way.at_rest() * size {
                return Ok(true);
            }
        }
        Ok(false)
    }

    fn iterate(&mut self, stage: &Stage, at: &mut At<'_>) -> Result<Iterated, Error> {
        let first = stage.fields.iter().filter_map(|&field| {
            let state = at.state.field(field)?;
            Some((field, state.solution.clone(), state.rows.clone()))
        });
        // The conductances change, and with them the factors, which in a large scene only take memory.
        if LARGE <= self.problem.scene.nodes.len() {
            self.solvers.iter_mut().for_each(Solver::release_factor);
        }
        let mut newton = Newton::new(&at.knowledge, first.collect(), at.capacities, self.solvers[0].method());
        newton.iterate(&mut at.knowledge)
    }

    /// The largest relative distance of the conductances at a state from those of its solution; and the largest of those that the last digits
    /// of temperatures and pore pressures do not explain.
    fn inconsistency(&self, stage: &Stage, At { knowledge, state, .. }: &At<'_>) -> Result<(f64, f64), Error> {
        let (mut largest, mut beyond) = (0.0_f64, 0.0_f64);
        for &field in &stage.fields {
            let (Some(nodes), Some(found)) = (self.problem.field(field), state.field(field)) else { continue };
            let terms = row_terms(knowledge, field, nodes)?;
            for (place, (now, before)) in terms.conductances.iter().zip(&found.rows).enumerate() {
                if now == before {
                    continue;
                }
                let distance = (now - before).abs() / now.max(*before);
                largest = largest.max(distance);
                let (row, slopes) = (nodes.rows[place], &terms.slopes[place]);
                let sides = knowledge.sides(row);
                let digit = |slope: f64, sides: [DoubleDouble; 2]| {
                    let size = sides.into_iter().fold(0.0_f64, |size, side| size.max(side.to_f64().abs()));
                    if slope == 0.0 { 0.0 } else { DIGITS * f64::EPSILON * size * slope.abs() }
                };
                let of_digits = digit(slopes.along_temperature, sides.temperatures)
                    + digit(slopes.along_pore_pressure, sides.pore_pressures);
                if of_digits * knowledge.row(row).area < (now - before).abs() {
                    beyond = beyond.max(distance);
                }
            }
        }
        Ok((largest, beyond))
    }
}

/// A state in progress, and its known values.
struct At<'a> {
    knowledge: Knowledge<'a>,
    capacities: Capacities,
    state: State,
}

/// Result of an attempt at a nonlinear stage.
struct Attempt {
    iterated: Iterated,
    /// Relative distance of the conductances from those of the state.
    inconsistency: f64,
    /// The largest distance not explained by rounding.
    beyond: f64,
}

impl Attempt {
    /// Whether it failed to converge.
    fn is_short(&self) -> bool {
        let is_good = self.iterated.has_converged && self.beyond <= CONSISTENT_ENOUGH;
        !is_good
    }
}
