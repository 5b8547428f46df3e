//! Geometries of a `.shp` file, record by record.

use std::borrow::Cow;
use std::io::{BufReader, Read};

use glam::DVec3;

use super::rings::polygons;
use crate::content::ContentReader;
use burgeon_base::budget::Budget;
use burgeon_base::error::Result;
use burgeon_spatial::Geometry;

/// First four bytes: the number 9994.
pub(super) const MAGIC: [u8; 4] = [0, 0, 0x27, 0x0a];

/// Maximum size of a record (bytes).
const LARGEST: usize = 500_000_000;

/// Description of the damage in a file.
pub(super) type ShapeDamage = Cow<'static, str>;

/// Records of a file, from the beginning.
pub(super) struct ShapeReader {
    file: BufReader<ContentReader>,
    /// Number of the last record that was read.
    pub(super) number: usize,
    record: Vec<u8>,
}

/// Geometry of a record, and its declared bounding box.
type ShapeRecord = (ShapeResult, Option<[f64; 4]>);

/// Geometry of a record, or the reason why it cannot be read.
pub(super) type ShapeResult = std::result::Result<Vec<Geometry>, Cow<'static, str>>;

fn whole(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?))
}

fn number(bytes: &[u8], at: usize) -> Option<f64> {
    Some(f64::from_le_bytes(bytes.get(at..at + 8)?.try_into().ok()?))
}

impl ShapeReader {
    /// Reads the header. Fails with the reason.
    pub(super) fn open(file: ContentReader) -> std::result::Result<Self, ShapeDamage> {
        let mut file = BufReader::with_capacity(1 << 16, file);
        let mut header = [0; 100];
        file.read_exact(&mut header).map_err(|_| "its header is cut short")?;
        if header[..4] != MAGIC || whole(&header, 28) != Some(1000) {
            return Err("it does not begin like a shapefile".into());
        }
        Ok(Self { file, number: 0, record: Vec::new() })
    }

    /// Returns the next record's geometry and its declared bounding box; `None` at the end.
    pub(super) fn next(
        &mut self,
        budget: &Budget,
    ) -> Result<std::result::Result<Option<ShapeRecord>, ShapeDamage>> {
        budget.tick()?;
        let mut header = [0; 8];
        let mut filled = 0;
        while filled < header.len() {
            match self.file.read(&mut header[filled..]) {
                Ok(0) if filled == 0 => return Ok(Ok(None)),
                Ok(0) | Err(_) => return Ok(Err(format!("record {} is cut short", self.number + 1).into())),
                Ok(count) => filled += count,
            }
        }
        self.number += 1;
        let [_, words] = [0, 4].map(|at| header[at..at + 4].try_into().map_or(0, u32::from_be_bytes));
        let size = words as usize * 2;
        if size > LARGEST {
            return Ok(Err(format!("record {} has {size} bytes", self.number).into()));
        }
        // The bytes, and the points decoded from them.
        let held = budget.hold(size.saturating_mul(4))?;
        self.record.clear();
        let read = (&mut self.file).take(size as u64).read_to_end(&mut self.record);
        if !read.is_ok_and(|count| count == size) {
            return Ok(Err(format!("record {} is cut short", self.number).into()));
        }
        let result = shape(&self.record, budget)?;
        drop(held);
        let bounds = [4, 12, 20, 28].map(|at| number(&self.record, at));
        let is_point = matches!(whole(&self.record, 0), Some(1 | 11 | 21));
        let bounds = match bounds {
            [Some(x), Some(y), ..] if is_point => Some([x, y, x, y]),
            [Some(west), Some(south), Some(east), Some(north)] => Some([west, south, east, north]),
            _ => None,
        };
        Ok(Ok(Some((result, bounds))))
    }
}

/// Decodes the geometry in the bytes of a record.
fn shape(bytes: &[u8], budget: &Budget) -> Result<ShapeResult> {
    let short = || Cow::Borrowed("has a shape that is cut short");
    let Some(kind) = whole(bytes, 0) else { return Ok(Err(short())) };
    // Z and M values follow the points.
    let (base, has_z) = match kind {
        0 => return Ok(Ok(Vec::new())),
        11 | 13 | 15 | 18 => (kind - 10, true),
        21 | 23 | 25 | 28 => (kind - 20, false),
        kind => (kind, false),
    };
    if base == 1 {
        let point = (number(bytes, 4), number(bytes, 12), if has_z { number(bytes, 20) } else { Some(0.0) });
        let (Some(x), Some(y), Some(z)) = point else { return Ok(Err(short())) };
        return Ok(Ok(vec![Geometry::point(DVec3::new(x, y, plain(z)))]));
    }
    if !matches!(base, 3 | 5 | 8) {
        let what =
            if kind == 31 { "is a multipatch, a surface in space" } else { "has a shape of unknown type" };
        return Ok(Err(format!("{what} ({kind})").into()));
    }
    let (starts, count, first) = if base == 8 {
        (vec![0], whole(bytes, 36), 40)
    } else {
        let Some(parts) = whole(bytes, 36).map(|parts| parts as usize) else { return Ok(Err(short())) };
        let Some(table) = bytes.get(44..).and_then(|rest| rest.get(..parts.checked_mul(4)?)) else {
            return Ok(Err(short()));
        };
        let starts = table.chunks_exact(4).map(|part| part.try_into().map_or(0, u32::from_le_bytes) as usize);
        (starts.collect(), whole(bytes, 40), 44 + 4 * parts)
    };
    let Some(count) = count.map(|count| count as usize) else { return Ok(Err(short())) };
    let Some(places) = bytes.get(first..).and_then(|rest| rest.get(..count.checked_mul(16)?)) else {
        return Ok(Err(short()));
    };
    // After the points, there are the minimum and maximum height, then the heights.
    let heights = first + count * 16 + 16;
    let height = |at: usize| if has_z { number(bytes, heights + at * 8).map(plain) } else { Some(0.0) };
    let mut points = Vec::with_capacity(count);
    for (at, place) in places.chunks_exact(16).enumerate() {
        budget.tick()?;
        let (Some(x), Some(y), Some(z)) = (number(place, 0), number(place, 8), height(at)) else {
            return Ok(Err(short()));
        };
        points.push(DVec3::new(x, y, z));
    }
    if base == 8 {
        return Ok(Ok(points.into_iter().map(Geometry::point).collect()));
    }
    let ends = starts.iter().skip(1).copied().chain([count]);
    let mut parts: Vec<Vec<DVec3>> = Vec::with_capacity(starts.len());
    for (start, end) in starts.iter().copied().zip(ends) {
        match points.get(start..end) {
            Some(part) => parts.push(part.to_vec()),
            None => return Ok(Err("has parts that begin beyond its points".into())),
        }
    }
    Ok(match base {
        3 => Ok(parts.into_iter().filter_map(Geometry::line).collect()),
        _ => Ok(polygons(parts, budget)?),
    })
}

/// Returns a height; numbers below -1e38 mean that there is none.
fn plain(z: f64) -> f64 {
    if z < -1e38 { 0.0 } else { z }
}
