//! Writer of well-known text.

use std::fmt::{self, Write};

use burgeon_geometry::Rings;
use glam::DVec3;

use crate::Geometry;

impl Geometry {
    /// Returns well-known text: every number as the shortest decimal that reads back the same, with heights
    /// if a point has one.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let text = "POLYGON ((0 0, 4 0, 4 2.5, 0 0), (1 0.25, 2 0.25, 2 0.5, 1 0.25))";
    /// assert_eq!(Geometry::from_wkt(text)?.to_wkt(), text);
    /// assert_eq!(Geometry::from_wkt("point z(1 2 3)")?.to_wkt(), "POINT Z (1 2 3)");
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn to_wkt(&self) -> String {
        self.to_string()
    }

    /// Returns well-known text, truncated with "..." after about `most` bytes.
    pub fn to_short_wkt(&self, most: usize) -> String {
        let mut text = Short { text: String::new(), most };
        match write!(text, "{self}") {
            Ok(()) => text.text,
            Err(fmt::Error) => text.text + "...",
        }
    }
}

/// A string with a maximum length.
struct Short {
    text: String,
    most: usize,
}

impl Write for Short {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        if self.text.len() + text.len() > self.most {
            return Err(fmt::Error);
        }
        self.text.push_str(text);
        Ok(())
    }
}

impl fmt::Display for Geometry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_geometry(self, self.has_heights(), f)
    }
}

fn write_geometry(geometry: &Geometry, heights: bool, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    f.write_str(geometry.kind().wkt())?;
    f.write_str(if heights { " Z" } else { "" })?;
    let count = match geometry {
        Geometry::Point(point) => point.iter().len(),
        Geometry::Line(points) | Geometry::MultiPoint(points) => points.len(),
        Geometry::Polygon(rings) => rings.len(),
        Geometry::MultiLine(lines) => lines.len(),
        Geometry::MultiPolygon(polygons) => polygons.len(),
        Geometry::Collection(members) => members.len(),
    };
    if count == 0 {
        return f.write_str(" EMPTY");
    }
    f.write_str(" (")?;
    let place = |point: &DVec3, f: &mut fmt::Formatter<'_>| write_point(*point, heights, f);
    match geometry {
        Geometry::Point(point) => list(point.iter(), f, place),
        Geometry::Line(points) => list(points, f, place),
        Geometry::MultiPoint(points) => list(points, f, |point, f| {
            f.write_str("(")?;
            place(point, f)?;
            f.write_str(")")
        }),
        Geometry::Polygon(rings) => write_rings(rings, heights, f),
        Geometry::MultiLine(lines) => list(lines, f, |line, f| {
            if line.is_empty() {
                return f.write_str("EMPTY");
            }
            f.write_str("(")?;
            list(line, f, place)?;
            f.write_str(")")
        }),
        Geometry::MultiPolygon(polygons) => list(polygons, f, |rings, f| {
            if rings.is_empty() {
                return f.write_str("EMPTY");
            }
            f.write_str("(")?;
            write_rings(rings, heights, f)?;
            f.write_str(")")
        }),
        Geometry::Collection(members) => list(members, f, |member, f| write_geometry(member, heights, f)),
    }?;
    f.write_str(")")
}

fn list<T>(
    items: impl IntoIterator<Item = T>,
    f: &mut fmt::Formatter<'_>,
    mut each: impl FnMut(T, &mut fmt::Formatter<'_>) -> fmt::Result,
) -> fmt::Result {
    for (index, item) in items.into_iter().enumerate() {
        f.write_str(if index > 0 { ", " } else { "" })?;
        each(item, f)?;
    }
    Ok(())
}

/// Writes rings, each with its first point repeated at its end.
fn write_rings(rings: &Rings, heights: bool, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    list(rings.iter(), f, |ring, f| {
        f.write_str("(")?;
        list(ring.iter().chain(ring.first()), f, |point, f| write_point(*point, heights, f))?;
        f.write_str(")")
    })
}

fn write_point(DVec3 { x, y, z }: DVec3, heights: bool, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    write_number(x, f)?;
    f.write_str(" ")?;
    write_number(y, f)?;
    if heights {
        f.write_str(" ")?;
        write_number(z, f)?;
    }
    Ok(())
}

/// Writes the shortest decimal that reads back as the same number.
pub fn write_number(value: f64, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    if value == 0.0 {
        f.write_str("0")
    } else if value.is_finite() && !(1e-7..1e21).contains(&value.abs()) {
        write!(f, "{value:e}")
    } else {
        write!(f, "{value}")
    }
}
