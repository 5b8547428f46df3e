//! Help for the methods of shapes.

use std::sync::Arc;

use burgeon_base::error::{Error, ErrorKind, Result};
use burgeon_base::{MemoryOwner, Stop};
use burgeon_kit::Vector;
use burgeon_shapes::{
    BeveledSolid, CombinedSolid, EdgeKind, ImageAxis, Selector, SolidOperation, SplitAxis, SplitParts,
};
use glam::DVec3;

use super::edge_distances::EdgeDistances;
use super::object::{ShapeObject, warn};

/// Number of copies between two checks for cancellation.
const STRETCH: u32 = 256;

impl ShapeObject {
    /// Divides a face by the distances of its edges.
    pub(super) fn divide_border(
        &self,
        method: &str,
        distances: &EdgeDistances,
    ) -> Result<burgeon_shapes::Setback> {
        let name = format!("shape:{method}");
        if let EdgeDistances::Each(each) = distances {
            let count = self.shape.mesh().faces.first().map_or(0, |face| face.edges().count());
            if each.len() != count {
                return Err(Error::argument(format!("{name}: {} distances for {count} edges", each.len()))
                    .help("give one for each edge, or a table of selectors"));
            }
        }
        let by_edge = distances.by_edge(self.shape.scope().axes).map_err(|error| error.about(&name))?;
        self.shape.setback(by_edge).map_err(|error| error.about(&name))
    }

    /// Cuts off or rounds convex edges.
    pub(super) fn bevel(
        &self,
        method: &str,
        distance: f64,
        segments: u32,
        kind: Option<String>,
    ) -> Result<Self> {
        let name = format!("shape:{method}");
        let kind = kind.map(|kind| EdgeKind::read(&kind)).transpose().map_err(|error| error.about(&name))?;
        let kinds = kind.as_ref().map(std::slice::from_ref);
        let BeveledSolid { solid, failed, narrow, shift } =
            self.shape.bevel(distance, segments, kinds).map_err(|error| error.about(&name))?;
        warn_of_shift(method, shift);
        let remarks = [
            (failed, "could not be cut off"),
            (narrow, "are on faces that are too narrow, so that cuts meet there"),
        ];
        for (count, what) in remarks.into_iter().filter(|(count, _)| *count > 0) {
            let edges = if count == 1 { "1 edge".into() } else { format!("{count} edges") };
            let text = format!("{edges} {what}");
            warn(method, &text, "use a smaller distance, or cut off edges of one kind");
        }
        Ok(self.with_shape(solid))
    }

    /// Sweeps a profile around a face, and warns of edges that are too short for it.
    pub(super) fn build_molding(&self, profile: &[Vector]) -> Result<Self> {
        let profile: Vec<_> = profile.iter().map(|at| at.0.truncate()).collect();
        let (solid, crossing) = self.shape.molding(&profile).map_err(|error| error.about("shape:molding"))?;
        if let [edge, rest @ ..] = crossing.as_slice() {
            let more = if rest.is_empty() { String::new() } else { format!(" and {} more", rest.len()) };
            let text =
                format!("the profile is too wide for edge {}{more}, so the solid crosses itself", edge + 1);
            warn("molding", &text, "use a profile that is narrower on the inside of the corners");
        }
        Ok(self.with_shape(solid))
    }

    /// Returns copies of the shape, each moved by `offset` (m) from the one before.
    pub(super) fn copies(&self, count: u32, offset: DVec3) -> Result<Vec<Arc<Self>>> {
        MemoryOwner::ensure_room((count as usize).saturating_mul(self.shape.memory()))?;
        let mut copies = Vec::with_capacity(count as usize);
        for number in 0..count {
            if number.is_multiple_of(STRETCH) {
                Stop::check_current()?;
            }
            copies.push(self.shape.translate(offset * f64::from(number)));
        }
        Ok(self.parts(copies))
    }

    /// Combines two solids; keeps this one with a warning if that fails. Warns if the other one had to be moved.
    pub(super) fn combine(
        &self,
        method: &str,
        other: &Self,
        operation: SolidOperation,
    ) -> Result<Option<Self>> {
        match self.shape.combine(&other.shape, operation) {
            Ok(CombinedSolid { solid, shift }) => {
                warn_of_shift(method, shift);
                Ok(solid.map(|solid| self.with_shape(solid)))
            }
            Err(error) if *error.kind() != ErrorKind::Geometry => Err(error),
            Err(error) => {
                let text = format!("{}; the first shape is kept", error.message());
                warn(method, &text, error.remedy().unwrap_or("use closed solids"));
                Ok(Some(self.clone()))
            }
        }
    }
}

/// Warns if a solid was moved by `shift` (m) for a set operation.
pub(super) fn warn_of_shift(method: &str, shift: f64) {
    if shift > 0.0 {
        let text = format!(
            "a set operation fails numerically, and succeeded with one of the solids moved by {shift:.1e} m"
        );
        let help = "let faces that almost coincide coincide, or move one of the solids by a millimetre";
        warn(method, &text, help);
    }
}

/// Returns the unit vector; fails without a length.
pub(super) fn unit(name: &str, vector: DVec3) -> Result<DVec3> {
    vector
        .try_normalize()
        .ok_or_else(|| Error::argument(format!("{name} has no length")).help("use a vector that is not zero"))
}

/// Reads a selector; all faces without one.
pub(super) fn read_selector(method: &str, selector: Option<String>) -> Result<Selector> {
    let Some(name) = selector else { return Ok(Selector::All) };
    Selector::read(&name).map_err(|error| error.about(&format!("shape:{method}")))
}

/// Reads the direction of an image; `None` for another axis.
pub(super) fn image_axis(axis: &str) -> Option<ImageAxis> {
    match axis {
        "u" => Some(ImageAxis::U),
        "v" => Some(ImageAxis::V),
        _ => None,
    }
}

/// Reads the axis of a split.
pub(super) fn split_axis(method: &str, axis: &str) -> Result<SplitAxis> {
    match axis {
        "x" => Ok(SplitAxis::X),
        "y" => Ok(SplitAxis::Y),
        "z" => Ok(SplitAxis::Z),
        other => Err(Error::argument(format!("shape:{method}: unknown axis {other:?}")).help(
            if method == "split" {
                "use \"x\", \"y\", \"z\", or \"u\" and \"v\" of a projected image"
            } else {
                "use \"x\", \"y\" or \"z\""
            },
        )),
    }
}

/// Reports sizes that do not fit, and solids that are open after a cut.
pub(super) fn warn_of_split(method: &str, unit: &str, split: &SplitParts) {
    if split.missing > 0.0 {
        let text =
            format!("the sizes exceed the shape by {:.3} {unit}, so the last parts are cut", split.missing);
        warn(method, &text, "use flexible sizes, such as \"~3\"");
    } else if split.rest > 0.0 {
        let text = format!("the sizes leave {:.3} {unit} at the end", split.rest);
        warn(method, &text, "add a flexible size, such as \"~1\"");
    }
    if split.negative > 0 {
        let sizes =
            if split.negative == 1 { "1 size is".into() } else { format!("{} sizes are", split.negative) };
        let text = format!("{sizes} below 0, so no parts are made for them");
        warn(method, &text, "give sizes from 0, such as math.max(0, size)");
    }
    if split.open {
        warn(method, "a solid could not be closed where it was cut", "check the solid with shape:open_edges");
    }
}
