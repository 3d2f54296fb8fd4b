//! From a linear network to its solution: what can be left out is left out, the rest is factored, refined and checked, and what was left out is put back.

use super::components::refuse_floating;
use super::core::{Core, NONE, Origins};
use super::dead_ends::DeadEnds;
use super::edges::{Balance, Edges};
use super::elimination::eliminate;
use super::factor::{Factor, NoSolution, Solves};
use super::infinite;
use super::iterative::ConjugateGradients;
use super::largest::largest_or_nan;
use super::matrix::Pattern;
use super::network::{LinearNetwork, Link, Unsolvable};
use super::ordering::{Analysis, Ordering};
use super::refinement::{GaveUp, Quality, Refined, refine};
use super::relative::Form;
use super::series::Series;
use super::sets::index;
use super::spanning_forest::SpanningForest;
use super::symbolic::Reused;
use super::work::{Phases, Work};
use inpact_evaluation::numbers::DoubleDouble;
use std::sync::Arc;
use std::time::Instant;

/// Methods of solving a network.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Method {
    /// A Cholesky factor in f64.
    #[default]
    Direct,
    /// A Cholesky factor in f32: half the memory and, in three dimensions, about half the time.
    Mixed,
    /// Conjugate gradients with an incomplete factor: memory of a few entries a node.
    Iterative,
    /// Elimination without subtraction in 106 bits: slow, and exact at any contrast but where a jump leaves the range of f64 or steps of both signs nearly cancel, which it refuses.
    Elimination,
}

/// Flows up to this have lost digits to the range of f64.
pub(super) const SMALL: f64 = f64::MIN_POSITIVE / f64::EPSILON / f64::EPSILON;

/// The tolerance of the last digit of f64.
pub const LAST_DIGIT: f64 = f64::EPSILON / 16.0;

/// Solves networks, and keeps what the next one can use again: the order of elimination as long as the same unknowns are coupled, the factor as long as the matrix is the same.
#[derive(Debug)]
pub struct Solver {
    method: Method,
    tolerance: f64,
    kept: Option<Kept>,
    work: Work,
}

/// State kept from one network to the next.
#[derive(Debug)]
struct Kept {
    pattern: Arc<Pattern>,
    analysis: Option<Arc<Analysis>>,
    factor: KeptFactor,
}

/// Factors of the matrix with these values.
#[derive(Debug, Default)]
struct KeptFactor {
    values: Vec<f64>,
    double: Option<Factor<f64>>,
    single: Option<Factor<f32>>,
}

/// The solution of a linear network.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearSolution {
    /// The value of each node.
    pub values: Vec<DoubleDouble>,
    /// The flow through each link, from its first to its second node.
    pub flows: Vec<DoubleDouble>,
    /// The flow into each store.
    pub stored: Vec<DoubleDouble>,
    /// The links whose flow does not determine the jump, ascending, and the jump across each.
    undetermined: Vec<(u32, DoubleDouble)>,
    /// Method, size and quality of the solution.
    pub report: LinearReport,
}

impl LinearSolution {
    /// The jump across a link of the network that was solved, its first node less its second, with all its digits: no difference of values.
    pub fn jump(&self, network: &LinearNetwork, link: usize) -> DoubleDouble {
        self.jump_at(link, network.links[link].conductance)
    }

    /// Whether all of it is in the range of f64.
    fn is_finite(&self) -> bool {
        let all = self.values.iter().chain(&self.flows).chain(&self.stored);
        all.into_iter().all(|number| number.to_f64().is_finite())
    }

    /// The jump across a link of this conductance.
    pub(crate) fn jump_at(&self, link: usize, conductance: f64) -> DoubleDouble {
        if conductance == f64::INFINITY {
            return DoubleDouble::ZERO;
        }
        match self.undetermined.binary_search_by_key(&index(link), |(number, _)| *number) {
            Ok(place) => self.undetermined[place].1,
            Err(_) => self.flows[link] / DoubleDouble::new(conductance),
        }
    }
}

/// Method, size and quality of a solution.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct LinearReport {
    /// The method that gave it.
    pub method: Method,
    /// The relative error of a flow that is permitted.
    pub tolerance: f64,
    /// The number of unknowns.
    pub unknowns: usize,
    /// The number of unknowns that are jumps from another node.
    pub relative: usize,
    /// In how many levels the strengths of the conductances fall.
    pub levels: usize,
    /// The number of nodes that share the value of another by an infinite conductance.
    pub merged: usize,
    /// The number of nodes eliminated in series: they only pass on the flow.
    pub taken_out: usize,
    /// The number of nodes in dead ends: no flow reaches them, and they have the value of another.
    pub dead_ends: usize,
    /// The number of infinite conductances beyond those that determine the shares of their flow; they share it as equal ones would.
    pub shared: usize,
    /// The order of elimination, where there was a factor.
    pub ordering: Option<Ordering>,
    /// Entries of the factor.
    pub factor_entries: usize,
    /// Results of a network before that were used again.
    pub reused: Reused,
    /// Iterations of conjugate gradients.
    pub iterations: usize,
    /// Residual and estimated error; an elimination has no estimate.
    pub quality: Quality,
    /// The methods that were tried before, and why they were given up.
    pub given_up: Vec<(Method, Shortcoming)>,
    /// Time of each phase.
    pub phases: Phases,
}

/// Reasons why a method was given up.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Shortcoming {
    /// It could not begin.
    NoSolution(NoSolution),
    /// It came no nearer than this.
    Stalled(Quality),
    /// A flow is beyond the range of f64, or what a rough factor made of it.
    Overflow,
    /// The filled network would be too large.
    TooLarge,
}

/// Reasons why a network has no solution.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum LinearFailure {
    /// It has none, or more than one.
    Unsolvable(Unsolvable),
    /// No method came within the tolerance.
    NotSolved(Vec<(Method, Shortcoming)>),
}

/// The solution of a core: values of its free nodes, flows of its elements.
pub(super) struct CoreFound {
    pub(super) values: Vec<DoubleDouble>,
    pub(super) flows: Vec<DoubleDouble>,
    /// The spanning forest with its steps; an elimination has none.
    pub(super) forest: Option<SpanningForest>,
}

impl Solver {
    /// A solver with this method whose estimated relative error of every flow is at most `tolerance`; [`LAST_DIGIT`] is the best that f64 can hold.
    pub fn new(method: Method, tolerance: f64) -> Self {
        Self { method, tolerance, kept: None, work: Work::default() }
    }

    /// The same, with an order of elimination that is known.
    pub(super) fn with_order(
        method: Method,
        tolerance: f64,
        (pattern, analysis): (Arc<Pattern>, Arc<Analysis>),
    ) -> Self {
        let kept = Kept { pattern, analysis: Some(analysis), factor: KeptFactor::default() };
        Self { kept: Some(kept), ..Self::new(method, tolerance) }
    }

    /// The tolerance.
    pub(crate) fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// Sets another tolerance; gives the one before.
    pub(crate) fn set_tolerance(&mut self, tolerance: f64) -> f64 {
        std::mem::replace(&mut self.tolerance, tolerance)
    }

    /// Lets the factor of the last network go, and keeps its order, if it has one.
    pub(crate) fn release_factor(&mut self) {
        self.kept = self.kept.take().filter(|kept| kept.analysis.is_some());
        if let Some(kept) = &mut self.kept {
            kept.factor = KeptFactor::default();
        }
    }

    /// The chosen method.
    pub(crate) fn method(&self) -> Method {
        self.method
    }

    /// Total work of all networks solved so far.
    pub fn work(&self) -> Work {
        self.work
    }

    /// Solves a network.
    ///
    /// # Errors
    /// See [`LinearFailure`].
    pub fn solve(&mut self, network: &LinearNetwork) -> Result<LinearSolution, LinearFailure> {
        let start = Instant::now();
        refuse_floating(network).map_err(LinearFailure::Unsolvable)?;
        let (core, origins) = Core::merged(network, &|_| false).map_err(LinearFailure::Unsolvable)?;
        let mut core = core;
        let (found, mut report) = self.solve_core(&mut core)?;
        report.merged = origins.merged;
        let Phases { order, factor, solve, .. } = report.phases;
        report.phases.set_up = start.elapsed().as_secs_f64() - order - factor - solve;
        self.work += Work::of(&report);
        let method = report.method;
        let overflow = || LinearFailure::NotSolved(vec![(method, Shortcoming::Overflow)]);
        let mut solution = put_together(network, &core, &origins, found, report);
        if !solution.is_finite() {
            return Err(overflow());
        }
        if origins.merged > 0 {
            infinite::find_flows(network, &mut solution)?;
            if !solution.is_finite() {
                return Err(overflow());
            }
        }
        Ok(solution)
    }

    /// Solves a core, in which all conductances are finite and every node has a path to a known value.
    pub(super) fn solve_core(&mut self, core: &mut Core) -> Result<(CoreFound, LinearReport), LinearFailure> {
        let dead_ends = DeadEnds::find(core);
        let series = Series::take_out(core, &dead_ends, &|_| false);
        let form = Form::choose(core, &series.is_there, &series.is_free);
        let mut report = LinearReport {
            unknowns: form.count(),
            relative: form.relative(),
            levels: form.scales.len(),
            taken_out: series.count(),
            dead_ends: dead_ends.count(),
            tolerance: self.tolerance,
            ..LinearReport::default()
        };
        let mut found = self.solve_form(core, &series, form, &mut report)?;
        series.put_back(core, &mut found);
        dead_ends.put_back(core, &mut found);
        Ok((found, report))
    }

    /// Solves for the unknowns, by the chosen method and, where that falls short, by safer ones.
    fn solve_form(
        &mut self,
        core: &Core,
        series: &Series,
        form: Form,
        report: &mut LinearReport,
    ) -> Result<CoreFound, LinearFailure> {
        let edges = Edges::new(core, form, &series.is_there);
        let mut method = self.method;
        loop {
            let shortcoming = match self.attempt(method, core, &edges, series, report) {
                Ok(found) => {
                    report.method = method;
                    return Ok(found);
                }
                Err(shortcoming) => shortcoming,
            };
            report.given_up.push((method, shortcoming));
            method = match (method, shortcoming) {
                (Method::Direct, Shortcoming::Overflow) | (Method::Elimination, _) => {
                    return Err(LinearFailure::NotSolved(std::mem::take(&mut report.given_up)));
                }
                (Method::Direct, _) => Method::Elimination,
                // A rough factor may have left the range of numbers by itself, that of f32 before all.
                (Method::Mixed | Method::Iterative, _) => Method::Direct,
            };
        }
    }

    fn attempt(
        &mut self,
        method: Method,
        core: &Core,
        edges: &Edges,
        series: &Series,
        report: &mut LinearReport,
    ) -> Result<CoreFound, Shortcoming> {
        if method == Method::Elimination {
            let found = eliminate(core, &series.is_there, &series.is_free).ok_or(Shortcoming::TooLarge)?;
            let residual = worst_share(core, series, &found.flows);
            report.quality = Quality { residual, ..Quality::default() };
            return match residual <= self.tolerance.max(f64::EPSILON) {
                true => Ok(CoreFound { values: found.values, flows: found.flows, forest: None }),
                false if residual.is_finite() => Err(Shortcoming::Stalled(report.quality)),
                false => Err(Shortcoming::Overflow),
            };
        }
        if edges.form.count() == 0 {
            let refined = refine(core, edges, &mut Nothing, self.tolerance)?;
            return Ok(found(core, edges, &refined.jumps, refined.balance));
        }
        let pattern = self.pattern(core, edges);
        let matrix = pattern.matrix(core, edges);
        let tolerance = self.tolerance;
        let refined = if method == Method::Iterative {
            let mut solver = ConjugateGradients::new(&matrix, tolerance);
            let solving = Instant::now();
            let refined = refine(core, edges, &mut solver, tolerance);
            report.iterations = solver.iterations;
            report.phases.solve += solving.elapsed().as_secs_f64();
            refined?
        } else {
            let Some(Kept { pattern, analysis, factor }) = &mut self.kept else {
                return Err(NoSolution::Memory.into());
            };
            let analysis = match analysis {
                Some(analysis) => {
                    report.reused = Reused::Order;
                    analysis
                }
                None => {
                    let ordering = Instant::now();
                    let made = Analysis::of(pattern.symbolic()).ok_or(NoSolution::Memory)?;
                    report.phases.order += ordering.elapsed().as_secs_f64();
                    analysis.insert(Arc::new(made))
                }
            };
            report.ordering = Some(analysis.ordering);
            report.factor_entries = analysis.entries();
            if factor.values != matrix.values {
                *factor = KeptFactor::default();
            }
            let KeptFactor { values, double, single } = factor;
            let has_factor = match method {
                Method::Mixed => single.is_some(),
                _ => double.is_some(),
            };
            if has_factor {
                report.reused = Reused::Factor;
            }
            let factoring = Instant::now();
            let solver: &mut dyn Solves = match method {
                Method::Mixed => get_or_try(single, || Factor::new(analysis, &matrix))?,
                _ => get_or_try(double, || Factor::new(analysis, &matrix))?,
            };
            report.phases.factor += factoring.elapsed().as_secs_f64();
            let solving = Instant::now();
            let refined = refine(core, edges, solver, tolerance);
            report.phases.solve += solving.elapsed().as_secs_f64();
            let refined = refined?;
            *values = matrix.values;
            refined
        };
        let Refined { jumps, balance, quality } = refined;
        report.quality = quality;
        Ok(found(core, edges, &jumps, balance))
    }

    /// The pattern of some edges with its analysis, those of the network before where they are the same.
    fn pattern(&mut self, core: &Core, edges: &Edges) -> Arc<Pattern> {
        let pattern = Pattern::of(core, edges);
        if let Some(kept) = &mut self.kept
            && kept.pattern.has_entries_of(pattern.symbolic())
        {
            // The parts may come in another order.
            kept.pattern = Arc::new(pattern);
            return Arc::clone(&kept.pattern);
        }
        let pattern = Arc::new(pattern);
        self.kept = Some(Kept { pattern: Arc::clone(&pattern), analysis: None, factor: KeptFactor::default() });
        pattern
    }
}

/// The largest share of its flows that is missing in the balance of a node; not finite where a flow is not.
fn worst_share(core: &Core, series: &Series, flows: &[DoubleDouble]) -> f64 {
    let mut missing = core.sources.clone();
    let mut magnitudes: Vec<f64> = core.sources.iter().map(|source| source.to_f64().abs()).collect();
    for (element, flow) in
        core.elements.iter().zip(flows).zip(&series.is_there).filter_map(|(of, there)| there.then_some(of))
    {
        for (end, leaving) in element.ends.into_iter().zip([*flow, -*flow]) {
            if core.is_free(end) {
                missing[end as usize] -= leaving;
                magnitudes[end as usize] += leaving.to_f64().abs();
            }
        }
    }
    let cells = missing.iter().zip(&magnitudes).zip(&series.is_free).filter_map(|(of, is_free)| is_free.then_some(of));
    let shares =
        cells.map(|(missing, magnitude)| if missing.is_zero() { 0.0 } else { missing.to_f64().abs() / magnitude });
    largest_or_nan(shares)
}

/// The content of `place`, made first where it is empty.
fn get_or_try<T>(place: &mut Option<T>, make: impl FnOnce() -> Result<T, NoSolution>) -> Result<&mut T, NoSolution> {
    if place.is_none() {
        *place = Some(make()?);
    }
    place.as_mut().ok_or(NoSolution::Memory)
}

/// Values and flows of the jumps along the forest.
fn found(core: &Core, edges: &Edges, jumps: &[DoubleDouble], balance: Balance) -> CoreFound {
    let forest = edges.spanning_forest(core, jumps);
    CoreFound { values: edges.values(core, jumps), flows: balance.flows, forest: Some(forest) }
}

/// The solution in terms of the network.
fn put_together(
    network: &LinearNetwork,
    core: &Core,
    origins: &Origins,
    found: CoreFound,
    report: LinearReport,
) -> LinearSolution {
    let CoreFound { values, flows, forest } = found;
    let flow_of = |&element: &u32| if element == NONE { DoubleDouble::ZERO } else { flows[element as usize] };
    let flows_of_links: Vec<DoubleDouble> = origins.of_link.iter().map(flow_of).collect();
    let determines_jump =
        |link: &Link, flow: &DoubleDouble| link.conductance.is_infinite() || SMALL < flow.to_f64().abs();
    let links = network.links.iter().zip(&flows_of_links).zip(0..);
    let undetermined: Vec<(u32, &Link)> =
        links.filter_map(|((link, flow), number)| (!determines_jump(link, flow)).then_some((number, link))).collect();
    let jump = |nodes: [u32; 2]| {
        let ends = nodes.map(|node| origins.number[node as usize]);
        match &forest {
            Some(forest) => forest.jump(core, ends),
            None => core.value(&values, ends[0]) - core.value(&values, ends[1]),
        }
    };
    LinearSolution {
        undetermined: undetermined.into_iter().map(|(number, link)| (number, jump(link.nodes))).collect(),
        values: origins.number.iter().map(|&number| core.value(&values, number)).collect(),
        flows: flows_of_links,
        stored: origins.of_store.iter().map(flow_of).collect(),
        report,
    }
}

/// Solves for no unknown.
struct Nothing;

impl Solves for Nothing {
    fn solve(&mut self, _: &mut [f64]) -> Result<(), NoSolution> {
        Ok(())
    }

    fn norm(&self) -> f64 {
        0.0
    }
}

impl From<NoSolution> for Shortcoming {
    fn from(reason: NoSolution) -> Self {
        Self::NoSolution(reason)
    }
}

impl From<GaveUp> for Shortcoming {
    fn from(reason: GaveUp) -> Self {
        match reason {
            GaveUp::Solver(reason) => Self::NoSolution(reason),
            GaveUp::Stalled(quality) => Self::Stalled(quality),
            GaveUp::Overflow => Self::Overflow,
        }
    }
}
