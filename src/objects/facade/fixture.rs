//! Models that walls carry: windows, doors, guardrails.

use std::any::Any;
use std::sync::Arc;

use glam::DVec3;

use crate::error::{Error, Result};
use crate::objects::{Model, Object};

/// A model and how it sits on a wall.
///
/// Models are seen from the front: x to the right, z up, y into the wall, whose surface is at y = 0.
#[derive(Clone)]
pub struct Fixture {
    /// The model.
    pub model: Arc<dyn Object>,
    /// Whether it is stretched to the wall's width and height.
    pub stretch: bool,
    /// Where it sits: 0 at the bottom of the wall, 1 at the top.
    pub anchor: f64,
    /// The lowest corner of the box around it (m).
    pub low: DVec3,
    /// The highest corner of the box around it (m).
    pub high: DVec3,
}

impl Fixture {
    /// A fixture for the wall `rule`; `at` is "bottom", "center" or "top".
    pub fn new(rule: &str, model: Arc<dyn Object>, stretch: bool, at: &str) -> Result<Self> {
        let any: &dyn Any = &*model;
        let Some(shape) = any.downcast_ref::<Model>() else {
            return Err(Error::new(format!("{rule}: a {} cannot be placed", model.kind().name))
                .help("give what derive returned, or model(\"window.glb\")"));
        };
        let (low, high) = (shape.low(), shape.high());
        let anchor = match at {
            "bottom" => 0.0,
            "center" => 0.5,
            "top" => 1.0,
            _ => {
                return Err(Error::new(format!("{rule}: at is {at:?}"))
                    .help("there are \"bottom\", \"center\" and \"top\""));
            }
        };
        Ok(Self { model, stretch, anchor, low, high })
    }

    /// Its width and height (m).
    pub fn extent(&self) -> [f64; 2] {
        [self.high.x - self.low.x, self.high.z - self.low.z]
    }
}
