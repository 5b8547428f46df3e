//! The object: what scripts see of a terrain.

use std::sync::{Arc, OnceLock};

use super::river::River;
use super::{EditFile, GroundCover, Plants, RuleLayers, Water, build};
use crate::{Elevation, Network};
use burgeon_base::error::{Error, Result};
use burgeon_base::text::number;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_kit::{Color, ObjectParameter, Path, Vector, fields, methods, object};
use burgeon_kit::{Expand, Rewriter, Show, Warn};
use burgeon_rewriting::ModuleKey;
use burgeon_scene::Scene;
use burgeon_terrain::{Cells, Channel, DEEPEST, Drainage, Dry, Edit, Edits, Ground, GroundMap, View, World};
use glam::{DVec2, DVec3};

/// What `terrain { ... }` takes.
#[fields("terrain")]
pub struct TerrainOptions {
    /// The length (m) of its sides.
    #[default(1024.0)]
    pub size: f64,
    /// How often all of it is divided; left out, only what is focused on.
    pub levels: Option<u32>,
    /// What divides its cells: a rule table, a system, or a list of these by level.
    pub rules: RuleLayers,
    /// The symbol of the whole; the first by name, if it is left out.
    pub start: Option<String>,
    /// The height (m) of the whole.
    #[default(0.0)]
    pub height: f64,
    /// How much (m) the changes of a rule table are at first.
    #[default(100.0)]
    pub decay: f64,
    /// Whether the surface runs smoothly through the cells and through measured samples, or each cell keeps its own
    /// height, and the ground is straight from sample to sample.
    #[default(true)]
    pub smooth: bool,
    /// What heights (m) are changed to: pairs { from, to } with straight lines in between.
    pub remap: Vec<Vec<f64>>,
    /// How far (m) the triangles may be from the surface; a tenth of the smallest cell, if it is left out.
    pub error: Option<f64>,
    /// The middle of its square (m); its z is added to all heights.
    #[default(Vector(DVec3::ZERO))]
    pub position: Vector,
    /// Measured heights, which the ground has at each sample, and to which the rules add detail in between:
    /// elevation("N43E007.hgt").
    pub elevation: Option<Elevation>,
    /// Changes of the ground that were kept: edits("ground.json").
    pub edits: Option<EditFile>,
    /// Streets that lie on it: the ground is cut and filled, so that it meets the edges of their sidewalks, and slopes beside
    /// them.
    pub under: Option<Arc<Network>>,
    /// Whether it is shown; one that is not can still be asked, and streets can lie on it.
    #[default(true)]
    pub shown: bool,
    /// What lies on it, from the bottom to the top.
    pub covers: Vec<GroundCover>,
    /// The height (m) of an underside: then it has sides and is closed.
    pub base: Option<f64>,
    /// The colour of its sides.
    #[default(Color([0.16, 0.12, 0.09, 1.0]))]
    pub sides: Color,
    /// Its colour, where it has no covers.
    #[default(Color([0.30, 0.28, 0.22, 1.0]))]
    pub color: Color,
    /// Standing water: its level (m), or more of it.
    pub water: Option<Water>,
    /// What grows on it.
    pub plants: Vec<Plants>,
}

/// Ground made by dividing a square into quadrants again and again, expanded where it is looked at.
///
/// What a pass asks of it holds from the end of that pass on: until then it answers as it was.
#[object(
    "terrain",
    options = TerrainOptions,
    example = include_str!("../../scripts/terrain.lua"),
    shows,
    expands,
    begins_empty,
    begin = restart,
    seed = take_seed,
    warns
)]
pub struct Terrain {
    pub(super) options: Arc<TerrainOptions>,
    pub(super) ground: Ground,
    /// The ground without what passes change, which the next pass finds.
    plain: Ground,
    /// What the present pass has asked for: a place and what is seen from there.
    wanted: Option<(DVec2, View)>,
    /// The ways down on the ground as it is expanded, once a river has asked.
    drainage: OnceLock<Drainage>,
    /// The rivers that the present pass has let run.
    pub(super) rivers: Vec<River>,
    /// The changes of the ground that come from a file.
    kept: Arc<Edits>,
    /// Whether that file has been read: its world is known only once there is a seed.
    kept_read: bool,
    /// Whether there is room for the streets on it.
    has_room: bool,
    /// These, and what the present pass has changed.
    edits: Arc<Edits>,
    pub(super) key: ModuleKey,
    /// Whether the script is only checked.
    sketched: bool,
    /// Whether a pass has begun.
    begun: bool,
    warnings: Vec<Warning>,
}

#[methods("terrain")]
impl Terrain {
    /// Expands what `view` shows from the place at `x` (m) and `y` (m), and contracts everything else, when the pass ends;
    /// until then the ground answers as it was. The last focus of a pass counts. A view is the size (m) of cells, and rings
    /// around the place: how many cells across, and how often each is divided.
    pub fn focus(&mut self, x: f64, y: f64, view: View) -> Result<()> {
        // What cannot be is told where it is asked for.
        view.check(self.ground.world(), DVec2::new(x, y))?;
        let wanted = (DVec2::new(x, y), view);
        let earlier = self.wanted.as_ref().filter(|earlier| **earlier != wanted);
        self.warnings.extend(earlier.map(|(at, _)| lost_focus("terrain", &format!("({}, {})", at.x, at.y))));
        self.wanted = Some(wanted);
        Ok(())
    }

    /// Makes the ground within an outline level, when the pass ends: at `height` (m), or as it is in the middle. Over
    /// `margin` (m, 5 unless given) around it the ground changes less and less.
    pub fn flatten(&mut self, outline: Path, height: Option<f64>, margin: Option<f64>) -> Result<()> {
        let outline = flat(&outline.points);
        let middle = outline.iter().map(|at| DVec2::from(*at)).sum::<DVec2>() / outline.len().max(1) as f64;
        let height = match height {
            Some(height) => height - self.options.position.0.z,
            None => self.ground.height(middle).ok_or_else(|| self.nothing(middle))?,
        };
        self.change(Edit::Flatten { outline, height, margin: margin.unwrap_or(5.0) })
    }

    /// Gives the ground along a path the heights of the path, over `width` (m), when the pass ends; beside it the
    /// ground changes less and less over `margin` (m, `width` unless given).
    pub fn cut(&mut self, path: Path, width: f64, margin: Option<f64>) -> Result<()> {
        let lift = self.options.position.0.z;
        let path = path.points.iter().map(|at| [at.x, at.y, at.z - lift]).collect();
        self.change(Edit::Cut { path, width, margin: margin.unwrap_or(width) })
    }

    /// Lowers the ground along a path of `width` (m) when the pass ends, by `depth` (m) in the middle; raises it, if
    /// the depth is below 0.
    pub fn dig(&mut self, path: Path, width: f64, depth: f64) -> Result<()> {
        self.change(Edit::Dig { path: flat(&path.points), width, depth })
    }

    /// Lets a river of `width` (m) run downhill from a place, to the standing water, the rim or an earlier river; its
    /// bed is dug when the pass ends, and nothing grows in it. It raises no ground. A place under water starts no river,
    /// and a bed deeper than its width and than 10 m gives a warning.
    pub fn river(&mut self, source: Vector, width: f64) -> Result<()> {
        if !(width > 0.0 && width <= self.options.size) {
            return Err(Error::argument(format!("terrain:river: width is {} m", number(width)))
                .help("give metres above 0"));
        }
        let at = source.0.truncate();
        let height = self.ground.height(at).ok_or_else(|| self.nothing(at))?;
        let sunk = self.options.water.as_ref().map(|water| water.level).filter(|level| height <= *level);
        self.drainage()?;
        let drainage =
            self.drainage.get_mut().ok_or_else(|| Error::internal("terrain: there are no ways down"))?;
        let way = match (drainage.river(at), sunk) {
            (Ok(way), _) => way,
            // Water runs there already.
            (Err(Dry::River), None) => return Ok(()),
            (Err(_), sunk) => {
                self.warnings.push(dry(at, sunk.map(|level| level - height)));
                return Ok(());
            }
        };
        let channel = Channel::new(&way, width, |at| self.ground.height(at));
        let (place, cut) = channel.deepest;
        if cut > width.max(DEEP) {
            self.warnings.push(deep(place, cut));
        }
        let depth = width * SHALLOW;
        let path = channel.path.iter().map(|at| [at.x, at.y, at.z - depth]).collect();
        self.rivers.push(River { way: channel.path, width });
        self.change(Edit::Carve { path, width, margin: width * 1.5 })
    }

    /// Height (m) of the ground at a place; fails where nothing is expanded.
    pub fn height(&self, place: Vector) -> Result<f64> {
        let at = place.0.truncate();
        Ok(self.known(at, self.ground.height(at), 0.0)? + self.options.position.0.z)
    }

    /// The way up from the ground at a place, as a vector of length 1.
    pub fn normal(&self, place: Vector) -> Result<DVec3> {
        let at = place.0.truncate();
        self.known(at, self.ground.way_up(at), DVec3::Z)
    }

    /// How steep (degrees) the ground is at a place.
    pub fn slope(&self, place: Vector) -> Result<f64> {
        let at = place.0.truncate();
        let up = self.known(at, self.ground.way_up(at), DVec3::Z)?;
        Ok(up.z.clamp(-1.0, 1.0).acos().to_degrees())
    }

    /// Whether a river can begin at a place: not in standing water, at the shore or the rim, or in an earlier river.
    pub fn is_source(&self, place: Vector) -> Result<bool> {
        let at = place.0.truncate();
        let found = self.ground.height(at).map(|_| self.drainage()).transpose()?;
        self.known(at, found.map(|drainage| drainage.is_source(at)), true)
    }

    /// Depth (m) of the deepest cut that the bed of a river of `width` (m) from a place needs; nil if no river begins there.
    pub fn river_cut(&self, place: Vector, width: f64) -> Result<Option<f64>> {
        let at = place.0.truncate();
        let drainage = self.ground.height(at).map(|_| self.drainage()).transpose()?;
        let course = self.known(at, drainage.map(|drainage| drainage.course(at)), Err(Dry::Outlet))?;
        Ok(course.ok().map(|path| Channel::new(&path, width, |at| self.ground.height(at)).deepest.1))
    }

    /// The symbol of the cell at a place.
    pub fn symbol(&self, place: Vector) -> Result<String> {
        let at = place.0.truncate();
        self.known(at, self.ground.symbol(at), "").map(str::to_owned)
    }

    /// How many heights are expanded at present.
    pub fn heights(&self) -> f64 {
        #[allow(clippy::cast_precision_loss, reason = "counts below 2^53")]
        let count = self.ground.heights() as f64;
        count
    }
}

impl Terrain {
    /// A terrain of which nothing is expanded.
    pub fn new(options: TerrainOptions) -> Result<Self> {
        let world = build::world(&options)?;
        if let Some(levels) = options.levels {
            View::whole(&world, levels).check(&world, options.position.0.truncate())?;
        }
        let world = Arc::new(world);
        Ok(Self {
            warnings: options.rules.warnings("terrain"),
            plain: Ground::new(Arc::clone(&world)),
            ground: Ground::new(world),
            options: Arc::new(options),
            wanted: None,
            drainage: OnceLock::new(),
            rivers: Vec::new(),
            kept: Arc::default(),
            edits: Arc::default(),
            kept_read: false,
            has_room: false,
            key: ModuleKey::default(),
            sketched: false,
            begun: false,
        })
    }

    /// The text of a file that keeps the changes of its ground.
    pub fn edits_json(&self) -> String {
        self.ground.edits().to_json(self.ground.world())
    }

    /// The heights (m) of all that is expanded, as a map.
    pub fn map(&self) -> Result<GroundMap> {
        let mut map = self.ground.map()?;
        map.heights.iter_mut().for_each(|height| *height += self.options.position.0.z);
        Ok(map)
    }

    /// The ground that is expanded.
    pub fn ground(&self) -> &Ground {
        &self.ground
    }

    /// What was `found` at a place (m); where nothing is expanded, an error, or `even` while the script is only checked.
    fn known<T>(&self, at: DVec2, found: Option<T>, even: T) -> Result<T> {
        match found {
            None if self.sketched => Ok(even),
            found => found.ok_or_else(|| self.nothing(at)),
        }
    }

    fn nothing(&self, at: DVec2) -> Error {
        let error = Error::script(format!("terrain: nothing is expanded at ({}, {})", at.x, at.y));
        if self.ground.heights() == 0 {
            return error.help(
                "give it levels, or focus on a place: this:focus(x, y, view) in an interpretation rule",
            );
        }
        let world = self.ground.world();
        let (low, high) = (world.corner, world.corner + world.size);
        error.help(format!(
            "it reaches from ({}, {}) to ({}, {}) m; what is not focused on is contracted",
            low.x, low.y, high.x, high.y
        ))
    }

    /// What to tell where the cells are too large for the samples of measured ground.
    fn coarse(&self) -> Option<Warning> {
        let (world, elevation) = (self.ground.world(), self.options.elevation.as_ref()?);
        let finest = self.ground.finest();
        if self.ground.heights() == 0 || world.shows_samples(finest) {
            return None;
        }
        let (cell, step) = (world.cell(finest), elevation.step());
        let more = (finest..=DEEPEST).find(|level| world.shows_samples(*level))? - finest;
        let help = match (&self.wanted, self.options.levels) {
            (None, Some(levels)) => format!("write levels = {} to show all of them", levels + more),
            _ => format!("divide the nearest cells of the view {more} times more to show all of them"),
        };
        let text = format!(
            "terrain: cells of {} m cannot show samples that are {} m apart: only height() keeps to each of them",
            rounded(cell),
            rounded(step)
        );
        Some(Warning::new(WarningKind::Doubtful, text).help(help))
    }

    fn drainage(&self) -> Result<&Drainage> {
        if let Some(known) = self.drainage.get() {
            return Ok(known);
        }
        let water = self.options.water.as_ref().map(|water| water.level);
        let map = self.ground.map()?;
        Ok(self.drainage.get_or_init(|| Drainage::new(&map, water)))
    }

    fn change(&mut self, edit: Edit) -> Result<()> {
        Arc::make_mut(&mut self.edits).add(self.ground.world(), edit)
    }

    /// The height (m) of its standing water.
    pub(crate) fn water_level(&self) -> Option<f64> {
        self.options.water.as_ref().map(|water| water.level + self.options.position.0.z)
    }

    /// Makes room for the streets on it, once.
    fn make_room(&mut self, view: &View) -> Result<()> {
        let Some(streets) = self.options.under.as_ref().filter(|_| !self.has_room) else { return Ok(()) };
        let world = self.ground.world();
        let cell = view.smallest(world)?;
        let lift = self.options.position.0.z;
        for edit in streets.bed(cell, self.options.error.unwrap_or(cell / 10.0))? {
            Arc::make_mut(&mut self.kept)
                .add(world, edit.raised(-lift))
                .map_err(|error| error.about("terrain: under"))?;
        }
        self.warnings.extend(streets.steep()?);
        (self.edits, self.has_room) = (Arc::clone(&self.kept), true);
        Ok(())
    }

    /// Reads the changes that were kept, once.
    fn read_edits(&mut self) -> Result<()> {
        if let (Some(file), false) = (&self.options.edits, self.kept_read) {
            self.kept = Arc::new(Edits::from_json(&file.text, &file.name, self.ground.world())?);
            // Before the first pass nothing else has changed the ground.
            self.edits = Arc::clone(&self.kept);
            self.kept_read = true;
        }
        Ok(())
    }
}

/// What to tell of a river that ends where it begins, at a place (m) that may lie some metres under water.
fn dry(at: DVec2, under: Option<f64>) -> Warning {
    let place = format!("({:.1}, {:.1})", at.x, at.y);
    let (text, help) = match under {
        Some(under) => (
            format!("the source {place} lies {under:.1} m under water"),
            "give a place above the water: this:height({ x, y }) tells how high the ground is",
        ),
        None => (format!("the source {place} lies at the rim or at the shore"), "give a place farther up"),
    };
    Warning::new(WarningKind::DrawsNothing, format!("terrain:river: {text}, so there is no river")).help(help)
}

/// What to tell of a focus of a `kind` of object that takes the place of an earlier one in the same pass.
pub(crate) fn lost_focus(kind: &str, earlier: &str) -> Warning {
    let text = format!("{kind}:focus: this takes the place of the focus on {earlier} in the same pass");
    Warning::new(WarningKind::NoEffect, text).help("the last focus of a pass counts: focus once")
}

/// A length (m) rounded to three digits, for messages.
pub(crate) fn rounded(length: f64) -> f64 {
    let unit = 10f64.powf(2.0 - length.abs().max(1e-9).log10().floor());
    (length * unit).round() / unit
}

/// Warns of a river that has to cut the ground deeply (m) at a place (m).
fn deep(at: DVec2, cut: f64) -> Warning {
    let text = format!(
        "terrain:river: at ({:.1}, {:.1}) its bed is cut {cut:.1} m deep into the ground",
        at.x, at.y
    );
    let help = "it leaves a hollow there: begin it farther down, fill the hollow with water = { level = ... }, or lower \
                the ground with this:cut or this:dig";
    Warning::new(WarningKind::Doubtful, text).help(help)
}

/// Depth (m) up to which a bed of any width may be cut without a warning.
const DEEP: f64 = 10.0;

/// How deep a river's bed is, as a multiple of its width.
const SHALLOW: f64 = 0.12;

/// A terrain of a script, to be asked by others.
impl ObjectParameter for Terrain {
    const LUAU: &str = "Terrain";
    const EXPECTED: &str = "a terrain that was derived: land:derive().objects[1]";
}

impl std::fmt::Debug for Terrain {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "terrain of {} heights", self.ground.heights())
    }
}

fn flat(points: &[DVec3]) -> Vec<[f64; 2]> {
    points.iter().map(|at| at.truncate().to_array()).collect()
}

impl Terrain {
    fn take_seed(&mut self, seed: u64) {
        self.key = ModuleKey(seed);
        let world = self.ground.world();
        let world = World { key: world.key.map(|_| ModuleKey(seed)), ..world.clone() };
        self.plain = Ground::new(Arc::new(world));
        self.ground = self.plain.clone();
    }

    fn restart(&mut self) {
        self.ground = self.plain.clone();
        self.begun = true;
        self.wanted = None;
        self.drainage = OnceLock::new();
        self.rivers.clear();
        self.edits = Arc::clone(&self.kept);
    }
}

impl Warn for Terrain {
    fn take_warnings(&mut self) -> Vec<Warning> {
        std::mem::take(&mut self.warnings)
    }
}

impl Expand for Terrain {
    fn expand(&mut self, rules: &dyn Rewriter) -> Result<()> {
        let divide = &Cells::new(rules);
        let (eye, view) = match (&self.wanted, self.options.levels) {
            (Some((eye, view)), _) => (*eye, view.clone()),
            (None, Some(levels)) => {
                (self.options.position.0.truncate(), View::whole(self.ground.world(), levels))
            }
            (None, None) => return Ok(()),
        };
        if let Some(world) = self.ground.world().begun(divide)? {
            self.plain = Ground::new(Arc::new(world));
            self.ground = self.plain.clone();
        }
        self.read_edits()?;
        self.make_room(&view)?;
        self.plain.edit(&self.kept);
        self.plain.focus(eye, &view, divide)?;
        self.ground = self.plain.clone();
        if self.edits != self.kept {
            self.ground.edit(&self.edits);
            self.ground.focus(eye, &view, divide)?;
        }
        // What is shown before the first pass may be focused on in it.
        let coarse = if self.begun { self.coarse() } else { None };
        self.warnings.extend(coarse);
        Ok(())
    }

    fn sketch(&mut self) {
        self.sketched = true;
    }
}

impl Terrain {
    /// Whether it shows itself.
    pub(crate) fn is_shown(&self) -> bool {
        self.options.shown
    }
}

impl Show for Terrain {
    fn show(&self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()> {
        if self.options.shown { self.draw(scene, name, feature) } else { Ok(()) }
    }
}
