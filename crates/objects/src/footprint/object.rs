//! The footprint object of scripts.

use std::sync::{Arc, OnceLock};

use super::edges::Edges;
use super::neighbors::Neighborhood;
use super::prefetch::{LocalPlan, PlanPrefetch};
use super::shell::Shell;
use super::sides::Side;
use super::walls::Plain;
use super::{EdgeKeywords, Roof, Walls, neighbors};
use crate::{LineIndex, MaterialOptions, Terrain};
use burgeon_base::error::{Error, Result};
use burgeon_geometry::Plan;
use burgeon_kit::{
    Color, Drawing, Expectation, LevelOfDetail, Note, Parameter, Report, Table, TableOf, Value, Vector,
    fields, methods, object,
};
use burgeon_scene::Material;
use burgeon_spatial::{GeometryObject, PolygonArgument};
use glam::{DVec2, DVec3};

/// A height (m).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Height(pub f64);

impl Parameter for Height {
    fn luau() -> String {
        f64::luau()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        f64::from_value(value).map(Self)
    }

    fn into_value(self) -> Value {
        self.0.into_value()
    }
}

/// Options of `footprint(geometry, { ... })`.
#[fields("footprint")]
pub struct FootprintOptions {
    /// Polygon on the ground (m): a feature's geometry, or rings of points, the outer ring first and then the holes.
    pub geometry: PolygonArgument,
    /// Keywords for the type of building, such as "shop".
    pub keywords: Vec<String>,
    /// Keywords of single edges, by edge number: { [2] = { "entry door" } }. Edge 1 runs from the first given point to
    /// the second. The edges of holes follow the edges of the outer ring.
    pub edge_keywords: EdgeKeywords,
    /// Further data, which `attribute` returns: any table, such as the feature.
    pub attributes: Arc<Table>,
    /// Nearby streets, as `streets(source)` returns them.
    pub streets: Option<LineIndex>,
    /// Terrain under the building, which sets the heights of its points.
    pub ground: Option<Arc<Terrain>>,
    /// Default height of the walls (m).
    pub height: Option<Height>,
    /// Default colour of the building.
    #[default(Color([0.62, 0.58, 0.52, 1.0]))]
    pub color: Color,
}

/// Maximum height (m) of walls and roofs.
const HIGHEST: f64 = 2000.0;

/// A building: groundwork, walls and a roof over a polygon on the ground.
///
/// The parts form one closed solid. Walls stand on the groundwork or on earlier walls. The roof covers the walls and
/// completes the building.
#[object(
    "footprint",
    options = FootprintOptions,
    make = from_table,
    first = "geometry",
    example = include_str!("../../scripts/footprint.lua"),
    draws,
    can(LevelOfDetail, Report),
    begins_empty,
    begin = restart,
    end = finish,
    seed = take_seed,
    gathers = neighbors::gather,
    prefetches = |features| Some(Arc::new(PlanPrefetch::new(features)?))
)]
pub struct Footprint {
    pub(super) options: Arc<FootprintOptions>,
    pub(super) plan: Arc<Plan>,
    /// Properties of the edges, computed on first use.
    pub(super) edges: Arc<OnceLock<Edges>>,
    /// Footprints of the system, and the index of this one among them.
    pub(super) place: Option<(Arc<Neighborhood>, usize)>,
    pub(super) shell: Shell,
    /// Walls over each edge, empty before the first walls.
    pub(super) sides: Vec<Side>,
    pub(super) drawing: Drawing,
    /// Seed of random choices.
    pub(super) seed: u64,
    /// Level of detail, from 0 to 3.
    pub(super) detail: u8,
    /// Number of times that walls have been raised.
    pub(super) raised: u64,
    /// Walls that are still to be drawn.
    pub(super) plain: Option<Plain>,
    pub(super) notes: Vec<Note>,
}

#[methods("footprint")]
impl Footprint {
    /// Builds the groundwork: "z_min" at the lowest point, "z_max" at the highest, "extruded" with faces down to the
    /// ground.
    pub fn groundwork(&mut self, kind: String, material: Option<MaterialOptions>) -> Result<()> {
        self.lay(&kind, material)
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
        self.facing(edge)
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
        self.touching()
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
    fn from_table(table: &Table) -> Result<Self> {
        let options = FootprintOptions::from_table(table)?;
        // A prefetched plan does not have the terrain's heights.
        let ready = if options.ground.is_none() { prefetched(table) } else { None };
        Self::with(options, ready)
    }

    /// Creates a footprint without any drawn parts. Without rings, the footprint only represents its type.
    pub fn new(options: FootprintOptions) -> Result<Self> {
        Self::with(options, None)
    }

    /// Creates a footprint from a plan that may be prefetched.
    fn with(mut options: FootprintOptions, ready: Option<Result<LocalPlan>>) -> Result<Self> {
        if let Some(ground) = &options.ground {
            for point in options.geometry.0.0.iter_mut().flatten() {
                point.z = ground.height(Vector(*point)).map_err(Error::of_data)?;
            }
        }
        let LocalPlan { plan, origin } = match ready {
            Some(ready) => ready?,
            None => LocalPlan::new(&options.geometry.0)?,
        };
        if let Some(Height(height)) = options.height {
            check_height("footprint: height", height)?;
        }
        let shell = Shell::new(&plan);
        let footprint = Self {
            options: Arc::new(options),
            plan,
            edges: Arc::default(),
            place: None,
            shell,
            sides: Vec::new(),
            drawing: Drawing::at(origin),
            seed: 0,
            detail: 3,
            raised: 0,
            plain: None,
            notes: Vec::new(),
        };
        footprint.check_edge_keywords()?;
        Ok(footprint)
    }

    /// Returns the origin of the mesh (m): whole metres near the plan.
    pub(super) fn origin(&self) -> DVec3 {
        self.drawing.origin()
    }

    /// Returns the part of the drawing with this material, this colour, or the footprint's colour, in this order.
    pub(super) fn part(&mut self, color: Option<Color>, material: Option<&MaterialOptions>) -> Result<usize> {
        let material = match material {
            Some(surface) => surface.material()?,
            None => Material { base_color: color.unwrap_or(self.options.color).0, ..Material::default() },
        };
        Ok(self.drawing.material(&material))
    }

    /// Fails if there is no geometry to build on, or if the building already has its roof.
    pub(super) fn check_open(&self, what: &str) -> Result<()> {
        if self.plan.polygon().is_empty() {
            return Err(Error::script(format!("footprint:{what}: the footprint has no geometry"))
                .help("make it with one: footprint(feature.geometry)"));
        }
        if self.shell.closed {
            return Err(Error::script(format!("footprint:{what}: the building has its roof already"))
                .help("the roof comes last"));
        }
        Ok(())
    }
}

/// Returns the plan of the geometry in a table of options, if another thread has computed it.
fn prefetched(options: &Table) -> Option<Result<LocalPlan>> {
    let Some(Value::Object(object)) = options.get("geometry") else { return None };
    let any: &dyn std::any::Any = &**object;
    let (prefetch, number) = any.downcast_ref::<GeometryObject>()?.prefetch()?;
    let any: &dyn std::any::Any = prefetch;
    any.downcast_ref::<PlanPrefetch>()?.take(number)
}

/// Fails if a height (m) is not above 0 or exceeds the maximum.
pub(super) fn check_height(what: &str, height: f64) -> Result<()> {
    if height > 0.0 && height <= HIGHEST {
        return Ok(());
    }
    let error = Error::argument(format!("{what} is {} m", Value::Number(height)));
    Err(error.help(format!("give metres above 0, up to {HIGHEST}")).of_data())
}

/// Creates the error for an unknown kind.
pub(super) fn unknown(what: &str, kind: &str, known: &[&'static str]) -> Error {
    Error::not_found("kind", kind, known.iter().copied(), format!("{what} has no kind called {kind:?}"))
        .help(format!("there are {}", known.join(", ")))
}

/// Returns the horizontal direction of an edge.
pub(super) fn along(from: DVec2, to: DVec2) -> DVec3 {
    (to - from).normalize_or_zero().extend(0.0)
}

impl Footprint {
    /// Returns the given rings (m).
    pub fn rings(&self) -> &burgeon_geometry::Rings {
        &self.options.geometry.0
    }

    fn restart(&mut self) {
        self.shell = Shell::new(&self.plan);
        self.sides.clear();
        self.drawing.clear();
        self.raised = 0;
        self.plain = None;
        let (repairs, trouble) = self.plan.repairs();
        self.notes = repairs.iter().map(|what| Note::new(*what, trouble)).collect();
    }

    fn finish(&mut self) -> Result<()> {
        self.finish_walls()
    }

    fn take_seed(&mut self, seed: u64) {
        self.seed = seed;
    }
}

impl LevelOfDetail for Footprint {
    fn set_detail(&mut self, detail: u8) {
        self.detail = detail;
    }
}

impl Report for Footprint {
    fn notes(&self) -> &[Note] {
        &self.notes
    }
}
