//! Solids that growth avoids: `obstacles` in scripts.

use std::sync::{Arc, OnceLock};

use burgeon_base::MemoryOwner;
use burgeon_base::error::{Error, Result};
use burgeon_geometry::{AlongSegment, ClosedMesh};
use burgeon_kit::{Answer, AxisScale, Environment, Model, Value, Vector, methods, object};
use burgeon_spatial::Geometry;
use glam::{DAffine3, DQuat, DVec3};
use rstar::RTree;

use super::prism::prism;
use super::solid::{IndexedSolid, Solid, SolidSurfacePoint};

/// Largest absolute coordinate (m) of a solid.
const FARTHEST: f64 = 1e9;
/// Approximate memory of a solid in the spatial index (bytes).
const SOLID_BYTES: usize = 160;
/// Distance (m) from a surface up to which its normal counts as the direction away from it.
const TOUCHING: f64 = 1e-9;

/// Solids that growth avoids: boxes, balls, prisms and models.
///
/// Obstacles never change: `box`, `sphere`, `prism` and `mesh` return new obstacles with one more solid. Rules,
/// interpretations and the top level of the script can read them.
#[object(
    "obstacles",
    can(Environment),
    example = include_str!("../../scripts/obstacles.lua"),
)]
pub struct ObstacleSolids {
    last: Option<Arc<SolidLink>>,
    /// Spatial index of all solids, built by the first question.
    index: OnceLock<Arc<RTree<IndexedSolid>>>,
}

/// A solid and the solids that were added before it, which other obstacles can share.
#[derive(Debug)]
struct SolidLink {
    solid: Solid,
    before: Option<Arc<SolidLink>>,
    count: usize,
}

impl Drop for SolidLink {
    // One after the other: nested calls for each of a million solids would overflow the stack.
    fn drop(&mut self) {
        let mut before = self.before.take();
        while let Some(mut link) = before.and_then(Arc::into_inner) {
            before = link.before.take();
        }
    }
}

#[methods("obstacles")]
impl ObstacleSolids {
    /// Returns these obstacles and a box with sides along the axes, from its corner `low` to its corner `high` (m).
    pub fn r#box(&self, low: Vector, high: Vector) -> Result<Self> {
        let size = high.0 - low.0;
        if !(is_near(low.0) && is_near(high.0) && size.min_element() > 0.0) {
            return Err(Error::argument(format!(
                "obstacles:box: the corners are {} and {}",
                text(low.0),
                text(high.0)
            ))
            .help(format!(
                "give a low and a high corner, with x, y and z that increase and are below {FARTHEST:e} m"
            )));
        }
        Ok(self.with(Solid::Cuboid([low.0, high.0])))
    }

    /// Returns these obstacles and a ball with a centre (m) and `radius` (m).
    pub fn sphere(&self, center: Vector, radius: f64) -> Result<Self> {
        if !(is_near(center.0) && radius > 0.0 && radius <= FARTHEST) {
            return Err(Error::argument(format!(
                "obstacles:sphere: the centre is {} and the radius {radius}",
                text(center.0)
            ))
            .help(format!("give a radius above 0, and numbers below {FARTHEST:e} m")));
        }
        Ok(self.with(Solid::Ball(center.0, radius)))
    }

    /// Returns these obstacles and the prism over an area, such as a block over the plan of a building, with `height` (m)
    /// above `bottom` (m, 0 unless given).
    pub fn prism(&self, area: Geometry, height: f64, bottom: Option<f64>) -> Result<Self> {
        let bottom = bottom.unwrap_or(0.0);
        if !(height > 0.0 && height <= FARTHEST && bottom.abs() <= FARTHEST) {
            return Err(Error::argument(format!(
                "obstacles:prism: the height is {height} and the bottom {bottom}"
            ))
            .help(format!("give a height above 0, and numbers below {FARTHEST:e} m")));
        }
        let meshes = prism(&area, [bottom, bottom + height]);
        let meshes = meshes.map_err(|error| error.about("obstacles:prism"))?;
        Ok(meshes.into_iter().fold(self.clone(), |all, mesh| all.with(Solid::Mesh(Arc::new(mesh)))))
    }

    /// Returns these obstacles and a model with a closed surface: the result of a system, or a file. Its origin is at
    /// `position` (m, the origin unless given), and it is scaled by `scale` (1 unless given). An open surface is refused,
    /// and a model that draws nothing adds no solid.
    pub fn mesh(
        &self,
        model: Arc<Model>,
        position: Option<Vector>,
        scale: Option<AxisScale>,
    ) -> Result<Self> {
        let position = position.map_or(DVec3::ZERO, |position| position.0);
        let scale = scale.unwrap_or_default().0;
        if !(is_near(position) && scale.is_finite() && scale.min_element() > 0.0) {
            return Err(Error::argument(format!(
                "obstacles:mesh: the position is {} and the scale {}",
                text(position),
                text(scale)
            ))
            .help(format!("give a scale above 0, and coordinates below {FARTHEST:e} m")));
        }
        // A system that draws nothing causes a warning of its own, and a check of a script draws nothing.
        if model.size() == 0 {
            return Ok(self.clone());
        }
        let placed = DAffine3::from_scale_rotation_translation(scale, DQuat::IDENTITY, position);
        let mesh = mesh_of(&model, placed).map_err(|error| error.about("obstacles:mesh"))?;
        Ok(self.with(Solid::Mesh(Arc::new(mesh))))
    }

    /// Returns the number of solids.
    pub fn count(&self) -> u32 {
        u32::try_from(self.size()).unwrap_or(u32::MAX)
    }

    /// Returns true if a place is in an obstacle.
    pub fn contains(&self, place: Vector) -> Result<bool> {
        Ok(self.around(place.0)?.next().is_some())
    }

    /// Returns the distance (m) from a place to the nearest obstacle, infinite if there are none. In an obstacle it is
    /// negative: the distance to the surface of this obstacle, of several the largest.
    pub fn distance(&self, place: Vector) -> Result<f64> {
        let Some((near, is_inside)) = self.surface(place.0)? else { return Ok(f64::INFINITY) };
        let distance = near.position.distance(place.0);
        Ok(if is_inside { -distance } else { distance })
    }

    /// Returns the point (m) of the nearest surface to a place. Fails if there are no obstacles.
    pub fn nearest(&self, place: Vector) -> Result<DVec3> {
        let (near, _) = self.surface(place.0)?.ok_or_else(|| {
            Error::argument("obstacles:nearest: there are no obstacles")
                .help("add a solid: obstacles():box({ 0, 0, 0 }, { 1, 1, 2 })")
        })?;
        Ok(near.position)
    }

    /// Returns the direction away from the obstacles at a place, of length 1: that in which the distance grows most. On a
    /// surface, it is the normal; if there are no obstacles, the zero vector.
    pub fn normal(&self, place: Vector) -> Result<DVec3> {
        let Some((near, is_inside)) = self.surface(place.0)? else { return Ok(DVec3::ZERO) };
        let away = place.0 - near.position;
        if away.length() <= TOUCHING {
            return Ok(near.normal);
        }
        Ok(away.normalize_or_zero() * if is_inside { -1.0 } else { 1.0 })
    }

    /// Returns the share of the segment between two places (m) at which it meets the first obstacle, from 0 to 1: 0 if it
    /// begins in one, and nil if it meets none.
    pub fn hit(&self, from: Vector, to: Vector) -> Result<Option<f64>> {
        let (from, to) = (from.0, to.0);
        let selection = AlongSegment::new(from, to, 1.0);
        let mut first = None;
        for indexed in self.index()?.locate_with_selection_function(&selection) {
            if selection.entry(indexed.solid.bounds()).is_some()
                && let Some(share) = indexed.solid.hit(from, to)
                && first.is_none_or(|first| share < first)
            {
                selection.nearest.set(share);
                first = Some(share);
            }
        }
        Ok(first)
    }
}

impl ObstacleSolids {
    /// Creates obstacles without solids.
    ///
    /// ```
    /// use burgeon_kit::Vector;
    /// use burgeon_objects::ObstacleSolids;
    /// use glam::DVec3;
    ///
    /// let at = |x: f64, y: f64, z: f64| Vector(DVec3::new(x, y, z));
    /// let garden = ObstacleSolids::new().r#box(at(0.0, 0.0, 0.0), at(1.0, 4.0, 2.0))?.sphere(at(5.0, 0.0, 1.0), 1.0)?;
    /// assert!(garden.contains(at(0.5, 1.0, 1.0))? && !garden.contains(at(2.0, 1.0, 1.0))?);
    /// assert_eq!(garden.distance(at(3.0, 0.0, 1.0))?, 1.0);
    /// assert_eq!(garden.hit(at(3.0, 0.0, 1.0), at(-1.0, 0.0, 1.0))?, Some(0.5));
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn new() -> Self {
        Self::default()
    }

    fn size(&self) -> usize {
        self.last.as_ref().map_or(0, |link| link.count)
    }

    /// Returns these obstacles and another solid.
    fn with(&self, solid: Solid) -> Self {
        let link = SolidLink { solid, before: self.last.clone(), count: self.size() + 1 };
        Self { last: Some(Arc::new(link)), index: OnceLock::new() }
    }

    fn index(&self) -> Result<&RTree<IndexedSolid>> {
        if let Some(index) = self.index.get() {
            return Ok(index);
        }
        MemoryOwner::ensure_room(self.size().saturating_mul(SOLID_BYTES))?;
        let links = std::iter::successors(self.last.as_ref(), |link| link.before.as_ref());
        let mut solids: Vec<IndexedSolid> = links.map(|link| link.solid.clone().into()).collect();
        solids.reverse();
        Ok(self.index.get_or_init(|| Arc::new(RTree::bulk_load(solids))))
    }

    /// Returns the solids that contain a place.
    fn around(&self, place: DVec3) -> Result<impl Iterator<Item = &Solid>> {
        let point = rstar::AABB::from_point(place.to_array());
        let near = self.index()?.locate_in_envelope_intersecting(&point);
        Ok(near.map(|indexed| &indexed.solid).filter(move |solid| solid.contains(place)))
    }

    /// Returns the nearest point of the surfaces, and true if the place is in an obstacle; `None` if there are none.
    fn surface(&self, place: DVec3) -> Result<Option<(SolidSurfacePoint, bool)>> {
        let depth = |near: &SolidSurfacePoint| near.position.distance_squared(place);
        let inside = self.around(place)?.map(|solid| solid.nearest(place));
        if let Some(deepest) = inside.max_by(|a, b| depth(a).total_cmp(&depth(b))) {
            return Ok(Some((deepest, true)));
        }
        let nearest = self.index()?.nearest_neighbor(&place.to_array());
        Ok(nearest.map(|indexed| (indexed.solid.nearest(place), false)))
    }
}

impl Environment for ObstacleSolids {
    fn end_pass(&mut self) -> Result<()> {
        Ok(())
    }
}

impl Answer for ObstacleSolids {
    fn luau() -> String {
        "Obstacles".into()
    }

    fn answer(self) -> Result<Value> {
        Ok(Value::Object(Arc::new(self)))
    }
}

/// Returns the closed mesh of all instances of a model in their places.
fn mesh_of(model: &Model, placed: DAffine3) -> Result<ClosedMesh> {
    MemoryOwner::ensure_room(model.size().saturating_mul(size_of::<[DVec3; 3]>()))?;
    let mut triangles = Vec::with_capacity(model.size());
    for (parts, transform) in model.meshes() {
        let transform = placed * transform;
        for (part, _) in parts {
            let place = |corner: u32| transform.transform_point3(part.positions[corner as usize].as_dvec3());
            triangles.extend(part.triangles.iter().map(|corners| corners.map(place)));
        }
    }
    if triangles.iter().flatten().any(|place| !is_near(*place)) {
        return Err(Error::argument(format!("the model extends beyond {FARTHEST:e} m"))
            .help("place it nearer, or use a smaller scale"));
    }
    ClosedMesh::new(triangles)
}

fn is_near(place: DVec3) -> bool {
    place.is_finite() && place.abs().max_element() <= FARTHEST
}

fn text(place: DVec3) -> String {
    let [x, y, z] = place.to_array();
    format!("{{{x:?}, {y:?}, {z:?}}}")
}
