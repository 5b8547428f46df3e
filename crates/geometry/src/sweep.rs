//! Sweeps: the surface that a cross-section leaves along its way, closed by caps.

use std::borrow::Cow;

use glam::Vec3;

use super::ring::{SectionRing, rings};
use super::surface::SweepSurface;
use super::{Section, Station};
use burgeon_base::error::{Error, Result};
use burgeon_scene::Part;

/// How far the texture runs between two stations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Lengthwise {
    /// As far as the surface, on average: a texture keeps its size also where the section tapers or twists.
    #[default]
    Surface,
    /// As far as the centre line: a texture keeps in step with the way, such as a tower's storeys.
    Axis,
}

/// How a sweep is shaded, closed and textured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SweepOptions {
    /// Whether the surface is shaded as round around the section, at the points that are marked smooth.
    pub around: bool,
    /// Whether the surface is shaded as round along the way, at the stations that are not marked sharp.
    pub along: bool,
    /// Whether the start is closed.
    pub start_cap: bool,
    /// Whether the end is closed.
    pub end_cap: bool,
    /// Whether the last station leads back to the first one, as in a ring; there are no caps then.
    pub closed: bool,
    /// Whether an open section gets its back side, too; without it, the material has to be two-sided.
    pub back: bool,
    /// The texture coordinate v (m) at the first station.
    pub v: f64,
    /// How far v runs between two stations.
    pub lengthwise: Lengthwise,
}

impl Default for SweepOptions {
    /// Round where it is marked so, closed by caps at both ends.
    fn default() -> Self {
        Self {
            around: true,
            along: true,
            start_cap: true,
            end_cap: true,
            closed: false,
            back: true,
            v: 0.0,
            lengthwise: Lengthwise::Surface,
        }
    }
}

/// What a sweep has added.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SweepResult {
    /// The texture coordinate v (m) at the end, where the next sweep can go on.
    pub v: f64,
    /// The edges (m) where the surface is open: at ends without a cap, and all around a ribbon.
    pub open: Vec<[Vec3; 2]>,
    /// Which stations its triangles lead to: in order, each station's number from 0 and how many triangles the part
    /// had when those that lead to it had been added. Caps count for their station.
    pub reached: Vec<(usize, usize)>,
}

/// Adds the surface that `section` leaves along `stations` to `part`.
///
/// Triangles are counter-clockwise seen from outside, also if scales are negative or the way goes backwards.
/// Texture coordinates are metres: u around the section and v along the way on the sides, the section's x and
/// y on the caps, never mirrored. A scale of 0 makes a tip, a scale of 0 in x or y alone a ridge; neither has
/// a cap. Two stations at one place make a step if their sections differ, a mitre if their headings do, and
/// are one if nothing does. With fewer than 2 different stations, nothing is added.
///
/// Fails, and adds nothing, if a value is not finite, if the way turns back at one place, if a scale changes
/// its sign between two stations, if the outlines of a step cross, or if a face would have no area.
///
/// ```
/// use burgeon_geometry::{Frame, Section, Segment, SweepOptions, solid, sweep};
/// use burgeon_scene::Part;
///
/// let mut way = Vec::new();
/// Segment { length: 5.0, ..Segment::default() }.stations(Frame::default(), &mut way)?;
/// let mut beam = Part::default();
/// sweep(&mut beam, &Section::rectangle(2.0, 1.0)?, &way, &SweepOptions::default())?;
/// assert!(solid::check([&beam]).is_solid());
/// assert!((solid::volume([&beam]) - 10.0).abs() < 1e-6);
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
pub fn sweep(
    part: &mut Part,
    section: &Section,
    stations: &[Station],
    options: &SweepOptions,
) -> Result<SweepResult> {
    if !options.v.is_finite() {
        return Err(Error::argument(format!("the texture of the sweep begins at {}", options.v))
            .help("give a finite v"));
    }
    let mut rings_of = rings(section, stations, options.closed)?;
    let mut section = Cow::Borrowed(section);
    let mut divided = [false; 2];
    for (axis, divided) in divided.iter_mut().enumerate() {
        let squeezed = |ring: &SectionRing| ring.after.scale[1 - axis] == 0.0 && !ring.is_apex();
        if !section.is_open() && rings_of.iter().any(squeezed) {
            *divided = true;
            section = Cow::Owned(section.divided_at_levels(axis)?);
            rings_of = rings(&section, stations, options.closed)?;
        }
    }
    if divided == [true; 2] && section.divided_at_levels(0)?.points().count() != section.points().count() {
        return Err(Error::geometry(
            "a run has a ridge along x and another along y, which do not fit this cross-section",
        )
        .help("make two runs, or use a rectangle"));
    }
    let (vertices, triangles) = (part.positions.len(), part.triangles.len());
    let result = SweepSurface::new(part, &section, &rings_of, options).and_then(SweepSurface::build);
    if result.is_err() {
        part.positions.truncate(vertices);
        part.normals.truncate(vertices);
        part.uvs.truncate(vertices);
        part.triangles.truncate(triangles);
    }
    result
}
