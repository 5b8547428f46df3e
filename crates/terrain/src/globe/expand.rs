//! Expansion of cells of several faces and levels at once: level by level, so that the surface is smooth
//! across the edges of the cube.
//!
//! The successor of a cell depends only on the world and the cell's position. Where three faces meet, the
//! missing fourth cell has the mean of the two adjacent cells.

use super::faces::{CubeCell, cell};
use crate::division::block::{Area, Block};
use crate::division::world::{Divide, World, smooth};
use burgeon_base::ModuleKey;
use burgeon_base::error::Result;

/// An area of each face.
pub(super) type Areas = [Area; 6];

/// Empty area.
pub(super) const NONE: Area = Area { x: 0, y: 0, columns: 0, rows: 0 };

/// Expands the cells of `wanted`, by level, which may lie beyond one side of their faces. Calls `found` with
/// the cells of each level that has wanted cells.
pub(super) fn expand(
    world: &World,
    wanted: &[Areas],
    divide: &dyn Divide,
    found: &mut dyn FnMut(u32, &[Block]),
) -> Result<()> {
    let levels: Vec<(u32, &Areas)> = (0..).zip(wanted).collect();
    let Some((deepest, _)) = levels.last().copied() else { return Ok(()) };
    let margin = i64::from(world.smooth);
    let mut needed: Vec<Areas> = Vec::with_capacity(wanted.len());
    for (level, wanted) in levels.iter().rev() {
        let mut areas = **wanted;
        if let Some(below) = needed.last() {
            for (area, below) in areas.iter_mut().zip(below) {
                *area = area.join(below.parent_area(margin));
            }
        }
        needed.push(settle(&areas, World::across(*level)));
    }
    needed.reverse();
    let root = |face| Block {
        keys: world.key.map(|key: ModuleKey| key.child(face)).into_iter().collect(),
        ..world.root()
    };
    let mut blocks: Vec<Block> = (0..6).map(root).collect();
    for ((level, wanted), needed) in levels.into_iter().zip(&needed) {
        if level > 0 {
            blocks = divide_cells(world, &blocks, needed, level == deepest, divide)?;
        }
        if wanted.iter().any(|area| !area.is_empty()) {
            found(level, &blocks);
        }
    }
    Ok(())
}

/// Divides the cells above, and returns the cells of `needed`.
fn divide_cells(
    world: &World,
    above: &[Block],
    needed: &Areas,
    last: bool,
    divide: &dyn Divide,
) -> Result<Vec<Block>> {
    let mut made = Vec::with_capacity(6);
    for (face, needed) in needed.iter().enumerate() {
        let cells = &above[face];
        let mut block = world.quarter(cells, needed.parent_area(0), last, divide)?;
        if world.smooth && !block.area.is_empty() {
            let area = cells.area.grow(1);
            let around = Block {
                level: cells.level,
                area,
                symbols: Vec::new(),
                heights: pad(above, face, area, |block| &block.heights),
                rest: Vec::new(),
                stride: 0,
                keys: Vec::new(),
                forms: Vec::new(),
                smooth: pad(above, face, area, |block| &block.smooth),
            };
            smooth(&around, &mut block);
        }
        world.begin_layer(&mut block);
        made.push(block);
    }
    Ok(made)
}

/// Returns the values of the cells of `area`, which may extend beyond the sides of `face`.
pub(super) fn pad(blocks: &[Block], face: usize, area: Area, of: fn(&Block) -> &[f64]) -> Vec<f64> {
    let across = World::across(blocks[face].level);
    let known = |(face, x, y): CubeCell| {
        let (face, x, y) = cell((face, x, y), across)?;
        of(&blocks[face]).get(blocks[face].area.index(x, y)).copied()
    };
    let mut numbers = Vec::with_capacity(area.len());
    let own = of(&blocks[face]);
    let inside = blocks[face].area;
    for row in 0..area.rows {
        let (_, y) = area.at(row * area.columns);
        if !(0..across).contains(&y) || !inside.contains(inside.x, y) {
            let cells = (0..area.columns).map(|column| area.at(row * area.columns + column).0);
            numbers.extend(cells.map(|x| number((face, x, y), across, &known)));
            continue;
        }
        let first = inside.index(inside.x, y);
        for column in 0..area.columns {
            let x = area.at(column).0;
            numbers.push(match usize::try_from(x - inside.x) {
                Ok(at) if at < inside.columns => own[first + at],
                _ => number((face, x, y), across, &known),
            });
        }
    }
    numbers
}

/// Returns the value of a cell that may lie beyond one or two sides of its face.
fn number((face, x, y): CubeCell, across: i64, known: &dyn Fn(CubeCell) -> Option<f64>) -> f64 {
    let within = |at: i64| at.clamp(0, across - 1);
    if within(x) != x && within(y) != y {
        let beside = [(face, within(x), y), (face, x, within(y))].map(|spot| known(spot).unwrap_or(0.0));
        return (beside[0] + beside[1]) / 2.0;
    }
    known((face, x, y)).unwrap_or(0.0)
}

/// Clips the areas to their faces, and adds the parts beyond a side to the adjacent face.
fn settle(areas: &Areas, across: i64) -> Areas {
    let clipped = |area: Area| {
        let span = |first: i64, count: usize| {
            let end = (first + i64::try_from(count).unwrap_or(0)).min(across);
            (first.max(0), usize::try_from(end - first.max(0)).unwrap_or(0))
        };
        let ((x, columns), (y, rows)) = (span(area.x, area.columns), span(area.y, area.rows));
        if columns == 0 || rows == 0 { NONE } else { Area { x, y, columns, rows } }
    };
    let mut settled = areas.map(clipped);
    for (face, area) in areas.iter().enumerate().filter(|(_, area)| !area.is_empty()) {
        let own = clipped(*area);
        if own.is_empty() {
            continue;
        }
        let ((west, north), (east, south)) = (own.at(0), own.at(own.len() - 1));
        let ((left, top), (right, bottom)) = (area.at(0), area.at(area.len() - 1));
        let strips = [
            (left < 0, [(left, north), (-1, south)]),
            (right >= across, [(across, north), (right, south)]),
            (top < 0, [(west, top), (east, -1)]),
            (bottom >= across, [(west, across), (east, bottom)]),
        ];
        for (_, ends) in strips.into_iter().filter(|(reaches, _)| *reaches) {
            let there = ends.map(|(x, y)| cell((face, x, y), across));
            if let [Some((face, x, y)), Some((_, to_x, to_y))] = there {
                settled[face] = settled[face].join(Area::bounding([(x, y), (to_x, to_y)].into_iter()));
            }
        }
    }
    settled
}
