//! The part of a surface that is opposite another one: its area, and ∫ N dA over it, by its nodes.
//!
//! Faces are subdivided into cells, adaptively at the edge of the other surface; cells of the last level count by their integration points that are opposite.
//! The integrals of a face that is opposite as a whole are exact to rounding; the area of one that is cut is within some 0.1 % of the face's.

use crate::coordinates::Placed;
use crate::face_shape::{MAX_NODES, evaluate, monomials};
use crate::patch::Patch;
use crate::quadrature::rule;
use crate::search::Master;
use crate::spread;
use crate::vector::{dot, norm};
use crate::{Error, ErrorKind, FaceId, FaceShape};

/// The part of a surface that is opposite another one.
#[derive(Clone, Debug, PartialEq)]
pub struct Overlap {
    /// Its area (L²).
    pub area: f64,
    /// ∫ N dA over it (L²) of each node, in the order of [`Surface::nodes`](crate::Surface::nodes).
    pub shares: Vec<f64>,
    /// Whether a face is at least partly in it, by face.
    pub faces: Vec<bool>,
}

/// The minimum and maximum level of subdivision of a face: 4 and 16,384 cells of a square.
const CUTS: [u32; 2] = [1, 7];

/// The inset of a point in its cell, as a fraction of half the cell: cells along the other surface's edge are on one side of it.
const INSIDE: f64 = 1e-4;

/// The part of a surface that is opposite `other`: where a point projects onto it, and both face each other.
///
/// ```
/// use inpact_geometry::{Face, FaceShape, Master, NodeId, overlap, Placed, Surface};
/// // A square of 2 by 2, and one of 1 by 1 a little above its corner.
/// let square = |z: f64, side: f64| [[0.0, 0.0, z], [side, 0.0, z], [side, side, z], [0.0, side, z]];
/// let points = [square(0.0, 2.0), square(0.1, 1.0)].concat();
/// let surface = |nodes: [u32; 4]| Surface::new([Face { shape: FaceShape::Quadrilateral4, nodes: &nodes.map(NodeId) }]);
/// let (lower, upper) = (surface([0, 1, 2, 3])?, surface([7, 6, 5, 4])?);
/// let (lower, upper) = (Placed::new(&lower, &points)?, Placed::new(&upper, &points)?);
/// assert!((overlap(&upper, &Master::new(lower))?.area - 1.0).abs() < 1e-14);
/// let found = overlap(&lower, &Master::new(upper))?;
/// assert!((found.area - 1.0).abs() < 0.01);
/// // ∫ (1 − x/2)(1 − y/2) dA
/// assert!((found.shares[0] - 0.5625).abs() < 0.01);
/// # Ok::<(), inpact_geometry::Error>(())
/// ```
///
/// # Errors
///
/// One of the surfaces consists of lines.
pub fn overlap(surface: &Placed<'_>, other: &Master<'_>) -> Result<Overlap, Error> {
    let of = surface.surface();
    let is_line = |surface: &crate::Surface| !surface.is_empty() && surface.is_line();
    if is_line(of) || is_line(other.placed().surface()) {
        return Err(ErrorKind::Extent.into());
    }
    // The projections of the nodes of the other surface, by face: a small part of it may lie between all other sample points.
    let mut places: Vec<Vec<[f64; 2]>> = vec![Vec::new(); of.len()];
    let own = Master::new(*surface);
    let points = other.placed().points();
    let corners: Vec<_> = other.placed().surface().nodes().iter().map(|node| points[node.index()]).collect();
    for across in own.project_all(&corners, 0.0).into_iter().flatten() {
        places[across.face.index()].push(across.place);
    }
    let faces: Vec<FaceId> = of.faces().collect();
    let parts: Vec<Part> = spread::map(&faces, |face| part(surface, *face, other, &places[face.index()]));
    let mut found = Overlap { area: 0.0, shares: vec![0.0; of.nodes().len()], faces: Vec::with_capacity(of.len()) };
    for (face, part) in faces.into_iter().zip(parts) {
        found.area += part.area;
        found.faces.push(0.0 < part.area);
        for (node, share) in of.face(face).nodes.iter().zip(part.functions) {
            if let Some(at) = of.position_of(*node) {
                found.shares[at] += share;
            }
        }
    }
    Ok(found)
}

/// Integrals over the part of a face: 1, and each shape function.
struct Part {
    area: f64,
    functions: [f64; MAX_NODES],
}

/// A face, and its opposite surface.
struct Cut<'a> {
    patch: Patch,
    other: &'a Master<'a>,
    part: Part,
}

/// A piece of the reference face: its corners, three or four.
type Cell = [[f64; 2]; 4];

fn part(surface: &Placed<'_>, face: FaceId, other: &Master<'_>, places: &[[f64; 2]]) -> Part {
    let patch = surface.patch(face);
    let whole = match patch.shape().corners() {
        3 => [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 1.0]],
        _ => [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]],
    };
    let mut cut = Cut { patch, other, part: Part { area: 0.0, functions: [0.0; MAX_NODES] } };
    cut.visit(&whole, 0, places);
    cut.part
}

impl Cut<'_> {
    fn corners(&self) -> usize {
        self.patch.shape().corners()
    }

    /// Whether a point is opposite the other surface, and both face each other.
    fn is_across(&self, place: [f64; 2]) -> bool {
        let across = self.other.project(self.patch.point(place), 0.0).filter(|across| across.projects);
        across.is_some_and(|across| {
            self.patch.normal(place).is_some_and(|normal| dot(normal, across.normal) < 0.0 || across.normal == [0.0; 3])
        })
    }

    /// Adds the opposite part of a cell, which may contain projected nodes of the other surface.
    fn visit(&mut self, cell: &Cell, cuts: u32, places: &[[f64; 2]]) {
        let corners = &cell[..self.corners()];
        let span = |k: usize| {
            let values = || corners.iter().map(|corner| corner[k]);
            values().fold(f64::INFINITY, f64::min)..=values().fold(f64::NEG_INFINITY, f64::max)
        };
        let bounds = [span(0), span(1)];
        let is_in = |place: &&[f64; 2]| (0..2).all(|k| bounds[k].contains(&place[k]));
        let places: Vec<[f64; 2]> = places.iter().filter(is_in).copied().collect();
        let count = corners.len() as f64;
        let middle = [0, 1].map(|k| corners.iter().map(|corner| corner[k]).sum::<f64>() / count);
        let towards = |corner: &[f64; 2], share: f64| [0, 1].map(|k| middle[k] + share * (corner[k] - middle[k]));
        if CUTS[0] <= cuts {
            let at_corners = corners.iter().filter(|corner| self.is_across(towards(corner, 1.0 - INSIDE))).count();
            let in_all = at_corners + usize::from(self.is_across(middle));
            match in_all {
                0 if places.is_empty() || cuts == CUTS[1] => return,
                all if all == corners.len() + 1 => return self.add(cell, 1.0),
                _ if cuts == CUTS[1] => {
                    let inside = corners.iter().filter(|corner| self.is_across(towards(corner, 0.5))).count();
                    return self.add(cell, inside as f64 / count);
                }
                _ => {}
            }
        }
        let half = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|k| 0.5 * (a[k] + b[k]));
        if let [a, b, c] = *corners {
            let (ab, bc, ca) = (half(a, b), half(b, c), half(c, a));
            for [x, y, z] in [[a, ab, ca], [ab, b, bc], [ca, bc, c], [bc, ca, ab]] {
                self.visit(&[x, y, z, z], cuts + 1, &places);
            }
        } else {
            let [a, b, c, d] = *cell;
            let (ab, bc, cd, da) = (half(a, b), half(b, c), half(c, d), half(d, a));
            for cell in [[a, ab, middle, da], [ab, b, bc, middle], [middle, bc, c, cd], [da, middle, cd, d]] {
                self.visit(&cell, cuts + 1, &places);
            }
        }
    }

    /// Adds a fraction of a cell.
    fn add(&mut self, cell: &Cell, share: f64) {
        let shape = self.patch.shape();
        let corners = self.corners();
        let place_in = |[x, y]: [f64; 2]| match corners {
            3 => [0, 1].map(|k| cell[0][k] + x * (cell[1][k] - cell[0][k]) + y * (cell[2][k] - cell[0][k])),
            // Cells of a square are rectangles.
            _ => [0, 1].map(|k| 0.5 * (cell[0][k] + cell[2][k]) + 0.5 * [x, y][k] * (cell[2][k] - cell[0][k])),
        };
        let size = size_of(shape, cell);
        for point in rule(shape) {
            let place = place_in(point.place);
            let weight = share * size * point.weight * norm(self.patch.area_vector(place));
            self.part.area += weight;
            let powers = monomials(place);
            for (sum, function) in self.part.functions.iter_mut().zip(shape.functions()) {
                *sum += weight * evaluate(function, &powers);
            }
        }
    }
}

/// The area of a cell as a fraction of the reference face.
fn size_of(shape: FaceShape, cell: &Cell) -> f64 {
    let [a, b, c, _] = *cell;
    let along = |p: [f64; 2]| [p[0] - a[0], p[1] - a[1]];
    if shape.corners() == 3 {
        let (u, v) = (along(b), along(c));
        (u[0] * v[1] - u[1] * v[0]).abs()
    } else {
        let diagonal = along(c);
        (0.25 * diagonal[0] * diagonal[1]).abs()
    }
}

#[cfg(test)]
mod tests {
    use super::overlap;
    use crate::{ErrorKind, Face, FaceShape, Master, NodeId, Placed, Point, Surface, shape_function_areas};

    /// Squares or triangles of a grid of `cells` by `cells` over a square, with normals up or down.
    fn grid(
        first: u32,
        cells: u32,
        [low, high]: [f64; 2],
        z: f64,
        shape: FaceShape,
        is_up: bool,
    ) -> (Surface, Vec<Point>) {
        let n = cells + 1;
        let place = |at: u32| low + (high - low) * f64::from(at) / f64::from(cells);
        let points = (0..n).flat_map(|j| (0..n).map(move |i| (i, j))).map(|(i, j)| [place(i), place(j), z]).collect();
        let node = |i: u32, j: u32| NodeId(first + i + n * j);
        let mut faces: Vec<Vec<NodeId>> = Vec::new();
        for (i, j) in (0..cells).flat_map(|j| (0..cells).map(move |i| (i, j))) {
            let square = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
            match shape {
                FaceShape::Triangle3 => {
                    faces.push(vec![square[0], square[1], square[2]]);
                    faces.push(vec![square[0], square[2], square[3]]);
                }
                _ => faces.push(square.to_vec()),
            }
        }
        if !is_up {
            for face in &mut faces {
                face.reverse();
            }
        }
        (Surface::new(faces.iter().map(|nodes| Face { shape, nodes })).expect("a surface"), points)
    }

    /// Areas of both sides of two grids.
    fn areas(lower: (u32, [f64; 2]), upper: (u32, [f64; 2]), shape: FaceShape) -> [super::Overlap; 2] {
        let (below, mut points) = grid(0, lower.0, lower.1, 0.0, shape, true);
        let first = u32::try_from(points.len()).expect("few");
        let (above, more) = grid(first, upper.0, upper.1, 0.01, shape, false);
        points.extend(more);
        let (below, above) =
            (Placed::new(&below, &points).expect("placed"), Placed::new(&above, &points).expect("placed"));
        [overlap(&below, &Master::new(above)).expect("areas"), overlap(&above, &Master::new(below)).expect("areas")]
    }

    #[test]
    fn grids_over_each_other() {
        for shape in [FaceShape::Quadrilateral4, FaceShape::Triangle3] {
            for (lower, upper, expected, within) in [
                // The same square with other cells, and one within whole cells of the other: exact.
                ((2, [0.0, 1.0]), (3, [0.0, 1.0]), 1.0, 1e-14),
                ((4, [0.0, 1.0]), (3, [0.25, 0.75]), 0.25, 1e-14),
                // Beside the edges of the cells, one cell around a far smaller square, and one beyond the edge of the other.
                ((4, [0.0, 1.0]), (3, [0.1, 0.6]), 0.25, 2e-3),
                ((1, [0.0, 1.0]), (2, [0.43, 0.47]), 0.0016, 2e-4),
                ((3, [0.0, 1.0]), (4, [0.35, 1.35]), 0.4225, 2e-3),
                ((3, [0.0, 1.0]), (2, [2.0, 3.0]), 0.0, 0.0),
            ] {
                for found in areas(lower, upper, shape) {
                    assert!((found.area - expected).abs() <= within, "{shape:?} {lower:?} {upper:?}: {}", found.area);
                    assert!((found.shares.iter().sum::<f64>() - found.area).abs() < 1e-14);
                }
            }
        }
    }

    #[test]
    fn shares_of_whole_faces_are_those_of_the_surface() {
        let (below, mut points) = grid(0, 2, [0.0, 1.0], 0.0, FaceShape::Quadrilateral4, true);
        let (above, more) = grid(9, 3, [-0.5, 1.5], 0.02, FaceShape::Quadrilateral4, false);
        points.extend(more);
        let (below, above) =
            (Placed::new(&below, &points).expect("placed"), Placed::new(&above, &points).expect("placed"));
        let found = overlap(&below, &Master::new(above)).expect("shares");
        let whole = shape_function_areas(&below).expect("areas");
        found.shares.iter().zip(whole).for_each(|(a, b)| assert!((a - b).abs() < 1e-15, "{a} and {b}"));
        assert!(found.faces.iter().all(|has_some| *has_some));
    }

    #[test]
    fn surfaces_that_look_away_have_nothing_across() {
        let (below, mut points) = grid(0, 2, [0.0, 1.0], 0.0, FaceShape::Quadrilateral4, true);
        let (above, more) = grid(9, 2, [0.0, 1.0], 0.02, FaceShape::Quadrilateral4, true);
        points.extend(more);
        let (below, above) =
            (Placed::new(&below, &points).expect("placed"), Placed::new(&above, &points).expect("placed"));
        assert_eq!(overlap(&below, &Master::new(above)).expect("nothing").area, 0.0);
    }

    #[test]
    fn lines_have_no_area() {
        let line = Surface::new([Face { shape: FaceShape::Segment2, nodes: &[NodeId(0), NodeId(1)] }]).expect("a line");
        let points = [[0.0; 3], [1.0, 0.0, 0.0]];
        let placed = Placed::new(&line, &points).expect("placed");
        assert_eq!(overlap(&placed, &Master::new(placed)), Err(ErrorKind::Extent.into()));
    }
}
