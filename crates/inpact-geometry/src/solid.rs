//! Shape functions and integration points of solid elements.
//!
//! Shape functions follow Zienkiewicz and Taylor, The Finite Element Method, chapter on shape functions: trilinear and serendipity bricks, linear and
//! quadratic tetrahedra in barycentric coordinates, and wedges as their products with a line. Nodes are in the order of the Abaqus Elements Guide.
//!
//! Integration points are those of Abaqus and CalculiX for conduction: 1 and 4 in tetrahedra of 4 and 10 nodes, 2 and 9 in wedges of 6 and 15, 8 and 27 in bricks of 8
//! and 20 nodes, and 8 in the reduced brick of 20. With one point a brick of 8 nodes has zero-energy (hourglass) modes of the temperature, so that it has all 8
//! here even where its type is reduced.

use crate::ElementShape;
use crate::quadrature::gauss;
use std::sync::OnceLock;

/// The maximum number of nodes of a solid element.
pub const MAX_SOLID_NODES: usize = 20;

/// The number of integration points of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Integration {
    /// As many as its order needs.
    Full,
    /// Those of a type with an `R` behind its number: C3D20R.
    Reduced,
}

impl Integration {
    /// The integration of an element type, by its name.
    ///
    /// ```
    /// use inpact_geometry::Integration;
    /// assert_eq!(Integration::of("C3D20RT"), Integration::Reduced);
    /// assert_eq!(Integration::of("DC3D20"), Integration::Full);
    /// ```
    pub fn of(name: &str) -> Self {
        let suffix = name.trim().trim_start_matches(|c: char| !c.is_ascii_digit());
        let suffix = suffix.trim_start_matches("3D").trim_start_matches(|c: char| c.is_ascii_digit());
        if suffix.bytes().any(|letter| letter.eq_ignore_ascii_case(&b'R')) { Self::Reduced } else { Self::Full }
    }
}

/// An integration point of the reference element.
#[derive(Debug)]
pub(crate) struct SolidPoint {
    /// The weights sum to the volume of the reference element.
    pub(crate) weight: f64,
    /// The shape functions.
    pub(crate) values: [f64; MAX_SOLID_NODES],
    /// Their derivatives by ξ, η and ζ.
    pub(crate) slopes: [[f64; 3]; MAX_SOLID_NODES],
}

/// The points of a shape; `None` where it is no solid.
pub(crate) fn rule(shape: ElementShape, integration: Integration) -> Option<&'static [SolidPoint]> {
    static RULES: [OnceLock<Vec<SolidPoint>>; 7] = [const { OnceLock::new() }; 7];
    let at = match (shape, integration) {
        (ElementShape::Tetrahedron4, _) => 0,
        (ElementShape::Tetrahedron10, _) => 1,
        (ElementShape::Wedge6, _) => 2,
        (ElementShape::Wedge15, _) => 3,
        (ElementShape::Hexahedron8, _) => 4,
        (ElementShape::Hexahedron20, Integration::Full) => 5,
        (ElementShape::Hexahedron20, Integration::Reduced) => 6,
        _ => return None,
    };
    Some(RULES[at].get_or_init(|| {
        let places = match at {
            0 => vec![([0.25; 3], 1.0 / 6.0)],
            1 => tetrahedron(),
            2 => wedge(&[([1.0 / 3.0; 2], 0.5)], 2),
            3 => {
                let (near, far) = (1.0 / 6.0, 2.0 / 3.0);
                wedge(&[([near, near], near), ([far, near], near), ([near, far], near)], 3)
            }
            4 | 6 => brick(2),
            _ => brick(3),
        };
        let point = |(place, weight)| {
            let (values, slopes) = functions(shape, place);
            SolidPoint { weight, values, slopes }
        };
        places.into_iter().map(point).collect()
    }))
}

/// Places and weights.
type Places = Vec<([f64; 3], f64)>;

/// Exact to the second degree.
fn tetrahedron() -> Places {
    let root = 5.0_f64.sqrt();
    let (near, far) = ((5.0 - root) / 20.0, (5.0 + 3.0 * root) / 20.0);
    let at = |k: usize| {
        let mut place = [near; 3];
        // The fourth barycentric coordinate is 1 minus the others.
        if let Some(coordinate) = place.get_mut(k) {
            *coordinate = far;
        }
        (place, 1.0 / 24.0)
    };
    (0..4).map(at).collect()
}

fn wedge(triangle: &[([f64; 2], f64)], layers: usize) -> Places {
    let mut places = Places::new();
    for (z, weight_z) in gauss(layers) {
        places.extend(triangle.iter().map(|&([x, y], weight)| ([x, y, z], weight * weight_z)));
    }
    places
}

fn brick(points: usize) -> Places {
    let line = gauss(points);
    let mut places = Places::new();
    for &(z, weight_z) in &line {
        for &(y, weight_y) in &line {
            places.extend(line.iter().map(|&(x, weight)| ([x, y, z], weight * weight_y * weight_z)));
        }
    }
    places
}

/// Shape functions and their derivatives at a place.
type Functions = ([f64; MAX_SOLID_NODES], [[f64; 3]; MAX_SOLID_NODES]);

fn functions(shape: ElementShape, place: [f64; 3]) -> Functions {
    match shape {
        ElementShape::Hexahedron8 | ElementShape::Hexahedron20 => brick_functions(shape.nodes(), place),
        ElementShape::Wedge6 | ElementShape::Wedge15 => wedge_functions(shape.nodes(), place),
        _ => tetrahedron_functions(shape.nodes(), place),
    }
}

/// Where the nodes of a brick are; 0 in the middle of an edge.
const BRICK: [[f64; 3]; MAX_SOLID_NODES] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [0.0, -1.0, -1.0],
    [1.0, 0.0, -1.0],
    [0.0, 1.0, -1.0],
    [-1.0, 0.0, -1.0],
    [0.0, -1.0, 1.0],
    [1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
    [-1.0, 0.0, 1.0],
    [-1.0, -1.0, 0.0],
    [1.0, -1.0, 0.0],
    [1.0, 1.0, 0.0],
    [-1.0, 1.0, 0.0],
];

fn brick_functions(nodes: usize, place: [f64; 3]) -> Functions {
    let (mut values, mut slopes) = ([0.0; MAX_SOLID_NODES], [[0.0; 3]; MAX_SOLID_NODES]);
    for (i, signs) in BRICK.iter().take(nodes).enumerate() {
        // A factor a direction, which is 1 − x² where the node is in the middle; corners of the second order have one more.
        let factor =
            [0, 1, 2].map(|k| if signs[k] == 0.0 { 1.0 - place[k] * place[k] } else { 1.0 + signs[k] * place[k] });
        let slope = [0, 1, 2].map(|k| if signs[k] == 0.0 { -2.0 * place[k] } else { signs[k] });
        let is_middle = signs.contains(&0.0);
        let more = if nodes == 8 || is_middle {
            1.0
        } else {
            signs.iter().zip(place).map(|(sign, x)| sign * x).sum::<f64>() - 2.0
        };
        let share = if is_middle { 0.25 } else { 0.125 };
        let product = factor[0] * factor[1] * factor[2];
        values[i] = share * product * more;
        for k in 0..3 {
            let others = factor[(k + 1) % 3] * factor[(k + 2) % 3];
            let of_more = if nodes == 8 || is_middle { 0.0 } else { signs[k] };
            slopes[i][k] = share * (slope[k] * others * more + product * of_more);
        }
    }
    (values, slopes)
}

/// Corners at both ends of each edge of a triangle or tetrahedron that has a node in its middle.
const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];

fn tetrahedron_functions(nodes: usize, [x, y, z]: [f64; 3]) -> Functions {
    let (mut values, mut slopes) = ([0.0; MAX_SOLID_NODES], [[0.0; 3]; MAX_SOLID_NODES]);
    let corner = [1.0 - x - y - z, x, y, z];
    let of_corner = [[-1.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for i in 0..4 {
        let (value, slope) = if nodes == 4 { (corner[i], 1.0) } else { quadratic(corner[i]) };
        values[i] = value;
        slopes[i] = of_corner[i].map(|component| slope * component);
    }
    for (i, [a, b]) in (4..nodes).zip(EDGES) {
        values[i] = 4.0 * corner[a] * corner[b];
        slopes[i] = [0, 1, 2].map(|k| 4.0 * (of_corner[a][k] * corner[b] + corner[a] * of_corner[b][k]));
    }
    (values, slopes)
}

/// L(2L − 1) and its derivative.
fn quadratic(corner: f64) -> (f64, f64) {
    (corner * (2.0 * corner - 1.0), 4.0 * corner - 1.0)
}

fn wedge_functions(nodes: usize, [x, y, z]: [f64; 3]) -> Functions {
    let (mut values, mut slopes) = ([0.0; MAX_SOLID_NODES], [[0.0; 3]; MAX_SOLID_NODES]);
    let corner = [1.0 - x - y, x, y];
    let of_corner = [[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]];
    let bubble = 1.0 - z * z;
    for (end, sign) in [-1.0, 1.0].into_iter().enumerate() {
        let along = 0.5 * (1.0 + sign * z);
        for i in 0..3 {
            // The contribution of the midside node of the vertical edge: L(1 − ζ²)/2.
            let (value, slope) = if nodes == 6 { (corner[i], 1.0) } else { quadratic(corner[i]) };
            let taken = if nodes == 6 { 0.0 } else { 0.5 };
            let at = 3 * end + i;
            values[at] = value * along - taken * corner[i] * bubble;
            let across = of_corner[i].map(|component| component * (slope * along - taken * bubble));
            slopes[at] = [across[0], across[1], 0.5 * sign * value + 2.0 * taken * corner[i] * z];
        }
        for (i, [a, b]) in EDGES.into_iter().take(3).enumerate().filter(|_| nodes == 15) {
            let at = 6 + 3 * end + i;
            values[at] = 4.0 * corner[a] * corner[b] * along;
            let across = [0, 1].map(|k| 4.0 * along * (of_corner[a][k] * corner[b] + corner[a] * of_corner[b][k]));
            slopes[at] = [across[0], across[1], 2.0 * sign * corner[a] * corner[b]];
        }
    }
    for i in (0..3).filter(|_| nodes == 15) {
        values[12 + i] = corner[i] * bubble;
        slopes[12 + i] = [of_corner[i][0] * bubble, of_corner[i][1] * bubble, -2.0 * corner[i] * z];
    }
    (values, slopes)
}

#[cfg(test)]
mod tests {
    use super::{BRICK, EDGES, Integration, functions, rule};
    use crate::ElementShape;

    const SOLIDS: [ElementShape; 6] = [
        ElementShape::Tetrahedron4,
        ElementShape::Tetrahedron10,
        ElementShape::Wedge6,
        ElementShape::Wedge15,
        ElementShape::Hexahedron8,
        ElementShape::Hexahedron20,
    ];

    /// Where the nodes of the reference element are.
    fn places(shape: ElementShape) -> Vec<[f64; 3]> {
        let middle = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|k| 0.5 * (a[k] + b[k]));
        let triangle = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        match shape {
            ElementShape::Hexahedron8 | ElementShape::Hexahedron20 => BRICK[..shape.nodes()].to_vec(),
            ElementShape::Wedge6 | ElementShape::Wedge15 => {
                let mut places: Vec<[f64; 3]> =
                    [-1.0, 1.0].iter().flat_map(|&z| triangle.map(|[x, y]| [x, y, z])).collect();
                for end in [0, 3] {
                    let middles = [0, 1, 2].map(|i| middle(places[end + EDGES[i][0]], places[end + EDGES[i][1]]));
                    places.extend(middles);
                }
                places.extend(triangle.map(|[x, y]| [x, y, 0.0]));
                places.truncate(shape.nodes());
                places
            }
            _ => {
                let mut places = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
                let middles = EDGES.map(|[a, b]| middle(places[a], places[b]));
                places.extend(middles);
                places.truncate(shape.nodes());
                places
            }
        }
    }

    #[test]
    fn a_function_is_one_at_its_own_node_and_zero_at_all_others() {
        for shape in SOLIDS {
            for (at, place) in places(shape).into_iter().enumerate() {
                let (values, _) = functions(shape, place);
                for (i, value) in values.iter().enumerate() {
                    assert_eq!(*value, f64::from(u8::from(i == at)), "{shape:?}: function {i} at node {at}");
                }
            }
        }
    }

    #[test]
    fn slopes_are_those_of_the_functions() {
        let place = [0.17, 0.31, 0.23];
        let step = 1e-6;
        for shape in SOLIDS {
            let (values, slopes) = functions(shape, place);
            assert!((values.iter().sum::<f64>() - 1.0).abs() < 1e-15, "{shape:?}");
            for k in 0..3 {
                let (mut before, mut after) = (place, place);
                before[k] -= step;
                after[k] += step;
                let (before, after) = (functions(shape, before).0, functions(shape, after).0);
                for i in 0..shape.nodes() {
                    let difference = (after[i] - before[i]) / (2.0 * step);
                    assert!((difference - slopes[i][k]).abs() < 1e-9, "{shape:?}: function {i}, direction {k}");
                }
            }
        }
    }

    #[test]
    fn weights_sum_to_the_volume_of_the_reference_element() {
        for shape in SOLIDS {
            let volume = match shape.faces().len() {
                4 => 1.0 / 6.0,
                5 => 1.0,
                _ => 8.0,
            };
            for integration in [Integration::Full, Integration::Reduced] {
                let weights: Vec<f64> =
                    rule(shape, integration).into_iter().flatten().map(|point| point.weight).collect();
                let found: f64 = weights.iter().sum();
                // A rounding for each weight and each sum.
                let bound = 2.0 * weights.len() as f64 * f64::EPSILON * volume;
                assert!((found - volume).abs() <= bound, "{shape:?}: {found} for {volume}");
            }
        }
        assert!(rule(ElementShape::Shell4, Integration::Full).is_none());
    }
}
