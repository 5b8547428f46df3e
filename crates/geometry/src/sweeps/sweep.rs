//! Sweeps: the surface of a cross-section moved along a path, closed by caps.

use std::borrow::Cow;

use super::options::{SweepOptions, SweepResult};
use super::path::Station;
use super::ring::{SectionRing, rings};
use super::surface::SweepSurface;
use crate::cross_section::section::Section;
use burgeon_base::error::{Error, Result};
use burgeon_scene::Part;

/// Adds the surface of `section` moved along `stations` to `part`.
///
/// Triangles are counter-clockwise seen from outside, even if scales are negative or the path runs backwards.
/// Texture coordinates are in metres and never mirrored: u around the section and v along the path on the
/// sides, the section's x and y on the caps. A scale of 0 creates a tip, and a scale of 0 only in x or y
/// creates a ridge; neither has a cap. Two stations at one position form a step if their sections differ, a
/// mitre if their headings differ, and are merged if they are equal. Fewer than 2 distinct stations add
/// nothing.
///
/// Fails, and adds nothing, if a value is not finite, if the path turns back at one position, if a scale
/// changes its sign between two stations, if the outlines of a step cross, or if a face would have no area.
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
