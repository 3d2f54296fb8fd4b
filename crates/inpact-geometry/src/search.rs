//! A spatial index of the master surface: a bounding volume hierarchy of its faces.

use crate::closest::{Closest, bounds};
use crate::coordinates::{Placed, finite};
use crate::{FaceId, Point};
use rstar::{AABB, PointDistance, RTree, RTreeObject};

/// A surface indexed for closest-point queries: memory is linear in its faces (n log n time to build).
pub struct Master<'a> {
    placed: Placed<'a>,
    tree: RTree<Boxed>,
}

impl<'a> Master<'a> {
    /// Builds the index.
    pub fn new(placed: Placed<'a>) -> Self {
        let boxes = placed.surface().faces().map(|face| {
            let (low, high) = bounds(&placed.patch(face));
            Boxed { face, bounds: AABB::from_corners(low, high) }
        });
        Self { placed, tree: RTree::bulk_load(boxes.collect()) }
    }

    /// The surface itself.
    pub fn placed(&self) -> &Placed<'a> {
        &self.placed
    }

    /// The face that is closest to a point, and the closest point on it; `None` where the surface has no face. Of equally distant faces the first is taken.
    ///
    /// `None` also for a point with a coordinate that is NaN or whose square is not finite.
    pub fn closest(&self, point: Point) -> Option<(FaceId, Closest)> {
        finite(point).ok()?;
        let mut best: Option<(FaceId, Closest)> = None;
        for candidate in self.tree.nearest_neighbor_iter(point) {
            let least = best.map_or(f64::INFINITY, |(_, closest)| closest.distance);
            if least < candidate.distance_2(&point).sqrt() {
                break;
            }
            // Slightly above the distance found, so that an equally distant face with a lower number is not skipped.
            let Some(closest) = self.placed.patch(candidate.face).closest_within(point, least * (1.0 + 1e-12)) else {
                continue;
            };
            let better = best.is_none_or(|(face, found)| {
                closest.distance < found.distance || (closest.distance == found.distance && candidate.face < face)
            });
            if better {
                best = Some((candidate.face, closest));
            }
        }
        best
    }
}

struct Boxed {
    face: FaceId,
    bounds: AABB<Point>,
}

impl RTreeObject for Boxed {
    type Envelope = AABB<Point>;

    fn envelope(&self) -> AABB<Point> {
        self.bounds
    }
}

impl PointDistance for Boxed {
    /// The distance to the box, a lower bound for the face.
    fn distance_2(&self, point: &Point) -> f64 {
        rstar::Envelope::distance_2(&self.bounds, point)
    }
}
