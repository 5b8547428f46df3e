//! `extruded { ... }`: a wall in front of the others or behind them.

use std::sync::{Arc, LazyLock};

use super::fixture::{Anchor, Fixture};
use super::size::Size;
use super::wall::{Rule, Wall};
use crate::Surface;
use burgeon_base::error::{Error, Result};
use burgeon_kit::{Kind, Model};

fields! {
    /// What `extruded { ... }` takes.
    pub struct Options for "extruded" {
        /// The wall that is moved.
        pub wall: Option<Wall> = None,
        /// How far it stands out (m); less than 0 where it lies back.
        pub depth: f64 = 0.0,
        /// Whether there is a face on the left side.
        pub left: bool = true,
        /// Whether there is a face on the right side.
        pub right: bool = true,
        /// Whether there is a face below.
        pub bottom: bool = true,
        /// Whether there is a face above.
        pub top: bool = true,
        /// A model on the surface, not moved, such as a guardrail: x to the right, z up, y into the wall.
        pub model: Option<Arc<Model>> = None,
        /// Whether the model is stretched to the wall's width and height.
        pub stretch: bool = false,
        /// Where the model sits: "bottom", "center" or "top".
        pub at: Anchor = Anchor::default(),
        /// Width (m): preferred, { least, greatest } or { least, preferred, greatest }.
        pub width: Option<Size> = None,
        /// Height (m), in the same way.
        pub height: Option<Size> = None,
        /// Material of the side faces; the template's if left out.
        pub material: Option<Surface> = None,
    }
}

/// The type, as scripts see it.
pub fn kind() -> &'static Arc<Kind> {
    static KIND: LazyLock<Arc<Kind>> = LazyLock::new(|| {
        let kind = Kind::new("extruded", "A wall that stands out or lies back, with faces at its sides.");
        Arc::new(
            kind.made_of(Options::fields(), |table| make(&Options::from_table(table)?))
                .first("wall")
                .methods(Wall::methods()),
        )
    });
    &KIND
}

/// How far a wall may be moved (m).
const FURTHEST: f64 = 100.0;

fn make(options: &Options) -> Result<Wall> {
    let Some(wall) = options.wall.clone() else {
        return Err(Error::argument("extruded: there is no wall to extrude")
            .help("write extruded { wall = panel { }, depth = 0.3 }"));
    };
    if options.depth.abs() > FURTHEST {
        return Err(Error::argument(format!("extruded: depth is {} m", options.depth))
            .help(format!("give metres from -{FURTHEST} to {FURTHEST}")));
    }
    let model = options.model.clone();
    let fixture = model.map(|model| Fixture::new(model, options.stretch, options.at));
    let sides = [options.left, options.right, options.bottom, options.top];
    let (sizes, targets) = (wall.0.sizes.clone(), wall.0.targets);
    let rule = Rule::Extruded { depth: options.depth, sides, fixture, wall };
    Wall::new(rule, sizes, targets, [options.width, options.height], options.material.as_ref())
}
