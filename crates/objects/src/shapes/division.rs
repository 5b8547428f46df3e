//! Divisions of shapes into parts that become modules.

use std::sync::Arc;

use burgeon_base::error::{Error, Result};
use burgeon_kit::{IntoParts, Object, Parameter, PartMaker, Value};
use burgeon_shapes::{ImageAxis, SplitAxis};

use super::component_selector::ComponentChoice;
use super::object::ShapeObject;
use super::part_sizes::SplitSizes;
use super::support::{image_axis, split_axis, warn_of_split};

/// Direction of a split.
#[derive(Debug, Clone, Copy)]
pub(super) enum SplitDirection {
    /// Along an axis of the scope.
    Axis(SplitAxis),
    /// Along an axis of the projected image.
    Image(ImageAxis),
}

impl SplitDirection {
    /// Reads the name of an axis.
    pub(super) fn read(axis: &str) -> Result<Self> {
        match image_axis(axis) {
            Some(axis) => Ok(Self::Image(axis)),
            None => split_axis("split", axis).map(Self::Axis),
        }
    }
}

impl ShapeObject {
    /// Divides the shape into parts of these sizes.
    pub(super) fn divide_along(
        &self,
        direction: SplitDirection,
        sizes: &SplitSizes,
    ) -> Result<Vec<Arc<Self>>> {
        let (split, unit) = match direction {
            SplitDirection::Image(axis) => (self.shape.split_image(axis, &sizes.0), "tiles"),
            SplitDirection::Axis(axis) => (self.shape.split(axis, &sizes.0), "m"),
        };
        let split = split.map_err(|error| error.about("shape:split"))?;
        warn_of_split("split", unit, &split);
        Ok(self.number_parts(split.parts))
    }
}

impl IntoParts for ShapeObject {
    fn prepare_parts(&self, method: &str, arguments: &[Value]) -> Option<PartMaker> {
        let [Value::Text(kind), entries] = arguments else { return None };
        match method {
            "split" => {
                let direction = SplitDirection::read(kind).ok()?;
                let sizes = SplitSizes::read_value(entries).ok()?;
                Some(division(move |shape| shape.divide_along(direction, &sizes)))
            }
            "components" => {
                let choice = ComponentChoice::read(kind, &Vec::read_value(entries).ok()?).ok()?;
                Some(division(move |shape| choice.of(shape)))
            }
            _ => None,
        }
    }
}

/// Creates the division of a function for shapes.
fn division(
    divide: impl Fn(&ShapeObject) -> Result<Vec<Arc<ShapeObject>>> + Send + Sync + 'static,
) -> PartMaker {
    Arc::new(move |object| {
        let shape = ShapeObject::of(object).ok_or_else(|| Error::argument("the parameter is not a shape"))?;
        let parts = divide(shape)?.into_iter();
        Ok(parts.map(|part| (part.place.entry, part as Arc<dyn Object>)).collect())
    })
}
