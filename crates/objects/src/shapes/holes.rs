//! Holes in faces of shapes, and the colour of faces.

use std::sync::Arc;

use burgeon_base::error::Result;
use burgeon_kit::{Color, Expectation, Parameter, Value};
use burgeon_shapes::HoleOutline;
use burgeon_spatial::PolygonArgument;
use glam::DVec2;

use super::object::{ShapeObject, warn};

/// Outline of a hole: points or a polygon in the scope of the face, or a shape in the world.
#[derive(Clone)]
pub enum HoleArgument {
    /// Rings (m).
    Rings(Vec<Vec<DVec2>>),
    /// Shape.
    Shape(Arc<ShapeObject>),
}

impl Parameter for HoleArgument {
    fn luau() -> String {
        "{ Vector } | Geometry | Shape".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        if let Ok(shape) = Arc::<ShapeObject>::read_value(&value) {
            return Ok(Self::Shape(shape));
        }
        let what = "an outline, such as { { 1, 1 }, { 2, 1 }, { 2, 2.5 } }, a polygon or a shape";
        let rings = PolygonArgument::read_value(&value).map_err(|_| Expectation::new(what))?.0;
        let flat = rings.iter().map(|ring| super::construct::flat_ring(ring));
        Ok(Self::Rings(flat.collect()))
    }

    fn into_value(self) -> Value {
        Value::Nil
    }
}

impl ShapeObject {
    /// Returns a face without the area of a hole, and warns of a hole beside it.
    pub(super) fn without_hole(&self, hole: &HoleArgument) -> Result<Option<Self>> {
        let outline = match hole {
            HoleArgument::Rings(rings) => HoleOutline::Rings(rings),
            HoleArgument::Shape(shape) => HoleOutline::Shape(shape.shape()),
        };
        let cut = self.shape().cut_hole(outline).map_err(|error| error.about("shape:cut_hole"))?;
        if cut.is_beside {
            warn(
                "cut_hole",
                "the hole is beside the face, so nothing is cut",
                "give the outline in the scope of the face: x to the right and y upwards from its corner (m)",
            );
        }
        Ok(cut.rest.map(|rest| self.with_shape(rest)))
    }

    /// Returns the colour that all faces have in common, as a text such as "#c08040".
    pub(super) fn common_color(&self) -> Option<String> {
        let styles = self.shape().styles();
        let mut colors = styles.iter().map(|style| style.as_deref().and_then(|style| style.color));
        let first = colors.next().flatten()?;
        let is_common = colors.all(|color| color == Some(first));
        match Color(first).into_value() {
            Value::Text(text) if is_common => Some(text.to_string()),
            _ => None,
        }
    }
}
