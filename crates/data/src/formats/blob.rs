//! Geometries in the encoding of GeoPackages: a header followed by well-known binary.

use burgeon_base::budget::Budget;
use burgeon_spatial::{Geometry, wkb};

/// Reads a GeoPackage blob; returns the parts of its geometry, none if it is empty. Fails with the reason.
///
/// Arcs are approximated by lines with a maximum distance of `near` (in units of the geometry).
///
/// Source: OGC 12-128r18, GeoPackage Encoding Standard, clause 2.1.3.
pub(super) fn read_blob(bytes: &[u8], near: f64, budget: &Budget) -> Result<Vec<Geometry>, String> {
    wkb::read(body(bytes)?, near, budget).map(Geometry::into_parts)
}

/// Returns the well-known binary after the header of a blob.
fn body(bytes: &[u8]) -> Result<&[u8], String> {
    if !bytes.starts_with(b"GP") || bytes.len() < 8 {
        return Err("is not a GeoPackage geometry".into());
    }
    let flags = bytes[3];
    if flags & 0x20 != 0 {
        return Err("has an extended type".into());
    }
    let envelope = match (flags >> 1) & 7 {
        0 => 0,
        1 => 32,
        2 | 3 => 48,
        4 => 64,
        _ => return Err("has an unknown envelope".into()),
    };
    // The flag for empty geometries is redundant with the content.
    bytes.get(8 + envelope..).ok_or_else(|| "ends too early".into())
}

/// Returns the bounds (west, south, east, north) in the header of a blob.
pub(super) fn envelope(bytes: &[u8]) -> Option<[f64; 4]> {
    if !bytes.starts_with(b"GP") || (bytes.get(3)? >> 1) & 7 == 0 {
        return None;
    }
    let is_little = bytes[3] & 1 == 1;
    let number = |at: usize| {
        let bytes = bytes.get(8 + 8 * at..16 + 8 * at)?.try_into().ok()?;
        Some(if is_little { f64::from_le_bytes(bytes) } else { f64::from_be_bytes(bytes) })
    };
    Some([number(0)?, number(2)?, number(1)?, number(3)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stands_behind_a_header_of_any_length_is_read() {
        let place = Geometry::point([1.0, 2.0, 3.0]);
        for (envelope_kind, size) in [(0, 0), (1, 32), (2, 48), (3, 48), (4, 64)] {
            let mut blob = vec![b'G', b'P', 0, envelope_kind << 1, 0, 0, 0, 0];
            blob.resize(8 + size, 7);
            blob.extend(place.to_wkb());
            assert_eq!(read_blob(&blob, wkb::NEAR, &Budget::default()), Ok(vec![place.clone()]));
            assert_eq!(envelope(&blob).is_some(), envelope_kind > 0);
            for end in 0..blob.len() {
                assert!(read_blob(&blob[..end], wkb::NEAR, &Budget::default()).is_err(), "{end}");
            }
        }
        for flags in [0x20, 5 << 1] {
            assert!(body(&[b'G', b'P', 0, flags, 0, 0, 0, 0]).is_err());
        }
    }
}
