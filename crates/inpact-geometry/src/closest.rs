//! The point of a face that is closest to a given point.
//!
//! Half the squared distance is minimised over the face's own coordinates: Newton's iteration with the curvature term (the second derivatives of the face
//! times the vector to the point), edges and corners as active constraints, monotone descent.
//! A warped or curved face can have several minima. Where a bound on the second derivatives does not prove that there is only one, the face is subdivided into four and
//! parts whose lower bound of the distance exceeds the best found are pruned (branch and bound), so that the result is the global minimum.

use crate::patch::Patch;
use crate::vector::{add, dot, norm, scale, sub};
use crate::{Point, Vector};

/// The maximum number of subdivisions of a face. On a face so strongly bent, or folded, that a 32nd of it has two minima, the better of those found is taken:
/// it is then not proven to be the global minimum.
const CUTS: u32 = 5;

/// The maximum number of Newton steps; it takes four to six where the face is nearly flat.
const STEPS: u32 = 60;

/// The maximum number of rounds of pattern search where derivatives vanish.
const MAX_TRIALS: u32 = 1000;

/// The maximum number of further starts where derivatives vanish.
const MAX_ROUGH: usize = 32;

/// The distance from an edge (in ξ and η, of magnitude 1) within which a point is on it: the rounding of a clipped step.
const ON_EDGE: f64 = 1e-14;

/// The closest point of a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// The point in the face's natural coordinates ξ and η.
    pub place: [f64; 2],
    /// The point in space (L).
    pub point: Point,
    /// The distance from the given point (L).
    pub distance: f64,
}

impl Patch {
    /// The point of the face that is closest to `point`.
    ///
    /// ```
    /// use inpact_geometry::{FaceShape, Patch};
    /// let square = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]];
    /// let closest = Patch::new(FaceShape::Quadrilateral4, &square).closest([3.0, 0.5, 0.0]);
    /// assert_eq!((closest.point, closest.distance), ([2.0, 0.5, 0.0], 1.0));
    /// ```
    ///
    /// # Panics
    ///
    /// A coordinate of the point or of the face is NaN, or its square is not finite.
    pub fn closest(&self, point: Point) -> Closest {
        self.closest_within(point, f64::INFINITY).expect("a distance below infinity")
    }

    /// The same where it is nearer than `limit`; `None` where it is not.
    pub(crate) fn closest_within(&self, point: Point, limit: f64) -> Option<Closest> {
        let search = Search::new(self, point);
        let mut best: Option<([f64; 2], f64)> = None;
        let mut parts = vec![(Part::whole(self), 0)];
        let mut rough: Vec<([f64; 2], f64)> = Vec::new();
        while let Some((part, cuts)) = parts.pop() {
            let centre = search.about(&part);
            let least = best.map_or(limit, |(_, distance)| distance);
            // Rounding may lift the bound of a part that holds the minimum itself.
            if least < centre.below * (1.0 - 1e-12) {
                continue;
            }
            let place = search.minimum_in(&part, part.centre());
            let distance = norm(search.to_point(place));
            if distance < least {
                best = Some((place, distance));
            }
            if !centre.one_minimum && cuts == CUTS {
                rough.push((place, distance));
            }
            if !centre.one_minimum && cuts < CUTS {
                parts.extend(part.quarters().into_iter().map(|quarter| (quarter, cuts + 1)));
            }
        }
        // Where derivatives vanish, all starts close to the best are searched further, the nearest first.
        rough.sort_by(|a, b| a.1.total_cmp(&b.1));
        for (place, distance) in rough.into_iter().take(MAX_ROUGH) {
            let Some((_, least)) = best.filter(|(_, least)| distance <= 1.01 * least) else { break };
            let (place, distance) = search.by_trial(place, distance);
            // Less than that is rounding, which a search would follow for half the digits of a point.
            if distance < least * (1.0 - 1e-12) {
                let sharper = search.minimum_in(&Part::whole(self), place);
                let sharp = norm(search.to_point(sharper));
                best = Some(if sharp <= distance { (sharper, sharp) } else { (place, distance) });
            }
        }
        best.map(|(place, distance)| Closest { place, point: self.point(place), distance })
    }
}

/// A convex part of the reference face: two ends, three corners or four.
#[derive(Clone)]
struct Part {
    corners: Vec<[f64; 2]>,
}

/// A side of a part: outward unit normal n and the bound b, n · place ≤ b.
struct Side {
    normal: [f64; 2],
    bound: f64,
}

impl Part {
    fn whole(patch: &Patch) -> Self {
        Self { corners: patch.shape.corner_places().to_vec() }
    }

    fn centre(&self) -> [f64; 2] {
        let n = self.corners.len() as f64;
        let sum = self.corners.iter().fold([0.0; 2], |sum, c| [sum[0] + c[0], sum[1] + c[1]]);
        [sum[0] / n, sum[1] / n]
    }

    fn sides(&self) -> Vec<Side> {
        let side = |normal: [f64; 2], through: [f64; 2]| Side { normal, bound: dot2(normal, through) };
        if let [from, to] = self.corners[..] {
            return vec![side([-1.0, 0.0], from), side([1.0, 0.0], to)];
        }
        (0..self.corners.len())
            .map(|i| {
                let (from, to) = (self.corners[i], self.corners[(i + 1) % self.corners.len()]);
                let along = [to[0] - from[0], to[1] - from[1]];
                let length = dot2(along, along).sqrt();
                side([along[1] / length, -along[0] / length], from)
            })
            .collect()
    }

    /// Half the extent in ξ and in η about the centre, at most.
    fn reach(&self, centre: [f64; 2]) -> [f64; 2] {
        self.corners.iter().fold([0.0_f64; 2], |reach, c| {
            [reach[0].max((c[0] - centre[0]).abs()), reach[1].max((c[1] - centre[1]).abs())]
        })
    }

    /// Two halves of a segment, four quarters of a triangle or of a quadrilateral.
    fn quarters(&self) -> Vec<Self> {
        let middle = |a: [f64; 2], b: [f64; 2]| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        let part = |corners: &[[f64; 2]]| Self { corners: corners.to_vec() };
        match self.corners[..] {
            [a, b] => vec![part(&[a, middle(a, b)]), part(&[middle(a, b), b])],
            [a, b, c] => {
                let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                vec![part(&[a, ab, ca]), part(&[ab, b, bc]), part(&[ca, bc, c]), part(&[ab, bc, ca])]
            }
            _ => {
                let [a, b, c, d] = [self.corners[0], self.corners[1], self.corners[2], self.corners[3]];
                let (ab, bc, cd, da, m) = (middle(a, b), middle(b, c), middle(c, d), middle(d, a), self.centre());
                vec![part(&[a, ab, m, da]), part(&[ab, b, bc, m]), part(&[m, bc, c, cd]), part(&[da, m, cd, d])]
            }
        }
    }
}

/// Bounds of a part before its search.
struct About {
    /// No point of it is nearer than this.
    below: f64,
    /// Half the squared distance is convex over it.
    one_minimum: bool,
}

struct Search<'a> {
    patch: &'a Patch,
    /// The given point, from the face's origin.
    point: Vector,
    /// Bounds of the second derivatives over the whole face: by ξ twice, by ξ and η, by η twice.
    curvature: [f64; 3],
    /// Their Lipschitz constants over the whole face, per unit of ξ and η together.
    variation: f64,
    /// The rounding error of a difference of points.
    rounding: f64,
}

impl<'a> Search<'a> {
    fn new(patch: &'a Patch, point: Point) -> Self {
        let point = sub(point, patch.origin);
        let size = patch.coefficients.map(norm);
        let curvature = [2.0 * (size[3] + size[6]), size[4] + 2.0 * (size[6] + size[7]), 2.0 * (size[5] + size[7])];
        let rounding = 4.0 * f64::EPSILON * (norm(point) + size[1..].iter().sum::<f64>());
        Self { patch, point, curvature, variation: 2.0 * (size[6] + size[7]), rounding }
    }

    /// From the given point to a place of the face.
    fn to_point(&self, place: [f64; 2]) -> Vector {
        sub(self.patch.relative(place), self.point)
    }

    fn about(&self, part: &Part) -> About {
        let centre = part.centre();
        let [reach_x, reach_y] = part.reach(centre);
        let away = self.to_point(centre);
        let distance = norm(away);
        let [along, across] = self.patch.tangents(centre);
        let [by_xx, by_xy, by_yy] = self.curvature;
        // Taylor's formula about the centre: the remainder after the tangents.
        let rest = 0.5 * (by_xx * reach_x * reach_x + 2.0 * by_xy * reach_x * reach_y + by_yy * reach_y * reach_y);
        let below = if distance == 0.0 {
            0.0
        } else {
            // Along the direction to the centre alone.
            let slopes = [dot(away, along) / distance, dot(away, across) / distance];
            let least = part
                .corners
                .iter()
                .map(|c| slopes[0] * (c[0] - centre[0]) + slopes[1] * (c[1] - centre[1]))
                .fold(f64::INFINITY, f64::min);
            (distance + least - rest).max(0.0)
        };
        let is_line = self.patch.shape.is_line();
        let (xx, xy, yy) = (dot(along, along), dot(along, across), dot(across, across));
        // The least singular value of the tangents at the centre minus a bound of their change: a lower bound in the part.
        let half = 0.5 * (xx + yy);
        let largest = half + (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt();
        let determinant = (xx * yy - xy * xy).max(0.0);
        let singular = if is_line {
            xx.sqrt()
        } else if largest == 0.0 {
            0.0
        } else {
            (determinant / largest).sqrt()
        };
        let turn = (by_xx * reach_x + by_xy * reach_y).hypot(by_xy * reach_x + by_yy * reach_y);
        let metric = (singular - turn).max(0.0);
        // The curvature term at the centre, and a bound of its growth.
        let moved = norm(along) * reach_x + norm(across) * reach_y + rest;
        let drift = distance * self.variation * (reach_x + reach_y);
        let curvatures = self.patch.curvatures(centre);
        let term = |k: usize, bound: f64| {
            dot(away, curvatures[k]).abs() + moved * bound + if bound == 0.0 { 0.0 } else { drift }
        };
        let (a, b, c) = (term(0, by_xx), term(1, by_xy), term(2, by_yy));
        let curved = (a * a + 2.0 * b * b + c * c).sqrt();
        About { below, one_minimum: curved < metric * metric }
    }

    /// A minimum of the distance in the part, from a start in it.
    fn minimum_in(&self, part: &Part, from: [f64; 2]) -> [f64; 2] {
        let sides = part.sides();
        let mut place = from;
        for _ in 0..STEPS {
            let away = self.to_point(place);
            let tangents = self.patch.tangents(place);
            let gradient = [dot(away, tangents[0]), dot(away, tangents[1])];
            let slack = |side: &Side| side.bound - dot2(side.normal, place);
            let Some(direction) = self.direction(place, away, tangents, gradient, &sides) else { break };
            let mut longest = 1.0_f64;
            for side in &sides {
                let speed = dot2(side.normal, direction);
                if 0.0 < speed {
                    longest = longest.min((slack(side) / speed).max(0.0));
                }
            }
            let value = 0.5 * dot(away, away);
            let noise = self.rounding * (norm(away) + self.rounding);
            let slope = dot2(gradient, direction);
            let mut step = longest;
            let mut next = moved(place, step, direction);
            for _ in 0..40 {
                let there = self.to_point(next);
                if 0.5 * dot(there, there) <= value + 1e-4 * step * slope + noise {
                    break;
                }
                step *= 0.5;
                next = moved(place, step, direction);
            }
            let change = (next[0] - place[0]).abs().max((next[1] - place[1]).abs());
            place = next;
            if change <= 1e-15 {
                break;
            }
        }
        self.patch.shape.clamp(place)
    }

    /// Pattern search around a point with decreasing step: where a face is folded to a point or a line, derivatives vanish there and give
    /// no direction of descent.
    fn by_trial(&self, place: [f64; 2], distance: f64) -> ([f64; 2], f64) {
        const AROUND: [[f64; 2]; 8] =
            [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
        let (mut place, mut distance) = (place, distance);
        let mut step = 4.0 / f64::from(1 << CUTS);
        let mut trials = 0;
        while 1e-12 < step && trials < MAX_TRIALS {
            let tried = AROUND.map(|direction| {
                let there = self.patch.shape.clamp(moved(place, step, direction));
                (there, norm(self.to_point(there)))
            });
            trials += 1;
            match tried.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)) {
                Some((there, nearer)) if nearer < distance => (place, distance) = (there, nearer),
                _ => step *= 0.5,
            }
        }
        (place, distance)
    }

    /// The direction of descent from a place; `None` at a minimum.
    fn direction(
        &self,
        place: [f64; 2],
        away: Vector,
        tangents: [Vector; 2],
        gradient: [f64; 2],
        sides: &[Side],
    ) -> Option<[f64; 2]> {
        if gradient == [0.0; 2] {
            return None;
        }
        let [xx, xy, yy] =
            [dot(tangents[0], tangents[0]), dot(tangents[0], tangents[1]), dot(tangents[1], tangents[1])];
        let curvatures = self.patch.curvatures(place);
        let mut flat = [xx, xy, yy];
        if self.patch.shape.is_line() {
            flat[2] = xx;
        }
        let full = [
            flat[0] + dot(away, curvatures[0]),
            flat[1] + dot(away, curvatures[1]),
            flat[2] + dot(away, curvatures[2]),
        ];
        let on: Vec<&Side> = sides.iter().filter(|side| side.bound - dot2(side.normal, place) <= ON_EDGE).collect();
        let holding: Vec<&Side> = on.iter().copied().filter(|side| dot2(side.normal, gradient) < 0.0).collect();
        let along = |tangent: [f64; 2]| {
            let slope = dot2(tangent, gradient);
            let curvature = quadratic(full, tangent);
            let curvature = if 0.0 < curvature { curvature } else { quadratic(flat, tangent) };
            (slope < 0.0 && 0.0 < curvature).then(|| [-slope / curvature * tangent[0], -slope / curvature * tangent[1]])
        };
        let inside = |tangent: &[f64; 2]| on.iter().all(|other| dot2(other.normal, *tangent) <= ON_EDGE);
        match holding[..] {
            [] => {
                let newton = solve(full, gradient).or_else(|| solve(damped(flat), gradient))?;
                if on.iter().all(|side| dot2(side.normal, newton) <= 0.0) {
                    return Some(newton);
                }
                // The Newton step crosses an edge that the gradient does not: the minimum of the quadratic model within lies on that edge.
                let curvature = quadratic(full, gradient);
                let curvature = if 0.0 < curvature { curvature } else { quadratic(flat, gradient) };
                let length = dot2(gradient, gradient) / curvature;
                let steepest = length.is_finite().then(|| [-length * gradient[0], -length * gradient[1]]);
                let on_edge = on.iter().filter(|side| 0.0 < dot2(side.normal, newton)).filter_map(|side| {
                    let tangent = [-side.normal[1], side.normal[0]];
                    let reversed = [-tangent[0], -tangent[1]];
                    [tangent, reversed].into_iter().filter(inside).find_map(along)
                });
                // Whichever decreases more, by that model.
                let fall = |direction: &[f64; 2]| -dot2(*direction, gradient);
                on_edge.chain(steepest).max_by(|a, b| fall(a).total_cmp(&fall(b)))
            }
            [side] => {
                let tangent = [-side.normal[1], side.normal[0]];
                along(tangent).or_else(|| along([-tangent[0], -tangent[1]]))
            }
            // A corner: along whichever of its edges the distance decreases.
            _ => on.iter().find_map(|side| {
                let tangent = [-side.normal[1], side.normal[0]];
                [tangent, [-tangent[0], -tangent[1]]].into_iter().filter(inside).find_map(along)
            }),
        }
    }
}

impl crate::FaceShape {
    /// The point, projected back onto the reference face where rounding left it beyond an edge.
    fn clamp(self, [x, y]: [f64; 2]) -> [f64; 2] {
        match self.corners() {
            2 => [x.clamp(-1.0, 1.0), 0.0],
            3 => {
                let (x, y) = (x.max(0.0), y.max(0.0));
                if 1.0 < x + y { [x / (x + y), y / (x + y)] } else { [x, y] }
            }
            _ => [x.clamp(-1.0, 1.0), y.clamp(-1.0, 1.0)],
        }
    }
}

fn dot2(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn moved(place: [f64; 2], step: f64, direction: [f64; 2]) -> [f64; 2] {
    [place[0] + step * direction[0], place[1] + step * direction[1]]
}

fn quadratic([xx, xy, yy]: [f64; 3], t: [f64; 2]) -> f64 {
    xx * t[0] * t[0] + 2.0 * xy * t[0] * t[1] + yy * t[1] * t[1]
}

/// The matrix regularised by a little of its trace on the diagonal, for a face folded to a line.
fn damped([xx, xy, yy]: [f64; 3]) -> [f64; 3] {
    let little = 1e-10 * (xx + yy);
    [xx + little, xy, yy + little]
}

/// −(matrix)⁻¹ gradient; `None` where the matrix is not positive definite.
fn solve([xx, xy, yy]: [f64; 3], gradient: [f64; 2]) -> Option<[f64; 2]> {
    let determinant = xx * yy - xy * xy;
    let definite = 0.0 < xx && 0.0 < yy && 1e-12 * xx * yy < determinant;
    let solution =
        [(xy * gradient[1] - yy * gradient[0]) / determinant, (xy * gradient[0] - xx * gradient[1]) / determinant];
    (definite && solution[0].is_finite() && solution[1].is_finite()).then_some(solution)
}

/// A bounding box of the whole face, including its bulge between the nodes.
pub(crate) fn bounds(patch: &Patch) -> (Point, Point) {
    // Bernstein–Bézier: a polynomial lies within the convex hull of its control points.
    let c = &patch.coefficients;
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    let mut include = |x: Vector| {
        for k in 0..3 {
            low[k] = low[k].min(x[k]);
            high[k] = high[k].max(x[k]);
        }
    };
    for corner in patch.shape.corner_places() {
        include(patch.relative(*corner));
    }
    if patch.shape.is_second_order() {
        if patch.shape.corners() == 3 {
            // Control points in the middle of edges, from the blossom of the quadratic.
            include(add(c[0], scale(0.5, c[1])));
            include(add(c[0], scale(0.5, c[2])));
            include(add(c[0], add(scale(0.5, add(c[1], c[2])), scale(0.5, c[4]))));
        } else {
            // The blossom of a biquadratic: ξ² becomes −1 and ξ becomes 0 at the control in the middle of a side.
            let control = |x: f64, y: f64| {
                let (xx, yy) = (if x == 0.0 { -1.0 } else { 1.0 }, if y == 0.0 { -1.0 } else { 1.0 });
                let powers = [1.0, x, y, xx, x * y, yy, xx * y, x * yy];
                c.iter().zip(powers).fold([0.0; 3], |sum, (c, power)| add(sum, scale(power, *c)))
            };
            for x in [-1.0, 0.0, 1.0] {
                for y in [-1.0, 0.0, 1.0] {
                    include(control(x, y));
                }
            }
        }
    }
    (add(low, patch.origin), add(high, patch.origin))
}
