//! Footings: the ground below streets, bridges left out.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::junctions::outline;
use super::parts::{StreetFooting, SurfaceOptions};
use crate::plan::corner::StreetLine;
use crate::plan::network::{JunctionId, StreetNetwork};
use crate::shape::profile::StreetProfiles;
use crate::shape::shapes::{StreetShapes, is_same};

/// Minimum length (m) of a part of a segment with its own footing.
const LEAST_FOOTING: f64 = 0.1;

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
                .carried_range(piece)
                .map_or([length; 2], |[from, to]| [(from - half).max(0.0), (to + half).min(length)]);
            let parts = [([0.0, carried[0]], false), (carried, true), ([carried[1], length], false)];
            for ([from, to], is_below) in parts {
                if to - from < LEAST_FOOTING {
                    continue;
                }
                let at = |along: f64| (start + way * along).extend(profiles.height_along(piece, along));
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

    /// Returns the footing of a junction: a circle with the diameter of its widest street on the ground.
    fn round_footing(&self, junction: JunctionId, profiles: &StreetProfiles) -> Option<StreetFooting> {
        let pieces = self.junctions[junction as usize].pieces.iter();
        let halves = pieces.filter(|piece| self.is_on_ground(**piece)).map(|piece| self.half(*piece));
        let radius = halves.fold(0.0, f64::max);
        let (at, height) = (self.at(junction), profiles.junction(junction));
        let corner =
            |index: u32| (at + DVec2::from_angle(TAU * f64::from(index) / 12.0) * radius).extend(height);
        let line = (0..12).map(corner).collect();
        (radius > 0.0).then_some(StreetFooting { line, width: 0.0, piece: None, is_below: false })
    }
}
