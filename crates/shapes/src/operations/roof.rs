//! Roofs over faces.

use burgeon_base::error::{Error, Result};
use burgeon_geometry::roof::{PatchKind, RoofShape, Support};
use glam::DVec3;

use crate::Shape;
use crate::mesh::PolygonMeshBuilder;
use crate::style::FaceStyle;

impl Shape {
    /// Returns a roof over a face that looks upwards, closed from below, and how it differs from the request.
    ///
    /// Faces have the tags "roof.slope", "roof.gable", "roof.bottom" and "roof.side". Fails unless the shape is one
    /// horizontal face.
    pub fn roof(&self, shape: &RoofShape) -> Result<(Self, Vec<&'static str>)> {
        let (polygon, frame) = self.single_face("roof")?;
        if frame.axes.z_axis.z < 1.0 - 1e-6 {
            return Err(Error::argument("the face under the roof is not horizontal")
                .help("use a horizontal face that looks upwards: shape:faces(\"up\")"));
        }
        let cover = shape.cover_on(&Support::new(&polygon, 0.0))?;
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
        Ok((Self::of_mesh(builder.build(), self.scope.axes), remarks))
    }
}
