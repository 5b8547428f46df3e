//! Ground areas covered by streets and sidewalks, where the terrain itself is hidden.

use glam::{DVec2, DVec3};

use super::junctions::outline;
use super::parts::SurfaceOptions;
use crate::plan::corner::StreetLine;
use crate::plan::network::{JunctionId, PieceId, StreetNetwork};
use crate::shape::profile::StreetProfiles;
use crate::shape::shapes::{StreetShapes, is_same};

/// Area of a segment, of a junction, or of the part of a segment before or after its bridge.
#[derive(Debug, Clone, PartialEq)]
pub struct StreetArea {
    /// Outline (m), counter-clockwise: outer edges of the sidewalks, and lines shared with adjacent areas.
    pub outline: Vec<DVec2>,
    /// Line (m) that defines the heights; the area is level across it. Centreline of a segment, or one point of a
    /// junction.
    pub line: Vec<DVec3>,
}

impl StreetNetwork {
    /// Returns the areas that streets cover on the ground; the spans carried by bridges are excluded.
    ///
    /// Adjacent areas share the corners of their outlines, so there are no gaps between them.
    pub fn ground_areas(&self, options: SurfaceOptions, profiles: &StreetProfiles) -> Vec<StreetArea> {
        let shapes = StreetShapes::new(self, options.turning);
        let mut areas = Vec::new();
        for (piece, known) in self.pieces() {
            let half = self.attributes(piece).arm(DVec2::ZERO).aside(StreetLine::Edge);
            let (line, length) = (self.profile_line(profiles, piece), self.length(piece));
            let [first, last] = known.ends.map(|end| {
                // The right and the left end, as seen from the junction along the segment.
                [-half, half].map(|aside| shapes.end(end, piece, aside))
            });
            let corners = [first[0], last[1], last[0], first[1]];
            match self.carried_range(piece) {
                None => areas.push(StreetArea { outline: corners.to_vec(), line }),
                Some([from, to]) => {
                    let [start, stop] = self.line(piece);
                    let way = (stop - start).normalize_or_zero();
                    let across =
                        |along: f64| [-half, half].map(|aside| start + way * along + way.perp() * aside);
                    let ([a, b], [c, d]) = (across(from), across(to));
                    let parts =
                        [([0.0, from], [first[0], a, b, first[1]]), ([to, length], [c, last[1], last[0], d])];
                    for ([low, high], outline) in parts {
                        let along = |at: &DVec3| way.dot(at.truncate() - start);
                        let at =
                            |along: f64| (start + way * along).extend(profiles.height_along(piece, along));
                        let mut line: Vec<DVec3> = line
                            .iter()
                            .copied()
                            .filter(|place| (low..=high).contains(&along(place)))
                            .collect();
                        if low > 0.0 {
                            line.insert(0, at(low));
                        } else {
                            line.push(at(high));
                        }
                        if is_ahead(outline, way) {
                            areas.push(StreetArea { outline: outline.to_vec(), line });
                        }
                    }
                }
            }
        }
        #[allow(clippy::cast_possible_truncation, reason = "pieces are limited far below")]
        for junction in 0..self.junctions.len() as JunctionId {
            let shape = shapes.junction(junction);
            if shape.arms.is_empty() || shape.is_mitred {
                continue;
            }
            let line = vec![self.at(junction).extend(profiles.junction(junction))];
            areas.push(StreetArea { outline: outline(&shapes, junction, StreetLine::Edge), line });
        }
        areas
    }

    /// Returns the centreline (m) of a segment, with heights at both ends and at each change of slope.
    pub(crate) fn profile_line(&self, profiles: &StreetProfiles, piece: PieceId) -> Vec<DVec3> {
        let [start, stop] = self.line(piece);
        let way = (stop - start).normalize_or_zero();
        let [first, last] = self.ends(piece).map(|end| profiles.junction(end));
        let mut line = vec![start.extend(first)];
        let stations = profiles.stations(piece).iter();
        line.extend(stations.map(|[along, height]| (start + way * *along).extend(*height)));
        line.push(stop.extend(last));
        line.dedup_by(|a, b| is_same(a.truncate(), b.truncate()));
        line
    }
}

/// Returns true if the part of a segment before or after a bridge is not empty: its far side is ahead of its near side.
fn is_ahead([a, b, c, d]: [DVec2; 4], way: DVec2) -> bool {
    way.dot(b - a).min(way.dot(c - d)) > 1e-3
}
