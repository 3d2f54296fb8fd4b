//! Evaluates the laws of a plan, row by row, in batches.
//!
//! Rows of one node under one interaction are increments of its history, in the order they come in; a node's first row starts it unless
//! [`Choices::history_start`](crate::plan::Choices::history_start) says otherwise (C-25):
//! its time integrals are 0, the jump of potential at its start is its own, the rate of its clearance is 0 unless given.
//! Results depend on the rows alone and not on how they are cut into batches.
//!
//! A row that lacks a number which a law needs has no results of that law and is no increment of its history;
//! the next increment then begins at the last row that had them all.
//! Opens no file: batches in, batches out.

mod conductances;
mod coordinates;
mod electrical;
mod pore;
mod tally;
mod thermal;
mod totals;
mod user;

pub use coordinates::{Coordinates, TableReads, TabulatedQuantity};
pub use tally::{AxisTally, InteractionTally, RemarkedRows, Tally, UserFaultInRow};
pub use totals::Totals;
pub(crate) use totals::summed;

use self::conductances::Conductances;
use self::electrical::Scratch;
use crate::compile::{CompiledTables, ConductanceSource, InteractionLaws, Laws};
use crate::history::{ElectricalHistory, PoreHistory, ThermalHistory};
use crate::law::contact::ContactState;
use crate::nodes::{Batch, HistoryOrder, NodeIndex};
use crate::plan::{ContactPlaces, History, Plan, RowInteractions, Source};
use crate::results::{ResultBatch, Status};
use inpact_parser::model::Model;

/// An evaluation under way: the laws, the histories of the nodes so far, and a count of what happened.
#[derive(Debug)]
pub struct Evaluation<'a> {
    laws: &'a Laws,
    interactions: RowInteractions<'a>,
    nodes: NodeIndex,
    histories: Vec<NodeHistory>,
    tally: Tally,
    /// The interaction and the state of each row of a batch; `None` where there is no interaction with a law.
    governed: Vec<Option<(usize, Option<ContactState>)>>,
    conductances: Conductances,
    scratch: Scratch,
}

/// What a node's rows so far add up to.
#[derive(Debug, Clone)]
struct NodeHistory {
    electrical: ElectricalHistory,
    thermal: ThermalHistory,
    pore: PoreHistory,
}

/// A row of a batch, with what both laws need of it.
#[derive(Clone, Copy)]
struct Row<'a> {
    batch: &'a Batch,
    index: usize,
    state: ContactState,
    clearance: Option<f64>,
    pressure: Option<f64>,
    /// The time, where the row is part of a history.
    time: Option<f64>,
}

/// What came of a law in a row.
#[derive(Debug, Clone, PartialEq)]
enum Outcome {
    /// The row lacks a number that the law needs.
    Incomplete,
    /// It was evaluated, and this is the row's status as far as it goes.
    Evaluated(Option<Status>),
    /// A user's routine gave what is no conductance: what there is to say of it, in the first rows.
    Faulty(Option<UserFaultInRow>),
}

impl NodeHistory {
    /// One that has not begun.
    fn of(laws: &Laws) -> Self {
        Self {
            electrical: ElectricalHistory::new(laws.history_start, laws.closing_heat),
            thermal: ThermalHistory::new(laws.history_start),
            pore: PoreHistory::new(laws.history_start),
        }
    }
}

impl<'a> Evaluation<'a> {
    /// Begins an evaluation of `laws`, compiled from this model and plan.
    pub fn new(model: &'a Model, plan: &Plan, laws: &'a Laws) -> Self {
        Self {
            laws,
            interactions: RowInteractions::new(model, plan.governed_by, laws.interaction),
            nodes: match plan.order {
                HistoryOrder::ByNode => NodeIndex::by_node(),
                HistoryOrder::Interleaved => NodeIndex::default(),
            },
            histories: Vec::new(),
            tally: Tally::new(plan, laws, model.interactions.len()),
            governed: Vec::new(),
            conductances: Conductances::default(),
            scratch: Scratch::default(),
        }
    }

    /// Evaluates the rows of a batch, which go on where the batch before ended.
    pub fn evaluate(&mut self, batch: &Batch, results: &mut ResultBatch) {
        results.reset(batch.rows, self.laws.result_columns);
        self.find_conductances(batch);
        for row in 0..batch.rows {
            self.evaluate_row(batch, row, results);
        }
        self.add_up(batch, results);
        self.tally.rows += batch.rows as u64;
    }

    /// Adds the rows to the totals of their interactions.
    fn add_up(&mut self, batch: &Batch, results: &ResultBatch) {
        let summed = &self.laws.summed;
        if summed.is_empty() {
            return;
        }
        for (row, governed) in self.governed.iter().enumerate() {
            let Some((interaction, _)) = governed else { continue };
            let time = self.laws.time.and_then(|place| batch.numbers[place].get(row));
            self.tally.interactions[*interaction].totals.take(time, summed, results, row);
        }
    }

    /// What was counted.
    pub fn finish(self) -> Tally {
        self.tally
    }

    /// Finds interaction, contact and conductance of every row: the tables are evaluated over columns.
    fn find_conductances(&mut self, batch: &Batch) {
        let interactions = &self.laws.interactions;
        self.conductances.begin(batch.rows, interactions.len());
        self.governed.clear();
        for index in 0..batch.rows {
            let interaction = self.interactions.of_row(batch, index);
            let laws = interaction.and_then(|interaction| Some((interaction, interactions[interaction].as_ref()?)));
            let Some((interaction, laws)) = laws else {
                self.governed.push(None);
                continue;
            };
            let state = laws.contact.state(batch, index);
            self.governed.push(Some((interaction, state)));
            if let (Some(law), Some(state)) = (laws.conductance_tables(), state) {
                self.conductances.take(interaction, law, Row::new(batch, index, state, laws.contact, self.laws.time));
            }
        }
        let tallies = &mut self.tally.interactions;
        self.conductances.finish(|interaction| interactions[interaction].as_ref()?.conductance_tables(), tallies);
    }

    fn evaluate_row(&mut self, batch: &Batch, index: usize, results: &mut ResultBatch) {
        let Some((interaction, state)) = self.governed[index] else { return };
        let Some(laws) = &self.laws.interactions[interaction] else { return };
        let tally = &mut self.tally.interactions[interaction];
        tally.rows += 1;
        tally.closed += u64::from(state == Some(ContactState::Closed));
        tally.open += u64::from(state == Some(ContactState::Open));
        let Some(state) = state else {
            tally.incomplete += 1;
            return;
        };
        let row = Row::new(batch, index, state, laws.contact, self.laws.time);
        let keeps_history = laws.electrical.as_ref().is_some_and(|law| law.history == History::ByTime)
            || laws.thermal.as_ref().is_some_and(|law| law.history == History::ByTime)
            || laws.pore.as_ref().is_some_and(|law| law.history == History::ByTime);
        let mut history = match self.laws.node.filter(|_| keeps_history && row.time.is_some()) {
            Some(node) => {
                let slot = self.nodes.enter(interaction, batch.labels[node].get(index));
                if slot.number == self.histories.len() {
                    self.histories.push(NodeHistory::of(self.laws));
                } else if slot.is_first {
                    self.histories[slot.number] = NodeHistory::of(self.laws);
                }
                Some(&mut self.histories[slot.number])
            }
            None => None,
        };
        let scratch = &mut self.scratch;
        let mut outcomes = [None, None, None];
        let mut heat_of_current = None;
        if let Some(law) = &laws.electrical {
            let history = history.as_mut().map(|history| &mut history.electrical);
            let conductance = self.conductances.of_row(index);
            let evaluated = electrical::evaluate(law, row, conductance, history, scratch, results, tally);
            heat_of_current = evaluated.1;
            outcomes[0] = Some(evaluated.0);
        }
        if let Some(law) = &laws.thermal {
            let history = history.as_mut().map(|history| &mut history.thermal);
            let scratch = (&mut scratch.variables, &mut scratch.slopes);
            outcomes[2] = Some(thermal::evaluate(law, row, heat_of_current, history, scratch, results, tally));
        }
        if let Some(law) = &laws.pore {
            let history = history.as_mut().map(|history| &mut history.pore);
            outcomes[1] =
                Some(pore::evaluate(law, row, history, (&mut scratch.variables, &mut scratch.slopes), results, tally));
        }
        tally.incomplete += u64::from(outcomes.contains(&Some(Outcome::Incomplete)));
        if let Some(Outcome::Faulty(Some(told))) = &outcomes[0] {
            self.tally.user_faults.push(told.clone());
        }
        let [electrical, pore, thermal] = outcomes.map(|outcome| outcome.and_then(Outcome::status));
        tally.count_statuses([electrical, pore, thermal]);
        results.status[index] = electrical.max(pore).max(thermal);
        results.status_by_law.electrical[index] = electrical;
        results.status_by_law.thermal[index] = thermal;
        results.status_by_law.pore[index] = pore;
    }
}

impl InteractionLaws {
    /// The tables of the electrical conductance, where tables give it.
    fn conductance_tables(&self) -> Option<&CompiledTables> {
        match &self.electrical.as_ref()?.conductance {
            ConductanceSource::Tables(tables) => Some(tables),
            ConductanceSource::User(_) => None,
        }
    }
}

impl Outcome {
    fn status(self) -> Option<Status> {
        match self {
            Self::Incomplete | Self::Faulty(_) => None,
            Self::Evaluated(status) => status,
        }
    }
}

impl<'a> Row<'a> {
    fn new(batch: &'a Batch, index: usize, state: ContactState, contact: ContactPlaces, time: Option<usize>) -> Self {
        let number = |place: Option<usize>| batch.numbers[place?].get(index);
        let (clearance, pressure) = (number(contact.clearance), number(contact.pressure));
        Self { batch, index, state, clearance, pressure, time: number(time) }
    }

    fn number(&self, place: usize) -> Option<f64> {
        self.batch.numbers[place].get(self.index)
    }

    /// The number of a source; `combine` makes one of slave and master.
    #[inline]
    fn fetch(&self, source: &Source<usize>, combine: impl Fn(f64, f64) -> f64) -> Option<f64> {
        let sides = |slave, master| Some(combine(self.number(slave)?, self.number(master)?));
        match *source {
            Source::Cell(cell) => self.number(cell),
            Source::Sides(slave, master) => sides(slave, master),
            Source::CellOrSides(cell, slave, master) => self.number(cell).or_else(|| sides(slave, master)),
        }
    }
}

/// The status of a row as far as contact goes; `None` where it cannot be told.
fn contact_status(state: ContactState) -> Option<Status> {
    match state {
        ContactState::Closed => Some(Status::Closed),
        ContactState::Open => Some(Status::Open),
        ContactState::Undetermined => None,
    }
}
