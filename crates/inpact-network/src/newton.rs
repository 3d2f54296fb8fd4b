//! Newton's iteration for fields whose conductances depend on the unknowns.
//!
//! Unknowns are the relative ones of each field (`linear/relative.rs`), so that the blocks of single fields are the well-scaled matrices of the linear solver;
//! the slopes of section 8 of the semantics are added to them, which makes the Jacobian unsymmetric (J-2):
//!
//! - of a flow q = g Δ the slopes ½ g' Δ along the temperatures of both sides, ∂σ/∂θ̄ among them, and those of radiation;
//! - of the heat of a current ∂q_g/∂Δφ and ∂q_g/∂θ̄.
//!
//! A step is shortened until it reduces the residuals of the balances (backtracking line search by halves). Tables are piecewise linear: at a knot the slope is that of the right-hand side,
//! and a step that overshoots a knot is shortened or, where no step reduces the residuals, replaced by one with frozen conductances (Picard), which needs no slope.
//! Where that does not reach a solution, pseudo-transient continuation follows: every equation gets a pseudo-capacity,
//! which decreases with the residuals (Kelley and Keyes, SIAM J. Numer. Anal. 35 (1998) 508–523).
//! It leaves local minima of the residual in which descent stalls. Currents have no pseudo-capacity: they are balanced again after each step.
//! In large scenes a step is computed without factoring the whole matrix (`newton/krylov.rs`).
//! The result of the iteration is a state whose conductances are accurate to rounding; the linear solver then computes their flows to the last digit.

mod equations;
mod krylov;
mod system;

use crate::assembly::{Capacities, Currents, add_heat, row_terms, sources};
use crate::error::Error;
use crate::knowledge::Knowledge;
use crate::linear::{LinearSolution, Method, index, largest_or_nan};
use crate::scene::Field;
use equations::{Slopes, StepEquations};
use faer::MatMut;
use faer::prelude::Solve;
use faer::sparse::SparseColMat;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use inpact_evaluation::numbers::DoubleDouble;
use system::{Evaluated, System};

/// The relative residual below which a balance is met.
const MET: f64 = 1e-17;

/// The relative residual below which a stagnating iteration has converged: conductances are computed in f64.
const GOOD_ENOUGH: f64 = 1e-10;

/// The maximum number of steps.
const MAX_STEPS: usize = 60;

/// The number of unknowns from which a step is computed without factoring the whole matrix.
const LARGE: usize = 20_000;

/// Initial pseudo-capacity of an equation, as a multiple of the size of its slopes: more in a second attempt.
const FIRST_PSEUDO_CAPACITIES: [f64; 2] = [1.0, 10.0];

/// Growth of the pseudo-capacity after a rejected step.
const GOING_BACK: f64 = 4.0;

/// The residual below which pseudo-transient continuation ends and Newton's iteration resumes.
const AT_REST: f64 = 1e-6;

/// The maximum number of steps of pseudo-transient continuation.
const MAX_PSEUDO_TIME_STEPS: usize = 1000;

/// The maximum number of halvings of a step.
const MAX_HALVES: i32 = 12;

/// Result of an iteration.
#[derive(Debug, Clone)]
pub(crate) struct Iterated {
    /// The number of steps.
    pub(crate) steps: usize,
    /// Whether the balances are met.
    pub(crate) has_converged: bool,
    /// The largest residual of each field, relative to the largest flow, and its node of the scene.
    pub(crate) missing: Vec<(f64, u32)>,
}

/// The fields of a stage, set up around a first solution of each.
pub(crate) struct Newton<'a> {
    fields: Vec<System<'a>>,
    method: Method,
    kept: Option<Structure>,
    /// The orders of the blocks of the fields, in large scenes.
    orders: Vec<Option<krylov::Order>>,
}

/// The symbolic factorisation, valid as long as the pattern of the matrix is the same.
struct Structure {
    places: Vec<(u32, u32)>,
    symbolic: SymbolicLu<u32>,
}

impl<'a> Newton<'a> {
    /// Sets up the fields around solutions of linear networks with these rows.
    pub(crate) fn new(
        knowledge: &Knowledge<'a>,
        first: Vec<(Field, LinearSolution, Vec<f64>)>,
        capacities: Capacities,
        method: Method,
    ) -> Self {
        let mut fields: Vec<System<'a>> = Vec::new();
        for (field, solution, rows) in first {
            let Some(nodes) = knowledge.problem.field(field) else { continue };
            let start = fields.last().map_or(0, |before| before.start + index(before.edges.form.count()));
            fields.extend(System::new(knowledge, field, nodes, &solution, &rows, capacities, start));
        }
        let orders = fields.iter().map(|_| None).collect();
        Self { fields, method, kept: None, orders }
    }

    /// Iterates; the temperatures and pore pressures in `knowledge` follow the state.
    ///
    /// # Errors
    /// A row whose law fails.
    pub(crate) fn iterate(&mut self, knowledge: &mut Knowledge<'a>) -> Result<Iterated, Error> {
        let start = self.jumps();
        let mut iterated = self.descend(knowledge)?;
        for pseudo_capacity in FIRST_PSEUDO_CAPACITIES {
            if !iterated.has_converged {
                self.set_jumps(start.clone());
                let steps = iterated.steps + self.pseudo_transient(knowledge, pseudo_capacity)?;
                let descended = self.descend(knowledge)?;
                iterated = Iterated { steps: steps + descended.steps, ..descended };
            }
        }
        Ok(iterated)
    }

    /// Takes steps that reduce the residuals.
    fn descend(&mut self, knowledge: &mut Knowledge<'a>) -> Result<Iterated, Error> {
        let mut states = self.evaluate(knowledge)?;
        let mut best = f64::INFINITY;
        let mut idle = 0;
        for step in 0..=MAX_STEPS {
            let worst = self.worst(&states);
            if worst < 0.5 * best {
                best = worst;
                idle = 0;
            } else {
                idle += 1;
            }
            let is_met = (worst <= MET && step > 0) || (worst <= GOOD_ENOUGH && idle >= 1);
            let end = |has_converged: bool, newton: &Self, states: &[Evaluated]| {
                let missing = newton.fields.iter().zip(states).map(|(of, at)| of.worst_node(at)).collect();
                Iterated { steps: step, has_converged, missing }
            };
            if is_met || step == MAX_STEPS || !worst.is_finite() {
                return Ok(end(is_met, self, &states));
            }
            let mut moved = None;
            // Without slopes a step leads to the solution with the current conductances.
            for slopes in [Slopes::All, Slopes::Held] {
                if moved.is_none()
                    && let Some(direction) = self.direction(knowledge, &states, slopes, 0.0)
                {
                    moved = self.search(knowledge, &direction, &states)?;
                }
            }
            match moved {
                Some(moved) => states = moved,
                None => return Ok(end(worst <= GOOD_ENOUGH, self, &states)),
            }
        }
        unreachable!("the last pass returns")
    }

    /// Pseudo-transient continuation until the residuals are small; returns the number of steps.
    fn pseudo_transient(&mut self, knowledge: &mut Knowledge<'a>, mut pseudo_capacity: f64) -> Result<usize, Error> {
        let mut states = self.evaluate(knowledge)?;
        let mut worst = self.worst(&states);
        let mut previous: Vec<f64> = Vec::new();
        for step in 0..MAX_PSEUDO_TIME_STEPS {
            if worst <= AT_REST || !worst.is_finite() {
                return Ok(step);
            }
            let Some(direction) = self.direction(knowledge, &states, Slopes::All, pseudo_capacity) else {
                return Ok(step);
            };
            let start = self.jumps();
            self.go(&start, &direction, 1.0);
            states = self.evaluate(knowledge)?;
            if let Some(balanced) = self.balance_currents(knowledge, &states)? {
                states = balanced;
            }
            let before = std::mem::replace(&mut worst, self.worst(&states));
            // A step that reverses the previous one has shown that it was too long.
            let goes_back = direction.iter().zip(&previous).map(|(now, before)| now * before).sum::<f64>() < 0.0;
            pseudo_capacity *= if goes_back { GOING_BACK } else { (worst / before).clamp(0.5, 2.0) };
            previous = direction;
        }
        Ok(MAX_PSEUDO_TIME_STEPS)
    }

    /// Balances the currents with the current conductances: they have no time scale of their own, and potentials of other conductances could give any heat. `None` where there are none.
    fn balance_currents(
        &mut self,
        knowledge: &mut Knowledge<'a>,
        states: &[Evaluated],
    ) -> Result<Option<Vec<Evaluated>>, Error> {
        let Some(potential) = self.fields.iter().find(|system| system.field == Field::Potential) else {
            return Ok(None);
        };
        let range = potential.start as usize..potential.start as usize + potential.edges.form.count();
        let Some(mut direction) = self.direction(knowledge, states, Slopes::Held, 0.0) else { return Ok(None) };
        for (_, change) in (0..).zip(&mut direction).filter(|(unknown, _)| !range.contains(unknown)) {
            *change = 0.0;
        }
        let start = self.jumps();
        self.go(&start, &direction, 1.0);
        self.evaluate(knowledge).map(Some)
    }

    /// The largest relative residual of any field.
    fn worst(&self, states: &[Evaluated]) -> f64 {
        largest_or_nan(self.fields.iter().zip(states).map(|(of, at)| of.worst(at)))
    }

    fn jumps(&self) -> Vec<Vec<DoubleDouble>> {
        self.fields.iter().map(|system| system.jumps.clone()).collect()
    }

    fn set_jumps(&mut self, jumps: Vec<Vec<DoubleDouble>>) {
        for (system, jumps) in self.fields.iter_mut().zip(jumps) {
            system.jumps = jumps;
        }
    }

    fn go(&mut self, start: &[Vec<DoubleDouble>], direction: &[f64], part: f64) {
        for (system, jumps) in self.fields.iter_mut().zip(start) {
            system.go(jumps, direction, part);
        }
    }

    /// Evaluates the laws and the balances at the current jumps.
    fn evaluate(&mut self, knowledge: &mut Knowledge<'a>) -> Result<Vec<Evaluated>, Error> {
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
                // Potential precedes temperature where both are in one stage.
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

    /// Backtracking line search along a direction; `None` where no step reduces the residuals.
    fn search(
        &mut self,
        knowledge: &mut Knowledge<'a>,
        direction: &[f64],
        states: &[Evaluated],
    ) -> Result<Option<Vec<Evaluated>>, Error> {
        let units: Vec<f64> = self.fields.iter().zip(states).map(|(of, at)| of.unit(at)).collect();
        let merit = |systems: &[System<'a>], states: &[Evaluated]| -> f64 {
            let of_field = |((of, at), unit): ((&System<'a>, &Evaluated), &f64)| of.merit(at, *unit);
            systems.iter().zip(states).zip(&units).map(of_field).sum()
        };
        let (before, worst) = (merit(&self.fields, states), self.worst(states));
        let start = self.jumps();
        for halves in 0..=MAX_HALVES {
            let part = 0.5_f64.powi(halves);
            self.go(&start, direction, part);
            let trial = self.evaluate(knowledge)?;
            let after = merit(&self.fields, &trial);
            // Near a solution the largest balances are at their rounding, while small ones still improve.
            let gains = after < (1.0 - 1e-4 * part) * before || self.worst(&trial) < 0.5 * worst;
            if gains {
                return Ok(Some(trial));
            }
        }
        self.set_jumps(start);
        self.evaluate(knowledge)?;
        Ok(None)
    }

    /// The Newton step: the change of all unknowns, on the scale of the matrix; `None` where the matrix cannot be factored.
    ///
    /// Each equation of temperature and pore pressure has a pseudo-capacity of `pseudo_capacity` times the magnitude of its slopes.
    fn direction(
        &mut self,
        knowledge: &Knowledge<'a>,
        states: &[Evaluated],
        slopes: Slopes,
        pseudo_capacity: f64,
    ) -> Option<Vec<f64>> {
        let equations = self.equations(knowledge, states, slopes, pseudo_capacity);
        let scale = equations.scale;
        let mut direction = if LARGE <= equations.right.len() {
            // The entries become the matrix in place; where GMRES fails they are assembled again.
            let found = self.without_factor(equations);
            found.or_else(|| self.by_factor(self.equations(knowledge, states, slopes, pseudo_capacity)))?
        } else {
            self.by_factor(equations)?
        };
        for system in &self.fields {
            let range = system.start as usize..system.start as usize + system.edges.form.count();
            direction[range].iter_mut().for_each(|change| *change *= scale[system.field.index()]);
        }
        direction.iter().all(|change| change.is_finite()).then_some(direction)
    }

    /// The step preconditioned by blocks of single fields.
    fn without_factor(&mut self, equations: StepEquations) -> Option<Vec<f64>> {
        let StepEquations { entries, right, pseudo_capacity, .. } = equations;
        let matrix = krylov::Columns::of(right.len(), entries);
        let blocks = self.fields.iter().zip(&mut self.orders).map(|(system, order)| {
            let range = system.start as usize..system.start as usize + system.edges.form.count();
            krylov::Block::of(system, pseudo_capacity.get(range).unwrap_or_default(), self.method, order)
        });
        let mut blocks = blocks.collect::<Option<Vec<krylov::Block>>>()?;
        krylov::solve(&matrix, &mut blocks, &right)
    }

    /// The step by a factor of the whole matrix.
    fn by_factor(&mut self, equations: StepEquations) -> Option<Vec<f64>> {
        let StepEquations { entries, mut right, .. } = equations;
        let count = right.len();
        let places: Vec<(u32, u32)> = entries.iter().map(|entry| (entry.row, entry.col)).collect();
        let matrix = SparseColMat::<u32, f64>::try_new_from_triplets(count, count, &entries).ok()?;
        let symbolic = match &self.kept {
            Some(kept) if kept.places == places => kept.symbolic.clone(),
            _ => SymbolicLu::try_new(matrix.symbolic()).ok()?,
        };
        let factor = Lu::try_new_with_symbolic(symbolic.clone(), matrix.as_ref()).ok()?;
        self.kept = Some(Structure { places, symbolic });
        factor.solve_in_place(MatMut::from_column_major_slice_mut(&mut right, count, 1));
        Some(right)
    }
}
