//! Geometries in the internal database: GeoPackage blobs, and well-known binary.

use burgeon_base::budget::Budget;
use burgeon_spatial::{Geometry, wkb};

/// Maximum distance between an arc and the line that approximates it (in coordinate units).
const NEAR: f64 = 0.01;

/// Returns the well-known binary in a blob, which may be a GeoPackage blob. Fails with the reason.
fn body(bytes: &[u8]) -> Result<&[u8], &'static str> {
    if !bytes.starts_with(b"GP") {
        return Ok(bytes);
    }
    let envelope = envelope_size(bytes)?;
    bytes.get(8 + envelope..).ok_or("ends too early")
}

/// Returns the size (bytes) of the envelope in a GeoPackage blob.
fn envelope_size(bytes: &[u8]) -> Result<usize, &'static str> {
    let flags = *bytes.get(3).ok_or("ends too early")?;
    if flags & 0x20 != 0 {
        return Err("is of an extended type");
    }
    match (flags >> 1) & 7 {
        0 => Ok(0),
        1 => Ok(32),
        2 | 3 => Ok(48),
        4 => Ok(64),
        _ => Err("has an envelope that is not known"),
    }
}

/// Reads the geometry in a blob. Fails with the reason.
pub(crate) fn read(bytes: &[u8], budget: &Budget) -> Result<Geometry, String> {
    let geometry = wkb::read(body(bytes)?, NEAR, budget)?;
    if geometry.is_sound() {
        return Ok(geometry);
    }
    let is_far = geometry.points().all(|point| point.is_finite());
    let why = if is_far { "greater than 1e9" } else { "that is no finite number" };
    Err(format!("has a coordinate {why}"))
}

/// Version of blobs whose coordinates are in the reference system that they name, and not in the run's.
const FOREIGN: u8 = 0xb7;

/// Returns the code of the reference system of a blob, if it is not the run's.
pub(crate) fn foreign(bytes: &[u8]) -> Option<u32> {
    let code = bytes.strip_prefix(&[b'G', b'P', FOREIGN])?.get(1..5)?;
    Some(u32::from_le_bytes(code.try_into().ok()?))
}

/// Writes a geometry as a GeoPackage blob with its envelope.
pub(crate) fn write(geometry: &Geometry) -> Vec<u8> {
    write_in(geometry, None)
}

/// Writes a geometry as a GeoPackage blob, with the code of its reference system if it is not the run's.
pub(crate) fn write_in(geometry: &Geometry, foreign: Option<u32>) -> Vec<u8> {
    let bounds = geometry.bounds();
    let version = if foreign.is_some() { FOREIGN } else { 0 };
    let flags = 1 | if bounds.is_some() { 2 } else { 0x10 };
    let mut bytes = vec![b'G', b'P', version, flags];
    bytes.extend(foreign.unwrap_or(0).to_le_bytes());
    if let Some([low, high]) = bounds {
        for value in [low.x, high.x, low.y, high.y] {
            bytes.extend(value.to_le_bytes());
        }
    }
    bytes.extend(geometry.to_wkb());
    bytes
}

/// Returns the envelope stored in a blob, if there is one.
pub(crate) fn told_bounds(bytes: &[u8]) -> Option<[f64; 4]> {
    if !bytes.starts_with(b"GP") || bytes.get(3)? & 0x10 != 0 || envelope_size(bytes).ok()? == 0 {
        return None;
    }
    let little = bytes[3] & 1 == 1;
    let number = |index: usize| -> Option<f64> {
        let word: [u8; 8] = bytes.get(8 + 8 * index..16 + 8 * index)?.try_into().ok()?;
        Some(if little { f64::from_le_bytes(word) } else { f64::from_be_bytes(word) })
    };
    let [low_x, high_x, low_y, high_y] = [number(0)?, number(1)?, number(2)?, number(3)?];
    let bounds = [low_x, low_y, high_x, high_y];
    (bounds.iter().all(|value| value.is_finite()) && low_x <= high_x && low_y <= high_y).then_some(bounds)
}
