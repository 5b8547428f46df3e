//! Volumes that shapes claim one after another: `volumes` in scripts.

use std::hash::{Hash, Hasher};
use std::sync::Arc;

use burgeon_base::error::Result;
use burgeon_base::{MemoryOwner, Stop};
use burgeon_kit::{Environment, ObjectContent as _, Vector, methods, object};
use burgeon_shapes::Shape;
use glam::DVec3;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};
use rustc_hash::FxHashMap;

use super::object::ShapeObject;
use super::relations::ShapeOrPlace;

/// Volumes that shapes claim in the order of the chain: a claim succeeds if the shape overlaps none before it.
///
/// Interpretations claim, and rules ask for the result of the last pass. Of two shapes that exclude each other, the first
/// one stays.
#[object("volumes", can(Environment), example = include_str!("../../scripts/volumes.lua"), begins_empty, begin = restart)]
pub struct Volumes {
    claims: Vec<Claim>,
    boxes: RTree<GeomWithData<Rectangle<[f64; 3]>, usize>>,
    /// Results of all claims of the pass, by shape.
    results: FxHashMap<ShapeKey, bool>,
}

/// A successful claim.
#[derive(Clone)]
struct Claim {
    shape: Arc<ShapeObject>,
    label: Option<String>,
    /// Number by which shapes are ranked.
    value: Option<f64>,
}

#[methods("volumes")]
impl Volumes {
    /// Claims the volume of a shape, with a label and a `value` for ranks. It succeeds if the shape overlaps no shape that claimed
    /// before in this pass.
    pub fn claim(
        &mut self,
        shape: Arc<ShapeObject>,
        label: Option<String>,
        value: Option<f64>,
    ) -> Result<()> {
        let is_free = self.is_free(Arc::clone(&shape), None)?;
        MemoryOwner::ensure_room(2 * self.claims.len() * size_of::<Claim>())?;
        let result = self.results.entry(ShapeKey(Arc::clone(&shape))).or_insert(false);
        *result |= is_free;
        if is_free {
            let [low, high] = shape.shape().bounds().map(|at| at.to_array());
            self.boxes.insert(GeomWithData::new(Rectangle::from_corners(low, high), self.claims.len()));
            self.claims.push(Claim { shape, label, value });
        }
        Ok(())
    }

    /// Returns true if the claim of a shape succeeded in the last pass. A shape that did not claim has no volume.
    pub fn has(&self, shape: Arc<ShapeObject>) -> bool {
        self.results.get(&ShapeKey(shape)).copied().unwrap_or(false)
    }

    /// Returns true if a shape overlaps no claimed shape with a label, or none at all.
    pub fn is_free(&self, shape: Arc<ShapeObject>, label: Option<String>) -> Result<bool> {
        for claim in self.near(shape.shape(), 0.0, label.as_deref()) {
            Stop::check_current()?;
            if claim.shape.shape().overlaps(shape.shape())? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Returns the number of claimed shapes with a label, or of all.
    pub fn count(&self, label: Option<String>) -> f64 {
        self.claims.iter().filter(|claim| label.is_none() || claim.label == label).count() as f64
    }

    /// Returns the rank of a value among those of the claimed shapes with a label, or of all: 1 if none is greater.
    pub fn rank(&self, value: f64, label: Option<String>) -> f64 {
        let is_greater = |claim: &&Claim| {
            (label.is_none() || claim.label == label) && claim.value.is_some_and(|other| other > value)
        };
        self.claims.iter().filter(is_greater).count() as f64 + 1.0
    }

    /// Returns true if no claimed shape with a label, or of all, is between two positions (m), which are outside of their own shapes.
    pub fn is_visible(&self, from: Vector, to: Vector, label: Option<String>) -> Result<bool> {
        let line = Shape::cuboid((to.0 - from.0).abs()).translate(from.0.min(to.0));
        for claim in self.near(&line, 0.0, label.as_deref()) {
            Stop::check_current()?;
            if claim.shape.shape().blocks(from.0, to.0)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Returns the distance (m) from a position or a shape to the nearest other claimed shape with a label, or of all, up
    /// to `most` (m, 100 unless given); nil if there is none.
    pub fn distance(
        &self,
        from: ShapeOrPlace,
        label: Option<String>,
        most: Option<f64>,
    ) -> Result<Option<f64>> {
        let most = most.unwrap_or(100.0);
        let own = match &from {
            ShapeOrPlace::Place(place) => Shape::cuboid(DVec3::splat(1e-9)).translate(*place),
            ShapeOrPlace::Shape(shape) => shape.shape().clone(),
        };
        let mut least: Option<f64> = None;
        for claim in self.near(&own, most, label.as_deref()) {
            Stop::check_current()?;
            let distance = match &from {
                ShapeOrPlace::Place(place) => claim.shape.shape().distance_to_place(*place)?,
                ShapeOrPlace::Shape(shape) if shape.equals(&*claim.shape) => continue,
                ShapeOrPlace::Shape(shape) => claim.shape.shape().distance(shape.shape())?,
            };
            if distance <= most && least.is_none_or(|least| distance < least) {
                least = Some(distance);
            }
        }
        Ok(least)
    }
}

impl Volumes {
    /// Returns the claims whose bounding boxes are within a distance (m), in their order.
    fn near(&self, shape: &Shape, reach: f64, label: Option<&str>) -> Vec<&Claim> {
        let [low, high] = shape.bounds();
        let around = AABB::from_corners((low - reach).to_array(), (high + reach).to_array());
        let mut numbers: Vec<usize> =
            self.boxes.locate_in_envelope_intersecting(&around).map(|found| found.data).collect();
        numbers.sort_unstable();
        let claims = numbers.into_iter().map(|number| &self.claims[number]);
        claims.filter(|claim| label.is_none() || claim.label.as_deref() == label).collect()
    }

    fn restart(&mut self) {
        self.claims.clear();
        self.boxes = RTree::new();
        self.results.clear();
    }
}

impl Environment for Volumes {
    fn end_pass(&mut self) -> Result<()> {
        Ok(())
    }
}

/// A shape as a key: by its content.
#[derive(Clone)]
struct ShapeKey(Arc<ShapeObject>);

impl PartialEq for ShapeKey {
    fn eq(&self, other: &Self) -> bool {
        self.0.equals(&*other.0)
    }
}

impl Eq for ShapeKey {}

impl Hash for ShapeKey {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0.hash(state);
    }
}
