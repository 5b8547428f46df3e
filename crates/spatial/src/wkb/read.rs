//! Reader of well-known binary: ISO and extended, in both byte orders, with Z and M.
//!
//! Curves become lines: straight parts stay unchanged, arcs are divided.
//!
//! The reader is implemented here because it must be bounded: 13 bytes that claim 2^32 points make other
//! readers allocate memory for all of them, which ends the program. This reader allocates only for the data
//! that exist.

use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result as BurgeonResult};
use glam::DVec3;

use super::{NEAR, add_arc};
use crate::{DEEPEST, Geometry};

impl Geometry {
    /// Reads a geometry from well-known binary.
    ///
    /// M and the number of a reference system are skipped. Curves become lines within a centimetre of them if
    /// the unit is a metre.
    ///
    /// Fails if the data end too early, are nested deeper than [`DEEPEST`], have an unknown type, or have a
    /// coordinate that is not finite.
    pub fn from_wkb(bytes: &[u8]) -> BurgeonResult<Self> {
        let geometry = read(bytes, NEAR, &Budget::default()).map_err(|why| {
            Error::data(format!("well-known binary {why}")).help("pass the result of ST_AsBinary")
        })?;
        geometry.check().map_err(Error::of_data)?;
        Ok(geometry)
    }
}

/// Reads a geometry from well-known binary with any coordinates. Fails with the reason, as a clause that
/// follows the name of the source.
///
/// Arcs become lines that are at most `near` (in the unit of the data) from them.
pub fn read(bytes: &[u8], near: f64, budget: &Budget) -> Result<Geometry, String> {
    let mut reader = WkbReader { bytes, little: true, near, budget };
    reader.geometry(|_| true, 0)
}

/// Returns the number of the reference system in extended well-known binary.
pub fn srid(bytes: &[u8]) -> Option<u32> {
    let read = |from: usize| {
        let word: [u8; 4] = bytes.get(from..from + 4)?.try_into().ok()?;
        Some(if bytes[0] == 1 { u32::from_le_bytes(word) } else { u32::from_be_bytes(word) })
    };
    (read(1)? & 0x2000_0000 != 0).then(|| read(5)).flatten()
}

const ENDS: &str = "ends too early";

/// Filter of the allowed types of a part.
type TypeFilter = fn(u32) -> bool;

struct WkbReader<'a> {
    bytes: &'a [u8],
    little: bool,
    near: f64,
    budget: &'a Budget,
}

/// Header of a geometry: its type, and whether its points have Z and M.
#[derive(Clone, Copy)]
struct GeometryHeader {
    kind: u32,
    z: bool,
    m: bool,
}

impl GeometryHeader {
    /// Returns the size (bytes) of each point.
    fn point_size(self) -> usize {
        16 + 8 * (usize::from(self.z) + usize::from(self.m))
    }
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

    /// Reads a number of items of at least `size` bytes each, so that a wrong number causes no large
    /// allocation.
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
        // Some programs write NaN for an unknown height.
        Ok(if point.z.is_nan() { point.with_z(0.0) } else { point })
    }

    fn points(&mut self, head: GeometryHeader) -> Result<Vec<DVec3>, String> {
        let count = self.count(head.point_size())?;
        let mut points = Vec::with_capacity(count);
        for _ in 0..count {
            points.push(self.point(head)?);
        }
        Ok(points)
    }

    /// Reads the points of a ring, and drops a last point that repeats the first before it takes up memory.
    fn ring(&mut self, head: GeometryHeader) -> Result<Vec<DVec3>, String> {
        let count = self.count(head.point_size())?;
        let mut points: Vec<DVec3> = Vec::with_capacity(count.saturating_sub(1));
        for number in 1..=count {
            let point = self.point(head)?;
            if number < count || points.first() != Some(&point) {
                points.push(point);
            }
        }
        Ok(points)
    }

    fn rings(&mut self, head: GeometryHeader) -> Result<Vec<Vec<DVec3>>, String> {
        let count = self.count(4)?;
        let mut rings = Vec::with_capacity(count);
        for _ in 0..count {
            rings.push(self.ring(head)?);
        }
        Ok(rings)
    }

    /// Reads the header of a geometry whose type is `allowed`.
    fn head(&mut self, allowed: TypeFilter) -> Result<GeometryHeader, String> {
        self.little = match self.take::<1>()? {
            [0] => false,
            [1] => true,
            _ => return Err("has an unknown byte order".into()),
        };
        let code = self.u32()?;
        let (flags, code) = (code & 0xe000_0000, code & 0x1fff_ffff);
        let (thousands, kind) = (code / 1000, code % 1000);
        if flags & 0x2000_0000 != 0 {
            self.u32()?;
        }
        if thousands > 3 || !allowed(kind) {
            return Err(format!("has a part of the wrong type {code}"));
        }
        let (z, m) =
            (flags & 0x8000_0000 != 0 || thousands & 1 != 0, flags & 0x4000_0000 != 0 || thousands & 2 != 0);
        Ok(GeometryHeader { kind, z, m })
    }

    /// Reads a geometry. Lines of one point become empty, as do polygons without three points; such holes are
    /// omitted.
    fn geometry(&mut self, allowed: TypeFilter, depth: usize) -> Result<Geometry, String> {
        self.budget.tick().map_err(|error| error.into_message())?;
        if depth > DEEPEST {
            return Err(format!("is nested more than {DEEPEST} deep"));
        }
        let head = self.head(allowed)?;
        Ok(match head.kind {
            1 => {
                let point = self.point(head)?;
                // An empty point is written as NaN coordinates.
                Geometry::Point((!(point.x.is_nan() && point.y.is_nan())).then_some(point))
            }
            2 | 8 | 9 => Geometry::line(self.curve_of(head)?).unwrap_or(Geometry::empty(1)),
            3 | 17 => Geometry::polygon(self.rings(head)?).unwrap_or(Geometry::empty(2)),
            10 => {
                let rings = (0..self.count(9)?).map(|_| self.curve(|kind| matches!(kind, 2 | 8 | 9)));
                let rings = rings.collect::<Result<Vec<_>, String>>()?;
                Geometry::polygon(rings).unwrap_or(Geometry::empty(2))
            }
            4 => Geometry::MultiPoint(self.members(
                |kind| kind == 1,
                depth,
                |part| match part {
                    Geometry::Point(point) => point,
                    _ => None,
                },
            )?),
            5 | 11 => {
                let allowed: TypeFilter =
                    if head.kind == 5 { |kind| kind == 2 } else { |kind| matches!(kind, 2 | 8 | 9) };
                Geometry::MultiLine(self.members(allowed, depth, |part| match part {
                    Geometry::Line(line) if !line.is_empty() => Some(line),
                    _ => None,
                })?)
            }
            6 | 12 | 15 | 16 => {
                let allowed: TypeFilter = match head.kind {
                    12 => |kind| matches!(kind, 3 | 10),
                    16 => |kind| kind == 17,
                    _ => |kind| kind == 3,
                };
                Geometry::MultiPolygon(self.members(allowed, depth, |part| match part {
                    Geometry::Polygon(rings) if !rings.is_empty() => Some(rings),
                    _ => None,
                })?)
            }
            7 => Geometry::Collection(self.members(|_| true, depth, Some)?),
            kind => return Err(format!("has the unknown type {kind}")),
        })
    }

    /// Reads the parts of a geometry, converted by `each`.
    fn members<T>(
        &mut self,
        allowed: TypeFilter,
        depth: usize,
        each: impl Fn(Geometry) -> Option<T>,
    ) -> Result<Vec<T>, String> {
        let mut members = Vec::new();
        for _ in 0..self.count(5)? {
            members.extend(each(self.geometry(allowed, depth + 1)?));
        }
        Ok(members)
    }

    /// Reads the points of a curve whose type is `allowed`.
    fn curve(&mut self, allowed: TypeFilter) -> Result<Vec<DVec3>, String> {
        let head = self.head(allowed)?;
        self.curve_of(head)
    }

    /// Reads the points of a line, a circular string or a compound curve after its header.
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
                    let arc = [given[from], given[from + 1], given[from + 2]];
                    let room = |count: usize| self.budget.take(count * 24);
                    add_arc(&mut points, arc, self.near, room)
                        .and_then(|()| self.budget.tick())
                        .map_err(|error| error.into_message())?;
                }
                Ok(points)
            }
            9 => {
                let mut points: Vec<DVec3> = Vec::new();
                for _ in 0..self.count(9)? {
                    let part = self.curve(|kind| matches!(kind, 2 | 8))?;
                    // Each part begins at the end of the previous one.
                    let same = points.last().is_some_and(|last| part.first() == Some(last));
                    points.extend(part.into_iter().skip(usize::from(same)));
                }
                Ok(points)
            }
            _ => self.points(head),
        }
    }
}
