//! Beds: constraints of objects on the ground, which is level with the bed and limited in slope next to it.

use std::ops::Range;

use burgeon_geometry::planar::{contains, foot};
use glam::DVec2;
use serde::{Deserialize, Serialize};

/// The bed of a street, or of another narrow or flat object.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GroundBed {
    /// Centreline (m) with heights; for an area, its outline.
    pub line: Vec<[f64; 3]>,
    /// Width (m); an area extends beyond its outline by half of it.
    pub width: f64,
    /// Set if the line is the outline of an area.
    pub is_area: bool,
    /// Maximum slope (m/m) of the ground next to the bed.
    pub slope: f64,
    /// Distance (m) from the bed within which the ground changes.
    pub margin: f64,
}

impl GroundBed {
    pub(crate) fn reach(&self) -> f64 {
        self.width / 2.0 + self.margin
    }

    /// Returns the segments of the line to search: all of an area, `near` of a path.
    pub(crate) fn segments(&self, near: Range<usize>) -> Range<usize> {
        if self.is_area { 0..self.line.len() } else { near }
    }

    /// Returns the distance (m) of a point from the bed and the bed's height (m) at its nearest point; `None`
    /// beyond the margin. The other segments than `segments` must be beyond the margin.
    pub(crate) fn distance_beside(&self, place: DVec2, segments: Range<usize>) -> Option<(f64, f64)> {
        let (mut distance, piece, along) = to_line(&self.line, place, segments);
        let next = self.line.get((piece + 1) % self.line.len().max(1));
        let height = match (self.line.get(piece), next) {
            (Some(from), Some(to)) => mix(from[2], to[2], along),
            _ => return None,
        };
        if self.is_area {
            let outline: Vec<[f64; 2]> = self.line.iter().map(|[x, y, _]| [*x, *y]).collect();
            if contains(&outline, place) {
                distance = 0.0;
            }
        }
        let beyond = (distance - self.width / 2.0).max(0.0);
        (beyond <= self.margin).then_some((beyond, height))
    }
}

/// Interpolates between two heights (m).
pub(crate) fn mix(a: f64, b: f64, part: f64) -> f64 {
    // At full strength the result is exactly the new height.
    if part >= 1.0 { b } else { a + (b - a) * part }
}

/// Returns the distance (m) of `place` from segments of a line, the index of the nearest segment, and the position (0 to
/// 1) along it. The segment after the last point ends at the first point. Positions begin with x and y (m).
pub(crate) fn to_line<const N: usize>(
    points: &[[f64; N]],
    place: DVec2,
    segments: Range<usize>,
) -> (f64, usize, f64) {
    let mut best = (f64::INFINITY, 0, 0.0);
    for piece in segments {
        let edge = [points[piece], points[(piece + 1) % points.len()]].map(|at| DVec2::new(at[0], at[1]));
        let along = foot(edge, place);
        let distance = place.distance(edge[0] + (edge[1] - edge[0]) * along);
        if distance < best.0 {
            best = (distance, piece, along);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use burgeon_base::random::Stream;

    use super::super::edit::Edit;
    use super::super::local_edits::LocalEdits;
    use super::*;

    /// Returns random beds of paths and areas within 200 m of the origin.
    fn beds(stream: &mut Stream) -> Vec<GroundBed> {
        let mut bed = |index: u32| {
            let mut number = |reach: f64| (stream.uniform() * 2.0 - 1.0) * reach;
            let (x, y, z) = (number(200.0), number(200.0), number(8.0));
            let is_area = index.is_multiple_of(3);
            let line = if is_area {
                [(0.0, 0.0), (30.0, 4.0), (26.0, 22.0), (-3.0, 18.0)].map(|(a, b)| [x + a, y + b, z]).to_vec()
            } else {
                vec![[x, y, z], [x + 60.0, y + number(40.0), z + number(5.0)], [x + 90.0, y, z]]
            };
            GroundBed { line, width: 9.0, is_area, slope: 0.6, margin: 50.0 }
        };
        (0..12).map(&mut bed).collect()
    }

    #[test]
    fn the_ground_is_nowhere_above_a_bed_and_falls_to_it_gently() {
        let mut stream = Stream::new(11);
        let mut met = 0;
        for _ in 0..40 {
            let beds = beds(&mut stream);
            let mut edits: Vec<Edit> = beds.iter().map(|bed| Edit::Embank { bed: bed.clone() }).collect();
            edits.extend(beds.iter().map(|bed| Edit::Excavate { bed: bed.clone() }));
            let text = serde_json::to_string(&edits).unwrap();
            assert_eq!(serde_json::from_str::<Vec<Edit>>(&text).unwrap().len(), edits.len());
            let local = LocalEdits::new(edits.clone(), DVec2::splat(-250.0), DVec2::splat(250.0));
            for _ in 0..400 {
                let place = DVec2::new(stream.uniform() - 0.5, stream.uniform() - 0.5) * 500.0;
                let ground = 12.0 * (place.x / 40.0).sin();
                let height = local.at(place, ground);
                let one_by_one = edits
                    .iter()
                    .fold(ground, |height, edit| edit.change(place, height, 0..edit.extents().len()));
                assert_eq!(height.to_bits(), one_by_one.to_bits(), "at {place}");
                let beside =
                    |bed: &GroundBed| bed.distance_beside(place, bed.segments(0..bed.line.len() - 1));
                let near: Vec<(f64, f64)> = beds.iter().filter_map(beside).collect();
                for (beyond, level) in &near {
                    assert!(height <= level + 0.6 * beyond + 1e-9);
                }
                if let [(beyond, level)] = near[..] {
                    met += 1;
                    assert!((height - level).abs() <= 0.6 * beyond + 1e-9, "{height} beside {level}");
                }
            }
        }
        assert!(met > 1000, "{met} places beside one bed alone");
    }
}
