//! Surfaces of streets: carriageways, sidewalks with kerbs, medians, and the blocks between them.
//!
//! All surfaces share their corners, so there are no overlaps and no gaps. A sidewalk is the band between two lines
//! with the same number of points: the inner line is the kerb of the carriageway, and the outer line bounds the block.

use glam::{DVec2, DVec3};

use crate::corner::StreetLine;
use crate::faces::Course;
use crate::network::{JunctionId, PieceId, StreetNetwork};
use crate::profile::StreetProfiles;
use crate::rows::{PieceRows, alongs_of};
use crate::shape::{StreetShapes, is_same, without_repeats};
use burgeon_geometry::planar::edges;
use burgeon_geometry::{Line, Polygon, Rings};

/// Options for the surfaces of streets.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SurfaceOptions {
    /// Radius (m) of the turning circle at a dead end; no circle if it is less than half of the street's width.
    pub turning: f64,
}

/// Band along the streets around a face, or around the outside of the network.
#[derive(Debug, Clone, PartialEq)]
pub struct Sidewalk {
    /// Edge of the carriageway (m), with the face on its left.
    pub kerb: Vec<DVec3>,
    /// Edge of the block (m), with one point for each point of the kerb.
    pub edge: Vec<DVec3>,
    /// Set if the sidewalk surrounds an area enclosed by streets, counter-clockwise.
    pub is_around_block: bool,
}

/// Triangulated surface: the carriageway of a segment between its junctions, the carriageway of a junction, or a
/// median.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StreetSurface {
    /// Vertices (m).
    pub points: Vec<DVec3>,
    /// Triangles of vertex indices, counter-clockwise.
    pub triangles: Vec<[u32; 3]>,
    /// Street segment; `None` for a junction.
    pub piece: Option<PieceId>,
    /// Depth of the street in the hierarchy; for a junction, the minimum of its streets.
    pub depth: u32,
}

/// Raised median of a segment.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Median {
    /// Top surface, at the height of the street.
    pub top: StreetSurface,
    /// Kerb (m), with the median on its left; open where the median continues in the next segment.
    pub kerbs: Vec<Line<DVec3>>,
}

/// All surfaces of a network.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StreetSurfaces {
    /// Carriageways.
    pub carriageways: Vec<StreetSurface>,
    /// Sidewalks.
    pub sidewalks: Vec<Sidewalk>,
    /// Medians between the two directions.
    pub medians: Vec<Median>,
    /// Surfaces that replace the [sidewalks](Self::sidewalks) of overlapping streets.
    pub merged: MergedSurfaces,
}

/// Sidewalks of a network with existing streets, and its bridges over other streets.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MergedSurfaces {
    /// Sidewalks.
    pub walks: Vec<StreetSurface>,
    /// Edges (m) of carriageways, with the carriageway on the right.
    pub kerbs: Vec<[DVec3; 2]>,
    /// Edges (m) of streets on the ground, with the street on the right.
    pub edges: Vec<[DVec3; 2]>,
    /// Decks that carry streets over others.
    pub decks: Vec<StreetDeck>,
}

/// Deck that carries the streets of a level over those of lower levels.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StreetDeck {
    /// Top surface: carriageways and sidewalks.
    pub surface: StreetSurface,
    /// Edges (m), with the deck on their right, and true if the edge has a railing; there is none where the deck ends.
    pub sides: Vec<([DVec3; 2], bool)>,
    /// Positions of piers (m) at the height of the street, with the direction of the street.
    pub piers: Vec<(DVec3, DVec2)>,
}

impl StreetNetwork {
    /// Returns the surfaces of the streets, at the heights of `profiles`.
    pub fn surfaces(&self, options: SurfaceOptions, profiles: &StreetProfiles) -> StreetSurfaces {
        let shapes = StreetShapes::new(self, options.turning);
        let mut surfaces = StreetSurfaces::default();
        for (piece, known) in self.pieces().filter(|(_, piece)| piece.attributes.level >= 0) {
            let rows = PieceRows::new(&shapes, profiles, piece);
            // The medians of merged streets are on top of the carriageway.
            surfaces.medians.extend(rows.median());
            if !self.has_existing() {
                surfaces.carriageways.push(rows.carriageway());
            }
            debug_assert!(self.has_existing() || known.attributes.level == 0);
        }
        #[allow(clippy::cast_possible_truncation, reason = "pieces are limited far below")]
        for junction in (0..self.junctions.len() as JunctionId).filter(|_| !self.has_existing()) {
            surfaces.carriageways.extend(junction_surface(&shapes, profiles, junction));
        }
        if let Some(merged) = self.merged(self.merge_options(options, profiles)) {
            self.add_merged(&merged, profiles, &mut surfaces);
            return surfaces;
        }
        for way in self.ways() {
            let is_around_block = self.area(&way) > 0.0;
            let (kerb, edge) = sides(&shapes, profiles, &way).into_iter().unzip();
            surfaces.sidewalks.push(Sidewalk { kerb, edge, is_around_block });
        }
        surfaces
    }

    /// Returns the blocks: for each face its rings (m) inside the sidewalks, the outer one first, counter-clockwise.
    ///
    /// ```
    /// use burgeon_geometry::Polygon;
    /// use burgeon_streets::{Constraints, Obstacles, StreetAttributes, StreetNetwork, SurfaceOptions};
    /// use glam::DVec2;
    ///
    /// let mut network = StreetNetwork::new(Constraints { corner: 0.0, ..Constraints::default() }, Obstacles::default())?;
    /// let street = StreetAttributes { width: 20.0, ..StreetAttributes::default() };
    /// let mut end = network.begin(DVec2::ZERO)?;
    /// for to in [(200.0, 0.0), (200.0, 200.0), (0.0, 200.0), (0.0, 0.0)] {
    ///     end = network.grow(end, DVec2::from(to), street)?.end;
    /// }
    /// let blocks = network.blocks(SurfaceOptions::default());
    /// assert_eq!(blocks.len(), 1);
    /// assert!((Polygon::new(blocks[0].clone())?.area() - 180.0 * 180.0).abs() < 1e-6);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn blocks(&self, options: SurfaceOptions) -> Vec<Rings<DVec2>> {
        self.blocks_at(options, &StreetProfiles::default()).iter().map(Rings::flat).collect()
    }

    /// Returns the blocks at the heights of `profiles`.
    pub fn blocks_at(&self, options: SurfaceOptions, profiles: &StreetProfiles) -> Vec<Rings> {
        if let Some(merged) = self.merged(self.merge_options(options, profiles)) {
            return self.merged_blocks(&merged, profiles);
        }
        let shapes = StreetShapes::new(self, options.turning);
        let ring = |way: &[Course]| {
            let sides = sides(&shapes, profiles, way);
            let mut edge: Vec<DVec3> = sides.into_iter().map(|(_, edge)| edge).collect();
            without_repeats(&mut edge, |a, b| a.truncate() == b.truncate());
            edge
        };
        let faces = self.faces().into_iter();
        faces
            .map(|face| std::iter::once(&face.around).chain(&face.islands).map(|way| ring(way)).collect())
            .collect()
    }
}

/// Ground area below a segment, below a junction, or below the part of a segment before or after its bridge.
#[derive(Debug, Clone, PartialEq)]
pub struct StreetFooting {
    /// Centreline of a segment (m), or outline of a junction.
    pub line: Vec<DVec3>,
    /// Width (m) of a segment; 0 for a junction.
    pub width: f64,
    /// Street segment; `None` for a junction.
    pub piece: Option<PieceId>,
    /// Set if a bridge carries the street over this area.
    pub is_below: bool,
}

impl StreetNetwork {
    /// Returns the footings of the streets, including their sidewalks.
    pub fn footings(&self, options: SurfaceOptions, profiles: &StreetProfiles) -> Vec<StreetFooting> {
        let shapes = StreetShapes::new(self, options.turning);
        let mut footings = Vec::new();
        for (piece, known) in self.pieces().filter(|(_, piece)| piece.attributes.level == 0) {
            let [start, stop] = self.line(piece);
            let (way, length) = ((stop - start).normalize_or_zero(), start.distance(stop));
            let [first, last] = known.ends.map(|end| profiles.junction(end));
            let mut line = vec![(0.0, start.extend(first))];
            let between = profiles.stations(piece).iter();
            line.extend(between.map(|[along, height]| (*along, (start + way * *along).extend(*height))));
            line.push((length, stop.extend(last)));
            line.dedup_by(|a, b| is_same(a.1.truncate(), b.1.truncate()));
            // The footing before a bridge ends with a semicircle of the street's width.
            let half = known.attributes.width / 2.0;
            let carried = self
                .carried(piece)
                .map_or([length; 2], |[from, to]| [(from - half).max(0.0), (to + half).min(length)]);
            let parts = [([0.0, carried[0]], false), (carried, true), ([carried[1], length], false)];
            for ([from, to], is_below) in parts {
                if to - from < LEAST_FOOTING {
                    continue;
                }
                let at = |along: f64| (start + way * along).extend(profiles.along(piece, along));
                let mut part: Vec<DVec3> = Vec::new();
                part.extend((from > 0.0).then(|| at(from)));
                part.extend(line.iter().filter(|(along, _)| (from..=to).contains(along)).map(|(_, at)| *at));
                part.extend((to < length).then(|| at(to)));
                part.dedup_by(|a, b| is_same(a.truncate(), b.truncate()));
                footings.push(StreetFooting {
                    line: part,
                    width: known.attributes.width,
                    piece: Some(piece),
                    is_below,
                });
            }
        }
        #[allow(clippy::cast_possible_truncation, reason = "pieces are limited far below")]
        for junction in 0..self.junctions.len() as JunctionId {
            let shape = shapes.junction(junction);
            if shape.arms.is_empty() || shape.is_mitred {
                continue;
            }
            if self.has_existing() {
                footings.extend(self.round_footing(junction, profiles));
                continue;
            }
            let mut line = outline(&shapes, junction, StreetLine::Edge);
            let height = profiles.junction(junction);
            let line = line.drain(..).map(|at| at.extend(height)).collect();
            footings.push(StreetFooting { line, width: 0.0, piece: None, is_below: false });
        }
        footings
    }
}

/// Minimum length (m) of a part of a segment with its own footing.
const LEAST_FOOTING: f64 = 0.1;

/// Returns the line around a junction (m), counter-clockwise.
pub(crate) fn outline(shapes: &StreetShapes<'_>, junction: JunctionId, line: StreetLine) -> Vec<DVec2> {
    let mut outline = Vec::new();
    for (index, arm) in shapes.junction(junction).arms.iter().enumerate() {
        let half = arm.arm.aside(line);
        outline.extend([-half, half].map(|aside| shapes.end(junction, arm.piece, aside)));
        let [edge, kerb] = shapes.corner(junction, index);
        outline.extend(if line == StreetLine::Edge { edge } else { kerb });
    }
    without_repeats(&mut outline, |a, b| a == b);
    outline
}

/// Returns the surface between the ends of the streets at a junction.
fn junction_surface(
    shapes: &StreetShapes<'_>,
    profiles: &StreetProfiles,
    junction: JunctionId,
) -> Option<StreetSurface> {
    let shape = shapes.junction(junction);
    if shape.arms.is_empty() || shape.is_mitred {
        return None;
    }
    let outline = outline(shapes, junction, StreetLine::Kerb);
    let middle = match &shape.arms[..] {
        // The end of a street is a semicircle, whose centre is on its edge.
        [arm] => shapes.network.at(junction) - arm.arm.way * (arm.arm.aside(StreetLine::Kerb) / 4.0),
        _ => shapes.network.at(junction),
    };
    let height = profiles.junction(junction);
    let is_around = edges(&outline).all(|[a, b]| (a - middle).perp_dot(b - middle) > 0.0);
    let divided = if is_around { None } else { divided(&outline) };
    let (points, triangles) = divided.unwrap_or_else(|| fan(middle, outline));
    let points = points.into_iter().map(|at| at.extend(height)).collect();
    let depths = shape.arms.iter().map(|arm| shapes.network.attributes(arm.piece).depth);
    Some(StreetSurface { points, triangles, piece: None, depth: depths.min().unwrap_or_default() })
}

/// Points (m) and triangles, counter-clockwise.
type PlaneTriangles = (Vec<DVec2>, Vec<[u32; 3]>);

/// Returns the triangles between a point (m) and the outline around it.
fn fan(middle: DVec2, outline: Vec<DVec2>) -> PlaneTriangles {
    #[allow(clippy::cast_possible_truncation, reason = "some dozens of points")]
    let count = outline.len() as u32;
    let triangles = (0..count).map(|index| [0, 1 + index, 1 + (index + 1) % count]).collect();
    (std::iter::once(middle).chain(outline).collect(), triangles)
}

/// Triangulates an outline (m); `None` if it intersects itself.
fn divided(outline: &[DVec2]) -> Option<PlaneTriangles> {
    let polygon = Polygon::new(Rings(vec![outline.to_vec()])).ok()?;
    #[allow(clippy::cast_possible_truncation, reason = "some dozens of points")]
    let triangles = polygon.triangles().ok()?.into_iter().map(|corners| corners.map(|corner| corner as u32));
    Some((polygon.points().collect(), triangles.collect()))
}

/// Returns the kerb along a walk and the edge of the area on its left, as pairs of points.
fn sides(shapes: &StreetShapes<'_>, profiles: &StreetProfiles, way: &[Course]) -> Vec<(DVec3, DVec3)> {
    let network = shapes.network;
    let mut pairs: Vec<(DVec2, DVec2, f64)> = Vec::new();
    for course in way {
        let (piece, from, to) = (course.piece, course.from, network.across(course.piece, course.from));
        let arm = network.attributes(piece).arm(DVec2::ZERO);
        let [kerb, edge] = [StreetLine::Kerb, StreetLine::Edge].map(|line| arm.aside(line));
        // The face is on the left of the course.
        let end = |junction, sign: f64| {
            let [kerb, edge] = [kerb, edge].map(|aside| shapes.end(junction, piece, sign * aside));
            (kerb, edge, profiles.junction(junction))
        };
        pairs.push(end(from, 1.0));
        let (rows, _) = alongs_of(shapes, profiles, piece);
        let [start, stop] = network.line(piece);
        let (along, aside) = ((stop - start).normalize_or_zero(), network.leaves(piece, from).perp());
        let between = |at: &f64| {
            let middle = start + along * *at;
            (middle + aside * kerb, middle + aside * edge, profiles.along(piece, *at))
        };
        if network.ends(piece)[0] == from {
            pairs.extend(rows.iter().map(between));
        } else {
            pairs.extend(rows.iter().rev().map(between));
        }
        pairs.push(end(to, -1.0));
        // The corner at the end of the course is between the next course and this one.
        let arms = &shapes.junction(to).arms;
        if let (Some(index), false) =
            (arms.iter().position(|arm| arm.piece == piece), shapes.junction(to).is_mitred)
        {
            let before = (index + arms.len() - 1) % arms.len();
            let [edge, kerb] = shapes.corner(to, before);
            let height = profiles.junction(to);
            pairs.extend(kerb.into_iter().zip(edge).rev().map(|(kerb, edge)| (kerb, edge, height)));
        }
    }
    // A pair is omitted if both of its points repeat the previous pair.
    without_repeats(&mut pairs, |a, b| a.0 == b.0 && a.1 == b.1);
    pairs.into_iter().map(|(kerb, edge, height)| (kerb.extend(height), edge.extend(height))).collect()
}
