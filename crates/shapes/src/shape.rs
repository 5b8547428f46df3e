//! Shapes: geometry with a scope.

use std::borrow::Cow;
use std::sync::Arc;

use burgeon_geometry::Polygon;
use glam::{DMat3, DVec3};

use crate::body::{RECESS_FACES, TOP, recess_style};
use crate::compact_scope::CompactScope;
use crate::mesh::{PolygonFace, PolygonMesh};
use crate::style::{FaceStyle, SharedStyle};
use crate::trim_planes::TrimFace;
use crate::{Scope, ShapeBody};

/// A solid, faces or an edge, with a scope. A shape never changes.
///
/// ```
/// use burgeon_shapes::Shape;
/// use glam::DVec3;
///
/// let mass = Shape::cuboid(DVec3::new(10.0, 6.0, 3.0));
/// assert_eq!((mass.volume(), mass.area(), mass.is_closed()), (180.0, 216.0, true));
/// ```
#[derive(Debug, Clone)]
pub struct Shape {
    /// Coordinate system.
    pub(crate) scope: CompactScope,
    /// Geometry.
    pub body: ShapeBody,
    /// Face of a solid that this face or part of a face was.
    pub(crate) trim: Option<TrimFace>,
}

/// Smallest extent (m) along an axis that is not 0.
const THINNEST: f64 = 1e-6;

impl Shape {
    /// Creates a shape of a body in a scope.
    pub(crate) fn new(scope: Scope, body: ShapeBody) -> Self {
        Self { scope: scope.into(), body, trim: None }
    }

    /// Returns the coordinate system.
    #[inline]
    pub fn scope(&self) -> Scope {
        self.scope.get()
    }

    /// Creates a box with a corner at the origin.
    pub fn cuboid(size: DVec3) -> Self {
        Self::new(Scope { size, ..Scope::default() }, ShapeBody::Box(None))
    }

    /// Creates a shape of faces, with a scope of these axes around them. Boxes and rectangles that fill it are recognised.
    pub fn of_mesh(mesh: PolygonMesh, axes: DMat3) -> Self {
        let scope = scope_around(axes, mesh.points.iter().copied());
        if let [face] = mesh.faces.as_slice()
            && is_rectangle(&mesh, face, &scope)
        {
            return Self::new(scope, ShapeBody::Rectangle(face.style.clone()));
        }
        Self::new(scope, ShapeBody::Mesh(Arc::new(mesh)))
    }

    /// Creates the shape of a face of a mesh in a scope of these axes, if it is a rectangle along them.
    pub(crate) fn of_rectangle(mesh: &PolygonMesh, face: usize, axes: DMat3) -> Option<Self> {
        let face = &mesh.faces[face];
        let [ring] = face.rings.as_slice() else { return None };
        if ring.len() != 4 {
            return None;
        }
        let scope = scope_around(axes, ring.iter().map(|point| mesh.at(*point)));
        is_rectangle(mesh, face, &scope).then(|| Self::new(scope, ShapeBody::Rectangle(face.style.clone())))
    }

    /// Creates the face of a polygon in the plane of a scope's x and y axes, with a scope around it.
    pub fn of_polygon(polygon: &Polygon, frame: &Scope, style: &SharedStyle) -> Self {
        let rings: Vec<Vec<DVec3>> =
            polygon.iter().map(|ring| ring.iter().map(|at| frame.point(at.extend(0.0))).collect()).collect();
        let mut builder = crate::mesh::PolygonMeshBuilder::default();
        builder.face(rings.iter().map(Vec::as_slice), style);
        Self::of_mesh(builder.build(), frame.axes)
    }

    /// Returns the faces as a mesh.
    pub fn mesh(&self) -> Cow<'_, PolygonMesh> {
        self.body.mesh(&self.scope())
    }

    /// Returns true if every edge has the same number of faces in both directions.
    pub fn is_closed(&self) -> bool {
        match &self.body {
            ShapeBody::Box(_) => true,
            ShapeBody::Rectangle(_) | ShapeBody::Recess(_) | ShapeBody::Edge(..) => false,
            ShapeBody::Mesh(mesh) => mesh.is_closed(),
        }
    }

    /// Returns the enclosed volume (m³); 0 if the shape is open.
    pub fn volume(&self) -> f64 {
        match &self.body {
            ShapeBody::Box(_) => self.scope().size.element_product(),
            ShapeBody::Mesh(mesh) if mesh.is_closed() => mesh.volume(),
            _ => 0.0,
        }
    }

    /// Returns the area (m²) of all faces.
    pub fn area(&self) -> f64 {
        let size = self.scope().size;
        match &self.body {
            ShapeBody::Box(_) => 2.0 * (size.x * size.y + size.y * size.z + size.z * size.x),
            ShapeBody::Recess(_) => size.x * size.y + 2.0 * size.z * (size.x + size.y),
            ShapeBody::Rectangle(_) => size.x * size.y,
            ShapeBody::Edge(..) => 0.0,
            ShapeBody::Mesh(mesh) => mesh.area(),
        }
    }

    /// Returns the normal of the first face; the z axis of an edge.
    pub fn normal(&self) -> DVec3 {
        match &self.body {
            ShapeBody::Mesh(mesh) => mesh.faces.first().map_or(DVec3::ZERO, |face| mesh.normal(face)),
            ShapeBody::Box(_) => -self.scope().axes.z_axis,
            ShapeBody::Rectangle(_) | ShapeBody::Recess(_) | ShapeBody::Edge(..) => self.scope().axes.z_axis,
        }
    }

    /// Returns the mean of the faces' centroids (m), weighted by area; the middle of the scope if there is none.
    pub fn centroid(&self) -> DVec3 {
        let mesh = match &self.body {
            ShapeBody::Mesh(_) | ShapeBody::Recess(_) => self.mesh(),
            _ => return self.scope().center(),
        };
        let (mut sum, mut area) = (DVec3::ZERO, 0.0);
        for (center, own) in mesh.faces.iter().map(|face| mesh.centroid(face)) {
            sum += center * own;
            area += own;
        }
        if area > 0.0 { sum / area } else { self.scope().center() }
    }

    /// Returns the styles of all faces.
    pub fn styles(&self) -> Vec<Option<Arc<FaceStyle>>> {
        match &self.body {
            ShapeBody::Box(styles) => {
                styles.as_deref().map_or_else(|| vec![None; TOP + 1], |styles| styles.to_vec())
            }
            ShapeBody::Recess(styles) => {
                (0..RECESS_FACES.len()).map(|face| recess_style(styles, face).clone()).collect()
            }
            ShapeBody::Rectangle(style) | ShapeBody::Edge(_, style) => vec![style.clone()],
            ShapeBody::Mesh(mesh) => mesh.faces.iter().map(|face| face.style.clone()).collect(),
        }
    }

    /// Returns the shape with other styles of its faces.
    #[must_use]
    pub fn with_styles(&self, change: impl Fn(&Option<Arc<FaceStyle>>) -> Option<Arc<FaceStyle>>) -> Self {
        let body = match &self.body {
            ShapeBody::Box(styles) => {
                let of = |face: usize| change(&styles.as_deref().and_then(|styles| styles[face].clone()));
                let new: [SharedStyle; 6] = std::array::from_fn(of);
                ShapeBody::Box(new.iter().any(Option::is_some).then(|| Arc::new(new)))
            }
            ShapeBody::Recess(styles) => {
                ShapeBody::Recess(Arc::new([change(&styles[0]), change(&styles[1])]))
            }
            ShapeBody::Rectangle(style) => ShapeBody::Rectangle(change(style)),
            ShapeBody::Edge(kind, style) => ShapeBody::Edge(*kind, change(style)),
            ShapeBody::Mesh(mesh) => {
                let mut new = (**mesh).clone();
                new.faces.iter_mut().for_each(|face| face.style = change(&face.style));
                ShapeBody::Mesh(Arc::new(new))
            }
        };
        Self { scope: self.scope.clone(), body, trim: self.trim.clone() }
    }

    /// Returns the approximate memory (bytes).
    pub fn memory(&self) -> usize {
        let mesh = if let ShapeBody::Mesh(mesh) = &self.body { mesh.memory() } else { 0 };
        size_of::<Self>() + mesh
    }

    /// Returns the face as a polygon in the plane of the scope's x and y axes; `None` unless it is one flat face.
    pub fn polygon(&self) -> Option<Polygon> {
        let mesh = self.mesh();
        let [face] = mesh.faces.as_slice() else { return None };
        mesh.flat_polygon(face, self.scope().axes, self.scope().origin)
    }
}

/// Returns the scope of these axes around points; extents of less than the thinnest are 0.
fn scope_around(axes: DMat3, points: impl IntoIterator<Item = DVec3>) -> Scope {
    let mut scope = Scope::around(axes, points);
    for size in scope.size.as_mut() {
        if *size < THINNEST {
            *size = 0.0;
        }
    }
    scope
}

/// Returns true if a face is the rectangle of the scope's x and y axes that faces along z.
fn is_rectangle(mesh: &PolygonMesh, face: &PolygonFace, scope: &Scope) -> bool {
    let [ring] = face.rings.as_slice() else { return false };
    if ring.len() != 4 || scope.size.z > 0.0 || scope.size.x <= 0.0 || scope.size.y <= 0.0 {
        return false;
    }
    let near = |a: f64, b: f64| (a - b).abs() < 1e-9 * (1.0 + b.abs());
    let is_corner = |point: &u32| {
        let at = scope.local(mesh.at(*point));
        (near(at.x, 0.0) || near(at.x, scope.size.x)) && (near(at.y, 0.0) || near(at.y, scope.size.y))
    };
    ring.iter().all(is_corner) && mesh.area_vector(face).dot(scope.axes.z_axis) > 0.0
}
