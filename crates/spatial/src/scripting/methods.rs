//! Methods of geometries for scripts.

use burgeon_base::error::{Error, Result};
use burgeon_base::text::listed;
use burgeon_kit::{ObjectContent as _, TableOf, Value, fields, methods};
use glam::DVec3;

use super::geometry_input::GeometryInput;
use super::object::GeometryObject;
use crate::{BufferCap, BufferJoin, BufferOptions, Geometry};

/// Shape of a buffer's boundary.
#[fields("geometry:buffer")]
pub struct BufferSettings {
    /// Shape at corners: "round", "mitre" or "bevel".
    #[default("round".into())]
    pub join: String,
    /// Shape at the ends of lines: "round", "flat" or "square".
    #[default("round".into())]
    pub cap: String,
    /// Number of edges that approximate a quarter of a circle.
    #[default(8)]
    pub quadrant_segments: u32,
}

impl BufferSettings {
    fn options(given: Option<TableOf<Self>>, method: &str) -> Result<BufferOptions> {
        let settings = given.unwrap_or_default().read()?;
        let joins =
            [("round", BufferJoin::Round), ("mitre", BufferJoin::Mitre), ("bevel", BufferJoin::Bevel)];
        let caps = [("round", BufferCap::Round), ("flat", BufferCap::Flat), ("square", BufferCap::Square)];
        Ok(BufferOptions {
            join: choose(method, "join", &settings.join, &joins)?,
            cap: choose(method, "cap", &settings.cap, &caps)?,
            quadrant_segments: settings.quadrant_segments,
        })
    }
}

/// Returns the entry of `known` called `name`.
fn choose<T: Copy>(method: &str, field: &str, name: &str, known: &[(&'static str, T)]) -> Result<T> {
    let found = known.iter().find(|(known, _)| *known == name);
    found.map(|(_, value)| *value).ok_or_else(|| {
        let names = || known.iter().map(|(name, _)| *name);
        let message = format!("geometry:{method}: unknown {field} {name:?}");
        Error::not_found("option", name, names(), message).help(format!("use one of {}", listed(names())))
    })
}

#[methods("geometry")]
impl GeometryObject {
    /// Returns the outer ring of a polygon as a closed line; nil for other types.
    pub fn exterior_ring(&self) -> Option<Geometry> {
        self.geometry().exterior_ring()
    }

    /// Returns the holes of a polygon as closed lines; an empty list for other types.
    pub fn interior_rings(&self) -> Vec<Geometry> {
        self.geometry().interior_rings().unwrap_or_default()
    }

    /// Returns the number of points; the first point of a ring counts again at its end.
    pub fn num_points(&self) -> f64 {
        self.geometry().num_points() as f64
    }

    /// Returns the point of a line at a number from 1, or from the end if the number is negative; nil if there is none.
    pub fn point_n(&self, number: f64) -> Option<Geometry> {
        let points = self.geometry().line_points()?;
        item(points.len(), number).map(|index| Geometry::Point(Some(points[index])))
    }

    /// Returns the first point of a line; nil for an empty line and for other types.
    pub fn start_point(&self) -> Option<Geometry> {
        Some(Geometry::Point(Some(*self.geometry().line_points()?.first()?)))
    }

    /// Returns the last point of a line; nil for an empty line and for other types.
    pub fn end_point(&self) -> Option<Geometry> {
        Some(Geometry::Point(Some(*self.geometry().line_points()?.last()?)))
    }

    /// Returns the x coordinate of a point, to the east (m); nil for other types.
    pub fn x(&self) -> Option<f64> {
        self.position().map(|it| it.x)
    }

    /// Returns the y coordinate of a point, to the north (m); nil for other types.
    pub fn y(&self) -> Option<f64> {
        self.position().map(|it| it.y)
    }

    /// Returns the height of a point (m); nil for other types.
    pub fn z(&self) -> Option<f64> {
        self.position().map(|it| it.z)
    }

    /// Returns the position of a point as a vector (m); nil for other types.
    pub fn place(&self) -> Option<DVec3> {
        self.position()
    }

    /// Returns the centroid of the areas, of the lines if there are no areas, or otherwise of the points. Empty for an
    /// empty geometry.
    pub fn centroid(&self) -> Geometry {
        self.geometry().centroid()
    }

    /// Returns a point well inside the areas, or on the lines if there are no areas. Empty for an empty geometry.
    pub fn point_on_surface(&self) -> Geometry {
        self.geometry().point_on_surface()
    }

    /// Returns the point inside that two numbers from 0 to 1 select: geometry:random_point(random(), random()) samples
    /// the geometry uniformly.
    pub fn random_point(&self, u: f64, v: f64) -> Result<Geometry> {
        self.prepared().random_point(u, v)
    }

    /// Returns the horizontal area without holes (m²); 0 for lines and points.
    pub fn area(&self) -> f64 {
        self.geometry().area()
    }

    /// Returns the horizontal length of the lines (m); 0 for areas, which have a perimeter.
    pub fn length(&self) -> f64 {
        self.geometry().length()
    }

    /// Returns the horizontal length of the rings of the areas (m).
    pub fn perimeter(&self) -> f64 {
        self.geometry().perimeter()
    }

    /// Returns the axis-aligned bounding rectangle; a line or a point if the width or the height is 0.
    pub fn envelope(&self) -> Geometry {
        self.geometry().envelope()
    }

    /// Returns the extent from west to east (m).
    pub fn envelope_width(&self) -> f64 {
        self.geometry().envelope_width()
    }

    /// Returns the extent from south to north (m).
    pub fn envelope_height(&self) -> f64 {
        self.geometry().envelope_height()
    }

    /// Returns the convex hull.
    pub fn convex_hull(&self) -> Geometry {
        self.geometry().convex_hull()
    }

    /// Returns the smallest enclosing rectangle of any orientation.
    pub fn oriented_envelope(&self) -> Geometry {
        self.geometry().oriented_envelope()
    }

    /// Returns the area of all points within `distance` (m); a negative distance shrinks areas.
    pub fn buffer(&self, distance: f64, options: Option<TableOf<BufferSettings>>) -> Result<Geometry> {
        self.geometry().buffer(distance, &BufferSettings::options(options, "buffer")?)
    }

    /// Returns the parallel line at `distance` (m), to the left, or to the right if the distance is negative. For
    /// areas, returns the boundary moved outwards, or inwards.
    pub fn offset(&self, distance: f64, options: Option<TableOf<BufferSettings>>) -> Result<Geometry> {
        self.geometry().offset(distance, &BufferSettings::options(options, "offset")?)
    }

    /// Returns the union with another geometry.
    pub fn union(&self, other: GeometryInput) -> Geometry {
        self.geometry().union(other.geometry())
    }

    /// Returns the intersection with another geometry: common areas, lines and points. Empty if they have nothing in
    /// common.
    pub fn intersection(&self, other: GeometryInput) -> Geometry {
        self.geometry().intersection(other.geometry())
    }

    /// Returns the set difference: this geometry without the other.
    pub fn difference(&self, other: GeometryInput) -> Geometry {
        self.geometry().difference(other.geometry())
    }

    /// Returns the symmetric difference: the parts that belong to only one of the two geometries.
    pub fn sym_difference(&self, other: GeometryInput) -> Geometry {
        self.geometry().sym_difference(other.geometry())
    }

    /// Returns the geometry without points that are within `tolerance` (m) of the line between other points.
    pub fn simplify(&self, tolerance: f64) -> Geometry {
        self.geometry().simplify(tolerance)
    }

    /// Returns the direction from the first point of a line to its last (degrees): 0 is east, 90 is north. Nil for
    /// other types.
    pub fn direction(&self) -> Option<f64> {
        self.geometry().direction()
    }

    /// Returns the horizontal distance (m); 0 if the geometries intersect, nil if either is empty.
    pub fn distance(&self, other: GeometryInput) -> Option<f64> {
        self.geometry().distance(other.geometry())
    }

    /// Returns the point of this geometry that is nearest to the other; empty if either is empty.
    pub fn nearest_point(&self, other: GeometryInput) -> Geometry {
        self.geometry().nearest_point(other.geometry())
    }

    /// Returns true if both geometries consist of the same points, in any order.
    pub fn equals(&self, other: GeometryInput) -> bool {
        self.prepared().equals(other.prepared())
    }

    /// Returns true if the geometries have no point in common.
    pub fn disjoint(&self, other: GeometryInput) -> bool {
        self.geometry().disjoint(other.geometry())
    }

    /// Returns true if the geometries have a point in common.
    pub fn intersects(&self, other: GeometryInput) -> bool {
        self.geometry().intersects(other.geometry())
    }

    /// Returns true if the geometries intersect only at their boundaries or line ends.
    pub fn touches(&self, other: GeometryInput) -> bool {
        self.prepared().touches(other.prepared())
    }

    /// Returns true if a line passes through an area, or if lines cross in points.
    pub fn crosses(&self, other: GeometryInput) -> bool {
        self.prepared().crosses(other.prepared())
    }

    /// Returns true if this geometry is inside the other; a geometry that is only on the other's boundary is not.
    pub fn within(&self, other: GeometryInput) -> bool {
        self.prepared().within(other.prepared())
    }

    /// Returns true if the other geometry is inside this one; a geometry that is only on this one's boundary is not.
    pub fn contains(&self, other: GeometryInput) -> bool {
        self.prepared().contains(other.prepared())
    }

    /// Returns true if no point of the other geometry is outside this one; the boundary belongs to the geometry.
    pub fn covers(&self, other: GeometryInput) -> bool {
        self.prepared().covers(other.prepared())
    }

    /// Returns true if both geometries are areas, or both lines, that share a part and each have a part of their own.
    pub fn overlaps(&self, other: GeometryInput) -> bool {
        self.prepared().overlaps(other.prepared())
    }

    /// Returns the DE-9IM relation of the two geometries as nine characters. With a pattern, such as "F***1****",
    /// returns true if the relation matches it.
    pub fn relate(&self, other: GeometryInput, pattern: Option<String>) -> Result<Value> {
        let relation = self.prepared().relate(other.prepared());
        Ok(match pattern {
            None => Value::Text(relation.text().into()),
            Some(pattern) => {
                Value::Boolean(relation.matches(&pattern).map_err(|error| error.about("geometry:relate"))?)
            }
        })
    }

    /// Returns the point of a line at a fraction `part` of its length: 0 is the first point, 1 the last.
    pub fn line_interpolate(&self, part: f64) -> Result<Geometry> {
        self.geometry().line_interpolate(part)
    }

    /// Returns the part of a line between two fractions of its length, from 0 to 1.
    pub fn line_substring(&self, from: f64, to: f64) -> Result<Geometry> {
        self.geometry().line_substring(from, to)
    }

    /// Returns the fraction of a line's length, from 0 to 1, at its point nearest to the other geometry.
    pub fn line_locate(&self, other: GeometryInput) -> Result<Option<f64>> {
        self.geometry().line_locate(other.geometry())
    }

    /// Returns the straight segments of the lines and rings, each as a line of two points.
    pub fn segments(&self) -> Vec<Geometry> {
        self.geometry().segments()
    }

    /// Returns the boundary: the rings of areas as lines, the ends of lines as points. Empty for points.
    pub fn boundary(&self) -> Geometry {
        self.geometry().boundary()
    }

    /// Returns the members of a multi-part geometry or a collection; for other types, a list of the geometry itself.
    pub fn geometries(&self) -> Vec<Geometry> {
        self.geometry().geometries()
    }

    /// Returns the number of member geometries.
    pub fn num_geometries(&self) -> f64 {
        self.geometry().num_geometries() as f64
    }

    /// Returns the member geometry at a number from 1, or from the end if the number is negative; nil if there is none.
    pub fn geometry_n(&self, number: f64) -> Option<Geometry> {
        let mut all = self.geometry().geometries();
        item(all.len(), number).map(|index| all.swap_remove(index))
    }

    /// Returns true if the geometry has no points.
    pub fn is_empty(&self) -> bool {
        self.geometry().is_empty()
    }

    /// Returns true if rings neither cross nor overlap, holes are inside, and lines have a length.
    pub fn is_valid(&self) -> bool {
        self.geometry().is_valid()
    }

    /// Returns the reason why the geometry is invalid; nil if it is valid.
    pub fn validity(&self) -> Option<String> {
        self.geometry().validity_reason()
    }

    /// Returns the most similar valid geometry; the geometry itself if it is valid.
    pub fn make_valid(&self) -> Geometry {
        self.geometry().make_valid()
    }

    /// Returns the straight skeleton of the areas: the lines on which the edges meet as all move inwards at the same
    /// speed, such as ridges and hips.
    pub fn straight_skeleton(&self) -> Result<Geometry> {
        self.geometry().straight_skeleton()
    }

    /// Returns the faces of the straight skeleton, one for each edge of the areas. The height of a point is its
    /// distance (m) inwards from the edge, as on a hip roof with a slope of 1.
    pub fn skeleton_faces(&self) -> Result<Vec<Geometry>> {
        self.geometry().skeleton_faces()
    }

    /// Returns the areas after their boundaries have moved inwards by `distance` (m), or outwards if it is negative.
    pub fn inset(&self, distance: f64) -> Result<Geometry> {
        self.geometry().inset(distance)
    }

    /// Returns the well-known text, which geometry(text) reads.
    pub fn wkt(&self) -> String {
        self.geometry().to_wkt()
    }
}

/// Returns the index of the item at a number from 1, or from the end if the number is negative.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
fn item(count: usize, number: f64) -> Option<usize> {
    let number = if number < 0.0 { number + count as f64 + 1.0 } else { number };
    let there = number.fract() == 0.0 && number >= 1.0 && number <= count as f64;
    there.then(|| number as usize - 1)
}
