//! Solids cut at the edges of the faces that they lie on.

use burgeon_base::error::{Error, Result};
use burgeon_kit::fields;

use super::object::{ShapeObject, warn};

/// Options of `shape:trim_to`.
#[fields("shape:trim_to")]
pub struct TrimOptions {
    /// Cut at upright edges and at those that rise on the face, such as hips and corners.
    #[default(true)]
    pub vertical: bool,
    /// Cut at edges that are level on the face, such as eaves and ridges.
    #[default(false)]
    pub horizontal: bool,
    /// Angle to the horizontal direction of the face up to which an edge is level (degrees).
    #[default(40.0)]
    pub angle: f64,
}

impl ShapeObject {
    /// Cuts a shape by the planes between a face and its neighbours.
    pub(super) fn trim_at(&self, face: &Self, options: &TrimOptions) -> Result<Option<Self>> {
        if !(0.0..=90.0).contains(&options.angle) {
            return Err(Error::argument(format!("shape:trim_to: angle is {} degrees", options.angle))
                .help("use an angle from 0 to 90 degrees"));
        }
        let mut planes = face.shape.trim_planes();
        if planes.is_empty() {
            warn(
                "trim_to",
                "the face has no neighbours, so nothing is cut",
                "use a face that shape:faces or components took from a solid, or a part of it",
            );
        }
        let limit = options.angle.to_radians();
        planes.retain(|plane| if plane.inclination <= limit { options.horizontal } else { options.vertical });
        let (rest, open) = self.shape.trim_by(&planes).map_err(|error| error.about("shape:trim_to"))?;
        if open {
            warn("trim_to", "a solid could not be closed where it was cut", "check it with shape:open_edges");
        }
        Ok(rest.map(|rest| self.with_shape(rest)))
    }
}
