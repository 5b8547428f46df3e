//! Geometries as bytes: GeoPackage's header, and well-known binary in both byte orders with Z and M.

use super::Geometry;

/// Reads one blob of a GeoPackage: its geometry's parts, none if it is empty. Fails with the reason.
///
/// Source: OGC 12-128r18, GeoPackage Encoding Standard, clause 2.1.3.
pub(super) fn read_blob(bytes: &[u8]) -> Result<Vec<Geometry>, String> {
    if !bytes.starts_with(b"GP") || bytes.len() < 8 {
        return Err("is no geometry of a GeoPackage".into());
    }
    let flags = bytes[3];
    if flags & 0x20 != 0 {
        return Err("is of an extended type".into());
    }
    let envelope = match (flags >> 1) & 7 {
        0 => 0,
        1 => 32,
        2 | 3 => 48,
        4 => 64,
        _ => return Err("has an envelope that is not known".into()),
    };
    let body = bytes.get(8 + envelope..).ok_or(ENDS)?;
    // The flag of an empty geometry says nothing that its content does not say.
    let mut reader = Reader { bytes: body, little: true };
    let mut parts = Vec::new();
    reader.geometry(&mut parts, None)?;
    Ok(parts)
}

const ENDS: &str = "ends too early";

struct Reader<'a> {
    bytes: &'a [u8],
    little: bool,
}

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let (taken, rest) = self.bytes.split_first_chunk::<N>().ok_or(ENDS)?;
        self.bytes = rest;
        Ok(*taken)
    }

    fn u32(&mut self) -> Result<u32, String> {
        let bytes = self.take()?;
        Ok(if self.little { u32::from_le_bytes(bytes) } else { u32::from_be_bytes(bytes) })
    }

    fn f64(&mut self) -> Result<f64, String> {
        let bytes = self.take()?;
        Ok(if self.little { f64::from_le_bytes(bytes) } else { f64::from_be_bytes(bytes) })
    }

    /// A number of items that take at least `size` bytes each, so that a wrong one asks for no memory.
    fn count(&mut self, size: usize) -> Result<usize, String> {
        let count = self.u32()? as usize;
        if count > self.bytes.len() / size {
            return Err(ENDS.into());
        }
        Ok(count)
    }

    fn point(&mut self, (z, m): (bool, bool)) -> Result<[f64; 3], String> {
        let point = [self.f64()?, self.f64()?, if z { self.f64()? } else { 0.0 }];
        if m {
            self.f64()?;
        }
        // Some programs write a height that is not known so.
        Ok(if point[2].is_nan() { [point[0], point[1], 0.0] } else { point })
    }

    fn points(&mut self, dimensions: (bool, bool)) -> Result<Vec<[f64; 3]>, String> {
        let size = 16 + 8 * (usize::from(dimensions.0) + usize::from(dimensions.1));
        let count = self.count(size)?;
        (0..count).map(|_| self.point(dimensions)).collect()
    }

    /// One geometry; within a multi-geometry it must be of the type `expected`.
    fn geometry(&mut self, parts: &mut Vec<Geometry>, expected: Option<u32>) -> Result<(), String> {
        self.little = match self.take::<1>()? {
            [0] => false,
            [1] => true,
            _ => return Err("has a byte order that is not known".into()),
        };
        let code = self.u32()?;
        let (flags, code) = (code & 0xe000_0000, code & 0x1fff_ffff);
        let (thousands, kind) = (code / 1000, code % 1000);
        let dimensions =
            (flags & 0x8000_0000 != 0 || thousands & 1 != 0, flags & 0x4000_0000 != 0 || thousands & 2 != 0);
        if flags & 0x2000_0000 != 0 {
            self.u32()?;
        }
        if thousands > 3 || expected.is_some_and(|expected| expected != kind) {
            return Err(format!("has a part of type {code}, which does not belong there"));
        }
        match kind {
            1 => {
                let point = self.point(dimensions)?;
                // So is an empty point written.
                if !(point[0].is_nan() && point[1].is_nan()) {
                    parts.push(Geometry::Point(point));
                }
            }
            2 => parts.extend(Geometry::line(self.points(dimensions)?)),
            3 => {
                let count = self.count(4)?;
                let rings: Vec<_> =
                    (0..count).map(|_| self.points(dimensions)).collect::<Result<_, String>>()?;
                parts.extend(Geometry::polygon(rings));
            }
            4..=6 => {
                for _ in 0..self.count(5)? {
                    self.geometry(parts, Some(kind - 3))?;
                }
            }
            7 => return Err("is a geometry collection".into()),
            8..=17 => return Err("is a curve or a surface, not points, lines or polygons".into()),
            _ => return Err(format!("is of type {code}, which is not known")),
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A blob with an envelope of `envelope` bytes, of well-known binary made of words and numbers.
    fn blob(flags: u8, envelope: usize, body: &[u8]) -> Vec<u8> {
        let mut bytes = vec![b'G', b'P', 0, flags, 0, 0, 0, 0];
        bytes.resize(8 + envelope, 7);
        bytes.extend(body);
        bytes
    }

    fn body(little: bool, code: u32, words: &[Result<f64, u32>]) -> Vec<u8> {
        let mut bytes = vec![u8::from(little)];
        for word in [Err(code)].iter().chain(words) {
            match (word, little) {
                (Ok(number), true) => bytes.extend(number.to_le_bytes()),
                (Ok(number), false) => bytes.extend(number.to_be_bytes()),
                (Err(word), true) => bytes.extend(word.to_le_bytes()),
                (Err(word), false) => bytes.extend(word.to_be_bytes()),
            }
        }
        bytes
    }

    #[test]
    fn points_are_read_in_both_byte_orders_with_z_and_m() {
        for little in [true, false] {
            let xy = [Ok(1.0), Ok(2.0)];
            let cases: [(u32, Vec<_>, f64); 6] = [
                (1, xy.to_vec(), 0.0),
                (1001, [&xy[..], &[Ok(3.0)]].concat(), 3.0),
                (2001, [&xy[..], &[Ok(9.0)]].concat(), 0.0),
                (3001, [&xy[..], &[Ok(3.0), Ok(9.0)]].concat(), 3.0),
                (0x8000_0001, [&xy[..], &[Ok(3.0)]].concat(), 3.0),
                (0xe000_0001, [&[Err(4326)], &xy[..], &[Ok(3.0), Ok(9.0)]].concat(), 3.0),
            ];
            for (envelope, size) in [(0, 0), (1, 32), (2, 48), (3, 48), (4, 64)] {
                for (code, words, z) in &cases {
                    let read = read_blob(&blob(envelope << 1, size, &body(little, *code, words)));
                    assert_eq!(read, Ok(vec![Geometry::Point([1.0, 2.0, *z])]), "{code} {envelope}");
                }
            }
        }
    }

    #[test]
    fn empty_geometries_have_no_parts() {
        let nan = Ok(f64::NAN);
        for (code, words) in [(1, vec![nan, nan]), (2, vec![Err(0)]), (3, vec![Err(0)]), (6, vec![Err(0)])] {
            assert_eq!(read_blob(&blob(0x10, 0, &body(true, code, &words))), Ok(Vec::new()), "{code}");
        }
    }

    #[test]
    fn what_is_cut_short_or_wrong_is_refused_without_asking_for_memory() {
        let ring = [Err(1), Err(4), Ok(0.0), Ok(0.0), Ok(1.0), Ok(0.0), Ok(1.0), Ok(1.0), Ok(0.0), Ok(0.0)];
        let whole = blob(0, 0, &body(true, 3, &ring));
        assert!(matches!(&read_blob(&whole).unwrap()[..], [Geometry::Polygon(rings)] if rings[0].len() == 3));
        for end in 0..whole.len() {
            assert!(read_blob(&whole[..end]).is_err(), "{end}");
        }
        for code in [2, 3, 4, 5, 6] {
            assert!(read_blob(&blob(0, 0, &body(true, code, &[Err(u32::MAX)]))).is_err(), "{code}");
        }
        for code in [0, 7, 8, 17, 99, 4001] {
            assert!(read_blob(&blob(0, 0, &body(true, code, &[Err(0)]))).is_err(), "{code}");
        }
        // A multi-polygon that contains itself would nest without end.
        let nested = body(true, 6, &[Err(1)]).into_iter().chain(body(true, 6, &[Err(0)])).collect::<Vec<_>>();
        assert!(read_blob(&blob(0, 0, &nested)).is_err());
    }
}
