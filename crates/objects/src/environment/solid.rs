//! Solids of obstacles: boxes, balls and closed meshes.

use std::sync::Arc;

use burgeon_geometry::{AlongSegment, ClosedMesh};
use glam::DVec3;
use rstar::{AABB, PointDistance, RTreeObject};

/// A solid.
#[derive(Debug, Clone)]
pub(super) enum Solid {
    /// A box with sides along the axes: its lowest and its highest corner (m).
    Cuboid([DVec3; 2]),
    /// A ball: centre and radius (m).
    Ball(DVec3, f64),
    /// A closed mesh.
    Mesh(Arc<ClosedMesh>),
}

/// Nearest point of a surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct SolidSurfacePoint {
    /// Position (m).
    pub position: DVec3,
    /// Unit normal, outwards.
    pub normal: DVec3,
}

impl Solid {
    /// Returns the lowest and the highest corner (m) of the bounding box.
    pub(super) fn bounds(&self) -> [DVec3; 2] {
        match self {
            Self::Cuboid(corners) => *corners,
            Self::Ball(center, radius) => [*center - *radius, *center + *radius],
            Self::Mesh(mesh) => mesh.bounds(),
        }
    }

    /// Returns true if a place (m) is inside.
    pub(super) fn contains(&self, place: DVec3) -> bool {
        match self {
            Self::Cuboid([low, high]) => place.cmpge(*low).all() && place.cmple(*high).all(),
            Self::Ball(center, radius) => center.distance(place) <= *radius,
            Self::Mesh(mesh) => mesh.contains(place),
        }
    }

    /// Returns the nearest point of the surface to a place (m).
    pub(super) fn nearest(&self, place: DVec3) -> SolidSurfacePoint {
        match self {
            Self::Cuboid(corners) => nearest_of_cuboid(*corners, place),
            Self::Ball(center, radius) => {
                let normal = (place - center).try_normalize().unwrap_or(DVec3::Z);
                SolidSurfacePoint { position: center + normal * radius, normal }
            }
            Self::Mesh(mesh) => {
                let (position, normal) = mesh.nearest(place).unwrap_or((mesh.bounds()[0], DVec3::Z));
                SolidSurfacePoint { position, normal }
            }
        }
    }

    /// Returns the share of the segment between two places (m) at which it meets the solid first, 0 if it begins inside.
    pub(super) fn hit(&self, from: DVec3, to: DVec3) -> Option<f64> {
        if self.contains(from) {
            return Some(0.0);
        }
        match self {
            Self::Cuboid(corners) => AlongSegment::new(from, to, 1.0).entry(*corners).map(|at| at.min(1.0)),
            Self::Ball(center, radius) => hit_of_ball(*center, *radius, from, to),
            Self::Mesh(mesh) => mesh.hit(from, to),
        }
    }
}

/// Returns the nearest point of the surface of a box.
fn nearest_of_cuboid([low, high]: [DVec3; 2], place: DVec3) -> SolidSurfacePoint {
    let mut position = place.clamp(low, high);
    let outside = place - position;
    let depths = [place - low, high - place].map(|depth| depth.to_array());
    // The face that is nearest, or farthest away if the place is outside.
    let sides = (0..3).flat_map(|axis| [(0, axis), (1, axis)]);
    let nearest = sides.min_by(|a, b| depths[a.0][a.1].total_cmp(&depths[b.0][b.1]));
    let (side, axis) = nearest.unwrap_or_default();
    let mut normal = DVec3::ZERO;
    normal[axis] = if side == 0 { -1.0 } else { 1.0 };
    if outside == DVec3::ZERO {
        position[axis] = [low, high][side][axis];
    }
    SolidSurfacePoint { position, normal }
}

/// Returns the share of a segment (m) from outside at which it meets a ball.
fn hit_of_ball(center: DVec3, radius: f64, from: DVec3, to: DVec3) -> Option<f64> {
    let (way, start) = (to - from, from - center);
    let square = way.length_squared();
    let toward = -start.dot(way);
    if square == 0.0 || toward <= 0.0 {
        return None;
    }
    // The distance of the centre from the line, which is more precise than the usual discriminant.
    let aside = start + way * (toward / square);
    let half = radius * radius - aside.length_squared();
    if half < 0.0 {
        return None;
    }
    let share = (toward - (half * square).sqrt()) / square;
    (share <= 1.0).then_some(share.max(0.0))
}

/// A solid with its bounding box, for a spatial index.
#[derive(Debug, Clone)]
pub(super) struct IndexedSolid {
    pub solid: Solid,
    envelope: AABB<[f64; 3]>,
}

impl From<Solid> for IndexedSolid {
    fn from(solid: Solid) -> Self {
        let [low, high] = solid.bounds();
        Self { solid, envelope: AABB::from_corners(low.to_array(), high.to_array()) }
    }
}

impl RTreeObject for IndexedSolid {
    type Envelope = AABB<[f64; 3]>;

    fn envelope(&self) -> Self::Envelope {
        self.envelope
    }
}

impl PointDistance for IndexedSolid {
    /// Returns the square of the distance of a place outside of the solid.
    fn distance_2(&self, place: &[f64; 3]) -> f64 {
        let place = DVec3::from_array(*place);
        self.solid.nearest(place).position.distance_squared(place)
    }
}
