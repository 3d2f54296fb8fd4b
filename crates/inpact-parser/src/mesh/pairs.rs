//! Contact pairs: which surfaces, and what their options mean for the geometry (C-02).

use super::conditions::{Target, Targets};
use super::layout::Entry;
use super::reader::Reader;
use super::{FaceSurface, Mesh, SurfaceKind};
use crate::grammar::Dialect;
use crate::model::{ContactPair, Model, Name, Reference};
use crate::number::read_float;
use crate::span::Span;
use inpact_geometry::{
    ContactNode, DEFAULT_EXTENSION, ElementSpace, Extent, Master, PairOptions, Placed, Point, Shares, contact_nodes,
};
use std::collections::HashMap;

/// Sliding of surfaces on each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sliding {
    /// Any distance.
    Finite,
    /// SMALL SLIDING: the initial projection of a slave node is kept.
    Small,
}

/// The state of the mesh at which the areas of slave nodes are taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AreasOf {
    /// That in which they are needed.
    Now,
    /// The one at the start: surface-to-surface contact of CalculiX, which integrates over the undeformed faces, with NLGEOM too.
    Start,
}

/// A contact pair of the deck.
#[derive(Debug, Clone)]
pub struct MeshPair {
    /// The keyword line, or the line of *CONTACT PROPERTY ASSIGNMENT.
    pub span: Span,
    /// The slave surface, a position in [`Mesh::surfaces`].
    pub slave: usize,
    /// The master surface, likewise.
    pub master: usize,
    /// The interaction.
    pub interaction: Option<Name>,
    /// TYPE: equal shares for NODE TO SURFACE, shape functions for SURFACE TO SURFACE.
    pub shares: Shares,
    /// The state at which areas are taken; with SMALL SLIDING always the initial one.
    pub areas_of: AreasOf,
    /// SMALL SLIDING.
    pub sliding: Sliding,
    /// ADJUST: slave nodes whose clearance is at most this are moved onto the master (L).
    pub adjust: Option<f64>,
    /// EXTENSION ZONE: the extension of the master beyond its outer edge, as a fraction of an edge.
    pub extension: f64,
    /// Whether the thickness of shells is used: not with NO THICKNESS, and not in finite sliding NODE TO SURFACE.
    pub counts_thickness: bool,
    /// *CLEARANCE, VALUE: the clearance of every slave node, overriding the mesh (L).
    pub clearance: Option<f64>,
}

impl Mesh {
    /// The geometry of a pair: area, normal, clearance and projection, for each slave node.
    ///
    /// `thickness` is the first row of the pair's interaction (K-01): the thickness (L) of plane surfaces where no section gives one, and the area (L²) of nodes
    /// of a node-based surface where *SURFACE gives none; 1 where the interaction has no row.
    ///
    /// ADJUST and *CLEARANCE are applied: [`Projection::clearance`](inpact_geometry::Projection) is the initial value of the solver.
    ///
    /// # Errors
    ///
    /// The mesh has no geometry, or the master is of nodes.
    pub fn contact(&self, pair: &MeshPair, thickness: f64) -> Result<Vec<ContactNode>, inpact_geometry::Error> {
        self.contact_at(&self.points, pair, thickness)
    }

    /// The same with displaced nodes, in the order of [`Mesh::points`], for a deformed state.
    ///
    /// ADJUST and *CLEARANCE of the pair are applied here too; they describe the initial state, so for a later state use a pair without them.
    ///
    /// # Errors
    ///
    /// As [`contact`](Self::contact).
    pub fn contact_at(
        &self,
        points: &[Point],
        pair: &MeshPair,
        thickness: f64,
    ) -> Result<Vec<ContactNode>, inpact_geometry::Error> {
        let SurfaceKind::Faces(master) = &self.surfaces[pair.master].kind else { return Ok(Vec::new()) };
        let tree = Master::new(Placed::new(&master.surface, points)?);
        let mut found = match &self.surfaces[pair.slave].kind {
            SurfaceKind::Faces(slave) => {
                let thicknesses: Vec<f64> =
                    slave.thickness.iter().map(|of_section| of_section.unwrap_or(thickness)).collect();
                let options = PairOptions {
                    shares: pair.shares,
                    extent: slave.extent(&thicknesses),
                    slave_shifts: if pair.counts_thickness { &slave.shifts } else { &[] },
                    master_shifts: if pair.counts_thickness { &master.shifts } else { &[] },
                    extension: pair.extension,
                };
                contact_nodes(&Placed::new(&slave.surface, points)?, &tree, &options)?
            }
            SurfaceKind::Nodes(slave) => {
                let node = |(node, area): (&inpact_geometry::NodeId, &Option<f64>)| {
                    let mut across = tree.project(points[node.index()], pair.extension);
                    if let Some(across) = across.as_mut().filter(|_| pair.counts_thickness) {
                        across.clearance -= master.shifts[across.face.index()];
                    }
                    ContactNode { node: *node, area: area.unwrap_or(thickness), normal: None, across }
                };
                slave.nodes.iter().zip(&slave.areas).map(node).collect()
            }
        };
        for across in found.iter_mut().filter_map(|node| node.across.as_mut()) {
            if let Some(clearance) = pair.clearance {
                across.clearance = clearance;
            } else if pair.adjust.is_some_and(|within| across.clearance <= within) {
                across.clearance = 0.0;
            }
        }
        Ok(found)
    }
}

impl FaceSurface {
    /// The factor from lengths to areas of its faces.
    pub fn extent<'a>(&self, thickness: &'a [f64]) -> Extent<'a> {
        match self.space {
            ElementSpace::Spatial => Extent::Spatial,
            ElementSpace::Plane | ElementSpace::Planar => Extent::Plane(thickness),
            ElementSpace::Axisymmetric => Extent::Axisymmetric,
        }
    }
}

/// The surfaces and pairs that the model needs; pairs by position among these surfaces.
#[derive(Default)]
pub(super) struct Request {
    pub(super) surfaces: Targets,
    pub(super) pairs: Vec<MeshPair>,
}

impl MeshPair {
    /// The pair by the positions of its surfaces; `None` where one was not found.
    pub(super) fn with_surfaces(self, positions: &[Option<usize>]) -> Option<Self> {
        Some(Self { slave: positions[self.slave]?, master: positions[self.master]?, ..self })
    }
}

impl Reader<'_, '_> {
    /// The surfaces that *CONTACT PAIR needs, and *CONTACT PROPERTY ASSIGNMENT with two names.
    pub(super) fn request(&mut self, model: &Model) -> Request {
        let mut request = Request::default();
        for option in &model.contact_pairs {
            for surfaces in &option.pairs {
                let Some(master) = &surfaces.master else {
                    self.note(
                        surfaces.slave.span,
                        format!("contact of `{}` with itself is not read", surfaces.slave.name),
                    );
                    continue;
                };
                let (slave, master) = (request.surface(&surfaces.slave), request.surface(master));
                let interaction = option.interaction.as_ref().map(|interaction| interaction.name.clone());
                let pair = self.pair(option, MeshPair::plain(option.span, slave, master, interaction));
                request.pairs.push(pair);
            }
        }
        for line in &model.property_assignments {
            let (Some(first), Some(second)) = (&line.first, &line.second) else {
                self.note(
                    line.span,
                    "surfaces that general contact finds by itself are not read; a line with two names is".to_owned(),
                );
                continue;
            };
            let (slave, master) = (request.surface(first), request.surface(second));
            let interaction = line.interaction.as_ref().map(|interaction| interaction.name.clone());
            // General contact is surface to surface.
            request.pairs.push(MeshPair {
                shares: Shares::ShapeFunctions,
                counts_thickness: true,
                ..MeshPair::plain(line.span, slave, master, interaction)
            });
        }
        let clearances = std::mem::take(&mut self.layout.clearances);
        let mut of_surfaces = HashMap::new();
        if !clearances.is_empty() {
            for (index, pair) in request.pairs.iter().enumerate() {
                of_surfaces.entry([pair.slave, pair.master]).or_insert(index);
            }
        }
        for clearance in clearances {
            self.clearance(clearance, &mut request, &of_surfaces);
        }
        request
    }

    fn pair(&mut self, option: &ContactPair, pair: MeshPair) -> MeshPair {
        let given = |name: &str| option.parameters.iter().find(|parameter| parameter.name == name);
        let value = |name: &str| given(name).and_then(|parameter| parameter.value.as_deref());
        let mut pair = pair;
        match value("TYPE").map(|text| text.replace(' ', "").to_ascii_uppercase()).as_deref() {
            None | Some("NODETOSURFACE") => {}
            Some("SURFACETOSURFACE") => pair.shares = Shares::ShapeFunctions,
            Some(other) => {
                self.note(
                    option.span,
                    format!("TYPE={other} is not known here; areas are those of SURFACE TO SURFACE"),
                );
                pair.shares = Shares::ShapeFunctions;
            }
        }
        if self.dialect == Dialect::Calculix && pair.shares == Shares::ShapeFunctions {
            pair.areas_of = AreasOf::Start;
        }
        if given("SMALL SLIDING").is_some() {
            pair.sliding = Sliding::Small;
        }
        pair.counts_thickness = given("NO THICKNESS").is_none()
            && (pair.sliding == Sliding::Small || pair.shares == Shares::ShapeFunctions);
        if let Some(text) = value("ADJUST") {
            pair.adjust = read_float(text.as_bytes()).ok();
            if pair.adjust.is_none() {
                self.note(
                    option.span,
                    format!("ADJUST={text} names a node set, which is not read: clearances are those of the mesh"),
                );
            }
        }
        if let Some(text) = value("EXTENSION ZONE") {
            match read_float(text.as_bytes()) {
                Ok(extension) => pair.extension = extension,
                Err(_) => self.note(
                    option.span,
                    format!("expected a number as EXTENSION ZONE, found `{text}`; {DEFAULT_EXTENSION} was taken"),
                ),
            }
        }
        for name in ["TIED", "HCRIT", "GEOMETRIC CORRECTION", "SMOOTH"] {
            if given(name).is_some() {
                self.note(
                    option.span,
                    format!("{name} of a contact pair is not honoured: clearances are those of the mesh"),
                );
            }
        }
        pair
    }

    /// Applies a *CLEARANCE; `of_surfaces` has the first pair of a slave and a master.
    fn clearance(&mut self, entry: Entry<'_>, request: &mut Request, of_surfaces: &HashMap<[usize; 2], usize>) {
        let position = |parameter| {
            let named = Reference { name: entry.named(parameter)?, span: entry.span() };
            request.surfaces.known(&Target::Surface(named))
        };
        let surfaces = position("SLAVE").zip(position("MASTER"));
        let pair = surfaces.and_then(|(slave, master)| of_surfaces.get(&[slave, master]));
        let pair = pair.map(|index| &mut request.pairs[*index]);
        let value = entry.parameter("VALUE").map(|text| read_float(text.as_bytes()));
        match (pair, value) {
            (Some(pair), Some(Ok(value))) if pair.sliding == Sliding::Small => pair.clearance = Some(value),
            (Some(pair), Some(Ok(_))) if pair.sliding == Sliding::Finite => {
                self.note(entry.span(), "*CLEARANCE needs a pair with SMALL SLIDING and is not honoured".to_owned());
            }
            _ => self.note(
                entry.span(),
                "*CLEARANCE is honoured with SLAVE and MASTER of a contact pair and a VALUE; this one was not read"
                    .to_owned(),
            ),
        }
    }
}

impl MeshPair {
    fn plain(span: Span, slave: usize, master: usize, interaction: Option<Name>) -> Self {
        Self {
            span,
            slave,
            master,
            interaction,
            shares: Shares::Equal,
            areas_of: AreasOf::Now,
            sliding: Sliding::Finite,
            adjust: None,
            extension: DEFAULT_EXTENSION,
            counts_thickness: false,
            clearance: None,
        }
    }
}

impl Request {
    /// The position of a surface, added if it is new.
    fn surface(&mut self, reference: &Reference) -> usize {
        self.surfaces.position(Target::Surface(reference.clone()))
    }
}
