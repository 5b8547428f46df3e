//! Rings of points: the cross-section at the stations of a sweep.

use glam::{DVec2, DVec3, Vec3};

use smallvec::SmallVec;

use super::path::Station;
use crate::cross_section::section::Section;
use crate::frame::Frame;
use crate::limits::{FEW, MOST, NOTHING};
use burgeon_base::error::{Error, Result};

/// Minimum reach (m) of a section from its axis: a smaller section collapses onto the axis, so that no face
/// is a sliver.
const LEAST_REACH: f64 = 1e-6;

/// Position, scale and twist of the section, relative to the path segment before or after a ring.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pose {
    pub(super) frame: Frame,
    pub(super) scale: DVec2,
    pub(super) twist: f64,
}

impl Pose {
    /// Returns the directions of the section's x and y.
    pub(super) fn axes(&self) -> (DVec3, DVec3) {
        let mut frame = self.frame;
        if self.twist != 0.0 {
            frame.roll(self.twist);
        }
        (-frame.left, -frame.up)
    }
}

/// The section at one position.
#[derive(Debug)]
pub(super) struct SectionRing {
    /// Number of the station, counted from 1.
    pub(super) station: usize,
    /// Pose for the path segment that ends here; its heading differs from that of `after` at a mitre.
    pub(super) before: Pose,
    /// Pose for the path segment that begins here.
    pub(super) after: Pose,
    /// Normal of the ring's plane, along the path.
    pub(super) normal: DVec3,
    /// Points (m), in the section's order.
    pub(super) exact: SmallVec<[DVec3; FEW]>,
    /// Points (m) at export precision.
    pub(super) points: SmallVec<[Vec3; FEW]>,
    /// Marks a sharp edge along the ring.
    pub(super) sharp: bool,
}

impl SectionRing {
    /// Returns true if the section has shrunk to one point.
    pub(super) fn is_apex(&self) -> bool {
        self.after.scale == DVec2::ZERO
    }

    /// Returns true if the section has an area.
    pub(super) fn is_full(&self) -> bool {
        self.after.scale.x != 0.0 && self.after.scale.y != 0.0
    }

    /// Returns the position (m) of the section's origin.
    pub(super) fn centre(&self) -> DVec3 {
        self.after.frame.position
    }

    fn is_at(&self, other: &SectionRing) -> bool {
        let pairs = self.exact.iter().zip(&other.exact);
        pairs.into_iter().all(|(a, b)| a.distance_squared(*b) <= NOTHING * NOTHING)
    }
}

/// Returns the rings of `section` at all `stations`, with one ring for coincident stations.
///
/// A mitre joins stations at one position with different headings: their rings lie in the plane halfway
/// between. If `closed`, the last and the first station are joined as well, and a last ring that repeats the
/// first is omitted. Fails if a value is not finite or if the path turns back on itself.
pub(super) fn rings(section: &Section, stations: &[Station], closed: bool) -> Result<Vec<SectionRing>> {
    for (index, station) in stations.iter().enumerate() {
        refuse_infinite(index + 1, station)?;
    }
    let reach = section.reach();
    let mut rings: Vec<SectionRing> = Vec::with_capacity(stations.len());
    for (group, normal) in groups(stations, closed) {
        for index in group {
            let ring = ring(section, reach, index + 1, &stations[index], normal)?;
            match rings.last_mut() {
                Some(last) if last.is_at(&ring) => {
                    last.after = ring.after;
                    last.sharp |= ring.sharp;
                }
                _ => rings.push(ring),
            }
        }
    }
    if closed
        && rings.len() > 2
        && rings[0].is_at(&rings[rings.len() - 1])
        && let Some(last) = rings.pop()
    {
        rings[0].before = last.before;
        rings[0].sharp |= last.sharp;
    }
    Ok(rings)
}

/// Groups consecutive stations at one position, each with the normal of its plane.
fn groups(stations: &[Station], closed: bool) -> impl Iterator<Item = (std::ops::Range<usize>, DVec3)> {
    let apart = |a: usize, b: usize| {
        let [a, b] = [a, b].map(|index| stations[index].frame.position);
        a.distance_squared(b) > NOTHING * NOTHING
    };
    let mut groups: SmallVec<[_; 2]> = SmallVec::new();
    let mut start = 0;
    for end in 1..=stations.len() {
        if end == stations.len() || apart(start, end) {
            groups.push((start..end, stations[start].frame.heading, stations[end - 1].frame.heading));
            start = end;
        }
    }
    let count = groups.len();
    if closed && count > 1 && !apart(0, stations.len() - 1) {
        groups[0].1 = groups[count - 1].1;
        groups[count - 1].2 = groups[0].2;
    }
    groups.into_iter().map(|(range, before, after)| (range, (before + after).normalize_or_zero()))
}

fn ring(
    section: &Section,
    reach: DVec2,
    number: usize,
    station: &Station,
    normal: DVec3,
) -> Result<SectionRing> {
    let squeeze = |scale: f64, reach: f64| if scale.abs() * reach <= LEAST_REACH { 0.0 } else { scale };
    let scale = DVec2::new(squeeze(station.scale.x, reach.x), squeeze(station.scale.y, reach.y));
    let pose = Pose { frame: station.frame, scale, twist: station.twist };
    let Frame { position, heading, .. } = station.frame;
    let slope = heading.dot(normal);
    // A mitre of 160 degrees is already six times as long as the section is wide.
    if slope < 0.17 {
        return Err(Error::geometry(format!("the path turns back on itself at station {number}"))
            .help("turn in several steps with a length between them, or begin a new run"));
    }
    let (x, y) = pose.axes();
    let place = |point: DVec2| {
        let offset = x * (scale.x * point.x) + y * (scale.y * point.y);
        position + offset - heading * (offset.dot(normal) / slope)
    };
    let straight = slope > 1.0 - 1e-15;
    let exact: SmallVec<[DVec3; FEW]> = if straight {
        section.points().map(|point| position + x * (scale.x * point.x) + y * (scale.y * point.y)).collect()
    } else {
        section.points().map(place).collect()
    };
    let points = exact.iter().copied().map(snap).collect();
    Ok(SectionRing {
        station: number,
        before: pose,
        after: pose,
        normal,
        exact,
        points,
        sharp: station.sharp,
    })
}

/// Returns the point (m) at export precision, on a grid with the resolution of f32 at one metre.
///
/// Without the grid, equal points would differ by rounding errors near 0, where f32 is finer.
fn snap(point: DVec3) -> Vec3 {
    const GRID: f64 = (1 << 24) as f64;
    // Adding 0 turns -0 into 0.
    (round(point * GRID) / GRID + DVec3::ZERO).as_vec3()
}

/// Rounds like `f64::round`, which calls a system library function on baseline processors; numbers must fit
/// into i64.
fn round(vector: DVec3) -> DVec3 {
    #[allow(clippy::cast_possible_truncation, reason = "the fraction is put back")]
    let round = |number: f64| {
        let whole = number as i64 as f64;
        if (number - whole).abs() < 0.5 { whole } else { whole + 1f64.copysign(number) }
    };
    DVec3::new(round(vector.x), round(vector.y), round(vector.z))
}

fn refuse_infinite(number: usize, station: &Station) -> Result<()> {
    let Frame { position, heading, left, up } = station.frame;
    let vectors = [
        ("position", position),
        ("heading", heading),
        ("left axis", left),
        ("up axis", up),
        ("scale", station.scale.extend(0.0)),
        ("twist", DVec3::splat(station.twist)),
    ];
    let Some((name, value)) = vectors.into_iter().find(|(_, value)| !is_usable(*value)) else {
        return Ok(());
    };
    let text = match name {
        "twist" => format!("{}", value.x),
        "scale" => format!("({}, {})", value.x, value.y),
        _ => format!("({}, {}, {})", value.x, value.y, value.z),
    };
    Err(Error::geometry(format!("the {name} of station {number} is {text}")).help("give numbers up to 1e9"))
}

/// Returns true if all components are finite and at most [`MOST`].
fn is_usable(value: DVec3) -> bool {
    value.is_finite() && value.abs().max_element() <= MOST
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_as_the_standard_library_rounds_them() {
        let halves = (-40..40).map(|count| f64::from(count) * 0.25);
        let near = [0.5f64.next_down(), 0.5, 0.5f64.next_up(), 2f64.powi(52) + 1.0, 2f64.powi(53), 1.6e16];
        for number in halves.chain(near).flat_map(|number| [number, -number]) {
            let found = round(DVec3::splat(number)).x + 0.0;
            assert_eq!(found.to_bits(), (number.round() + 0.0).to_bits(), "{number}");
        }
    }
}
