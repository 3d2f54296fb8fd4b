//! From result files to states: frames of all files joined by their times, fields by the nodes of the mesh.
//!
//! Files are added one by one; the values of an earlier one take precedence, and a later one fills in missing values.

mod frames;
mod nodes;
mod pairs;
mod quantities;

pub use nodes::MatchedBy;

use crate::Error;
use crate::state::{PairTotal, Source, State, TotalQuantity};
use frames::Building;
use inpact_geometry::NodeId;
use inpact_parser::mesh::Mesh;
use inpact_parser::model::Model;
use inpact_results::{Field, Format, Frame, Region, Results, Rows};
use nodes::{FileSurfaces, NodeMap};
use pairs::{PairNames, PairOf, Side};
use quantities::Quantity;
use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::sync::Arc;

/// A result file that can be streamed state by state, more than once.
pub trait ResultFile {
    /// The reason why it cannot be read.
    type Error: From<Error>;

    /// Passes every state to `take` in the order of the file, with the preceding data that belong to no state, until `take` stops; returns the data that belong to no state.
    ///
    /// # Errors
    /// It cannot be read, or not to its end.
    fn frames(&self, take: &mut dyn FnMut(&Results, &Frame) -> ControlFlow<()>) -> Result<Results, Self::Error>;
}

/// Results in memory.
impl ResultFile for Results {
    type Error = Error;

    fn frames(&self, take: &mut dyn FnMut(&Results, &Frame) -> ControlFlow<()>) -> Result<Results, Error> {
        let Self { format, coordinates, surfaces, frames, not_read } = self;
        let head = Results {
            format: *format,
            coordinates: coordinates.clone(),
            surfaces: surfaces.clone(),
            frames: Vec::new(),
            not_read: not_read.clone(),
        };
        for frame in frames {
            if take(&head, frame).is_break() {
                break;
            }
        }
        Ok(head)
    }
}

/// Makes states of result files.
#[derive(Debug)]
pub struct Join<'a> {
    mesh: &'a Mesh,
    /// Nodes move in the analysis of the deck.
    moves: bool,
    pairs: PairNames,
    /// The slave nodes of all pairs, and those of several.
    slaves: Vec<NodeId>,
    shared: Vec<NodeId>,
    building: Vec<Building>,
    files: Vec<FileSummary>,
    notes: Vec<ResultNote>,
}

/// The content of result files on a mesh.
#[derive(Debug)]
pub struct Joined {
    /// One state per time, in the order of times.
    pub states: Vec<State>,
    /// The summary of each file.
    pub files: Vec<FileSummary>,
    /// Notes on parts that could not be used, and on assumptions.
    pub notes: Vec<ResultNote>,
}

/// Summary of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct FileSummary {
    /// The file.
    pub file: Arc<str>,
    /// Its format.
    pub format: Format,
    /// The number of its frames.
    pub frames: usize,
    /// The number of frames with values at a node of a contact surface.
    pub used_frames: usize,
    /// The number of nodes of contact surfaces with values.
    pub nodes: usize,
    /// The method by which its nodes were matched with the mesh.
    pub matched_by: MatchedBy,
}

/// A note on a result file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ResultNote {
    /// The file.
    pub file: Arc<str>,
    /// The note, for users.
    pub message: String,
}

impl<'a> Join<'a> {
    /// Nothing yet.
    pub fn new(mesh: &'a Mesh, model: &Model) -> Self {
        let without_motion = ["HEAT TRANSFER", "COUPLED THERMAL-ELECTRICAL", "MASS DIFFUSION"];
        let moves = model.procedures.iter().any(|procedure| !without_motion.contains(&&*procedure.option.keyword));
        let (slaves, shared) = frames::slave_nodes(mesh);
        Self {
            mesh,
            moves,
            pairs: PairNames::new(mesh),
            slaves,
            shared,
            building: Vec::new(),
            files: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// Adds a file, with one state at a time in memory; a fault of the file as a whole is an error, an unusable part a note.
    ///
    /// # Errors
    /// It cannot be read to its end, or belongs to another mesh.
    pub fn add<F: ResultFile>(&mut self, file: &str, results: &F) -> Result<(), F::Error> {
        let file: Arc<str> = file.into();
        let mut of_file = None;
        let mut failed = None;
        let (mut frames, mut used_frames) = (0, 0);
        let head = results.frames(&mut |head, frame| {
            let of_file = match &mut of_file {
                Some(of_file) => of_file,
                None => match self.begin(&file, (head, Some(frame)), results) {
                    Ok(begun) => of_file.insert(begun),
                    Err(error) => {
                        failed = Some(error);
                        return ControlFlow::Break(());
                    }
                },
            };
            frames += 1;
            used_frames += usize::from(self.frame(frame, of_file));
            ControlFlow::Continue(())
        })?;
        if let Some(error) = failed {
            return Err(error);
        }
        let of_file = match of_file {
            Some(of_file) => of_file,
            None => self.begin(&file, (&head, None), results)?,
        };
        let OfFile { map, used, not_needed, notes, .. } = of_file;
        let mut messages: Vec<String> = notes.into_iter().collect();
        if !not_needed.is_empty() {
            let names: Vec<&str> = not_needed.iter().map(String::as_str).collect();
            messages.push(format!("no node table has a place for {}: not used", names.join(", ")));
        }
        if !head.not_read.is_empty() {
            let listed: Vec<String> =
                head.not_read.iter().map(|what| format!("{} ({})", what.what, what.count)).collect();
            messages.push(format!("not read: {}", listed.join(", ")));
        }
        messages.extend(map.without(self.mesh, &used));
        self.notes.extend(messages.into_iter().map(|message| ResultNote { file: Arc::clone(&file), message }));
        self.files.push(FileSummary {
            file,
            format: head.format,
            frames,
            used_frames,
            nodes: used.len(),
            matched_by: map.matched_by(),
        });
        Ok(())
    }

    /// Matches the labels of a file with nodes of the mesh, from the data before and in its first state.
    fn begin<F: ResultFile>(
        &self,
        file: &Arc<str>,
        (head, first): (&Results, Option<&Frame>),
        results: &F,
    ) -> Result<OfFile, F::Error> {
        let surfaces = || -> Result<FileSurfaces, F::Error> {
            let mut surfaces = FileSurfaces::of(head);
            if let Some(frame) = first {
                surfaces.take(frame);
            }
            // Without surfaces given by faces, the contact regions of all states determine which nodes are on one.
            if head.surfaces.is_empty() {
                results.frames(&mut |_, frame| {
                    surfaces.take(frame);
                    ControlFlow::Continue(())
                })?;
            }
            Ok(surfaces)
        };
        let (map, notes) =
            NodeMap::new(self.mesh, head, surfaces, |message| Error::result_files(format!("{file}: {message}")))?;
        Ok(OfFile {
            file: Arc::clone(file),
            format: head.format,
            map,
            used: BTreeSet::new(),
            not_needed: BTreeSet::new(),
            notes: notes.into_iter().collect(),
        })
    }

    /// Adds the values of a frame; whether there are any.
    fn frame(&mut self, frame: &Frame, of_file: &mut OfFile) -> bool {
        let moment = match frames::moment(frame, &self.mesh.steps) {
            Ok(moment) => moment,
            Err(message) => {
                of_file.note(message);
                return false;
            }
        };
        let of_total = frame.total_time.is_some();
        let mut building = Building::new(self.mesh, moment, of_total, &of_file.file, of_file.format);
        for field in &frame.fields {
            self.field(field, of_file, &mut building);
        }
        if building.is_empty() {
            return false;
        }
        if quantities::is_of_calculix(of_file.format) {
            building.open_where_nothing_is_in_contact(&self.slaves);
        }
        of_file.notes.extend(building.without_shared(&self.shared, self.mesh));
        let near = self.building.iter_mut().filter_map(|other| Some((other.distance(&building)?, other)));
        match near.min_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((_, same)) => {
                let disagreements = same.merge(building, self.mesh);
                of_file.notes.extend(disagreements);
            }
            None => self.building.push(building),
        }
        true
    }

    fn field(&self, field: &Field, of_file: &mut OfFile, building: &mut Building) {
        if matches!(field.rows, Rows::Whole) && self.total(field, of_file, building) {
            return;
        }
        let quantities: Vec<Option<Quantity>> =
            field.columns.iter().map(|column| quantities::of_column(&column.name, of_file.format)).collect();
        if quantities.iter().all(Option::is_none) {
            of_file.not_needed.insert(field.name.to_string());
            return;
        }
        let Rows::Nodes(labels) = &field.rows else {
            let what = match field.rows {
                Rows::FacePoints { .. } => "is of integration points of faces",
                Rows::Elements(_) => "is of elements",
                _ => "is of the pair as a whole",
            };
            // The force of a pair, which is not a value of nodes.
            if !matches!(field.rows, Rows::Whole) {
                of_file.note(format!("{} {what}, not of nodes: not used", field.name));
            }
            return;
        };
        let is_of_contact = quantities.iter().flatten().any(|quantity| quantity.is_of_contact());
        let pair = match self.pairs.of_region(&field.region) {
            PairOf::Pair(pair) => Some(pair),
            PairOf::Unsaid => None,
            PairOf::Unknown if !is_of_contact => None,
            PairOf::Unknown => {
                of_file.note(format!(
                    "{} is of a pair {}, which the deck does not have: not used",
                    field.name,
                    named(&field.region)
                ));
                return;
            }
        };
        let rows: Vec<(usize, NodeId)> = labels
            .iter()
            .enumerate()
            .filter_map(|(row, label)| Some((row, of_file.map.node(&field.region, pair, *label)?)))
            .collect();
        // An empty list of nodes in contact is also information.
        if rows.is_empty() && !(is_of_contact && quantities::is_of_calculix(of_file.format)) {
            return;
        }
        of_file.used.extend(rows.iter().map(|(_, node)| *node));
        for (column, quantity) in field.columns.iter().zip(quantities) {
            let Some(quantity) = quantity else { continue };
            let source = Source::File { quantity: quantity.name(), file: Arc::clone(&of_file.file) };
            let values = rows.iter().filter_map(|(row, node)| {
                let value = column.values[*row];
                (!value.is_nan()).then_some((*node, value))
            });
            building.take(quantity, pair.filter(|_| quantity.is_of_contact()), source, values);
        }
    }

    /// Adds the values of a pair as a whole: its area in contact, or the heat through one of its surfaces; whether there are any.
    fn total(&self, field: &Field, of_file: &mut OfFile, building: &mut Building) -> bool {
        let value = |name: &str| field.column(name).and_then(|column| column.values.first()).copied();
        let of_pair = value("CAREA").map(|area| (TotalQuantity::ContactArea, "CAREA", area));
        // Heat that leaves the body is negative heat into it.
        let of_surface = value("SURFACE_FLUX").map(|flux| (TotalQuantity::HeatIntoSlave, "SURFACE_FLUX", -flux));
        let Some((quantity, name, value)) = of_pair.or(of_surface) else { return false };
        let found = match quantity {
            TotalQuantity::ContactArea => match self.pairs.of_region(&field.region) {
                PairOf::Pair(pair) => Some((quantity, pair)),
                PairOf::Unsaid | PairOf::Unknown => None,
            },
            _ => self.pairs.of_surface(&field.region).map(|(pair, side)| match side {
                Side::Slave => (TotalQuantity::HeatIntoSlave, pair),
                Side::Master => (TotalQuantity::HeatIntoMaster, pair),
            }),
        };
        match found {
            None => of_file.note(format!(
                "{name} is of a surface that is not the slave or the master of one pair alone: not used"
            )),
            Some(_) if value.is_nan() => {}
            Some((quantity, pair)) => {
                let source = Source::File { quantity: name.into(), file: Arc::clone(&of_file.file) };
                building.take_total(PairTotal { quantity, pair, value, source });
            }
        }
        true
    }

    /// The states, completed from *INITIAL CONDITIONS.
    ///
    /// # Errors
    /// No file has values at a node of a contact surface, or several states have no time.
    pub fn finish(mut self) -> Result<Joined, Error> {
        if self.building.is_empty() {
            let names: Vec<String> = self.files.iter().map(|file| format!("`{}`", file.file)).collect();
            let of = if names.is_empty() { "no result file".to_owned() } else { names.join(", ") };
            return Err(Error::result_files(format!("{of} says nothing of the nodes of the contact surfaces")));
        }
        let timeless = self.building.iter().filter(|building| building.moment.time.is_none()).count();
        if 0 < timeless && 1 < self.building.len() {
            let message = format!(
                "{timeless} of {} states have no time, so that no history can be made of them; name files that say times, or one state only",
                self.building.len()
            );
            return Err(Error::result_files(message));
        }
        // The sort is stable: frames of equal time stay in the order of the files.
        self.building.sort_by(|a, b| a.moment.time.unwrap_or_default().total_cmp(&b.moment.time.unwrap_or_default()));
        frames::slip_rates(&mut self.building);
        let mut notes: BTreeSet<String> = BTreeSet::new();
        let mut states = Vec::new();
        for building in self.building {
            let (mut state, missing) = building.finish(self.mesh);
            if let Some(message) = missing {
                notes.insert(message);
            } else if state.displacements.is_none() && self.moves {
                let message = "no displacements (U): areas, the faces across and clearances that nothing else says are those of the undeformed mesh";
                notes.insert(message.to_owned());
            }
            let of_files = state.fields.len();
            state.complete(self.mesh);
            if 0 < of_files || !state.contact.is_empty() {
                let initial = state.fields.iter().filter(|field| field.source == Source::InitialConditions);
                for field in initial {
                    let column = field.quantity.column(inpact_evaluation::nodes::Part::Slave).to_string();
                    let quantity = column.trim_end_matches("_s");
                    notes.insert(format!("no {quantity} of nodes: that of *INITIAL CONDITIONS is taken"));
                }
            }
            states.push(state);
        }
        if let Some(file) = self.files.first().map(|file| Arc::clone(&file.file)) {
            self.notes.extend(notes.into_iter().map(|message| ResultNote { file: Arc::clone(&file), message }));
        }
        Ok(Joined { states, files: self.files, notes: self.notes })
    }
}

/// State of reading a file.
struct OfFile {
    file: Arc<str>,
    format: Format,
    map: NodeMap,
    /// The nodes with values.
    used: BTreeSet<NodeId>,
    /// Fields without a counterpart in node tables.
    not_needed: BTreeSet<String>,
    /// Messages, each once.
    notes: BTreeSet<String>,
}

impl OfFile {
    fn note(&mut self, message: String) {
        self.notes.insert(message);
    }
}

/// The surfaces of a region.
fn named(region: &Region) -> String {
    let name = |name: &Option<inpact_results::Name>| name.as_deref().unwrap_or("?").to_owned();
    format!("`{}` on `{}`", name(&region.slave), name(&region.master))
}
