//! From states to rows: one batch per pair and state.

use crate::Error;
use crate::naming::Names;
use crate::pair::{Pair, across};
use crate::picture::SlaveFaces;
use crate::state::{ContactQuantity, Source, State};
use crate::summary::Origin;
use crate::summary::{ColumnSummary, PairSummary};
use crate::values::{columns, number};
use inpact_evaluation::nodes::{Batch, Column};
use inpact_evaluation::results::push_number;
use inpact_geometry::Vector;
use inpact_parser::mesh::{Mesh, MeshNote, SurfaceKind};
use inpact_parser::model::Model;
use std::sync::Arc;

/// The rows of all pairs of a mesh.
pub struct NodeRows<'a> {
    mesh: &'a Mesh,
    pairs: Vec<Pair<'a>>,
    keys: Vec<Column>,
    numbers: Vec<Column>,
    columns: Vec<ColumnSummary>,
    notes: Vec<MeshNote>,
    rows: u64,
    /// The naming of files in cells of [`Column::Source`], where there is that column.
    naming: Option<FileNaming>,
}

/// Naming of the file of a quantity in a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum FileNaming {
    /// Not at all: there is only one.
    Omitted,
    /// After the quantity: `COPEN@job.fil`.
    Appended,
}

impl std::fmt::Debug for NodeRows<'_> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("NodeRows")
            .field("numbers", &self.numbers)
            .field("rows", &self.rows)
            .finish_non_exhaustive()
    }
}

impl<'a> NodeRows<'a> {
    /// The rows of the pairs whose interaction the model has, with the columns that these states fill.
    ///
    /// # Errors
    /// A pair has no valid geometry as defined in the deck.
    pub fn new(mesh: &'a Mesh, model: &'a Model, states: &[State]) -> Result<Self, Error> {
        let mut notes = Vec::new();
        let mut names = Names::default();
        let mut pairs = Vec::new();
        for (index, pair) in mesh.pairs.iter().enumerate() {
            let (slave, master) = (&mesh.surfaces[pair.slave], &mesh.surfaces[pair.master]);
            let interaction = pair.interaction.as_ref().and_then(|name| model.interactions.get(name));
            let left_out = match (interaction, &pair.interaction, &master.kind) {
                (None, None, _) => Some("names no interaction".to_owned()),
                (None, Some(name), _) => Some(format!("names the interaction `{name}`, which is not defined")),
                (Some(_), _, SurfaceKind::Nodes(_)) => Some("has a master of nodes, which have no faces".to_owned()),
                (Some(_), _, SurfaceKind::Faces(_)) => None,
            };
            let (slave, master) = (slave.name.clone(), master.name.clone());
            let (Some(interaction), None) = (interaction, &left_out) else {
                let reason = left_out.unwrap_or_default();
                let message = format!("the pair of `{slave}` and `{master}` {reason}: its nodes are left out");
                notes.push(MeshNote { span: pair.span, message });
                continue;
            };
            let thickness = interaction.thickness;
            let summary = PairSummary::of(mesh, pair, &interaction.name, thickness);
            let name = |node: &inpact_geometry::ContactNode| names.give(mesh, pair, &interaction.name, node.node);
            let made = Pair::new(mesh, index, thickness, summary, name)?;
            notes.extend(without_master(mesh, &made, states));
            pairs.push(made);
        }
        if 0 < names.renamed
            && let Some(first) = pairs.first()
        {
            let message = format!(
                "{} slave nodes belong to several pairs of one interaction: their rows of the later ones are named with the master, `12:MASTER`",
                names.renamed
            );
            notes.push(MeshNote { span: first.of.span, message });
        }
        let mut keys = vec![Column::Node, Column::Interaction];
        if states.iter().any(|state| state.moment.time.is_some()) {
            keys.push(Column::Time);
        }
        let naming = file_naming(states);
        keys.extend(naming.map(|_| Column::Source));
        let numbers = columns(states);
        let columns = numbers.iter().map(|column| ColumnSummary::new(*column)).collect();
        Ok(Self { mesh, pairs, keys, numbers, columns, notes, rows: 0, naming })
    }

    /// The columns of texts: node, interaction, time where a state has one, and the source of the numbers if there are result files.
    pub fn keys(&self) -> &[Column] {
        &self.keys
    }

    /// The columns of numbers.
    pub fn numbers(&self) -> &[Column] {
        &self.numbers
    }

    /// The pairs left out, and other notes on the rows, with their places.
    pub fn notes(&self) -> &[MeshNote] {
        &self.notes
    }

    /// The number of slave nodes of the pairs, which is the number of rows of a state.
    pub fn nodes(&self) -> usize {
        self.pairs.iter().map(|pair| pair.start.len()).sum()
    }

    /// The number of rows so far.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// The sources of the columns of numbers so far, and their empty cells.
    pub fn columns(&self) -> &[ColumnSummary] {
        &self.columns
    }

    /// Summaries of the pairs that have rows: counts so far, and sources of quantities.
    pub fn summaries(&self) -> impl Iterator<Item = &PairSummary> {
        self.pairs.iter().map(|pair| &pair.summary)
    }

    pub(crate) fn mesh(&self) -> &'a Mesh {
        self.mesh
    }

    pub(crate) fn pairs(&self) -> &[Pair<'a>] {
        &self.pairs
    }

    /// The slave surfaces of the pairs, for drawing.
    pub fn slave_faces(&self) -> SlaveFaces {
        SlaveFaces::of(self.mesh, &self.pairs)
    }

    /// Leaves the column [`Column::Source`] out.
    pub fn without_sources(&mut self) {
        self.naming = None;
        self.keys.retain(|key| *key != Column::Source);
    }

    /// The rows of all states in turn, one batch per pair and state, in the order of the deck.
    pub fn batches<'b>(&'b mut self, states: &'b [State]) -> impl Iterator<Item = Result<Batch, Error>> + use<'a, 'b> {
        let pairs = self.pairs.len();
        let each = states.iter().flat_map(move |state| (0..pairs).map(move |pair| (pair, state)));
        each.map(|(pair, state)| self.batch(pair, state))
    }

    /// The averaged unit normals of the slave surfaces in a state, one per row, in the order of its rows; `None` where there is none.
    ///
    /// # Errors
    /// The nodes have moved to places that have no geometry.
    pub fn normals(&self, state: &State) -> Result<Vec<Option<Vector>>, Error> {
        let mut normals = Vec::with_capacity(self.nodes());
        for pair in &self.pairs {
            normals.extend(pair.contact(self.mesh, state)?.iter().map(|node| node.normal));
        }
        Ok(normals)
    }

    /// Passes the rows of a state to `take`, one batch per pair, in the order of the deck.
    ///
    /// # Errors
    /// The displaced nodes have no valid geometry; and errors of `take`.
    pub fn write<E: From<Error>>(
        &mut self,
        state: &State,
        mut take: impl FnMut(&Batch) -> Result<(), E>,
    ) -> Result<(), E> {
        for pair in 0..self.pairs.len() {
            take(&self.batch(pair, state)?)?;
        }
        Ok(())
    }

    /// The rows of a pair, counted among those that have rows, in a state.
    fn batch(&mut self, pair: usize, state: &State) -> Result<Batch, Error> {
        let pair = &mut self.pairs[pair];
        let contact = pair.contact(self.mesh, state)?;
        let mut summary = pair.summary.clone();
        let mut batch = Batch::with_columns(self.keys.len(), self.numbers.len());
        batch.first_row = self.rows;
        batch.rows = contact.len();
        let time = state.moment.time.map(|time| {
            let mut text = Vec::new();
            push_number(&mut text, time);
            text
        });
        let time = time.as_deref().unwrap_or_default();
        let mut sources = String::new();
        for (node, name) in contact.iter().zip(&pair.names) {
            sources.clear();
            let (mut clearance, mut pressure) = (None, None);
            for (summary, numbers) in self.columns.iter_mut().zip(&mut batch.numbers) {
                let found = number(self.mesh, pair, state, node, summary.column);
                let (value, origin) = found.unzip();
                summary.count(found);
                numbers.push(value);
                match summary.column {
                    Column::Clearance => clearance = value,
                    Column::Pressure => pressure = value,
                    _ => {}
                }
                if let (Some(naming), Some(Some(origin))) = (self.naming, origin) {
                    push_source(&mut sources, summary.column, origin, naming);
                }
            }
            summary.count(clearance, pressure);
            for (key, labels) in self.keys.iter().zip(&mut batch.labels) {
                labels.push(match key {
                    Column::Node => name.as_bytes(),
                    Column::Interaction => pair.summary.interaction.written().as_bytes(),
                    Column::Time => time,
                    _ => sources.as_bytes(),
                });
            }
        }
        if summary.nodes == 0 {
            summary.nodes = contact.len();
            summary.area = contact.iter().map(|node| node.area).sum();
        }
        self.rows += contact.len() as u64;
        drop(contact);
        pair.summary = summary;
        Ok(batch)
    }
}

/// Adds the source of a column: `clearance=COPEN`.
fn push_source(text: &mut String, column: Column, origin: Origin<'_>, naming: FileNaming) {
    if !text.is_empty() {
        text.push(' ');
    }
    *text += &column.to_string();
    let source = match origin {
        Origin::Mesh => {
            *text += "=mesh";
            return;
        }
        Origin::Moved(source) => {
            *text += "=mesh+U";
            source
        }
        Origin::Said(source) => {
            text.push('=');
            *text += source.word();
            source
        }
    };
    if let (FileNaming::Appended, Source::File { file, .. }) = (naming, source) {
        text.push('@');
        *text += file;
    }
}

/// The naming of files in cells; `None` without files.
fn file_naming(states: &[State]) -> Option<FileNaming> {
    let sources = states.iter().flat_map(|state| {
        let fields = state.fields.iter().map(|field| &field.source);
        let contact = state.contact.iter().map(|field| &field.source);
        let outputs = state.outputs.iter().map(|field| &field.source);
        fields.chain(contact).chain(outputs).chain(state.displacements.iter().map(|moved| &moved.source))
    });
    let mut first: Option<&Arc<str>> = None;
    for source in sources {
        let Source::File { file, .. } = source else { continue };
        match first {
            Some(first) if first != file => return Some(FileNaming::Appended),
            _ => first = Some(file),
        }
    }
    first.map(|_| FileNaming::Omitted)
}

/// Notes the slave nodes without an opposite face at the start.
fn without_master(mesh: &Mesh, pair: &Pair<'_>, states: &[State]) -> Option<MeshNote> {
    let mut beside = pair.start.iter().filter(|node| across(node).is_none());
    let first = &mesh.nodes[beside.next()?.node.index()];
    let (slave, master) = (&pair.summary.slave, &pair.summary.master);
    let moves = states.iter().any(|state| {
        state.displacements.is_some() || state.contact.iter().any(|said| said.quantity == ContactQuantity::Clearance)
    });
    let count = 1 + beside.count();
    let (who, has, theirs) = match count {
        1 => (format!("slave node {first} of `{slave}`"), "has", "its clearance is"),
        _ => (format!("{count} slave nodes of `{slave}`, the first of them {first},"), "have", "their clearances are"),
    };
    let rest = if moves { " in the undeformed mesh".to_owned() } else { format!(": {theirs} left empty") };
    let message = format!("{who} {has} no face of `{master}` across{rest}");
    Some(MeshNote { span: pair.of.span, message })
}
