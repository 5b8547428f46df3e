//! The surfaces of streets: carriageways, sidewalks with kerbs, and the blocks between them.
//!
//! All of them share their corners, so nothing overlaps and nothing is left open: a sidewalk is the band between two
//! lines with as many points, of which the inner one is the kerb of the carriageway and the outer one bounds the block.

use glam::DVec2;
use smallvec::SmallVec;

use crate::corner::{Arm, Corner};
use crate::faces::Course;
use crate::network::{JunctionId, PieceId, StreetNetwork};
use burgeon_geometry::Rings;

/// How streets are made of their lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceOptions {
    /// Width (m) of sidewalks, on both sides; less on streets that are too narrow.
    pub sidewalk: f64,
    /// The radius (m) of the circle to turn in at a dead end; none if it is less than half of the street.
    pub turning: f64,
}

impl Default for SurfaceOptions {
    fn default() -> Self {
        Self { sidewalk: 2.5, turning: 0.0 }
    }
}

/// A band along the streets around a face, or around the outside.
#[derive(Debug, Clone, PartialEq)]
pub struct Sidewalk {
    /// The edge of the carriageway (m), with the face on its left.
    pub kerb: Vec<DVec2>,
    /// The edge of the block (m): a point for each of the kerb.
    pub edge: Vec<DVec2>,
    /// Whether it goes around an area that streets enclose, counter-clockwise.
    pub is_around_block: bool,
}

/// The carriageway of a piece between the corners of its junctions, or of a junction.
#[derive(Debug, Clone, PartialEq)]
pub struct Carriageway {
    /// Its outline (m), counter-clockwise.
    pub outline: Vec<DVec2>,
    /// A place (m) that sees all of the outline.
    pub middle: DVec2,
    /// The piece that it is of; none of a junction.
    pub piece: Option<PieceId>,
}

/// All surfaces of a network.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StreetSurfaces {
    /// Where vehicles are.
    pub carriageways: Vec<Carriageway>,
    /// Where people walk.
    pub sidewalks: Vec<Sidewalk>,
}

impl StreetNetwork {
    /// The surfaces of its streets.
    pub fn surfaces(&self, options: SurfaceOptions) -> StreetSurfaces {
        let mut surfaces = StreetSurfaces::default();
        for (piece, _) in self.pieces() {
            let [from, to] = self.ends(piece);
            let [[right, left], [far_left, far_right]] =
                [from, to].map(|end| self.piece_end(end, piece, options));
            surfaces.carriageways.push(Carriageway {
                outline: vec![right, far_right, far_left, left],
                middle: (right + left + far_left + far_right) / 4.0,
                piece: Some(piece),
            });
        }
        #[allow(clippy::cast_possible_truncation, reason = "pieces are limited far below")]
        for junction in 0..self.junctions.len() as JunctionId {
            surfaces.carriageways.extend(self.junction_surface(junction, options));
        }
        for way in self.ways() {
            let is_around_block = self.area(&way) > 0.0;
            let [kerb, edge] = self.edges_of(&way, options);
            surfaces.sidewalks.push(Sidewalk { kerb, edge, is_around_block });
        }
        surfaces
    }

    /// The blocks: for each face its rings (m), the outer one counter-clockwise first, inside of the sidewalks.
    pub fn blocks(&self, options: SurfaceOptions) -> Vec<Rings<DVec2>> {
        let ring = |way: &[Course]| {
            let [_, mut edge] = self.edges_of(way, options);
            without_repeats(&mut edge);
            edge
        };
        let faces = self.faces().into_iter();
        faces
            .map(|face| std::iter::once(&face.around).chain(&face.islands).map(|way| ring(way)).collect())
            .collect()
    }

    /// The width (m) of the carriageway of a piece.
    pub fn carriageway(&self, piece: PieceId, options: SurfaceOptions) -> f64 {
        2.0 * (self.half(piece) - self.sidewalk(piece, options))
    }

    /// How far (m) from one of its junctions the carriageway of a piece begins, behind all corners.
    pub fn begins(&self, junction: JunctionId, piece: PieceId, options: SurfaceOptions) -> f64 {
        self.arm_reach(junction, piece, options)
    }

    /// The width (m) of the sidewalks of a piece.
    fn sidewalk(&self, _: PieceId, options: SurfaceOptions) -> f64 {
        // Corners are round by one circle for both streets, so all sidewalks are as wide as the narrowest street lets them.
        options.sidewalk.min(self.narrowest() / 2.0 * 0.45)
    }

    /// The corners of a junction, each from an arm to the next one counter-clockwise.
    fn corners_at(&self, junction: JunctionId, options: SurfaceOptions) -> SmallVec<[(PieceId, Corner); 6]> {
        let arms = self.corner_arms(junction);
        if let [(piece, arm)] = arms[..] {
            // The circle leaves the other end of the piece its corners, and its own circle.
            let far = self.across(piece, junction);
            let room = match self.junctions[far as usize].degree() {
                1 => self.length(piece) * 0.45,
                _ => (self.length(piece) - self.reach_at(far, piece)) * 0.9,
            };
            let radius = options.turning.min(room.hypot(arm.half));
            return SmallVec::from_iter([(piece, Corner::around(arm, radius))]);
        }
        let next = |index: usize| arms[(index + 1) % arms.len()].1;
        let corners = arms.iter().enumerate().map(|(index, (piece, arm))| {
            let pair: [Arm; 2] = [*arm, next(index)];
            (*piece, Corner::new(pair, self.constraints.corner))
        });
        corners.collect()
    }

    /// How far (m) from a junction the carriageway of one of its pieces begins.
    fn arm_reach(&self, junction: JunctionId, piece: PieceId, options: SurfaceOptions) -> f64 {
        let corners = self.corners_at(junction, options);
        let Some(index) = corners.iter().position(|(arm, _)| *arm == piece) else { return 0.0 };
        let before = (index + corners.len() - 1) % corners.len();
        corners[index].1.reaches[0].max(corners[before].1.reaches[1])
    }

    /// Where the kerbs of a piece end at one of its junctions (m): on the right and on the left as it leaves.
    fn piece_end(&self, junction: JunctionId, piece: PieceId, options: SurfaceOptions) -> [DVec2; 2] {
        let corners = self.corners_at(junction, options);
        let (at, inside) = (self.at(junction), self.sidewalk(piece, options));
        if is_mitred(&corners)
            && let Some(index) = corners.iter().position(|(arm, _)| *arm == piece)
        {
            return [1 - index, index].map(|corner| at + corners[corner].1.points(inside)[0]);
        }
        let way = self.leaves(piece, junction);
        let aside = way.perp() * (self.half(piece) - inside);
        let start = at + way * self.arm_reach(junction, piece, options);
        [start - aside, start + aside]
    }

    fn junction_surface(&self, junction: JunctionId, options: SurfaceOptions) -> Option<Carriageway> {
        let corners = self.corners_at(junction, options);
        if corners.is_empty() || is_mitred(&corners) {
            return None;
        }
        let middle = self.at(junction);
        let mut outline = Vec::new();
        for (piece, corner) in &corners {
            let inside = self.sidewalk(*piece, options);
            let half = self.half(*piece) - inside;
            let way = self.leaves(*piece, junction);
            let reach = self.arm_reach(junction, *piece, options);
            outline.extend([-1.0, 1.0].map(|side| middle + way * reach + way.perp() * half * side));
            outline.extend(corner.points(inside).into_iter().map(|at| middle + at));
        }
        without_repeats(&mut outline);
        let middle = match corners[..] {
            // The end of a street is half a circle, whose center lies on its edge.
            [(piece, _)] => middle - self.leaves(piece, junction) * (self.half(piece) / 4.0),
            _ => middle,
        };
        Some(Carriageway { outline, middle, piece: None })
    }

    /// The kerb around a way, and the edge of what lies on its left.
    fn edges_of(&self, way: &[Course], options: SurfaceOptions) -> [Vec<DVec2>; 2] {
        let mut lines = [Vec::new(), Vec::new()];
        for course in way {
            let (piece, to) = (course.piece, self.across(course.piece, course.from));
            let (from_at, to_at) = (self.at(course.from), self.at(to));
            let along = (to_at - from_at).normalize_or_zero();
            let [start, end] = [course.from, to].map(|junction| {
                let corners = self.corners_at(junction, options);
                (!is_mitred(&corners)).then(|| self.arm_reach(junction, piece, options))
            });
            let inside = self.sidewalk(piece, options);
            // The face is on the left of the course, and the corner at its end leads from the next course to it.
            let corners = self.corners_at(to, options);
            let corner = corners.iter().position(|(arm, _)| *arm == piece).map(|index| {
                let before = (index + corners.len() - 1) % corners.len();
                corners[before].1
            });
            for (line, inside) in lines.iter_mut().zip([inside, 0.0]) {
                let aside = along.perp() * (self.half(piece) - inside);
                line.extend(start.map(|start| from_at + along * start + aside));
                line.extend(end.map(|end| to_at - along * end + aside));
                if let Some(corner) = &corner {
                    line.extend(corner.points(inside).into_iter().rev().map(|at| to_at + at));
                }
            }
        }
        let [kerb, edge] = lines;
        // A pair is left out where both of its places repeat the pair before.
        let mut pairs: Vec<(DVec2, DVec2)> = kerb.into_iter().zip(edge).collect();
        let same =
            |a: &(DVec2, DVec2), b: &(DVec2, DVec2)| a.0.distance(b.0) < 1e-6 && a.1.distance(b.1) < 1e-6;
        pairs.dedup_by(|a, b| same(a, b));
        while pairs.len() > 1 && same(&pairs[0], &pairs[pairs.len() - 1]) {
            pairs.pop();
        }
        let (kerb, edge) = pairs.into_iter().unzip();
        [kerb, edge]
    }
}

/// Whether a street only turns a little at a junction, where its pieces meet without a surface between them.
fn is_mitred(corners: &[(PieceId, Corner)]) -> bool {
    corners.len() == 2 && corners.iter().all(|(_, corner)| corner.is_sharp())
}

fn without_repeats(ring: &mut Vec<DVec2>) {
    ring.dedup_by(|a, b| a.distance(*b) < 1e-6);
    while ring.len() > 1 && ring[0].distance(ring[ring.len() - 1]) < 1e-6 {
        ring.pop();
    }
}
