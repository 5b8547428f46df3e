//! Standing water: a level surface over all ground below it, lighter where it is shallow.

use std::sync::Arc;

use glam::{DVec2, DVec3, Vec2};

use burgeon_base::error::Result;
use burgeon_kit::{Color, Expectation, Field, Parameter, Table, Value, fields};
use burgeon_scene::{Normal, Part};
use burgeon_terrain::{Ground, Tile};

/// Standing water.
#[fields("water")]
pub struct Water {
    /// Height (m) of the surface.
    #[default(0.0)]
    pub level: f64,
    /// Colour of deep water.
    #[default(Color([0.008, 0.045, 0.075, 1.0]))]
    pub color: Color,
    /// Colour at the shore.
    #[default(Color([0.07, 0.17, 0.17, 1.0]))]
    pub shallow: Color,
    /// Visibility depth (m).
    #[default(8.0)]
    pub clarity: f64,
}

impl Parameter for Water {
    fn luau() -> String {
        "number | { level: number?, color: Color?, shallow: Color?, clarity: number? }".into()
    }

    fn fields() -> Vec<Field> {
        Self::fields()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let what = "a level (m), or { level = 0, color = \"#0b3b4b\", shallow = \"#4b8b8b\", clarity = 8 }";
        match value {
            Value::Number(level) if level.is_finite() => Ok(Self { level, ..Self::default() }),
            Value::Table(table) => {
                let water = Self::from_table(&table);
                water.ok().filter(|water| water.clarity > 0.0).ok_or_else(|| Expectation::new(what))
            }
            _ => Err(Expectation::new(what)),
        }
    }

    fn into_value(self) -> Value {
        Value::Table(Arc::new(Table::default()))
    }
}

/// Maximum number of texels per side of a tile's image.
const MOST_TEXELS: usize = 512;

impl Water {
    /// Returns the colour at a depth (m).
    #[allow(clippy::cast_possible_truncation, reason = "colours are f32")]
    pub(crate) fn tint(&self, depth: f64) -> [f32; 3] {
        let clear = (-depth.max(0.0) / self.clarity).exp() as f32;
        [0, 1, 2].map(|at| self.color.0[at] + (self.shallow.0[at] - self.color.0[at]) * clear)
    }

    /// Returns the surface over `tile`, and an image for it with its number of texels per side, or `None` if all ground
    /// is above the water. All points are relative to `origin` (m).
    #[allow(clippy::cast_precision_loss, clippy::cast_possible_truncation, reason = "texels are few")]
    pub(super) fn surface(
        &self,
        ground: &Ground,
        tile: &Tile,
        origin: DVec3,
    ) -> Option<(Part, Vec<u8>, usize)> {
        let (corner, size) = tile.bounds(ground.world());
        let across = (1usize << tile.detail).min(MOST_TEXELS) + 1;
        let step = size / (across - 1) as f64;
        let mut bytes = Vec::with_capacity(across * across * 3);
        let mut wet = false;
        for row in (0..across).rev() {
            for column in 0..across {
                let place = (corner + DVec2::new(column as f64, row as f64) * step).min(corner + size);
                let depth = self.level - ground.height(place).unwrap_or(self.level);
                wet |= depth > 0.0;
                bytes.extend(self.tint(depth).map(burgeon_base::srgb_byte));
            }
        }
        if !wet {
            return None;
        }
        let corners = [DVec2::ZERO, DVec2::new(size, 0.0), DVec2::splat(size), DVec2::new(0.0, size)];
        let positions = corners.iter().map(|at| ((corner + at).extend(self.level) - origin).as_vec3());
        let uvs = corners.iter().map(|at| (at + step / 2.0).as_vec2());
        let part = Part {
            material: 0,
            positions: positions.collect(),
            normals: vec![Normal::Z; 4],
            uvs: uvs.map(|uv| Vec2::new(uv.x, uv.y)).collect(),
            triangles: vec![[0, 1, 2], [0, 2, 3]].into(),
            ..Part::default()
        };
        Some((part, bytes, across))
    }
}
