//! Element types by name: C3D8RHT is a brick, CAX4 a quadrilateral around an axis.

use crate::ElementShape;

/// The space of an element, which determines the out-of-plane extent of its faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ElementSpace {
    /// In space.
    Spatial,
    /// In the plane of x and y, with a thickness.
    Plane,
    /// Around the axis x = 0.
    Axisymmetric,
    /// A line in the plane, which may be plane or axisymmetric: R2D2.
    Planar,
}

/// A type of element that has faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ElementType {
    /// Its shape.
    pub shape: ElementShape,
    /// Its space.
    pub space: ElementSpace,
}

impl ElementType {
    /// The type of this name, case-insensitive; `None` for unknown types.
    ///
    /// Known are stress, heat transfer, convection, coupled, pore pressure, piezoelectric and thermal-electrical elements of first and second order: solids
    /// (C3D…, DC3D…, DCC3D…, Q3D…), plane ones (CPE…, CPS…, CPEG…, DC2D…, DCC2D…), axisymmetric ones (CAX…, CGAX…, DCAX…, DCCAX…), shells (S…, STRI…, DS…, SAX…,
    /// DSAX…), membranes (M3D…, MAX…), surface elements (SFM3D…) and rigid ones (R3D…, R2D2, RAX2).
    /// Not known are acoustic ones, pyramids, those with a variable number of nodes (C3D27, C3D15V), continuum shells, gaskets and cohesive elements, and lines
    /// in space.
    ///
    /// ```
    /// use inpact_geometry::{ElementShape, ElementSpace, ElementType};
    /// let brick = ElementType::named("c3d20rht").expect("a brick");
    /// assert_eq!((brick.shape, brick.space), (ElementShape::Hexahedron20, ElementSpace::Spatial));
    /// assert_eq!(ElementType::named("AC3D8"), None);
    /// assert_eq!(ElementType::named("C3D15V"), None);
    /// ```
    pub fn named(name: &str) -> Option<Self> {
        let name = name.trim().to_ascii_uppercase();
        FAMILIES.iter().find_map(|family| {
            let rest = name.strip_prefix(family.prefix)?;
            let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
            let (count, suffix) = rest.split_at(digits);
            let (_, shape) = family.shapes.iter().find(|(nodes, _)| *nodes == count)?;
            suffix
                .bytes()
                .all(|letter| family.suffixes.as_bytes().contains(&letter))
                .then_some(Self { shape: *shape, space: family.space })
        })
    }
}

/// Types whose names begin alike.
struct Family {
    prefix: &'static str,
    space: ElementSpace,
    /// By the number that follows.
    shapes: &'static [(&'static str, ElementShape)],
    /// Letters that may follow the number: reduced and hybrid integration, incompatible modes, temperature, electric potential, pore pressure, …
    suffixes: &'static str,
}

use ElementShape::{
    Hexahedron8, Hexahedron20, Line2, Line3, Quadrilateral4, Quadrilateral8, Shell3, Shell4, Shell6, Shell8,
    Tetrahedron4, Tetrahedron10, Triangle3, Triangle6, Wedge6, Wedge15,
};

const SOLIDS: &[(&str, ElementShape)] = &[
    ("4", Tetrahedron4),
    ("6", Wedge6),
    ("8", Hexahedron8),
    ("10", Tetrahedron10),
    ("15", Wedge15),
    ("20", Hexahedron20),
];
const PLANES: &[(&str, ElementShape)] =
    &[("3", Triangle3), ("4", Quadrilateral4), ("6", Triangle6), ("8", Quadrilateral8)];
const SHELLS: &[(&str, ElementShape)] = &[("3", Shell3), ("4", Shell4), ("6", Shell6), ("8", Shell8)];
/// Axisymmetric shells and membranes are numbered by their order.
const LINES: &[(&str, ElementShape)] = &[("1", Line2), ("2", Line3)];
const STRESS: &str = "RHITEPMS";
const HEAT: &str = "ED";

const fn family(
    prefix: &'static str,
    space: ElementSpace,
    shapes: &'static [(&'static str, ElementShape)],
    suffixes: &'static str,
) -> Family {
    Family { prefix, space, shapes, suffixes }
}

static FAMILIES: [Family; 27] = [
    family("C3D", ElementSpace::Spatial, SOLIDS, STRESS),
    family("DC3D", ElementSpace::Spatial, SOLIDS, HEAT),
    family("DCC3D", ElementSpace::Spatial, SOLIDS, HEAT),
    family("Q3D", ElementSpace::Spatial, SOLIDS, STRESS),
    family("CPE", ElementSpace::Plane, PLANES, STRESS),
    family("CPS", ElementSpace::Plane, PLANES, STRESS),
    family("CPEG", ElementSpace::Plane, PLANES, STRESS),
    family("DC2D", ElementSpace::Plane, PLANES, HEAT),
    family("DCC2D", ElementSpace::Plane, PLANES, HEAT),
    family("CAX", ElementSpace::Axisymmetric, PLANES, STRESS),
    family("CGAX", ElementSpace::Axisymmetric, PLANES, STRESS),
    family("DCAX", ElementSpace::Axisymmetric, PLANES, HEAT),
    // DCCAX2 is a line, which has no faces.
    family("DCCAX", ElementSpace::Axisymmetric, &[("4", Quadrilateral4)], HEAT),
    family("S", ElementSpace::Spatial, SHELLS, "RSTW5"),
    family("STRI", ElementSpace::Spatial, &[("3", Shell3), ("65", Shell6)], ""),
    family("DS", ElementSpace::Spatial, SHELLS, ""),
    family("M3D", ElementSpace::Spatial, SHELLS, "R"),
    family("SFM3D", ElementSpace::Spatial, SHELLS, "R"),
    family("R3D", ElementSpace::Spatial, &[("3", Shell3), ("4", Shell4)], ""),
    family("SAX", ElementSpace::Axisymmetric, LINES, "T"),
    family("DSAX", ElementSpace::Axisymmetric, LINES, ""),
    family("MAX", ElementSpace::Axisymmetric, LINES, ""),
    family("MGAX", ElementSpace::Axisymmetric, LINES, ""),
    family("SFMAX", ElementSpace::Axisymmetric, LINES, ""),
    family("SFMGAX", ElementSpace::Axisymmetric, LINES, ""),
    family("RAX", ElementSpace::Axisymmetric, &[("2", Line2)], ""),
    family("R2D", ElementSpace::Planar, &[("2", Line2)], ""),
];
