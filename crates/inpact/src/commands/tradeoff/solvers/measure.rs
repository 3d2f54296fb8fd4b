//! Times and errors of every solver.

use super::subjects::{Failed, Reference, Solved, Subject, USUAL, reference, subjects};
use crate::commands::solvable::SolvableScene;
use crate::commands::tradeoff::front::front;
use crate::commands::tradeoff::rounds::least_times;
use inpact_network::linear::{LinearReport, Method, Phases, Work};
use inpact_network::scene::Field;
use inpact_network::{Distance, Problem, State};

/// Measurements on a scene.
pub(super) struct Measured {
    pub(super) reference: Reference,
    pub(super) rounds: u32,
    /// The fastest first.
    pub(super) entries: Vec<Entry>,
    /// Subjects that did not solve the scene, with the reason.
    pub(super) failed: Vec<(Subject, String)>,
    /// The total number of unknowns of the default solver in all fields.
    pub(super) unknowns: usize,
}

/// A solver at a tolerance.
pub(super) struct Entry {
    pub(super) subject: Subject,
    /// The minimum time, in seconds.
    pub(super) time: f64,
    /// The minimum time of each of its phases, in seconds.
    pub(super) phases: Phases,
    /// From the reference, over all states.
    pub(super) distance: Distance,
    /// It is the reference itself, so its distance is meaningless.
    pub(super) is_reference: bool,
    pub(super) found: Found,
    /// It is on the Pareto front: no other is as fast and as accurate in the values of nodes, and better in one of the two.
    pub(super) on_front: bool,
}

/// The reports of some states, summarised.
#[derive(Default)]
pub(super) struct Found {
    /// The methods in the order in which they were tried.
    pub(super) methods: Vec<Method>,
    /// Methods that failed, with the field and the reason.
    pub(super) given_up: Vec<(Field, Method, String)>,
    /// The largest of the last linear problems of all fields.
    pub(super) residual: f64,
    /// The same; where there is no estimate, nothing.
    pub(super) estimate: Option<f64>,
    pub(super) condition: Option<f64>,
    /// Unknowns of all fields of a state.
    pub(super) unknowns: usize,
    pub(super) newton_steps: usize,
    /// Networks that were solved, with the corrections and iterations of all.
    pub(super) work: Work,
    /// Entries of the factors of all fields of a state.
    pub(super) factor_entries: usize,
    pub(super) factor_bytes: usize,
}

/// Computes the errors of every solver, then times them in interleaved rounds.
///
/// # Errors
/// The failure of the default solver: such a scene has no solution to compare with.
pub(super) fn measure(prepared: &SolvableScene, problem: &Problem<'_>, rounds: u32) -> Result<Measured, Failed> {
    let usual = USUAL.solve(problem)?;
    let reference = reference(prepared, problem, &usual);
    let (mut entries, mut failed) = (Vec::new(), Vec::new());
    for subject in subjects() {
        match subject.solve(problem) {
            Ok(solved) => entries.push(Entry::new(subject, &solved, problem, &reference)),
            Err(failure) => failed.push((subject, failure.reason(prepared))),
        }
    }
    take_times(problem, &mut entries, rounds);
    entries.sort_by(|a, b| a.time.total_cmp(&b.time));
    let places: Vec<(f64, f64)> = entries.iter().map(|entry| (entry.time, entry.distance.values)).collect();
    for (entry, on_front) in entries.iter_mut().zip(front(&places)) {
        entry.on_front = on_front;
    }
    let unknowns = Found::new(USUAL.method, &usual).unknowns;
    Ok(Measured { reference, rounds, entries, failed, unknowns })
}

fn take_times(problem: &Problem<'_>, entries: &mut [Entry], rounds: u32) {
    let mut runs: Vec<Box<dyn FnMut() + '_>> = Vec::new();
    for Entry { subject, phases, .. } in &mut *entries {
        let run = || {
            if let Ok(Solved { work, .. }) = subject.solve(problem) {
                *phases = least(*phases, work.phases);
            }
        };
        runs.push(Box::new(run));
    }
    let times = least_times(rounds, &mut runs);
    drop(runs);
    for (entry, time) in entries.iter_mut().zip(times) {
        entry.time = time;
    }
}

/// The lesser of each part.
fn least(one: Phases, other: Phases) -> Phases {
    Phases {
        set_up: one.set_up.min(other.set_up),
        order: one.order.min(other.order),
        factor: one.factor.min(other.factor),
        solve: one.solve.min(other.solve),
    }
}

impl Entry {
    fn new(subject: Subject, solved: &Solved, problem: &Problem<'_>, reference: &Reference) -> Self {
        let pairs = solved.states.iter().zip(&reference.states);
        let distances = pairs.map(|(state, reference)| state.distance(problem, reference));
        let found = Found::new(subject.method, solved);
        Self {
            subject,
            time: f64::INFINITY,
            phases: solved.work.phases,
            distance: distances.fold(Distance::default(), Distance::max),
            is_reference: reference.is_found_by(found.methods.last().copied(), subject.tolerance),
            found,
            on_front: false,
        }
    }
}

impl Found {
    fn new(method: Method, solved: &Solved) -> Self {
        let mut found = Self { methods: vec![method], work: solved.work, ..Self::default() };
        let mut has_estimates = true;
        for state in &solved.states {
            let (mut unknowns, mut entries, mut bytes) = (0, 0, 0);
            for (field, linear) in linear_reports(state) {
                found.take(field, linear);
                has_estimates &= linear.method != Method::Elimination;
                unknowns += linear.unknowns;
                entries += linear.factor_entries;
                bytes += linear.factor_entries * if linear.method == Method::Mixed { 4 } else { 8 };
            }
            found.newton_steps += state.reports.iter().map(|stage| stage.iterations).sum::<usize>();
            found.unknowns = found.unknowns.max(unknowns);
            found.factor_entries = found.factor_entries.max(entries);
            found.factor_bytes = found.factor_bytes.max(bytes);
        }
        if !has_estimates {
            (found.estimate, found.condition) = (None, None);
        }
        found
    }

    fn take(&mut self, field: Field, linear: &LinearReport) {
        for (method, why) in &linear.given_up {
            self.add_method(*method);
            let of = (field, *method, why.to_string());
            if !self.given_up.contains(&of) {
                self.given_up.push(of);
            }
        }
        self.add_method(linear.method);
        self.residual = self.residual.max(linear.quality.residual);
        if linear.unknowns > 0 {
            self.estimate = Some(self.estimate.unwrap_or(0.0).max(linear.quality.error));
            self.condition = Some(self.condition.unwrap_or(0.0).max(linear.quality.condition));
        }
    }

    fn add_method(&mut self, method: Method) {
        if !self.methods.contains(&method) {
            self.methods.push(method);
        }
    }

    /// The solver, and its fallbacks.
    pub(super) fn methods_text(&self) -> String {
        let names: Vec<String> = self.methods.iter().map(ToString::to_string).collect();
        names.join(", then ")
    }
}

fn linear_reports(state: &State) -> impl Iterator<Item = (Field, &LinearReport)> {
    state.reports.iter().flat_map(|stage| stage.fields.iter().copied().zip(&stage.linear))
}

#[cfg(test)]
mod tests {
    use super::*;
    use inpact_network::linear::{MethodFailure, NoSolution, Quality};

    /// A report of a method reached as a fallback.
    fn report(method: Method, given_up: &[Method]) -> LinearReport {
        let why = MethodFailure::NoSolution(NoSolution::Iterations);
        LinearReport {
            method,
            unknowns: 1,
            quality: Quality { error: 1e-20, condition: 3.0, ..Quality::default() },
            given_up: given_up.iter().map(|method| (*method, why)).collect(),
            ..LinearReport::default()
        }
    }

    #[test]
    fn methods_that_gave_up_are_listed_in_order() {
        let mut found = Found { methods: vec![Method::Iterative], ..Found::default() };
        found.take(Field::Potential, &report(Method::Iterative, &[]));
        assert_eq!(found.methods_text(), "iterative");
        for _ in 0..2 {
            found.take(Field::Temperature, &report(Method::Direct, &[Method::Iterative]));
        }
        assert_eq!(found.methods_text(), "iterative, then direct");
        let why = "the iterations did not converge".to_owned();
        assert_eq!(found.given_up, [(Field::Temperature, Method::Iterative, why)]);
    }
}
