//! The footprint object of scripts: its state, and its construction.

use std::sync::{Arc, OnceLock};

use super::neighbors::Neighborhood;
use super::options::FootprintOptions;
use super::prefetch::{LocalPlan, PlanPrefetch};
use super::state::{Edges, Plain, Shell, Side};
use crate::MaterialOptions;
use crate::roofs::{Height, check_height};
use burgeon_base::error::{Error, Result};
use burgeon_base::warning::Warning;
use burgeon_geometry::Plan;
use burgeon_kit::declare::as_mut;
use burgeon_kit::{Color, Drawing, LevelOfDetail, Object, Report, Table, Value, Vector, Warn, object};
use burgeon_scene::Material;
use burgeon_spatial::GeometryObject;
use glam::DVec3;

/// A building: groundwork, walls and a roof over a polygon on the ground.
///
/// The parts form one closed solid. Walls stand on the groundwork or on earlier walls. The roof covers the walls and
/// completes the building.
///
/// ```
/// use burgeon_kit::{Object, Parameter, Table, TableKey, Value, object};
/// use burgeon_objects::Footprint;
/// use glam::DVec3;
/// use std::sync::Arc;
///
/// let ring = [(0.0, 0.0), (10.0, 0.0), (10.0, 6.0), (0.0, 6.0)].map(|(x, y)| DVec3::new(x, y, 0.0));
/// let options = [("geometry", vec![ring.to_vec()].into_value()), ("height", Value::Number(5.0))];
/// let entries = options.map(|(name, value)| (TableKey::Name(name.into()), value)).to_vec();
/// let house = Value::Object(Footprint::kind().make(&Table { class: None, entries })?.into());
/// let mut house = Arc::unwrap_or_clone(object::<Footprint>(house, "a footprint").expect("a footprint"));
/// assert_eq!((house.area(), house.edges()), (60.0, 4));
/// house.walls(None)?;
/// house.roof(None)?;
/// house.end()?;
/// let drawn: &dyn Object = &house;
/// assert!(drawn.triangles() > 8);
/// # Ok::<(), burgeon_base::Error>(())
/// ```
#[object(
    "footprint",
    options = FootprintOptions,
    make = from_table,
    first = "geometry",
    example = include_str!("../../scripts/footprint.lua"),
    draws,
    can(LevelOfDetail, Report, Warn),
    begins_empty,
    begin = restart,
    end = finish,
    seed = take_seed,
    gathers = gather,
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
    pub(super) notes: Vec<Warning>,
    /// Warnings since the last call of `take_warnings`.
    pub(super) warnings: Vec<Warning>,
}

impl Footprint {
    fn from_table(table: &Table) -> Result<Self> {
        let options = FootprintOptions::from_table(table)?;
        // A prefetched plan does not have the terrain's heights.
        let ready = if options.ground.is_none() { prefetched_plan(table) } else { None };
        Self::with_plan(options, ready)
    }

    /// Creates a footprint without any drawn parts. Without rings, the footprint only represents its type.
    pub fn new(options: FootprintOptions) -> Result<Self> {
        Self::with_plan(options, None)
    }

    /// Creates a footprint from a plan that may be prefetched.
    fn with_plan(mut options: FootprintOptions, ready: Option<Result<LocalPlan>>) -> Result<Self> {
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
            warnings: Vec::new(),
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
        let material = self.material(color, material)?;
        Ok(self.drawing.material(&material))
    }

    /// Returns this material, or one with this colour or the footprint's colour, in this order.
    pub(super) fn material(
        &self,
        color: Option<Color>,
        material: Option<&MaterialOptions>,
    ) -> Result<Material> {
        match material {
            Some(surface) => surface.material(),
            None => Ok(Material { base_color: color.unwrap_or(self.options.color).0, ..Material::default() }),
        }
    }

    /// Fails if keywords are given to an edge that does not exist.
    fn check_edge_keywords(&self) -> Result<()> {
        let count = self.plan.given();
        match self.options.edge_keywords.0.keys().find(|number| !(1..=count).contains(*number)) {
            None => Ok(()),
            Some(number) => {
                Err(Error::argument(format!("footprint: edge_keywords refers to the unknown edge {number}"))
                    .help(format!("the geometry has the edges 1 to {count}")))
            }
        }
    }
    /// Fails if there is no geometry to build on, or if the building already has its roof.
    pub(super) fn check_open(&self, what: &str) -> Result<()> {
        if self.plan.polygon().is_empty() {
            return Err(Error::script(format!("footprint:{what}: the footprint has no geometry"))
                .help("create it with one: footprint(feature.geometry)"));
        }
        if self.shell.closed {
            return Err(Error::script(format!("footprint:{what}: the building already has a roof"))
                .help("call roof last"));
        }
        Ok(())
    }
}

/// Connects the footprints among `objects` with one another.
pub(super) fn gather(objects: &mut [Box<dyn Object>]) {
    let mut found: Vec<&mut Footprint> =
        objects.iter_mut().filter_map(|object| as_mut::<Footprint>(&mut **object)).collect();
    let plans = found.iter().map(|footprint| (Arc::clone(&footprint.plan), footprint.origin().truncate()));
    let top = |footprint: &&mut Footprint| {
        footprint.options.height.map(|height| footprint.origin().z + footprint.plan.ground().1 + height.0)
    };
    let all = Arc::new(Neighborhood::new(plans.collect(), found.iter().map(top).collect()));
    for (index, footprint) in found.iter_mut().enumerate() {
        footprint.place = Some((Arc::clone(&all), index));
        footprint.edges = Arc::default();
    }
}

/// Returns the plan of the geometry in a table of options, if another thread has computed it.
fn prefetched_plan(options: &Table) -> Option<Result<LocalPlan>> {
    let Some(Value::Object(object)) = options.get("geometry") else { return None };
    let any: &dyn std::any::Any = &**object;
    let (prefetch, number) = any.downcast_ref::<GeometryObject>()?.prefetch()?;
    let any: &dyn std::any::Any = prefetch;
    any.downcast_ref::<PlanPrefetch>()?.take(number)
}

impl Footprint {
    /// Returns the given rings (m).
    pub fn rings(&self) -> &burgeon_geometry::Rings {
        &self.options.geometry.0
    }
}

impl LevelOfDetail for Footprint {
    fn set_detail(&mut self, detail: u8) {
        self.detail = detail;
    }
}

impl Report for Footprint {
    fn notes(&self) -> &[Warning] {
        &self.notes
    }
}

impl Warn for Footprint {
    fn take_warnings(&mut self) -> Vec<Warning> {
        std::mem::take(&mut self.warnings)
    }
}
