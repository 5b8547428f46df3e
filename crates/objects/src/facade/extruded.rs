//! `extruded { ... }`: a wall in front of the others or behind them.

use std::sync::{Arc, LazyLock};

use super::fixture::{Anchor, Fixture};
use super::size::Size;
use super::wall::{Wall, WallRule, wall_kind};
use crate::MaterialOptions;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::number;
use burgeon_kit::{Kind, Model, fields};

/// Fields of `extruded { ... }`.
#[fields("extruded")]
pub struct ExtrudedOptions {
    /// Wall to move.
    pub wall: Option<Wall>,
    /// Projection (m); negative for a recess.
    #[default(0.0)]
    pub depth: f64,
    /// Draw a face on the left side.
    #[default(true)]
    pub left: bool,
    /// Draw a face on the right side.
    #[default(true)]
    pub right: bool,
    /// Draw a face at the bottom.
    #[default(true)]
    pub bottom: bool,
    /// Draw a face at the top.
    #[default(true)]
    pub top: bool,
    /// Model on the original surface, which is not moved, such as a guardrail: x to the right, z up, y into the wall.
    pub model: Option<Arc<Model>>,
    /// Stretch the model to the wall's width and height.
    pub stretch: bool,
    /// Vertical position of the model: "bottom", "center" or "top".
    pub at: Anchor,
    /// Width (m): preferred, { minimum, maximum } or { minimum, preferred, maximum }.
    pub width: Option<Size>,
    /// Height (m), in the same form.
    pub height: Option<Size>,
    /// Material of the side faces. If omitted, the template's.
    pub material: Option<MaterialOptions>,
}

/// Returns the script type of extruded walls.
pub fn kind() -> &'static Arc<Kind> {
    static KIND: LazyLock<Arc<Kind>> = LazyLock::new(|| {
        let kind = Kind::new("extruded", "A wall that projects or recedes, with faces at its sides.")
            .first("wall")
            .example(include_str!("../../scripts/extruded.lua"));
        wall_kind(kind, ExtrudedOptions::fields(), |table| make(ExtrudedOptions::from_table(table)?))
    });
    &KIND
}

/// Maximum distance (m) by which a wall may be moved.
const FURTHEST: f64 = 100.0;

fn make(options: ExtrudedOptions) -> Result<Wall> {
    let Some(wall) = options.wall else {
        return Err(Error::argument("extruded: missing wall to extrude")
            .help("write extruded { wall = panel { }, depth = 0.3 }"));
    };
    if options.depth.abs() > FURTHEST {
        return Err(Error::argument(format!("extruded: depth is {} m", number(options.depth)))
            .help(format!("give metres from -{FURTHEST} to {FURTHEST}")));
    }
    let fixture = options.model.map(|model| Fixture::new(model, options.stretch, options.at));
    let sides = [options.left, options.right, options.bottom, options.top];
    let (sizes, targets) = (wall.0.sizes.clone(), wall.0.targets);
    let rule = WallRule::Extruded { depth: options.depth, sides, fixture, wall };
    Wall::new(kind(), rule, sizes, targets, [options.width, options.height], options.material.as_ref())
}
