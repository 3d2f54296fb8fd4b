//! The first pass over a node table: the contents of its columns for each interaction, and whether it can be evaluated at all.
//!
//! All faults of cells are found here (D002 to D006, D008, D009), so that an evaluation only begins when it can complete.
//! Memory: bounds of each column for each interaction, and where there are histories the last time of the current node;
//! of every node only where the rows of a node are not contiguous. The rows themselves may be kept, so that the table is read once.

use super::choices::Choices;
use super::governing::{GovernedBy, NameFault, RowInteractions, find_interaction};
use super::surveyed::{ColumnSurvey, InteractionSurvey, Survey};
use super::wanted::wanted_columns;
use crate::kernel::scan;
use crate::law::contact::ContactState;
use crate::law::contact::columns::{contact_states, count_states};
use crate::nodes::{
    Batch, Column, Findings, Header, HistoryOrder, KeptRows, MALFORMED_CELL, NEGATIVE_AREA, NEGATIVE_PROPERTY,
    NON_FINITE, NodeIndex, NodeLabel, NodeLabels, NodeReader, NodeRuns, Part, Place, Selection, TIME_NOT_ASCENDING,
    UNKNOWN_INTERACTION,
};
use inpact_parser::model::Model;
use std::io;
use std::ops::Range;

/// Reads a node table to its end and surveys its contents; `None` when the interaction that governs a row is undetermined.
///
/// Assumes that the rows of nodes are interleaved: memory grows with the number of nodes that have a history.
///
/// # Errors
/// Those of reading the table.
pub fn survey(
    reader: NodeReader<'_>,
    model: &Model,
    choices: &Choices,
    findings: &mut Findings,
) -> io::Result<Option<Survey>> {
    survey_rows(reader, model, choices, findings, None)
}

/// The same, with the rows kept so that the table need not be read again; memory grows with the number of nodes only where their rows are not contiguous.
///
/// # Errors
/// Those of reading the table and of keeping its rows.
pub fn survey_keeping(
    reader: NodeReader<'_>,
    model: &Model,
    choices: &Choices,
    findings: &mut Findings,
    kept: &mut KeptRows,
) -> io::Result<Option<Survey>> {
    survey_rows(reader, model, choices, findings, Some(kept))
}

fn survey_rows(
    mut reader: NodeReader<'_>,
    model: &Model,
    choices: &Choices,
    findings: &mut Findings,
    mut kept: Option<&mut KeptRows>,
) -> io::Result<Option<Survey>> {
    let header = reader.header().clone();
    let governed_by = GovernedBy::decide(model, &header, choices.interaction.as_ref(), findings);
    header.report_unknown(findings);
    let Some(governed_by) = governed_by else { return Ok(None) };
    let columns = wanted_columns(model, governed_by, choices, &header);
    let histories = header.has(Column::Node) && columns.contains(&Column::Time);
    // Without histories the order is not determined, and must not be relied on.
    let order = if histories && kept.is_some() { HistoryOrder::ByNode } else { HistoryOrder::Interleaved };
    let labels = match kept {
        Some(_) => key_columns(&header),
        None => label_columns(governed_by, histories),
    };
    let selection = Selection { labels, numbers: columns.clone() };
    reader.select(&selection);
    if let Some(kept) = kept.as_deref_mut() {
        kept.begin(&selection);
    }
    let interactions = vec![InteractionSurvey::default(); model.interactions.len()];
    let survey = Survey { header, rows: 0, governed_by, order, columns, interactions };
    let mut surveyor = Surveyor::new(survey, &selection, model, histories);
    let mut batch = Batch::default();
    while reader.read_batch(&mut batch, findings)? {
        surveyor.take(&batch, kept.as_deref_mut(), findings)?;
        if let Some(kept) = kept.as_deref_mut() {
            kept.push(std::mem::take(&mut batch))?;
        }
    }
    Ok(Some(surveyor.finish(findings)))
}

/// The key columns that a table has, in the order of the contract.
pub(crate) fn key_columns(header: &Header) -> Vec<Column> {
    let keys = [Column::Node, Column::Interaction, Column::Time];
    keys.into_iter().filter(|column| header.has(*column)).collect()
}

/// The labels that the first pass needs.
fn label_columns(governed_by: GovernedBy, histories: bool) -> Vec<Column> {
    let node = histories.then_some(Column::Node);
    let interaction = (governed_by == GovernedBy::Column).then_some(Column::Interaction);
    node.into_iter().chain(interaction).collect()
}

/// The block size in rows for states.
const ROWS_OF_STATES: usize = 512;

/// A survey in progress.
struct Surveyor<'a> {
    survey: Survey,
    model: &'a Model,
    rows: RowInteractions<'a>,
    contact: ContactPlaces,
    area: Option<usize>,
    /// Lengths and permeabilities that must not be negative.
    properties: Vec<(usize, Column)>,
    /// Steps and increments, which are integers.
    counters: Vec<(usize, Column)>,
    time: Option<usize>,
    node: Option<usize>,
    /// Whether the rows of a node stand together, where that is relied on.
    runs: Option<NodeRuns>,
    nodes: NodeIndex,
    last_times: Vec<f64>,
    /// The number of nodes of each interaction.
    histories: Vec<u64>,
    first_non_finite: Vec<Option<Place>>,
}

/// The indices of the columns of contact in a batch.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct ContactPlaces {
    /// `clearance`.
    pub(crate) clearance: Option<usize>,
    /// `pressure`.
    pub(crate) pressure: Option<usize>,
    /// `closed`.
    pub(crate) closed: Option<usize>,
    /// The state of all rows, where the plan knows it.
    pub(crate) state: Option<ContactState>,
}

impl ContactPlaces {
    /// The state of a row ([`ContactState::of`]); `None` where the row has too little data.
    #[inline]
    pub(crate) fn state(&self, batch: &Batch, row: usize) -> Option<ContactState> {
        if self.state.is_some() {
            return self.state;
        }
        let number = |place: Option<usize>| batch.numbers[place?].get(row);
        ContactState::of(number(self.closed), number(self.clearance), number(self.pressure))
    }

    /// Writes the states of some rows, in order.
    pub(crate) fn states(&self, batch: &Batch, rows: Range<usize>, states: &mut [Option<ContactState>]) {
        // A column is plain where none of its numbers is missing.
        let plain = |place: Option<usize>| {
            let column = &batch.numbers[place?];
            column.presence().is_none().then(|| &column.values()[rows.clone()])
        };
        if self.state.is_some() {
            return states.fill(self.state);
        }
        match (self.closed, plain(self.closed), plain(self.clearance), self.pressure, plain(self.pressure)) {
            (_, Some(closed), ..) => {
                for (state, closed) in states.iter_mut().zip(closed) {
                    *state = ContactState::of(Some(*closed), None, None);
                }
            }
            (None, _, Some(clearance), Some(_), Some(pressure)) => contact_states(clearance, pressure, states),
            (None, _, Some(clearance), None, _) => {
                for (state, clearance) in states.iter_mut().zip(clearance) {
                    *state = ContactState::of(None, Some(*clearance), None);
                }
            }
            _ => states.iter_mut().zip(rows).for_each(|(state, row)| *state = self.state(batch, row)),
        }
    }
}

impl<'a> Surveyor<'a> {
    fn new(survey: Survey, selection: &Selection, model: &'a Model, histories: bool) -> Self {
        let properties = [
            Column::CharacteristicLength,
            Column::BulkPermeability(Part::Slave),
            Column::BulkPermeability(Part::Master),
        ];
        let properties = properties.into_iter().filter_map(|column| Some((selection.number(column)?, column)));
        let counters = [Column::Step, Column::Increment];
        let counters = counters.into_iter().filter_map(|column| Some((selection.number(column)?, column)));
        Self {
            contact: ContactPlaces {
                clearance: selection.number(Column::Clearance),
                pressure: selection.number(Column::Pressure),
                closed: selection.number(Column::Closed),
                state: None,
            },
            area: selection.number(Column::Area),
            properties: properties.collect(),
            counters: counters.collect(),
            time: selection.number(Column::Time).filter(|_| histories),
            node: selection.label(Column::Node),
            rows: RowInteractions::new(model, survey.governed_by, selection.label(Column::Interaction)),
            runs: (survey.order == HistoryOrder::ByNode && histories).then(NodeRuns::new),
            nodes: match survey.order {
                HistoryOrder::ByNode => NodeIndex::by_node(),
                HistoryOrder::Interleaved => NodeIndex::default(),
            },
            last_times: Vec::new(),
            histories: vec![0; survey.interactions.len()],
            first_non_finite: vec![None; survey.columns.len()],
            model,
            survey,
        }
    }

    fn take(&mut self, batch: &Batch, mut kept: Option<&mut KeptRows>, findings: &mut Findings) -> io::Result<()> {
        self.survey.rows += batch.rows as u64;
        let is_suspicious = self.may_hold_what_it_must_not(batch);
        let history = self.node.zip(self.time).map(|(node, time)| (NodeLabels::of(&batch.labels[node]), time));
        let mut first = 0;
        while first < batch.rows {
            let interaction = self.rows.of_row(batch, first);
            let rows = first..self.rows.end_of_run(batch, first);
            first = rows.end;
            let looked_at =
                if is_suspicious || history.is_some() || interaction.is_none() { rows.clone() } else { 0..0 };
            for row in looked_at {
                if is_suspicious {
                    self.check_cells(batch, row, findings);
                }
                match (interaction, &history) {
                    (Some(interaction), Some((nodes, time))) => {
                        let place = (interaction, nodes.get(row), *time);
                        self.check_time(place, batch, row, kept.as_deref_mut(), findings)?;
                    }
                    (Some(_), None) => {}
                    (None, _) => self.report_unknown_interaction(batch, row, findings),
                }
            }
            if let Some(interaction) = interaction {
                self.take_contact(interaction, batch, rows.clone());
                self.take_cells(interaction, batch, rows);
            }
        }
        Ok(())
    }

    /// How many rows are closed and open.
    fn take_contact(&mut self, interaction: usize, batch: &Batch, rows: Range<usize>) {
        let of = &mut self.survey.interactions[interaction];
        of.rows += rows.len() as u64;
        let mut states = [None; ROWS_OF_STATES];
        let mut first = rows.start;
        while first < rows.end {
            let some = first..rows.end.min(first + ROWS_OF_STATES);
            let states = &mut states[..some.len()];
            first = some.end;
            self.contact.states(batch, some, states);
            of.closed += count_states(states, Some(ContactState::Closed));
            of.open += count_states(states, Some(ContactState::Open));
        }
        if let Some(place) = self.contact.clearance {
            // A missing number is NaN, which is not above zero.
            of.above_zero += scan::count_above_zero(&batch.numbers[place].values()[rows]);
        }
    }

    /// Whether [`Self::check_cells`] may find something, by one pass over each column.
    fn may_hold_what_it_must_not(&self, batch: &Batch) -> bool {
        let values = |place: usize| batch.numbers[place].values().iter();
        // A missing number is NaN, which is not negative, and neither 0 nor 1.
        let below_zero = |place: usize| scan::has_below_zero(batch.numbers[place].values());
        self.contact.closed.is_some_and(|place| values(place).any(|value| *value != 0.0 && *value != 1.0))
            || self.area.is_some_and(below_zero)
            || self.properties.iter().any(|(place, _)| below_zero(*place))
            || !self.counters.is_empty()
    }

    /// Contents of the cells of some rows of one interaction, column by column.
    fn take_cells(&mut self, interaction: usize, batch: &Batch, rows: Range<usize>) {
        let columns = &mut self.survey.interactions[interaction].columns;
        if columns.is_empty() {
            columns.resize_with(batch.numbers.len(), ColumnSurvey::default);
        }
        for (place, (column, of)) in batch.numbers.iter().zip(columns).enumerate() {
            let before = of.non_finite;
            of.take(&column.values()[rows.clone()], column.presence().map(|present| &present[rows.clone()]));
            if before < of.non_finite && self.first_non_finite[place].is_none() {
                let row = rows.clone().find(|row| column.get(*row).is_some_and(|value| !value.is_finite()));
                let name = self.survey.header.name_of(self.survey.columns[place]);
                self.first_non_finite[place] = row.map(|row| batch.place(row, Some(name)));
            }
        }
    }

    /// Invalid numbers of cells.
    fn check_cells(&self, batch: &Batch, row: usize, findings: &mut Findings) {
        let name = |column| self.survey.header.name_of(column);
        let number = batch.first_row + row as u64 + 1;
        if let Some(closed) = self.contact.closed.and_then(|place| batch.numbers[place].get(row))
            && closed != 0.0
            && closed != 1.0
        {
            let name = name(Column::Closed);
            let message = format!("`{name}` of row {number} is {closed:?}, which is neither 0 nor 1");
            findings.report(&MALFORMED_CELL, batch.place(row, Some(name)), message, "write 1 for closed, 0 for open");
        }
        let area = self.area.and_then(|place| batch.numbers[place].get(row));
        if let Some(area) = area.filter(|area| *area < 0.0) {
            let name = name(Column::Area);
            let message = format!("`{name}` of row {number} is {area:?}, below zero");
            let help = "give the area of the slave node, or leave the cell empty";
            findings.report(&NEGATIVE_AREA, batch.place(row, Some(name)), message, help);
        }
        for (place, column) in &self.properties {
            let Some(value) = batch.numbers[*place].get(row).filter(|value| *value < 0.0) else { continue };
            let name = name(*column);
            let message = format!("`{name}` of row {number} is {value:?}, below zero");
            let help = "give a number of zero or above, or leave the cell empty";
            findings.report(&NEGATIVE_PROPERTY, batch.place(row, Some(name)), message, help);
        }
        for (place, column) in &self.counters {
            let is_counter = |value: f64| value == value.trunc() && value.abs() <= f64::from(i32::MAX);
            let Some(value) = batch.numbers[*place].get(row).filter(|value| !is_counter(*value)) else { continue };
            let name = name(*column);
            let message = format!("`{name}` of row {number} is {value:?}, which is no whole number of 32 bits");
            let help = "number steps and increments from 1 on, or leave the cell empty";
            findings.report(&MALFORMED_CELL, batch.place(row, Some(name)), message, help);
        }
    }

    /// The times of a node must ascend from row to row (D006).
    fn check_time(
        &mut self,
        (interaction, label, time): (usize, NodeLabel<'_>, usize),
        batch: &Batch,
        row: usize,
        kept: Option<&mut KeptRows>,
        findings: &mut Findings,
    ) -> io::Result<()> {
        let begins = self.runs.as_mut().is_some_and(|runs| runs.take(interaction, label));
        if begins && self.runs.as_ref().is_some_and(|runs| runs.order() == HistoryOrder::Interleaved) {
            self.remember_all_nodes(batch, row, kept)?;
        }
        let Some(time) = batch.numbers[time].get(row) else { return Ok(()) };
        let slot = self.nodes.enter(interaction, label);
        if slot.number == self.last_times.len() {
            self.last_times.push(time);
        }
        let before = std::mem::replace(&mut self.last_times[slot.number], time);
        if slot.is_first {
            self.histories[interaction] += 1;
            return Ok(());
        }
        if time > before {
            return Ok(());
        }
        let message = format!(
            "`time` of node `{label}` is {time:?} in row {} and {before:?} in the row before it",
            batch.first_row + row as u64 + 1
        );
        let help = "sort the rows by time, give nodes of different parts different labels, and leave out the \
                    first frame of a step, which repeats the last of the step before";
        let place = batch.place(row, Some(self.survey.header.name_of(Column::Time)));
        findings.report(&TIME_NOT_ASCENDING, place, message, help);
        Ok(())
    }

    /// From here on the last time of every node is tracked, as the rows of a node are not contiguous; those of earlier rows are scanned again.
    #[cold]
    fn remember_all_nodes(&mut self, batch: &Batch, row: usize, kept: Option<&mut KeptRows>) -> io::Result<()> {
        let (Some(node), Some(time)) = (self.node, self.time) else { return Ok(()) };
        self.runs = None;
        self.survey.order = HistoryOrder::Interleaved;
        self.nodes = NodeIndex::default();
        self.last_times.clear();
        let mut take = |batch: &Batch, rows: usize| {
            let nodes = NodeLabels::of(&batch.labels[node]);
            for row in 0..rows {
                let Some(interaction) = self.rows.of_row(batch, row) else { continue };
                let Some(time) = batch.numbers[time].get(row) else { continue };
                let slot = self.nodes.enter(interaction, nodes.get(row));
                if slot.number == self.last_times.len() {
                    self.last_times.push(time);
                } else {
                    self.last_times[slot.number] = time;
                }
            }
        };
        if let Some(kept) = kept {
            kept.for_each(|batch| take(batch, batch.rows))?;
        }
        take(batch, row);
        Ok(())
    }

    fn report_unknown_interaction(&self, batch: &Batch, row: usize, findings: &mut Findings) {
        let number = batch.first_row + row as u64 + 1;
        let label = self.survey.header.name_of(Column::Interaction);
        let text = String::from_utf8_lossy(self.rows.label_of(batch, row));
        let fault = find_interaction(self.model, &text).err().unwrap_or(NameFault::Unknown);
        let message = match fault {
            _ if text.trim().is_empty() => format!("`{label}` of row {number} is empty"),
            NameFault::Unknown => {
                format!("`{label}` of row {number} is `{}`, which the deck does not define", text.trim())
            }
            NameFault::Ambiguous => {
                format!("`{label}` of row {number} is `{}`, which may be one of several", text.trim())
            }
        };
        findings.report(&UNKNOWN_INTERACTION, batch.place(row, Some(label)), message, fault.help(self.model));
    }

    fn finish(mut self, findings: &mut Findings) -> Survey {
        if self.time.is_some() {
            for (index, of) in self.survey.interactions.iter_mut().enumerate() {
                of.histories = Some(self.histories[index]);
            }
        }
        for (place, first) in self.first_non_finite.into_iter().enumerate() {
            let Some(first) = first else { continue };
            let count: u64 = self.survey.interactions.iter().map(|of| of.column(place).non_finite).sum();
            let name = first.column.clone().unwrap_or_default();
            let rows = if count == 1 { "row" } else { "rows" };
            let message = format!("`{name}` is NaN or infinite in {count} {rows}");
            let help = "results of these rows are NaN or the limit; leave a cell empty where there is no number";
            findings.report(&NON_FINITE, first, message, help);
        }
        self.survey
    }
}
