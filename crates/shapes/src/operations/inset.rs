//! Faces after their edges move inwards or outwards.

use burgeon_base::error::{Error, ErrorKind, Result};
use burgeon_geometry::overlay::{BufferSource, BufferStyle, Cap, Join, buffer};
use burgeon_geometry::skeleton::{Pace, Skeleton};
use burgeon_geometry::{Polygon, Rings};
use glam::DVec2;
use rustc_hash::FxHashSet;

use super::strips::{Strips, divide};
use crate::{Scope, Selector, Shape};

/// Mitre limit of outward offsets, as a multiple of the distance.
const MITRE: f64 = 4.0;

/// Strips along the edges of a face, and the rest of the face.
#[derive(Debug, Clone, Default)]
pub struct Setback {
    /// Strips, in the order of the edges; tagged "setback.border".
    pub border: Vec<Shape>,
    /// Rest, tagged "setback.inner".
    pub inner: Vec<Shape>,
}

impl Shape {
    /// Divides a face into strips along its edges and the rest: every edge moves inwards by its distance (m).
    ///
    /// `distances` has one number per edge, in the order of the rings; an edge with 0 does not move. Neighbouring strips
    /// meet on the line that their edges sweep. Fails unless the shape is one face.
    ///
    /// Method: the straight skeleton with a speed for each edge.
    pub fn setback(&self, distances: impl Fn(usize, &Shape) -> f64) -> Result<Setback> {
        let (polygon, frame) = self.single_face("setback")?;
        let edges = self.border_edges(&polygon, &frame);
        let mut paces = Vec::with_capacity(edges.len());
        for (number, edge) in edges.iter().enumerate() {
            let distance = distances(number, edge);
            if distance < 0.0 || !distance.is_finite() {
                return Err(Error::argument(format!("the setback of edge {} is {distance} m", number + 1))
                    .help("use 0 or more; offset moves edges outwards"));
            }
            paces.push(if distance > 0.0 { Pace { speed: distance, rest: 0.0 } } else { Pace::STILL });
        }
        if paces.iter().all(|pace| !pace.moves()) {
            return Ok(Setback { inner: vec![self.clone()], border: Vec::new() });
        }
        let skeleton = Skeleton::new(&polygon, &paces);
        let skeleton = skeleton.map_err(|error| explain_touching(error, &polygon, &frame))?;
        let strips = divide(&polygon, &skeleton, 1.0)?;
        Ok(self.setback_parts(&strips, &frame))
    }

    /// Returns the rest of a face after all edges moved inwards by the same distance (m), found so that its area is
    /// `area` (m²); with that distance.
    ///
    /// Method: bisection over the straight skeleton. Fails if the area is not between 0 and that of the face.
    pub fn setback_to_area(&self, area: f64) -> Result<(Setback, f64)> {
        let (polygon, frame) = self.single_face("setback")?;
        let whole = polygon.area();
        if !(area > 0.0 && area < whole) {
            return Err(Error::argument(format!("a face of {whole:.3} m² has no rest of {area} m²"))
                .help("use an area above 0 and below that of the face"));
        }
        let skeleton = Skeleton::new(&polygon, &vec![Pace::default(); polygon.size()]);
        let skeleton = skeleton.map_err(|error| explain_touching(error, &polygon, &frame))?;
        let (mut low, mut high) = (0.0, skeleton.duration());
        for _ in 0..60 {
            let middle = f64::midpoint(low, high);
            let rest = divide(&polygon, &skeleton, middle)?.inner.iter().map(Polygon::area).sum::<f64>();
            *if rest > area { &mut low } else { &mut high } = middle;
        }
        Ok((self.setback_parts(&divide(&polygon, &skeleton, low)?, &frame), low))
    }

    /// Returns the faces after moving every edge inwards by `distance` (m), or outwards if it is negative; empty if
    /// nothing remains. Corners are mitred.
    ///
    /// Fails unless the shape is one face.
    pub fn offset(&self, distance: f64) -> Result<Vec<Self>> {
        let (polygon, frame) = self.single_face("offset")?;
        if !distance.is_finite() {
            return Err(Error::argument(format!("the distance of an offset is {distance}")));
        }
        let style = BufferStyle { join: Join::Mitre(MITRE), cap: Cap::Flat, quadrant_segments: 1 };
        let own = [Rings::from(&polygon)];
        let source = BufferSource { areas: &own, ..BufferSource::default() };
        let areas = buffer(source, -distance, style)?;
        let own_style = self.styles().into_iter().next().flatten();
        let polygons = areas.into_iter().filter_map(|rings| {
            let corners = rings.iter().map(|ring| without_straight_points(ring)).collect();
            Polygon::turned(Rings(corners)).ok()
        });
        Ok(polygons
            .map(|polygon| Self::of_polygon(&polygon, &frame, &own_style).with_trim_of(self))
            .collect())
    }

    /// Returns the only face as a polygon, with the frame of its plane.
    pub(crate) fn single_face(&self, operation: &str) -> Result<(Polygon, Scope)> {
        let normal = self.normal();
        let axes = if self.scope().axes.z_axis.dot(normal) > 1.0 - 1e-9 {
            self.scope().axes
        } else {
            Scope::face_axes(normal, self.scope().axes)
        };
        let mesh = self.mesh();
        let frame = Scope::around(axes, mesh.points.iter().copied());
        let polygon = match mesh.faces.as_slice() {
            [face] => mesh.flat_polygon(face, axes, frame.origin),
            faces => {
                let count = faces.len();
                return Err(Error::argument(format!(
                    "{operation} takes one face, and the shape has {count}"
                ))
                .help("use its faces: shape:faces(\"top\")"));
            }
        };
        let invalid = || Error::geometry(format!("{operation}: the outline of the face crosses itself"));
        Ok((polygon.ok_or_else(invalid)?, frame))
    }

    /// Returns the edges of a polygon as shapes, whose z axes point outwards.
    pub(crate) fn border_edges(&self, polygon: &Polygon, frame: &Scope) -> Vec<Self> {
        let style = self.styles().into_iter().next().flatten();
        let edges = polygon.edges().map(|[from, to]| {
            let [a, b] = [from, to].map(|at| frame.point(at.extend(0.0)));
            let along = (b - a).normalize_or(frame.axes.x_axis);
            let out = along.cross(frame.axes.z_axis);
            let scope = Scope {
                origin: a,
                axes: glam::DMat3::from_cols(along, out.cross(along), out),
                size: glam::DVec3::new(a.distance(b), 0.0, 0.0),
            };
            Self::new(scope, crate::ShapeBody::Edge(crate::EdgeKind::Border, style.clone()))
        });
        edges.collect()
    }

    /// Returns the strips and the rest as shapes.
    fn setback_parts(&self, strips: &Strips, frame: &Scope) -> Setback {
        let style = self.styles().into_iter().next().flatten();
        let tagged = |tag: &'static str| crate::FaceStyle::with_automatic_tag(&style, tag);
        let (border, inner) = (tagged("setback.border"), tagged("setback.inner"));
        Setback {
            border: strips
                .border
                .iter()
                .map(|(strip, along)| {
                    Self::of_polygon(strip, frame, &border)
                        .along(frame.axes * along.extend(0.0))
                        .with_trim_of(self)
                })
                .collect(),
            inner: strips
                .inner
                .iter()
                .map(|rest| Self::of_polygon(rest, frame, &inner).with_trim_of(self))
                .collect(),
        }
    }
}

/// Returns a ring without the points that lie on a straight line between their neighbours, which mitred corners leave.
fn without_straight_points(ring: &[DVec2]) -> Vec<DVec2> {
    let count = ring.len();
    let is_corner = |index: &usize| {
        let [before, at, after] = [index + count - 1, *index, index + 1].map(|index| ring[index % count]);
        let (back, forth) = (before - at, after - at);
        back.perp_dot(forth).abs() > 1e-9 * back.length() * forth.length() || back.dot(forth) > 0.0
    };
    (0..count).filter(is_corner).map(|index| ring[index]).collect()
}

impl Selector {
    /// Returns true for an edge of a face, whose z axis points outwards, of a shape with these axes.
    pub fn matches_edge(&self, edge: &Shape, axes: &glam::DMat3) -> bool {
        let style = edge.styles().into_iter().next().flatten();
        self.matches(edge.scope().axes.z_axis, &style, axes)
    }
}

/// Returns the error of an operation on a face, with the place (m) where the rings of the face touch, if they do, as its cause.
pub(crate) fn explain_touching(error: Error, polygon: &Polygon, frame: &Scope) -> Error {
    if *error.kind() != ErrorKind::Geometry {
        return error;
    }
    let mut known: FxHashSet<[u64; 2]> = FxHashSet::default();
    let mut is_new = |at: &DVec2| known.insert((*at + DVec2::ZERO).to_array().map(f64::to_bits));
    let Some(at) = polygon.points().find(|at| !is_new(at)) else { return error };
    let at = frame.point(at.extend(0.0));
    let place = format!("({:.2}, {:.2}, {:.2})", at.x, at.y, at.z);
    Error::geometry(format!("the outline of the face touches itself or a hole at {place}"))
        .help("move the hole by a centimetre: inwards, or over the edge of the face")
}
