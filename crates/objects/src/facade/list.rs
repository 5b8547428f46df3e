//! `list { ... }`: walls next to or above each other.

use std::sync::{Arc, LazyLock};

use super::size::Size;
use super::wall::{Wall, WallRule, range, wall_kind};
use crate::MaterialOptions;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_geometry::{Share, Split};
use burgeon_kit::{Kind, fields};

/// Fields of `list { ... }`.
#[fields("list")]
pub struct ListOptions {
    /// Walls, from left to right or from the bottom up.
    pub walls: Vec<Wall>,
    /// Direction: "horizontal" or "vertical".
    #[default("horizontal".into())]
    pub direction: String,
    /// Width (m): preferred, { minimum, maximum } or { minimum, preferred, maximum }.
    pub width: Option<Size>,
    /// Height (m), in the same form.
    pub height: Option<Size>,
}

/// Returns the script type of lists.
pub fn kind() -> &'static Arc<Kind> {
    static KIND: LazyLock<Arc<Kind>> = LazyLock::new(|| {
        let kind = Kind::new("list", "Walls from left to right, or from the bottom up.")
            .first("walls")
            .example(include_str!("../../scripts/list.lua"));
        wall_kind(kind, ListOptions::fields(), |table| make(ListOptions::from_table(table)?))
    });
    &KIND
}

/// Maximum number of walls in a list.
const MOST: usize = 500;

fn make(options: ListOptions) -> Result<Wall> {
    let upwards = match options.direction.as_str() {
        "horizontal" => false,
        "vertical" => true,
        other => {
            return Err(Error::argument(format!("list: unknown direction {other:?}"))
                .help("use \"horizontal\" or \"vertical\""));
        }
    };
    let Some(first) = options.walls.first() else {
        return Err(Error::argument("list: missing walls").help("write list({ panel { }, panel { } })"));
    };
    if options.walls.len() > MOST {
        return Err(Error::limit(Limit::Size, format!("list: {} walls are too many", options.walls.len()))
            .help(format!("use at most {MOST}, or repeat a wall with grid")));
    }
    let (along, across) = (usize::from(upwards), usize::from(!upwards));
    let shares = options.walls.iter().map(|wall| {
        let target = wall.0.targets[along];
        Share { sizes: wall.0.sizes[along].clone(), target, order: if target.is_some() { 2 } else { 0 } }
    });
    let split = Split::new(shares.collect()).map_err(|error| error.about("list"))?;
    let mut common = first.0.sizes[across].clone();
    for (index, wall) in options.walls.iter().enumerate() {
        let side = ["wide", "high"][across];
        let both = common.and(&wall.0.sizes[across]);
        if both.is_empty() {
            let message = format!(
                "list: it can never fit: wall {} is {}, the walls before it are {}",
                index + 1,
                range(&wall.0.sizes[across], side),
                range(&common, side)
            );
            return Err(Error::argument(message).help("add a margin around one of them: bordered { ... }"));
        }
        common = both;
    }
    let mut sizes = [split.sizes().clone(), common];
    let mut targets = [split.target(), options.walls.iter().find_map(|wall| wall.0.targets[across])];
    if upwards {
        sizes.reverse();
        targets.reverse();
    }
    let rule = WallRule::List { upwards, split, walls: options.walls };
    Wall::new(kind(), rule, sizes, targets, [options.width, options.height], None::<&MaterialOptions>)
}
