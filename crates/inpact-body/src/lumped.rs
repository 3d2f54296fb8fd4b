//! Conductances and capacities of bodies between their terminals.

use crate::assembly::{Held, Matrix, Sum};
use crate::body::Body;
use crate::conductances::Conductances;
use crate::dissipation::JouleHeat;
use crate::error::{BodyFault, Error};
use crate::even::{Even, even};
use crate::material::{BodyField, tensor, values_at};
use crate::nodes::{NodesOfBodies, NodesOfBody};
use crate::rules::UNUSABLE_PROPERTY;
use crate::solve::{Equations, Solution};
use inpact_geometry::{Conductivity, NodeId, Point};
use inpact_network::ErrorKind;
use inpact_network::linear::{Cholesky, NoSolution};
use inpact_parser::mesh::{BodyMaterial, ElementBlock, MaterialAxes, MaterialProperty, MeshNote, TensorKind};
use inpact_parser::model::Name;
use inpact_parser::span::Span;
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// Conductances and capacities of bodies between their terminals.
#[derive(Debug, Clone)]
pub struct Lumped {
    /// The field.
    pub field: BodyField,
    /// Conductances with isothermal (or equipotential) terminals.
    pub isothermal: Conductances,
    /// Conductances with a uniform flow over each terminal; the values are means over terminals.
    pub even: Conductances,
    /// The terminals, in the requested order.
    pub terminals: Vec<TerminalSummary>,
    /// The bodies that have a terminal.
    pub bodies: Vec<BodySummary>,
    /// The capacity of each terminal (M L² T⁻² θ⁻¹); `None` for a current, where a material of its body has no density or specific heat, and where its body was left out.
    pub capacities: Vec<Option<f64>>,
    /// The minimum and maximum of a potential that is 1 at one terminal and 0 at the others: 0 and 1 by the maximum principle, which a coarse mesh may violate.
    pub potentials: [f64; 2],
    /// Parts of the deck that were ignored for this field, with their places.
    pub left_out: Vec<MeshNote>,
    /// How both problems were solved: with isothermal terminals, and with uniform flows.
    pub solutions: [Solution; 2],
}

/// A terminal: its size, and its deviation from isothermal.
#[derive(Debug, Clone, PartialEq)]
pub struct TerminalSummary {
    /// Its name.
    pub name: Name,
    /// The number of its nodes.
    pub nodes: usize,
    /// Its area (L²); `None` for a node set that does not consist of whole faces, whose nodes share a flow equally.
    pub area: Option<f64>,
    /// Its body, a position in [`Lumped::bodies`]; `None` where that was left out.
    pub body: Option<usize>,
    /// Its conductance to all others with uniform flows: a lower bound for joints with a uniform flow.
    pub lower: f64,
    /// Its conductance to all others with isothermal terminals: an upper bound for all joints.
    pub upper: f64,
    /// With uniform flows, its mean at 1 and those of all others at 0: the difference of its maximum and minimum temperature. 0 where it is isothermal.
    pub range: f64,
}

impl TerminalSummary {
    /// The lumping error: the difference of both conductances, relative to the larger. 0 where it conducts nothing.
    pub fn relative(&self) -> f64 {
        if 0.0 < self.upper { ((self.upper - self.lower) / self.upper).max(0.0) } else { 0.0 }
    }
}

/// A body with a terminal.
#[derive(Debug, Clone, PartialEq)]
pub struct BodySummary {
    /// Its terminals.
    pub terminals: Vec<usize>,
    /// The number of its nodes.
    pub nodes: usize,
    /// The number of its elements.
    pub elements: usize,
    /// Its volume (L³).
    pub volume: f64,
    /// Its capacity (M L² T⁻² θ⁻¹); `None` as for [`Lumped::capacities`].
    pub capacity: Option<f64>,
    /// Its Joule heat.
    pub joule_heat: JouleHeat,
    /// The bound of the lumping error: with uniform flows it conducts less than with isothermal terminals by at most this fraction, for any temperatures
    /// of its terminals. Exact with two terminals, a bound with more.
    pub relative: f64,
}

impl Body {
    /// Solves the bodies between their terminals; properties that depend on temperature are taken at `temperature` (θ).
    ///
    /// # Errors
    ///
    /// A material without a conductivity, one that depends on temperature without `temperature`, a conductivity that is not positive, an orthotropic or anisotropic one in a
    /// section with ORIENTATION or in a rotated instance, an inverted element, or equations without a solution due to rounding.
    pub fn lumped(&self, field: BodyField, temperature: Option<f64>) -> Result<Lumped, Error> {
        let blocks = self.blocks();
        let matrix = self.matrix(&blocks, field, temperature)?;
        let shares: Vec<Even> = self.terminals.iter().map(|terminal| even(self, terminal)).collect();
        let nodes = NodesOfBodies::of(self);
        let (potentials, isothermal_solution) = self.potentials(&matrix, &nodes)?;
        let isothermal = self.isothermal(&matrix, &nodes, &potentials);
        let (even, ranges, even_solution) = self.even(&matrix, &nodes, &shares)?;
        let (held, left_out) = self.held(&blocks, field, temperature)?;
        let bodies = self.summaries(&held, (&isothermal, &even));
        let mut bodies_of: Vec<Option<usize>> = vec![None; self.terminals.len()];
        for (number, body) in bodies.iter().enumerate() {
            body.terminals.iter().for_each(|at| bodies_of[*at] = Some(number));
        }
        let capacity = |at: usize| {
            bodies[bodies_of[at]?].capacity?;
            let mut sum = Sum::default();
            let of_body = nodes.body(self.body_of(&self.terminals[at].nodes) as usize);
            let pairs = potentials[at].iter().zip(of_body.nodes);
            pairs.for_each(|(potential, node)| sum.add(potential * held.capacities[*node as usize]));
            Some(sum.value())
        };
        let capacities = (0..self.terminals.len()).map(capacity).collect();
        let all = || potentials.iter().flatten();
        let terminals = self.terminals.iter().enumerate().map(|(at, terminal)| TerminalSummary {
            name: terminal.name.clone(),
            nodes: terminal.nodes.len(),
            area: shares[at].area,
            body: bodies_of[at],
            lower: even.to_all(at),
            upper: isothermal.to_all(at),
            range: ranges[at],
        });
        Ok(Lumped {
            field,
            terminals: terminals.collect(),
            isothermal,
            even,
            bodies,
            capacities,
            potentials: [all().copied().fold(0.0, f64::min), all().copied().fold(1.0, f64::max)],
            left_out,
            solutions: [isothermal_solution, even_solution],
        })
    }

    /// The potential of a terminal, by the nodes of [`mesh`](Self::mesh): 1 at it, and 0 at all other terminals and in all other bodies; one solution of one linear system.
    ///
    /// # Errors
    ///
    /// As [`lumped`](Self::lumped).
    ///
    /// # Panics
    ///
    /// There is no such terminal.
    pub fn potential(
        &self,
        field: BodyField,
        temperature: Option<f64>,
        terminal: usize,
    ) -> Result<(Vec<f64>, Solution), Error> {
        let matrix = self.matrix(&self.blocks(), field, temperature)?;
        let nodes = self.mesh.points.len();
        let is_held = self.held_nodes();
        let mut potential = vec![0.0; nodes];
        self.terminals[terminal].nodes.iter().for_each(|node| potential[node.index()] = 1.0);
        let mut fields = [potential];
        let solution =
            Equations { matrix: &matrix, is_held: &is_held, sources: vec![vec![0.0; nodes]] }.solve(&mut fields)?;
        let [potential] = fields;
        Ok((potential, solution))
    }

    /// The matrix of some blocks.
    fn matrix(&self, blocks: &[&ElementBlock], field: BodyField, temperature: Option<f64>) -> Result<Matrix, Error> {
        let conductivities = self.conductivities(blocks, field, temperature)?;
        let mut matrix = Matrix::pattern(blocks, self.mesh.points.len());
        for (block, conductivity) in blocks.iter().zip(&conductivities) {
            matrix.add_block(self, block, conductivity).map_err(only)?;
        }
        Ok(matrix)
    }

    /// The conductivity of each block.
    fn conductivities(
        &self,
        blocks: &[&ElementBlock],
        field: BodyField,
        temperature: Option<f64>,
    ) -> Result<Vec<Conductivity>, Error> {
        let mut faults: Vec<BodyFault> = Vec::new();
        let mut found = Vec::new();
        for block in blocks {
            let Some(material) = self.mesh.materials.get(block.material) else {
                let message = format!("the material `{}` is not defined", block.material_name);
                faults.push(BodyFault::at(&UNUSABLE_PROPERTY, block.section, message).of(self.bodies_of(block)));
                continue;
            };
            let Some(property) = field.of(material) else {
                let message = format!(
                    "the material `{}` has no *{}: found `{}` in a body with terminals",
                    material.name,
                    field.keyword(),
                    block.type_name
                );
                faults.push(BodyFault::at(&UNUSABLE_PROPERTY, material.span, message).of(self.bodies_of(block)));
                continue;
            };
            let conductivity = values_at(property, &material.name, temperature)
                .and_then(|values| tensor(property, &material.name, &values))
                .and_then(|conductivity| self.in_axes(conductivity, block, property, material));
            match conductivity {
                Ok(conductivity) => found.push(conductivity),
                Err(fault) => faults.push(fault.of(self.bodies_of(block))),
            }
        }
        // A fault shared by several blocks is kept once, with the bodies of all.
        let mut met: HashMap<(Option<Span>, String), usize> = HashMap::new();
        let mut kept: Vec<BodyFault> = Vec::new();
        for fault in faults {
            match met.entry((fault.span, fault.message.clone())) {
                Entry::Occupied(at) => {
                    let known = &mut kept[*at.get()];
                    let bodies = known.bodies.iter().chain(&fault.bodies).copied().collect();
                    *known = known.clone().of(bodies);
                }
                Entry::Vacant(at) => {
                    at.insert(kept.len());
                    kept.push(fault);
                }
            }
        }
        let faults = kept;
        Error::unless_none(faults)?;
        Ok(found)
    }

    /// A conductivity in global axes; rejects unknown material axes.
    fn in_axes(
        &self,
        conductivity: Conductivity,
        block: &ElementBlock,
        property: &MaterialProperty,
        material: &BodyMaterial,
    ) -> Result<Conductivity, BodyFault> {
        if property.kind == TensorKind::Isotropic {
            return Ok(conductivity);
        }
        let (keyword, name) = (property.keyword, &material.name);
        let message = match &block.axes {
            MaterialAxes::Along(axes) => return Ok(along(&conductivity, axes)),
            MaterialAxes::Unread(orientation, why) => format!(
                "*{keyword} of `{name}` has directions, and the *ORIENTATION `{orientation}` of its section {why}"
            ),
            MaterialAxes::Unsaid if self.mesh.turned.contains(&block.instance) => format!(
                "*{keyword} of `{name}` has directions, and its part stands turned in the assembly: without *ORIENTATION it is not said which axes they follow"
            ),
            MaterialAxes::Unsaid => return Ok(conductivity),
        };
        Err(BodyFault::at(&UNUSABLE_PROPERTY, block.section, message))
    }

    /// The bodies with at least two terminals, each with these; only they conduct between terminals.
    fn groups(&self) -> Vec<(usize, &[usize])> {
        let all = self.parts.iter().map(|part| part.terminals.as_slice()).enumerate();
        all.filter(|(_, terminals)| 1 < terminals.len()).collect()
    }

    fn no_conductance(&self) -> Conductances {
        Conductances::new(self.terminals.len(), self.groups().into_iter().map(|(_, group)| group))
    }

    /// Nodes of bodies with fewer than two terminals, whose value is known at once.
    fn idle(&self) -> Vec<bool> {
        self.part_of.iter().map(|part| self.parts[*part as usize].terminals.len() < 2).collect()
    }

    /// Nodes with given values: those of terminals, and of bodies without a request.
    fn held_nodes(&self) -> Vec<bool> {
        let mut is_held = self.idle();
        for node in self.terminals.iter().flat_map(|terminal| &terminal.nodes) {
            is_held[node.index()] = true;
        }
        is_held
    }

    /// The potential of each terminal at the nodes of its body: 1 at it, 0 at all others.
    fn potentials(&self, matrix: &Matrix, of_bodies: &NodesOfBodies) -> Result<(Vec<Vec<f64>>, Solution), Error> {
        let nodes = self.mesh.points.len();
        let groups = self.groups();
        let is_held = self.held_nodes();
        // The potential of the last terminal of a body is 1 minus the others; bodies are solved together, one terminal of each at a time.
        let rounds = groups.iter().map(|(_, group)| group.len() - 1).max().unwrap_or(0);
        let mut fields = vec![vec![0.0; nodes]; rounds];
        for (round, field) in fields.iter_mut().enumerate() {
            for terminal in groups.iter().filter(|(_, group)| round + 1 < group.len()).map(|(_, group)| group[round]) {
                self.terminals[terminal].nodes.iter().for_each(|node| field[node.index()] = 1.0);
            }
        }
        let equations = Equations { matrix, is_held: &is_held, sources: vec![vec![0.0; nodes]; rounds] };
        let solution = equations.solve(&mut fields)?;
        let mut potentials = vec![Vec::new(); self.terminals.len()];
        for (number, part) in self.parts.iter().enumerate() {
            let Some((last, others)) = part.terminals.split_last() else { continue };
            let of_body = of_bodies.body(number);
            let mut left = vec![1.0; of_body.nodes.len()];
            for (field, terminal) in fields.iter().zip(others) {
                potentials[*terminal] = of_body.values(field);
                left.iter_mut().zip(&potentials[*terminal]).for_each(|(left, value)| *left -= value);
            }
            potentials[*last] = left;
        }
        // Where another terminal is at 1 the remainder is exactly 0, since held values are integers.
        Ok((potentials, solution))
    }

    fn isothermal(&self, matrix: &Matrix, of_bodies: &NodesOfBodies, potentials: &[Vec<f64>]) -> Conductances {
        let mut conductances = self.no_conductance();
        for (part, group) in self.groups() {
            let fields: Vec<&[f64]> = group.iter().map(|terminal| potentials[*terminal].as_slice()).collect();
            let energies = matrix.energies(&of_bodies.body(part), &fields);
            for (i, a) in group.iter().enumerate() {
                for (j, b) in group.iter().enumerate().skip(i + 1) {
                    conductances.set(*a, *b, -energies[i * group.len() + j]);
                }
            }
        }
        conductances
    }

    /// Conductances with even flows, and the ranges of temperature over the terminals.
    fn even(
        &self,
        matrix: &Matrix,
        of_bodies: &NodesOfBodies,
        shares: &[Even],
    ) -> Result<(Conductances, Vec<f64>, Solution), Error> {
        let nodes = self.mesh.points.len();
        let groups = self.groups();
        let mut is_held = self.idle();
        let rounds = groups.iter().map(|(_, group)| group.len() - 1).max().unwrap_or(0);
        let mut sources = vec![vec![0.0; nodes]; rounds];
        for (_, group) in &groups {
            // Only differences matter: one node is held.
            let last = group[group.len() - 1];
            is_held[self.terminals[last].nodes[0].index()] = true;
            for (round, terminal) in group[..group.len() - 1].iter().enumerate() {
                for (sign, of) in [(1.0, *terminal), (-1.0, last)] {
                    for (node, share) in self.terminals[of].nodes.iter().zip(&shares[of].shares) {
                        sources[round][node.index()] += sign * share;
                    }
                }
            }
        }
        let mut fields = vec![vec![0.0; nodes]; rounds];
        let equations = Equations { matrix, is_held: &is_held, sources };
        let solution = equations.solve(&mut fields)?;
        let mut conductances = self.no_conductance();
        let mut ranges = vec![0.0; self.terminals.len()];
        for (part, group) in groups {
            let count = group.len() - 1;
            let of_body = of_bodies.body(part);
            let of_group: Vec<Vec<f64>> = fields[..count].iter().map(|field| of_body.values(field)).collect();
            let of_group: Vec<&[f64]> = of_group.iter().map(Vec::as_slice).collect();
            let resistances = resistances(matrix, &of_body, &of_group, &equations.sources);
            let inverse = inverse(&resistances, count).map_err(|_| {
                Error::without_place("the body was not solved: its resistances are not positive definite".to_owned())
            })?;
            // The conductance to the last terminal follows from the row sums.
            let entry = |i: usize, j: usize| inverse[i * count + j];
            for i in 0..count {
                for j in i + 1..count {
                    conductances.set(group[i], group[j], -entry(i, j));
                }
                conductances.set(group[i], group[count], (0..count).map(|j| entry(i, j)).sum());
            }
            for (at, terminal) in group.iter().enumerate() {
                let flow = |round: usize| {
                    if at == count { -(0..count).map(|j| entry(round, j)).sum::<f64>() } else { entry(round, at) }
                };
                let flows: Vec<f64> = (0..count).map(flow).collect();
                let value = |node: &NodeId| {
                    flows.iter().zip(&of_group).map(|(flow, field)| flow * field[of_body.place_of(*node)]).sum::<f64>()
                };
                let values: Vec<f64> = self.terminals[*terminal].nodes.iter().map(value).collect();
                let highest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                ranges[*terminal] = highest - values.iter().copied().fold(f64::INFINITY, f64::min);
            }
        }
        Ok((conductances, ranges, solution))
    }

    /// The capacities of the elements of some blocks, and what is missing for them.
    fn held(
        &self,
        blocks: &[&ElementBlock],
        field: BodyField,
        temperature: Option<f64>,
    ) -> Result<(OfNodes, Vec<MeshNote>), Error> {
        let mut left_out: Vec<MeshNote> = Vec::new();
        let mut heats = Vec::new();
        // The capacity of a body is known where it is known for all its elements.
        let mut is_known = vec![field == BodyField::Thermal; self.parts.len()];
        for block in blocks {
            let material = &self.mesh.materials[block.material];
            let heat = match field {
                BodyField::Electrical => Ok(0.0),
                BodyField::Thermal => heat_of(material, temperature),
            };
            heats.push(heat.unwrap_or_else(|fault| {
                let note = MeshNote {
                    span: fault.span.unwrap_or(material.span),
                    message: format!("{}, so that its bodies have no capacity here", fault.message),
                };
                if !left_out.contains(&note) {
                    left_out.push(note);
                }
                self.bodies_of(block).into_iter().for_each(|body| is_known[body as usize] = false);
                0.0
            }));
        }
        let pairs: Vec<(&ElementBlock, f64)> = blocks.iter().copied().zip(heats).collect();
        let Held { volumes, capacities } = Held::of(self, &pairs).map_err(only)?;
        Ok((OfNodes { volumes, capacities, is_known }, left_out))
    }

    fn summaries(&self, held: &OfNodes, (isothermal, even): (&Conductances, &Conductances)) -> Vec<BodySummary> {
        let with_terminal = self.parts.iter().enumerate().filter(|(_, part)| !part.terminals.is_empty());
        let [volumes, capacities] = [&held.volumes, &held.capacities].map(|values| self.sums(values));
        let joule_heat = self.joule_heat();
        let summary = |(number, part): (usize, &crate::BodyPart)| BodySummary {
            terminals: part.terminals.clone(),
            nodes: part.nodes,
            elements: part.elements,
            volume: volumes[number].value(),
            capacity: held.is_known[number].then(|| capacities[number].value()),
            joule_heat: joule_heat[number].clone(),
            relative: relative(&part.terminals, isothermal, even),
        };
        with_terminal.map(summary).collect()
    }

    /// The sum over the nodes of each body.
    fn sums(&self, values: &[f64]) -> Vec<Sum> {
        let mut sums = vec![Sum::default(); self.parts.len()];
        for (value, part) in values.iter().zip(&self.part_of) {
            sums[*part as usize].add(*value);
        }
        sums
    }
}

/// Volume and capacity of each node.
struct OfNodes {
    volumes: Vec<f64>,
    capacities: Vec<f64>,
    /// Whether the capacity of each body is known.
    is_known: Vec<bool>,
}

/// A tensor with components along some axes, transformed to global axes: k_ij e_i e_j.
fn along(k: &Conductivity, axes: &[Point; 3]) -> Conductivity {
    let component = |a: usize, b: usize| {
        (0..3).flat_map(|i| (0..3).map(move |j| (i, j))).map(|(i, j)| k[i][j] * axes[i][a] * axes[j][b]).sum()
    };
    [0, 1, 2].map(|a| [0, 1, 2].map(|b| component(a.min(b), a.max(b))))
}

fn only(fault: BodyFault) -> Error {
    Error::unless_none(vec![fault]).expect_err("there is one")
}

/// ρ c of a material.
fn heat_of(material: &BodyMaterial, temperature: Option<f64>) -> Result<f64, BodyFault> {
    let mut product = 1.0;
    for (property, keyword) in [(&material.density, "DENSITY"), (&material.specific_heat, "SPECIFIC HEAT")] {
        let name = &material.name;
        let Some(property) = property else {
            return Err(BodyFault::at(
                &UNUSABLE_PROPERTY,
                material.span,
                format!("the material `{name}` has no *{keyword}"),
            ));
        };
        let value = values_at(property, name, temperature)?[0];
        if !(0.0 < value && value < f64::INFINITY) {
            return Err(BodyFault::at(
                &UNUSABLE_PROPERTY,
                property.span,
                format!("*{keyword} of `{name}` must be above 0: found {value:?}"),
            ));
        }
        product *= value;
    }
    Ok(product)
}

/// The differences of the mean temperatures of terminals, by a unit of flow through each, the upper triangle: b·y + c·x − a(x, y) of fields x and y that the sources b
/// and c produce, whose error is a product of theirs.
fn resistances(matrix: &Matrix, of_body: &NodesOfBody<'_>, fields: &[&[f64]], sources: &[Vec<f64>]) -> Vec<f64> {
    let count = fields.len();
    let product = |source: &[f64], field: &[f64]| {
        let mut sum = Sum::default();
        of_body.nodes.iter().zip(field).for_each(|(node, value)| sum.add(source[*node as usize] * value));
        sum.value()
    };
    let mut resistances = matrix.energies(of_body, fields);
    for (i, x) in fields.iter().enumerate() {
        for (j, y) in fields.iter().enumerate().skip(i) {
            let energy = &mut resistances[i * count + j];
            *energy = product(&sources[i], y) + product(&sources[j], x) - *energy;
        }
    }
    resistances
}

/// The largest fraction, over all temperatures of some terminals, by which uniform flows conduct less than isothermal terminals.
///
/// With S and L the matrices of both without the last terminal, it is 1 − 1/λ for the largest eigenvalue λ of L⁻¹S. As means are less than single values, S ≥ L: no
/// eigenvalue is below 1, so that λ is at most the sum of all of them, the trace, less 1 for each of the others.
fn relative(terminals: &[usize], isothermal: &Conductances, even: &Conductances) -> f64 {
    let Some(count) = terminals.len().checked_sub(1).filter(|count| 0 < *count) else { return 0.0 };
    let entry = |of: &Conductances, i: usize, j: usize| {
        if i == j { of.to_all(terminals[i]) } else { -of.between(terminals[i], terminals[j]) }
    };
    let places = || (0..count).flat_map(|i| (0..count).map(move |j| (i, j)));
    let upper: Vec<f64> = places().map(|(i, j)| entry(even, i, j)).collect();
    let Ok(inverse) = inverse(&upper, count) else { return 1.0 };
    let trace: f64 = places().map(|(i, j)| inverse[i * count + j] * entry(isothermal, i, j)).sum();
    let largest = trace - (count - 1) as f64;
    if largest.is_finite() { (1.0 - 1.0 / largest.max(1.0)).max(0.0) } else { 1.0 }
}

/// The inverse of a symmetric positive definite matrix of which the upper triangle is given.
fn inverse(upper: &[f64], count: usize) -> Result<Vec<f64>, inpact_network::Error> {
    let number = |place: usize| u32::try_from(place).map_err(|_| ErrorKind::NotFactored(NoSolution::Memory));
    let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
    for column in 0..count {
        for row in column..count {
            rows.push(number(row)?);
            values.push(upper[column * count + row]);
        }
        starts.push(number(rows.len())?);
    }
    let mut factor = Cholesky::new(&starts, &rows, values)?;
    let mut inverse = vec![0.0; count * count];
    for column in 0..count {
        let mut unit = vec![0.0; count];
        unit[column] = 1.0;
        factor.solve(&mut unit)?;
        // One half is copied to the other, so that it is exactly symmetric.
        for row in 0..=column {
            inverse[row * count + column] = unit[row];
            inverse[column * count + row] = unit[row];
        }
    }
    Ok(inverse)
}
