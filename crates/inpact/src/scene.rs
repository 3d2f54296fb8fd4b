//! Scenes: nodes, bulk conductances and the interfaces of a deck that couple them.

use crate::commands::findings::Collected;
use crate::commands::laws::LawArguments;
use crate::commands::solvable::{Ended, SolvableScene};
use crate::error::Error;
use crate::settings::ReadOptions;
use crate::threads::with_threads;
use inpact_diagnostics::Diagnostic;
use inpact_network::linear::{LAST_DIGIT, Method};
use inpact_network::scene::Field;
use inpact_network::transient;
use inpact_network::{Equations, Problem, State};
use std::ops::ControlFlow;
use std::path::Path;

/// A scene with its deck, ready to be solved.
pub struct Scene {
    solvable: SolvableScene,
    findings: Vec<Diagnostic>,
}

/// Options of solving; by default to the last digit.
#[derive(Debug, Clone, Copy)]
pub struct SolveOptions {
    method: Method,
    tolerance: f64,
}

/// The states of a scene: one for a steady scene, one per increment for a transient.
#[derive(Debug, Clone)]
pub struct Solution {
    nodes: Vec<String>,
    links: Vec<[u32; 2]>,
    fields: Vec<Field>,
    left_out: Vec<String>,
    states: Vec<SolvedState>,
}

/// Values at the nodes and links at one time.
#[derive(Debug, Clone)]
pub struct SolvedState {
    /// The time; 0 in a steady scene.
    time: f64,
    /// By field, then by node.
    values: [Vec<Option<f64>>; 3],
    /// By field, then by link.
    flows: [Vec<Option<f64>>; 3],
}

impl Default for SolveOptions {
    fn default() -> Self {
        Self { method: Method::Direct, tolerance: LAST_DIGIT }
    }
}

impl SolveOptions {
    /// To the last digit, with a Cholesky factor in f64.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets the solver of linear equations; one that does not reach the tolerance falls back to a more robust one.
    #[must_use]
    pub fn method(mut self, method: Method) -> Self {
        self.method = method;
        self
    }

    /// The acceptable relative error of a flow.
    #[must_use]
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }
}

impl Scene {
    /// Reads the scene at `path`, or standard input for `-`, with its deck and tables.
    ///
    /// # Errors
    /// A file that cannot be read; a scene or a deck with errors, which [`Error::findings`] lists.
    pub fn read(path: impl AsRef<Path>, options: &ReadOptions) -> Result<Self, Error> {
        let path = path.as_ref();
        let mut collected = Collected::default();
        match SolvableScene::read(path, &LawArguments::default(), options, &mut collected)? {
            Some(solvable) => Ok(Self { solvable, findings: collected.0 }),
            None => Err(Error::of_first(&format!("`{}` has errors", path.display()), collected.0)),
        }
    }

    /// Warnings and notes about scene and deck.
    pub fn findings(&self) -> &[Diagnostic] {
        &self.findings
    }

    /// Solves it: its steady state, or the increments of its transient.
    ///
    /// ```
    /// use inpact::{Field, ReadOptions, Scene, SolveOptions};
    ///
    /// let folder = tempfile::tempdir()?;
    /// let deck = "*SURFACE INTERACTION, NAME=JOINT\n*GAP ELECTRICAL CONDUCTANCE\n2., 0.\n0., 1.\n";
    /// std::fs::write(folder.path().join("joint.inp"), deck)?;
    /// // 12 V — 1 S — gap of 2 S — 0 V
    /// let text = r#"
    /// deck = "joint.inp"
    /// node = [{ name = "battery", potential = { fixed = 12.0 } }, { name = "left" }, { name = "right", potential = { fixed = 0.0 } }]
    /// link = [{ nodes = ["battery", "left"], electrical = 1.0 }]
    /// interface = [{ slave = "left", master = "right", area = 1.0, clearance = 0.0 }]
    /// "#;
    /// std::fs::write(folder.path().join("scene.toml"), text)?;
    ///
    /// let scene = Scene::read(folder.path().join("scene.toml"), &ReadOptions::new().isolated())?;
    /// let solution = scene.solve(&SolveOptions::new())?;
    /// assert_eq!(solution.states()[0].values(Field::Potential), &[Some(12.0), Some(4.0), Some(0.0)]);
    /// assert_eq!(solution.states()[0].flows(Field::Potential), &[Some(8.0)]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// The scene is incomplete, or has no solution.
    pub fn solve(&self, options: &SolveOptions) -> Result<Solution, Error> {
        self.solve_watched(options, |_| ControlFlow::Continue(()))
    }

    /// The same; `watch` is called with the time of every computed state, and may stop the transient, whose states so far are kept.
    ///
    /// # Errors
    /// As [`solve`](Self::solve).
    pub fn solve_watched(
        &self,
        options: &SolveOptions,
        watch: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<Solution, Error> {
        with_threads(0, || self.solve_on_threads(options, watch))
    }

    fn solve_on_threads(
        &self,
        options: &SolveOptions,
        mut watch: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Solution, Error> {
        let mut collected = Collected::default();
        let name = &self.solvable.name;
        let Some(problem) = self.solvable.problem(&mut collected) else {
            return Err(Error::of_first(&format!("`{name}` cannot be solved"), collected.0));
        };
        let mut equations = Equations::new(&problem, options.method, options.tolerance);
        let mut states: Vec<SolvedState> = Vec::new();
        let ran = transient::run(&mut equations, |state| {
            states.push(SolvedState::of(&problem, state));
            if watch(state.time).is_break() { Err(Ended::Taking(())) } else { Ok(()) }
        });
        if let Err(Ended::Solving(failure)) = ran {
            let found = self.solvable.findings(&failure, states.last().map(|state| state.time));
            let found = self.solvable.settings.apply(found);
            return Err(Error::of_first(&format!("`{name}` has no solution"), found));
        }
        let scene = problem.scene();
        Ok(Solution {
            nodes: scene.nodes.clone(),
            links: scene.links.iter().map(|link| link.nodes).collect(),
            fields: problem.solved_fields(),
            left_out: problem.left_out.clone(),
            states,
        })
    }
}

impl Solution {
    /// The names of the nodes, in the order of the scene.
    pub fn nodes(&self) -> &[String] {
        &self.nodes
    }

    /// The two nodes of each link, as indices in [`nodes`](Self::nodes).
    pub fn links(&self) -> &[[u32; 2]] {
        &self.links
    }

    /// The fields that were solved for.
    pub fn fields(&self) -> &[Field] {
        &self.fields
    }

    /// The parts not solved, with the reason, one sentence each.
    pub fn left_out(&self) -> &[String] {
        &self.left_out
    }

    /// The states in the order of time.
    pub fn states(&self) -> &[SolvedState] {
        &self.states
    }
}

impl SolvedState {
    fn of(problem: &Problem<'_>, state: &State) -> Self {
        let scene = problem.scene();
        let values = |field| (0..).zip(&scene.nodes).map(|(node, _)| state.value(problem, field, node)).collect();
        let flows = |field| (0..).zip(&scene.links).map(|(link, _)| state.link_flow(problem, field, link)).collect();
        Self { time: state.time, values: Field::ALL.map(values), flows: Field::ALL.map(flows) }
    }

    /// The time, T; 0 in a steady scene.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The potential (φ), temperature (θ) or pore pressure (M L⁻¹ T⁻²) of each node; `None` where it is not known.
    pub fn values(&self, field: Field) -> &[Option<f64>] {
        &self.values[field.index()]
    }

    /// The current (C T⁻¹), heat (M L² T⁻³) or fluid (L³ T⁻¹) through each link, from its first node to its second; `None` where it is not known.
    pub fn flows(&self, field: Field) -> &[Option<f64>] {
        &self.flows[field.index()]
    }
}

impl std::fmt::Debug for Scene {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Scene").field("name", &self.solvable.name).finish_non_exhaustive()
    }
}
