//! GML geometries.

use std::rc::Rc;

use glam::DVec3;

use super::system::NamedSystem;
use crate::formats::xml::{Element, Xml, XmlPiece};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result as Checked};
use burgeon_base::text::shown;
use burgeon_spatial::Geometry;
use burgeon_spatial::wkb::{NEAR, add_arc};

/// Reason why a geometry is not read.
pub(super) enum GeometryProblem {
    /// Error that ends the reading.
    Stop(Error),
    /// Invalid geometry, with the reason.
    Wrong(String),
}

impl From<Error> for GeometryProblem {
    fn from(error: Error) -> Self {
        Self::Stop(error)
    }
}

type GeometryResult<T> = Result<T, GeometryProblem>;

fn wrong<T>(why: impl Into<String>) -> GeometryResult<T> {
    Err(GeometryProblem::Wrong(why.into()))
}

/// Context of coordinates; inner elements may override it.
#[derive(Clone, Default)]
pub(super) struct GmlContext {
    /// Coordinate system, or the reason why it is unknown.
    pub(super) system: Option<Rc<Checked<NamedSystem>>>,
    /// Number of coordinates per position.
    pub(super) dimension: Option<usize>,
}

impl GmlContext {
    /// Returns the context within `element`; `named` returns the coordinate system with a name.
    pub(super) fn within(
        &self,
        element: &Element,
        named: impl FnOnce(&str) -> Rc<Checked<NamedSystem>>,
    ) -> Self {
        let dimension = element.attribute("srsDimension").or_else(|| element.attribute("dimension"));
        let dimension =
            dimension.and_then(|text| text.trim().parse().ok()).filter(|number| (2..=4).contains(number));
        let system = element.attribute("srsName").map(named);
        Self { system: system.or_else(|| self.system.clone()), dimension: dimension.or(self.dimension) }
    }

    fn usable_system(&self) -> Option<&NamedSystem> {
        self.system.as_ref().and_then(|system| system.as_ref().as_ref().ok())
    }
}

/// Returns true if an element called `name` is a geometry.
pub(super) fn is_geometry(name: &str) -> bool {
    const OTHERS: [&str; 12] = [
        "Point",
        "Polygon",
        "PolygonPatch",
        "Triangle",
        "Rectangle",
        "Surface",
        "PolyhedralSurface",
        "TriangulatedSurface",
        "Tin",
        "OrientableSurface",
        "CompositeSurface",
        "GeometryCollection",
    ];
    is_curve(name)
        || OTHERS.contains(&name)
        || name.starts_with("Multi") && MULTI.contains(&name)
        || SOLIDS.contains(&name)
}

const MULTI: [&str; 8] = [
    "MultiPoint",
    "MultiLineString",
    "MultiCurve",
    "MultiPolygon",
    "MultiSurface",
    "MultiGeometry",
    "MultiSolid",
    "MultiGeometryCollection",
];
const SOLIDS: [&str; 3] = ["Solid", "CompositeSolid", "MultiSolid"];

fn is_curve(name: &str) -> bool {
    matches!(name, "LineString" | "LinearRing" | "Ring" | "Curve" | "CompositeCurve" | "OrientableCurve")
}

/// Part of a geometry.
pub(super) enum GmlPiece {
    /// Rings of a polygon, the outer one first.
    Surface(Vec<Vec<DVec3>>),
    Line(Vec<DVec3>),
    Point(DVec3),
}

/// Treatment of solids.
#[derive(Clone, Copy, PartialEq)]
enum Solids {
    /// Their surfaces are read.
    Read,
    /// They are refused, because features lie in the plane.
    Refused,
}

/// Reader of the geometries in a file.
pub(super) struct GeometryReader<'x> {
    pub(super) xml: &'x mut Xml,
    pub(super) named: &'x mut dyn FnMut(&str) -> Rc<Checked<NamedSystem>>,
    /// First coordinate system that was found.
    pub(super) system: Option<Rc<Checked<NamedSystem>>>,
    pub(super) budget: &'x Budget,
}

impl GeometryReader<'_> {
    /// Adds the parts of the geometry that `element` begins.
    pub(super) fn geometry(
        &mut self,
        element: &Element,
        context: &GmlContext,
        parts: &mut Vec<Geometry>,
    ) -> GeometryResult<()> {
        self.pieces(element, context, Solids::Refused, &mut |piece| {
            parts.extend(match piece {
                GmlPiece::Surface(rings) => Geometry::polygon(rings),
                GmlPiece::Line(line) => Geometry::line(line),
                GmlPiece::Point(point) => Some(Geometry::point(point)),
            });
            Ok(())
        })
    }

    /// Calls `each` with the rings of each polygon of the geometry that `element` begins, including nested polygons,
    /// and with its lines and points. Rings do not repeat their first point.
    pub(super) fn surfaces(
        &mut self,
        element: &Element,
        context: &GmlContext,
        each: &mut dyn FnMut(GmlPiece),
    ) -> GeometryResult<()> {
        let budget = self.budget;
        self.pieces(element, context, Solids::Read, &mut |mut piece| {
            if let GmlPiece::Surface(rings) = &mut piece {
                for ring in rings.iter_mut().filter(|ring| ring.len() > 1 && ring.first() == ring.last()) {
                    ring.pop();
                }
                let size: usize = rings.iter().map(Vec::len).sum();
                budget.take(size * 24)?;
            }
            each(piece);
            Ok(())
        })
    }

    /// Calls `each` with the polygons, lines and points of the geometry that `element` begins.
    fn pieces(
        &mut self,
        element: &Element,
        context: &GmlContext,
        solids: Solids,
        each: &mut dyn FnMut(GmlPiece) -> Checked<()>,
    ) -> GeometryResult<()> {
        self.budget.tick()?;
        let context = context.within(element, &mut *self.named);
        if self.system.is_none() {
            self.system.clone_from(&context.system);
        }
        match &*element.name {
            "Point" => {
                if let Some(place) = self.places(&context)?.first() {
                    each(GmlPiece::Point(*place))?;
                }
            }
            name if is_curve(name) => each(GmlPiece::Line(self.curve(element, &context)?))?,
            "Polygon" | "PolygonPatch" | "Triangle" | "Rectangle" => {
                each(GmlPiece::Surface(self.rings(&context)?))?;
            }
            name if solids == Solids::Refused && SOLIDS.contains(&name) => {
                return wrong("is a solid without a footprint");
            }
            _ => {
                let depth = self.xml.depth;
                while let Some(inner) = self.xml.next_child(depth)? {
                    if is_geometry(&inner.name) {
                        self.pieces(&inner, &context, solids, each)?;
                    } else if is_aside(&inner.name) {
                        self.xml.leave(self.xml.depth - 1)?;
                    }
                }
            }
        }
        Ok(())
    }

    /// Returns the rings of a polygon, the outer one first.
    fn rings(&mut self, context: &GmlContext) -> GeometryResult<Vec<Vec<DVec3>>> {
        let depth = self.xml.depth;
        let (mut rings, mut outer) = (Vec::new(), None);
        let mut is_outer = true;
        while let Some(inner) = self.xml.next_child(depth)? {
            match &*inner.name {
                "exterior" | "outerBoundaryIs" => is_outer = true,
                "interior" | "innerBoundaryIs" => is_outer = false,
                name if is_curve(name) => {
                    let context = context.within(&inner, &mut *self.named);
                    let ring = self.curve(&inner, &context)?;
                    if is_outer && outer.replace(rings.len()).is_some() {
                        return wrong("has a polygon with more than one outer ring");
                    }
                    rings.push(ring);
                }
                _ => self.xml.leave(self.xml.depth - 1)?,
            }
        }
        match outer {
            Some(at) => rings.swap(0, at),
            None if rings.is_empty() => {}
            None => return wrong("has a polygon without an outer ring"),
        }
        Ok(rings)
    }

    /// Returns the points along the curve that `element` begins.
    fn curve(&mut self, element: &Element, context: &GmlContext) -> GeometryResult<Vec<DVec3>> {
        let mut places = match &*element.name {
            "LineString" | "LinearRing" | "LineStringSegment" | "GeodesicString" | "Geodesic" => {
                self.places(context)?
            }
            "Arc" | "ArcString" | "Circle" => {
                let given = self.places(context)?;
                self.arcs(element, &given, context)?
            }
            "Ring" | "Curve" | "CompositeCurve" | "OrientableCurve" => self.chain(context)?,
            name => return wrong(format!("has a curve of unsupported type {}", shown(name))),
        };
        if element.attribute("orientation") == Some("-") {
            places.reverse();
        }
        Ok(places)
    }

    /// Returns the points along consecutive curves and segments within an element.
    fn chain(&mut self, context: &GmlContext) -> GeometryResult<Vec<DVec3>> {
        let depth = self.xml.depth;
        let mut places: Vec<DVec3> = Vec::new();
        while let Some(inner) = self.xml.next_child(depth)? {
            // An element with a lower-case first letter is a property of its parent.
            if !inner.name.starts_with(|letter: char| letter.is_ascii_uppercase()) {
                if is_aside(&inner.name) {
                    self.xml.leave(self.xml.depth - 1)?;
                }
                continue;
            }
            let context = context.within(&inner, &mut *self.named);
            let part = self.curve(&inner, &context)?;
            let same = places.last().is_some_and(|last| part.first() == Some(last));
            places.extend(part.into_iter().skip(usize::from(same)));
        }
        Ok(places)
    }

    fn arcs(&self, element: &Element, given: &[DVec3], context: &GmlContext) -> GeometryResult<Vec<DVec3>> {
        if given.len() < 3 || given.len().is_multiple_of(2) {
            return wrong(format!("has a curve that is an {} of {} positions", element.name, given.len()));
        }
        let near = NEAR / context.usable_system().map_or(1.0, |system| system.crs.metres());
        let room = |count: usize| self.budget.take(count * 24);
        let mut places = vec![given[0]];
        for from in (0..given.len() - 2).step_by(2) {
            add_arc(&mut places, [given[from], given[from + 1], given[from + 2]], near, room)?;
            self.budget.tick()?;
        }
        if element.name == "Circle" {
            // A circle has three points; the second arc leads from the third back to the first.
            let opposite = around(given);
            add_arc(&mut places, [given[2], opposite, given[0]], near, room)?;
        }
        Ok(places)
    }

    /// Returns the positions within an element.
    fn places(&mut self, context: &GmlContext) -> GeometryResult<Vec<DVec3>> {
        let depth = self.xml.depth;
        let mut places = Vec::new();
        while let Some(inner) = self.xml.next_child(depth)? {
            let inside = context.within(&inner, &mut *self.named);
            let own = self.xml.depth;
            match &*inner.name {
                "pos" | "posList" => {
                    let many = inner.name == "posList";
                    self.end(own)?;
                    let numbers = numbers(self.xml.text())?;
                    self.budget.take(numbers.len() * 16)?;
                    let dimension = match many {
                        true => dimension(&numbers, &inner, &inside)?,
                        false => numbers.len().min(3),
                    };
                    if dimension < 2 {
                        return wrong("has a position of fewer than two numbers");
                    }
                    if many && !numbers.len().is_multiple_of(dimension) {
                        let count = numbers.len();
                        return wrong(format!(
                            "has a list of {count} numbers, which is not a multiple of the dimension {dimension}"
                        ));
                    }
                    let chunks = numbers.chunks_exact(if many { dimension } else { numbers.len() });
                    places.extend(chunks.map(|place| east_first(place, &inside)));
                }
                "coordinates" => {
                    self.end(own)?;
                    let old = tuples(self.xml.text(), &inner)?;
                    self.budget.take(old.len() * 32)?;
                    places.extend(old.iter().map(|place| east_first(&place[..], &inside)));
                }
                "coord" => {
                    let mut place = Vec::new();
                    while let Some(axis) = self.xml.next_child(own)? {
                        let at = self.xml.depth;
                        self.end(at)?;
                        let number = self.xml.text().parse::<f64>();
                        place.push(number.or_else(|_| {
                            wrong(format!("has a coordinate {} that is not a number", shown(&axis.name)))
                        })?);
                    }
                    if place.len() < 2 {
                        return wrong("has a position of fewer than two numbers");
                    }
                    places.push(east_first(&place, &inside));
                }
                name if is_aside(name) => self.xml.leave(own - 1)?,
                // A property that contains positions.
                _ => {}
            }
        }
        Ok(places)
    }

    /// Reads to the end of the element that began at `depth`, which must contain only text.
    fn end(&mut self, depth: usize) -> GeometryResult<()> {
        match self.xml.next()? {
            XmlPiece::End if self.xml.depth < depth => Ok(()),
            _ => wrong("has an element instead of numbers"),
        }
    }
}

/// Returns true if an element contains no geometry.
fn is_aside(name: &str) -> bool {
    matches!(
        name,
        "boundedBy" | "description" | "metaDataProperty" | "name" | "identifier" | "descriptionReference"
    )
}

/// Returns the point opposite the second of three points on their circle.
fn around(given: &[DVec3]) -> DVec3 {
    let [a, b, c] = [given[0], given[1], given[2]].map(|place| place.truncate());
    let (u, v) = (b - a, c - a);
    let twice = 2.0 * u.perp_dot(v);
    let centre = a + (u * v.length_squared() - v * u.length_squared()).perp() / twice;
    (centre + centre - b).extend(given[1].z)
}

/// Returns the number of coordinates per position in a list.
fn dimension(numbers: &[f64], element: &Element, context: &GmlContext) -> GeometryResult<usize> {
    if let Some(told) = context.dimension {
        return Ok(told);
    }
    if let Some(count) = element.attribute("count").and_then(|count| count.trim().parse::<usize>().ok())
        && count > 0
        && numbers.len().is_multiple_of(count)
    {
        return Ok(numbers.len() / count);
    }
    let closes = |dimension: usize| {
        let count = numbers.len();
        count.is_multiple_of(dimension)
            && count > dimension
            && numbers[..dimension] == numbers[count - dimension..]
    };
    Ok(match (closes(2), closes(3)) {
        (false, true) => 3,
        (true, false) => 2,
        _ if context.usable_system().is_some_and(|system| system.has_heights) => 3,
        _ if numbers.len().is_multiple_of(2) => 2,
        _ => 3,
    })
}

/// Returns a position in the order east, north.
fn east_first(place: &[f64], context: &GmlContext) -> DVec3 {
    let z = place.get(2).copied().unwrap_or_default();
    match context.usable_system() {
        Some(system) if system.north_first => DVec3::new(place[1], place[0], z),
        _ => DVec3::new(place[0], place[1], z),
    }
}

fn number(text: &str) -> GeometryResult<f64> {
    text.parse().or_else(|_| wrong(format!("has \"{}\" instead of a number", shown(text))))
}

/// Parses numbers separated by white space.
fn numbers(text: &str) -> GeometryResult<Vec<f64>> {
    text.split_ascii_whitespace().map(number).collect()
}

/// Parses the positions in a version 2 text, whose separators may be customised.
fn tuples(text: &str, element: &Element) -> GeometryResult<Vec<Vec<f64>>> {
    let mark = |name: &str, usual: char| {
        let told = element.attribute(name).and_then(|text| text.chars().next());
        told.unwrap_or(usual)
    };
    let (decimal, comma, blank) = (mark("decimal", '.'), mark("cs", ','), mark("ts", ' '));
    let places = text.split(|letter: char| letter == blank || (blank == ' ' && letter.is_whitespace()));
    let places = places.map(str::trim).filter(|place| !place.is_empty()).map(|place| {
        let numbers = place.split(comma).map(|text| match decimal {
            '.' => number(text.trim()),
            mark => number(&text.trim().replace(mark, ".")),
        });
        let numbers: Vec<f64> = numbers.collect::<GeometryResult<_>>()?;
        if numbers.len() < 2 { wrong("has a position of fewer than two numbers") } else { Ok(numbers) }
    });
    places.collect()
}
