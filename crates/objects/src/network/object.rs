//! The network object: its fields, and its read and write methods.

use std::sync::{Arc, OnceLock};

use glam::DVec2;
use rustc_hash::FxHashMap;

use super::answers;
use super::areas::NetworkAreas;
use super::cache::AnswerCache;
use super::existing::{self, ExistingLines};
use super::kinds::StreetOptions;
use super::land::VergeRecords;
use super::lots::{BlockRecords, LotRecords, LotSettings};
use super::proposals::ProposalTally;
use super::sites::{SiteRecords, SiteSettings};
use super::streets::{JunctionRecords, StreetRecords};
use super::walk::NetworkWalk;
use crate::Terrain;
use burgeon_base::error::{Error, Result};
use burgeon_base::warning::Warning;
use burgeon_geometry::Polygon;
use burgeon_kit::{Color, HasLayers, Show, TableOf, Value, Vector, Warn, fields, methods, object};
use burgeon_spatial::PolygonArgument;
use burgeon_streets::{
    Constraints, ExistingLoss, Fate, JunctionId, Obstacles, StreetAttributes, StreetFit, StreetGrowth,
    StreetKind, StreetNetwork, SurfaceOptions,
};

/// Fields of `network(...)`.
#[fields("network")]
pub struct NetworkOptions {
    /// Start positions of streets (m): junctions 1, 2, 3 and so on. If omitted, the origin; with existing streets, the
    /// origin only if no obstacle is there.
    pub starts: Option<Vec<Vector>>,
    /// Street types, by depth from 0. The last type also applies to greater depths.
    #[default([20.0, 14.0, 11.0].map(StreetOptions::of_width).to_vec())]
    pub streets: Vec<StreetOptions>,
    /// Snap distance (m): the end of a street joins a junction or another street within this distance.
    #[default(25.0)]
    pub snap: f64,
    /// Minimum angle (degrees) between two streets at a junction.
    #[default(45.0)]
    pub min_angle: f64,
    /// Minimum length (m) of a street between two junctions.
    #[default(12.0)]
    pub min_length: f64,
    /// Minimum distance (m) between streets that do not meet.
    #[default(6.0)]
    pub clearance: f64,
    /// Radius (m) of the corners of blocks.
    #[default(4.0)]
    pub corner: f64,
    /// Maximum turn (degrees) to avoid an obstacle.
    #[default(40.0)]
    pub bend: f64,
    /// Maximum length (m) of a bridge over water.
    #[default(0.0)]
    pub bridge: f64,
    /// Areas that no street crosses: polygons.
    #[default(Vec::new())]
    pub obstacles: Vec<PolygonArgument>,
    /// Areas that only bridges cross: polygons.
    #[default(Vec::new())]
    pub water: Vec<PolygonArgument>,
    /// Area that streets stay inside. If omitted, streets are not limited.
    pub limit: Option<PolygonArgument>,
    /// Shorten streets before an obstacle instead of refusing them.
    #[default(true)]
    pub shorten: bool,
    /// Existing streets, which stay unchanged regardless of the constraints: a list of { lines = ..., depth = ...,
    /// width = ..., lanes = ..., level = ... }.
    #[default(Vec::new())]
    pub existing: Vec<ExistingLines>,
    /// Maximum number of street segments.
    #[default(400_000)]
    pub most: u32,
    /// Terrain under the streets, which must already be derived.
    pub on: Option<Arc<Terrain>>,
    /// Maximum slope (%) of streets on the terrain. To keep it, streets cut into the ground or rise above it.
    #[default(10.0)]
    pub max_slope: f64,
    /// Height (m) of the water under bridges. If omitted, the terrain's water level.
    pub water_level: Option<f64>,
    /// Height (m) of kerbs.
    #[default(0.14)]
    pub kerb: f64,
    /// Radius (m) of turning circles at dead ends; 0 for none.
    #[default(0.0)]
    pub turning: f64,
    /// Square dead ends without a turning circle, as at the edge of the map, instead of round ones.
    #[default(false)]
    pub square_ends: bool,
    /// Paint lines and crossings on the streets.
    #[default(true)]
    pub markings: bool,
    /// Colour of carriageways.
    #[default(Color([0.095, 0.098, 0.105, 1.0]))]
    pub asphalt: Color,
    /// Colour of sidewalks.
    #[default(Color([0.45, 0.44, 0.42, 1.0]))]
    pub paving: Color,
    /// Colour of the blocks between the streets. If omitted, blocks are not drawn.
    pub ground: Option<Color>,
}

/// A street network, grown by interpretation rules.
///
/// A proposed street is built, shortened, bent, joined to a street or junction near its end, or refused. In the next
/// step, rules read the outcome. Streets never cross without a junction, and keep their minimum distance. Streets that
/// are built remain in all later steps.
#[object(
    "network",
    can(Show, HasLayers, Warn),
    options = NetworkOptions,
    example = include_str!("../../scripts/network.lua"),
    begin = restart,
    push = open_branch,
    pop = close_branch,
    end = finish,
)]
pub struct Network {
    pub(super) options: NetworkOptions,
    /// Street types, by depth.
    pub(super) kinds: Vec<StreetKind>,
    pub(super) network: StreetNetwork,
    /// Areas that bridges may cross.
    pub(super) water: Arc<[Polygon]>,
    /// Heights of the streets, with the version of the network for which they were computed.
    pub(super) fit: OnceLock<(u64, Arc<StreetFit>)>,
    /// Outcomes of the streets proposed in the last pass, by junction and heading.
    pub(super) growths: FxHashMap<(u32, u64), StreetGrowth>,
    pub(super) walk: NetworkWalk,
    /// Missing parts of existing streets.
    pub(super) omitted: Vec<ExistingLoss>,
    /// Cached results about blocks and lots.
    pub(super) answers: AnswerCache,
    pub(super) warnings: Vec<Warning>,
    /// Outcomes of all proposed streets.
    pub(super) proposals: ProposalTally,
    /// Set once a warning has reported refused streets.
    pub(super) has_warned_of_refusals: bool,
    /// Set once a warning has reported streets hidden by the ground.
    pub(super) has_warned_of_hiding: bool,
}

#[methods("network")]
impl Network {
    /// Proposes a street from a junction: its `heading` (degrees from east, counter-clockwise), its `length` (m) and
    /// its depth, the number of times that its path has branched.
    pub fn grow(&mut self, junction: u32, heading: f64, length: f64, depth: u32) -> Result<()> {
        let (from, to) = self.proposed("grow", junction, heading, length)?;
        let growth = self.network.grow(from, to, self.attributes(depth))?;
        self.proposals.count(growth.fate);
        self.growths.insert((junction, heading.to_bits()), growth);
        Ok(())
    }

    /// Proposes a street from a junction to a position (m). The street may join other streets on its way. A warning
    /// reports a street that is refused, or that ends before an obstacle.
    pub fn lead(&mut self, junction: u32, to: Vector, depth: u32) -> Result<()> {
        let from = self.known(junction)?;
        let to = to.0.truncate();
        let growth = self.network.grow(from, to, self.attributes(depth))?;
        let ways = [self.network.at(from), self.network.at(growth.end), to];
        self.warnings.extend(answers::misled(growth.fate, ways));
        Ok(())
    }

    /// Walks ahead by a street of a `length` (m), and continues from its end.
    ///
    /// A path begins at the first start, towards the east. A branch begins at the current position, and its depth is
    /// one more. A refused street ends its path.
    pub fn walk(&mut self, length: f64) -> Result<()> {
        if length <= 0.0 {
            return Err(Error::argument(format!("network:walk: a street of {length} m cannot be"))
                .help("give a length above 0"));
        }
        if self.network.junctions().is_empty() {
            return Err(Error::argument("network:walk: the network has no junction to walk from")
                .help("give it starts, such as network { starts = { { 0, 0 } } }"));
        }
        let attributes = self.attributes(self.walk.depth());
        if let Some((junction, heading, growth)) = self.walk.ahead(&mut self.network, length, attributes)? {
            self.growths.insert((junction + 1, heading.to_bits()), growth);
        }
        Ok(())
    }

    /// Turns the path by `angle` (degrees), counter-clockwise.
    pub fn turn(&mut self, angle: f64) {
        self.walk.turn(angle);
    }

    /// Continues the path from a junction with a `heading` (degrees from east, counter-clockwise).
    pub fn stand(&mut self, junction: u32, heading: f64) -> Result<()> {
        let at = self.known(junction)?;
        self.walk.stand(at, heading);
        Ok(())
    }

    /// Joins dead ends to streets within `radius` (m, 150 unless given), if the path along the streets is `detour` (2
    /// unless given) times longer.
    pub fn join_dead_ends(&mut self, radius: Option<f64>, detour: Option<f64>) -> Result<()> {
        self.network.join_dead_ends(answers::dead_end_options("join_dead_ends", radius, detour)?);
        Ok(())
    }

    /// Removes dead ends until none remain.
    pub fn remove_dead_ends(&mut self) {
        self.network.remove_dead_ends();
    }

    /// Returns the junction at the end of a street that was proposed with this `heading` (degrees), if it is open for
    /// further streets, or nil if the street joined others or was refused.
    pub fn reached(&self, junction: u32, heading: f64) -> Option<u32> {
        let growth = self.growths.get(&(junction, heading.to_bits()))?;
        matches!(growth.fate, Fate::Built | Fate::Bent | Fate::Shortened).then_some(growth.end + 1)
    }

    /// Returns the junction at the end of a street that was proposed with this `heading` (degrees), also if it joined
    /// others, or nil if it was refused.
    pub fn arrived(&self, junction: u32, heading: f64) -> Option<u32> {
        let growth = self.growths.get(&(junction, heading.to_bits()))?;
        (!matches!(growth.fate, Fate::Refused(_))).then_some(growth.end + 1)
    }

    /// Returns the outcome of a street that was proposed with this `heading` (degrees): "built", "bent", "shortened",
    /// "snapped" to a junction, or "joined" to a street. If it was refused, returns the reason: "too short", "angle",
    /// "too near", "corners", "obstacle" or "outside". If it was not proposed, returns "unknown".
    pub fn fate(&self, junction: u32, heading: f64) -> String {
        let growth = self.growths.get(&(junction, heading.to_bits()));
        growth.map_or("unknown", |growth| answers::fate(growth.fate)).into()
    }

    /// Predicts the outcome of a street with this `heading` (degrees) and `length` (m), without building it: a table
    /// with its `fate`, `built` (true if it would be built), the `place` (m) of its end, and the `junction` there, if
    /// any.
    pub fn probe(&self, junction: u32, heading: f64, length: f64, depth: u32) -> Result<Value> {
        let (from, to) = self.proposed("probe", junction, heading, length)?;
        Ok(answers::prospect(self.network.probe(from, to, self.attributes(depth))))
    }

    /// Returns the dead ends: a list of tables with `junction`, `place` (m), the `heading` (degrees) to continue in,
    /// and `depth`.
    pub fn open_ends(&self) -> Value {
        answers::open_ends(&self.network)
    }

    /// Returns the number of dead ends that `join_dead_ends` would join within the same `radius` (m, 150 unless given)
    /// and with the same `detour` (2 unless given).
    pub fn joinable(&self, radius: Option<f64>, detour: Option<f64>) -> Result<u32> {
        let options = answers::dead_end_options("joinable", radius, detour)?;
        Ok(u32::try_from(self.network.joinable_dead_ends(options)).unwrap_or(u32::MAX))
    }

    /// Returns the measures for comparing networks: a table with `length` (m), the mean `degree` of junctions, the
    /// fractions `dead_ends`, `three_way` and `four_way`, `circuity`, `meshedness`, `orientation_order`, the median
    /// area `block` (m²), `block_spread` and `block_shape` of blocks, the `largest` block (m²), the median `segment`
    /// (m) between junctions, the `density` (km/km²), the `zigzags` per kilometre, and the fractions `stubs`,
    /// `triangles` and `knots`.
    pub fn measures(&self) -> Value {
        answers::measures(&self.network.measures())
    }

    /// Returns the position of a junction (m).
    pub fn place(&self, junction: u32) -> Result<glam::DVec3> {
        Ok(self.network.at(self.known(junction)?).extend(0.0))
    }

    /// Returns all junctions by number, including those where a street only turns: a list of tables with `place` (m),
    /// the minimum `depth` of its streets, and the `headings` (degrees) in which they leave it.
    pub fn places(&self) -> Value {
        answers::places(&self.network)
    }

    /// Returns the area on the left of the street that leaves a junction nearest to a `heading` (degrees): a table with
    /// its `area` (m²), negative for the area outside all streets, and its `corners` in order, each with `junction`,
    /// `place` (m), `degree`, and the `depth` of the street to the next corner. Returns nil if no street leaves the
    /// junction.
    pub fn face(&self, junction: u32, heading: f64) -> Result<Value> {
        let towards = DVec2::from_angle(heading.to_radians());
        Ok(answers::face(&self.network, self.known(junction)?, towards))
    }

    /// Returns the number of streets at a junction.
    pub fn degree(&self, junction: u32) -> Result<u32> {
        let degree = self.network.junctions()[self.known(junction)? as usize].degree();
        Ok(u32::try_from(degree).unwrap_or(u32::MAX))
    }

    /// Returns the number of street segments between junctions.
    pub fn size(&self) -> u32 {
        u32::try_from(self.network.size()).unwrap_or(u32::MAX)
    }

    /// Returns the distance (m) from a position to the centreline of the nearest street, or infinity without streets.
    pub fn distance(&self, place: Vector) -> f64 {
        self.network.nearest(place.0.truncate()).map_or(f64::INFINITY, |(_, distance)| distance)
    }

    /// Returns the streets from one junction to the next as features. Each has an id, a geometry (its centreline), its
    /// depth, the name of its kind, its width, sidewalk, lanes, median and parking, its level, its length (m), bridge
    /// (true for a bridge), and the junctions from and to.
    pub fn streets(&self) -> StreetRecords {
        self.street_records()
    }

    /// Returns the junctions and dead ends as features, without positions where a street only turns. Each has an id, a
    /// geometry (a point), its junction number, its degree, and the minimum depth and maximum width of its streets.
    pub fn junctions(&self) -> JunctionRecords {
        self.junction_records()
    }

    /// Returns the parts of `existing` streets that are missing in the network: a list of tables with the `name` of the
    /// street, the `place` (m) where the part begins, its `length` (m) and the `reason`.
    pub fn omitted(&self) -> Value {
        answers::omitted(&self.omitted)
    }

    /// Returns the blocks between the streets, inside their sidewalks, as features. Each has an id, a geometry, its
    /// area (m²) and the minimum depth of the surrounding streets (street_depth).
    pub fn blocks(&self) -> Result<BlockRecords> {
        self.block_records()
    }

    /// Divides blocks into lots with a front on a street, and returns them as features. Each has an id, a geometry, its
    /// area (m²), its front (a line) and all its fronts, its width along the front and its depth behind it (m), corner
    /// (true for a corner lot), its access (a point on the front), its facing direction (degrees), its use, its block,
    /// and the depth and width of its street.
    pub fn lots(&self, options: Option<TableOf<LotSettings>>) -> Result<LotRecords> {
        self.lot_records(&options.unwrap_or_default().read()?)
    }

    /// Returns the height (m) of the sidewalks of the nearest street, at its point nearest to a position: the base of
    /// houses next to the street.
    pub fn height(&self, place: Vector) -> Result<f64> {
        self.height_at(place.0)
    }

    /// Returns the positions along the streets for a "tree" or a "lamp", at the distances of the street types: features
    /// with a place (m), the heading towards the street (degrees), and the street's depth.
    pub fn verge(&self, what: String) -> Result<VergeRecords> {
        self.verge_of(&what)
    }

    /// Returns sites for buildings next to the streets, in a grid along both sides of each street, as features. Each
    /// has an id, a geometry (a rectangle), its area (m²), width and depth (m), its front (a line), its access (the
    /// middle of the front), its facing direction (degrees), its row behind the street, from 0, and the depth and width
    /// of its street.
    pub fn sites(&self, options: Option<TableOf<SiteSettings>>) -> Result<SiteRecords> {
        self.site_records(&options.unwrap_or_default().read()?)
    }

    /// Returns the number of dead ends.
    pub fn dead_ends(&self) -> u32 {
        u32::try_from(self.network.dead_ends().count()).unwrap_or(u32::MAX)
    }
}

impl Network {
    /// Creates the network that a script specifies. Fails if its fields contradict each other.
    pub fn new(options: NetworkOptions) -> Result<Self> {
        let kinds: Vec<StreetKind> = options.streets.iter().map(StreetOptions::kind).collect();
        if kinds.is_empty() {
            return Err(Error::argument("network: streets has no kind of street")
                .help("write streets = { { width = 20 }, { width = 14 } }"));
        }
        for (number, kind) in (1..).zip(&kinds) {
            kind.check().map_err(|error| error.about(&format!("network: streets: kind {number}")))?;
        }
        let named = [
            ("kerb", options.kerb, 0.0, 2.0),
            ("turning", options.turning, 0.0, 100.0),
            ("max_slope", options.max_slope, 0.1, 100.0),
        ];
        for (name, value, least, most) in named {
            if !(least..=most).contains(&value) {
                return Err(Error::argument(format!(
                    "network: {name} must be from {least} to {most}, not {value}"
                )));
            }
        }
        let constraints = Constraints {
            snap: options.snap,
            min_angle: options.min_angle,
            min_length: options.min_length,
            clearance: options.clearance,
            corner: options.corner,
            bend: options.bend,
            bridge: options.bridge,
            shorten: options.shorten,
            square_ends: options.square_ends,
            most: options.most as usize,
        };
        let NetworkAreas { areas, waters, mut warnings } = NetworkAreas::new(&options);
        let mut network =
            StreetNetwork::new(constraints, Obstacles::new(areas)).map_err(|error| error.about("network"))?;
        match &options.starts {
            Some(starts) => {
                for start in starts {
                    network.begin(start.0.truncate()).map_err(|error| error.about("network: starts"))?;
                }
            }
            // With existing streets, the origin is only a default start, so an obstacle there is not an error.
            None if !options.existing.is_empty() => {
                let _ = network.begin(DVec2::ZERO);
            }
            None => {
                network.begin(DVec2::ZERO).map_err(|error| error.about("network: starts"))?;
            }
        }
        let (existing, said) = existing::add(&mut network, &options.existing, &kinds)?;
        warnings.extend(said);
        Ok(Self {
            options,
            kinds,
            network,
            fit: OnceLock::new(),
            water: waters.into(),
            omitted: existing.losses,
            growths: FxHashMap::default(),
            walk: NetworkWalk::default(),
            answers: AnswerCache::default(),
            warnings,
            proposals: ProposalTally::default(),
            has_warned_of_refusals: false,
            has_warned_of_hiding: false,
        })
    }

    /// Returns the street network.
    pub fn network(&self) -> &StreetNetwork {
        &self.network
    }

    /// Converts the number of a junction, from 1, to its id. Fails if there is no such junction.
    fn known(&self, junction: u32) -> Result<JunctionId> {
        let count = self.network.junctions().len();
        match junction.checked_sub(1) {
            Some(id) if (id as usize) < count => Ok(id),
            _ => Err(Error::argument(format!("there is no junction {junction}")).help(format!(
                "junctions are numbered from 1 to {count}: network:reached tells where a street ends"
            ))),
        }
    }

    fn attributes(&self, depth: u32) -> StreetAttributes {
        StreetKind::of(&self.kinds, depth).attributes(depth)
    }

    pub(super) fn surface_options(&self) -> SurfaceOptions {
        SurfaceOptions { turning: self.options.turning }
    }

    /// Returns the start and the end of a street that a script proposes with `method`. Fails if the length is not above
    /// 0.
    fn proposed(
        &self,
        method: &str,
        junction: u32,
        heading: f64,
        length: f64,
    ) -> Result<(JunctionId, DVec2)> {
        let from = self.known(junction)?;
        if length <= 0.0 {
            return Err(Error::argument(format!(
                "network:{method}: a street of {length} m towards {heading} degrees cannot be"
            ))
            .help("give a finite heading, and a length above 0"));
        }
        Ok((from, self.network.at(from) + DVec2::from_angle(heading.to_radians()) * length))
    }
}

/// Allows other objects to take a script's network as a parameter.
impl burgeon_kit::ObjectParameter for Network {
    const LUAU: &str = "Network";
    const EXPECTED: &str = "a network that was derived: roads:derive().objects[1]";
}

impl std::fmt::Debug for Network {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "network of {} pieces", self.network.size())
    }
}
