//! Surfaces of streets: carriageways, sidewalks with kerbs, medians, and the blocks between them.
//!
//! All surfaces share their corners, so there are no overlaps and no gaps. A sidewalk is the band between two lines
//! with the same number of points: the inner line is the kerb of the carriageway, and the outer line bounds the block.

use glam::{DVec2, DVec3};

use super::junctions::junction_surface;
use super::parts::{Sidewalk, StreetSurfaces, SurfaceOptions};
use super::rows::{PieceRows, alongs_of};
use crate::plan::corner::StreetLine;
use crate::plan::faces::Course;
use crate::plan::network::{JunctionId, StreetNetwork};
use crate::shape::profile::StreetProfiles;
use crate::shape::shapes::{StreetShapes, without_repeats};
use burgeon_geometry::Rings;

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
        if let Some(merged) = self.merge_levels(self.merge_options(options, profiles)) {
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
        if let Some(merged) = self.merge_levels(self.merge_options(options, profiles)) {
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
            (middle + aside * kerb, middle + aside * edge, profiles.height_along(piece, *at))
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
