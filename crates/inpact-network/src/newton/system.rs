//! One field of Newton's iteration: its network in relative unknowns, and its state at given jumps.

use crate::assembly::{Capacities, HeatTerm, RowTerms, network};
use crate::knowledge::Knowledge;
use crate::linear::{
    Balance, Core, DeadEnds, Edges, Form, LinearNetwork, LinearSolution, NONE, Origins, Series, index, largest_or_nan,
};
use crate::problem::FieldNodes;
use crate::scene::{Field, SceneInterface};
use inpact_evaluation::numbers::{DoubleDouble, scale_by_power};

/// One field.
pub(super) struct System<'a> {
    pub(super) field: Field,
    pub(super) nodes: &'a FieldNodes,
    pub(super) core: Core,
    pub(super) origins: Origins,
    pub(super) edges: Edges,
    pub(super) jumps: Vec<DoubleDouble>,
    /// The offset of its unknowns among those of all fields.
    pub(super) start: u32,
}

/// A field at some state.
pub(super) struct Evaluated {
    pub(super) terms: RowTerms,
    pub(super) heat: Vec<HeatTerm>,
    pub(super) balance: Balance,
    /// Flows through links, then rows, of the field.
    pub(super) flows: Vec<DoubleDouble>,
}

impl<'a> System<'a> {
    pub(super) fn new(
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
        // Nodes with state-dependent conductances or sources must stay.
        let mut stays = vec![false; core.free as usize];
        let scene = knowledge.problem.scene;
        let ends = scene.interfaces.iter().flat_map(SceneInterface::nodes);
        let heated = scene.links.iter().filter(|link| link.joule_heat_fraction > 0.0).flat_map(|link| link.nodes);
        for node in ends.chain(heated) {
            let place = nodes.place[node as usize];
            if place != NONE
                && let Some(stays) = stays.get_mut(origins.number[place as usize] as usize)
            {
                *stays = true;
            }
        }
        let sources = crate::assembly::sources(knowledge, field, nodes);
        for (place, source) in sources.iter().enumerate() {
            if let Some(stays) = stays.get_mut(origins.number[place] as usize) {
                *stays |= *source != 0.0;
            }
        }
        let series = Series::take_out(&mut core, &DeadEnds::default(), &|node| stays[node as usize]);
        let form = Form::choose(&core, &series.is_there, &series.is_free);
        let edges = Edges::new(&core, form, &series.is_there);
        let mut system = Self { field, nodes, core, origins, edges, jumps: Vec::new(), start };
        system.jumps = system.jumps_of(solution, rows, &network);
        Some(system)
    }

    /// The jumps along the forest of a solution: from the flows where a conductance determines them, otherwise from the values.
    pub(super) fn jumps_of(
        &self,
        solution: &LinearSolution,
        rows: &[f64],
        network: &LinearNetwork,
    ) -> Vec<DoubleDouble> {
        let mut jump_of_element = vec![None; self.core.elements.len()];
        let links = self.nodes.links.len();
        for (link, &element) in self.origins.of_link.iter().enumerate().filter(|(_, element)| **element != NONE) {
            let conductance = link.checked_sub(links).map_or(network.links[link].conductance, |row| rows[row]);
            if conductance > 0.0 {
                jump_of_element[element as usize] = Some(solution.flows[link] / DoubleDouble::new(conductance));
            }
        }
        let mut value_of_number = vec![DoubleDouble::ZERO; self.core.free as usize];
        for (&number, &value) in self.origins.number.iter().zip(&solution.values) {
            if let Some(place) = value_of_number.get_mut(number as usize) {
                *place = value;
            }
        }
        let value = |number: u32| self.core.value(&value_of_number, number);
        let form = &self.edges.form;
        let jump = |unknown: u32| {
            let number = form.branches[unknown as usize];
            let element = self.core.elements[number as usize];
            let along =
                jump_of_element[number as usize].unwrap_or_else(|| value(element.ends[0]) - value(element.ends[1]));
            let is_first = element.ends[0] == form.nodes[unknown as usize];
            (if is_first { along } else { -along }).times_power_of_two(form.scale(unknown))
        };
        (0..index(form.count())).map(jump).collect()
    }

    /// Half the scaling exponent of an unknown.
    pub(super) fn half(&self, unknown: u32) -> i32 {
        self.edges.form.scale(unknown) / 2
    }

    /// Updates temperatures or pore pressures from the jumps.
    pub(super) fn tell(&self, knowledge: &mut Knowledge<'_>) {
        let known = match self.field {
            Field::Potential => return,
            Field::Temperature => &mut knowledge.temperatures,
            Field::PorePressure => &mut knowledge.pore_pressures,
        };
        let values = self.values();
        let form = &self.edges.form;
        for (&node, &number) in self.nodes.nodes.iter().zip(&self.origins.number) {
            if !self.core.is_free(number) {
                known[node as usize] = self.core.known[(number - self.core.free) as usize];
            } else if form.of_node[number as usize] != NONE {
                known[node as usize] = values[number as usize];
            }
        }
    }

    /// Sets conductances of rows and sources.
    pub(super) fn set(&mut self, rows: &[f64], sources: &[f64]) {
        let links = self.nodes.links.len();
        for (&element, &conductance) in self.origins.of_link[links..].iter().zip(rows) {
            if element != NONE {
                self.core.elements[element as usize].conductance = DoubleDouble::new(conductance);
            }
        }
        self.core.sources.fill(DoubleDouble::ZERO);
        for (&number, &source) in self.origins.number.iter().zip(sources) {
            if let Some(sum) = self.core.sources.get_mut(number as usize) {
                *sum += DoubleDouble::new(source);
            }
        }
    }

    pub(super) fn balance(&self) -> Balance {
        let mut balance = Balance::default();
        let sources = self.edges.sources(&self.core);
        self.edges.balance(&self.core, &self.jumps, &sources, &mut balance);
        balance
    }

    /// The flows of the field's links and rows; zero for links whose nodes are eliminated.
    pub(super) fn flows(&self, balance: &Balance) -> Vec<DoubleDouble> {
        let flow = |&element: &u32| if element == NONE { DoubleDouble::ZERO } else { balance.flows[element as usize] };
        self.origins.of_link.iter().map(flow).collect()
    }

    /// The largest residual of a balance, relative to the flow there if every jump were as large as the field.
    ///
    /// This measures the effect of rounding of the field on a balance: it is met when no better values are possible.
    /// A body without flow is judged by its conductances like any other.
    pub(super) fn worst(&self, state: &Evaluated) -> f64 {
        let form = &self.edges.form;
        let size = self.size();
        let mut scales = vec![0.0; form.count()];
        for &number in &self.edges.elements {
            let element = &self.core.elements[number as usize];
            let flow = (element.conductance.to_f64() * size).min(f64::MAX);
            form.on_way(form.ends(&self.core, element), |unknown, _| scales[unknown as usize] += flow);
        }
        let shares = state.balance.missing().zip(scales.iter().zip(&state.balance.magnitudes)).map(
            |(missing, (scale, magnitude))| if missing == 0.0 { 0.0 } else { missing.abs() / scale.max(*magnitude) },
        );
        largest_or_nan(shares)
    }

    /// The largest magnitude of a field; for potentials, which matter only through their jumps, the largest jump.
    fn size(&self) -> f64 {
        let form = &self.edges.form;
        let jumps = (0..).zip(&self.jumps).map(|(unknown, jump)| jump.times_power_of_two(-form.scale(unknown)));
        let largest = |size: f64, value: DoubleDouble| size.max(value.to_f64().abs());
        let of_jumps = jumps.fold(0.0, largest);
        if self.field == Field::Potential {
            return of_jumps;
        }
        self.values().into_iter().chain(self.core.known.iter().copied()).fold(of_jumps, largest)
    }

    /// The largest residual, relative to the largest flow, and its node of the scene.
    pub(super) fn worst_node(&self, state: &Evaluated) -> (f64, u32) {
        let largest = state.balance.magnitudes.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        let missing = (0_usize..).zip(state.balance.missing().map(f64::abs));
        let Some((unknown, worst)) = missing.max_by(|a, b| a.1.total_cmp(&b.1)) else { return (0.0, NONE) };
        let number = self.edges.form.nodes[unknown];
        let place = self.origins.number.iter().position(|&of| of == number);
        (worst / largest, place.map_or(NONE, |place| self.nodes.nodes[place]))
    }

    /// The magnitude of the flows of its equations, on the scale of the matrix.
    pub(super) fn unit(&self, state: &Evaluated) -> f64 {
        let scaled =
            (0..).zip(&state.balance.magnitudes).map(|(unknown, &flow)| scale_by_power(flow, -self.half(unknown)));
        let unit = scaled.fold(0.0, f64::max);
        if unit > 0.0 && unit.is_finite() { unit } else { 1.0 }
    }

    /// The sum of squares of the residuals in parts of `unit`.
    pub(super) fn merit(&self, state: &Evaluated, unit: f64) -> f64 {
        let scaled =
            (0..).zip(state.balance.missing()).map(|(unknown, flow)| scale_by_power(flow, -self.half(unknown)) / unit);
        scaled.map(|share| share * share).sum()
    }

    /// Moves from `jumps` by a fraction along a direction of all fields.
    pub(super) fn go(&mut self, jumps: &[DoubleDouble], direction: &[f64], part: f64) {
        let form = &self.edges.form;
        let changes: Vec<f64> = (0..index(form.count()))
            .map(|unknown| {
                let change = direction[(self.start + unknown) as usize];
                part * scale_by_power(change, self.half(unknown))
            })
            .collect();
        let changes = self.edges.changes_of_jumps(&changes);
        self.jumps = jumps.iter().zip(changes).map(|(jump, change)| *jump + DoubleDouble::new(change)).collect();
    }

    /// The values of the nodes of its core.
    pub(super) fn values(&self) -> Vec<DoubleDouble> {
        self.edges.values(&self.core, &self.jumps)
    }

    /// The jump of these values between two nodes of the scene.
    pub(super) fn jump_of_values(&self, values: &[DoubleDouble], slave: u32, master: u32) -> f64 {
        let value = |node: u32| {
            let number = self.origins.number[self.nodes.place[node as usize] as usize];
            self.core.value(values, number)
        };
        (value(slave) - value(master)).to_f64()
    }

    /// Calls `take` with the row of each equation that the flow of an element is part of, and the factor it has there on the scale of the matrix.
    pub(super) fn on_element(&self, element: u32, mut take: impl FnMut(u32, f64)) {
        let ends = self.edges.form.ends(&self.core, &self.core.elements[element as usize]);
        self.edges.form.on_way(ends, |unknown, sign| {
            take(self.start + unknown, scale_by_power(sign, -self.half(unknown)));
        });
    }

    /// Calls `take` with the column of each unknown in the jump of an element, and the factor from a slope along the jump to one along the unknown.
    pub(super) fn on_jump(&self, element: u32, mut take: impl FnMut(u32, &dyn Fn(f64) -> f64)) {
        let ends = self.edges.form.ends(&self.core, &self.core.elements[element as usize]);
        self.edges.form.on_way(ends, |unknown, sign| {
            let half = self.half(unknown);
            take(self.start + unknown, &|slope| scale_by_power(sign * slope, -half));
        });
    }

    /// The same for the value of a node of the scene.
    pub(super) fn on_value(&self, node: u32, take: impl FnMut(u32, &dyn Fn(f64) -> f64)) {
        let place = self.nodes.place[node as usize];
        if place != NONE {
            self.on_place(place, take);
        }
    }

    /// The same for the value of a node of the field; its balance is in the same equations, with the same factors.
    pub(super) fn on_place(&self, place: u32, mut take: impl FnMut(u32, &dyn Fn(f64) -> f64)) {
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
