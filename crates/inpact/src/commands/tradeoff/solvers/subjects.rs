//! Subjects of measurement: solvers at tolerances, and the reference they are compared with.

use crate::commands::solvable::SolvableScene;
use inpact_network::linear::{LAST_DIGIT, Method, Work};
use inpact_network::{Equations, Error, Problem, State, transient};
use std::sync::LazyLock;
use std::time::{Duration, Instant};

/// A solver at a tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Subject {
    pub(super) method: Method,
    pub(super) tolerance: f64,
}

/// The result of a solver.
pub(super) struct Solved {
    /// The steady state; of a transient the state at its start and the one an increment later.
    pub(super) states: Vec<State>,
    pub(super) work: Work,
}

/// The failure of a solver, and the time of the last state before it.
pub(super) struct Failed {
    pub(super) why: Error,
    pub(super) after: Option<f64>,
}

pub(super) struct Reference {
    pub(super) subject: Subject,
    /// The reason for the choice, for users.
    pub(super) reason: String,
    pub(super) states: Vec<State>,
}

/// The solver of `solve` by default.
pub(super) const USUAL: Subject = Subject { method: Method::Direct, tolerance: LAST_DIGIT };

/// The exact solver, which is slow.
const EXACT: Subject = Subject { method: Method::Elimination, tolerance: LAST_DIGIT };

const METHODS: [Method; 3] = [Method::Direct, Method::Mixed, Method::Iterative];
const TOLERANCES: [f64; 5] = [LAST_DIGIT, 1e-12, 1e-9, 1e-6, 1e-3];

/// Up to this number of nodes the reference is elimination: in three dimensions that takes a quarter of a second, and several times as long with Newton's iteration.
const MAX_NODES: usize = 1000;

/// The time since the first call, for the phases of solvers.
fn clock() -> Duration {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed()
}

/// All solvers at all tolerances.
pub(super) fn subjects() -> impl Iterator<Item = Subject> {
    METHODS.into_iter().flat_map(|method| TOLERANCES.map(|tolerance| Subject { method, tolerance }))
}

/// The reference for a scene whose default solution is known.
pub(super) fn reference(prepared: &SolvableScene, problem: &Problem<'_>, usual: &Solved) -> Reference {
    let nodes = problem.scene().nodes.len();
    let direct = |reason| Reference { subject: USUAL, reason, states: usual.states.clone() };
    if MAX_NODES < nodes {
        return direct(format!("elimination would be slow on more than {MAX_NODES} nodes"));
    }
    match EXACT.solve(problem) {
        Ok(Solved { states, .. }) => {
            let reason = "without subtraction, in 106 bits".to_owned();
            Reference { subject: EXACT, reason, states }
        }
        Err(failed) => direct(failed.reason(prepared)),
    }
}

impl Failed {
    /// Why, for a person.
    pub(super) fn reason(&self, prepared: &SolvableScene) -> String {
        let findings = prepared.findings(&self.why, self.after).into_iter();
        findings.map(|finding| finding.message).collect::<Vec<String>>().join("; ")
    }
}

impl Reference {
    /// Whether a method at a tolerance is the reference itself; elimination has no tolerance.
    pub(super) fn is_found_by(&self, method: Option<Method>, tolerance: f64) -> bool {
        let Subject { method: own, tolerance: own_tolerance } = self.subject;
        method == Some(own) && (own == Method::Elimination || tolerance == own_tolerance)
    }
}

impl Subject {
    /// Solves a scene as far as it is measured, from scratch.
    pub(super) fn solve(self, problem: &Problem<'_>) -> Result<Solved, Failed> {
        let mut equations = Equations::new(problem, self.method, self.tolerance).timed_by(clock);
        let mut states = Vec::new();
        let begun = transient::begin(&mut equations, |state| {
            states.push(state);
            Ok(())
        });
        match begun {
            Ok(()) => Ok(Solved { states, work: equations.work() }),
            Err(why) => Err(Failed { why, after: states.last().map(|state| state.time) }),
        }
    }

    /// Its tolerance in words.
    pub(super) fn tolerance_text(self) -> String {
        if self.tolerance == LAST_DIGIT { "last digit".to_owned() } else { format!("{:e}", self.tolerance) }
    }
}
