//! Flows and balances in edge form: differences first, then conductances, then sums.
//!
//! The balance of a node from an assembled diagonal, s x − Σ c x', loses the digits that the strongest conductance rounds away;
//! Σ c (x − x') does not. Jumps and flows are kept in 106 bits, so that refinement is not limited by the rounding of f64.

use super::core::{Core, NONE, ROUNDING};
use super::largest::largest_or_nan;
use super::relative::Form;
use super::sets::index;
use super::spanning_forest::SpanningForest;
use inpact_evaluation::numbers::{DoubleDouble, exponent_of, scale_by_power};

/// The elements of a core in terms of the unknowns; conductances may change, the topology may not.
#[derive(Clone, Debug)]
pub(crate) struct Edges {
    pub(crate) form: Form,
    /// The remaining elements.
    pub(crate) elements: Vec<u32>,
    /// The jumps along the forest between the ends of each of them, where there are not too many.
    ways: Option<Ways>,
}

/// For each remaining element, the unknowns whose jumps add up to its own, and their signs.
#[derive(Clone, Debug)]
struct Ways {
    start: Vec<u32>,
    steps: Vec<(u32, bool)>,
}

/// Paths along the forest are stored up to this average number of steps per element.
const STEPS_OF_AN_ELEMENT: usize = 16;

/// Networks with more elements have too many paths; small ones store them whatever their length.
const MAX_ELEMENTS: usize = 1 << 16;

/// Steps that are stored in any case.
const LEAST_STEPS: usize = 1 << 16;

/// Absolute rounding error of the smallest numbers, whose low part underflows.
const LEAST: f64 = f64::MIN_POSITIVE / (1_u64 << 46) as f64;

/// The flows at a state and their residuals.
#[derive(Clone, Debug, Default)]
pub(crate) struct Balance {
    /// The flow from the first to the second end of each element of the core; zero for eliminated ones.
    pub(crate) flows: Vec<DoubleDouble>,
    /// The residual of the equation of each unknown.
    pub(crate) residuals: Vec<DoubleDouble>,
    /// The sum of magnitudes of all flows in the equation of each unknown.
    pub(crate) magnitudes: Vec<f64>,
    /// A bound of the rounding error of each flow.
    pub(crate) roundings: Vec<f64>,
    /// A bound of the rounding error of each residual.
    rounding_of_residuals: Vec<f64>,
}

impl Edges {
    pub(crate) fn new(core: &Core, form: Form, is_there: &[bool]) -> Self {
        let elements: Vec<u32> = (0..core.elements.len()).filter(|&element| is_there[element]).map(index).collect();
        let ways = Ways::of(core, &form, &elements);
        Self { form, elements, ways }
    }

    /// The sum of the sources of all nodes below each unknown in the forest, itself included.
    pub(crate) fn sources(&self, core: &Core) -> Vec<DoubleDouble> {
        let form = &self.form;
        let mut sources: Vec<DoubleDouble> = form.nodes.iter().map(|&node| core.sources[node as usize]).collect();
        for &unknown in form.order.iter().rev() {
            let top = form.tops[unknown as usize];
            if top != NONE {
                let own = sources[unknown as usize];
                sources[top as usize] += own;
            }
        }
        sources
    }

    /// The unknowns that belong to jumps along the forest: each the sum of the jumps on the path to its top.
    fn unknowns(&self, jumps: &[DoubleDouble]) -> Vec<DoubleDouble> {
        let form = &self.form;
        let mut unknowns = vec![DoubleDouble::ZERO; form.count()];
        for &unknown in &form.order {
            let top = form.tops[unknown as usize];
            let scale = form.scale(unknown);
            let mut sum = jumps[unknown as usize];
            let mut at = form.parents[unknown as usize];
            while at != top {
                sum += unknowns[at as usize].times_power_of_two(scale - form.scale(at));
                at = form.tops[at as usize];
            }
            unknowns[unknown as usize] = sum;
        }
        unknowns
    }

    /// The flows at `jumps` along the forest, and how they balance with `sources`, which are those of [`Self::sources`].
    pub(crate) fn balance(&self, core: &Core, jumps: &[DoubleDouble], sources: &[DoubleDouble], balance: &mut Balance) {
        let form = &self.form;
        let unknowns = if self.ways.is_some() { Vec::new() } else { self.unknowns(jumps) };
        balance.reset(core.elements.len(), sources);
        for (place, &number) in self.elements.iter().enumerate() {
            let element = &core.elements[number as usize];
            let ends = form.ends(core, element);
            let (flow, rounding) = if let Some(child) = self.child_of(number, ends) {
                // Along the forest the jump is stored directly.
                let conductance = element.conductance.times_power_of_two(-form.scale(child));
                let flow = jumps[child as usize] * conductance;
                (if child == ends[0] { flow } else { -flow }, ROUNDING * flow.to_f64().abs())
            } else {
                let strength = exponent_of(element.conductance.to_f64());
                let (mut jump, mut parts) = (DoubleDouble::ZERO, 0.0);
                let mut add = |part: DoubleDouble, is_opposite: bool| {
                    jump += if is_opposite { -part } else { part };
                    parts += part.to_f64().abs();
                };
                let part = |of: &[DoubleDouble], unknown: u32| {
                    of[unknown as usize].times_power_of_two(strength - form.scale(unknown))
                };
                match &self.ways {
                    Some(ways) => ways
                        .of_element(place)
                        .iter()
                        .for_each(|&(step, is_opposite)| add(part(jumps, step), is_opposite)),
                    None => form.on_way(ends, |unknown, sign| add(part(&unknowns, unknown), sign < 0.0)),
                }
                let conductance = element.conductance.times_power_of_two(-strength);
                let (mut flow, mut rounding) = (jump * conductance, ROUNDING * parts * conductance.to_f64());
                let step = form.base_of(core, element.ends[0]) - form.base_of(core, element.ends[1]);
                if !step.is_zero() {
                    let of_step = step * element.conductance;
                    flow += of_step;
                    rounding += ROUNDING * of_step.to_f64().abs();
                }
                (flow, rounding)
            };
            balance.flows[number as usize] = flow;
            balance.roundings[number as usize] = rounding;
            let magnitude = flow.to_f64().abs();
            form.on_way(ends, |unknown, sign| {
                let unknown = unknown as usize;
                balance.residuals[unknown] += if sign < 0.0 { flow } else { -flow };
                balance.magnitudes[unknown] += magnitude;
                balance.rounding_of_residuals[unknown] += rounding + LEAST;
            });
        }
    }

    /// The unknown whose branch is an element with these ends, if there is one.
    fn child_of(&self, element: u32, ends: [u32; 2]) -> Option<u32> {
        ends.into_iter().find(|&end| end != NONE && self.form.branches[end as usize] == element)
    }

    /// The change of the jump along the forest of each unknown when the unknowns change by `changes`.
    pub(crate) fn changes_of_jumps(&self, changes: &[f64]) -> Vec<f64> {
        let form = &self.form;
        let change = |unknown: u32| {
            let scale = form.scale(unknown);
            let mut sum = 0.0;
            form.on_way([unknown, form.parents[unknown as usize]], |on_way, sign| {
                sum += sign * scale_by_power(changes[on_way as usize], scale - form.scale(on_way));
            });
            sum
        };
        (0..index(form.count())).map(change).collect()
    }

    /// The largest relative change of a flow when the unknowns change by `changes`; flows at their rounding count with their accuracy.
    pub(crate) fn change_of_flows(&self, core: &Core, balance: &Balance, changes: &[f64]) -> f64 {
        self.largest_change(core, balance, |unknown, sign| sign * changes[unknown])
    }

    /// The same when each unknown changes by the residual of its equation, in the worst direction for each flow.
    pub(crate) fn missing_in_flows(&self, core: &Core, balance: &Balance) -> f64 {
        let missing: Vec<f64> = balance.missing().map(f64::abs).collect();
        self.largest_change(core, balance, |unknown, _| missing[unknown])
    }

    fn largest_change(&self, core: &Core, balance: &Balance, change_of: impl Fn(usize, f64) -> f64) -> f64 {
        let relative_change = |number: u32| {
            let element = &core.elements[number as usize];
            let conductance = element.conductance.to_f64();
            let mut change = 0.0;
            self.form.on_way(self.form.ends(core, element), |unknown, sign| {
                change += scale_by_power(conductance, -self.form.scale(unknown)) * change_of(unknown as usize, sign);
            });
            if change == 0.0 {
                return 0.0;
            }
            let flow = balance.flows[number as usize].to_f64().abs();
            change.abs() / flow.max(balance.roundings[number as usize] / f64::EPSILON)
        };
        self.elements.iter().map(|&number| relative_change(number)).fold(0.0, f64::max)
    }

    /// Sets flows below their rounding to zero, and returns the largest relative rounding error of the others.
    ///
    /// The flow along the forest is the sum of those below, so its accuracy is that of the balances there: below 106 bits where large flows nearly cancel.
    /// The uncertainty of other flows is that of their jumps along the forest. Solving has amplified it by up to the condition number of the matrix.
    /// Where there are too many paths to be stored, only the flows' own rounding is used, and zeros may remain as some 1e-30 of the surrounding flows.
    pub(crate) fn settle(&self, core: &Core, condition: f64, balance: &mut Balance) -> f64 {
        let Some(ways) = &self.ways else { return self.settle_without_ways(core, condition, balance) };
        let steps = self.open_steps(core, condition, balance);
        let mut largest = 0.0_f64;
        for (place, &number) in self.elements.iter().enumerate() {
            let conductance = core.elements[number as usize].conductance.to_f64();
            let of_step =
                |&(step, _): &(u32, bool)| scale_by_power(conductance, -self.form.scale(step)) * steps[step as usize];
            let of_steps: f64 = ways.of_element(place).iter().map(of_step).sum();
            let open = balance.roundings[number as usize] + of_steps;
            let flow = &mut balance.flows[number as usize];
            let magnitude = flow.to_f64().abs();
            if magnitude <= open {
                *flow = DoubleDouble::ZERO;
            } else {
                largest = largest.max(open / magnitude);
            }
        }
        largest
    }

    /// The same where paths are too long to be stored: the uncertainty of both paths to known values together is an upper bound.
    ///
    /// Only their own rounding sets them to zero.
    fn settle_without_ways(&self, core: &Core, condition: f64, balance: &mut Balance) -> f64 {
        let form = &self.form;
        let mut to_base = self.open_steps(core, condition, balance);
        for &unknown in &form.order {
            let parent = form.parents[unknown as usize];
            to_base[unknown as usize] = scale_by_power(to_base[unknown as usize], -form.scale(unknown));
            if parent != NONE {
                to_base[unknown as usize] += to_base[parent as usize];
            }
        }
        let mut largest = 0.0_f64;
        for &number in &self.elements {
            let element = &core.elements[number as usize];
            let ends = form.ends(core, element).into_iter().filter(|end| *end != NONE);
            let of_steps = element.conductance.to_f64() * ends.map(|end| to_base[end as usize]).sum::<f64>();
            let rounding = balance.roundings[number as usize];
            let flow = &mut balance.flows[number as usize];
            let magnitude = flow.to_f64().abs();
            if magnitude <= rounding {
                *flow = DoubleDouble::ZERO;
            } else if rounding + of_steps < magnitude {
                largest = largest.max((rounding + of_steps) / magnitude);
            }
        }
        largest
    }

    /// A bound of the error of each jump along the forest from rounding.
    fn open_steps(&self, core: &Core, condition: f64, balance: &Balance) -> Vec<f64> {
        let form = &self.form;
        let mut open: Vec<f64> = balance.rounding_of_residuals.iter().map(|rounding| condition * rounding).collect();
        for &unknown in form.order.iter().rev() {
            let parent = form.parents[unknown as usize];
            if parent != NONE {
                open[parent as usize] += open[unknown as usize];
            }
        }
        for (unknown, open) in (0..).zip(&mut open) {
            let element = &core.elements[form.branches[unknown as usize] as usize];
            *open /= scale_by_power(element.conductance.to_f64(), -form.scale(unknown));
        }
        open
    }

    /// The forest by nodes of the core.
    pub(super) fn spanning_forest(&self, core: &Core, jumps: &[DoubleDouble]) -> SpanningForest {
        let form = &self.form;
        let mut forest = SpanningForest::new(core);
        for &unknown in &form.order {
            let parent = match form.parents[unknown as usize] {
                NONE => form.bases[unknown as usize],
                parent => form.nodes[parent as usize],
            };
            let step = jumps[unknown as usize].times_power_of_two(-form.scale(unknown));
            forest.attach(form.nodes[unknown as usize], parent, step);
        }
        forest
    }

    /// The values of the nodes, zero at eliminated ones.
    pub(crate) fn values(&self, core: &Core, jumps: &[DoubleDouble]) -> Vec<DoubleDouble> {
        let form = &self.form;
        // Jumps are summed before adding the known value, compared with which they may be small.
        let mut sums = vec![DoubleDouble::ZERO; form.count()];
        let mut values = vec![DoubleDouble::ZERO; core.free as usize];
        for &unknown in &form.order {
            let jump = jumps[unknown as usize].times_power_of_two(-form.scale(unknown));
            let sum = match form.parents[unknown as usize] {
                NONE => jump,
                parent => sums[parent as usize] + jump,
            };
            sums[unknown as usize] = sum;
            let base = core.known[(form.bases[unknown as usize] - core.free) as usize];
            values[form.nodes[unknown as usize] as usize] = base + sum;
        }
        values
    }
}

impl Balance {
    /// The residual of each equation; zero where it is within rounding.
    pub(crate) fn missing(&self) -> impl Iterator<Item = f64> {
        self.residuals.iter().zip(&self.rounding_of_residuals).map(|(residual, &rounding)| {
            let missing = residual.to_f64();
            if missing.abs() <= rounding { 0.0 } else { missing }
        })
    }

    /// The largest residual of an equation relative to its flows; NaN or infinite where a flow is.
    pub(crate) fn worst_share(&self) -> f64 {
        let shares = self
            .missing()
            .zip(&self.magnitudes)
            .map(|(missing, &magnitude)| if missing == 0.0 { 0.0 } else { missing.abs() / magnitude });
        largest_or_nan(shares)
    }

    fn reset(&mut self, elements: usize, sources: &[DoubleDouble]) {
        self.flows.clear();
        self.flows.resize(elements, DoubleDouble::ZERO);
        self.roundings.clear();
        self.roundings.resize(elements, 0.0);
        self.residuals.clear();
        self.residuals.extend_from_slice(sources);
        self.magnitudes.clear();
        self.magnitudes.extend(sources.iter().map(|source| source.to_f64().abs()));
        self.rounding_of_residuals.clear();
        self.rounding_of_residuals.extend(self.magnitudes.iter().map(|magnitude| ROUNDING * magnitude));
    }
}

impl Ways {
    /// The paths of some elements; `None` where they are too long to be stored.
    fn of(core: &Core, form: &Form, elements: &[u32]) -> Option<Self> {
        if elements.len() > MAX_ELEMENTS {
            return None;
        }
        let most = (STEPS_OF_AN_ELEMENT * elements.len()).max(LEAST_STEPS);
        let mut depths = vec![0_u32; form.count()];
        for &unknown in &form.order {
            let parent = form.parents[unknown as usize];
            depths[unknown as usize] = if parent == NONE { 1 } else { depths[parent as usize] + 1 };
        }
        let depth = |unknown: u32| if unknown == NONE { 0 } else { depths[unknown as usize] };
        let (mut start, mut steps) = (vec![0], Vec::new());
        for &number in elements {
            let [mut first, mut second] = form.ends(core, &core.elements[number as usize]);
            while first != second {
                let (of_first, of_second) = (depth(first), depth(second));
                if of_first >= of_second {
                    steps.push((first, false));
                    first = form.parents[first as usize];
                }
                if of_second >= of_first {
                    steps.push((second, true));
                    second = form.parents[second as usize];
                }
            }
            if steps.len() > most {
                return None;
            }
            start.push(index(steps.len()));
        }
        Some(Self { start, steps })
    }

    fn of_element(&self, place: usize) -> &[(u32, bool)] {
        &self.steps[self.start[place] as usize..self.start[place + 1] as usize]
    }
}
