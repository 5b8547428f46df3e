//! `extruded { ... }`: a wall in front of the others or behind them.

use std::sync::{Arc, LazyLock};

use super::fixture::{Anchor, Fixture};
use super::size::Size;
use super::wall::{Wall, WallRule, wall_kind};
use crate::MaterialOptions;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::number;
use burgeon_kit::{Kind, Model, fields};

/// What `extruded { ... }` takes.
#[fields("extruded")]
pub struct ExtrudedOptions {
    /// The wall that is moved.
    pub wall: Option<Wall>,
    /// How far it stands out (m); less than 0 where it lies back.
    #[default(0.0)]
    pub depth: f64,
    /// Whether there is a face on the left side.
    #[default(true)]
    pub left: bool,
    /// Whether there is a face on the right side.
    #[default(true)]
    pub right: bool,
    /// Whether there is a face below.
    #[default(true)]
    pub bottom: bool,
    /// Whether there is a face above.
    #[default(true)]
    pub top: bool,
    /// A model on the surface, not moved, such as a guardrail: x to the right, z up, y into the wall.
    pub model: Option<Arc<Model>>,
    /// Whether the model is stretched to the wall's width and height.
    pub stretch: bool,
    /// Where the model sits: "bottom", "center" or "top".
    pub at: Anchor,
    /// Width (m): preferred, { least, greatest } or { least, preferred, greatest }.
    pub width: Option<Size>,
    /// Height (m), in the same way.
    pub height: Option<Size>,
    /// Material of the side faces; the template's if left out.
    pub material: Option<MaterialOptions>,
}

/// The type, as scripts see it.
pub fn kind() -> &'static Arc<Kind> {
    static KIND: LazyLock<Arc<Kind>> = LazyLock::new(|| {
        let kind = Kind::new("extruded", "A wall that stands out or lies back, with faces at its sides.")
            .first("wall")
            .example(include_str!("../../scripts/extruded.lua"));
        wall_kind(kind, ExtrudedOptions::fields(), |table| make(&ExtrudedOptions::from_table(table)?))
    });
    &KIND
}

/// How far a wall may be moved (m).
const FURTHEST: f64 = 100.0;

fn make(options: &ExtrudedOptions) -> Result<Wall> {
    let Some(wall) = options.wall.clone() else {
        return Err(Error::argument("extruded: there is no wall to extrude")
            .help("write extruded { wall = panel { }, depth = 0.3 }"));
    };
    if options.depth.abs() > FURTHEST {
        return Err(Error::argument(format!("extruded: depth is {} m", number(options.depth)))
            .help(format!("give metres from -{FURTHEST} to {FURTHEST}")));
    }
    let model = options.model.clone();
    let fixture = model.map(|model| Fixture::new(model, options.stretch, options.at));
    let sides = [options.left, options.right, options.bottom, options.top];
    let (sizes, targets) = (wall.0.sizes.clone(), wall.0.targets);
    let rule = WallRule::Extruded { depth: options.depth, sides, fixture, wall };
    Wall::new(rule, sizes, targets, [options.width, options.height], options.material.as_ref())
}
