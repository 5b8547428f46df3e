//! Positions, axes and scales of objects that move along a chain.

use std::any::Any;

use burgeon_base::error::Result;
use glam::DVec3;

use crate::{Parameter, Value, Vector};

/// Position and axes of an object at a module of its chain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ObjectPlace {
    /// Position (m).
    pub position: DVec3,
    /// Direction of movement.
    pub heading: DVec3,
    /// Direction to the left.
    pub left: DVec3,
    /// Upward direction.
    pub up: DVec3,
}

impl ObjectPlace {
    /// Names of the read methods that it answers.
    pub const METHODS: [&str; 4] = ["position", "heading", "left", "up"];

    /// Returns the result of a read method with this name at the place; `None` if the result does not depend on it.
    ///
    /// ```
    /// use burgeon_kit::{ObjectPlace, Value};
    /// use glam::DVec3;
    ///
    /// let place = ObjectPlace { position: DVec3::ZERO, heading: DVec3::Z, left: DVec3::Y, up: DVec3::X };
    /// assert!(matches!(place.answer("heading"), Some(Value::Table(_))));
    /// assert!(place.answer("triangles").is_none());
    /// ```
    pub fn answer(&self, method: &str) -> Option<Value> {
        let vector = match method {
            "position" => self.position,
            "heading" => self.heading,
            "left" => self.left,
            "up" => self.up,
            _ => return None,
        };
        Some(Vector(vector).into_value())
    }
}

/// Capability to move along the chain: rules that read the position or an axis read it at their module.
///
/// The read methods `position`, `heading`, `left` and `up` of such a type return the parts of its place.
pub trait Locate {
    /// Returns the current place.
    fn place(&self) -> ObjectPlace;
}

/// Capability to draw at another scale.
pub trait Rescale {
    /// Multiplies the lengths and widths of what is drawn from now on by `factor`, until the branch ends. Positions stay as they
    /// are. Fails unless `factor` is finite and above 0.
    fn rescale(&mut self, factor: f64) -> Result<()>;
}

/// Capability to return to an earlier state of the same interpretation pass, so that the next pass begins where the chain
/// has changed.
pub trait Rewind {
    /// Returns the number of frames that a mark contains.
    fn mark_size(&self) -> usize;

    /// Returns the present state, to which [`Rewind::rewind`] returns. Content that is drawn never changes after that.
    fn mark(&mut self) -> Box<dyn Any + Send + Sync>;

    /// Returns to the state in which [`Rewind::mark`] returned `mark`, if the pass has not begun anew since, or to which the
    /// object has returned since. Returns `false` if the mark belongs to another type.
    fn rewind(&mut self, mark: &(dyn Any + Send + Sync)) -> bool;
}
