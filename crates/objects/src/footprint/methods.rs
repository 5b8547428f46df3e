//! The read and write methods of footprints, and the work before and after a pass.

use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3};

use super::object::Footprint;
use super::state::Shell;
use super::walls::Walls;
use crate::MaterialOptions;
use crate::roofs::Roof;
use crate::shapes::{ShapeObject, ShapeTarget, draw_building};
use burgeon_base::error::Result;
use burgeon_base::warning::Warning;
use burgeon_kit::{Color, TableOf, Value, Vector, methods};

#[methods("footprint")]
impl Footprint {
    /// Builds the groundwork: "z_min" at the lowest point, "z_max" at the highest, "extruded" with faces down to the
    /// ground.
    pub fn groundwork(&mut self, kind: String, material: Option<MaterialOptions>) -> Result<()> {
        self.lay(&kind, material.as_ref())
    }

    /// Raises walls: { height, templates, photo, bay, color, material, expand }.
    pub fn walls(&mut self, options: Option<TableOf<Walls>>) -> Result<()> {
        let options = options.unwrap_or_default().read()?;
        self.raise(&options)
    }

    /// Adds the roof: { kind, height, slope, overhang, eaves, slab, material, gable, details, ... }.
    pub fn roof(&mut self, options: Option<TableOf<Roof>>) -> Result<()> {
        let options = options.unwrap_or_default().read()?;
        self.cover(&options)
    }

    /// Draws the faces of a shape in the coordinates of the world, in their own colours, or else in `color`, that of the footprint
    /// unless given.
    ///
    /// For formats with meanings, faces with the tag "roof" are roofs, with "extrude.bottom" ground, with "window" or "door" openings,
    /// and all others walls.
    pub fn shape(&mut self, shape: Arc<ShapeObject>, color: Option<Color>) -> Result<()> {
        let material = Arc::new(self.material(None, None)?);
        let transform = DAffine3::from_translation(-self.origin());
        let to = ShapeTarget { drawing: &mut self.drawing, base: &material, color };
        let warning = draw_building(to, &transform, &shape)?;
        if warning.is_some() {
            let remark = Warning::simplification("an edge of a shape draws nothing");
            self.notes.push(remark.with_cause("it has no faces"));
        }
        Ok(())
    }

    /// Returns the plan as a face at the lowest height of the ground, in the coordinates of the world (m).
    pub fn plan(&self) -> Result<ShapeObject> {
        let origin = self.origin();
        let rings: Vec<Vec<DVec2>> = self
            .plan
            .polygon()
            .iter()
            .map(|ring| ring.iter().map(|at| (*at + origin).truncate()).collect())
            .collect();
        Ok(ShapeObject::new(burgeon_shapes::Shape::plan(&rings, origin.z + self.plan.ground().0)?))
    }

    /// Returns the area (m²) without the holes.
    pub fn area(&self) -> f64 {
        self.plan.polygon().area()
    }

    /// Returns the total length (m) of the edges.
    pub fn perimeter(&self) -> f64 {
        self.plan.polygon().length()
    }

    /// Returns the number of given edges: the edges of the outer ring, then the edges of the holes.
    pub fn edges(&self) -> u32 {
        u32::try_from(self.plan.given()).unwrap_or(u32::MAX)
    }

    /// Returns the length (m) of an edge, by its number from 1.
    pub fn edge_length(&self, edge: u32) -> Result<f64> {
        self.ends("edge_length", edge).map(|[a, b]| a.distance(b))
    }

    /// Returns the start (m) of an edge, at the height of the lowest ground.
    pub fn edge_start(&self, edge: u32) -> Result<DVec3> {
        self.ends("edge_start", edge).map(|[a, _]| a.extend(self.lowest()))
    }

    /// Returns the direction that an edge faces (degrees): 0 is east, 90 is north.
    pub fn edge_facing(&self, edge: u32) -> Result<f64> {
        self.facing_angle(edge)
    }

    /// Returns true if an edge has this keyword: a given keyword, or "blind" (neighbours cover half of its wall or
    /// more), "street" or "entry door".
    pub fn edge_has(&self, edge: u32, keyword: String) -> Result<bool> {
        self.words_of(edge).map(|words| words.iter().any(|word| *word == keyword))
    }

    /// Returns the fraction, 0 to 1, of an edge that neighbours touch.
    pub fn shared(&self, edge: u32) -> Result<f64> {
        self.part_shared(edge)
    }

    /// Returns the number of footprints of the system that touch this one.
    pub fn neighbors(&self) -> u32 {
        self.neighbor_count()
    }

    /// Returns the number of the edge on the street side: the nearest edge that faces a street, or the longest edge
    /// without streets. Prefers edges that are not party walls.
    pub fn street_edge(&self) -> u32 {
        self.on_street()
    }

    /// Returns the attribute with this name.
    pub fn attribute(&self, name: String) -> Value {
        self.options.attributes.get(&name).cloned().unwrap_or(Value::Nil)
    }

    /// Returns the ratio of the area to the area of the convex hull: 1 if the polygon is convex.
    pub fn convexity(&self) -> f64 {
        self.plan.convexity()
    }

    /// Returns the minimum ground height at the points (m).
    pub fn lowest(&self) -> f64 {
        self.origin().z + self.plan.ground().0
    }

    /// Returns the maximum ground height at the points (m).
    pub fn highest(&self) -> f64 {
        self.origin().z + self.plan.ground().1
    }

    /// Returns the wall height given to the constructor (m), or 0 if none was given.
    pub fn height(&self) -> f64 {
        self.options.height.map_or(0.0, |height| height.0)
    }

    /// Returns true if the footprint has this keyword.
    pub fn has(&self, keyword: String) -> bool {
        self.options.keywords.contains(&keyword)
    }

    /// Returns the distance (m) from a position to the nearest point of the drawn building.
    pub fn distance(&self, place: Vector) -> f64 {
        self.drawing.distance(place.0 - self.origin())
    }
}

impl Footprint {
    pub(super) fn restart(&mut self) {
        self.shell = Shell::new(&self.plan);
        self.sides.clear();
        self.drawing.clear();
        self.raised = 0;
        self.plain = None;
        let (repairs, trouble) = self.plan.repairs();
        self.notes = repairs.iter().map(|what| Warning::simplification(what).with_cause(trouble)).collect();
    }

    pub(super) fn finish(&mut self) -> Result<()> {
        self.finish_walls()
    }

    pub(super) fn take_seed(&mut self, seed: u64) {
        self.seed = seed;
    }
}
