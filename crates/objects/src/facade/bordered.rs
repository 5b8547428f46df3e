//! `bordered { ... }`: a wall between four margins.

use std::sync::{Arc, LazyLock};

use super::size::{Margin, Policy, Size};
use super::wall::{Wall, WallRule, wall_kind};
use crate::MaterialOptions;
use burgeon_base::error::{Error, Result};
use burgeon_geometry::{Share, Split};
use burgeon_kit::{Kind, fields};

/// What `bordered { ... }` takes.
#[fields("bordered")]
pub struct BorderedOptions {
    /// The wall in the middle.
    pub wall: Option<Wall>,
    /// The left margin: a size (m), or { size, "min" | "max" | "fixed" }; a size alone is the least.
    pub left: Margin,
    /// The right margin (m), in the same way.
    pub right: Margin,
    /// The margin below (m), in the same way.
    pub bottom: Margin,
    /// The margin above (m), in the same way.
    pub top: Margin,
    /// Width (m): preferred, { least, greatest } or { least, preferred, greatest }.
    pub width: Option<Size>,
    /// Height (m), in the same way.
    pub height: Option<Size>,
    /// Material of the margins; the template's if left out.
    pub material: Option<MaterialOptions>,
}

/// The type, as scripts see it.
pub fn kind() -> &'static Arc<Kind> {
    static KIND: LazyLock<Arc<Kind>> = LazyLock::new(|| {
        let kind = Kind::new("bordered", "A wall between four margins.")
            .first("wall")
            .example(include_str!("../../scripts/bordered.lua"));
        wall_kind(kind, BorderedOptions::fields(), |table| make(&BorderedOptions::from_table(table)?))
    });
    &KIND
}

fn make(options: &BorderedOptions) -> Result<Wall> {
    let Some(wall) = options.wall.clone() else {
        return Err(Error::argument("bordered: there is no wall between the margins")
            .help("write bordered { wall = panel { }, left = 0.5 }"));
    };
    let columns = split(options.left, &wall, 0, options.right)?;
    let rows = split(options.bottom, &wall, 1, options.top)?;
    let sizes = [columns.sizes().clone(), rows.sizes().clone()];
    let targets = [(0, &options.left, &options.right), (1, &options.bottom, &options.top)]
        .map(|(side, before, after)| wall.0.targets[side].map(|target| before.size + target + after.size));
    let own = [options.width, options.height];
    Wall::new(WallRule::Bordered { columns, rows, wall }, sizes, targets, own, options.material.as_ref())
}

fn split(before: Margin, wall: &Wall, side: usize, after: Margin) -> Result<Split> {
    let margin = |margin: Margin| Share {
        sizes: margin.sizes(),
        target: Some(margin.size),
        // What may be smaller gives way first, what may be larger takes what a preferred size leaves.
        order: if margin.policy == Policy::Max { 0 } else { 1 },
    };
    let target = wall.0.targets[side];
    let center =
        Share { sizes: wall.0.sizes[side].clone(), target, order: if target.is_some() { 2 } else { 0 } };
    Split::new(vec![margin(before), center, margin(after)]).map_err(|error| error.about("bordered"))
}
