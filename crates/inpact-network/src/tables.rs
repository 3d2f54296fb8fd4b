//! States as tables: values by node, flows by link, and interface rows as batches of the columns that the evaluation of a deck reads.

use crate::problem::Problem;
use crate::scene::{Course, Field, SceneInterface};
use crate::state::State;
use inpact_evaluation::nodes::{Batch, Column, Part, Selection};
use inpact_evaluation::results::push_number;
use inpact_parser::model::Model;
use std::collections::{BTreeSet, HashMap, HashSet};

/// Columns of times in tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Times {
    /// There is only one.
    One,
    /// A row has a time.
    Many,
}

impl Times {
    /// Those of a scene.
    pub fn of(problem: &Problem<'_>) -> Self {
        if problem.scene.is_transient() { Self::Many } else { Self::One }
    }
}

/// A line of comma-separated values under construction.
struct Line<'a> {
    text: &'a mut Vec<u8>,
    is_first: bool,
}

impl<'a> Line<'a> {
    fn new(text: &'a mut Vec<u8>) -> Self {
        Self { text, is_first: true }
    }

    fn next(&mut self) {
        if !self.is_first {
            self.text.push(b',');
        }
        self.is_first = false;
    }

    fn text(&mut self, cell: &str) {
        self.next();
        if cell.contains([',', '"', '\n', '\r']) {
            self.text.push(b'"');
            self.text.extend_from_slice(cell.replace('"', "\"\"").as_bytes());
            self.text.push(b'"');
        } else {
            self.text.extend_from_slice(cell.as_bytes());
        }
    }

    /// A number; an empty cell where there is none.
    fn number(&mut self, number: Option<f64>) {
        self.next();
        if let Some(number) = number {
            push_number(self.text, number);
        }
    }

    fn end(self) {
        self.text.push(b'\n');
    }
}

/// The header of the table of values.
pub fn state_header(times: Times) -> &'static str {
    match times {
        Times::One => "node,potential,temperature,pore_pressure\n",
        Times::Many => "node,time,potential,temperature,pore_pressure\n",
    }
}

/// The rows of the table of values: every node of the scene, in its order; an empty cell where a field is not solved for.
pub fn state_rows(problem: &Problem<'_>, state: &State, times: Times, text: &mut Vec<u8>) {
    for (number, name) in (0..).zip(&problem.scene.nodes) {
        let mut line = Line::new(text);
        line.text(name);
        if times == Times::Many {
            line.number(Some(state.time));
        }
        for field in Field::ALL {
            line.number(state.value(problem, field, number));
        }
        line.end();
    }
}

/// The header of the table of flows.
pub fn link_header(times: Times) -> &'static str {
    match times {
        Times::One => "node_1,node_2,current,heat,fluid\n",
        Times::Many => "node_1,node_2,time,current,heat,fluid\n",
    }
}

/// The rows of the table of flows: every link of the scene, in its order; positive from its first node to its second.
pub fn link_rows(problem: &Problem<'_>, state: &State, times: Times, text: &mut Vec<u8>) {
    for (number, link) in (0..).zip(&problem.scene.links) {
        let mut line = Line::new(text);
        for node in link.nodes {
            line.text(&problem.scene.nodes[node as usize]);
        }
        if times == Times::Many {
            line.number(Some(state.time));
        }
        for field in Field::ALL {
            line.number(state.link_flow(problem, field, number));
        }
        line.end();
    }
}

/// The columns of numbers of a scene's interface rows as a node table, in the order of the contract.
fn interface_columns(problem: &Problem<'_>) -> Vec<Column> {
    let rows = &problem.scene.interfaces;
    let has = |is_given: &dyn Fn(&SceneInterface) -> bool| rows.iter().any(is_given);
    let mut columns = BTreeSet::from([Column::Area]);
    let mut when = |is_there: bool, of: &[Column]| {
        if is_there {
            columns.extend(of);
        }
    };
    when(has(&|row| row.clearance.is_some()), &[Column::Clearance]);
    when(has(&|row| row.pressure.is_some()), &[Column::Pressure]);
    when(has(&|row| row.closed.is_some()), &[Column::Closed]);
    when(has(&|row| row.mass_flow.is_some()), &[Column::MassFlow(Part::Both)]);
    when(has(&|row| row.shear.is_some()), &[Column::Shear]);
    when(has(&|row| row.slip_rate.is_some()), &[Column::SlipRate]);
    when(has(&|row| row.clearance_rate.is_some()), &[Column::ClearanceRate]);
    when(has(&|row| row.characteristic_length.is_some()), &[Column::CharacteristicLength]);
    let has_bulk = |row: &SceneInterface| row.bulk_permeabilities.iter().any(Option::is_some);
    when(has(&has_bulk), &[Part::Slave, Part::Master].map(Column::BulkPermeability));
    let parts = [Part::Slave, Part::Master, Part::Both];
    when(problem.field(Field::Potential).is_some(), &parts.map(Column::Potential));
    if problem.field(Field::Temperature).is_some() {
        when(true, &[Part::Slave, Part::Master].map(Column::Temperature));
        when(true, &[Column::TemperatureJump]);
    } else {
        let is_known = has(&|row| row.temperature.is_some()) || problem.scene.initial_temperature.is_some();
        when(is_known, &[Column::Temperature(Part::Both)]);
    }
    when(problem.field(Field::PorePressure).is_some(), &parts.map(Column::PorePressure));
    when(problem.field(Field::PorePressure).is_some(), &[Column::FlowAcross]);
    let fields = rows.iter().map(|row| row.field_variables.len()).max().unwrap_or(0);
    columns.extend((1..).take(fields).map(|number| Column::FieldVariable(number, Part::Both)));
    columns.into_iter().collect()
}

/// The interface rows of states as the columns of a node table.
#[derive(Debug)]
pub struct InterfaceTable<'a> {
    problem: &'a Problem<'a>,
    model: &'a Model,
    /// The labels of [`interface_labels`].
    labels: Vec<String>,
    selection: Selection,
}

impl<'a> InterfaceTable<'a> {
    /// The table of a problem with the interactions of `model`.
    pub fn new(problem: &'a Problem<'a>, model: &'a Model) -> Self {
        let mut labels = vec![Column::Node, Column::Interaction];
        labels.extend((Times::of(problem) == Times::Many).then_some(Column::Time));
        let selection = Selection { labels, numbers: interface_columns(problem) };
        Self { problem, model, labels: interface_labels(problem), selection }
    }

    /// Its columns: texts and numbers.
    pub fn selection(&self) -> &Selection {
        &self.selection
    }

    /// The rows of a state, in the order of the scene, after `before` rows so far.
    pub fn rows(&self, state: &State, before: u64) -> Batch {
        let mut batch = Batch::with_columns(self.selection.labels.len(), self.selection.numbers.len());
        batch.first_row = before;
        let mut time = Vec::new();
        push_number(&mut time, state.time);
        for ((number, row), label) in (0..).zip(&self.problem.scene.interfaces).zip(&self.labels) {
            let interaction = self.model.interactions.get_index(self.problem.interactions[number as usize]);
            let name = interaction.map_or("", |of| of.name.written());
            let texts = [label.as_bytes(), name.as_bytes(), &time];
            for (column, text) in batch.labels.iter_mut().zip(texts) {
                column.push(text);
            }
            for (column, to) in self.selection.numbers.iter().zip(&mut batch.numbers) {
                to.push(cell(self.problem, state, number, row, *column));
            }
            batch.rows += 1;
        }
        batch
    }
}

/// The names of slave nodes; where several rows of one interaction share one, with that of the master node and, from the second of the same pair on, a number,
/// so that each row has a history of its own.
fn interface_labels(problem: &Problem<'_>) -> Vec<String> {
    let scene = problem.scene;
    let rows = || scene.interfaces.iter().zip(&problem.interactions);
    let (mut seen, mut shared) = (BTreeSet::new(), BTreeSet::new());
    for (row, interaction) in rows() {
        if !seen.insert((row.slave, *interaction)) {
            shared.insert((row.slave, *interaction));
        }
    }
    // A node may have the name of a pair, and two pairs may have equal names.
    let names: HashSet<&str> =
        if shared.is_empty() { HashSet::new() } else { scene.nodes.iter().map(String::as_str).collect() };
    let mut taken: HashSet<(usize, String)> = HashSet::new();
    let mut last_numbers: HashMap<(usize, u32, u32), usize> = HashMap::new();
    let mut label = |(row, &interaction): (&SceneInterface, &usize)| {
        let [slave, master] = row.nodes().map(|node| &scene.nodes[node as usize]);
        if !shared.contains(&(row.slave, interaction)) {
            return slave.clone();
        }
        let number = last_numbers.entry((interaction, row.slave, row.master)).or_default();
        loop {
            *number += 1;
            let label = if *number == 1 { format!("{slave}|{master}") } else { format!("{slave}|{master}|{number}") };
            if !names.contains(label.as_str()) && taken.insert((interaction, label.clone())) {
                return label;
            }
        }
    };
    rows().map(&mut label).collect()
}

fn cell(problem: &Problem<'_>, state: &State, number: u32, row: &SceneInterface, column: Column) -> Option<f64> {
    let at = |course: &Option<Course>| course.as_ref().map(|course| course.at(state.time));
    let value = |field, part| {
        let node = if part == Part::Slave { row.slave } else { row.master };
        state.value(problem, field, node)
    };
    let jump = |field| state.row_jump(problem, field, number);
    match column {
        Column::Area => Some(row.area),
        Column::Clearance => at(&row.clearance),
        Column::Pressure => at(&row.pressure),
        Column::Closed => row.closed.map(|closed| f64::from(u8::from(closed))),
        Column::MassFlow(_) => row.mass_flow,
        Column::Shear => row.shear,
        Column::SlipRate => row.slip_rate,
        Column::ClearanceRate => row.clearance_rate,
        Column::CharacteristicLength => row.characteristic_length,
        Column::BulkPermeability(part) => row.bulk_permeabilities[usize::from(part != Part::Slave)],
        Column::Potential(Part::Both) => jump(Field::Potential),
        Column::Potential(part) => value(Field::Potential, part),
        Column::Temperature(Part::Both) => row.temperature.or(problem.scene.initial_temperature),
        Column::Temperature(part) => {
            let of_nodes = [Part::Slave, Part::Master].map(|part| value(Field::Temperature, part));
            let of_sides = row.temperatures(of_nodes, problem.scene.initial_temperature, |given| given);
            of_sides[usize::from(part != Part::Slave)]
        }
        Column::TemperatureJump => jump(Field::Temperature),
        Column::PorePressure(Part::Both) => jump(Field::PorePressure),
        Column::PorePressure(part) => value(Field::PorePressure, part),
        Column::FlowAcross => {
            let is_constrained = state.is_constrained(problem, Field::PorePressure, number);
            let flow = state.row_flow(problem, Field::PorePressure, number).filter(|_| is_constrained)?;
            // From slave to master in the network, from master to slave in the law; zero flow is +0, not −0.
            Some(0.0 - flow / row.area)
        }
        Column::FieldVariable(number, _) => {
            row.field_variables.get(number as usize - 1).copied().filter(|value| !value.is_nan())
        }
        _ => None,
    }
}
