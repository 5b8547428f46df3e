//! Network of junctions and the street segments between them.

use glam::DVec2;
use rstar::primitives::{GeomWithData, Line as IndexLine};
use rstar::{AABB, PointDistance, RTree};
use smallvec::SmallVec;

use super::constraints::Constraints;
use super::corner::{Arm, Corner};
use super::grid::GridPlace;
use super::merge_cache::MergeCache;
use super::obstacles::Obstacles;
use burgeon_base::error::Result;

/// Index of a junction.
pub type JunctionId = u32;
/// Index of a street segment.
pub type PieceId = u32;

/// Attributes of a street, constant along it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StreetAttributes {
    /// Width (m) between the outer edges of the sidewalks.
    pub width: f64,
    /// Width (m) of the sidewalk on each side.
    pub sidewalk: f64,
    /// Width (m) of the raised median; 0 for none.
    pub median: f64,
    /// Number of lanes in both directions; 0 for the number of its street type.
    pub lanes: u32,
    /// Number of branchings from a main street; 0 for a main street.
    pub depth: u32,
    /// Vertical level: 0 on the ground, 1 on a bridge, -1 in a tunnel, and so on. Streets of different levels cross
    /// without a junction.
    pub level: i32,
}

/// Point at which streets meet, turn or end.
#[derive(Debug, Clone)]
pub struct Junction {
    pub(crate) place: GridPlace,
    /// Segments that end at this junction.
    pub(crate) pieces: SmallVec<[PieceId; 4]>,
}

impl StreetAttributes {
    /// Returns the street as it leaves a junction in a direction.
    pub(crate) fn arm(self, way: DVec2) -> Arm {
        Arm { way, half: self.width / 2.0, walk: self.sidewalk }
    }

    /// Returns the width (m) of the carriageway.
    pub fn carriageway(&self) -> f64 {
        self.width - 2.0 * self.sidewalk
    }
}

impl Junction {
    /// Returns the position (m).
    pub fn place(&self) -> DVec2 {
        self.place.metres()
    }

    /// Returns the number of street segments at this junction.
    pub fn degree(&self) -> usize {
        self.pieces.len()
    }
}

/// Straight segment of a street between two junctions.
#[derive(Debug, Clone, Copy)]
pub struct StreetPiece {
    pub(crate) ends: [JunctionId; 2],
    /// Attributes of the street.
    pub attributes: StreetAttributes,
    /// Cleared if the segment was removed or divided.
    pub(crate) is_there: bool,
    /// Marks a bridge over an obstacle.
    pub is_bridge: bool,
    /// Marks a street that existed before the network grew, and is kept.
    pub is_existing: bool,
}

/// Maximum turn (degrees) at which one street continues in another.
const GOES_ON: f64 = 20.0;

type IndexItem<G> = GeomWithData<G, u32>;

/// Network of streets that meet only at junctions.
///
/// Two segments of the same level share at most a junction. A segment that grew keeps the minimum distance from streets
/// that it does not join, and meets others at no less than the minimum angle. All tests are exact, on a grid.
#[derive(Clone)]
pub struct StreetNetwork {
    pub(crate) constraints: Constraints,
    pub(crate) obstacles: Obstacles,
    pub(crate) junctions: Vec<Junction>,
    pub(crate) pieces: Vec<StreetPiece>,
    piece_index: RTree<IndexItem<IndexLine<[f64; 2]>>>,
    junction_index: RTree<IndexItem<[f64; 2]>>,
    widest: f64,
    pub(crate) has_existing: bool,
    /// Most recent merged surfaces.
    pub(crate) merge_cache: MergeCache,
    /// Number of additions and removals of segments.
    version: u64,
    /// Number of neighbours examined, to measure the benefit of the index.
    pub(crate) looked_at: u64,
}

impl StreetNetwork {
    /// Creates a network without streets; fails if the constraints are invalid.
    pub fn new(constraints: Constraints, obstacles: Obstacles) -> Result<Self> {
        constraints.check()?;
        Ok(Self {
            constraints,
            obstacles,
            junctions: Vec::new(),
            pieces: Vec::new(),
            piece_index: RTree::new(),
            junction_index: RTree::new(),
            widest: 0.0,
            has_existing: false,
            merge_cache: MergeCache::default(),
            version: 0,
            looked_at: 0,
        })
    }

    /// Returns the constraints.
    pub fn constraints(&self) -> &Constraints {
        &self.constraints
    }

    /// Returns the obstacles.
    pub fn obstacles(&self) -> &Obstacles {
        &self.obstacles
    }

    /// Returns all junctions by index. Junctions without segments are unused.
    pub fn junctions(&self) -> &[Junction] {
        &self.junctions
    }

    /// Returns the segments with their indices.
    pub fn pieces(&self) -> impl Iterator<Item = (PieceId, &StreetPiece)> {
        (0..).zip(&self.pieces).filter(|(_, piece)| piece.is_there)
    }

    /// Returns the number of segments.
    pub fn size(&self) -> usize {
        self.piece_index.size()
    }

    /// Returns the number of neighbours that the index has returned so far.
    pub fn looked_at(&self) -> u64 {
        self.looked_at
    }

    /// Returns the two ends (m) of a segment.
    pub fn line(&self, piece: PieceId) -> [DVec2; 2] {
        self.pieces[piece as usize].ends.map(|end| self.at(end))
    }

    /// Returns the start and end junctions of a segment.
    pub fn ends(&self, piece: PieceId) -> [JunctionId; 2] {
        self.pieces[piece as usize].ends
    }

    /// Returns the attributes of a segment's street.
    pub fn attributes(&self, piece: PieceId) -> StreetAttributes {
        self.pieces[piece as usize].attributes
    }

    /// Returns true if a segment is a bridge over an obstacle.
    pub fn is_bridge(&self, piece: PieceId) -> bool {
        self.pieces[piece as usize].is_bridge
    }

    /// Returns a number that changes whenever segments are added or removed.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Returns the length (m) of a segment.
    pub fn length(&self, piece: PieceId) -> f64 {
        let [a, b] = self.line(piece);
        a.distance(b)
    }

    /// Returns the position (m) of a junction.
    pub fn at(&self, junction: JunctionId) -> DVec2 {
        self.junctions[junction as usize].place()
    }

    pub(crate) fn grid_line(&self, piece: PieceId) -> [GridPlace; 2] {
        self.pieces[piece as usize].ends.map(|end| self.junctions[end as usize].place)
    }

    /// Returns the junction at the other end of a segment.
    pub fn across(&self, piece: PieceId, from: JunctionId) -> JunctionId {
        let [a, b] = self.pieces[piece as usize].ends;
        if a == from { b } else { a }
    }

    /// Returns the direction in which a segment leaves a junction.
    pub(crate) fn leaves(&self, piece: PieceId, from: JunctionId) -> DVec2 {
        (self.at(self.across(piece, from)) - self.at(from)).normalize_or_zero()
    }

    /// Returns the segments at a junction, counter-clockwise, each with its direction.
    pub fn arms(&self, junction: JunctionId) -> SmallVec<[(PieceId, DVec2); 6]> {
        let pieces = &self.junctions[junction as usize].pieces;
        let mut arms: SmallVec<[(PieceId, DVec2); 6]> =
            pieces.iter().map(|&piece| (piece, self.leaves(piece, junction))).collect();
        arms.sort_by(|(_, a), (_, b)| a.to_angle().total_cmp(&b.to_angle()));
        arms
    }

    /// Returns true if a street continues at a junction of two segments with only a slight turn.
    pub(crate) fn goes_on(&self, junction: JunctionId) -> bool {
        let [a, b] = self.junctions[junction as usize].pieces[..] else { return false };
        let same = self.attributes(a) == self.attributes(b) && self.is_bridge(a) == self.is_bridge(b);
        same && (-self.leaves(a, junction)).angle_to(self.leaves(b, junction)).abs().to_degrees() < GOES_ON
    }

    /// Returns the distance (m) from a junction at which each arm begins, beyond its corners.
    pub(crate) fn reaches(&self, arms: &[Arm]) -> SmallVec<[f64; 6]> {
        let mut reaches: SmallVec<[f64; 6]> = SmallVec::from_elem(0.0, arms.len());
        if arms.len() < 2 {
            return reaches;
        }
        for index in 0..arms.len() {
            let next = (index + 1) % arms.len();
            let corner = Corner::new([arms[index], arms[next]], self.constraints.corner);
            reaches[index] = reaches[index].max(corner.reaches[0]);
            reaches[next] = reaches[next].max(corner.reaches[1]);
        }
        reaches
    }

    /// Returns the segments at a junction, counter-clockwise, as arms for its corners.
    pub(crate) fn corner_arms(&self, junction: JunctionId) -> SmallVec<[(PieceId, Arm); 6]> {
        let arms = self.arms(junction).into_iter();
        arms.map(|(piece, way)| (piece, self.attributes(piece).arm(way))).collect()
    }

    /// Returns half the width (m) of a segment.
    pub(crate) fn half(&self, piece: PieceId) -> f64 {
        self.attributes(piece).width / 2.0
    }

    /// Returns the junction at a position; adds it if missing.
    pub(crate) fn junction(&mut self, place: GridPlace) -> JunctionId {
        let metres = place.metres().to_array();
        if let Some(found) = self.junction_index.locate_at_point(&metres) {
            return found.data;
        }
        #[allow(clippy::cast_possible_truncation, reason = "pieces are limited far below")]
        let id = self.junctions.len() as JunctionId;
        self.junctions.push(Junction { place, pieces: SmallVec::new() });
        self.junction_index.insert(GeomWithData::new(metres, id));
        id
    }

    pub(crate) fn junction_at(&self, place: GridPlace) -> Option<JunctionId> {
        self.junction_index.locate_at_point(&place.metres().to_array()).map(|found| found.data)
    }

    /// Adds a segment without checking constraints.
    pub(crate) fn add(
        &mut self,
        ends: [JunctionId; 2],
        attributes: StreetAttributes,
        is_bridge: bool,
    ) -> PieceId {
        #[allow(clippy::cast_possible_truncation, reason = "pieces are limited far below")]
        let id = self.pieces.len() as PieceId;
        self.widest = self.widest.max(attributes.width);
        self.version += 1;
        self.pieces.push(StreetPiece { ends, attributes, is_there: true, is_bridge, is_existing: false });
        for end in ends {
            self.junctions[end as usize].pieces.push(id);
        }
        self.piece_index.insert(self.index_item(id));
        id
    }

    /// Removes a segment, and its junctions if no other segment uses them.
    pub fn remove(&mut self, piece: PieceId) {
        if !std::mem::replace(&mut self.pieces[piece as usize].is_there, false) {
            return;
        }
        self.version += 1;
        self.piece_index.remove(&self.index_item(piece));
        for end in self.pieces[piece as usize].ends {
            let junction = &mut self.junctions[end as usize];
            junction.pieces.retain(|known| *known != piece);
            if junction.pieces.is_empty() {
                let metres = junction.place().to_array();
                self.junction_index.remove(&GeomWithData::new(metres, end));
            }
        }
    }

    fn index_item(&self, piece: PieceId) -> IndexItem<IndexLine<[f64; 2]>> {
        let [a, b] = self.line(piece);
        GeomWithData::new(IndexLine::new(a.to_array(), b.to_array()), piece)
    }

    /// Divides a segment at a position near it; returns the new junction.
    pub(crate) fn divide(&mut self, piece: PieceId, place: GridPlace) -> JunctionId {
        let StreetPiece { ends: [a, b], attributes, is_bridge, is_existing, .. } =
            self.pieces[piece as usize];
        let middle = self.junction(place);
        // Both halves are added first, so the end junctions are never empty and stay.
        for ends in [[a, middle], [middle, b]] {
            let half = self.add(ends, attributes, is_bridge);
            self.pieces[half as usize].is_existing = is_existing;
        }
        self.remove(piece);
        middle
    }

    /// Removes a segment but keeps its junctions.
    pub(crate) fn take_out(&mut self, piece: usize) {
        #[allow(clippy::cast_possible_truncation, reason = "pieces are limited far below")]
        let id = piece as PieceId;
        if !std::mem::replace(&mut self.pieces[piece].is_there, false) {
            return;
        }
        self.version += 1;
        self.piece_index.remove(&self.index_item(id));
        for end in self.pieces[piece].ends {
            self.junctions[end as usize].pieces.retain(|known| *known != id);
        }
    }

    /// Moves a junction without streets to a position.
    pub(crate) fn relocate(&mut self, junction: JunctionId, place: GridPlace) {
        let known = &mut self.junctions[junction as usize];
        let before = std::mem::replace(&mut known.place, place);
        self.junction_index.remove(&GeomWithData::new(before.metres().to_array(), junction));
        self.junction_index.insert(GeomWithData::new(place.metres().to_array(), junction));
    }

    /// Moves the streets of junction `of` to junction `bare`, which has no streets and takes its position.
    pub(crate) fn replace_junction(&mut self, bare: JunctionId, of: JunctionId) {
        let place = self.junctions[of as usize].place;
        self.junction_index.remove(&GeomWithData::new(place.metres().to_array(), of));
        self.relocate(bare, place);
        let pieces = std::mem::take(&mut self.junctions[of as usize].pieces);
        for piece in &pieces {
            for end in &mut self.pieces[*piece as usize].ends {
                if *end == of {
                    *end = bare;
                }
            }
        }
        self.junctions[bare as usize].pieces = pieces;
        self.version += 1;
    }

    /// Returns true if some streets existed before the network grew.
    pub fn has_existing(&self) -> bool {
        self.has_existing
    }

    /// Returns true if a segment is on the ground, neither on a bridge over other streets nor in a tunnel.
    pub fn is_on_ground(&self, piece: PieceId) -> bool {
        self.pieces[piece as usize].attributes.level == 0
    }

    /// Returns true if a street on the ground ends at a junction.
    pub(crate) fn has_ground(&self, junction: JunctionId) -> bool {
        self.junctions[junction as usize].pieces.iter().any(|piece| self.is_on_ground(*piece))
    }

    /// Returns the segments on the ground whose bounding boxes are within `margin` (m) of the bounding box of `line`.
    pub(crate) fn ground_near(&self, line: [DVec2; 2], margin: f64) -> impl Iterator<Item = PieceId> + '_ {
        self.pieces_near(line, margin).filter(|piece| self.is_on_ground(*piece))
    }

    /// Returns the segment on the ground nearest to a position, and its distance (m); `None` if there is none.
    pub fn nearest_on_ground(&self, place: DVec2) -> Option<(PieceId, f64)> {
        self.nearest_of_level(place, 0)
    }

    /// Returns the segment of a level nearest to a position, and its distance (m); `None` if there is none.
    pub(crate) fn nearest_of_level(&self, place: DVec2, level: i32) -> Option<(PieceId, f64)> {
        let place = place.to_array();
        let mut near = self.piece_index.nearest_neighbor_iter(&place);
        let found = near.find(|found| self.attributes(found.data).level == level)?;
        Some((found.data, found.distance_2(&place).sqrt()))
    }

    /// Returns the width (m) of the widest street so far.
    pub(crate) fn widest(&self) -> f64 {
        self.widest
    }

    /// Returns the segments whose bounding boxes are within `margin` (m) of the bounding box of `line`.
    pub(crate) fn pieces_near(&self, [a, b]: [DVec2; 2], margin: f64) -> impl Iterator<Item = PieceId> + '_ {
        let around = AABB::from_corners((a.min(b) - margin).to_array(), (a.max(b) + margin).to_array());
        self.piece_index.locate_in_envelope_intersecting(&around).map(|found| found.data)
    }

    /// Returns the junctions within `margin` (m) of the bounding box of `line`.
    pub(crate) fn junctions_near(
        &self,
        [a, b]: [DVec2; 2],
        margin: f64,
    ) -> impl Iterator<Item = JunctionId> + '_ {
        let around = AABB::from_corners((a.min(b) - margin).to_array(), (a.max(b) + margin).to_array());
        self.junction_index.locate_in_envelope(&around).map(|found| found.data)
    }

    /// Returns the segment nearest to a position, and its distance (m); `None` if there is none.
    ///
    /// ```
    /// use burgeon_streets::{Constraints, Obstacles, StreetAttributes, StreetNetwork};
    /// use glam::DVec2;
    ///
    /// let mut network = StreetNetwork::new(Constraints::default(), Obstacles::default())?;
    /// assert_eq!(network.nearest(DVec2::ZERO), None);
    /// let start = network.begin(DVec2::ZERO)?;
    /// network.grow(start, DVec2::new(100.0, 0.0), StreetAttributes::default())?;
    /// let (piece, distance) = network.nearest(DVec2::new(30.0, 7.0)).expect("a street");
    /// assert_eq!((network.length(piece), distance), (100.0, 7.0));
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn nearest(&self, place: DVec2) -> Option<(PieceId, f64)> {
        let place = place.to_array();
        let found = self.piece_index.nearest_neighbor(&place)?;
        Some((found.data, found.distance_2(&place).sqrt()))
    }
}
