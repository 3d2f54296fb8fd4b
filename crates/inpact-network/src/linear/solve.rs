//! From a linear network to its solution: reduction, factorisation, refinement and checks, and recovery of the eliminated parts.

use super::components::refuse_floating;
use super::core::{Core, NONE, Origins};
use super::dead_ends::DeadEnds;
use super::edges::{Balance, Edges};
use super::elimination::{MAX_FILLED, eliminate};
use super::factor::{Factor, Solves};
use super::found::{CoreFound, SMALL};
use super::infinite;
use super::iterative::ConjugateGradients;
use super::largest::largest_or_nan;
use super::matrix::Pattern;
use super::network::{LinearNetwork, Link};
use super::ordering::Analysis;
use super::refinement::{Refined, refine};
use super::relative::Form;
use super::report::{LAST_DIGIT, LinearReport, Method, MethodFailure, NoSolution, Quality, Reused};
use super::series::Series;
use super::solution::LinearSolution;
use super::work::{Clock, Phases, Work, no_clock, seconds_since};
use crate::error::Error;
use inpact_evaluation::numbers::DoubleDouble;
use std::sync::Arc;

/// Solves networks, and caches what the next one can reuse: the elimination ordering as long as the same unknowns are coupled, the factor as long as the matrix is the same.
#[derive(Debug)]
pub struct Solver {
    method: Method,
    tolerance: f64,
    kept: Option<Kept>,
    work: Work,
    clock: Clock,
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

impl Solver {
    /// A solver with this method whose estimated relative error of every flow is at most `tolerance`; [`LAST_DIGIT`] is the best that f64 can hold.
    pub fn new(method: Method, tolerance: f64) -> Self {
        Self { method, tolerance, kept: None, work: Work::default(), clock: no_clock }
    }

    /// The same, with the times of its phases measured by the caller's clock; without one they are 0.
    #[must_use]
    pub fn timed_by(self, clock: Clock) -> Self {
        Self { clock, ..self }
    }

    /// The same, with a known elimination ordering.
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

    /// Sets another tolerance; gives the previous one.
    pub(crate) fn set_tolerance(&mut self, tolerance: f64) -> f64 {
        std::mem::replace(&mut self.tolerance, tolerance)
    }

    /// Drops the factor of the last network, and keeps its ordering, if any.
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
    /// It has no solution, or more than one; or no method comes within the tolerance.
    pub fn solve(&mut self, network: &LinearNetwork) -> Result<LinearSolution, Error> {
        let start = (self.clock)();
        refuse_floating(network)?;
        let (core, origins) = Core::merged(network, &|_| false)?;
        let mut core = core;
        let (found, mut report) = self.solve_core(&mut core)?;
        report.merged = origins.merged;
        let Phases { order, factor, solve, .. } = report.phases;
        report.phases.set_up = seconds_since(self.clock, start) - order - factor - solve;
        self.work += report.work();
        let method = report.method;
        let overflow = || Error::not_solved(vec![(method, MethodFailure::Overflow)]);
        let mut solution = put_together(network, &core, &origins, found, report);
        if !solution.is_finite() {
            return Err(overflow());
        }
        if origins.merged > 0 {
            let solve =
                |core: &mut Core| Self::new(Method::Direct, LAST_DIGIT).solve_core(core).map(|(found, _)| found);
            infinite::find_flows(network, &mut solution, solve)?;
            if !solution.is_finite() {
                return Err(overflow());
            }
        }
        Ok(solution)
    }

    /// Solves a core, in which all conductances are finite and every node has a path to a known value.
    pub(super) fn solve_core(&mut self, core: &mut Core) -> Result<(CoreFound, LinearReport), Error> {
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

    /// Solves for the unknowns, by the chosen method and, where that fails, by more robust ones.
    fn solve_form(
        &mut self,
        core: &Core,
        series: &Series,
        form: Form,
        report: &mut LinearReport,
    ) -> Result<CoreFound, Error> {
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
                (Method::Direct, MethodFailure::Overflow) | (Method::Elimination, _) => {
                    return Err(Error::not_solved(std::mem::take(&mut report.given_up)));
                }
                (Method::Direct, _) => Method::Elimination,
                // An inaccurate factor may itself have overflowed, especially in f32.
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
    ) -> Result<CoreFound, MethodFailure> {
        if method == Method::Elimination {
            let found = eliminate(core, &series.is_there, &series.is_free, MAX_FILLED)?;
            let residual = worst_share(core, series, &found.flows);
            report.quality = Quality { residual, ..Quality::default() };
            return match residual <= self.tolerance.max(f64::EPSILON) {
                true => Ok(CoreFound { values: found.values, flows: found.flows, forest: None }),
                false if residual.is_finite() => Err(MethodFailure::Stalled(report.quality)),
                false => Err(MethodFailure::Overflow),
            };
        }
        if edges.form.count() == 0 {
            let refined = refine(core, edges, &mut Nothing, self.tolerance)?;
            return Ok(found(core, edges, &refined.jumps, refined.balance));
        }
        let clock = self.clock;
        let pattern = self.pattern(core, edges);
        let matrix = pattern.matrix(core, edges);
        let tolerance = self.tolerance;
        let refined = if method == Method::Iterative {
            let mut solver = ConjugateGradients::new(&matrix, tolerance);
            let solving = clock();
            let refined = refine(core, edges, &mut solver, tolerance);
            report.iterations = solver.iterations;
            report.phases.solve += seconds_since(clock, solving);
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
                    let ordering = clock();
                    let made = Analysis::of(pattern.symbolic()).ok_or(NoSolution::Memory)?;
                    report.phases.order += seconds_since(clock, ordering);
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
            let factoring = clock();
            let solver: &mut dyn Solves = match method {
                Method::Mixed => get_or_try(single, || Factor::new(analysis, &matrix))?,
                _ => get_or_try(double, || Factor::new(analysis, &matrix))?,
            };
            report.phases.factor += seconds_since(clock, factoring);
            let solving = clock();
            let refined = refine(core, edges, solver, tolerance);
            report.phases.solve += seconds_since(clock, solving);
            let refined = refined?;
            *values = matrix.values;
            refined
        };
        let Refined { jumps, balance, quality } = refined;
        report.quality = quality;
        Ok(found(core, edges, &jumps, balance))
    }

    /// The pattern of some edges with its analysis, reused from the previous network where they are the same.
    fn pattern(&mut self, core: &Core, edges: &Edges) -> Arc<Pattern> {
        let pattern = Pattern::of(core, edges);
        if let Some(kept) = &mut self.kept
            && kept.pattern.has_entries_of(pattern.symbolic())
        {
            // The contributions may be in another order.
            kept.pattern = Arc::new(pattern);
            return Arc::clone(&kept.pattern);
        }
        let pattern = Arc::new(pattern);
        self.kept = Some(Kept { pattern: Arc::clone(&pattern), analysis: None, factor: KeptFactor::default() });
        pattern
    }
}

/// The largest residual of the balance of a node relative to its flows; not finite where a flow is not.
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

/// The content of `place`, created if it is empty.
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

/// Solves a core without unknowns.
struct Nothing;

impl Solves for Nothing {
    fn solve(&mut self, _: &mut [f64]) -> Result<(), NoSolution> {
        Ok(())
    }

    fn norm(&self) -> f64 {
        0.0
    }
}
