//! Points of an evaluated node table for curves and interfaces: the positions of its rows, and their sums for each time. For `plot` and `report`.

use super::evaluable::{Evaluable, EvaluableArguments};
use super::picture::Drawn;
use crate::chart::surface::Surface;
use crate::curves::{Figure, HeldPlace, LawKind, NodeRows, NodeSample, Side, range};
use crate::failure::Failure;
use crate::report::History;
use inpact_evaluation::law::ContactState;
use inpact_evaluation::nodes::{Batch, Column, Findings, Selection};
use inpact_evaluation::numbers::UnboundedSum;
use inpact_evaluation::plan::{Plan, RowInteractions};
use inpact_evaluation::results::{Output, ResultBatch, Status};
use inpact_evaluation::{Evaluation, Tally};
use inpact_results::vtu::{Cell, CellKind};
use std::collections::{BTreeMap, HashMap};

/// The approximate number of rows drawn.
const SAMPLE: u64 = 3000;

/// The maximum number of faces drawn.
const MAX_FACES: usize = 4000;

/// The maximum number of times with sums.
const MAX_TIMES: usize = 20_000;

/// The laws with a column of their own among the results.
const LAWS: [(LawKind, Output); 3] = [
    (LawKind::Electrical, Output::Conductance),
    (LawKind::Thermal, Output::ThermalConductance),
    (LawKind::Permeability, Output::Permeability),
];

/// Results of an evaluation.
pub(crate) struct Gathered {
    /// The rows of each law of each interaction, by its index in the model.
    rows: HashMap<(usize, LawKind), NodeRows>,
    /// Sums over the nodes of each interface.
    pub(crate) histories: Vec<History>,
    /// The interfaces coloured by results, at the last state; empty where their geometry is unknown.
    pub(crate) surfaces: Vec<Surface>,
    pub(crate) tally: Tally,
    pub(crate) findings: Findings,
}

/// Times as ordered keys.
type Sums = BTreeMap<(usize, usize, u64), (Option<f64>, UnboundedSum)>;

/// Evaluates a node table for drawing.
///
/// # Errors
/// A node table that cannot be read.
pub(crate) fn gather(arguments: &EvaluableArguments, evaluable: &mut Evaluable) -> Result<Gathered, Failure> {
    let path = arguments.nodes_path();
    let unreadable = |error| Failure::read(path, error);
    let Evaluable { model, plan, choices, nodes_name, rows, made, .. } = evaluable;
    // A constant column is folded, but still gives the positions of its rows.
    let mut selection = plan.selection.clone();
    let located = [Column::Clearance, Column::Pressure, Column::Closed, Column::Time];
    selection.numbers.extend(located.into_iter().filter(|column| !plan.selection.numbers.contains(column)));
    let mut given = rows.give_back(&selection).map_err(unreadable)?;
    let mut evaluation = Evaluation::new(model, plan, choices);
    let label = plan.selection.label(Column::Interaction);
    let mut interactions = RowInteractions::new(model, plan.governed_by, label);
    let mut results = ResultBatch::default();
    let places = Places::of(plan, &selection);
    let step = plan.rows.div_ceil(SAMPLE).max(1);
    let mut rows: HashMap<(usize, LawKind), NodeRows> = HashMap::new();
    let mut sums = Sums::new();
    let mut coloured: Vec<Coloured> = made.iter().flat_map(|_| places.coloured(plan)).collect();
    while let Some(mut batch) = given.next_batch().map_err(unreadable)? {
        plan.name_rows(&mut batch);
        evaluation.evaluate(&batch, &mut results);
        for Coloured { source, values, .. } in &mut coloured {
            let column = match *source {
                Source::Given(place) => &batch.numbers[place],
                Source::Result(place) => &results.numbers[place],
            };
            values.extend((0..batch.rows).map(|row| column.get(row).unwrap_or(f64::NAN)));
        }
        for row in 0..batch.rows {
            let Some(interaction) = interactions.of_row(&batch, row) else { continue };
            let is_drawn = (batch.first_row + row as u64).is_multiple_of(step);
            places.take_point((&batch, &results, row), interaction, is_drawn, &mut rows);
            places.take_sums(&batch, &results, row, interaction, &mut sums);
        }
    }
    let tally = evaluation.finish();
    let mut findings = Findings::new(nodes_name);
    tally.report_user_faults(&mut findings);
    tally.report(plan, &mut findings);
    let mut histories: BTreeMap<(usize, usize), History> = BTreeMap::new();
    for ((interaction, output, _), (time, sum)) in sums {
        let history = histories.entry((interaction, output)).or_insert_with(|| History {
            interaction: model.interactions[interaction].name.written().to_owned(),
            output: places.summed[output].0.to_string(),
            points: Vec::new(),
        });
        history.points.push((time, sum.total()));
    }
    let surfaces = made.iter().flat_map(|made| surfaces(&made.drawn, &coloured)).collect();
    Ok(Gathered { rows, surfaces, histories: histories.into_values().collect(), tally, findings })
}

impl Gathered {
    /// The points that axes must include so that every drawn row is within.
    pub(crate) fn held_places(&self, evaluable: &Evaluable) -> Vec<HeldPlace> {
        let names: Vec<_> = evaluable.model.interactions.keys().collect();
        let places = self.rows.iter().flat_map(|((interaction, law), rows)| {
            let name = names[*interaction].clone();
            let ends = Side::BOTH.into_iter().flat_map(|side| {
                let xs = rows.sample.iter().filter(|node| node.side == side).map(|node| node.x);
                range(xs).into_iter().flat_map(move |(least, greatest)| [(side, least), (side, greatest)])
            });
            ends.map(|(side, x)| HeldPlace { interaction: name.clone(), law: *law, side, x }).collect::<Vec<_>>()
        });
        places.collect()
    }

    /// Adds the rows to the curves of their laws.
    pub(crate) fn place(&self, figure: &mut Figure, evaluable: &Evaluable) {
        for panel in &mut figure.panels {
            let is_meant = |name: &inpact_parser::model::Name| name.written() == panel.interaction;
            let Some(index) = evaluable.model.interactions.keys().position(is_meant) else { continue };
            panel.nodes = self.rows.get(&(index, panel.law)).cloned();
        }
    }
}

/// A quantity that colours interfaces.
struct Coloured {
    name: String,
    source: Source,
    /// One value per row.
    values: Vec<f64>,
}

/// Columns for colouring: from the batches or from the results.
#[derive(Clone, Copy)]
enum Source {
    Given(usize),
    Result(usize),
}

/// The faces of the last state coloured by their results.
fn surfaces(drawn: &Drawn, coloured: &[Coloured]) -> Vec<Surface> {
    let Some(state) = drawn.states.last() else { return Vec::new() };
    let grid = drawn.faces.grid(state, Vec::new());
    if MAX_FACES < grid.cells.len() {
        return Vec::new();
    }
    let first = (drawn.states.len() - 1) * drawn.faces.points();
    let directions = Surface::directions(&grid.points);
    let surface = |Coloured { name, values, .. }: &Coloured| {
        let values = values.get(first..first + drawn.faces.points())?;
        let face = |cell: &Cell| {
            // Corners come before midside nodes.
            let corners = match cell.kind {
                CellKind::QuadraticTriangle => 3,
                CellKind::QuadraticQuadrilateral => 4,
                CellKind::QuadraticLine => 2,
                _ => cell.points.len(),
            };
            let place = |point: &usize| directions.map(|axis| grid.points[*point][axis]);
            let known = cell.points.iter().map(|point| values[*point]).filter(|value| value.is_finite());
            let count = known.clone().count();
            // Divided first: a sum of large values may overflow.
            let mean: f64 = known.map(|value| value / count as f64).sum();
            (0 < count).then(|| (cell.points.iter().take(corners).map(place).collect(), mean))
        };
        let faces: Vec<_> = grid.cells.iter().filter_map(face).collect();
        let (output, time) = (name.clone(), state.moment.time);
        (!faces.is_empty()).then_some(Surface { output, time, directions, faces })
    };
    coloured.iter().filter_map(surface).collect()
}

/// Indices in batches and results of the drawn quantities.
struct Places {
    clearance: Option<usize>,
    pressure: Option<usize>,
    closed: Option<usize>,
    time: Option<usize>,
    laws: Vec<(LawKind, usize)>,
    summed: Vec<(Output, usize)>,
}

impl Places {
    fn of(plan: &Plan, selection: &Selection) -> Self {
        let number = |column| selection.number(column);
        let output = |wanted: Output| plan.outputs.iter().position(|output| *output == wanted);
        let is_summed = |output: &Output| {
            matches!(output, Output::Ecda | Output::Sjda | Output::Hfla | Output::Sfdra | Output::Pfla)
        };
        let outputs = plan.outputs.iter().copied().enumerate();
        Self {
            clearance: number(Column::Clearance),
            pressure: number(Column::Pressure),
            closed: number(Column::Closed),
            time: number(Column::Time),
            laws: LAWS.into_iter().filter_map(|(law, of)| Some((law, output(of)?))).collect(),
            summed: outputs.filter(|(_, output)| is_summed(output)).map(|(place, output)| (output, place)).collect(),
        }
    }

    /// The quantities that colour interfaces: the clearance, and the results per area.
    fn coloured(&self, plan: &Plan) -> Vec<Coloured> {
        let clearance = self.clearance.map(|place| ("clearance".to_owned(), Source::Given(place)));
        let outputs = plan.outputs.iter().enumerate();
        let is_coloured = |output: &Output| matches!(output, Output::Ecd | Output::Hfl | Output::Pfl);
        let results = outputs.filter(|(_, output)| is_coloured(output));
        let results = results.map(|(place, output)| (output.to_string(), Source::Result(place)));
        clearance
            .into_iter()
            .chain(results)
            .map(|(name, source)| Coloured { name, source, values: Vec::new() })
            .collect()
    }

    fn take_point(
        &self,
        (batch, results, row): (&Batch, &ResultBatch, usize),
        interaction: usize,
        is_drawn: bool,
        rows: &mut HashMap<(usize, LawKind), NodeRows>,
    ) {
        let cell = |place: Option<usize>| batch.numbers[place?].get(row);
        let (clearance, pressure) = (cell(self.clearance), cell(self.pressure));
        let (side, x) = match ContactState::of(cell(self.closed), clearance, pressure) {
            Some(ContactState::Open) => (Side::Open, clearance.map(|clearance| clearance.max(0.0))),
            Some(ContactState::Closed) => (Side::Closed, pressure),
            _ => return,
        };
        for (law, place) in &self.laws {
            let Some(y) = results.numbers[*place].get(row) else { continue };
            let statuses = match law {
                LawKind::Electrical => &results.status_by_law.electrical,
                LawKind::Permeability => &results.status_by_law.pore,
                LawKind::Thermal | LawKind::ViewFactor => &results.status_by_law.thermal,
            };
            let of = rows.entry((interaction, *law)).or_default();
            let index = side as usize;
            of.count[index] += 1;
            of.beyond[index] += u64::from(statuses.get(row) == Some(&Some(Status::BeyondTable)));
            // Without a pressure a closed row of a table against clearance is at contact.
            if let (true, Some(x)) = (is_drawn && y.is_finite(), x.or(Some(0.0)).filter(|x| x.is_finite())) {
                of.sample.push(NodeSample { side, x, y });
            }
        }
    }

    fn take_sums(&self, batch: &Batch, results: &ResultBatch, row: usize, interaction: usize, sums: &mut Sums) {
        let time = self.time.and_then(|place| batch.numbers[place].get(row));
        // Positive and negative times in their order.
        let bits = time.unwrap_or(0.0).to_bits();
        let key = if bits >> 63 == 0 { bits | 1 << 63 } else { !bits };
        for (output, (_, place)) in self.summed.iter().enumerate() {
            let Some(value) = results.numbers[*place].get(row) else { continue };
            if MAX_TIMES < sums.len() && !sums.contains_key(&(interaction, output, key)) {
                continue;
            }
            sums.entry((interaction, output, key)).or_insert_with(|| (time, UnboundedSum::default())).1.add(value);
        }
    }
}
