//! Division of shapes along an axis.

use std::sync::Arc;

use burgeon_base::error::{Error, Result};
use burgeon_base::{MemoryOwner, Stop};

use crate::cut::plane::CutPlane;
use crate::sizes::DividedParts;
use crate::style::SharedStyle;
use crate::{PartSizes, Scope, Shape, ShapeBody};

/// Axis of a split.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SplitAxis {
    /// The scope's x axis.
    X,
    /// The scope's y axis.
    Y,
    /// The scope's z axis.
    Z,
}

/// Parts of a split.
#[derive(Debug, Clone, Default)]
pub struct SplitParts {
    /// Parts in ascending order, with the number of their entry (from 0).
    pub parts: Vec<(usize, Shape)>,
    /// Length (m) that no part covers.
    pub rest: f64,
    /// Length (m) of the requested sizes that did not fit.
    pub missing: f64,
    /// Number of sizes below 0, which make no part.
    pub negative: usize,
    /// Set if cut solids could not be closed.
    pub open: bool,
}

/// Maximum number of parts of a split.
const MOST_PARTS: usize = 4_000_000;
/// Number of parts between two checks for cancellation.
const STRETCH: usize = 4096;

impl Shape {
    /// Divides the shape along an axis of its scope. Parts of solids are closed by new faces without tags.
    ///
    /// Scopes shrink to the geometry of their parts.
    ///
    /// ```
    /// use burgeon_shapes::{PartSize, PartSizes, Shape, SizedParts, SplitAxis};
    /// use glam::DVec3;
    ///
    /// let sizes = PartSizes(vec![SizedParts::Repeated(vec![PartSize::Flexible(3.0)])]);
    /// let storeys = Shape::cuboid(DVec3::new(8.0, 8.0, 10.0)).split(SplitAxis::Z, &sizes)?;
    /// assert_eq!(storeys.parts.len(), 3);
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn split(&self, axis: SplitAxis, sizes: &PartSizes) -> Result<SplitParts> {
        let axis = axis as usize;
        let whole = self.scope().size[axis];
        if whole <= 0.0 {
            let name = ["x", "y", "z"][axis];
            return Err(Error::argument(format!("the shape has no extent along {name}"))
                .help("split it along another axis, or extrude it first"));
        }
        let DividedParts { parts, rest, missing, negative } = sizes.divide(whole, MOST_PARTS)?;
        MemoryOwner::ensure_room(parts.len() * size_of::<(usize, Shape)>())?;
        let mut split = SplitParts { rest, missing, negative, ..SplitParts::default() };
        match &self.body {
            ShapeBody::Box(styles) => {
                let styles = BoxStyles::new(styles, axis);
                split.parts.reserve(parts.len());
                for (number, part) in parts.iter().enumerate() {
                    if number.is_multiple_of(STRETCH) {
                        Stop::check_current()?;
                    }
                    let scope = self.scope.slab(axis, [part.from, part.to]);
                    let body = ShapeBody::Box(styles.of(part.from <= 0.0, part.to >= whole));
                    split.parts.push((part.entry, Self { scope, body, trim: None }));
                }
            }
            ShapeBody::Rectangle(_) | ShapeBody::Edge(..) if axis < 2 => {
                split.parts.extend(parts.iter().map(|part| {
                    let scope = self.scope.slab(axis, [part.from, part.to]);
                    (part.entry, Self { scope, body: self.body.clone(), trim: self.trim.clone() })
                }));
            }
            _ => self.split_mesh(axis, &parts, &mut split)?,
        }
        Ok(split)
    }

    /// Adds the parts of a mesh.
    fn split_mesh(
        &self,
        axis: usize,
        parts: &[crate::sizes::PartInterval],
        split: &mut SplitParts,
    ) -> Result<()> {
        let mut rest = self.mesh().into_owned();
        let normal = self.scope().axes.col(axis);
        let start = self.scope().origin.dot(normal);
        for part in parts {
            Stop::check_current()?;
            // The rest begins where the last part ended.
            let halves = CutPlane { normal, offset: start + part.to }.cut(&rest, &None)?;
            split.open |= halves.open;
            if let Some(mesh) = halves.below {
                MemoryOwner::ensure_room(mesh.memory())?;
                split.parts.push((part.entry, Self::of_mesh(mesh, self.scope().axes).with_trim_of(self)));
            }
            let Some(above) = halves.above else { break };
            rest = above;
        }
        Ok(())
    }

    /// Returns the parts of the shape below and above a plane, each with a scope of the same axes, and whether cut solids
    /// could not be closed.
    pub fn cut(&self, plane: &CutPlane) -> Result<([Option<Self>; 2], bool)> {
        let halves = plane.cut(&self.mesh(), &None)?;
        let shape = |mesh| Self::of_mesh(mesh, self.scope().axes).with_trim_of(self);
        Ok(([halves.below.map(shape), halves.above.map(shape)], halves.open))
    }

    /// Returns the number of parts that [`Shape::split`] allows.
    pub const fn most_parts() -> usize {
        MOST_PARTS
    }
}

/// Styles of the parts of a box: the first and the last part keep the style of an end.
struct BoxStyles {
    /// Styles by whether the part has the first and the last face.
    of: [Option<Arc<[SharedStyle; 6]>>; 4],
}

impl BoxStyles {
    fn new(styles: &Option<Arc<[SharedStyle; 6]>>, axis: usize) -> Self {
        // Numbers of the faces at the start and the end of each axis.
        let [first, last] = [[4, 2], [1, 3], [0, 5]][axis];
        let of = std::array::from_fn(|ends| {
            let mut own = styles.as_deref()?.clone();
            if ends & 1 == 0 {
                own[first] = None;
            }
            if ends & 2 == 0 {
                own[last] = None;
            }
            own.iter().any(Option::is_some).then(|| Arc::new(own))
        });
        Self { of }
    }

    fn of(&self, has_first: bool, has_last: bool) -> Option<Arc<[SharedStyle; 6]>> {
        self.of[usize::from(has_first) + 2 * usize::from(has_last)].clone()
    }
}

impl Scope {
    /// Returns the plane at a distance (m) along the axis with this index.
    pub fn plane(&self, axis: usize, at: f64) -> CutPlane {
        let normal = self.axes.col(axis);
        CutPlane { normal, offset: self.origin.dot(normal) + at }
    }
}
