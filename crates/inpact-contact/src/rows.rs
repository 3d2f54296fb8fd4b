//! From states to rows: a batch a pair and state.

use crate::naming::Names;
use crate::state::{NodeField, State};
use crate::summary::{ColumnSummary, PairSummary};
use inpact_evaluation::nodes::{Batch, Column, Part};
use inpact_evaluation::results::push_number;
use inpact_geometry::{ContactNode, GeometryError, NodeId, Point, Projection, Vector};
use inpact_parser::mesh::{InitialQuantity, Mesh, MeshNote, MeshPair, Sliding, SurfaceKind};
use inpact_parser::model::Model;
use std::borrow::Cow;

/// Why the rows of a pair cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("the contact pair of `{slave}` and `{master}` has no geometry{}: {reason}", at(*.time))]
pub struct RowsError {
    slave: String,
    master: String,
    time: Option<f64>,
    reason: String,
}

fn at(time: Option<f64>) -> String {
    time.map_or_else(String::new, |time| format!(" at time {time:?}"))
}

/// The rows of all pairs of a mesh.
pub struct NodeRows<'a> {
    mesh: &'a Mesh,
    pairs: Vec<Pair<'a>>,
    keys: Vec<Column>,
    numbers: Vec<Column>,
    columns: Vec<ColumnSummary>,
    notes: Vec<MeshNote>,
    rows: u64,
}

/// A pair with what the solver starts from.
struct Pair<'a> {
    of: &'a MeshPair,
    thickness: f64,
    start: Vec<ContactNode>,
    /// What ADJUST moves: it has moved before anything else, and is no rule for what follows.
    adjusted: Vec<(NodeId, Vector)>,
    names: Vec<String>,
    summary: PairSummary,
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
    /// Where a pair has no geometry as the deck says it.
    pub fn new(mesh: &'a Mesh, model: &'a Model, states: &[State]) -> Result<Self, RowsError> {
        let mut notes = Vec::new();
        let mut names = Names::default();
        let mut pairs = Vec::new();
        for pair in &mesh.pairs {
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
            let start = mesh.contact(pair, thickness);
            let start = start.and_then(|start| Ok((start, adjusted(mesh, pair, thickness)?)));
            let (start, adjusted) = start.map_err(|error| RowsError {
                slave: slave.to_string(),
                master: master.to_string(),
                time: None,
                reason: reason(mesh, &error),
            })?;
            let given = start.iter().map(|node| names.give(mesh, pair, &interaction.name, node.node)).collect();
            let summary = PairSummary::of(mesh, pair, &interaction.name, thickness);
            let mut beside = start.iter().filter(|node| across(node).is_none());
            if let Some(first) = beside.next() {
                let first = &mesh.nodes[first.node.index()];
                let message = match beside.count() {
                    0 => format!(
                        "slave node {first} of `{slave}` has no face of `{master}` across: its clearance is left empty"
                    ),
                    more => format!(
                        "{} slave nodes of `{slave}`, the first of them {first}, have no face of `{master}` across: their clearances are left empty",
                        more + 1
                    ),
                };
                notes.push(MeshNote { span: pair.span, message });
            }
            pairs.push(Pair { of: pair, thickness, start, adjusted, names: given, summary });
        }
        if 0 < names.told_apart
            && let Some(first) = pairs.first()
        {
            let message = format!(
                "{} slave nodes belong to several pairs of one interaction: their rows of the later ones are named with the master, `12:MASTER`",
                names.told_apart
            );
            notes.push(MeshNote { span: first.of.span, message });
        }
        let mut keys = vec![Column::Node, Column::Interaction];
        if states.iter().any(|state| state.time.is_some()) {
            keys.push(Column::Time);
        }
        let numbers = numbers(states);
        let columns = numbers.iter().map(|column| ColumnSummary::of(*column, states)).collect();
        Ok(Self { mesh, pairs, keys, numbers, columns, notes, rows: 0 })
    }

    /// The columns of names: node, interaction, and time where a state has one.
    pub fn keys(&self) -> &[Column] {
        &self.keys
    }

    /// The columns of numbers.
    pub fn numbers(&self) -> &[Column] {
        &self.numbers
    }

    /// Which pairs were left out, and what else there is to know of the rows, with its place.
    pub fn notes(&self) -> &[MeshNote] {
        &self.notes
    }

    /// How many slave nodes the pairs have: a state has as many rows.
    pub fn nodes(&self) -> usize {
        self.pairs.iter().map(|pair| pair.start.len()).sum()
    }

    /// How many rows there are so far.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Where the columns of numbers come from that are not of the geometry, and where they are empty.
    pub fn columns(&self) -> &[ColumnSummary] {
        &self.columns
    }

    /// The pairs that have rows: how many there are of them so far, and where their quantities come from.
    pub fn summaries(&self) -> impl Iterator<Item = &PairSummary> {
        self.pairs.iter().map(|pair| &pair.summary)
    }

    /// Hands the rows of a state to `take`, a batch a pair, in the order of the deck.
    ///
    /// # Errors
    /// Where the nodes have moved to places that have no geometry; and those of `take`.
    pub fn write<E: From<RowsError>>(
        &mut self,
        state: &State,
        mut take: impl FnMut(&Batch) -> Result<(), E>,
    ) -> Result<(), E> {
        for pair in &mut self.pairs {
            let contact = pair.contact(self.mesh, state)?;
            let mut summary = pair.summary.clone();
            let mut batch = Batch::with_columns(self.keys.len(), self.numbers.len());
            batch.first_row = self.rows;
            batch.rows = contact.len();
            let time = state.time.map(|time| {
                let mut text = Vec::new();
                push_number(&mut text, time);
                text
            });
            for (node, name) in contact.iter().zip(&pair.names) {
                batch.labels[0].push(name.as_bytes());
                batch.labels[1].push(pair.summary.interaction.written().as_bytes());
                if let Some(labels) = batch.labels.get_mut(2) {
                    labels.push(time.as_deref().unwrap_or_default());
                }
                for (summary, numbers) in self.columns.iter_mut().zip(&mut batch.numbers) {
                    let value = number(self.mesh, pair.of, state, node, summary.column);
                    summary.empty += u64::from(value.is_none());
                    numbers.push(value);
                }
            }
            if summary.nodes == 0 {
                summary.nodes = contact.len();
                summary.area = contact.iter().map(|node| node.area).sum();
            }
            summary.count(&contact);
            self.rows += contact.len() as u64;
            pair.summary = summary;
            take(&batch)?;
        }
        Ok(())
    }
}

impl PairSummary {
    fn count(&mut self, contact: &[ContactNode]) {
        for node in contact {
            match across(node) {
                Some(across) if across.clearance <= 0.0 => self.closed += 1,
                Some(_) => self.open += 1,
                None => self.without_master += 1,
            }
        }
    }
}

impl Pair<'_> {
    /// The geometry in a state.
    fn contact(&self, mesh: &Mesh, state: &State) -> Result<Cow<'_, [ContactNode]>, RowsError> {
        let Some(moved) = &state.displacements else { return Ok(Cow::Borrowed(&self.start)) };
        if self.of.sliding == Sliding::Small {
            return Ok(Cow::Owned(self.slid(mesh, moved)));
        }
        let mut points: Vec<Point> = mesh.points.iter().zip(moved).map(|(point, moved)| add(*point, *moved)).collect();
        for (node, offset) in &self.adjusted {
            points[node.index()] = add(points[node.index()], *offset);
        }
        let contact = mesh.contact_at(&points, &without_start(self.of), self.thickness);
        let contact = contact.map_err(|error| RowsError {
            slave: self.summary.slave.to_string(),
            master: self.summary.master.to_string(),
            time: state.time,
            reason: reason(mesh, &error),
        })?;
        Ok(Cow::Owned(contact))
    }

    /// Small sliding: what is across at the start stays across, and areas are those of the start.
    fn slid(&self, mesh: &Mesh, moved: &[Vector]) -> Vec<ContactNode> {
        let mut contact = self.start.clone();
        for node in &mut contact {
            let Some(across) = &mut node.across else { continue };
            let of_slave = moved[node.node.index()];
            let of_master = interpolated(mesh, self.of, across, |node| Some(moved[node.index()]));
            let along = of_master
                .map_or(f64::NAN, |of_master| (0..3).map(|k| (of_slave[k] - of_master[k]) * across.normal[k]).sum());
            across.clearance += along;
        }
        contact
    }
}

/// How ADJUST moves slave nodes onto the master before anything else: each with its way (L).
fn adjusted(mesh: &Mesh, pair: &MeshPair, thickness: f64) -> Result<Vec<(NodeId, Vector)>, GeometryError> {
    let (Some(within), None) = (pair.adjust, pair.clearance) else { return Ok(Vec::new()) };
    let contact = mesh.contact(&without_start(pair), thickness)?;
    let way = |node: ContactNode| {
        let across = node.across.filter(|across| across.clearance <= within)?;
        Some((node.node, across.normal.map(|component| -across.clearance * component)))
    };
    Ok(contact.into_iter().filter_map(way).collect())
}

/// The pair without what holds at the start only.
fn without_start(pair: &MeshPair) -> MeshPair {
    MeshPair { adjust: None, clearance: None, ..pair.clone() }
}

fn add(point: Point, way: Vector) -> Point {
    [0, 1, 2].map(|k| point[k] + way[k])
}

/// What is across from a slave node, where it is across.
fn across(node: &ContactNode) -> Option<&Projection> {
    node.across.as_ref().filter(|across| across.projects)
}

/// The columns that some of the states fill.
fn numbers(states: &[State]) -> Vec<Column> {
    let mut quantities: Vec<InitialQuantity> =
        states.iter().flat_map(|state| &state.fields).map(|field| field.quantity).collect();
    quantities.sort_unstable();
    quantities.dedup();
    let mut columns = vec![Column::Clearance, Column::Area];
    if states.iter().any(|state| state.pressure.is_some()) {
        columns.insert(1, Column::Pressure);
    }
    columns.extend(
        quantities.into_iter().flat_map(|quantity| [column(quantity, Part::Slave), column(quantity, Part::Master)]),
    );
    columns
}

fn column(quantity: InitialQuantity, part: Part) -> Column {
    match quantity {
        InitialQuantity::Temperature => Column::Temperature(part),
        InitialQuantity::PorePressure => Column::PorePressure(part),
        InitialQuantity::FieldVariable(number) => Column::FieldVariable(number, part),
    }
}

/// The number of a slave node in a column; `None` where it is not known.
fn number(mesh: &Mesh, pair: &MeshPair, state: &State, node: &ContactNode, column: Column) -> Option<f64> {
    let (quantity, part) = match column {
        Column::Clearance => return across(node).map(|across| across.clearance),
        Column::Area => return Some(node.area),
        Column::Pressure => return state.pressure.as_ref()?.values[node.node.index()],
        Column::Temperature(part) => (InitialQuantity::Temperature, part),
        Column::PorePressure(part) => (InitialQuantity::PorePressure, part),
        Column::FieldVariable(number, part) => (InitialQuantity::FieldVariable(number), part),
        _ => return None,
    };
    let NodeField { values, .. } = state.field(quantity)?;
    match part {
        Part::Slave => values[node.node.index()],
        _ => {
            let value = |node: NodeId| values[node.index()].map(|value| [value]);
            interpolated(mesh, pair, across(node)?, value).map(|[value]| value)
        }
    }
}

/// A field of the master at the place across; `None` where a node that counts there has no value.
fn interpolated<const N: usize>(
    mesh: &Mesh,
    pair: &MeshPair,
    across: &Projection,
    value: impl Fn(NodeId) -> Option<[f64; N]>,
) -> Option<[f64; N]> {
    let SurfaceKind::Faces(master) = &mesh.surfaces[pair.master].kind else { return None };
    let face = master.surface.face(across.face);
    let mut sum = [0.0; N];
    let nodes: Vec<(NodeId, f64)> =
        face.nodes.iter().copied().zip(across.weights(face.shape)).filter(|(_, weight)| *weight != 0.0).collect();
    let first = value(nodes.first()?.0)?;
    // Differences from one node: a field that is the same in all of them stays what it is, to the last digit.
    for (node, weight) in nodes {
        let value = value(node)?;
        for k in 0..N {
            sum[k] += weight * (value[k] - first[k]);
        }
    }
    for k in 0..N {
        sum[k] += first[k];
    }
    Some(sum)
}

/// What is wrong with a geometry, with the nodes by their names.
fn reason(mesh: &Mesh, error: &GeometryError) -> String {
    let name = |node: &NodeId| mesh.nodes.get(node.index()).map_or_else(String::new, ToString::to_string);
    match error {
        GeometryError::Coordinate { node, coordinate } => {
            format!("node {} has the coordinate {coordinate:?}, whose square is no finite number", name(node))
        }
        GeometryError::Radius { node, radius } => {
            format!("node {} of an axisymmetric surface has the radius {radius:?}, which is negative", name(node))
        }
        other => other.to_string(),
    }
}
