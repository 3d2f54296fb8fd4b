//! A state under construction: the values of the frames of one time, collected node by node.

use super::nodes::nodes_of;
use super::quantities::Quantity;
use crate::state::{
    ContactField, ContactQuantity, Displacements, HeatFlux, Moment, NodeField, OutputField, PairTotal, Source, State,
};
use inpact_geometry::{ElementSpace, NodeId, Vector};
use inpact_parser::mesh::{Mesh, SurfaceKind};
use inpact_parser::model::Name;
use inpact_results::{Format, Frame};
use std::collections::HashSet;
use std::sync::Arc;

/// The largest difference of two values of one node in two files, as a share of the larger: reports have four digits or more.
const SAME: f64 = 1e-3;

/// A state under construction.
#[derive(Debug)]
pub(super) struct Building {
    pub(super) moment: Moment,
    /// The relative error of the time due to the printed digits.
    digits: f64,
    files: Vec<Arc<str>>,
    nodes: usize,
    said: Vec<Said>,
    totals: Vec<PairTotal>,
}

/// Values of a quantity from one file, or from several for different nodes.
#[derive(Debug, Clone)]
struct Said {
    quantity: Quantity,
    pair: Option<usize>,
    source: Source,
    values: Vec<Option<f64>>,
}

/// The time of a frame; an error where it is not a state.
pub(super) fn moment(frame: &Frame, steps: &[Option<Name>]) -> Result<Moment, String> {
    let named = frame.step_name.as_ref().and_then(|name| step_number(name, steps));
    let step = frame.step.or(named);
    // The first step begins with the analysis.
    let of_first_step = frame.step_time.filter(|_| step == Some(1) || steps.len() <= 1);
    let time = frame.total_time.or(of_first_step);
    if time.is_some_and(f64::is_nan) {
        return Err("frames whose time is no number are not used".to_owned());
    }
    if time.is_none() && frame.step_time.is_some() {
        let name = frame.step_name.as_deref().unwrap_or("?");
        return Err(format!(
            "frames of step `{name}` say their time within the step only, and nothing says how long the steps before it took: not used"
        ));
    }
    Ok(Moment { time, step, increment: frame.increment, step_time: frame.step_time })
}

/// The number of a step by its name; without one, Abaqus calls it `Step-1`.
fn step_number(name: &str, steps: &[Option<Name>]) -> Option<i64> {
    let wanted = Name::new(name);
    let at = steps.iter().position(|step| step.as_ref() == Some(&wanted));
    let numbered = || {
        let number: usize = wanted.canonical().strip_prefix("STEP-")?.parse().ok()?;
        number.checked_sub(1).filter(|at| steps.get(*at).is_some_and(Option::is_none))
    };
    at.or_else(numbered).and_then(|at| i64::try_from(at + 1).ok())
}

impl Building {
    pub(super) fn new(mesh: &Mesh, moment: Moment, of_total: bool, file: &Arc<str>, format: Format) -> Self {
        let digits = match format {
            Format::Fil | Format::Vtu => 1e-12,
            // Four digits of the time within a step, eight of XY data.
            Format::Rpt if !of_total => 1e-3,
            Format::Rpt | Format::Frd | Format::Dat => 1e-6,
        };
        Self {
            moment,
            digits,
            files: vec![Arc::clone(file)],
            nodes: mesh.nodes.len(),
            said: Vec::new(),
            totals: Vec::new(),
        }
    }

    /// Whether it is empty.
    pub(super) fn is_empty(&self) -> bool {
        self.said.is_empty() && self.totals.is_empty()
    }

    /// Adds a value of a pair as a whole; the first takes precedence.
    pub(super) fn take_total(&mut self, total: PairTotal) {
        let is_same = |known: &PairTotal| (known.quantity, known.pair) == (total.quantity, total.pair);
        if !self.totals.iter().any(is_same) {
            self.totals.push(total);
        }
    }

    /// Adds values of a quantity; the first value of a node takes precedence.
    pub(super) fn take(
        &mut self,
        quantity: Quantity,
        pair: Option<usize>,
        source: Source,
        values: impl Iterator<Item = (NodeId, f64)>,
    ) {
        let is = |said: &Said| said.quantity == quantity && said.pair == pair && said.source == source;
        let at = self.said.iter().position(is).unwrap_or_else(|| {
            self.said.push(Said { quantity, pair, source, values: vec![None; self.nodes] });
            self.said.len() - 1
        });
        for (node, value) in values {
            self.said[at].values[node.index()].get_or_insert(value);
        }
    }

    /// CalculiX lists nodes in contact, in some releases every node, with zeros for the others: a slave node without numbers, or with zeros, is open.
    ///
    /// Its pressure and shear are then 0, and its clearance is unknown.
    pub(super) fn open_where_nothing_is_in_contact(&mut self, slaves: &[NodeId]) {
        let is_contact = |said: &Said| matches!(said.quantity, Quantity::Contact(..));
        let closed: HashSet<NodeId> = self
            .said
            .iter()
            .filter(|said| is_contact(said))
            .flat_map(|said| slaves.iter().filter(|node| said.values[node.index()].is_some_and(|value| value != 0.0)))
            .copied()
            .collect();
        for said in &mut self.said {
            let open = match said.quantity {
                Quantity::Contact(ContactQuantity::Clearance, _) => None,
                Quantity::Contact(ContactQuantity::Pressure, _) | Quantity::Shear(_) => Some(0.0),
                _ => continue,
            };
            for node in slaves.iter().filter(|node| !closed.contains(node)) {
                said.values[node.index()] = open;
            }
        }
    }

    /// Removes values without a pair at nodes that are slaves of several pairs, with a note.
    pub(super) fn without_shared(&mut self, shared: &[NodeId], mesh: &Mesh) -> Option<String> {
        let mut first = None;
        let of_contact = self.said.iter_mut().filter(|said| said.quantity.is_of_contact() && said.pair.is_none());
        for said in of_contact {
            for node in shared {
                // Zero pressure is zero for every pair.
                if said.values[node.index()].take_if(|value| *value != 0.0).is_some() {
                    first.get_or_insert(*node);
                }
            }
        }
        let first = &mesh.nodes[first?.index()];
        Some(format!(
            "contact of nodes that are slaves of several pairs, such as {first}, is not said pair by pair: not used"
        ))
    }

    /// The difference of two of them in time, where they are of one state.
    pub(super) fn distance(&self, other: &Self) -> Option<f64> {
        let of = |moment: &Moment| moment.step.zip(moment.increment);
        if let (Some(own), Some(others)) = (of(&self.moment), of(&other.moment)) {
            return (own == others).then_some(0.0);
        }
        let (own, others) = (self.moment.time?, other.moment.time?);
        let of_one_file = self.files.iter().any(|file| other.files.contains(file));
        let digits = if of_one_file { 0.0 } else { self.digits.max(other.digits) };
        let distance = (own - others).abs();
        (distance <= digits * own.abs().max(others.abs())).then_some(distance)
    }

    /// Merges another one of the same state, which fills in missing values; notes disagreements.
    pub(super) fn merge(&mut self, other: Self, mesh: &Mesh) -> Vec<String> {
        let mut disagreements = Vec::new();
        let (own, others) = (&mut self.moment, other.moment);
        if other.digits < self.digits {
            own.time = others.time.or(own.time);
            self.digits = other.digits;
        }
        own.step = own.step.or(others.step);
        own.increment = own.increment.or(others.increment);
        own.step_time = own.step_time.or(others.step_time);
        for file in other.files {
            if !self.files.contains(&file) {
                self.files.push(file);
            }
        }
        for total in other.totals {
            self.take_total(total);
        }
        for said in other.said {
            let same = self.said.iter().find(|known| {
                known.quantity == said.quantity && known.pair == said.pair && known.source != said.source
            });
            disagreements.extend(same.and_then(|known| known.disagreement(&said, mesh)));
            let values = (0..).map(NodeId).zip(&said.values).filter_map(|(node, value)| Some((node, (*value)?)));
            let values: Vec<(NodeId, f64)> = values.collect();
            self.take(said.quantity, said.pair, said.source, values.into_iter());
        }
        disagreements
    }

    /// The slip that is accumulated by each node of a pair, its components in their order.
    fn slips(&self) -> Vec<(Option<usize>, Vec<Option<Vector>>)> {
        self.vectors(|quantity| match quantity {
            Quantity::Slip(at) => Some(at),
            _ => None,
        })
    }

    fn shears(&self) -> Vec<(Option<usize>, Vec<Option<Vector>>)> {
        self.vectors(|quantity| match quantity {
            Quantity::Shear(at) => Some(at),
            _ => None,
        })
    }

    /// Vectors of nodes by pairs, of their components; one that is not there is 0.
    fn vectors(&self, component: impl Fn(Quantity) -> Option<usize>) -> Vec<(Option<usize>, Vec<Option<Vector>>)> {
        let mut found: Vec<(Option<usize>, Vec<Option<Vector>>)> = Vec::new();
        for said in &self.said {
            let Some(component) = component(said.quantity) else { continue };
            let at = found.iter().position(|(pair, _)| *pair == said.pair).unwrap_or_else(|| {
                found.push((said.pair, vec![None; self.nodes]));
                found.len() - 1
            });
            for (vector, value) in found[at].1.iter_mut().zip(&said.values) {
                if let Some(value) = value {
                    vector.get_or_insert([0.0; 3])[component] = *value;
                }
            }
        }
        found
    }

    fn source_of(&self, is: impl Fn(Quantity) -> bool) -> Option<Source> {
        self.said.iter().find(|said| is(said.quantity)).map(|said| said.source.clone())
    }

    /// The state, and the reason why its displacements are not used.
    pub(super) fn finish(self, mesh: &Mesh) -> (State, Option<String>) {
        let mut state = State { moment: self.moment, ..State::default() };
        let displacements = self.displacements(mesh);
        let missing = displacements.as_ref().and_then(|found| found.as_ref().err().cloned());
        state.displacements = displacements.and_then(Result::ok);
        let shears = self.shears();
        if let Some(source) = self.source_of(|quantity| matches!(quantity, Quantity::Shear(_))) {
            for (pair, vectors) in shears {
                let values: Vec<Option<f64>> = vectors.into_iter().map(|vector| vector.map(length)).collect();
                // Frictionless contact has 0 everywhere, which is dropped.
                if values.iter().flatten().any(|value| *value != 0.0) {
                    let (quantity, source) = (ContactQuantity::Shear, source.clone());
                    state.contact.push(ContactField { quantity, pair, values, source });
                }
            }
        }
        let fluxes = self.vectors(|quantity| match quantity {
            Quantity::HeatFlux(at) => Some(at),
            _ => None,
        });
        if let (Some((_, vectors)), Some(source)) =
            (fluxes.into_iter().next(), self.source_of(|quantity| matches!(quantity, Quantity::HeatFlux(_))))
        {
            state.heat_flux = Some(HeatFlux { vectors, source });
        }
        state.totals.extend_from_slice(&self.totals);
        let slides = !state.contact.is_empty();
        for Said { quantity, pair, source, values } in self.said {
            if values.iter().all(Option::is_none) {
                continue;
            }
            match quantity {
                Quantity::Node(quantity, _) => state.fields.push(NodeField { quantity, values, source }),
                Quantity::Contact(ContactQuantity::SlipRate, _) if !slides => {}
                Quantity::Contact(quantity, _) => {
                    state.contact.push(ContactField { quantity, pair, values, source });
                }
                Quantity::Output(output) => state.outputs.push(OutputField { output, pair, values, source }),
                Quantity::Displacement(_) | Quantity::Shear(_) | Quantity::Slip(_) | Quantity::HeatFlux(_) => {}
            }
        }
        (state, missing)
    }

    /// The displacements of the nodes; an error where not all are known, nothing where none is.
    fn displacements(&self, mesh: &Mesh) -> Option<Result<Displacements, String>> {
        let source = self.source_of(|quantity| matches!(quantity, Quantity::Displacement(_)))?;
        let is_flat =
            |kind: &SurfaceKind| matches!(kind, SurfaceKind::Faces(faces) if faces.space != ElementSpace::Spatial);
        let components = if mesh.surfaces.iter().any(|surface| is_flat(&surface.kind)) { 2 } else { 3 };
        let mut vectors = vec![[0.0; 3]; self.nodes];
        for at in 0..components {
            let of_component = self.said.iter().filter(|said| said.quantity == Quantity::Displacement(at));
            for (node, vector) in vectors.iter_mut().enumerate() {
                match of_component.clone().find_map(|said| said.values[node]) {
                    Some(value) => vector[at] = value,
                    None => {
                        return Some(Err(format!(
                            "U{} of node {} is not said: the displacements of that state are not used, its areas, the faces across and clearances that nothing else says are those of the undeformed mesh",
                            at + 1,
                            mesh.nodes[node]
                        )));
                    }
                }
            }
        }
        Some(Ok(Displacements { vectors, source }))
    }
}

impl Said {
    /// A node at which another differs.
    fn disagreement(&self, other: &Self, mesh: &Mesh) -> Option<String> {
        let differs = |(own, others): (&Option<f64>, &Option<f64>)| {
            let (own, others) = ((*own)?, (*others)?);
            Some((own, others)).filter(|_| SAME * own.abs().max(others.abs()) < (own - others).abs())
        };
        let found = self.values.iter().zip(&other.values).map(differs);
        let mut found = found.enumerate().filter_map(|(node, values)| Some((node, values?)));
        let (node, (own, others)) = found.next()?;
        Some(format!(
            "{} differs from {} at {} nodes, at {} it is {others} where the other is {own}: what was named first counts",
            other.source,
            self.source,
            1 + found.count(),
            mesh.nodes[node]
        ))
    }
}

/// The slave nodes of all pairs, each once, and those among them that several pairs have.
pub(super) fn slave_nodes(mesh: &Mesh) -> (Vec<NodeId>, Vec<NodeId>) {
    let mut counts = vec![0_u32; mesh.nodes.len()];
    for pair in &mesh.pairs {
        for node in nodes_of(&mesh.surfaces[pair.slave].kind) {
            counts[node.index()] += 1;
        }
    }
    let of = |least: u32| (0..).map(NodeId).zip(&counts).filter(move |(_, count)| least <= **count);
    (of(1).map(|(node, _)| node).collect(), of(2).map(|(node, _)| node).collect())
}

/// Adds to states in the order of time the rate of slip since the previous one; before the first there is none.
pub(super) fn slip_rates(building: &mut [Building]) {
    let mut before: Vec<(Option<usize>, f64, Vec<Option<Vector>>)> = Vec::new();
    for state in building {
        let Some(time) = state.moment.time else { continue };
        let Some(source) = state.source_of(|quantity| matches!(quantity, Quantity::Slip(_))) else { continue };
        for (pair, slips) in state.slips() {
            let known = before.iter().position(|(of, ..)| *of == pair);
            let since = known.map_or(0.0, |at| before[at].1);
            let rate = |(node, slip): (usize, &Option<Vector>)| {
                let earlier = match known {
                    Some(at) => before[at].2[node]?,
                    None => [0.0; 3],
                };
                let slip = (*slip)?;
                let way = length([0, 1, 2].map(|k| slip[k] - earlier[k]));
                (since < time).then(|| (node, way / (time - since)))
            };
            let rates: Vec<(NodeId, f64)> = slips
                .iter()
                .enumerate()
                .filter_map(rate)
                .filter_map(|(node, rate)| Some((NodeId(u32::try_from(node).ok()?), rate)))
                .collect();
            state.take(Quantity::Contact(ContactQuantity::SlipRate, "CSLIP"), pair, source.clone(), rates.into_iter());
            match known {
                Some(at) => before[at] = (pair, time, slips),
                None => before.push((pair, time, slips)),
            }
        }
    }
}

fn length(vector: Vector) -> f64 {
    vector.iter().map(|component| component * component).sum::<f64>().sqrt()
}
