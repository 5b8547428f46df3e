//! Geometries as bytes: GeoPackage's header, and well-known binary in both byte orders with Z and M.
//!
//! Curves become lines: their straight parts stay as they are, their arcs are divided.
//!
//! The reader is our own, since it must be bounded: 13 bytes that claim 2^32 points make geozero ask for the memory
//! of all of them, which ends the program. Here room is made for what is there.

use glam::DVec3;

use super::super::{DEEPEST, Geometry};
use super::arc;
use burgeon_base::budget::Budget;

/// Reads one blob of a GeoPackage: its geometry's parts, none if it is empty. Fails with the reason.
///
/// Arcs become lines that are at most `near` (in its own units) from them.
///
/// Source: OGC 12-128r18, GeoPackage Encoding Standard, clause 2.1.3.
pub(super) fn read_blob(bytes: &[u8], near: f64, budget: &Budget) -> Result<Vec<Geometry>, String> {
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
    let mut reader = WkbReader { bytes: body, little: true, near, budget };
    let mut parts = Vec::new();
    reader.geometry(&mut parts, |_| true, 0)?;
    Ok(parts)
}

const ENDS: &str = "ends too early";

/// The types that may stand in a place.
type TypeFilter = fn(u32) -> bool;

struct WkbReader<'a> {
    bytes: &'a [u8],
    little: bool,
    near: f64,
    budget: &'a Budget,
}

/// What stands before each geometry: its type, and whether its points have Z and M.
#[derive(Clone, Copy)]
struct GeometryHeader {
    kind: u32,
    z: bool,
    m: bool,
}

impl WkbReader<'_> {
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

    fn point(&mut self, head: GeometryHeader) -> Result<DVec3, String> {
        let point = DVec3::new(self.f64()?, self.f64()?, if head.z { self.f64()? } else { 0.0 });
        if head.m {
            self.f64()?;
        }
        // Some programs write a height that is not known so.
        Ok(if point.z.is_nan() { point.with_z(0.0) } else { point })
    }

    fn points(&mut self, head: GeometryHeader) -> Result<Vec<DVec3>, String> {
        let size = 16 + 8 * (usize::from(head.z) + usize::from(head.m));
        let count = self.count(size)?;
        (0..count).map(|_| self.point(head)).collect()
    }

    fn rings(&mut self, head: GeometryHeader) -> Result<Vec<Vec<DVec3>>, String> {
        let count = self.count(4)?;
        (0..count).map(|_| self.points(head)).collect()
    }

    /// The head of a geometry of a type that is `allowed` here.
    fn head(&mut self, allowed: TypeFilter) -> Result<GeometryHeader, String> {
        self.little = match self.take::<1>()? {
            [0] => false,
            [1] => true,
            _ => return Err("has a byte order that is not known".into()),
        };
        let code = self.u32()?;
        let (flags, code) = (code & 0xe000_0000, code & 0x1fff_ffff);
        let (thousands, kind) = (code / 1000, code % 1000);
        if flags & 0x2000_0000 != 0 {
            self.u32()?;
        }
        if thousands > 3 || !allowed(kind) {
            return Err(format!("has a part of type {code}, which does not belong there"));
        }
        let (z, m) =
            (flags & 0x8000_0000 != 0 || thousands & 1 != 0, flags & 0x4000_0000 != 0 || thousands & 2 != 0);
        Ok(GeometryHeader { kind, z, m })
    }

    /// Adds the parts of one geometry.
    fn geometry(
        &mut self,
        parts: &mut Vec<Geometry>,
        allowed: TypeFilter,
        depth: usize,
    ) -> Result<(), String> {
        self.budget.tick().map_err(|error| error.message().to_owned())?;
        if depth > DEEPEST {
            return Err(format!("is nested more than {DEEPEST} deep"));
        }
        let head = self.head(allowed)?;
        match head.kind {
            1 => {
                let point = self.point(head)?;
                // So is an empty point written.
                if !(point.x.is_nan() && point.y.is_nan()) {
                    parts.push(Geometry::Point(point));
                }
            }
            2 | 8 | 9 => parts.extend(Geometry::line(self.curve_of(head)?)),
            3 | 17 => parts.extend(Geometry::polygon(self.rings(head)?)),
            10 => {
                let rings = (0..self.count(9)?).map(|_| self.curve(|kind| matches!(kind, 2 | 8 | 9)));
                let rings = rings.collect::<Result<Vec<_>, String>>()?;
                parts.extend(Geometry::polygon(rings));
            }
            4..=7 | 11 | 12 | 15 | 16 => {
                let allowed: TypeFilter = match head.kind {
                    4 => |kind| kind == 1,
                    5 => |kind| kind == 2,
                    6 | 15 => |kind| kind == 3,
                    11 => |kind| matches!(kind, 2 | 8 | 9),
                    12 => |kind| matches!(kind, 3 | 10),
                    16 => |kind| kind == 17,
                    _ => |_| true,
                };
                for _ in 0..self.count(5)? {
                    self.geometry(parts, allowed, depth + 1)?;
                }
            }
            kind => return Err(format!("is of type {kind}, which is not known")),
        }
        Ok(())
    }

    /// The points of a curve of a type that is `allowed` here.
    fn curve(&mut self, allowed: TypeFilter) -> Result<Vec<DVec3>, String> {
        let head = self.head(allowed)?;
        self.curve_of(head)
    }

    /// The points of a line, a circular string or a compound of these, whose head has been read.
    fn curve_of(&mut self, head: GeometryHeader) -> Result<Vec<DVec3>, String> {
        match head.kind {
            8 => {
                let given = self.points(head)?;
                if given.is_empty() {
                    return Ok(given);
                }
                if given.len() < 3 || given.len().is_multiple_of(2) {
                    return Err(format!("has a circular string of {} points", given.len()));
                }
                let mut points = vec![given[0]];
                for from in (0..given.len() - 2).step_by(2) {
                    let before = points.len();
                    arc::add(&mut points, [given[from], given[from + 1], given[from + 2]], self.near);
                    self.budget
                        .take((points.len() - before) * 24)
                        .map_err(|error| error.message().to_owned())?;
                    self.budget.tick().map_err(|error| error.message().to_owned())?;
                }
                Ok(points)
            }
            9 => {
                let mut points: Vec<DVec3> = Vec::new();
                for _ in 0..self.count(9)? {
                    let part = self.curve(|kind| matches!(kind, 2 | 8))?;
                    // Each begins where the one before it ends.
                    let same = points.last().is_some_and(|last| part.first() == Some(last));
                    points.extend(part.into_iter().skip(usize::from(same)));
                }
                Ok(points)
            }
            _ => self.points(head),
        }
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

    fn read_blob(bytes: &[u8]) -> Result<Vec<Geometry>, String> {
        super::read_blob(bytes, arc::NEAR, &Budget::default())
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
                    assert_eq!(
                        read,
                        Ok(vec![Geometry::Point(DVec3::new(1.0, 2.0, *z))]),
                        "{code} {envelope}"
                    );
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
        for code in [2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 15, 16, 17] {
            assert!(read_blob(&blob(0, 0, &body(true, code, &[Err(u32::MAX)]))).is_err(), "{code}");
        }
        for code in [0, 13, 14, 18, 99, 4001] {
            assert!(read_blob(&blob(0, 0, &body(true, code, &[Err(0)]))).is_err(), "{code}");
        }
        // A multi-polygon that contains itself would nest without end.
        let nested = body(true, 6, &[Err(1)]).into_iter().chain(body(true, 6, &[Err(0)])).collect::<Vec<_>>();
        assert!(read_blob(&blob(0, 0, &nested)).is_err());
    }
    /// Well-known binary of a type, with the parts that it is made of behind their number.
    fn of_parts(code: u32, parts: &[Vec<u8>]) -> Vec<u8> {
        let count = u32::try_from(parts.len()).unwrap();
        [body(true, code, &[Err(count)]), parts.concat()].concat()
    }

    fn of_points(code: u32, points: &[[f64; 2]]) -> Vec<u8> {
        let count = Err(u32::try_from(points.len()).unwrap());
        let words: Vec<_> = std::iter::once(count).chain(points.iter().flatten().map(|it| Ok(*it))).collect();
        body(true, code, &words)
    }

    #[test]
    fn curves_and_collections_become_lines_and_polygons() {
        let read = |body: &[u8]| read_blob(&blob(0, 0, body)).unwrap();
        let straight = of_points(2, &[[0.0, 0.0], [4.0, 0.0]]);
        let half = of_points(8, &[[4.0, 0.0], [2.0, 2.0], [0.0, 0.0]]);
        let compound = of_parts(9, &[straight.clone(), half.clone()]);
        let [Geometry::Line(line)] = &read(&compound)[..] else { panic!("a line") };
        assert_eq!((line[0], line[1], line.last()), (DVec3::ZERO, DVec3::X * 4.0, Some(&DVec3::ZERO)));
        assert!(
            line.len() > 10 && line[1..].iter().all(|it| ((it[0] - 2.0).hypot(it[1]) - 2.0).abs() < 1e-9)
        );
        let disc = of_parts(10, std::slice::from_ref(&compound));
        let [Geometry::Polygon(rings)] = &read(&disc)[..] else { panic!("a polygon") };
        assert_eq!(rings[0].len(), line.len() - 1);
        let ring = of_points(2, &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0]]);
        let square = of_parts(3, &[ring[5..].to_vec()]);
        let all = of_parts(
            7,
            &[
                body(true, 1, &[Ok(0.0), Ok(0.0)]),
                of_parts(11, &[straight.clone(), half.clone(), compound]),
                of_parts(12, &[disc, square.clone()]),
                of_parts(16, &[]),
                of_parts(15, std::slice::from_ref(&square)),
            ],
        );
        let kinds: Vec<_> = read(&all).iter().map(|part| part.kind().name()).collect();
        assert_eq!(kinds, ["point", "line", "line", "line", "polygon", "polygon", "polygon"]);
        // A surface of curves takes no points, and a compound no polygons.
        assert!(read_blob(&blob(0, 0, &of_parts(9, &[square]))).is_err());
        assert!(read_blob(&blob(0, 0, &of_points(8, &[[0.0, 0.0], [1.0, 1.0]]))).is_err());
        let mut nested = of_parts(7, &[]);
        for _ in 0..1000 {
            nested = of_parts(7, &[nested]);
        }
        assert!(read_blob(&blob(0, 0, &nested)).unwrap_err().contains("nested more than 32 deep"));
    }

    #[test]
    fn changed_bytes_never_make_it_panic() {
        let straight = of_points(2, &[[0.0, 0.0], [4.0, 0.0]]);
        let half = of_points(8, &[[4.0, 0.0], [2.0, 2.0], [0.0, 0.0]]);
        let disc = of_parts(10, &[of_parts(9, &[straight.clone(), half.clone()])]);
        let whole = blob(0, 0, &of_parts(7, &[of_parts(12, &[disc]), of_parts(11, &[straight, half])]));
        let (mut good, mut bad) = (0, 0);
        for at in 0..whole.len() {
            for byte in 0..=255 {
                let mut changed = whole.clone();
                changed[at] = byte;
                match read_blob(&changed) {
                    Ok(_) => good += 1,
                    Err(_) => bad += 1,
                }
            }
        }
        assert!(good > 10_000 && bad > 1000, "{good} {bad}");
    }
}
