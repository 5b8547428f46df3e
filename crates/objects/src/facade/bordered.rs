//! `bordered { ... }`: a wall between four margins.

use std::sync::{Arc, LazyLock};

use super::size::{Margin, Policy, Size};
use super::wall::{Wall, WallRule, wall_kind};
use crate::MaterialOptions;
use burgeon_base::error::{Error, Result};
use burgeon_geometry::{Share, Split};
use burgeon_kit::{Kind, fields};

/// Fields of `bordered { ... }`.
#[fields("bordered")]
pub struct BorderedOptions {
    /// Wall in the middle.
    pub wall: Option<Wall>,
    /// Left margin: a size (m), or { size, "min" | "max" | "fixed" }. A size alone is the minimum.
    pub left: Margin,
    /// Right margin (m), in the same form.
    pub right: Margin,
    /// Bottom margin (m), in the same form.
    pub bottom: Margin,
    /// Top margin (m), in the same form.
    pub top: Margin,
    /// Width (m): preferred, { minimum, maximum } or { minimum, preferred, maximum }.
    pub width: Option<Size>,
    /// Height (m), in the same form.
    pub height: Option<Size>,
    /// Material of the margins. If omitted, the template's.
    pub material: Option<MaterialOptions>,
}

/// Returns the script type of bordered walls.
pub fn kind() -> &'static Arc<Kind> {
    static KIND: LazyLock<Arc<Kind>> = LazyLock::new(|| {
        let kind = Kind::new("bordered", "A wall between four margins.")
            .first("wall")
            .example(include_str!("../../scripts/bordered.lua"));
        wall_kind(kind, BorderedOptions::fields(), |table| make(BorderedOptions::from_table(table)?))
    });
    &KIND
}

fn make(options: BorderedOptions) -> Result<Wall> {
    let Some(wall) = options.wall else {
        return Err(Error::argument("bordered: missing wall between the margins")
            .help("write bordered { wall = panel { }, left = 0.5 }"));
    };
    let columns = split(options.left, &wall, 0, options.right)?;
    let rows = split(options.bottom, &wall, 1, options.top)?;
    let sizes = [columns.sizes().clone(), rows.sizes().clone()];
    let targets = [(0, &options.left, &options.right), (1, &options.bottom, &options.top)]
        .map(|(side, before, after)| wall.0.targets[side].map(|target| before.size + target + after.size));
    let own = [options.width, options.height];
    Wall::new(
        kind(),
        WallRule::Bordered { columns, rows, wall },
        sizes,
        targets,
        own,
        options.material.as_ref(),
    )
}

fn split(before: Margin, wall: &Wall, side: usize, after: Margin) -> Result<Split> {
    let margin = |margin: Margin| Share {
        sizes: margin.sizes(),
        target: Some(margin.size),
        // A margin that may be smaller gives way first; a margin that may be larger takes the remainder of a preferred
        // size.
        order: if margin.policy == Policy::Max { 0 } else { 1 },
    };
    let target = wall.0.targets[side];
    let center =
        Share { sizes: wall.0.sizes[side].clone(), target, order: if target.is_some() { 2 } else { 0 } };
    Split::new(vec![margin(before), center, margin(after)]).map_err(|error| error.about("bordered"))
}
