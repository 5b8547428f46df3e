//! The network: junctions and the pieces of streets between them.

use glam::DVec2;
use rstar::primitives::{GeomWithData, Line as IndexLine};
use rstar::{AABB, PointDistance, RTree};
use smallvec::SmallVec;

use crate::constraints::Constraints;
use crate::corner::{Arm, Corner};
use crate::grid::GridPlace;
use crate::merged::MergeCache;
use crate::obstacles::Obstacles;
use burgeon_base::error::Result;

/// The number of a junction.
pub type JunctionId = u32;
/// The number of a piece.
pub type PieceId = u32;

/// What a street is, the same all along.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StreetAttributes {
    /// Width (m) from one outer edge of the sidewalks to the other.
    pub width: f64,
    /// Width (m) of the sidewalk on each side.
    pub sidewalk: f64,
    /// Width (m) of the raised strip in its middle; 0 for none.
    pub median: f64,
    /// The number of lanes for both directions; 0 for as many as its kind has.
    pub lanes: u32,
    /// How many times its way branched off: 0 for a main street.
    pub depth: u32,
    /// 0 on the ground, 1 on a bridge, -1 in a tunnel, and so on: streets of different levels cross without a junction.
    pub level: i32,
}

/// Where streets meet, turn or end.
#[derive(Debug, Clone)]
pub struct Junction {
    pub(crate) place: GridPlace,
    /// The pieces that end here.
    pub(crate) pieces: SmallVec<[PieceId; 4]>,
}

impl StreetAttributes {
    /// As it leaves a junction in a direction.
    pub(crate) fn arm(self, way: DVec2) -> Arm {
        Arm { way, half: self.width / 2.0, walk: self.sidewalk }
    }

    /// Width (m) of the carriageway.
    pub fn carriageway(&self) -> f64 {
        self.width - 2.0 * self.sidewalk
    }
}

impl Junction {
    /// Where it is (m).
    pub fn place(&self) -> DVec2 {
        self.place.metres()
    }

    /// How many pieces end here.
    pub fn degree(&self) -> usize {
        self.pieces.len()
    }
}

/// A piece of a street, straight from one junction to another.
#[derive(Debug, Clone, Copy)]
pub struct StreetPiece {
    pub(crate) ends: [JunctionId; 2],
    /// What it is a piece of.
    pub attributes: StreetAttributes,
    /// Whether it is still there: a piece that was divided is not.
    pub(crate) is_there: bool,
    /// Whether it leads over an obstacle.
    pub is_bridge: bool,
    /// Whether it existed before the network grew, so that it stays.
    pub is_existing: bool,
}

type IndexItem<G> = GeomWithData<G, u32>;

/// A network of streets, which meet only at junctions.
///
/// No two of its pieces of one level have a place in common but a junction. Each that grew keeps its distance from what it
/// does not join, and meets others at no angle smaller than the least one. All of it is decided on a grid, exactly.
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
    /// Surfaces that were asked for last.
    pub(crate) merge_cache: MergeCache,
    /// How often pieces were added or taken away.
    version: u64,
    /// How many neighbours were looked at, to show what the index saves.
    pub(crate) looked_at: u64,
}

impl StreetNetwork {
    /// A network without streets; fails if the constraints contradict one another.
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

    /// What its streets keep to.
    pub fn constraints(&self) -> &Constraints {
        &self.constraints
    }

    /// What its streets do not run through.
    pub fn obstacles(&self) -> &Obstacles {
        &self.obstacles
    }

    /// Its junctions, by number. Those without a piece are of no street any more.
    pub fn junctions(&self) -> &[Junction] {
        &self.junctions
    }

    /// The pieces of its streets with their numbers.
    pub fn pieces(&self) -> impl Iterator<Item = (PieceId, &StreetPiece)> {
        (0..).zip(&self.pieces).filter(|(_, piece)| piece.is_there)
    }

    /// How many pieces there are.
    pub fn size(&self) -> usize {
        self.piece_index.size()
    }

    /// How many neighbours its index gave for all that was asked so far.
    pub fn looked_at(&self) -> u64 {
        self.looked_at
    }

    /// The two ends (m) of a piece.
    pub fn line(&self, piece: PieceId) -> [DVec2; 2] {
        self.pieces[piece as usize].ends.map(|end| self.at(end))
    }

    /// The junctions that a piece leads from and to.
    pub fn ends(&self, piece: PieceId) -> [JunctionId; 2] {
        self.pieces[piece as usize].ends
    }

    /// What a piece is a piece of.
    pub fn attributes(&self, piece: PieceId) -> StreetAttributes {
        self.pieces[piece as usize].attributes
    }

    /// Whether a piece leads over an obstacle.
    pub fn is_bridge(&self, piece: PieceId) -> bool {
        self.pieces[piece as usize].is_bridge
    }

    /// A number that changes whenever pieces are added or taken away.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// The length (m) of a piece.
    pub fn length(&self, piece: PieceId) -> f64 {
        let [a, b] = self.line(piece);
        a.distance(b)
    }

    /// Where a junction is (m).
    pub fn at(&self, junction: JunctionId) -> DVec2 {
        self.junctions[junction as usize].place()
    }

    pub(crate) fn grid_line(&self, piece: PieceId) -> [GridPlace; 2] {
        self.pieces[piece as usize].ends.map(|end| self.junctions[end as usize].place)
    }

    /// The junction at the other end of a piece.
    pub fn across(&self, piece: PieceId, from: JunctionId) -> JunctionId {
        let [a, b] = self.pieces[piece as usize].ends;
        if a == from { b } else { a }
    }

    /// The direction in which a piece leaves a junction.
    pub(crate) fn leaves(&self, piece: PieceId, from: JunctionId) -> DVec2 {
        (self.at(self.across(piece, from)) - self.at(from)).normalize_or_zero()
    }

    /// The pieces at a junction, counter-clockwise, each with the direction in which it leaves.
    pub fn arms(&self, junction: JunctionId) -> SmallVec<[(PieceId, DVec2); 6]> {
        let pieces = &self.junctions[junction as usize].pieces;
        let mut arms: SmallVec<[(PieceId, DVec2); 6]> =
            pieces.iter().map(|&piece| (piece, self.leaves(piece, junction))).collect();
        arms.sort_by(|(_, a), (_, b)| a.to_angle().total_cmp(&b.to_angle()));
        arms
    }

    /// How far (m) from a junction each of its arms begins, where its corners end.
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

    /// The pieces at a junction, counter-clockwise, as its corners see them.
    pub(crate) fn corner_arms(&self, junction: JunctionId) -> SmallVec<[(PieceId, Arm); 6]> {
        let arms = self.arms(junction).into_iter();
        arms.map(|(piece, way)| (piece, self.attributes(piece).arm(way))).collect()
    }

    /// Half of the width (m) of a piece.
    pub(crate) fn half(&self, piece: PieceId) -> f64 {
        self.attributes(piece).width / 2.0
    }

    /// Adds a junction, or finds the one that is there.
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

    /// Adds a piece without asking anything.
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
        self.piece_index.insert(self.indexed(id));
        id
    }

    /// Takes a piece away; a junction that nothing leads to any more goes with it.
    pub fn remove(&mut self, piece: PieceId) {
        if !std::mem::replace(&mut self.pieces[piece as usize].is_there, false) {
            return;
        }
        self.version += 1;
        self.piece_index.remove(&self.indexed(piece));
        for end in self.pieces[piece as usize].ends {
            let junction = &mut self.junctions[end as usize];
            junction.pieces.retain(|known| *known != piece);
            if junction.pieces.is_empty() {
                let metres = junction.place().to_array();
                self.junction_index.remove(&GeomWithData::new(metres, end));
            }
        }
    }

    fn indexed(&self, piece: PieceId) -> IndexItem<IndexLine<[f64; 2]>> {
        let [a, b] = self.line(piece);
        GeomWithData::new(IndexLine::new(a.to_array(), b.to_array()), piece)
    }

    /// Divides a piece at a place near it; gives the junction there.
    pub(crate) fn divide(&mut self, piece: PieceId, place: GridPlace) -> JunctionId {
        let StreetPiece { ends: [a, b], attributes, is_bridge, is_existing, .. } =
            self.pieces[piece as usize];
        let middle = self.junction(place);
        // The junctions of its ends stay, for a half of it leads to each.
        for ends in [[a, middle], [middle, b]] {
            let half = self.add(ends, attributes, is_bridge);
            self.pieces[half as usize].is_existing = is_existing;
        }
        self.remove(piece);
        middle
    }

    /// Takes a piece out, whose junctions stay.
    pub(crate) fn take_out(&mut self, piece: usize) {
        #[allow(clippy::cast_possible_truncation, reason = "pieces are limited far below")]
        let id = piece as PieceId;
        if !std::mem::replace(&mut self.pieces[piece].is_there, false) {
            return;
        }
        self.version += 1;
        self.piece_index.remove(&self.indexed(id));
        for end in self.pieces[piece].ends {
            self.junctions[end as usize].pieces.retain(|known| *known != id);
        }
    }

    /// Moves a junction without streets to a place.
    pub(crate) fn relocate(&mut self, junction: JunctionId, place: GridPlace) {
        let known = &mut self.junctions[junction as usize];
        let before = std::mem::replace(&mut known.place, place);
        self.junction_index.remove(&GeomWithData::new(before.metres().to_array(), junction));
        self.junction_index.insert(GeomWithData::new(place.metres().to_array(), junction));
    }

    /// Gives the streets of one junction to another one, which has none and takes its place.
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

    /// Tells if some of its streets existed before it grew.
    pub fn has_existing(&self) -> bool {
        self.has_existing
    }

    /// Tells if a piece lies on the ground, neither on a bridge over other streets nor in a tunnel.
    pub fn is_on_ground(&self, piece: PieceId) -> bool {
        self.pieces[piece as usize].attributes.level == 0
    }

    /// Tells if a street on the ground leads to a junction.
    pub(crate) fn has_ground(&self, junction: JunctionId) -> bool {
        self.junctions[junction as usize].pieces.iter().any(|piece| self.is_on_ground(*piece))
    }

    /// The pieces on the ground whose boxes come within `margin` (m) of a box around `line`.
    pub(crate) fn ground_near(&self, line: [DVec2; 2], margin: f64) -> impl Iterator<Item = PieceId> + '_ {
        self.pieces_near(line, margin).filter(|piece| self.is_on_ground(*piece))
    }

    /// The nearest piece on the ground to a place and its distance (m); `None` without any.
    pub fn nearest_on_ground(&self, place: DVec2) -> Option<(PieceId, f64)> {
        self.nearest_of_level(place, 0)
    }

    /// The nearest piece of a level to a place and its distance (m); `None` without any.
    pub(crate) fn nearest_of_level(&self, place: DVec2, level: i32) -> Option<(PieceId, f64)> {
        let place = place.to_array();
        let mut near = self.piece_index.nearest_neighbor_iter(&place);
        let found = near.find(|found| self.attributes(found.data).level == level)?;
        Some((found.data, found.distance_2(&place).sqrt()))
    }

    /// The widest street (m) so far.
    pub(crate) fn widest(&self) -> f64 {
        self.widest
    }

    /// The pieces whose boxes come within `margin` (m) of a box around `line`.
    pub(crate) fn pieces_near(&self, [a, b]: [DVec2; 2], margin: f64) -> impl Iterator<Item = PieceId> + '_ {
        let around = AABB::from_corners((a.min(b) - margin).to_array(), (a.max(b) + margin).to_array());
        self.piece_index.locate_in_envelope_intersecting(&around).map(|found| found.data)
    }

    /// The junctions within `margin` (m) of a box around `line`.
    pub(crate) fn junctions_near(
        &self,
        [a, b]: [DVec2; 2],
        margin: f64,
    ) -> impl Iterator<Item = JunctionId> + '_ {
        let around = AABB::from_corners((a.min(b) - margin).to_array(), (a.max(b) + margin).to_array());
        self.junction_index.locate_in_envelope(&around).map(|found| found.data)
    }

    /// The nearest piece to a place and its distance (m); `None` without any.
    pub fn nearest(&self, place: DVec2) -> Option<(PieceId, f64)> {
        let place = place.to_array();
        let found = self.piece_index.nearest_neighbor(&place)?;
        Some((found.data, found.distance_2(&place).sqrt()))
    }
}
