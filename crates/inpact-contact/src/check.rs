//! The rules on geometry, G001 to G006: contact pairs of a deck judged by the undeformed mesh.

mod rules;

pub use rules::GEOMETRY_RULES;

use rules::{BEYOND_CUTOFF, DEEP_OVERCLOSURE, NODE_BASED_SURFACE, TABLE_NOT_REACHED, WITHOUT_MASTER, WRONG_SIDE};

use crate::pair::across;
use inpact_diagnostics::{Diagnostic, Label, Rule};
use inpact_evaluation::results::push_number;
use inpact_geometry::{ContactNode, Point, Projection};
use inpact_parser::mesh::{Mesh, MeshPair, SurfaceKind};
use inpact_parser::model::{Interaction, Model, TableKind};

/// Checks the pairs of a mesh by all rules on geometry.
///
/// Findings have the span of their pair, without file, line and column.
/// A pair without a valid geometry, or without an interaction of the model, has none.
pub fn check_geometry(mesh: &Mesh, model: &Model) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for pair in &mesh.pairs {
        let interaction = pair.interaction.as_ref().and_then(|name| model.interactions.get(name));
        let thickness = interaction.map_or(1.0, |interaction| interaction.thickness);
        let SurfaceKind::Faces(_) = &mesh.surfaces[pair.master].kind else { continue };
        let Ok(nodes) = mesh.contact(pair, thickness) else { continue };
        let checked = Checked { mesh, model, pair, interaction, nodes };
        // With a surface on its wrong side all other checks are meaningless.
        match checked.wrong_side() {
            Some(finding) => found.push(finding),
            None => found.extend(
                [
                    checked.without_master(),
                    checked.deep_overclosure(),
                    checked.beyond_cutoff(),
                    checked.node_based_surface(),
                ]
                .into_iter()
                .flatten()
                .chain(checked.tables_not_reached()),
            ),
        }
    }
    found
}

/// A pair that is checked.
struct Checked<'a> {
    mesh: &'a Mesh,
    model: &'a Model,
    pair: &'a MeshPair,
    interaction: Option<&'a Interaction>,
    nodes: Vec<ContactNode>,
}

impl Checked<'_> {
    fn finding(&self, rule: &'static Rule, message: String) -> Diagnostic {
        Diagnostic::new(rule, message, Label::new(self.pair.span, ""))
    }

    fn slave(&self) -> &inpact_parser::model::Name {
        &self.mesh.surfaces[self.pair.slave].name
    }

    fn master(&self) -> &inpact_parser::model::Name {
        &self.mesh.surfaces[self.pair.master].name
    }

    fn name(&self, node: &ContactNode) -> String {
        self.mesh.nodes[node.node.index()].to_string()
    }

    /// The slave nodes with an opposite face.
    fn across(&self) -> impl Iterator<Item = (&ContactNode, &Projection)> {
        self.nodes.iter().filter_map(|node| Some((node, across(node)?)))
    }

    /// G001: normals of both surfaces that point the same way.
    fn wrong_side(&self) -> Option<Diagnostic> {
        let cosines = self.across().filter_map(|(node, across)| {
            let normal = node.normal?;
            Some((node, (0..3).map(|k| normal[k] * across.normal[k]).sum::<f64>()))
        });
        let cosines: Vec<(&ContactNode, f64)> = cosines.collect();
        let same: Vec<&ContactNode> =
            cosines.iter().filter(|(_, cosine)| 0.5 < *cosine).map(|(node, _)| *node).collect();
        // Single nodes at an edge have normals of their own.
        if 2 * same.len() <= cosines.len() {
            return None;
        }
        let (slave, master) = (self.slave(), self.master());
        let message = format!(
            "`{slave}` and `{master}` face the same way at {} of {} slave nodes, the first of them {}",
            same.len(),
            cosines.len(),
            self.name(same[0])
        );
        let mut finding = self.finding(&WRONG_SIDE, message);
        finding
            .note("surfaces that touch have normals against each other: one of the two lies on the far side of its elements")
            .help("name the other face of its elements: S1 for S2, SPOS for SNEG");
        Some(finding)
    }

    /// G002: slave nodes beside the master.
    fn without_master(&self) -> Option<Diagnostic> {
        let mut beside = self.nodes.iter().filter(|node| across(node).is_none());
        let first = self.name(beside.next()?);
        let (slave, master) = (self.slave(), self.master());
        let (count, all) = (1 + beside.count(), self.nodes.len());
        let message = match count {
            1 => format!("slave node {first} of `{slave}` has no face of `{master}` across"),
            _ => format!(
                "{count} of {all} slave nodes of `{slave}`, the first of them {first}, have no face of `{master}` across"
            ),
        };
        let mut finding = self.finding(&WITHOUT_MASTER, message);
        finding
            .note("nothing is conducted at a slave node beside its master, and it is in no contact")
            .help("make the master at least as large as the slave, or let the larger surface be the master");
        Some(finding)
    }

    /// G003: slave nodes deeper in the master than the length of its faces.
    fn deep_overclosure(&self) -> Option<Diagnostic> {
        let SurfaceKind::Faces(master) = &self.mesh.surfaces[self.pair.master].kind else { return None };
        let deep = self.across().filter_map(|(node, across)| {
            let face = master.surface.face(across.face);
            let corners = &face.nodes[..face.shape.corners()];
            let points: Vec<Point> = corners.iter().map(|node| self.mesh.points[node.index()]).collect();
            let edge = longest(&points);
            (across.clearance < -edge).then_some((node, across.clearance, edge))
        });
        let deep: Vec<(&ContactNode, f64, f64)> = deep.collect();
        let (node, clearance, edge) = *deep.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
        let message = format!(
            "`{}` is overclosed by {} at slave node {}, where a face of `{}` is {} long{}",
            self.slave(),
            number(-clearance),
            self.name(node),
            self.master(),
            number(edge),
            and_more(deep.len() - 1)
        );
        let mut finding = self.finding(&DEEP_OVERCLOSURE, message);
        finding
            .note("an overclosure larger than an element is no contact that a mesh has at its start: the solver pushes the bodies apart, or finds another face")
            .help("look at places and units of both bodies, and at which surfaces the pair names");
        Some(finding)
    }

    /// G004: a gap too wide for pore fluid at every node.
    fn beyond_cutoff(&self) -> Option<Diagnostic> {
        let permeability = self.interaction?.contact_permeability.as_ref()?;
        let cutoff = permeability.cutoff_flow_across?;
        let (node, clearance) = self.narrowest()?;
        if clearance <= cutoff {
            return None;
        }
        let message = format!(
            "no pore fluid crosses between `{}` and `{}`: the smallest clearance is {}, at slave node {}, and CUTOFF FLOW ACROSS is {}",
            self.slave(),
            self.master(),
            number(clearance),
            self.name(node),
            number(cutoff)
        );
        let mut finding = self.finding(&BEYOND_CUTOFF, message);
        finding
            .note("beyond the cutoff the flow across is zero, unless the surfaces come nearer in a step")
            .help("raise the cutoff, or close the gap of the mesh (ADJUST)");
        Some(finding)
    }

    /// G005: tables against clearance that end before the narrowest place of the gap.
    fn tables_not_reached(&self) -> Vec<Diagnostic> {
        let (Some(interaction), Some((node, clearance))) = (self.interaction, self.narrowest()) else {
            return Vec::new();
        };
        let against = interaction.tables().into_iter().filter(|of| of.kind.is_against_clearance());
        let ends = against.filter_map(|of| {
            let last = (0..of.table.row_count()).map(|row| of.table.row(row)[1]).reduce(f64::max)?;
            Some((of, last)).filter(|(_, last)| *last < clearance)
        });
        ends.map(|(of, last)| {
            let message = format!(
                "no clearance of `{}` on `{}` is within the table of *{} of `{}`: the smallest is {}, at slave node {}, and the last of the table is {}",
                self.slave(),
                self.master(),
                of.keyword,
                interaction.name,
                number(clearance),
                self.name(node),
                number(last)
            );
            let beyond = match of.kind {
                TableKind::ThermalClearance => "nothing is conducted beyond the last clearance of the table",
                _ => "beyond the last clearance of the table its last value holds (or 0, as the manual's figure has it)",
            };
            let mut finding = self.finding(&TABLE_NOT_REACHED, message);
            finding
                .note(format!("{beyond}, unless the surfaces come nearer in a step"))
                .help("compare the units of table and mesh, let the table go on, or close the gap of the mesh (ADJUST)");
            finding
        })
        .collect()
    }

    /// G006: a surface of nodes in a procedure in which it conducts nothing.
    fn node_based_surface(&self) -> Option<Diagnostic> {
        let SurfaceKind::Nodes(_) = &self.mesh.surfaces[self.pair.slave].kind else { return None };
        let conducts = |of: &inpact_parser::model::TableOf<'_>| {
            use TableKind::{ElectricalClearance, ElectricalPressure, ThermalClearance, ThermalPressure};
            matches!(of.kind, ElectricalClearance | ElectricalPressure | ThermalClearance | ThermalPressure)
        };
        let interaction = self.interaction.filter(|interaction| interaction.tables().iter().any(conducts))?;
        let keyword = "COUPLED TEMPERATURE-DISPLACEMENT";
        self.model.procedures.iter().find(|procedure| procedure.option.keyword == keyword)?;
        let message = format!(
            "`{}` is a surface of nodes, which conducts no heat and no current in *{keyword}, and `{}` gives it a conductance",
            self.slave(),
            interaction.name
        );
        let mut finding = self.finding(&NODE_BASED_SURFACE, message);
        finding
            .note("in coupled procedures with displacements only surfaces of elements exchange heat and current")
            .help("make the slave surface of element faces");
        Some(finding)
    }

    /// The slave node that is nearest to the master, if all of them are open.
    fn narrowest(&self) -> Option<(&ContactNode, f64)> {
        let clearances = self.across().map(|(node, across)| (node, across.clearance));
        clearances.min_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, clearance)| 0.0 < *clearance)
    }
}

/// The longest distance between consecutive corners.
fn longest(corners: &[Point]) -> f64 {
    let distance = |a: &Point, b: &Point| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    edges.map(|(a, b)| distance(a, b)).fold(0.0, f64::max)
}

fn and_more(count: usize) -> String {
    if count == 0 { String::new() } else { format!(", and so are {count} more nodes") }
}

fn number(value: f64) -> String {
    let mut text = Vec::new();
    push_number(&mut text, value);
    String::from_utf8_lossy(&text).into_owned()
}
