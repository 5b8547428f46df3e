//! Mosaic of several rasters whose samples are on one grid.

use super::raster::Raster;
use crate::heights::{MOST, SampleGrid, count};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_spatial::Crs;
use std::borrow::Cow;

/// Tolerance (samples) for the alignment of samples with the grid.
const TOLERANCE: f64 = 0.02;

/// Difference (m) up to which heights are equal.
const SAME: f32 = 0.01;

/// Joins rasters before their holes are filled. The result does not depend on their order.
///
/// Fails if the rasters differ in coordinate system or step, if their samples are not aligned, or if the mosaic is too
/// large.
pub(super) fn join(mut tiles: Vec<Raster>, budget: &Budget) -> Result<Raster> {
    unwrap_longitudes(&mut tiles);
    tiles.sort_by(|a, b| {
        let place = |tile: &Raster| [-tile.grid.first[1], tile.grid.first[0]];
        let ([y, x], [v, u]) = (place(a), place(b));
        y.total_cmp(&v).then(x.total_cmp(&u)).then_with(|| a.name.cmp(&b.name))
    });
    let Some(first) = tiles.first() else {
        return Err(Error::argument("elevation needs a file name").help("write elevation(\"N43E007.hgt\")"));
    };
    let step = first.grid.step;
    for tile in &tiles[1..] {
        check_same(first, tile)?;
    }
    let west = tiles.iter().map(|tile| tile.grid.first[0]).fold(f64::INFINITY, f64::min);
    let north = tiles.iter().map(|tile| tile.grid.first[1]).fold(f64::NEG_INFINITY, f64::max);
    let grid = SampleGrid { first: [west, north], step };
    let parts = tiles.iter().map(|tile| place(&grid, tile, &first.name)).collect::<Result<Vec<_>>>()?;
    let side = |axis: usize| parts.iter().map(|part| part[axis]).max().unwrap_or(0);
    let (columns, rows) = (side(2), side(3));
    if columns.checked_mul(rows).is_none_or(|all| all > MOST) {
        let most = MOST / 1_000_000;
        let what = format!(
            "the {} files extend over {columns} x {rows} heights, more than {most} million",
            tiles.len()
        );
        return Err(
            Error::limit(Limit::Size, what).help("use files that are closer together, or coarser files")
        );
    }
    budget.take(columns * rows * size_of::<f32>())?;
    let (name, crs) = (file_names(&tiles), first.crs.clone());
    let mut raster = Raster::new(&name, [columns, rows], vec![f32::NAN; columns * rows], grid, crs);
    let mut covered = vec![false; columns * rows];
    for (tile, [left, top, right, bottom]) in tiles.into_iter().zip(&parts) {
        for (row, line) in (*top..*bottom).zip(tile.heights.chunks_exact(tile.columns)) {
            budget.tick()?;
            covered[row * columns + left..row * columns + right].fill(true);
            let into = &mut raster.heights[row * columns + left..row * columns + right];
            for (known, height) in into.iter_mut().zip(line) {
                if known.is_nan() {
                    *known = *height;
                } else if !height.is_nan() {
                    let off = (*known - height).abs();
                    if off > SAME {
                        raster.seam = raster.seam.max(off);
                        *known = known.midpoint(*height);
                    }
                }
            }
        }
        budget.give(tile.columns * tile.rows * size_of::<f32>());
        raster.surplus += tile.surplus;
        raster.marks.join(tile.marks);
    }
    if covered.contains(&false) {
        raster.parts = parts;
    }
    Ok(raster)
}

/// Returns a name for messages.
fn file_names(tiles: &[Raster]) -> Cow<'_, str> {
    match tiles {
        [one] => one.name.as_str().into(),
        [first, second] => format!("{} and {}", first.name, second.name).into(),
        [first, .., last] => format!("{} to {} ({} files)", first.name, last.name, tiles.len()).into(),
        [] => "".into(),
    }
}

/// Makes longitudes continuous for rasters on both sides of the date line.
fn unwrap_longitudes(tiles: &mut [Raster]) {
    let longitudes = || tiles.iter().map(|tile| tile.grid.first[0]);
    let span = longitudes().fold(f64::NEG_INFINITY, f64::max) - longitudes().fold(f64::INFINITY, f64::min);
    let is_geographic = tiles.iter().all(|tile| tile.crs.as_ref().is_some_and(Crs::is_geographic));
    if is_geographic && span > 180.0 {
        tiles.iter_mut().filter(|tile| tile.grid.first[0] < 0.0).for_each(|tile| tile.grid.first[0] += 360.0);
    }
}

/// Fails if a raster cannot be joined with another one.
fn check_same(first: &Raster, other: &Raster) -> Result<()> {
    let [a, b] = [first, other]
        .map(|tile| tile.crs.as_ref().map_or("metres of the run".into(), |crs| Cow::Owned(crs.name())));
    let warp = "resample all files to one grid: gdalwarp -t_srs EPSG:CODE -tr X Y -tap IN... OUT.tif";
    if a != b {
        let what = format!("{} is in {a}, and {} in {b}", first.name, other.name);
        return Err(Error::data(what).help(warp));
    }
    for axis in 0..2 {
        let (one, two) = (first.grid.step[axis], other.grid.step[axis]);
        let samples = count(first.columns.max(first.rows).max(other.columns).max(other.rows));
        if (one - two).abs() * samples > TOLERANCE * one {
            let what = format!(
                "{} has a height every {one} towards the {}, and {} every {two}",
                first.name,
                ["east", "north"][axis],
                other.name
            );
            return Err(Error::data(what).help(warp));
        }
    }
    Ok(())
}

/// Returns the columns and rows of the grid that a raster covers. Fails if its samples are not aligned with the grid.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
fn place(grid: &SampleGrid, tile: &Raster, first: &str) -> Result<[usize; 4]> {
    let [x, y] = tile.grid.first;
    let offset = [(x - grid.first[0]) / grid.step[0], (grid.first[1] - y) / grid.step[1]];
    for axis in offset {
        if (axis - axis.round()).abs() > TOLERANCE || !(axis.round() >= 0.0 && axis < 1e9) {
            let what =
                format!("the heights of {} are not on the same grid as the heights of {first}", tile.name);
            return Err(
                Error::data(what).help("resample all files to one grid: gdalwarp -tr X Y -tap IN... OUT.tif")
            );
        }
    }
    let [left, top] = offset.map(|axis| axis.round() as usize);
    Ok([left, top, left + tile.columns, top + tile.rows])
}

/// Counts the missing samples within the parts.
pub(super) fn count_missing(raster: &Raster) -> usize {
    let missing = raster.heights.iter().enumerate().filter(|(_, height)| height.is_nan());
    missing.filter(|(index, _)| raster.parts.is_empty() || is_covered(raster, *index)).count()
}

fn is_covered(raster: &Raster, index: usize) -> bool {
    let (column, row) = (index % raster.columns, index / raster.columns);
    raster
        .parts
        .iter()
        .any(|[left, top, right, bottom]| (*left..*right).contains(&column) && (*top..*bottom).contains(&row))
}

/// Extends the heights of the parts into the gaps, so interpolation at the edges of parts works as at the edges of
/// rasters. The heights in gaps are never queried.
pub(super) fn extend(raster: &mut Raster) {
    if raster.parts.is_empty() {
        return;
    }
    let Raster { columns, rows, parts, heights, .. } = raster;
    let columns = *columns;
    let mut last: Option<usize> = None;
    let mut bare = Vec::new();
    for row in 0..*rows {
        let spans: Vec<(usize, usize)> = parts
            .iter()
            .filter(|[_, top, _, bottom]| (*top..*bottom).contains(&row))
            .map(|[left, _, right, _]| (*left, *right))
            .collect();
        let line = &mut heights[row * columns..][..columns];
        let inside = |column: usize| spans.iter().any(|(left, right)| (*left..*right).contains(&column));
        // Columns in gaps, and the nearest known heights to the west and to the east of each column.
        let mut west: Option<(usize, f32)> = None;
        let mut from_west = vec![None; columns];
        for column in 0..columns {
            match inside(column) {
                true if !line[column].is_nan() => west = Some((column, line[column])),
                true => {}
                false => from_west[column] = west,
            }
        }
        let mut east: Option<(usize, f32)> = None;
        for column in (0..columns).rev() {
            if inside(column) {
                if !line[column].is_nan() {
                    east = Some((column, line[column]));
                }
                continue;
            }
            line[column] = match (from_west[column], east) {
                (Some((left, height)), Some((right, _))) if column - left <= right - column => height,
                (_, Some((_, height))) | (Some((_, height)), None) => height,
                (None, None) => f32::NAN,
            };
        }
        if west.is_none() {
            bare.push((row, last));
        } else {
            last = Some(row);
        }
    }
    for (row, above) in bare {
        let below = (row + 1..raster.rows).find(|below| !raster.heights[below * columns].is_nan());
        let Some(from) = above.or(below) else { continue };
        let spans: Vec<(usize, usize)> = parts
            .iter()
            .filter(|[_, top, _, bottom]| (*top..*bottom).contains(&row))
            .map(|[left, _, right, _]| (*left, *right))
            .collect();
        for column in 0..columns {
            if !spans.iter().any(|(left, right)| (*left..*right).contains(&column)) {
                raster.heights[row * columns + column] = raster.heights[from * columns + column];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elevation::Relief;
    use crate::heights::narrow;
    use burgeon_spatial::ReferenceFrame;
    use glam::DVec2;
    use std::sync::Arc;

    /// Returns the height of a smooth terrain.
    fn ground(x: f64, y: f64) -> f64 {
        500.0 + 200.0 * (x * 9.0).sin() + 100.0 * (y * 7.0).cos()
    }

    /// Returns a tile of one degree with `side` by `side` samples; its south-west corner is at whole degrees.
    fn tile([x, y]: [f64; 2], side: usize) -> Raster {
        let step = 1.0 / count(side - 1);
        let at = |index: usize| {
            narrow(ground(x + count(index % side) * step, y + 1.0 - count(index / side) * step))
        };
        let grid = SampleGrid { first: [x, y + 1.0], step: [step; 2] };
        let name = format!("{x} {y}");
        Raster::new(
            &name,
            [side, side],
            (0..side * side).map(at).collect(),
            grid,
            Some(Crs::epsg(4326).unwrap()),
        )
    }

    fn joined(tiles: Vec<Raster>) -> Raster {
        let mut raster = join(tiles, &Budget::default()).unwrap();
        raster.filled = count_missing(&raster);
        extend(&mut raster);
        super::super::fill::fill(raster.columns, raster.rows, &mut raster.heights, &Budget::default())
            .unwrap();
        raster
    }

    #[test]
    fn tiles_with_common_borders_are_the_ground_that_one_raster_would_be() {
        let side = 121;
        let corners = [[7.0, 43.0], [8.0, 43.0], [7.0, 44.0], [8.0, 44.0]];
        let raster = joined(corners.map(|corner| tile(corner, side)).to_vec());
        assert_eq!((raster.columns, raster.rows, raster.filled, raster.seam), (241, 241, 0, 0.0));
        assert!(raster.parts.is_empty());
        // The order of the files does not matter.
        let [a, b, c, d] = corners.map(|corner| tile(corner, side));
        assert_eq!(joined(vec![d, b, a, c]).heights, raster.heights);
        let step = 1.0 / 120.0;
        let whole = (0..241 * 241)
            .map(|at| narrow(ground(7.0 + count(at % 241) * step, 45.0 - count(at / 241) * step)));
        let grid = SampleGrid { first: [7.0, 45.0], step: [step; 2] };
        let whole = Raster::new("a", [241, 241], whole.collect(), grid, Some(Crs::epsg(4326).unwrap()));
        let frame = || Some(ReferenceFrame::around(&Crs::epsg(4326).unwrap(), [8.0, 44.0], "a").unwrap());
        let [one, many] = [whole, raster].map(|raster| Relief::new(Arc::new(raster), &mut frame()).unwrap());
        // Across the seam, which passes through the origin, positions are one metre apart.
        let (mut worst, mut jump): (f64, f64) = (0.0, 0.0);
        for along in -400..400 {
            let mut last: Option<f64> = None;
            for across in -20..20 {
                let place = DVec2::new(f64::from(across), f64::from(along) * 100.0 + 0.3);
                let (a, b) = (one.height(place).unwrap(), many.height(place).unwrap());
                worst = worst.max((a - b).abs());
                jump = jump.max(last.map_or(0.0, |last| (last - b).abs()));
                last = Some(b);
            }
        }
        assert!(worst < 1e-3 && jump < 0.2, "{worst} {jump}");
    }

    #[test]
    fn gaps_between_tiles_have_no_heights_and_holes_are_filled_across_seams() {
        let side = 61;
        let mut east = tile([8.0, 43.0], side);
        let west = tile([7.0, 43.0], side);
        // A hole at the common border, and a hole in the border whose heights the other tile contains.
        for row in 20..40 {
            for column in 1..8 {
                east.heights[row * side + column] = f32::NAN;
            }
        }
        (0..side).for_each(|row| east.heights[row * side] = f32::NAN);
        let raster = joined(vec![west, east, tile([7.0, 44.0], side)]);
        assert_eq!((raster.filled, raster.parts.len()), (140, 3));
        let mut frame = None;
        let relief = Relief::new(Arc::new(raster), &mut frame).unwrap();
        let frame = frame.unwrap();
        let crs = Crs::epsg(4326).unwrap();
        let passage = frame.passage(&crs).unwrap();
        let at = |x: f64, y: f64| relief.height(DVec2::from(passage.enter([x, y])));
        assert_eq!((at(8.5, 44.5), at(8.02, 44.02)), (None, None));
        for (x, y) in
            [(7.5, 43.5), (8.9, 43.9), (7.1, 44.9), (8.0, 43.999), (7.999, 44.5), (8.005, 43.5), (8.07, 43.5)]
        {
            let height = at(x, y).unwrap();
            assert!((height - ground(x, y)).abs() < 6.0, "{x} {y}: {height} is not {}", ground(x, y));
        }
    }

    #[test]
    fn files_that_do_not_fit_together_are_refused_and_seams_that_differ_are_reported() {
        let told = |a: Raster, b: Raster| join(vec![a, b], &Budget::default()).unwrap_err().to_string();
        let coarse = told(tile([7.0, 43.0], 61), tile([8.0, 43.0], 121));
        assert!(coarse.contains("a height every") && coarse.contains("gdalwarp"), "{coarse}");
        let mut moved = tile([8.0, 43.0], 61);
        moved.grid.first[0] += moved.grid.step[0] * 0.4;
        assert!(told(tile([7.0, 43.0], 61), moved).contains("not on the same grid"));
        let mut metres = tile([8.0, 43.0], 61);
        metres.crs = Some(Crs::epsg(3067).unwrap());
        assert!(told(tile([7.0, 43.0], 61), metres).contains("is in EPSG:4326, and"));
        let far = told(tile([7.0, 43.0], 1201), tile([27.0, -43.0], 1201));
        assert!(far.contains("more than 200 million"), "{far}");
        let mut higher = tile([8.0, 43.0], 61);
        higher.heights.iter_mut().for_each(|height| *height += 3.0);
        let raster = join(vec![tile([7.0, 43.0], 61), higher], &Budget::default()).unwrap();
        assert!((raster.seam - 3.0).abs() < 1e-3, "{}", raster.seam);
        let over = join(vec![tile([179.0, 10.0], 61), tile([-180.0, 10.0], 61)], &Budget::default()).unwrap();
        assert_eq!((over.columns, over.rows), (121, 61));
    }
}
