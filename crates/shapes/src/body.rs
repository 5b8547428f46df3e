//! Geometry of shapes.

use std::borrow::Cow;
use std::sync::{Arc, LazyLock};

use glam::DVec3;

use crate::Scope;
use crate::edge_kind::EdgeKind;
use crate::mesh::{PolygonFace, PolygonMesh};
use crate::style::SharedStyle;

/// Geometry of a shape. Boxes and rectangles that fill their scope need no mesh, so that a million of them fit in memory.
#[derive(Debug, Clone)]
pub enum ShapeBody {
    /// The solid of the scope, with the styles of its faces: bottom, front, right, back, left and top.
    Box(Option<Arc<[SharedStyle; 6]>>),
    /// The rectangle of the scope's x and y axes, which faces along z.
    Rectangle(SharedStyle),
    /// The line along the scope's x axis.
    Edge(EdgeKind, SharedStyle),
    /// The box of the scope without its top, seen from inside, with the style of the back, which is the bottom of the box, and
    /// that of the sides: the inside of a window's recess.
    Recess(Arc<[SharedStyle; 2]>),
    /// Any faces.
    Mesh(Arc<PolygonMesh>),
}

/// Corners of the faces of a box, as numbers of [`Scope::corners`].
pub(crate) const BOX_FACES: [[u32; 4]; 6] =
    [[0, 2, 3, 1], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6], [4, 5, 7, 6]];
/// Corners of the faces of a recess, as numbers of [`Scope::corners`]: the faces of a box without the top, turned over.
pub(crate) const RECESS_FACES: [[u32; 4]; 5] =
    [[1, 3, 2, 0], [4, 5, 1, 0], [5, 7, 3, 1], [7, 6, 2, 3], [6, 4, 0, 2]];
/// Number of the top face of a box.
pub(crate) const TOP: usize = 5;

/// A mesh without faces.
static EMPTY: LazyLock<PolygonMesh> = LazyLock::new(PolygonMesh::default);

impl ShapeBody {
    /// Returns the faces as a mesh; empty for an edge.
    pub(crate) fn mesh(&self, scope: &Scope) -> Cow<'_, PolygonMesh> {
        match self {
            Self::Mesh(mesh) => Cow::Borrowed(mesh),
            Self::Edge(..) => Cow::Borrowed(&EMPTY),
            Self::Rectangle(style) => {
                let corners = scope.corners();
                let points: Vec<DVec3> = [0, 1, 3, 2].map(|corner: usize| corners[corner]).to_vec();
                Cow::Owned(PolygonMesh::new(points, vec![PolygonFace::of(&[0, 1, 2, 3], style)]))
            }
            Self::Recess(styles) => {
                let faces = RECESS_FACES.iter().enumerate();
                let faces = faces.map(|(number, ring)| PolygonFace::of(ring, recess_style(styles, number)));
                Cow::Owned(PolygonMesh::new(scope.corners().to_vec(), faces.collect()))
            }
            Self::Box(styles) => {
                let style = |face: usize| styles.as_deref().and_then(|styles| styles[face].clone());
                let faces = BOX_FACES.iter().enumerate();
                let faces = faces.map(|(number, ring)| PolygonFace::of(ring, &style(number))).collect();
                Cow::Owned(PolygonMesh::new(scope.corners().to_vec(), faces))
            }
        }
    }

    /// Returns the corners (m) and the style of each face of a box, a recess or a rectangle, counter-clockwise seen from outside;
    /// `None` for others.
    pub fn quads<'a>(
        &'a self,
        scope: &Scope,
    ) -> Option<impl Iterator<Item = ([DVec3; 4], &'a SharedStyle)> + Clone + use<'a>> {
        const PLAIN: &SharedStyle = &None;
        let (rings, styles): (&[[u32; 4]], &[SharedStyle]) = match self {
            Self::Box(styles) => (&BOX_FACES, styles.as_deref().map_or(&[], <[SharedStyle; 6]>::as_slice)),
            Self::Recess(styles) => (&RECESS_FACES, styles.as_slice()),
            Self::Rectangle(style) => (&[[0, 1, 3, 2]], std::slice::from_ref(style)),
            Self::Edge(..) | Self::Mesh(_) => return None,
        };
        let is_recess = matches!(self, Self::Recess(_));
        let corners = scope.corners();
        Some(rings.iter().enumerate().map(move |(number, ring)| {
            // All sides of a recess have one style.
            let style = if is_recess { number.min(1) } else { number };
            (ring.map(|corner| corners[corner as usize]), styles.get(style).unwrap_or(PLAIN))
        }))
    }

    /// Returns the number of faces.
    pub fn faces(&self) -> usize {
        match self {
            Self::Box(_) => BOX_FACES.len(),
            Self::Recess(_) => RECESS_FACES.len(),
            Self::Rectangle(_) => 1,
            Self::Edge(..) => 0,
            Self::Mesh(mesh) => mesh.faces.len(),
        }
    }
}

/// Returns the style of the face of a recess with this number.
pub(crate) fn recess_style(styles: &[SharedStyle; 2], number: usize) -> &SharedStyle {
    &styles[number.min(1)]
}
