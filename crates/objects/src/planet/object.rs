//! The planet object of scripts.

use std::sync::Arc;

use super::looks;
use super::options::PlanetOptions;
use crate::terrain::cells::Cells;
use crate::terrain::{lost_focus, round_length, rules};
use burgeon_base::error::{Error, Result};
use burgeon_base::text::number;
use burgeon_base::warning::Warning;
use burgeon_base::{MemoryOwner, ModuleKey, Stop};
use burgeon_kit::{Expand, Rewriter, Show, Vector, Warn, methods, object};
use burgeon_scene::{Instance, Material, Mesh, Scene, Upright};
use burgeon_terrain::World;
use burgeon_terrain::globe::{DEEPEST, DETAIL, Globe, GlobeMesh, GlobeView};
use glam::{DAffine3, DVec3};
use rayon::prelude::*;

/// A globe made by repeatedly dividing the six faces of a cube into quadrants, expanded near the eye.
///
/// Calls during a pass take effect at the end of the pass. Until then, the planet returns its earlier values.
#[object(
    "planet",
    can(Show, Expand, Warn),
    options = PlanetOptions,
    example = include_str!("../../scripts/planet.lua"),
    begins_empty,
    begin = restart,
    seed = take_seed,
)]
pub struct Planet {
    options: Arc<PlanetOptions>,
    globe: Globe,
    /// Eye position requested in the current pass (m, relative to the centre), and its height (m) above the ground.
    wanted: Option<(DVec3, f64)>,
    /// Eye position (m, relative to the centre).
    eye: Option<DVec3>,
    /// Height (m) of the eye above the ground that was expanded in the pass that set the eye.
    clearance: f64,
    /// Set if the script is only checked.
    sketched: bool,
    warnings: Vec<Warning>,
}

#[methods("planet")]
impl Planet {
    /// Expands the planet for an eye at `x` (m), `y` (m), `z` (m) when the pass ends: nearer tiles get more detail.
    /// Fails if the position is below the ground or the water of this pass. If the expanded ground is higher, the eye
    /// is raised to keep its height above the ground. Only the last call in a pass counts.
    pub fn focus(&mut self, x: f64, y: f64, z: f64) -> Result<()> {
        let (eye, radius) = (DVec3::new(x, y, z) - self.options.position.0, self.options.radius);
        if eye.length() < radius * (1.0 - DEEP) {
            return Err(Error::argument(format!(
                "planet: the focus ({x}, {y}, {z}) is inside the planet, {:.0} m from its centre",
                eye.length()
            ))
            .help(format!("its ground is about {radius} m from its centre: use a focus farther out")));
        }
        let above =
            self.globe.height(eye).map(|height| eye.length() - radius - self.globe.shown_height(height));
        if let Some(below) = above.map(|above| -above).filter(|below| *below > 1e-6 * radius.max(1.0)) {
            return Err(Error::argument(format!(
                "planet: the focus ({x}, {y}, {z}) is {} m below the {}",
                number(round_length(below)),
                self.surface_name(eye)
            ))
            .help(format!(
                "the surface there is {:.1} m from the centre: add a height to this:surface(direction)",
                eye.length() + below
            )));
        }
        if let Some((earlier, _)) = self.wanted.filter(|(earlier, _)| *earlier != eye) {
            let at = earlier + self.options.position.0;
            self.warnings.push(lost_focus("planet", &format!("({}, {}, {})", at.x, at.y, at.z)));
        }
        self.wanted = Some((eye, above.unwrap_or_default().max(0.0)));
        Ok(())
    }

    /// Returns the ground height (m) in a direction from the centre. Below water, this is the height of the sea floor.
    pub fn height(&self, direction: Vector) -> Result<f64> {
        self.require_expanded(self.globe.height(unit_direction(direction)?), 0.0)
    }

    /// Returns the position (m) of the ground or water surface in a direction from the centre.
    pub fn surface(&self, direction: Vector) -> Result<DVec3> {
        let way = unit_direction(direction)?;
        let height = self.require_expanded(self.globe.height(way), 0.0)?;
        Ok(self.options.position.0 + way * (self.options.radius + self.globe.shown_height(height)))
    }

    /// Returns the symbol of the cell in a direction from the centre.
    pub fn symbol(&self, direction: Vector) -> Result<String> {
        self.require_expanded(self.globe.symbol(unit_direction(direction)?), "").map(str::to_owned)
    }

    /// Returns the number of heights that are currently expanded.
    pub fn heights(&self) -> f64 {
        #[allow(clippy::cast_precision_loss, reason = "counts below 2^53")]
        let count = self.globe.heights() as f64;
        count
    }
}

/// Maximum depth of the ground below the radius, as a fraction of the radius.
const DEEP: f64 = 0.1;

impl Planet {
    /// Returns `found`. If it is `None`, returns `even` while the script is only checked, and otherwise an error.
    fn require_expanded<T>(&self, found: Option<T>, even: T) -> Result<T> {
        match found {
            None if self.sketched => Ok(even),
            found => found.ok_or_else(nothing),
        }
    }

    /// Creates a planet of which no tile is expanded.
    pub fn new(options: PlanetOptions) -> Result<Self> {
        if !(options.radius > 0.0 && options.radius <= 1e9) {
            return Err(Error::argument(format!("planet: radius is {} m", number(options.radius)))
                .help("use a length above 0 and up to 1e9 m"));
        }
        if options.error < 0.0 {
            return Err(Error::argument("planet: error is below 0")
                .help("use a fraction of a cell's size, such as 0.05"));
        }
        if !(DETAIL..=DEEPEST).contains(&options.levels) {
            return Err(Error::argument(format!("planet: levels is {}", options.levels))
                .help(format!("use {DETAIL} to {DEEPEST} levels")));
        }
        if !(0.0..=100.0).contains(&options.closeness) {
            return Err(Error::argument(format!("planet: closeness is {}", options.closeness))
                .help("use a number from 0 to 100, such as 3"));
        }
        if options.axis.0.length() <= 0.0 {
            return Err(Error::argument("planet: axis has no direction").help("write axis = { 0, 0, 1 }"));
        }
        if options.rules.0.is_empty() {
            return Err(rules::none("planet"));
        }
        let built =
            options.rules.build("planet", options.start.as_ref(), (options.height, options.decay), 0)?;
        let key = options.seed.map_or(ModuleKey::default(), |seed| ModuleKey::seed(seed.0));
        let world = World {
            corner: glam::DVec2::ZERO,
            size: options.radius,
            layers: built.layers,
            smooth: options.smooth,
            key: built.drawn.then_some(key),
            remap: Vec::new(),
            measured: None,
        };
        let sea = options.water.as_ref().map(|water| water.level);
        Ok(Self {
            warnings: options.rules.warnings("planet"),
            globe: Globe::new(world, options.radius, sea),
            options: Arc::new(options),
            wanted: None,
            sketched: false,
            eye: None,
            clearance: 0.0,
        })
    }

    /// Returns the name of the visible surface in a direction: water or ground.
    fn surface_name(&self, direction: DVec3) -> &'static str {
        let height = self.globe.height(direction);
        if self.globe.sea().is_some_and(|sea| height.is_some_and(|height| height < sea)) {
            "water"
        } else {
            "ground"
        }
    }

    /// Returns the globe as currently expanded.
    pub fn globe(&self) -> &Globe {
        &self.globe
    }
}

fn unit_direction(direction: Vector) -> Result<DVec3> {
    direction.0.try_normalize().ok_or_else(|| {
        Error::argument("planet: the direction has no length")
            .help("use a direction from the centre, such as { 1, 0, 0 }")
    })
}

fn nothing() -> Error {
    Error::script("planet: nothing is expanded yet").help("it is expanded from the end of the first pass")
}

impl std::fmt::Debug for Planet {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "planet of {} heights", self.globe.heights())
    }
}

impl Planet {
    fn take_seed(&mut self, seed: u64) {
        if self.options.seed.is_some() {
            return;
        }
        let world = self.globe.world();
        let world = World { key: world.key.map(|_| ModuleKey(seed)), ..world.clone() };
        self.globe = Globe::new(world, self.options.radius, self.globe.sea());
    }

    fn restart(&mut self) {
        self.wanted = None;
    }
}

impl Warn for Planet {
    fn take_warnings(&mut self) -> Vec<Warning> {
        std::mem::take(&mut self.warnings)
    }
}

impl Expand for Planet {
    fn expand(&mut self, rules: &dyn Rewriter) -> Result<()> {
        let divide = &Cells::new(rules);
        if let Some(world) = self.globe.world().begin_systems(divide)? {
            self.globe = Globe::new(world, self.options.radius, self.globe.sea());
        }
        (self.eye, self.clearance) = self.wanted.map_or((None, 0.0), |(eye, above)| (Some(eye), above));
        let PlanetOptions { closeness, levels, horizon, .. } = *self.options;
        let view = GlobeView { eye: self.eye, clearance: self.clearance, closeness, levels, horizon };
        self.globe.focus(&view, divide)
    }

    fn sketch(&mut self) {
        self.sketched = true;
    }
}

impl Show for Planet {
    fn show(&self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()> {
        let globe = &self.globe;
        let mesh = GlobeMesh::new(globe, self.options.error);
        for cover in self.options.covers.iter().chain(&self.options.ice) {
            cover.on.check("planet", globe.world())?;
        }
        let hidden = self.eye.filter(|_| self.options.horizon);
        scene.upright = scene.upright.or_else(|| Upright::new(self.eye?, self.options.axis.0));
        let tiles: Vec<_> = globe.tiles().collect();
        let owner = MemoryOwner::current();
        let made: Vec<_> = tiles
            .into_par_iter()
            .map(|(face, tile)| {
                let _charged = owner.enter();
                let pieces = mesh.write(face, tile, looks::begin(globe, tile), hidden);
                if pieces.is_empty() {
                    return Ok(None);
                }
                let place = tile.place;
                let of = format!("{name} {face}/{}/{}/{}", place.level, place.x, place.y);
                let looks = looks::of(&self.options, globe, (face, tile), &of)?;
                Ok(Some((of, pieces, looks)))
            })
            .collect::<Result<_>>()?;
        Stop::check_current()?;
        for (of, pieces, land) in made.into_iter().flatten() {
            let water = Material { name: format!("{} water", land.name), roughness: 0.3, ..land.clone() };
            let mut parts = Vec::new();
            for (mut part, material) in [(pieces.land, land), (pieces.water, water)] {
                if !part.triangles.is_empty() {
                    part.material = scene.material(&material);
                    parts.push(part);
                }
            }
            scene.meshes.push(Mesh { name: of.clone(), parts, ..Mesh::default() });
            scene.instances.push(Instance {
                mesh: scene.meshes.len() - 1,
                transform: DAffine3::from_translation(pieces.origin + self.options.position.0),
                name: of,
                feature: feature.map(str::to_owned),
                origin: None,
                placement: None,
                meaning: None,
            });
        }
        Ok(())
    }
}
