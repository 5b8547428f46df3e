//! Sizes of a texture's tiles as scripts write them.

use burgeon_base::error::{Error, Result};
use burgeon_kit::{Expectation, Parameter, Value, fields};
use burgeon_shapes::{Scope, UvMap};
use glam::DVec2;

use super::object::ShapeObject;

/// Length (m) of a tile, or the length that whole tiles come close to.
#[derive(Debug, Clone, Copy)]
pub enum TileLength {
    /// Length (m).
    Fixed(f64),
    /// As many whole tiles of about this length (m) as fit.
    Whole(f64),
}

impl Parameter for TileLength {
    fn luau() -> String {
        "number | string".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let what = "a length above 0 (m), or \"~2\" for whole tiles of about 2 m";
        let length = match &value {
            Value::Number(length) => Some(Self::Fixed(*length)),
            Value::Text(text) => {
                text.trim().strip_prefix('~').and_then(|rest| rest.trim().parse().ok()).map(Self::Whole)
            }
            _ => None,
        };
        let is_length = |length: &Self| {
            let (Self::Fixed(length) | Self::Whole(length)) = length;
            *length > 1e-6 && *length < 1e7
        };
        length.filter(is_length).ok_or_else(|| Expectation::new(what))
    }

    fn into_value(self) -> Value {
        Value::Nil
    }
}

impl TileLength {
    /// Returns the length (m) of a tile on a whole of this length (m).
    fn on(self, whole: f64) -> f64 {
        match self {
            Self::Fixed(length) => length,
            Self::Whole(length) if whole > 0.0 => whole / (whole / length).round().max(1.0),
            Self::Whole(length) => length,
        }
    }
}

/// Options of `shape:project`.
#[fields("shape:project")]
pub struct ProjectOptions {
    /// Axes of the scope along the width and the height of the image: "xy", "xz" or "yz".
    #[default("xy".into())]
    pub axes: String,
    /// Fractions of a tile by which the image is shifted: { u, v }.
    #[default(vec![0.0, 0.0])]
    pub offset: Vec<f64>,
    /// Rotation of the image (degrees), counter-clockwise.
    #[default(0.0)]
    pub angle: f64,
    /// Name of the set of texture coordinates, which the field dirt_set of a material names; the set of the texture if omitted.
    pub set: Option<String>,
}

impl ShapeObject {
    /// Returns the shape with texture coordinates in tiles of this width and height.
    pub(super) fn with_tiles(
        &self,
        [width, height]: [TileLength; 2],
        options: &ProjectOptions,
    ) -> Result<Self> {
        let axes = match options.axes.as_str() {
            "xy" => [0, 1],
            "xz" => [0, 2],
            "yz" => [1, 2],
            other => {
                return Err(Error::argument(format!("shape:project: unknown axes {other:?}"))
                    .help("use \"xy\", \"xz\" or \"yz\""));
            }
        };
        let &[u, v] = options.offset.as_slice() else {
            let count = options.offset.len();
            return Err(Error::argument(format!("shape:project: offset has {count} numbers"))
                .help("write { u, v }, such as { 0.5, 0 }"));
        };
        let scope: &Scope = &self.shape.scope();
        let tile = DVec2::new(width.on(scope.size[axes[0]]), height.on(scope.size[axes[1]]));
        let map = UvMap { offset: DVec2::new(u, v), ..UvMap::of_plane(scope, axes, tile) };
        if options.set.as_ref().is_some_and(String::is_empty) {
            return Err(Error::argument("shape:project: the name of the set is empty")
                .help("give a name, such as \"dirt\", or omit set to place the texture"));
        }
        let set = options.set.as_deref().unwrap_or_default().into();
        Ok(self.with_shape(self.shape.project_set(&set, map.rotate(options.angle.to_radians()))))
    }
}
