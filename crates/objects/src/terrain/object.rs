//! The terrain object of scripts.

use std::sync::{Arc, OnceLock};

use super::build;
use super::cells::Cells;
use super::options::TerrainOptions;
use super::river::River;
use super::streets::StreetsOnGround;
use super::view::ViewArgument;
use burgeon_base::ModuleKey;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::number;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_kit::{Expand, ObjectParameter, Rewriter, Show, Vector, Warn, methods, object};
use burgeon_spatial::Path;
use burgeon_terrain::{Channel, DEEPEST, Drainage, Dry, Edit, Edits, Ground, GroundMap, View, World};
use glam::{DVec2, DVec3};

/// Ground made by repeatedly dividing a square into quadrants, expanded in the view.
///
/// Calls during a pass take effect at the end of the pass. Until then, the terrain returns its earlier values.
#[object(
    "terrain",
    can(Show, Expand, Warn),
    options = TerrainOptions,
    example = include_str!("../../scripts/terrain.lua"),
    renames("shown", "1.1", "visible"),
    begins_empty,
    begin = restart,
    seed = take_seed,
)]
pub struct Terrain {
    pub(super) options: Arc<TerrainOptions>,
    pub(super) ground: Ground,
    /// Ground without the changes of passes, from which the next pass starts.
    plain: Ground,
    /// Position and view requested in the current pass.
    wanted: Option<(DVec2, View)>,
    /// Drainage of the expanded ground, computed on first use.
    drainage: OnceLock<Drainage>,
    /// Rivers of the current pass.
    pub(super) rivers: Vec<River>,
    /// Edits from a file, and for streets.
    kept: Arc<Edits>,
    /// Set once the file is read. The world is known only after the seed is set.
    kept_read: bool,
    /// Set once the ground is adapted to the streets.
    has_room: bool,
    /// Edits of `kept`, followed by the edits of the current pass.
    edits: Arc<Edits>,
    pub(super) key: ModuleKey,
    /// Set if the script is only checked.
    sketched: bool,
    /// Set once a pass has begun.
    begun: bool,
    warnings: Vec<Warning>,
}

#[methods("terrain")]
impl Terrain {
    /// Expands what `view` shows from the position at `x` (m) and `y` (m), and contracts everything else, when the pass
    /// ends. Until then, the ground is unchanged. Only the last call in a pass counts. A view is the size (m) of cells,
    /// and rings around the position: the width of each ring in cells, and the number of their divisions.
    pub fn focus(&mut self, x: f64, y: f64, view: ViewArgument) -> Result<()> {
        let ViewArgument(view) = view;
        // Checks the view here, so that an error refers to this call.
        view.check(self.ground.world(), DVec2::new(x, y))?;
        let wanted = (DVec2::new(x, y), view);
        let earlier = self.wanted.as_ref().filter(|earlier| **earlier != wanted);
        self.warnings.extend(earlier.map(|(at, _)| lost_focus("terrain", &format!("({}, {})", at.x, at.y))));
        self.wanted = Some(wanted);
        Ok(())
    }

    /// Levels the ground within an outline when the pass ends: at `height` (m), or at the height of the middle. The
    /// change fades out over `margin` (m, 5 unless given) around the outline.
    pub fn flatten(&mut self, outline: Path, height: Option<f64>, margin: Option<f64>) -> Result<()> {
        let outline = flat_points(&outline.points);
        let middle = outline.iter().map(|at| DVec2::from(*at)).sum::<DVec2>() / outline.len().max(1) as f64;
        let height = match height {
            Some(height) => height - self.options.position.0.z,
            None => self.ground.height(middle).ok_or_else(|| self.nothing(middle))?,
        };
        self.change(Edit::Flatten { outline, height, margin: margin.unwrap_or(5.0) })
    }

    /// Sets the ground along a path to the heights of the path, over `width` (m), when the pass ends. The change fades
    /// out on both sides over `margin` (m, `width` unless given).
    pub fn cut(&mut self, path: Path, width: f64, margin: Option<f64>) -> Result<()> {
        let lift = self.options.position.0.z;
        let path = path.points.iter().map(|at| [at.x, at.y, at.z - lift]).collect();
        self.change(Edit::Cut { path, width, margin: margin.unwrap_or(width) })
    }

    /// Lowers the ground along a path of `width` (m) when the pass ends, by `depth` (m) in the middle. A negative depth
    /// raises the ground.
    pub fn dig(&mut self, path: Path, width: f64, depth: f64) -> Result<()> {
        self.change(Edit::Dig { path: flat_points(&path.points), width, depth })
    }

    /// Adds a river of `width` (m) that runs downhill from a position, to the standing water, the edge of the map or an
    /// earlier river. Its bed is dug when the pass ends, and nothing grows in it. A river never raises the ground. A
    /// source under water gives no river, but a warning, and so does a bed deeper than its width and than 10 m.
    pub fn river(&mut self, source: Vector, width: f64) -> Result<()> {
        if !(width > 0.0 && width <= self.options.size) {
            return Err(Error::argument(format!("terrain:river: width is {} m", number(width)))
                .help("give metres above 0"));
        }
        let at = source.0.truncate();
        let height = self.ground.height(at).ok_or_else(|| self.nothing(at))?;
        let sunk = self.options.water.as_ref().map(|water| water.level).filter(|level| height <= *level);
        self.drainage()?;
        let drainage = self
            .drainage
            .get_mut()
            .ok_or_else(|| Error::internal("terrain: the drainage is not available"))?;
        let way = match (drainage.river(at), sunk) {
            (Ok(way), _) => way,
            // A river already runs there.
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

    /// Returns the height (m) of the ground at a position. Fails if the position is not expanded.
    pub fn height(&self, place: Vector) -> Result<f64> {
        let at = place.0.truncate();
        Ok(self.require_expanded(at, self.ground.height(at), 0.0)? + self.options.position.0.z)
    }

    /// Returns the normal of the ground at a position, as a vector of length 1.
    pub fn normal(&self, place: Vector) -> Result<DVec3> {
        let at = place.0.truncate();
        self.require_expanded(at, self.ground.way_up(at), DVec3::Z)
    }

    /// Returns the slope (degrees) of the ground at a position.
    pub fn slope(&self, place: Vector) -> Result<f64> {
        let at = place.0.truncate();
        let up = self.require_expanded(at, self.ground.way_up(at), DVec3::Z)?;
        Ok(up.z.clamp(-1.0, 1.0).acos().to_degrees())
    }

    /// Returns true if a river can start at a position: not in standing water, at the shore, at the edge of the map, or
    /// in an earlier river.
    pub fn is_source(&self, place: Vector) -> Result<bool> {
        let at = place.0.truncate();
        let found = self.ground.height(at).map(|_| self.drainage()).transpose()?;
        self.require_expanded(at, found.map(|drainage| drainage.is_source(at)), true)
    }

    /// Returns the depth (m) of the deepest cut for the bed of a river of `width` (m) from a position, or nil if no
    /// river can start there.
    pub fn river_cut(&self, place: Vector, width: f64) -> Result<Option<f64>> {
        let at = place.0.truncate();
        let drainage = self.ground.height(at).map(|_| self.drainage()).transpose()?;
        let course =
            self.require_expanded(at, drainage.map(|drainage| drainage.course(at)), Err(Dry::Outlet))?;
        Ok(course.ok().map(|path| Channel::new(&path, width, |at| self.ground.height(at)).deepest.1))
    }

    /// Returns the symbol of the cell at a position.
    pub fn symbol(&self, place: Vector) -> Result<String> {
        let at = place.0.truncate();
        self.require_expanded(at, self.ground.symbol(at), "").map(str::to_owned)
    }

    /// Returns the number of heights that are currently expanded.
    pub fn heights(&self) -> f64 {
        #[allow(clippy::cast_precision_loss, reason = "counts below 2^53")]
        let count = self.ground.heights() as f64;
        count
    }
}

impl Terrain {
    /// Creates a terrain of which no tile is expanded.
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

    /// Returns the terrain edits as the text of a file.
    pub fn edits_json(&self) -> String {
        self.ground.edits().to_json(self.ground.world())
    }

    /// Returns the heights (m) of the whole expanded ground, as a map.
    pub fn map(&self) -> Result<GroundMap> {
        let mut map = self.ground.map()?;
        map.heights.iter_mut().for_each(|height| *height += self.options.position.0.z);
        Ok(map)
    }

    /// Returns the ground as currently expanded.
    pub fn ground(&self) -> &Ground {
        &self.ground
    }

    /// Returns `found`, a value at a position (m). If it is `None`, returns `even` while the script is only checked,
    /// and otherwise an error.
    fn require_expanded<T>(&self, at: DVec2, found: Option<T>, even: T) -> Result<T> {
        match found {
            None if self.sketched => Ok(even),
            found => found.ok_or_else(|| self.nothing(at)),
        }
    }

    fn nothing(&self, at: DVec2) -> Error {
        let error = Error::script(format!("terrain: nothing is expanded at ({}, {})", at.x, at.y));
        if self.ground.heights() == 0 {
            return error.help(
                "set levels, or focus on a position: this:focus(x, y, view) in an interpretation rule",
            );
        }
        let world = self.ground.world();
        let (low, high) = (world.corner, world.corner + world.size);
        error.help(format!(
            "it extends from ({}, {}) to ({}, {}) m; areas outside the focus are contracted",
            low.x, low.y, high.x, high.y
        ))
    }

    /// Returns the warning that the cells are too large for the samples of measured ground.
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
            _ => format!("divide the nearest cells of the view {more} more times to show all of them"),
        };
        let text = format!(
            "terrain: cells of {} m cannot show samples that are {} m apart: only height() returns each of them",
            round_length(cell),
            round_length(step)
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

    /// Returns the height (m) of the standing water.
    pub(crate) fn water_level(&self) -> Option<f64> {
        self.options.water.as_ref().map(|water| water.level + self.options.position.0.z)
    }

    /// Adapts the ground to the streets on it, once.
    fn make_room(&mut self, view: &View) -> Result<()> {
        let Some(StreetsOnGround(streets)) = self.options.under.as_ref().filter(|_| !self.has_room) else {
            return Ok(());
        };
        let world = self.ground.world();
        let cell = view.smallest(world)?;
        let lift = self.options.position.0.z;
        for edit in streets.bed(cell, self.options.error.unwrap_or(cell / 10.0))? {
            Arc::make_mut(&mut self.kept)
                .add(world, edit.raise(-lift))
                .map_err(|error| error.about("terrain: under"))?;
        }
        self.warnings.extend(streets.steep_warning()?);
        self.restore_edits();
        self.has_room = true;
        Ok(())
    }

    /// Reads the stored edits, once.
    fn read_edits(&mut self) -> Result<()> {
        if let (Some(file), false) = (&self.options.edits, self.kept_read) {
            self.kept = Arc::new(Edits::from_json(&file.text, &file.name, self.ground.world())?);
            // Before the first pass, there are no other edits.
            self.restore_edits();
            self.kept_read = true;
        }
        Ok(())
    }
}

/// Creates the warning about a river that ends at its source, a position (m) that may be under water by a depth (m).
fn dry(at: DVec2, under: Option<f64>) -> Warning {
    let place = format!("({:.1}, {:.1})", at.x, at.y);
    let (text, help) = match under {
        Some(under) => (
            format!("the source {place} is {under:.1} m under water"),
            "use a position above the water: this:height({ x, y }) returns the height of the ground",
        ),
        None => (
            format!("the source {place} is at the edge of the map or at the shore"),
            "use a position farther up",
        ),
    };
    Warning::new(WarningKind::DrawsNothing, format!("terrain:river: {text}, so no river is created"))
        .help(help)
}

/// Creates the warning about a focus that replaces an earlier focus in the same pass. `kind` is the object type.
pub(crate) fn lost_focus(kind: &str, earlier: &str) -> Warning {
    let text = format!("{kind}:focus: this replaces the focus on {earlier} in the same pass");
    Warning::new(WarningKind::NoEffect, text).help("call focus once per pass: only the last call counts")
}

/// Rounds a length (m) to three significant digits, for messages.
pub(crate) fn round_length(length: f64) -> f64 {
    let unit = 10f64.powf(2.0 - length.abs().max(1e-9).log10().floor());
    (length * unit).round() / unit
}

/// Creates the warning about a river that cuts deeply (m) into the ground at a position (m).
fn deep(at: DVec2, cut: f64) -> Warning {
    let text = format!(
        "terrain:river: at ({:.1}, {:.1}) its bed is cut {cut:.1} m deep into the ground",
        at.x, at.y
    );
    let help = "the source is in a hollow: start farther down, fill the hollow with water = { level = ... }, or lower the ground with this:cut or this:dig";
    Warning::new(WarningKind::Doubtful, text).help(help)
}

/// Depth (m) up to which a bed of any width may be cut without a warning.
const DEEP: f64 = 10.0;

/// Depth of a river's bed, as a multiple of its width.
const SHALLOW: f64 = 0.12;

/// Allows other objects to take a script's terrain as a parameter.
impl ObjectParameter for Terrain {
    const LUAU: &str = "Terrain";
    const EXPECTED: &str = "a derived terrain: land:derive().objects[1]";
}

impl std::fmt::Debug for Terrain {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "terrain of {} heights", self.ground.heights())
    }
}

fn flat_points(points: &[DVec3]) -> Vec<[f64; 2]> {
    points.iter().map(|at| at.truncate().to_array()).collect()
}

impl Terrain {
    fn take_seed(&mut self, seed: u64) {
        self.key = ModuleKey(seed);
        let world = self.ground.world();
        let world = World { key: world.key.map(|_| ModuleKey(seed)), ..world.clone() };
        self.set_world(world);
    }

    fn restart(&mut self) {
        self.restore_ground();
        self.begun = true;
        self.wanted = None;
        self.drainage = OnceLock::new();
        self.rivers.clear();
        self.restore_edits();
    }

    /// Replaces the edits by those of all passes.
    fn restore_edits(&mut self) {
        self.edits = Arc::clone(&self.kept);
    }

    /// Replaces the ground of all passes, and the present one.
    fn set_world(&mut self, world: World) {
        self.plain = Ground::new(Arc::new(world));
        self.restore_ground();
    }

    /// Replaces the ground by that of all passes.
    fn restore_ground(&mut self) {
        self.ground = self.plain.clone();
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
        if let Some(world) = self.ground.world().begin_systems(divide)? {
            self.set_world(world);
        }
        self.read_edits()?;
        self.make_room(&view)?;
        self.plain.edit(&self.kept);
        self.plain.focus(eye, &view, divide)?;
        self.restore_ground();
        if self.edits != self.kept {
            self.ground.edit(&self.edits);
            self.ground.focus(eye, &view, divide)?;
        }
        // A terrain that is shown before the first pass may still get a focus in it.
        let coarse = if self.begun { self.coarse() } else { None };
        self.warnings.extend(coarse);
        Ok(())
    }

    fn sketch(&mut self) {
        self.sketched = true;
    }
}

impl Terrain {
    /// Returns true if the terrain is visible.
    pub(crate) fn is_visible(&self) -> bool {
        self.options.visible
    }
}
