//! Conductance and capacity of a solid element: ∫ ∇N·k·∇N dV and ∫ N dV.

use crate::solid::{MAX_SOLID_NODES, SolidPoint, rule};
use crate::vector::{cross, dot, sub};
use crate::{ElementShape, Error, ErrorKind, Integration, Point};

/// A symmetric tensor in global axes: thermal conductivity (M L T⁻³ θ⁻¹), or electrical (C T⁻¹ L⁻¹ φ⁻¹).
pub type Conductivity = [[f64; 3]; 3];

/// A solid element by its shape, without coordinates: integrates conductance and capacity for given nodes.
///
/// ```
/// use inpact_geometry::{ElementShape, Integration, SolidElement};
/// let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let element = SolidElement::new(ElementShape::Tetrahedron4, Integration::Full).expect("a solid");
/// let conductivity = [[6.0, 0.0, 0.0], [0.0, 6.0, 0.0], [0.0, 0.0, 6.0]];
/// let mut matrix = element.integrals();
/// element.conduct(&corners, &conductivity, &mut matrix)?;
/// assert_eq!(matrix.conductance(1, 0), -1.0);
/// assert_eq!(matrix.conductance(0, 0), 3.0);
/// assert!((matrix.volumes().iter().sum::<f64>() - 1.0 / 6.0).abs() < 1e-16);
/// # Ok::<(), inpact_geometry::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct SolidElement {
    points: &'static [SolidPoint],
    nodes: usize,
}

/// Conductance and capacity of an element.
#[derive(Clone, Debug)]
pub struct SolidIntegrals {
    nodes: usize,
    /// The lower triangle, row by row.
    conduction: [f64; MAX_SOLID_NODES * (MAX_SOLID_NODES + 1) / 2],
    volumes: [f64; MAX_SOLID_NODES],
}

impl SolidElement {
    /// The element of a shape; `None` where it is not a three-dimensional solid.
    pub fn new(shape: ElementShape, integration: Integration) -> Option<Self> {
        rule(shape, integration).map(|points| Self { points, nodes: shape.nodes() })
    }

    /// The number of nodes.
    pub fn nodes(&self) -> usize {
        self.nodes
    }

    /// Storage for its conductance and capacity.
    pub fn integrals(&self) -> SolidIntegrals {
        SolidIntegrals {
            nodes: self.nodes,
            conduction: [0.0; MAX_SOLID_NODES * (MAX_SOLID_NODES + 1) / 2],
            volumes: [0.0; MAX_SOLID_NODES],
        }
    }

    /// Integrates over the element with its nodes at these points.
    ///
    /// # Errors
    ///
    /// [`ErrorKind::Inverted`]: its Jacobian is not positive at one of its integration points.
    pub fn conduct(
        &self,
        points: &[Point],
        conductivity: &Conductivity,
        into: &mut SolidIntegrals,
    ) -> Result<(), Error> {
        let n = self.nodes;
        into.conduction.fill(0.0);
        self.each_point(points, into, |point, columns, determinant, into| {
            let inverse = determinant.recip();
            // Rows of the inverse transpose of the Jacobian, which maps derivatives on the reference element to gradients.
            let turned = [cross(columns[1], columns[2]), cross(columns[2], columns[0]), cross(columns[0], columns[1])];
            let mut gradients = [[0.0; 3]; MAX_SOLID_NODES];
            for (gradient, slope) in gradients.iter_mut().zip(&point.slopes).take(n) {
                *gradient = [0, 1, 2]
                    .map(|k| inverse * (turned[0][k] * slope[0] + turned[1][k] * slope[1] + turned[2][k] * slope[2]));
            }
            let weight = point.weight * determinant;
            let mut at = 0;
            for i in 0..n {
                let flux = [0, 1, 2].map(|k| weight * dot(conductivity[k], gradients[i]));
                for gradient in &gradients[..=i] {
                    into.conduction[at] += dot(flux, *gradient);
                    at += 1;
                }
            }
        })
    }

    /// Integrates only the volumes of the nodes.
    ///
    /// # Errors
    ///
    /// As [`conduct`](Self::conduct).
    pub fn hold(&self, points: &[Point], into: &mut SolidIntegrals) -> Result<(), Error> {
        self.each_point(points, into, |_, _, _, _| {})
    }

    /// Calls `take` at each integration point, with the tangents along ξ, η and ζ and their determinant, and gathers the volumes.
    fn each_point(
        &self,
        points: &[Point],
        into: &mut SolidIntegrals,
        mut take: impl FnMut(&SolidPoint, [[f64; 3]; 3], f64, &mut SolidIntegrals),
    ) -> Result<(), Error> {
        let n = self.nodes;
        if points.len() != n {
            return Err(ErrorKind::Values { what: "points", expected: n, found: points.len() }.into());
        }
        // Relative to the first node, so that a mesh far from the origin loses no further digits.
        let mut places = [[0.0; 3]; MAX_SOLID_NODES];
        for (place, point) in places.iter_mut().zip(points) {
            *place = sub(*point, points[0]);
        }
        into.volumes.fill(0.0);
        for point in self.points {
            let mut columns = [[0.0; 3]; 3];
            for (slope, place) in point.slopes.iter().zip(&places).take(n) {
                for (column, slope) in columns.iter_mut().zip(slope) {
                    for (component, coordinate) in column.iter_mut().zip(place) {
                        *component += slope * coordinate;
                    }
                }
            }
            let determinant = dot(columns[0], cross(columns[1], columns[2]));
            if !(0.0 < determinant && determinant < f64::INFINITY) {
                return Err(ErrorKind::Inverted { determinant }.into());
            }
            let weight = point.weight * determinant;
            for (volume, value) in into.volumes.iter_mut().zip(&point.values).take(n) {
                *volume += weight * value;
            }
            take(point, columns, determinant, into);
        }
        Ok(())
    }
}

impl SolidIntegrals {
    /// ∫ ∇N·k·∇N dV of two nodes of the element: the flow out of one (heat per time and temperature, or current per potential) where the other has the value 1 and the rest 0.
    ///
    /// # Panics
    ///
    /// The element has no such nodes.
    pub fn conductance(&self, a: usize, b: usize) -> f64 {
        assert!(a < self.nodes && b < self.nodes, "nodes {a} and {b} of an element of {}", self.nodes);
        let (row, column) = (a.max(b), a.min(b));
        self.conduction[row * (row + 1) / 2 + column]
    }

    /// ∫ N dV of each node (L³); their sum is the volume. Corners of second-order elements have negative ones.
    pub fn volumes(&self) -> &[f64] {
        &self.volumes[..self.nodes]
    }
}
