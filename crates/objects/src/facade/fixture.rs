//! Models on walls: windows, doors, guardrails.

use std::sync::Arc;

use glam::DVec3;

use burgeon_kit::{Expectation, Model, Parameter, Value};
use burgeon_scene::SurfaceMeaning;

/// A model and its alignment on a wall.
///
/// Models are seen from the front: x to the right, z up, y into the wall, whose surface is at y = 0.
#[derive(Clone)]
pub struct Fixture {
    /// Model to place.
    pub model: Arc<Model>,
    /// Set if the model is stretched to the wall's width and height.
    pub stretch: bool,
    /// Vertical position: 0 at the bottom of the wall, 1 at the top.
    pub anchor: f64,
    /// Minimum corner of the bounding box (m).
    pub low: DVec3,
    /// Maximum corner of the bounding box (m).
    pub high: DVec3,
    /// Meaning of the model's surfaces, if specified.
    pub meaning: Option<SurfaceMeaning>,
}

impl Fixture {
    /// Creates a fixture of `model`.
    pub fn new(model: Arc<Model>, stretch: bool, at: Anchor) -> Self {
        let (low, high) = (model.low(), model.high());
        Self { model, stretch, anchor: at.0, low, high, meaning: None }
    }

    /// Returns the width and height (m).
    pub fn extent(&self) -> [f64; 2] {
        [self.high.x - self.low.x, self.high.z - self.low.z]
    }
}

/// The meaning of a panel: wall, window or door.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PanelMeaning(pub SurfaceMeaning);

const MEANINGS: [(&str, SurfaceMeaning); 3] =
    [("wall", SurfaceMeaning::Wall), ("window", SurfaceMeaning::Window), ("door", SurfaceMeaning::Door)];

impl Parameter for PanelMeaning {
    fn luau() -> String {
        "string".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let named = MEANINGS.iter().find(|(name, _)| matches!(&value, Value::Text(text) if **text == **name));
        let what = || Expectation::new("\"wall\", \"window\" or \"door\"");
        named.map(|(_, meaning)| Self(*meaning)).ok_or_else(what)
    }

    fn into_value(self) -> Value {
        let named = MEANINGS.iter().find(|(_, meaning)| *meaning == self.0);
        Value::Text(named.map_or("wall", |(name, _)| name).into())
    }
}

/// The vertical position of a model on a wall: 0 at the bottom, 1 at the top.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Anchor(pub f64);

impl Default for Anchor {
    /// Returns the anchor in the middle.
    fn default() -> Self {
        Self(0.5)
    }
}

const ANCHORS: [(&str, f64); 3] = [("bottom", 0.0), ("center", 0.5), ("top", 1.0)];

impl Parameter for Anchor {
    fn luau() -> String {
        "string".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let named = ANCHORS.iter().find(|(name, _)| matches!(&value, Value::Text(text) if **text == **name));
        let what = || Expectation::new("\"bottom\", \"center\" or \"top\"");
        named.map(|(_, height)| Self(*height)).ok_or_else(what)
    }

    fn into_value(self) -> Value {
        let nearest = ANCHORS.iter().min_by(|a, b| (a.1 - self.0).abs().total_cmp(&(b.1 - self.0).abs()));
        Value::Text(nearest.map_or("center", |(name, _)| name).into())
    }
}
