//! What scripts ask of a geometry.

use burgeon_base::error::{Error, Result};
use burgeon_base::text::listed;
use burgeon_kit::{ObjectContent as _, TableOf, Value, fields, methods};
use glam::DVec3;

use super::object::GeometryObject;
use super::shape::Shape;
use crate::{BufferCap, BufferJoin, BufferOptions, Geometry};

/// How the border of what lies within a distance runs.
#[fields("geometry:buffer")]
pub struct BufferSettings {
    /// What it does at corners: "round", "mitre" or "bevel".
    #[default("round".into())]
    pub join: String,
    /// What it does at the ends of lines: "round", "flat" or "square".
    #[default("round".into())]
    pub cap: String,
    /// How many edges stand for a quarter of a circle.
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

/// The one of `known` that is called `name`.
fn choose<T: Copy>(method: &str, field: &str, name: &str, known: &[(&'static str, T)]) -> Result<T> {
    let found = known.iter().find(|(known, _)| *known == name);
    found.map(|(_, value)| *value).ok_or_else(|| {
        let names = || known.iter().map(|(name, _)| *name);
        let message = format!("geometry:{method}: there is no {field} called {name:?}");
        Error::not_found("option", name, names(), message).help(format!("it is one of {}", listed(names())))
    })
}

#[methods("geometry")]
impl GeometryObject {
    /// The outer ring of a polygon as a line that ends where it begins; nil of other kinds.
    pub fn exterior_ring(&self) -> Option<Geometry> {
        self.geometry().exterior_ring()
    }

    /// The holes of a polygon as lines that end where they begin; an empty list of other kinds.
    pub fn interior_rings(&self) -> Vec<Geometry> {
        self.geometry().interior_rings().unwrap_or_default()
    }

    /// How many points it has; the first point of a ring counts again at its end.
    pub fn num_points(&self) -> f64 {
        self.geometry().num_points() as f64
    }

    /// The point of a line with a number from 1, or from its end if that is negative; nil if there is none.
    pub fn point_n(&self, number: f64) -> Option<Geometry> {
        let points = self.geometry().line_points()?;
        item(points.len(), number).map(|index| Geometry::Point(Some(points[index])))
    }

    /// The first point of a line; nil of other kinds, and of an empty one.
    pub fn start_point(&self) -> Option<Geometry> {
        Some(Geometry::Point(Some(*self.geometry().line_points()?.first()?)))
    }

    /// The last point of a line; nil of other kinds, and of an empty one.
    pub fn end_point(&self) -> Option<Geometry> {
        Some(Geometry::Point(Some(*self.geometry().line_points()?.last()?)))
    }

    /// Where a point is to the east (m); nil of other kinds.
    pub fn x(&self) -> Option<f64> {
        self.position().map(|it| it.x)
    }

    /// Where a point is to the north (m); nil of other kinds.
    pub fn y(&self) -> Option<f64> {
        self.position().map(|it| it.y)
    }

    /// The height of a point (m); nil of other kinds.
    pub fn z(&self) -> Option<f64> {
        self.position().map(|it| it.z)
    }

    /// The place of a point as a vector (m); nil of other kinds.
    pub fn place(&self) -> Option<DVec3> {
        self.position()
    }

    /// The centre of mass: of its areas, else of its lines, else of its points. Empty of an empty one.
    pub fn centroid(&self) -> Geometry {
        self.geometry().centroid()
    }

    /// A point that is well inside of its areas, or on its lines if it has none. Empty of an empty one.
    pub fn point_on_surface(&self) -> Geometry {
        self.geometry().point_on_surface()
    }

    /// The point inside that two numbers from 0 to 1 choose: geometry:random_point(random(), random()) draws one of which
    /// no place is likelier than another.
    pub fn random_point(&self, u: f64, v: f64) -> Result<Geometry> {
        self.prepared().random_point(u, v)
    }

    /// Its area as seen from above, without holes (m²); 0 of lines and points.
    pub fn area(&self) -> f64 {
        self.geometry().area()
    }

    /// The length of its lines as seen from above (m); 0 of areas, which have a perimeter.
    pub fn length(&self) -> f64 {
        self.geometry().length()
    }

    /// The length of the rings of its areas as seen from above (m).
    pub fn perimeter(&self) -> f64 {
        self.geometry().perimeter()
    }

    /// The rectangle along the axes around it; a line or a point where it has no width or no height.
    pub fn envelope(&self) -> Geometry {
        self.geometry().envelope()
    }

    /// How far it reaches from west to east (m).
    pub fn envelope_width(&self) -> f64 {
        self.geometry().envelope_width()
    }

    /// How far it reaches from south to north (m).
    pub fn envelope_height(&self) -> f64 {
        self.geometry().envelope_height()
    }

    /// The smallest convex geometry around it.
    pub fn convex_hull(&self) -> Geometry {
        self.geometry().convex_hull()
    }

    /// The smallest rectangle around it, whichever way that is turned.
    pub fn oriented_envelope(&self) -> Geometry {
        self.geometry().oriented_envelope()
    }

    /// The area of all that lies within `distance` (m); a negative one takes as much off an area.
    pub fn buffer(&self, distance: f64, options: Option<TableOf<BufferSettings>>) -> Result<Geometry> {
        self.geometry().buffer(distance, &BufferSettings::options(options, "buffer")?)
    }

    /// The line beside it at `distance` (m), to its left, or to its right if that is negative. Of areas, the border as far
    /// outside, or inside.
    pub fn offset(&self, distance: f64, options: Option<TableOf<BufferSettings>>) -> Result<Geometry> {
        self.geometry().offset(distance, &BufferSettings::options(options, "offset")?)
    }

    /// What either of the two has.
    pub fn union(&self, other: Shape) -> Geometry {
        self.geometry().union(other.geometry())
    }

    /// What both have: areas, lines along which they touch, points in which they meet. Empty if they have nothing in common.
    pub fn intersection(&self, other: Shape) -> Geometry {
        self.geometry().intersection(other.geometry())
    }

    /// What it has and the other one has not.
    pub fn difference(&self, other: Shape) -> Geometry {
        self.geometry().difference(other.geometry())
    }

    /// What one of the two has and the other one has not.
    pub fn sym_difference(&self, other: Shape) -> Geometry {
        self.geometry().sym_difference(other.geometry())
    }

    /// The same without points that are within `tolerance` (m) of the line between others.
    pub fn simplify(&self, tolerance: f64) -> Geometry {
        self.geometry().simplify(tolerance)
    }

    /// The way from the first point of a line to its last (degrees): 0 is east, 90 is north. Nil of other kinds.
    pub fn direction(&self) -> Option<f64> {
        self.geometry().direction()
    }

    /// How far the two are apart as seen from above (m); 0 where they meet, nil if one is empty.
    pub fn distance(&self, other: Shape) -> Option<f64> {
        self.geometry().distance(other.geometry())
    }

    /// The point of it that is nearest to the other one; empty if one is empty.
    pub fn nearest_point(&self, other: Shape) -> Geometry {
        self.geometry().nearest_point(other.geometry())
    }

    /// Whether they are the same points, in whatever order.
    pub fn equals(&self, other: Shape) -> bool {
        self.prepared().equals(other.prepared())
    }

    /// Whether they have no point in common.
    pub fn disjoint(&self, other: Shape) -> bool {
        self.geometry().disjoint(other.geometry())
    }

    /// Whether they have a point in common.
    pub fn intersects(&self, other: Shape) -> bool {
        self.geometry().intersects(other.geometry())
    }

    /// Whether they meet, and only with their borders or ends.
    pub fn touches(&self, other: Shape) -> bool {
        self.prepared().touches(other.prepared())
    }

    /// Whether a line leads through an area, or lines cross in points.
    pub fn crosses(&self, other: Shape) -> bool {
        self.prepared().crosses(other.prepared())
    }

    /// Whether it lies in the other one; what lies on its border alone does not.
    pub fn within(&self, other: Shape) -> bool {
        self.prepared().within(other.prepared())
    }

    /// Whether the other one lies in it; what lies on its border alone does not.
    pub fn contains(&self, other: Shape) -> bool {
        self.prepared().contains(other.prepared())
    }

    /// Whether no point of the other one lies outside; borders count.
    pub fn covers(&self, other: Shape) -> bool {
        self.prepared().covers(other.prepared())
    }

    /// Whether both are areas, or both lines, that share a part and have one of their own each.
    pub fn overlaps(&self, other: Shape) -> bool {
        self.prepared().overlaps(other.prepared())
    }

    /// How the two lie to each other, as nine letters; with a pattern, such as "F***1****", whether they lie so.
    pub fn relate(&self, other: Shape, pattern: Option<String>) -> Result<Value> {
        let relation = self.prepared().relate(other.prepared());
        Ok(match pattern {
            None => Value::Text(relation.text().into()),
            Some(pattern) => {
                Value::Boolean(relation.matches(&pattern).map_err(|error| error.about("geometry:relate"))?)
            }
        })
    }

    /// The point of a line at a `part` of its length: 0 is its first point, 1 its last.
    pub fn line_interpolate(&self, part: f64) -> Result<Geometry> {
        self.geometry().line_interpolate(part)
    }

    /// The piece of a line between two parts of its length, from 0 to 1.
    pub fn line_substring(&self, from: f64, to: f64) -> Result<Geometry> {
        self.geometry().line_substring(from, to)
    }

    /// At which part of the length of a line the point is that is nearest to the other one, from 0 to 1.
    pub fn line_locate(&self, other: Shape) -> Result<Option<f64>> {
        self.geometry().line_locate(other.geometry())
    }

    /// The straight pieces of its lines and rings, each a line of two points.
    pub fn segments(&self) -> Vec<Geometry> {
        self.geometry().segments()
    }

    /// Its border: the rings of areas as lines, the ends of lines as points. Empty of points.
    pub fn boundary(&self) -> Geometry {
        self.geometry().boundary()
    }

    /// Its geometries: those of a multi form or a collection, else itself alone.
    pub fn geometries(&self) -> Vec<Geometry> {
        self.geometry().geometries()
    }

    /// How many geometries it has.
    pub fn num_geometries(&self) -> f64 {
        self.geometry().num_geometries() as f64
    }

    /// The geometry of it with a number from 1, or from its end if that is negative; nil if there is none.
    pub fn geometry_n(&self, number: f64) -> Option<Geometry> {
        let mut all = self.geometry().geometries();
        item(all.len(), number).map(|index| all.swap_remove(index))
    }

    /// Whether it has no points.
    pub fn is_empty(&self) -> bool {
        self.geometry().is_empty()
    }

    /// Whether its rings neither cross nor overlap, holes lie inside, and lines have a length.
    pub fn is_valid(&self) -> bool {
        self.geometry().is_valid()
    }

    /// Why it is not valid; nil if it is.
    pub fn validity(&self) -> Option<String> {
        self.geometry().validity_reason()
    }

    /// The valid geometry that is most like it; itself if it is valid.
    pub fn make_valid(&self) -> Geometry {
        self.geometry().make_valid()
    }

    /// The lines inside of its areas on which their borders meet as they move inwards alike: ridges and hips.
    pub fn straight_skeleton(&self) -> Result<Geometry> {
        self.geometry().straight_skeleton()
    }

    /// The faces of its straight skeleton, one for each edge of its areas, whose heights are how far (m) inwards from it
    /// they reach: a hip roof with a slope of 1.
    pub fn skeleton_faces(&self) -> Result<Vec<Geometry>> {
        self.geometry().skeleton_faces()
    }

    /// What is left of its areas when their borders move inwards by `distance` (m), or outwards if that is negative.
    pub fn inset(&self, distance: f64) -> Result<Geometry> {
        self.geometry().inset(distance)
    }

    /// Its well-known text, which geometry(text) reads.
    pub fn wkt(&self) -> String {
        self.geometry().to_wkt()
    }
}

/// The place of the item with a number from 1, or from the end if it is negative.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
fn item(count: usize, number: f64) -> Option<usize> {
    let number = if number < 0.0 { number + count as f64 + 1.0 } else { number };
    let there = number.fract() == 0.0 && number >= 1.0 && number <= count as f64;
    there.then(|| number as usize - 1)
}
