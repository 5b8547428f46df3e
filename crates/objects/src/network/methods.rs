//! The read and write methods of networks.

use glam::DVec2;

use super::answers;
use super::land::VergeRecords;
use super::lots::{BlockRecords, LotRecords, LotSettings};
use super::object::Network;
use super::sites::{SiteRecords, SiteSettings};
use super::streets::{JunctionRecords, StreetRecords};
use burgeon_base::error::{Error, Result};
use burgeon_kit::{TableOf, Value, Vector, methods};
use burgeon_streets::Fate;

#[methods("network")]
impl Network {
    /// Proposes a street from a junction: its `heading` (degrees from east, counter-clockwise), its `length` (m) and
    /// its depth, the number of times that its path has branched.
    pub fn grow(&mut self, junction: u32, heading: f64, length: f64, depth: u32) -> Result<()> {
        let (from, to) = self.proposed_line("grow", junction, heading, length)?;
        let growth = self.network.grow(from, to, self.attributes(depth))?;
        self.proposals.count(growth.fate);
        self.growths.insert((junction, heading.to_bits()), growth);
        Ok(())
    }

    /// Proposes a street from a junction to a position (m). The street may join other streets on its way. A warning
    /// reports a street that is refused, or that ends before an obstacle.
    pub fn grow_to(&mut self, junction: u32, to: Vector, depth: u32) -> Result<()> {
        let from = self.junction_id(junction)?;
        let to = to.0.truncate();
        let growth = self.network.grow(from, to, self.attributes(depth))?;
        let ways = [self.network.at(from), self.network.at(growth.end), to];
        self.warnings.extend(answers::misled_warning(growth.fate, ways));
        Ok(())
    }

    /// Walks ahead by a street of a `length` (m), and continues from its end.
    ///
    /// A path begins at the first start, towards the east. A branch begins at the current position, and its depth is
    /// one more. A refused street ends its path.
    pub fn walk(&mut self, length: f64) -> Result<()> {
        if length <= 0.0 {
            return Err(Error::argument(format!("network:walk: invalid street length {length} m"))
                .help("use a length above 0"));
        }
        if self.network.junctions().is_empty() {
            return Err(Error::argument("network:walk: the network has no junction to walk from")
                .help("set starts, such as network { starts = { { 0, 0 } } }"));
        }
        let attributes = self.attributes(self.walk.depth());
        if let Some((junction, heading, growth)) =
            self.walk.walk_ahead(&mut self.network, length, attributes)?
        {
            self.growths.insert((junction + 1, heading.to_bits()), growth);
        }
        Ok(())
    }

    /// Turns the path by `angle` (degrees), counter-clockwise.
    pub fn turn(&mut self, angle: f64) {
        self.walk.turn(angle);
    }

    /// Continues the path from a junction with a `heading` (degrees from east, counter-clockwise).
    pub fn move_to(&mut self, junction: u32, heading: f64) -> Result<()> {
        let at = self.junction_id(junction)?;
        self.walk.move_to(at, heading);
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
    pub fn open_end(&self, junction: u32, heading: f64) -> Option<u32> {
        let growth = self.growths.get(&(junction, heading.to_bits()))?;
        matches!(growth.fate, Fate::Built | Fate::Bent | Fate::Shortened).then_some(growth.end + 1)
    }

    /// Returns the junction at the end of a street that was proposed with this `heading` (degrees), also if it joined
    /// others, or nil if it was refused.
    pub fn end_junction(&self, junction: u32, heading: f64) -> Option<u32> {
        let growth = self.growths.get(&(junction, heading.to_bits()))?;
        (!matches!(growth.fate, Fate::Refused(_))).then_some(growth.end + 1)
    }

    /// Returns the outcome of a street that was proposed with this `heading` (degrees): "built", "bent", "shortened",
    /// "snapped" to a junction, or "joined" to a street. If it was refused, returns the reason: "too short", "angle",
    /// "too near", "corners", "obstacle" or "outside". If it was not proposed, returns "unknown".
    pub fn outcome(&self, junction: u32, heading: f64) -> String {
        let growth = self.growths.get(&(junction, heading.to_bits()));
        growth.map_or("unknown", |growth| answers::fate(growth.fate)).into()
    }

    /// Predicts the outcome of a street with this `heading` (degrees) and `length` (m), without building it: a table
    /// with its `outcome`, `built` (true if it would be built), the `place` (m) of its end, and the `junction` there, if
    /// any.
    pub fn probe(&self, junction: u32, heading: f64, length: f64, depth: u32) -> Result<Value> {
        let (from, to) = self.proposed_line("probe", junction, heading, length)?;
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
        Ok(self.network.at(self.junction_id(junction)?).extend(0.0))
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
        Ok(answers::face(&self.network, self.junction_id(junction)?, towards))
    }

    /// Returns the number of streets at a junction.
    pub fn degree(&self, junction: u32) -> Result<u32> {
        let degree = self.network.junctions()[self.junction_id(junction)? as usize].degree();
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
        answers::omitted_streets(&self.omitted)
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
