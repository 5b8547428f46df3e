//! How two geometries lie to each other.

use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;
use geo::Intersects;
use glam::DVec2;

use super::Geometry;
use super::plane::Plane;
use super::topology::{self, PreparedGeometry};

/// What the dimensionally extended nine-intersection model says of two geometries: the dimensions in which the
/// interior, the boundary and the exterior of one meet those of the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Relation {
    /// Row by row, of the first geometry: interior, boundary, exterior; `F`, `0`, `1` or `2`.
    cells: [u8; 9],
}

impl Relation {
    /// Its nine letters.
    pub fn text(&self) -> &str {
        std::str::from_utf8(&self.cells).unwrap_or_default()
    }

    /// Whether it is as a pattern says: nine letters, of which `*` is anything, `T` is 0, 1 or 2, and `F`, `0`, `1` and
    /// `2` are themselves. Fails if that is no pattern.
    pub fn matches(&self, pattern: &str) -> Result<bool> {
        let letters = pattern.as_bytes();
        let known =
            |letter: &u8| matches!(letter.to_ascii_uppercase(), b'*' | b'T' | b'F' | b'0' | b'1' | b'2');
        if letters.len() != 9 || !letters.iter().all(known) {
            return Err(Error::argument(format!("\"{}\" is no pattern of nine letters", shown(pattern)))
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

/// The predicates of OGC Simple Features (06-103r4, clause 6.1.15). Where one geometry is empty, all are false, but for
/// `disjoint`, and `equals` of two that are.
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
    /// The dimensions in which interiors, boundaries and exteriors of the two meet.
    pub fn relate(&self, other: &Self) -> Relation {
        PreparedGeometry::new(self).relate(&PreparedGeometry::new(other))
    }

    /// Whether they have a point in common.
    pub fn intersects(&self, other: &Self) -> bool {
        if !self.is_near(other) {
            return false;
        }
        let plane = Plane::of(&[self, other]);
        plane.geo(self).intersects(&plane.geo(other))
    }

    /// Whether they have no point in common.
    pub fn disjoint(&self, other: &Self) -> bool {
        !self.intersects(other)
    }

    /// Whether no point of the other one lies outside, and one lies in the interior.
    pub fn contains(&self, other: &Self) -> bool {
        self.surrounds(other) && PreparedGeometry::new(self).contains(&PreparedGeometry::new(other))
    }

    /// Whether the other one contains it.
    pub fn within(&self, other: &Self) -> bool {
        other.contains(self)
    }

    /// Whether no point of the other one lies outside; borders count.
    pub fn covers(&self, other: &Self) -> bool {
        self.surrounds(other) && PreparedGeometry::new(self).covers(&PreparedGeometry::new(other))
    }

    /// Whether the other one covers it.
    pub fn covered_by(&self, other: &Self) -> bool {
        other.covers(self)
    }

    /// Whether they meet, and their interiors do not.
    pub fn touches(&self, other: &Self) -> bool {
        self.is_near(other) && PreparedGeometry::new(self).touches(&PreparedGeometry::new(other))
    }

    /// Whether their interiors meet in less than the greater of their dimensions, and each has points outside of the
    /// other: a line that leads through an area, or lines that cross in points.
    pub fn crosses(&self, other: &Self) -> bool {
        self.is_near(other) && PreparedGeometry::new(self).crosses(&PreparedGeometry::new(other))
    }

    /// Whether they are of one dimension, their interiors meet in it, and each has points outside of the other.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.is_near(other)
            && self.dimension() == other.dimension()
            && PreparedGeometry::new(self).overlaps(&PreparedGeometry::new(other))
    }

    /// Whether they are the same points, in whatever order and however divided.
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

    /// Whether both are sound and the rectangles around them meet.
    fn is_near(&self, other: &Self) -> bool {
        meet(self.bounds(), other.bounds()) && self.is_sound() && other.is_sound()
    }

    /// Whether both are sound and the other one's rectangle lies in its own.
    fn surrounds(&self, other: &Self) -> bool {
        surrounds(self.bounds(), other.bounds()) && self.is_sound() && other.is_sound()
    }
}

/// Whether two rectangles meet.
fn meet(one: Option<[DVec2; 2]>, two: Option<[DVec2; 2]>) -> bool {
    one.zip(two).is_some_and(|([a, b], [c, d])| a.cmple(d).all() && c.cmple(b).all())
}

/// Whether the second rectangle lies in the first.
fn surrounds(one: Option<[DVec2; 2]>, two: Option<[DVec2; 2]>) -> bool {
    one.zip(two).is_some_and(|([a, b], [c, d])| a.cmple(c).all() && d.cmple(b).all())
}

/// The same of geometries that are compared with many.
impl PreparedGeometry {
    /// The dimensions in which interiors, boundaries and exteriors of the two meet.
    pub fn relate(&self, other: &Self) -> Relation {
        Relation { cells: topology::relate(self, other, true) }
    }

    /// The same, but for the dimension in which borders that cross each other meet.
    fn relation(&self, other: &Self) -> Relation {
        Relation { cells: topology::relate(self, other, false) }
    }

    fn is_near(&self, other: &Self) -> bool {
        self.is_sound && other.is_sound && meet(self.bounds, other.bounds)
    }

    fn surrounds(&self, other: &Self) -> bool {
        self.is_sound && other.is_sound && surrounds(self.bounds, other.bounds)
    }

    /// As [`Geometry::contains`].
    pub fn contains(&self, other: &Self) -> bool {
        self.surrounds(other) && self.relation(other).is("T*****FF*")
    }

    /// As [`Geometry::within`].
    pub fn within(&self, other: &Self) -> bool {
        other.contains(self)
    }

    /// As [`Geometry::covers`].
    pub fn covers(&self, other: &Self) -> bool {
        if !self.surrounds(other) {
            return false;
        }
        let relation = self.relation(other);
        ["T*****FF*", "*T****FF*", "***T**FF*", "****T*FF*"].iter().any(|pattern| relation.is(pattern))
    }

    /// As [`Geometry::covered_by`].
    pub fn covered_by(&self, other: &Self) -> bool {
        other.covers(self)
    }

    /// As [`Geometry::touches`].
    pub fn touches(&self, other: &Self) -> bool {
        if !self.is_near(other) {
            return false;
        }
        let relation = self.relation(other);
        ["FT*******", "F**T*****", "F***T****"].iter().any(|pattern| relation.is(pattern))
    }

    /// As [`Geometry::crosses`].
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

    /// As [`Geometry::overlaps`].
    pub fn overlaps(&self, other: &Self) -> bool {
        if !self.is_near(other) || self.dimension != other.dimension {
            return false;
        }
        let pattern = if self.dimension == 1 { "1*T***T**" } else { "T*T***T**" };
        self.relation(other).is(pattern)
    }

    /// As [`Geometry::equals`].
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
