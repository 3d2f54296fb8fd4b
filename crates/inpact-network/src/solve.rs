//! Solves a scene at one time: stage by stage, each field with what the stages before have found.

use crate::assembly::{Capacities, Currents, RowFault, RowTerms, add_heat, network, row_terms, sources};
use crate::knowledge::{Increment, Knowledge};
use crate::linear::{LinearFailure, LinearSolution, Method, Shortcoming, Solver, Unsolvable, Work};
use crate::newton::{Iterated, Newton};
use crate::problem::{FieldNodes, Problem, Stage};
use crate::scene::Field;
use crate::state::{FieldState, StageReport, State};

/// Conductances within this relative distance of those a solution was found with are the same.
const CONSISTENT: f64 = 1e-14;

/// Conductances that come no nearer are taken within this distance; the report says how near they are.
const CONSISTENT_ENOUGH: f64 = 1e-10;

/// Equations of which no larger share is missing are not named when others are not met.
const MET: f64 = 1e-10;

/// How often a nonlinear stage is solved with the conductances of its own solution before Newton's iteration.
const FIRST_PASSES: usize = 2;

/// Solves a scene, time after time, with what can be kept from one to the next.
pub struct Equations<'a> {
    problem: &'a Problem<'a>,
    solvers: [Solver; 3],
    histories: Histories,
}

/// Whether time integrals of the rows are wanted, whose error then counts in the length of increments.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Histories {
    /// No.
    #[default]
    NotWanted,
    /// ECDT, SJDT, HTL, PTL and those times the area.
    Wanted,
}

/// Why a scene was not solved.
#[derive(Debug, Clone, PartialEq)]
pub enum SolveFailure {
    /// Bodies without a path to a fixed value: the field, and the nodes of each body, by their numbers in the scene.
    Floating {
        /// The field.
        field: Field,
        /// The nodes.
        bodies: Vec<Vec<u32>>,
    },
    /// Nodes that are one are held at different values.
    Contradiction {
        /// The field.
        field: Field,
        /// The nodes.
        nodes: [u32; 2],
        /// What they are held at.
        values: [f64; 2],
    },
    /// A law of a row gives nothing that can be solved with.
    Row(RowFault),
    /// No linear solver came within the tolerance.
    NotSolved {
        /// The field.
        field: Field,
        /// What was tried.
        tried: Vec<(Method, Shortcoming)>,
    },
    /// Newton's iteration did not converge.
    NotConverged {
        /// How many steps it took.
        steps: usize,
        /// For each field where most is missing: the share of its largest flow, and the node.
        worst: Vec<(Field, f64, Option<u32>)>,
    },
}

impl<'a> Equations<'a> {
    /// Equations that are solved by a method, within a tolerance of the relative error of every flow.
    pub fn new(problem: &'a Problem<'a>, method: Method, tolerance: f64) -> Self {
        let solvers = std::array::from_fn(|_| Solver::new(method, tolerance));
        Self { problem, solvers, histories: Histories::default() }
    }

    /// The same, with or without a look at time integrals.
    #[must_use]
    pub fn with(self, histories: Histories) -> Self {
        Self { histories, ..self }
    }

    /// Whether time integrals are wanted.
    pub(crate) fn histories(&self) -> Histories {
        self.histories
    }

    /// What is solved.
    pub fn problem(&self) -> &'a Problem<'a> {
        self.problem
    }

    /// What all linear networks that were solved so far took.
    pub fn work(&self) -> Work {
        let mut work = Work::default();
        self.solvers.iter().for_each(|solver| work += solver.work());
        work
    }

    /// The steady state.
    ///
    /// # Errors
    /// See [`SolveFailure`].
    pub fn steady(&mut self) -> Result<State, SolveFailure> {
        let knowledge = Knowledge::at_start(self.problem, 0.0);
        self.solve(knowledge, Capacities::None)
    }

    /// The state at the start of a transient: nodes with a capacity have their initial values, all others what follows from them.
    ///
    /// # Errors
    /// See [`SolveFailure`].
    pub fn start(&mut self, time: f64) -> Result<State, SolveFailure> {
        let knowledge = Knowledge::at_start(self.problem, time);
        self.solve(knowledge, Capacities::Held)
    }

    /// The state an increment after another, by backward Euler.
    ///
    /// # Errors
    /// See [`SolveFailure`].
    pub fn step(&mut self, before: &State, time: f64) -> Result<State, SolveFailure> {
        let increment = Increment { before, duration: time - before.time };
        let knowledge = Knowledge::in_increment(self.problem, increment, time);
        self.solve(knowledge, Capacities::Stored)
    }

    fn solve(&mut self, mut knowledge: Knowledge<'_>, capacities: Capacities) -> Result<State, SolveFailure> {
        let mut state = State {
            time: knowledge.time,
            increment: knowledge.number,
            fields: [None, None, None],
            reports: Vec::new(),
        };
        for stage in &self.problem.stages {
            let report = if stage.is_linear {
                self.solve_fields(stage, &mut knowledge, capacities, &mut state)?;
                StageReport { fields: stage.fields.clone(), iterations: 0, inconsistency: 0.0, linear: Vec::new() }
            } else {
                self.solve_nonlinear(stage, &mut knowledge, capacities, &mut state)?
            };
            let linear = stage.fields.iter().filter_map(|field| state.field(*field));
            let linear = linear.map(|field| field.solution.report.clone()).collect();
            state.reports.push(StageReport { linear, ..report });
        }
        Ok(state)
    }

    /// Solves the fields of a stage one after the other, each with the conductances that follow from what is known; then their values are known.
    fn solve_fields(
        &mut self,
        stage: &Stage,
        knowledge: &mut Knowledge<'_>,
        capacities: Capacities,
        state: &mut State,
    ) -> Result<(), SolveFailure> {
        for &field in &stage.fields {
            let Some(nodes) = self.problem.field(field) else { continue };
            let terms = row_terms(knowledge, field, nodes).map_err(SolveFailure::Row)?;
            let mut sources = sources(knowledge, field, nodes);
            if field == Field::Temperature {
                sources.iter_mut().zip(&knowledge.heat).for_each(|(sum, heat)| *sum += heat);
            }
            let network = network(knowledge, field, nodes, &terms.conductances, &sources, capacities);
            let solution =
                self.solvers[field.index()].solve(&network).map_err(|failure| failed(field, nodes, failure))?;
            if field == Field::Potential {
                knowledge.heat = self.heat_of(knowledge, nodes, &solution, &terms);
            }
            state.fields[field.index()] = Some(FieldState { solution, rows: terms.conductances, sources });
            knowledge.take(field, state);
        }
        Ok(())
    }

    /// The heat of currents, by place among the nodes of temperature; empty where no temperature is solved for.
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

    /// Solves a stage in which fields depend on themselves or on each other.
    fn solve_nonlinear(
        &mut self,
        stage: &Stage,
        knowledge: &mut Knowledge<'_>,
        capacities: Capacities,
        state: &mut State,
    ) -> Result<StageReport, SolveFailure> {
        for _ in 0..FIRST_PASSES {
            self.solve_fields(stage, knowledge, capacities, state)?;
        }
        let mut steps = 0;
        let mut inconsistency = f64::INFINITY;
        let iterated = loop {
            let iterated = self.iterate(stage, knowledge, capacities, state)?;
            steps += iterated.steps;
            if !iterated.has_converged {
                break iterated;
            }
            // The flows of the conductances that were found, to the last digit: what the conductances are there tells how good they were.
            self.solve_fields(stage, knowledge, capacities, state)?;
            let before = std::mem::replace(&mut inconsistency, self.inconsistency(stage, knowledge, state)?);
            if inconsistency <= CONSISTENT || 0.5 * before <= inconsistency {
                break iterated;
            }
        };
        if iterated.has_converged && inconsistency <= CONSISTENT_ENOUGH {
            return Ok(StageReport {
                fields: stage.fields.clone(),
                iterations: steps,
                inconsistency,
                linear: Vec::new(),
            });
        }
        let worst = stage
            .fields
            .iter()
            .zip(&iterated.missing)
            .map(|(&field, &(share, node))| (field, share, Some(node).filter(|node| *node != crate::linear::NONE)));
        let worst: Vec<(Field, f64, Option<u32>)> = worst.collect();
        let is_unmet = |(_, share, _): &(Field, f64, Option<u32>)| share.is_nan() || MET < *share;
        let unmet: Vec<_> = worst.iter().copied().filter(is_unmet).collect();
        Err(SolveFailure::NotConverged { steps, worst: if unmet.is_empty() { worst } else { unmet } })
    }

    fn iterate(
        &self,
        stage: &Stage,
        knowledge: &mut Knowledge<'_>,
        capacities: Capacities,
        state: &State,
    ) -> Result<Iterated, SolveFailure> {
        let first = stage.fields.iter().filter_map(|&field| {
            let state = state.field(field)?;
            Some((field, state.solution.clone(), state.rows.clone()))
        });
        let mut newton = Newton::new(knowledge, first.collect(), capacities, self.solvers[0].method());
        newton.iterate(knowledge).map_err(SolveFailure::Row)
    }

    /// How far the conductances at a state are from those it was found with, the largest relative distance.
    fn inconsistency(&self, stage: &Stage, knowledge: &Knowledge<'_>, state: &State) -> Result<f64, SolveFailure> {
        let mut largest = 0.0_f64;
        for &field in &stage.fields {
            let (Some(nodes), Some(found)) = (self.problem.field(field), state.field(field)) else { continue };
            let terms = row_terms(knowledge, field, nodes).map_err(SolveFailure::Row)?;
            for (now, before) in terms.conductances.iter().zip(&found.rows) {
                if now != before {
                    largest = largest.max((now - before).abs() / now.max(*before));
                }
            }
        }
        Ok(largest)
    }
}

/// A failure in terms of the scene.
fn failed(field: Field, nodes: &FieldNodes, failure: LinearFailure) -> SolveFailure {
    let node = |place: u32| nodes.nodes[place as usize];
    match failure {
        LinearFailure::Unsolvable(Unsolvable::Floating(bodies)) => {
            let bodies = bodies.into_iter().map(|body| body.into_iter().map(node).collect()).collect();
            SolveFailure::Floating { field, bodies }
        }
        LinearFailure::Unsolvable(Unsolvable::Contradiction { nodes, values }) => {
            SolveFailure::Contradiction { field, nodes: nodes.map(node), values }
        }
        LinearFailure::NotSolved(tried) => SolveFailure::NotSolved { field, tried },
    }
}
