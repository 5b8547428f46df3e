//! The object: what scripts see of a footprint.

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
use burgeon_geometry::{Plan, Rings};
use burgeon_kit::{
    Color, Drawing, Expectation, GeometryObject, LevelOfDetail, Note, Parameter, Report, Table, TableOf,
    Value, Vector, fields, methods, object,
};
use burgeon_scene::Material;
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

/// What `footprint(geometry, { ... })` takes.
#[fields("footprint")]
pub struct FootprintOptions {
    /// The polygon on the ground (m): a feature's geometry, or rings of points, the holes after the outer one.
    pub geometry: Rings,
    /// Words that say what kind of building it is, such as "shop".
    pub keywords: Vec<String>,
    /// Words about single edges, by their numbers: { [2] = { "entry door" } }. Edge 1 goes from the first point
    /// that was given to the second; those of holes count on after the outer ring's.
    pub edge_keywords: EdgeKeywords,
    /// What else is known of it, for `attribute` to tell: any table, such as the feature.
    pub attributes: Arc<Table>,
    /// The streets by which it lies, as `streets(source)` made them.
    pub streets: Option<LineIndex>,
    /// The terrain on which it stands, which gives its points their heights.
    pub ground: Option<Arc<Terrain>>,
    /// Height of the walls (m), where they are not given one.
    pub height: Option<Height>,
    /// Colour of what is drawn, where it is given none.
    #[default(Color([0.62, 0.58, 0.52, 1.0]))]
    pub color: Color,
}

/// The highest walls and roofs (m).
const HIGHEST: f64 = 2000.0;

/// A building: groundwork, walls and a roof over a polygon on the ground.
///
/// They rise as one closed solid. Walls stand on the groundwork or on earlier walls, the roof stands on the walls and ends the building.
#[object(
    "footprint",
    options = FootprintOptions,
    make = from_table,
    first = "geometry",
    example = include_str!("../../scripts/footprint.lua"),
    draws,
    has_detail,
    reports,
    begins_empty,
    begin = restart,
    end = finish,
    seed = take_seed,
    gathers = neighbors::gather,
    prefetches = |layer| Arc::new(PlanPrefetch::new(layer))
)]
pub struct Footprint {
    pub(super) options: Arc<FootprintOptions>,
    pub(super) plan: Arc<Plan>,
    /// What is known of the edges, once someone has asked.
    pub(super) edges: Arc<OnceLock<Edges>>,
    /// The footprints of its system, and its number among them.
    pub(super) place: Option<(Arc<Neighborhood>, usize)>,
    pub(super) shell: Shell,
    /// The walls over each edge, once there are some.
    pub(super) sides: Vec<Side>,
    pub(super) drawing: Drawing,
    /// Where random choices come from.
    pub(super) seed: u64,
    /// The level of detail, from 0 to 3.
    pub(super) detail: u8,
    /// How often walls have been raised.
    pub(super) raised: u64,
    /// Walls that are still to be drawn.
    pub(super) plain: Option<Plain>,
    pub(super) notes: Vec<Note>,
}

#[methods("footprint")]
impl Footprint {
    /// Lays the ground: "z_min" at the lowest point, "z_max" at the highest, "extruded" with faces down from it.
    pub fn groundwork(&mut self, kind: String, material: Option<MaterialOptions>) -> Result<()> {
        self.lay(&kind, material)
    }

    /// Raises walls: { height, templates, photo, bay, color, material, expand }.
    pub fn walls(&mut self, options: Option<TableOf<Walls>>) -> Result<()> {
        let options = options.unwrap_or_default().read()?;
        self.raise(&options)
    }

    /// Puts on the roof: { kind, height, slope, overhang, eaves, slab, material, gable, details, ... }.
    pub fn roof(&mut self, options: Option<TableOf<Roof>>) -> Result<()> {
        let options = options.unwrap_or_default().read()?;
        self.cover(&options)
    }

    /// Its area (m²) without the holes.
    pub fn area(&self) -> f64 {
        self.plan.polygon().area()
    }

    /// The length (m) of its edges.
    pub fn perimeter(&self) -> f64 {
        self.plan.polygon().length()
    }

    /// The number of its edges, as they were given: first those of the outer ring, then those of the holes.
    pub fn edges(&self) -> u32 {
        u32::try_from(self.plan.given()).unwrap_or(u32::MAX)
    }

    /// The length (m) of an edge, by its number from 1.
    pub fn edge_length(&self, edge: u32) -> Result<f64> {
        self.ends("edge_length", edge).map(|[a, b]| a.distance(b))
    }

    /// The place (m) where an edge begins, at the height of the lowest ground.
    pub fn edge_start(&self, edge: u32) -> Result<DVec3> {
        self.ends("edge_start", edge).map(|[a, _]| a.extend(self.lowest()))
    }

    /// The way an edge faces (degrees): 0 is east, 90 is north.
    pub fn edge_facing(&self, edge: u32) -> Result<f64> {
        self.facing(edge)
    }

    /// Returns true if an edge has this keyword: one it was given, or "blind" (neighbours cover half of its wall or more),
    /// "street" or "entry door".
    pub fn edge_has(&self, edge: u32, keyword: String) -> Result<bool> {
        self.words_of(edge).map(|words| words.iter().any(|word| *word == keyword))
    }

    /// The part of an edge, 0 to 1, that neighbours touch.
    pub fn shared(&self, edge: u32) -> Result<f64> {
        self.part_shared(edge)
    }

    /// How many of its system's footprints touch it.
    pub fn neighbors(&self) -> u32 {
        self.touching()
    }

    /// The number of the edge on the street side: the nearest to a street that it faces, without streets the
    /// longest; no party wall if there is another.
    pub fn street_edge(&self) -> u32 {
        self.on_street()
    }

    /// What its attributes have under this name.
    pub fn attribute(&self, name: String) -> Value {
        self.options.attributes.get(&name).cloned().unwrap_or(Value::Nil)
    }

    /// Its area as a part of its convex hull's: 1 if it is convex.
    pub fn convexity(&self) -> f64 {
        self.plan.convexity()
    }

    /// The lowest ground at its points (m).
    pub fn lowest(&self) -> f64 {
        self.origin().z + self.plan.ground().0
    }

    /// The highest ground at its points (m).
    pub fn highest(&self) -> f64 {
        self.origin().z + self.plan.ground().1
    }

    /// How high the walls are that it was made with (m); 0 if it was not told.
    pub fn height(&self) -> f64 {
        self.options.height.map_or(0.0, |height| height.0)
    }

    /// Whether it has this keyword.
    pub fn has(&self, keyword: String) -> bool {
        self.options.keywords.contains(&keyword)
    }

    /// Distance (m) from a place to the nearest point of what it has drawn.
    pub fn distance(&self, place: Vector) -> f64 {
        self.drawing.distance(place.0 - self.origin())
    }
}

impl Footprint {
    fn from_table(table: &Table) -> Result<Self> {
        let options = FootprintOptions::from_table(table)?;
        // Under other heights it is another plan.
        let ready = if options.ground.is_none() { prefetched(table) } else { None };
        Self::with(options, ready)
    }

    /// A footprint that has drawn nothing yet; without rings it can only stand for its type.
    pub fn new(options: FootprintOptions) -> Result<Self> {
        Self::with(options, None)
    }

    /// The same, where its plan may be ready.
    fn with(mut options: FootprintOptions, ready: Option<Result<LocalPlan>>) -> Result<Self> {
        if let Some(ground) = &options.ground {
            for point in options.geometry.0.iter_mut().flatten() {
                point.z = ground.height(Vector(*point)).map_err(Error::of_data)?;
            }
        }
        let LocalPlan { plan, origin } = match ready {
            Some(ready) => ready?,
            None => LocalPlan::new(&options.geometry)?,
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

    /// Where the mesh has its origin (m): a whole number of metres near the plan.
    pub(super) fn origin(&self) -> DVec3 {
        self.drawing.origin()
    }

    /// The part with this material, or with this colour, or with the footprint's own.
    pub(super) fn part(&mut self, color: Option<Color>, material: Option<&MaterialOptions>) -> Result<usize> {
        let material = match material {
            Some(surface) => surface.material()?,
            None => Material { base_color: color.unwrap_or(self.options.color).0, ..Material::default() },
        };
        Ok(self.drawing.material(&material))
    }

    /// Fails if nothing can be built, or `what` comes too late.
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

/// The plan of the geometry in a table of options, if another thread has made it.
fn prefetched(options: &Table) -> Option<Result<LocalPlan>> {
    let Some(Value::Object(object)) = options.get("geometry") else { return None };
    let any: &dyn std::any::Any = &**object;
    let (prefetch, number) = any.downcast_ref::<GeometryObject>()?.prefetch()?;
    let any: &dyn std::any::Any = prefetch;
    any.downcast_ref::<PlanPrefetch>()?.take(number)
}

/// Fails if a height (m) is not above 0 or is absurd.
pub(super) fn check_height(what: &str, height: f64) -> Result<()> {
    if height > 0.0 && height <= HIGHEST {
        return Ok(());
    }
    let error = Error::argument(format!("{what} is {} m", Value::Number(height)));
    Err(error.help(format!("give metres above 0, up to {HIGHEST}")).of_data())
}

/// The error for a kind that there is not.
pub(super) fn unknown(what: &str, kind: &str, known: &[&'static str]) -> Error {
    Error::not_found("kind", kind, known.iter().copied(), format!("{what} has no kind called {kind:?}"))
        .help(format!("there are {}", known.join(", ")))
}

/// The direction of an edge on the ground.
pub(super) fn along(from: DVec2, to: DVec2) -> DVec3 {
    (to - from).normalize_or_zero().extend(0.0)
}

impl Footprint {
    /// The rings (m) that it was given.
    pub fn rings(&self) -> &burgeon_geometry::Rings {
        &self.options.geometry
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
