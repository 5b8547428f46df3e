//! The type of object: its fields, and what rules ask and interpretations change.

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
use burgeon_geometry::{Polygon, Rings};
use burgeon_kit::{Color, TableOf, Value, Vector, fields, methods, object};
use burgeon_streets::{
    Constraints, ExistingLoss, Fate, JunctionId, Obstacles, StreetAttributes, StreetFit, StreetGrowth,
    StreetKind, StreetNetwork, SurfaceOptions,
};

/// What `network(...)` takes.
#[fields("network")]
pub struct NetworkOptions {
    /// Where streets begin (m): junctions 1, 2, 3 and so on. The origin if omitted, unless streets exist and an obstacle is
    /// there.
    pub starts: Option<Vec<Vector>>,
    /// The kinds of streets, by depth from 0 on; the last one holds for all that are deeper.
    #[default([20.0, 14.0, 11.0].map(StreetOptions::of_width).to_vec())]
    pub streets: Vec<StreetOptions>,
    /// How near (m) the end of a street comes to a junction or another street before it joins that.
    #[default(25.0)]
    pub snap: f64,
    /// The least angle (degrees) between two streets at a junction.
    #[default(45.0)]
    pub min_angle: f64,
    /// The least length (m) of a street between two junctions.
    #[default(12.0)]
    pub min_length: f64,
    /// The least distance (m) between streets that do not meet.
    #[default(6.0)]
    pub clearance: f64,
    /// The radius (m) of the corners of blocks.
    #[default(4.0)]
    pub corner: f64,
    /// How far (degrees) a street may turn to pass an obstacle.
    #[default(40.0)]
    pub bend: f64,
    /// The longest way (m) over water that a bridge may lead.
    #[default(0.0)]
    pub bridge: f64,
    /// Areas that no street leads through: polygons.
    #[default(Vec::new())]
    pub obstacles: Vec<Rings>,
    /// Areas that only bridges lead over: polygons.
    #[default(Vec::new())]
    pub water: Vec<Rings>,
    /// The area that streets stay inside of; anywhere if it is left out.
    pub limit: Option<Rings>,
    /// Whether a street may end before an obstacle, in place of being refused.
    #[default(true)]
    pub shorten: bool,
    /// Existing streets, which stay where they are whatever the constraints ask: a list of { lines = ..., depth = ...,
    /// width = ..., lanes = ..., level = ... }.
    #[default(Vec::new())]
    pub existing: Vec<ExistingLines>,
    /// The most pieces of streets.
    #[default(400_000)]
    pub most: u32,
    /// The ground that streets lie on: a terrain that was derived before.
    pub on: Option<Arc<Terrain>>,
    /// The greatest slope (%) of streets on the ground; they cut into it and are raised over it to keep that.
    #[default(10.0)]
    pub max_slope: f64,
    /// The height (m) of the water that bridges lead over; that of the terrain's water if it is left out.
    pub water_level: Option<f64>,
    /// Height (m) of kerbs.
    #[default(0.14)]
    pub kerb: f64,
    /// The radius (m) of circles to turn in at dead ends; 0 for none.
    #[default(0.0)]
    pub turning: f64,
    /// Whether dead ends without such a circle are cut off square, as at the rim of a map, in place of round.
    #[default(false)]
    pub square_ends: bool,
    /// Whether lines and crossings are painted on the streets.
    #[default(true)]
    pub markings: bool,
    /// Colour of carriageways.
    #[default(Color([0.095, 0.098, 0.105, 1.0]))]
    pub asphalt: Color,
    /// Colour of sidewalks.
    #[default(Color([0.45, 0.44, 0.42, 1.0]))]
    pub paving: Color,
    /// Colour of the blocks between the streets; none is drawn if it is left out.
    pub ground: Option<Color>,
}

/// A network of streets, which grows by what interpretation rules propose.
///
/// A street that is proposed is built, shortened, bent, joined to what is near its end, or refused; in the next step rules ask
/// what became of it. No two streets cross without a junction, and none comes too near another. What was built stays for all
/// steps.
#[object(
    "network",
    options = NetworkOptions,
    example = include_str!("../../scripts/network.lua"),
    shows,
    has_layers,
    begin = restart,
    push = open_branch,
    pop = close_branch,
    end = finish,
    warns
)]
pub struct Network {
    pub(super) options: NetworkOptions,
    /// By depth.
    pub(super) kinds: Vec<StreetKind>,
    pub(super) network: StreetNetwork,
    /// Areas that bridges lead over.
    pub(super) water: Arc<[Polygon]>,
    /// How high its streets lie, with the version of the network that this is of.
    pub(super) fit: OnceLock<(u64, Arc<StreetFit>)>,
    /// What became of what was proposed in the last pass, by junction and heading.
    pub(super) growths: FxHashMap<(u32, u64), StreetGrowth>,
    pub(super) walk: NetworkWalk,
    /// Parts of existing streets that are missing.
    pub(super) omitted: Vec<ExistingLoss>,
    /// What scripts have asked of blocks and lots.
    pub(super) answers: AnswerCache,
    pub(super) warnings: Vec<Warning>,
    /// What became of all that was proposed.
    pub(super) proposals: ProposalTally,
    /// Whether it was told that streets were refused.
    pub(super) has_warned_of_refusals: bool,
    /// Whether it was told that the ground hides streets.
    pub(super) has_warned_of_hiding: bool,
}

#[methods("network")]
impl Network {
    /// Proposes a street from a junction: its `heading` (degrees from east, counter-clockwise), its `length` (m) and how often
    /// its way has branched off.
    pub fn grow(&mut self, junction: u32, heading: f64, length: f64, depth: u32) -> Result<()> {
        let (from, to) = self.proposed("grow", junction, heading, length)?;
        let growth = self.network.grow(from, to, self.attributes(depth))?;
        self.proposals.count(growth.fate);
        self.growths.insert((junction, heading.to_bits()), growth);
        Ok(())
    }

    /// Proposes a street from a junction to a place (m). It may join others on its way; a warning tells if it is refused, or
    /// ends before an obstacle.
    pub fn lead(&mut self, junction: u32, to: Vector, depth: u32) -> Result<()> {
        let from = self.known(junction)?;
        let to = to.0.truncate();
        let growth = self.network.grow(from, to, self.attributes(depth))?;
        let ways = [self.network.at(from), self.network.at(growth.end), to];
        self.warnings.extend(answers::misled(growth.fate, ways));
        Ok(())
    }

    /// Walks ahead from where the way is by a street of a `length` (m), if that is not refused, and goes on from where it ends.
    ///
    /// A way begins at the first start, towards the east; a branch begins where it leaves, and its depth is one more. What
    /// is refused ends its way.
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

    /// Turns the way by `angle` (degrees), counter-clockwise.
    pub fn turn(&mut self, angle: f64) {
        self.walk.turn(angle);
    }

    /// Lets the way go on from a junction towards a `heading` (degrees from east, counter-clockwise).
    pub fn stand(&mut self, junction: u32, heading: f64) -> Result<()> {
        let at = self.known(junction)?;
        self.walk.stand(at, heading);
        Ok(())
    }

    /// Joins dead ends to the streets within `radius` (m, 150 unless given) to which the way along the streets is `detour` (2
    /// unless given) times longer.
    pub fn join_dead_ends(&mut self, radius: Option<f64>, detour: Option<f64>) -> Result<()> {
        self.network.join_dead_ends(answers::dead_end_options("join_dead_ends", radius, detour)?);
        Ok(())
    }

    /// Takes dead ends away, until none is left.
    pub fn remove_dead_ends(&mut self) {
        self.network.remove_dead_ends();
    }

    /// The junction where a street ends that was proposed with this `heading` (degrees), if others may go on from there; nil if
    /// it joined others or was refused.
    pub fn reached(&self, junction: u32, heading: f64) -> Option<u32> {
        let growth = self.growths.get(&(junction, heading.to_bits()))?;
        matches!(growth.fate, Fate::Built | Fate::Bent | Fate::Shortened).then_some(growth.end + 1)
    }

    /// The junction where a street ends that was proposed with this `heading` (degrees), whatever it joined; nil if it was
    /// refused.
    pub fn arrived(&self, junction: u32, heading: f64) -> Option<u32> {
        let growth = self.growths.get(&(junction, heading.to_bits()))?;
        (!matches!(growth.fate, Fate::Refused(_))).then_some(growth.end + 1)
    }

    /// What became of a street that was proposed with this `heading` (degrees): "built", "bent", "shortened", "snapped" to a
    /// junction, "joined" to a street, or why it was refused: "too short", "angle", "too near", "corners", "obstacle",
    /// "outside"; "unknown" if it was not proposed.
    pub fn fate(&self, junction: u32, heading: f64) -> String {
        let growth = self.growths.get(&(junction, heading.to_bits()));
        growth.map_or("unknown", |growth| answers::fate(growth.fate)).into()
    }

    /// What would become of a street with this `heading` (degrees) and `length` (m), as the network is now: a table with its
    /// `fate`, whether it would be `built`, the `place` (m) where it would end, and the `junction` if one is there.
    pub fn probe(&self, junction: u32, heading: f64, length: f64, depth: u32) -> Result<Value> {
        let (from, to) = self.proposed("probe", junction, heading, length)?;
        Ok(answers::prospect(self.network.probe(from, to, self.attributes(depth))))
    }

    /// The dead ends: a list of tables with `junction`, `place` (m), the `heading` (degrees) that leads on, and `depth`.
    pub fn open_ends(&self) -> Value {
        answers::open_ends(&self.network)
    }

    /// How many dead ends `join_dead_ends` would join within the same `radius` (m, 150 unless given) and with the same
    /// `detour` (2 unless given).
    pub fn joinable(&self, radius: Option<f64>, detour: Option<f64>) -> Result<u32> {
        let options = answers::dead_end_options("joinable", radius, detour)?;
        Ok(u32::try_from(self.network.joinable_dead_ends(options)).unwrap_or(u32::MAX))
    }

    /// The measures that networks are compared by: a table with `length` (m), the mean `degree` of junctions, the shares
    /// `dead_ends`, `three_way` and `four_way`, `circuity`, `meshedness`, `orientation_order`, of blocks the median area `block`
    /// (m²), `block_spread`, `block_shape` and the `largest` (m²), the median `segment` (m) between junctions, the `density`
    /// (km/km²), the `zigzags` on each kilometre, and the shares `stubs`, `triangles` and `knots`.
    pub fn measures(&self) -> Value {
        answers::measures(&self.network.measures())
    }

    /// Where a junction is (m).
    pub fn place(&self, junction: u32) -> Result<glam::DVec3> {
        Ok(self.network.at(self.known(junction)?).extend(0.0))
    }

    /// Where all junctions are, by their numbers, those too where a street only turns: a list of tables with `place` (m), the
    /// least `depth` of its streets, and the `headings` (degrees) in which they leave it.
    pub fn places(&self) -> Value {
        answers::places(&self.network)
    }

    /// The area on the left of the street that leaves a junction nearest to a `heading` (degrees): a table with its `area` (m²),
    /// negative if it lies outside of all streets, and its `corners` in order, each with `junction`, `place` (m), `degree`, and
    /// the `depth` of the street to the next one. It is nil if no street leaves the junction.
    pub fn face(&self, junction: u32, heading: f64) -> Result<Value> {
        let towards = DVec2::from_angle(heading.to_radians());
        Ok(answers::face(&self.network, self.known(junction)?, towards))
    }

    /// How many streets meet at a junction.
    pub fn degree(&self, junction: u32) -> Result<u32> {
        let degree = self.network.junctions()[self.known(junction)? as usize].degree();
        Ok(u32::try_from(degree).unwrap_or(u32::MAX))
    }

    /// How many pieces of streets there are, from junction to junction.
    pub fn size(&self) -> u32 {
        u32::try_from(self.network.size()).unwrap_or(u32::MAX)
    }

    /// Distance (m) from a place to the middle of the nearest street; infinite without any.
    pub fn distance(&self, place: Vector) -> f64 {
        self.network.nearest(place.0.truncate()).map_or(f64::INFINITY, |(_, distance)| distance)
    }

    /// The streets from one junction to the next, as features: each has an id, a geometry (its middle line), how often its way has
    /// branched off (depth), the name of its kind, its width, sidewalk, lanes, median and parking, its level, its length (m),
    /// whether it is a bridge, and the junctions that it leads from and to.
    pub fn streets(&self) -> StreetRecords {
        self.street_records()
    }

    /// The junctions and the dead ends, without places where a street only turns, as features: each has an id, a geometry (a
    /// point), its junction, its degree, and the least depth and the greatest width of its streets.
    pub fn junctions(&self) -> JunctionRecords {
        self.junction_records()
    }

    /// The parts of `existing` streets that are missing in the network: a list of tables with the `name` of the street, the
    /// `place` (m) where the part begins, its `length` (m) and the `reason`.
    pub fn omitted(&self) -> Value {
        answers::omitted(&self.omitted)
    }

    /// The blocks between the streets, inside of their sidewalks, as features: each has an id, a geometry, its area (m²) and the
    /// least depth of the streets around it (street_depth).
    pub fn blocks(&self) -> Result<BlockRecords> {
        self.block_records()
    }

    /// Divides blocks into lots with a front on a street, as features: each has an id, a geometry, its area (m²), its front (a
    /// line) and all its fronts, its width along the front and its depth behind it (m), whether it is a corner, its access (a place
    /// on the front), where it is facing (degrees), its use, its block, and the depth and width of its street.
    pub fn lots(&self, options: Option<TableOf<LotSettings>>) -> Result<LotRecords> {
        self.lot_records(&options.unwrap_or_default().read()?)
    }

    /// Height (m) of the sidewalks of the street that is nearest to a place, where it is nearest: houses beside it stand there.
    pub fn height(&self, place: Vector) -> Result<f64> {
        self.height_at(place.0)
    }

    /// Places along the streets for a "tree" or a "lamp", as far apart as the kinds of streets say: features with a place (m), the
    /// direction from there towards the street (degrees), and how often the street's way has branched off.
    pub fn verge(&self, what: String) -> Result<VergeRecords> {
        self.verge_of(&what)
    }

    /// Sites for buildings beside the streets, in a grid along both sides of each, where there is room, as features: each has an
    /// id, a geometry (a rectangle), its area (m²), width and depth (m), its front (a line), its access (the middle of it), where
    /// it is facing (degrees), its row behind the street, from 0, and the depth and width of its street.
    pub fn sites(&self, options: Option<TableOf<SiteSettings>>) -> Result<SiteRecords> {
        self.site_records(&options.unwrap_or_default().read()?)
    }

    /// How many dead ends there are.
    pub fn dead_ends(&self) -> u32 {
        u32::try_from(self.network.dead_ends().count()).unwrap_or(u32::MAX)
    }
}

impl Network {
    /// The network that a script describes; fails if its fields contradict one another.
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
            // What exists says where streets begin; nobody asked for the origin.
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

    /// The network itself.
    pub fn network(&self) -> &StreetNetwork {
        &self.network
    }

    /// The junction with this number, which counts from 1.
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

    /// Where a street begins and ends that a script proposes by `method`.
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

/// A network of a script, to be asked by others.
impl burgeon_kit::ObjectParameter for Network {
    const LUAU: &str = "Network";
    const EXPECTED: &str = "a network that was derived: roads:derive().objects[1]";
}

impl std::fmt::Debug for Network {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "network of {} pieces", self.network.size())
    }
}
