//! Assembles the equations of one field from a scene at one time: conductances of rows and sources as a linear network.

use crate::dependence::range_of_unknown;
use crate::error::{Error, ErrorKind, RowFault};
use crate::interface::{self, Conducts, Contact, PoreElement, Sides};
use crate::knowledge::{Guess, Knowledge};
use crate::linear::{LinearNetwork, Link, NONE, Sets, Store};
use crate::problem::FieldNodes;
use crate::scene::{Field, SceneInterface};
use inpact_evaluation::law::InterfaceLaws;
use inpact_evaluation::numbers::DoubleDouble;

/// The contribution of the rows to the network of a field, at some state.
#[derive(Debug, Clone, Default)]
pub(crate) struct RowTerms {
    /// The conductance of each row, times its area; infinite where both sides have one value.
    pub(crate) conductances: Vec<f64>,
    /// Slopes per area and conductance of each row.
    pub(crate) slopes: Vec<Conducts>,
}

/// Heat of a current at nodes, with its slopes for Newton's iteration.
#[derive(Debug, Clone)]
pub(crate) struct HeatTerm {
    /// The index among the flows of the potential: links first, then rows.
    pub(crate) flow: usize,
    /// Indices among the nodes of temperature, with their shares of the heat.
    pub(crate) nodes: Vec<(u32, f64)>,
    /// ∂Q/∂Δφ.
    pub(crate) along_jump: f64,
    /// ∂Q/∂θ of either side of a row, by way of its conductance.
    pub(crate) along_temperatures: f64,
}

/// Currents and their jumps in the field of potentials, of a solution or an iterate.
#[derive(Clone, Copy)]
pub(crate) struct Currents<'a> {
    /// Through links, then rows.
    pub(crate) flows: &'a [DoubleDouble],
    pub(crate) rows: &'a RowTerms,
}

/// Evaluates the law of every row of a field.
///
/// # Errors
/// The first row that cannot be solved.
pub(crate) fn row_terms(knowledge: &Knowledge<'_>, field: Field, nodes: &FieldNodes) -> Result<RowTerms, Error> {
    let mut terms = RowTerms::default();
    for &row in &nodes.rows {
        let failed = |fault| Error::from(ErrorKind::Row { row, fault }).of_field(field);
        let Some(laws) = knowledge.problem.laws_of(row as usize) else { continue };
        let (of, contact, sides) = (knowledge.row(row), knowledge.contact(row), knowledge.sides(row));
        let conducts = conducts(knowledge, field, laws, (of, &contact, &sides)).map_err(failed)?;
        let asks_elsewhere = conducts.conductance == 0.0 && knowledge.guess == Guess::WhereRowsConduct;
        let found = if asks_elsewhere { elsewhere(knowledge, field, laws, (of, &contact, &sides)) } else { None };
        let conducts = found.unwrap_or(conducts);
        let conductance = conducts.conductance * of.area;
        let may_be_infinite = field == Field::PorePressure && conducts.conductance.is_infinite();
        let is_usable = conductance >= 0.0 && (conductance.is_finite() || may_be_infinite);
        if !is_usable {
            let (value, area) = (conducts.conductance, of.area);
            let is_product = 0.0 <= value && value.is_finite();
            return Err(failed(if is_product {
                RowFault::TooLarge { conductance: value, area }
            } else {
                RowFault::NoConductance(value)
            }));
        }
        terms.conductances.push(conductance);
        terms.slopes.push(conducts);
    }
    Ok(terms)
}

/// The conductance of a row for a field, with its slopes.
fn conducts(
    knowledge: &Knowledge<'_>,
    field: Field,
    laws: &InterfaceLaws,
    (of, contact, sides): (&SceneInterface, &Contact, &Sides),
) -> Result<Conducts, RowFault> {
    match field {
        Field::Potential => {
            let Some(source) = &laws.electrical else { return Ok(Conducts::default()) };
            let node = node_number(&knowledge.problem.scene.nodes[of.slave as usize]);
            interface::electrical(source, of, contact, sides, knowledge.moment(), node).map_err(RowFault::User)
        }
        Field::Temperature => Ok(interface::thermal(laws, of, contact, sides)),
        Field::PorePressure => match interface::pore(laws, of, contact, sides, knowledge.gap(of)).0 {
            PoreElement::Finite(conducts) => Ok(conducts),
            PoreElement::Constrained => Ok(Conducts { conductance: f64::INFINITY, ..Conducts::default() }),
            PoreElement::NeedsLength => Err(RowFault::NeedsLength),
        },
    }
}

/// The number of temperatures or pore pressures at which a row that conducts nothing at a first guess is evaluated.
const PROBES: u32 = 65;

/// The largest finite conductance elsewhere in the table of a row that conducts nothing at a first guess; `None` where it is zero everywhere.
fn elsewhere(
    knowledge: &Knowledge<'_>,
    field: Field,
    laws: &InterfaceLaws,
    (of, contact, sides): (&SceneInterface, &Contact, &Sides),
) -> Option<Conducts> {
    let [least, greatest] = range_of_unknown(laws, field, contact.state)?;
    let probes = (0..PROBES).map(|probe| {
        let part = f64::from(probe) / f64::from(PROBES - 1);
        let value = [DoubleDouble::new((1.0 - part) * least + part * greatest); 2];
        let sides = match field {
            Field::PorePressure => Sides { pore_pressures: value, ..*sides },
            _ => Sides { temperatures: value, ..*sides },
        };
        conducts(knowledge, field, laws, (of, contact, &sides)).unwrap_or_default()
    });
    let finite = probes.filter(|of| of.conductance.is_finite());
    finite.max_by(|one, other| one.conductance.total_cmp(&other.conductance)).filter(|of| 0.0 < of.conductance)
}

/// Net flow into each node of a field from sources of the scene, friction and gap filling, W, A or L³/T.
pub(crate) fn sources(knowledge: &Knowledge<'_>, field: Field, nodes: &FieldNodes) -> Vec<f64> {
    let scene = knowledge.problem.scene;
    let conditions = scene.conditions(field);
    let given = |node: &u32| conditions.sources.get(node).map_or(0.0, |course| course.at(knowledge.time));
    let mut sources: Vec<f64> = nodes.nodes.iter().map(given).collect();
    let mut add = |of: &SceneInterface, into: [f64; 2]| {
        for (node, flow) in of.nodes().into_iter().zip(into) {
            if let Some(sum) = sources.get_mut(nodes.place[node as usize] as usize) {
                *sum += flow;
            }
        }
    };
    match field {
        Field::Potential => {}
        Field::Temperature => {
            for (row, of) in scene.interfaces.iter().enumerate() {
                add(of, knowledge.problem.friction(row, knowledge.time));
            }
        }
        Field::PorePressure => {
            for &row in &nodes.rows {
                let of = knowledge.row(row);
                let Some(laws) = knowledge.problem.laws_of(row as usize) else { continue };
                let (contact, sides) = (knowledge.contact(row), knowledge.sides(row));
                let (_, filling) = interface::pore(laws, of, &contact, &sides, knowledge.gap(of));
                add(of, filling.map(|flux| flux * of.area));
            }
        }
    }
    sources
}

/// The heat of currents, added to the sources of temperature; with its slopes on request.
pub(crate) fn add_heat(
    knowledge: &Knowledge<'_>,
    potential: &FieldNodes,
    currents: Currents<'_>,
    temperature: &FieldNodes,
    sources: &mut [f64],
    mut slopes: Option<&mut Vec<HeatTerm>>,
) {
    let scene = knowledge.problem.scene;
    let mut put = |flow: usize, nodes: [(u32, f64); 2], heat: f64, along_jump: f64, along_temperatures: f64| {
        let places = nodes.map(|(node, share)| (temperature.place[node as usize], share));
        let carried: Vec<(u32, f64)> = places.into_iter().filter(|(place, _)| *place != NONE).collect();
        for &(place, share) in &carried {
            sources[place as usize] += share * heat;
        }
        if let Some(slopes) = slopes.as_deref_mut() {
            slopes.push(HeatTerm { flow, nodes: carried, along_jump, along_temperatures });
        }
    };
    for (place, &row) in potential.rows.iter().enumerate() {
        let generation = knowledge.problem.laws_of(row as usize).and_then(|laws| laws.heat_generation);
        let (Some(generation), conductance) = (generation, currents.rows.conductances[place]) else { continue };
        if conductance == 0.0 {
            continue;
        }
        let flow = potential.links.len() + place;
        let jump = (currents.flows[flow] / DoubleDouble::new(conductance)).to_f64();
        let of = knowledge.row(row);
        let conducts = currents.rows.slopes[place];
        let found = interface::heat_of_current(conducts.conductance, jump, knowledge.jump_at_start(row), generation);
        let weight = generation.slave_weight;
        // The share of each side is rounded once.
        let shares = if found.heat.total == 0.0 {
            [weight, 1.0 - weight]
        } else {
            [found.heat.slave / found.heat.total, found.heat.master / found.heat.total]
        };
        put(
            flow,
            [(of.slave, shares[0]), (of.master, shares[1])],
            found.heat.total * of.area,
            found.along_jump * of.area,
            0.5 * found.along_conductance * conducts.along_temperature * of.area,
        );
    }
    for (place, &link) in potential.links.iter().enumerate() {
        let of = &scene.links[link as usize];
        let conductance = of.conductances[Field::Potential.index()];
        if of.joule_heat_fraction == 0.0 || conductance.is_infinite() {
            continue;
        }
        let generation = inpact_evaluation::law::HeatGeneration { fraction: of.joule_heat_fraction, slave_weight: 0.5 };
        let jump = (currents.flows[place] / DoubleDouble::new(conductance)).to_f64();
        let start = knowledge.link_jump_at_start(link, conductance);
        let found = interface::heat_of_current(conductance, jump, start, generation);
        put(place, [(of.nodes[0], 0.5), (of.nodes[1], 0.5)], found.heat.total, found.along_jump, 0.0);
    }
}

/// Treatment of nodes with a capacity in the equations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Capacities {
    /// Not at all: steady state.
    None,
    /// They are held at their initial values, which determine all other nodes at the start of a transient.
    Held,
    /// They store the net inflow of the increment.
    Stored,
}

/// The equations of a field as a linear network: its links, then its rows.
pub(crate) fn network(
    knowledge: &Knowledge<'_>,
    field: Field,
    nodes: &FieldNodes,
    rows: &[f64],
    sources: &[f64],
    capacities: Capacities,
) -> LinearNetwork {
    let scene = knowledge.problem.scene;
    let conditions = scene.conditions(field);
    let mut network = LinearNetwork::of_nodes(nodes.nodes.len());
    network.sources.copy_from_slice(sources);
    for (held, node) in network.held.iter_mut().zip(&nodes.nodes) {
        *held = conditions.fixed.get(node).map(|course| course.at(knowledge.time));
    }
    let known = match field {
        Field::PorePressure => &knowledge.pore_pressures,
        _ => &knowledge.temperatures,
    };
    let with_capacity = conditions.capacities.iter().filter(|(_, capacity)| **capacity > 0.0);
    for (&node, &capacity) in with_capacity {
        let place = nodes.place[node as usize];
        match (capacities, knowledge.increment) {
            (Capacities::Held, _) => network.held[place as usize] = Some(known[node as usize].to_f64()),
            (Capacities::Stored, Some(increment)) => {
                let before = increment.before.exact_value(knowledge.problem, field, node).unwrap_or_default();
                network.stores.push(Store { node: place, conductance: capacity / increment.duration, before });
            }
            _ => {}
        }
    }
    let place_of = |node: u32| nodes.place[node as usize];
    network.links.extend(nodes.links.iter().map(|&link| {
        let of = &scene.links[link as usize];
        Link { nodes: of.nodes.map(place_of), conductance: of.conductances[field.index()] }
    }));
    network.links.extend(
        nodes.rows.iter().zip(rows).map(|(&row, &conductance)| Link {
            nodes: scene.interfaces[row as usize].nodes().map(place_of),
            conductance,
        }),
    );
    if capacities == Capacities::Held {
        let is_fixed = |place: u32| conditions.fixed.contains_key(&nodes.nodes[place as usize]);
        part_initial_values(&mut network, is_fixed);
    }
    network
}

/// Opens infinite conductances between nodes with different initial values: at the start these are overdetermined, in the increments the nodes share their storage.
fn part_initial_values(network: &mut LinearNetwork, is_fixed: impl Fn(u32) -> bool) {
    let mut sets = Sets::new(network.held.len());
    // The value of a set from one of its nodes, and whether it is fixed.
    let mut known: Vec<Option<(f64, bool)>> =
        (0..).zip(&network.held).map(|(place, held)| held.map(|value| (value, is_fixed(place)))).collect();
    for link in network.links.iter_mut().filter(|link| link.conductance.is_infinite()) {
        let [one, other] = link.nodes.map(|node| sets.of(node));
        let of = [known[one as usize], known[other as usize]];
        if let [Some((value, fixed)), Some((other, also_fixed))] = of
            && value != other
            && !(fixed && also_fixed)
        {
            link.conductance = 0.0;
            continue;
        }
        sets.join_roots(one, other);
        let [first, second] = of;
        known[one as usize] = match (first, second) {
            (Some((_, false)) | None, Some(_)) => second,
            _ => first,
        };
    }
}

/// The number of a node whose name is a number, for user routines; 0 otherwise.
fn node_number(name: &str) -> i32 {
    name.trim().parse().unwrap_or(0)
}
