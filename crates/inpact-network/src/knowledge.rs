//! The values that interface laws read while a scene is being solved: temperatures and pore pressures at the nodes, the jumps at the start of the increment, and the time.

use crate::interface::{Contact, Moment, Sides};
use crate::problem::Problem;
use crate::scene::{Field, SceneInterface};
use crate::state::State;
use inpact_evaluation::HistoryStart;
use inpact_evaluation::law::{Clearance, ClearanceRate, ClosingHeat, ContactPressure, ContactState, Gap};
use inpact_evaluation::numbers::DoubleDouble;

/// The minimum initial guess of a temperature, above absolute zero, θ.
const WARM: f64 = 300.0;

/// An increment of time.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Increment<'a> {
    /// The state at its start.
    pub(crate) before: &'a State,
    /// Length, T.
    pub(crate) duration: f64,
}

/// The purpose of an initial guess.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Guess {
    /// Rows have the conductances of their laws there.
    #[default]
    AsItIs,
    /// A row whose conductance is zero there takes one from elsewhere in its table, so that every node has a path at first.
    WhereRowsConduct,
}

/// The values other than the unknowns of a stage.
#[derive(Debug, Clone)]
pub(crate) struct Knowledge<'a> {
    pub(crate) problem: &'a Problem<'a>,
    /// The time at the end of the increment.
    pub(crate) time: f64,
    pub(crate) increment: Option<Increment<'a>>,
    pub(crate) number: i32,
    /// By node of the scene; NaN where unknown.
    pub(crate) temperatures: Vec<DoubleDouble>,
    pub(crate) pore_pressures: Vec<DoubleDouble>,
    /// The heat of currents already solved, by index among the nodes of temperature; empty where there is none.
    pub(crate) heat: Vec<f64>,
    pub(crate) guess: Guess,
}

impl<'a> Knowledge<'a> {
    /// Only initial values are known.
    pub(crate) fn at_start(problem: &'a Problem<'a>, time: f64) -> Self {
        let nodes = problem.scene.nodes.len();
        let mut knowledge = Self {
            problem,
            time,
            increment: None,
            number: 0,
            temperatures: vec![DoubleDouble::new(f64::NAN); nodes],
            pore_pressures: vec![DoubleDouble::new(f64::NAN); nodes],
            heat: Vec::new(),
            guess: Guess::default(),
        };
        knowledge.begin(Field::Temperature);
        knowledge.begin(Field::PorePressure);
        knowledge
    }

    /// The values in an increment before it is solved: the state at its start.
    pub(crate) fn in_increment(problem: &'a Problem<'a>, increment: Increment<'a>, time: f64) -> Self {
        let mut knowledge = Self::at_start(problem, time);
        knowledge.increment = Some(increment);
        knowledge.number = increment.before.increment + 1;
        for field in Field::ALL {
            knowledge.take(field, increment.before);
        }
        knowledge
    }

    /// Adds the values of a field of a state.
    pub(crate) fn take(&mut self, field: Field, state: &State) {
        let (Some(nodes), Some(state)) = (self.problem.field(field), state.field(field)) else { return };
        let values = match field {
            Field::Potential => return,
            Field::Temperature => &mut self.temperatures,
            Field::PorePressure => &mut self.pore_pressures,
        };
        for (&node, value) in nodes.nodes.iter().zip(&state.solution.values) {
            values[node as usize] = *value;
        }
    }

    /// An initial guess of a field: initial and fixed values, and their middle where neither is given.
    fn begin(&mut self, field: Field) {
        let Some(nodes) = self.problem.field(field) else { return };
        let (scene, time) = (self.problem.scene, self.time);
        let conditions = scene.conditions(field);
        let of_all = match field {
            Field::PorePressure => scene.initial_pore_pressure,
            _ => scene.initial_temperature,
        };
        let fixed = conditions.fixed.values().map(|course| course.at(time));
        let (least, greatest) = fixed
            .chain(conditions.initial.values().copied())
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, greatest), value| {
                (least.min(value), greatest.max(value))
            });
        let middle = if least <= greatest { 0.5 * least + 0.5 * greatest } else { 0.0 };
        let middle = if field == Field::Temperature { self.warm(middle) } else { middle };
        let values = if field == Field::PorePressure { &mut self.pore_pressures } else { &mut self.temperatures };
        for &node in &nodes.nodes {
            let fixed = conditions.fixed.get(&node).map(|course| course.at(time));
            let value = fixed.or_else(|| conditions.initial.get(&node).copied()).or(of_all).unwrap_or(middle);
            values[node as usize] = DoubleDouble::new(value);
        }
    }

    /// An initial guess of temperatures at which every radiating surface radiates: at absolute zero a body would seem disconnected.
    fn warm(&self, guess: f64) -> f64 {
        let radiating = self.problem.laws.iter().flatten().filter_map(|laws| laws.radiation.as_ref());
        let coldest = radiating.map(|law| law.absolute_zero).fold(f64::NEG_INFINITY, f64::max);
        if guess <= coldest { coldest + WARM } else { guess }
    }

    pub(crate) fn row(&self, row: u32) -> &'a SceneInterface {
        &self.problem.scene.interfaces[row as usize]
    }

    /// The contact of a row now.
    pub(crate) fn contact(&self, row: u32) -> Contact {
        // Rows with undetermined contact were rejected before solving.
        Contact::of(self.row(row), self.time).unwrap_or(Contact {
            clearance: Clearance(f64::NAN),
            pressure: ContactPressure(f64::NAN),
            state: ContactState::Undetermined,
        })
    }

    /// The values on both sides of a row.
    pub(crate) fn sides(&self, row: u32) -> Sides {
        let of = self.row(row);
        let nodes = of.nodes().map(|node| node as usize);
        let known = |value: DoubleDouble| (!value.to_f64().is_nan()).then_some(value);
        let of_nodes = nodes.map(|node| known(self.temperatures[node]));
        let temperatures = of.temperatures(of_nodes, self.problem.scene.initial_temperature, DoubleDouble::new);
        Sides {
            temperatures: temperatures.map(|temperature| temperature.unwrap_or(DoubleDouble::new(f64::NAN))),
            pore_pressures: nodes.map(|node| self.pore_pressures[node]),
        }
    }

    /// Time and increment, for user subroutines.
    pub(crate) fn moment(&self) -> Moment {
        Moment { time: self.time, step_time: self.time - self.problem.start(), increment: self.number.max(1) }
    }

    /// The jump of potential of a row at the start of the increment; `None` in a steady state, and where the increment closes a circuit whose heat is to balance.
    pub(crate) fn jump_at_start(&self, row: u32) -> Option<f64> {
        let before = self.increment?.before;
        if self.starts_at_rest() {
            return Some(0.0);
        }
        let is_open = before.conductance(self.problem, Field::Potential, row) == Some(0.0);
        let takes_jump = !is_open || self.problem.scene.closing_heat() == ClosingHeat::Manual;
        before.row_jump(self.problem, Field::Potential, row).filter(|_| takes_jump)
    }

    /// The jump of potential of a link at the start of the increment; `None` in a steady state.
    pub(crate) fn link_jump_at_start(&self, link: u32, conductance: f64) -> Option<f64> {
        let before = self.increment?.before;
        if self.starts_at_rest() {
            return Some(0.0);
        }
        Some(before.link_flow(self.problem, Field::Potential, link)? / conductance)
    }

    /// Whether the increment is the first of a history that starts without any jump (C-25).
    fn starts_at_rest(&self) -> bool {
        self.problem.scene.history_start() != HistoryStart::FirstRow && self.number == 1
    }

    /// The gap of a row: in a transient it changes at the given rate, otherwise by the change of its clearance over the increment; and the default length of its cutoffs.
    pub(crate) fn gap(&self, of: &SceneInterface) -> (Gap, Option<f64>) {
        let from_course = || {
            let (course, increment) = (of.clearance.as_ref()?, self.increment?);
            let clearance = Clearance(course.at(increment.before.time));
            Some(Gap::Since { clearance, duration: increment.duration })
        };
        let gap = if self.problem.scene.is_transient() {
            let given = of.clearance_rate.map(|rate| Gap::Changing(ClearanceRate(rate)));
            given.or_else(from_course).unwrap_or(Gap::Changing(ClearanceRate(0.0)))
        } else {
            Gap::Steady
        };
        (gap, self.problem.characteristic_length)
    }
}
