//! Topological relations between two geometries.

use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;
use geo::Intersects;
use glam::DVec2;

use super::Geometry;
use super::plane::Plane;
use super::topology::{self, PreparedGeometry};

/// Matrix of the dimensionally extended nine-intersection model: the dimensions in which the interior,
/// boundary and exterior of one geometry intersect those of the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Relation {
    /// Cells by row of the first geometry: interior, boundary, exterior; `F`, `0`, `1` or `2`.
    cells: [u8; 9],
}

impl Relation {
    /// Returns the nine characters.
    pub fn text(&self) -> &str {
        std::str::from_utf8(&self.cells).unwrap_or_default()
    }

    /// Returns true if the relation matches a pattern of nine characters: `*` matches anything, `T` matches
    /// 0, 1 and 2, and `F`, `0`, `1` and `2` match themselves. Fails if the pattern is invalid.
    pub fn matches(&self, pattern: &str) -> Result<bool> {
        let letters = pattern.as_bytes();
        let known =
            |letter: &u8| matches!(letter.to_ascii_uppercase(), b'*' | b'T' | b'F' | b'0' | b'1' | b'2');
        if letters.len() != 9 || !letters.iter().all(known) {
            return Err(Error::argument(format!(
                "\"{}\" is not a pattern of nine characters",
                shown(pattern)
            ))
            .help("write one of *, T, F, 0, 1 and 2 for each cell: \"F***1****\""));
        }
        Ok(self.cells.iter().zip(letters).all(|(cell, letter)| match letter.to_ascii_uppercase() {
            b'*' => true,
            b'T' => *cell != b'F',
            letter => *cell == letter,
        }))
    }

    fn is(&self, pattern: &str) -> bool {
        self.matches(pattern).unwrap_or(false)
    }
}

/// Predicates of OGC Simple Features (06-103r4, clause 6.1.15). If either geometry is empty, all are false,
/// except `disjoint`, and `equals` for two empty geometries.
///
/// ```
/// use burgeon_spatial::Geometry;
///
/// let house = Geometry::from_wkt("POLYGON ((0 0, 8 0, 8 6, 0 6, 0 0))")?;
/// let next_door = Geometry::from_wkt("POLYGON ((8 1, 14 1, 14 7, 8 7, 8 1))")?;
/// let door = Geometry::from_wkt("POINT (8 3)")?;
/// assert!(house.touches(&next_door) && house.intersects(&next_door) && !house.overlaps(&next_door));
/// assert!(house.covers(&door) && !house.contains(&door));
/// assert!(house.relate(&next_door).matches("FF*F1****")?);
/// assert_eq!(house.relate(&door).text(), "FF20F1FF2");
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
impl Geometry {
    /// Computes the dimensions in which the interiors, boundaries and exteriors of both geometries intersect.
    pub fn relate(&self, other: &Self) -> Relation {
        PreparedGeometry::new(self).relate(&PreparedGeometry::new(other))
    }

    /// Returns true if both geometries have a common point.
    pub fn intersects(&self, other: &Self) -> bool {
        if !self.is_near(other) {
            return false;
        }
        let plane = Plane::of(&[self, other]);
        plane.geo(self).intersects(&plane.geo(other))
    }

    /// Returns true if both geometries have no common point.
    pub fn disjoint(&self, other: &Self) -> bool {
        !self.intersects(other)
    }

    /// Returns true if no point of the other geometry lies outside, and at least one lies in the interior.
    pub fn contains(&self, other: &Self) -> bool {
        self.surrounds(other) && PreparedGeometry::new(self).contains(&PreparedGeometry::new(other))
    }

    /// Returns true if the other geometry contains this one.
    pub fn within(&self, other: &Self) -> bool {
        other.contains(self)
    }

    /// Returns true if no point of the other geometry lies outside; borders count as inside.
    pub fn covers(&self, other: &Self) -> bool {
        self.surrounds(other) && PreparedGeometry::new(self).covers(&PreparedGeometry::new(other))
    }

    /// Returns true if the other geometry covers this one.
    pub fn covered_by(&self, other: &Self) -> bool {
        other.covers(self)
    }

    /// Returns true if the geometries intersect, but their interiors do not.
    pub fn touches(&self, other: &Self) -> bool {
        self.is_near(other) && PreparedGeometry::new(self).touches(&PreparedGeometry::new(other))
    }

    /// Returns true if the interiors intersect in a lower dimension than the larger of the two, and each
    /// geometry has points outside the other: a line through an area, or lines that cross in points.
    pub fn crosses(&self, other: &Self) -> bool {
        self.is_near(other) && PreparedGeometry::new(self).crosses(&PreparedGeometry::new(other))
    }

    /// Returns true if both have the same dimension, their interiors intersect in that dimension, and each
    /// has points outside the other.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.is_near(other)
            && self.dimension() == other.dimension()
            && PreparedGeometry::new(self).overlaps(&PreparedGeometry::new(other))
    }

    /// Returns true if both consist of the same points, regardless of their order and division.
    pub fn equals(&self, other: &Self) -> bool {
        match [self, other].map(|it| it.is_empty() || !it.is_sound()) {
            [false, false] => {
                self == other
                    || self.bounds() == other.bounds()
                        && PreparedGeometry::new(self).equals(&PreparedGeometry::new(other))
            }
            empty => empty == [true; 2],
        }
    }

    /// Returns true if both are sound and their bounding rectangles intersect.
    fn is_near(&self, other: &Self) -> bool {
        meet(self.bounds(), other.bounds()) && self.is_sound() && other.is_sound()
    }

    /// Returns true if both are sound and the other's bounding rectangle lies within this one's.
    fn surrounds(&self, other: &Self) -> bool {
        surrounds(self.bounds(), other.bounds()) && self.is_sound() && other.is_sound()
    }
}

/// Returns true if two rectangles intersect.
fn meet(one: Option<[DVec2; 2]>, two: Option<[DVec2; 2]>) -> bool {
    one.zip(two).is_some_and(|([a, b], [c, d])| a.cmple(d).all() && c.cmple(b).all())
}

/// Returns true if the second rectangle lies within the first.
fn surrounds(one: Option<[DVec2; 2]>, two: Option<[DVec2; 2]>) -> bool {
    one.zip(two).is_some_and(|([a, b], [c, d])| a.cmple(c).all() && d.cmple(b).all())
}

/// Predicates for geometries that are compared many times.
impl PreparedGeometry {
    /// Computes the dimensions in which the interiors, boundaries and exteriors of both geometries intersect.
    pub fn relate(&self, other: &Self) -> Relation {
        Relation { cells: topology::relate(self, other, true) }
    }

    /// Computes the relation, without the exact dimension of the intersection of crossing borders.
    fn relation(&self, other: &Self) -> Relation {
        Relation { cells: topology::relate(self, other, false) }
    }

    fn is_near(&self, other: &Self) -> bool {
        self.is_sound && other.is_sound && meet(self.bounds, other.bounds)
    }

    fn surrounds(&self, other: &Self) -> bool {
        self.is_sound && other.is_sound && surrounds(self.bounds, other.bounds)
    }

    /// Returns the result of [`Geometry::contains`].
    pub fn contains(&self, other: &Self) -> bool {
        self.surrounds(other) && self.relation(other).is("T*****FF*")
    }

    /// Returns the result of [`Geometry::within`].
    pub fn within(&self, other: &Self) -> bool {
        other.contains(self)
    }

    /// Returns the result of [`Geometry::covers`].
    pub fn covers(&self, other: &Self) -> bool {
        if !self.surrounds(other) {
            return false;
        }
        let relation = self.relation(other);
        ["T*****FF*", "*T****FF*", "***T**FF*", "****T*FF*"].iter().any(|pattern| relation.is(pattern))
    }

    /// Returns the result of [`Geometry::covered_by`].
    pub fn covered_by(&self, other: &Self) -> bool {
        other.covers(self)
    }

    /// Returns the result of [`Geometry::touches`].
    pub fn touches(&self, other: &Self) -> bool {
        if !self.is_near(other) {
            return false;
        }
        let relation = self.relation(other);
        ["FT*******", "F**T*****", "F***T****"].iter().any(|pattern| relation.is(pattern))
    }

    /// Returns the result of [`Geometry::crosses`].
    pub fn crosses(&self, other: &Self) -> bool {
        if !self.is_near(other) {
            return false;
        }
        match self.dimension.cmp(&other.dimension) {
            std::cmp::Ordering::Less => self.relation(other).is("T*T******"),
            std::cmp::Ordering::Greater => self.relation(other).is("T*****T**"),
            std::cmp::Ordering::Equal => self.dimension == 1 && self.relation(other).is("0********"),
        }
    }

    /// Returns the result of [`Geometry::overlaps`].
    pub fn overlaps(&self, other: &Self) -> bool {
        if !self.is_near(other) || self.dimension != other.dimension {
            return false;
        }
        let pattern = if self.dimension == 1 { "1*T***T**" } else { "T*T***T**" };
        self.relation(other).is(pattern)
    }

    /// Returns the result of [`Geometry::equals`].
    pub fn equals(&self, other: &Self) -> bool {
        match [self, other].map(|it| it.bounds.is_none() || !it.is_sound) {
            [false, false] => {
                self.whole == other.whole
                    || self.bounds == other.bounds && self.relation(other).is("T*F**FFF*")
            }
            empty => empty == [true; 2],
        }
    }
}
