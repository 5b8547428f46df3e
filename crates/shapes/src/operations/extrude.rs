//! Solids over faces.

use std::sync::Arc;

use burgeon_base::error::{Error, Result};
use glam::DVec3;

use crate::mesh::{EdgeSums, PolygonFace, PolygonMesh};
use crate::style::{FaceStyle, SharedStyle};
use crate::{Scope, Shape, ShapeBody};

/// Tags of the faces, the sides and the copies.
const EXTRUDED: [&str; 3] = ["extrude.bottom", "extrude.side", "extrude.top"];
const TAPERED: [&str; 3] = ["taper.bottom", "taper.side", "taper.top"];

impl Shape {
    /// Returns the solid between the faces and their copies at `distance` (m) along `direction`, the mean normal of the
    /// faces unless given. A negative distance extrudes backwards.
    ///
    /// New faces have the tags "extrude.bottom", "extrude.side" and "extrude.top", in addition to those of the faces.
    /// Fails for closed shapes, for edges, and if the direction lies in the plane of the faces.
    ///
    /// ```
    /// use burgeon_shapes::Shape;
    /// use glam::DVec2;
    ///
    /// let plan = Shape::plan(&[vec![(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 5.0)].into_iter().map(DVec2::from).collect()], 0.0)?;
    /// let mass = plan.extrude(2.0, None)?;
    /// assert!(mass.is_closed() && (mass.volume() - 2.0 * plan.area()).abs() < 1e-9);
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn extrude(&self, distance: f64, direction: Option<DVec3>) -> Result<Self> {
        self.check_open("extrude")?;
        if distance == 0.0 || !distance.is_finite() {
            return Err(Error::argument(format!("the distance of an extrusion is {distance} m"))
                .help("use a distance other than 0"));
        }
        if let (ShapeBody::Rectangle(style), None) = (&self.body, direction) {
            let mut scope = self.scope();
            scope.size.z = distance.abs();
            if distance < 0.0 {
                scope.origin += scope.axes.z_axis * distance;
            }
            let side = FaceStyle::with_automatic_tag(style, EXTRUDED[1]);
            let mut styles: [SharedStyle; 6] = std::array::from_fn(|_| side.clone());
            styles[0] = FaceStyle::with_automatic_tag(
                style,
                if distance > 0.0 { "extrude.bottom" } else { "extrude.top" },
            );
            styles[5] = FaceStyle::with_automatic_tag(
                style,
                if distance > 0.0 { "extrude.top" } else { "extrude.bottom" },
            );
            return Ok(Self::new(scope, ShapeBody::Box(Some(Arc::new(styles)))));
        }
        let mesh = self.mesh();
        let normal: DVec3 = mesh.faces.iter().map(|face| mesh.area_vector(face)).sum();
        let Some(normal) = normal.try_normalize() else {
            return Err(Error::geometry("the faces of the extrusion have no common side")
                .help("extrude faces that look to one side, or give a direction"));
        };
        let direction = direction.and_then(DVec3::try_normalize).unwrap_or(normal);
        if direction.dot(normal).abs() < 1e-6 {
            return Err(Error::argument("the direction of an extrusion lies in the plane of the faces")
                .help("use a direction that leaves the plane"));
        }
        let solid = loft(&mesh, direction * distance, direction.dot(normal) * distance < 0.0);
        Ok(Self::of_mesh(solid, self.scope().axes))
    }

    /// Returns the solid between a face and its copy at `height` (m) along the normal, scaled by `scale` around the
    /// centroid: a pyramid if it is 0.
    ///
    /// New faces have the tags "taper.bottom", "taper.side" and "taper.top". Fails for closed shapes and edges.
    pub fn taper(&self, height: f64, scale: f64) -> Result<Self> {
        self.check_open("taper")?;
        if height <= 0.0 || !height.is_finite() || !(0.0..=1e3).contains(&scale) {
            return Err(Error::argument(format!(
                "a taper of height {height} m and scale {scale} is no solid"
            ))
            .help("use a height above 0, and a scale from 0"));
        }
        let mesh = self.mesh();
        let normal: DVec3 = mesh.faces.iter().map(|face| mesh.area_vector(face)).sum();
        let Some(normal) = normal.try_normalize() else {
            return Err(Error::geometry("the faces have no common side").help("taper a face"));
        };
        let center = self.centroid();
        let above = |at: DVec3| center + (at - center) * scale + normal * height;
        let solid = if scale > 0.0 {
            sides(&mesh, above, TAPERED)
        } else {
            let mut solid = sides(&mesh, above, TAPERED);
            collapse_top(&mut solid, mesh.points.len());
            solid
        };
        Ok(Self::of_mesh(solid, self.scope().axes))
    }

    /// Returns the inside of a recess of `depth` (m) behind the faces: the back and the sides, which look outwards, without
    /// the opening.
    ///
    /// Faces have the tags "recess.back" and "recess.side". Fails as [`Shape::extrude`].
    pub fn recess(&self, depth: f64) -> Result<Self> {
        if depth <= 0.0 {
            return Err(
                Error::argument(format!("the depth of a recess is {depth} m")).help("use a depth above 0")
            );
        }
        if let ShapeBody::Rectangle(style) = &self.body {
            return Ok(self.rectangle_recess(style, depth));
        }
        let solid = self.extrude(-depth, None)?;
        let mesh = solid.mesh();
        let inside =
            (0..mesh.faces.len()).filter(|&face| !FaceStyle::has_tag(&mesh.faces[face].style, EXTRUDED[0]));
        let inside = Self::of_mesh(mesh.select(inside), self.scope().axes).reverse();
        Ok(inside.with_styles(|style| {
            let tag = if FaceStyle::has_tag(style, EXTRUDED[1]) { "recess.side" } else { "recess.back" };
            FaceStyle::with_automatic_tag(&FaceStyle::without_tags(style, "extrude"), tag)
        }))
    }

    /// Returns the recess behind a rectangle: the most frequent recess, that of a window.
    fn rectangle_recess(&self, style: &SharedStyle, depth: f64) -> Self {
        let Scope { origin, axes, size } = self.scope();
        let own = FaceStyle::without_tags(style, "extrude");
        let styles = ["recess.back", "recess.side"].map(|tag| FaceStyle::with_automatic_tag(&own, tag));
        let scope = Scope { origin: origin - axes.z_axis * depth, axes, size: size.with_z(depth) };
        Self::new(scope, ShapeBody::Recess(Arc::new(styles)))
    }

    /// Fails unless the shape has faces and is open.
    fn check_open(&self, operation: &str) -> Result<()> {
        match &self.body {
            ShapeBody::Edge(..) => Err(Error::argument(format!("an edge has no face to {operation}"))
                .help("use a face: shape:faces(\"top\")")),
            ShapeBody::Box(_) => Err(closed(operation)),
            ShapeBody::Mesh(mesh) if mesh.is_closed() => Err(closed(operation)),
            _ => Ok(()),
        }
    }
}

fn closed(operation: &str) -> Error {
    Error::argument(format!("the shape is a solid, which has no open face to {operation}"))
        .help("use one of its faces: shape:faces(\"top\")")
}

/// Returns the solid between faces and their copies at an offset (m); `backwards` if the copies are behind the faces.
fn loft(mesh: &PolygonMesh, offset: DVec3, backwards: bool) -> PolygonMesh {
    if !backwards {
        return sides(mesh, |at| at + offset, EXTRUDED);
    }
    // Seen from the copies, the faces are in front.
    let [bottom, side, top] = EXTRUDED;
    sides(&mesh.translate(|at| at + offset, false), |at| at - offset, [top, side, bottom])
}

/// Returns the closed mesh of reversed faces, copies at other positions, and sides over the open edges.
fn sides(
    mesh: &PolygonMesh,
    above: impl Fn(DVec3) -> DVec3,
    [bottom, side, top]: [&'static str; 3],
) -> PolygonMesh {
    #[allow(clippy::cast_possible_truncation, reason = "a mesh has fewer than 2^31 points")]
    let count = mesh.points.len() as u32;
    let mut points = mesh.points.clone();
    points.extend(mesh.points.iter().map(|at| above(*at)));
    let mut faces = Vec::with_capacity(3 * mesh.faces.len() + points.len());
    let mut rim = EdgeSums::default();
    for face in &mesh.faces {
        let reversed = face.rings.iter().map(|ring| ring.iter().rev().copied().collect()).collect();
        faces
            .push(PolygonFace { rings: reversed, style: FaceStyle::with_automatic_tag(&face.style, bottom) });
        face.edges().for_each(|edge| rim.add(edge));
    }
    let style = mesh.faces.first().and_then(|face| face.style.clone());
    let side = FaceStyle::with_automatic_tag(&style, side);
    faces.extend(rim.rest().map(|[from, to]| PolygonFace::of(&[from, to, to + count, from + count], &side)));
    for face in &mesh.faces {
        let raised = face.rings.iter().map(|ring| ring.iter().map(|point| point + count).collect()).collect();
        faces.push(PolygonFace { rings: raised, style: FaceStyle::with_automatic_tag(&face.style, top) });
    }
    PolygonMesh::new(points, faces)
}

/// Joins all points from number `first` on, and removes faces without area.
fn collapse_top(mesh: &mut PolygonMesh, first: usize) {
    mesh.points.truncate(first + 1);
    #[allow(clippy::cast_possible_truncation, reason = "a mesh has fewer than 2^32 points")]
    let apex = first as u32;
    mesh.faces.retain_mut(|face| {
        for ring in &mut face.rings {
            ring.iter_mut().for_each(|point| *point = (*point).min(apex));
            ring.dedup();
        }
        face.rings.iter().all(|ring| ring.len() > 2)
    });
}

impl Scope {
    /// Returns the scope with another size (m).
    #[must_use]
    pub fn with_size(&self, size: DVec3) -> Self {
        Self { size, ..*self }
    }
}
