//! Roofs over faces.

use burgeon_base::error::{Error, Result};
use burgeon_geometry::roof::{PatchKind, RoofMap, RoofShape, Support, UnusedLine};
use glam::{DVec2, DVec3};

use super::inset::explain_touching;
use crate::Shape;
use crate::mesh::PolygonMeshBuilder;
use crate::style::FaceStyle;

/// A roof as a shape, and its differences from the request.
#[derive(Debug)]
pub struct ShapeRoof {
    /// Solid.
    pub shape: Shape,
    /// Differences that the plan requires.
    pub remarks: Vec<&'static str>,
    /// Lines of the map that are not used as they are given, with their places in the coordinates of the world (m).
    pub unused: Vec<UnusedLine>,
}

impl Shape {
    /// Returns a roof over a face that looks upwards, closed from below.
    ///
    /// `map` has lines of the surface in the coordinates of the world, with heights (m) above the face. Faces have the tags
    /// "roof.slope", "roof.gable", "roof.bottom" and "roof.side". Fails unless the shape is one horizontal face.
    pub fn roof(&self, shape: &RoofShape, map: Option<&RoofMap>) -> Result<ShapeRoof> {
        let (polygon, frame) = self.single_face("roof")?;
        if frame.axes.z_axis.z < 1.0 - 1e-6 {
            return Err(Error::argument("the face under the roof is not horizontal")
                .help("use a horizontal face that looks upwards: shape:faces(\"up\")"));
        }
        let local = |at: &DVec3| frame.local(at.truncate().extend(frame.origin.z)).truncate().extend(at.z);
        let lines =
            |lines: &[Vec<DVec3>]| lines.iter().map(|line| line.iter().map(local).collect()).collect();
        let map = map.map(|map| RoofMap {
            ridges: lines(&map.ridges),
            edges: lines(&map.edges),
            apexes: map.apexes.iter().map(local).collect(),
        });
        let cover = shape.cover_on(&Support { map: map.as_ref(), ..Support::new(&polygon, 0.0) });
        let cover = cover.map_err(|error| explain_touching(error, &polygon, &frame))?;
        let own = self.styles().into_iter().next().flatten();
        let style = |tag: &'static str| FaceStyle::with_automatic_tag(&own, tag);
        let [slope, gable, side, bottom] =
            ["roof.slope", "roof.gable", "roof.side", "roof.bottom"].map(style);
        let place = |ring: &[DVec3]| -> Vec<DVec3> { ring.iter().map(|at| frame.point(*at)).collect() };
        let mut builder = PolygonMeshBuilder::default();
        for patch in &cover.patches {
            let rings: Vec<Vec<DVec3>> = patch.rings.iter().map(|ring| place(ring)).collect();
            let style = match patch.kind {
                PatchKind::Slope => &slope,
                PatchKind::Gable => &gable,
                _ => &side,
            };
            builder.face(rings.iter().map(Vec::as_slice), style);
        }
        let below: Vec<Vec<DVec3>> =
            polygon.from_below().iter().map(|ring| place(&ring.at_height(0.0))).collect();
        builder.face(below.iter().map(Vec::as_slice), &bottom);
        let hips = cover.hipped.then_some("hips replace a gable that was not possible");
        let remarks = hips.into_iter().chain(cover.remark).collect();
        let world = |at: DVec2| frame.point(at.extend(0.0)).truncate();
        let unused = cover.unused.iter().map(|line| UnusedLine { at: world(line.at), ..*line }).collect();
        Ok(ShapeRoof { shape: Self::of_mesh(builder.build(), self.scope().axes), remarks, unused })
    }
}
