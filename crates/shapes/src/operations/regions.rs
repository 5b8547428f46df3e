//! Parts of faces by area, zoning envelopes and inner rectangles.

use burgeon_base::Stop;
use burgeon_base::error::{Error, Result};
use burgeon_geometry::Polygon;
use glam::{DMat3, DVec2, DVec3};

use crate::sizes::PartInterval;
use crate::{CutPlane, PartSizes, Shape, SplitAxis, SplitParts};

/// Maximum number of parts of a split by area.
const MOST_PARTS: usize = 10_000;
/// Number of divisions of the lattice on which the inner rectangle is searched.
const LATTICE: usize = 48;

/// Limit of a zoning envelope along an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EnvelopeLimit {
    /// Height (m) up to which the envelope rises over the edge.
    pub height: f64,
    /// Angle (radians) from the horizontal at which it continues inwards: a right angle for an upright wall.
    pub angle: f64,
}

impl Shape {
    /// Divides faces along an axis of the scope into parts with given areas (m²), as [`Shape::split`] does with lengths.
    ///
    /// Method: bisection of the position of each cut.
    pub fn split_area(&self, axis: SplitAxis, areas: &PartSizes) -> Result<SplitParts> {
        if self.is_closed() {
            return Err(
                Error::argument("a solid is not divided by area").help("use a face: shape:faces(\"top\")")
            );
        }
        let axis = axis as usize;
        let normal = self.scope().axes.col(axis);
        let (start, length) = (self.scope().origin.dot(normal), self.scope().size[axis]);
        let mut split = SplitParts::default();
        let divided = areas.divide(self.area(), MOST_PARTS)?;
        (split.rest, split.missing) = (divided.rest, divided.missing);
        let mut rest = self.clone();
        for PartInterval { entry, from, to } in divided.parts {
            Stop::check_current()?;
            let wanted = to - from;
            if rest.area() - wanted < 1e-9 * self.area() {
                split.parts.push((entry, rest));
                return Ok(split);
            }
            let (mut low, mut high) = (0.0, length);
            for _ in 0..50 {
                let middle = f64::midpoint(low, high);
                let ([below, _], _) = rest.cut(&CutPlane { normal, offset: start + middle })?;
                let is_less = below.is_none_or(|below| below.area() < wanted);
                *if is_less { &mut low } else { &mut high } = middle;
            }
            let ([below, above], _) = rest.cut(&CutPlane { normal, offset: start + high })?;
            split.parts.extend(below.map(|part| (entry, part)));
            let Some(above) = above else { break };
            rest = above;
        }
        Ok(split)
    }

    /// Returns the volume that a zoning law allows over a horizontal face: `most` (m) high, and below a plane over each
    /// edge that has a limit. The planes of all edges cut the whole volume.
    ///
    /// `limits` has the limit of each edge, which gets the edge as a shape with z outwards. Fails unless the shape is one
    /// face that looks upwards, and if nothing remains.
    pub fn envelope(&self, most: f64, limits: impl Fn(&Self) -> Option<EnvelopeLimit>) -> Result<Self> {
        let (polygon, frame) = self.single_face("envelope")?;
        if frame.axes.z_axis.z < 1.0 - 1e-6 {
            return Err(Error::argument("the face below an envelope is not horizontal")
                .help("use shape:faces(\"up\")"));
        }
        let mut solid = self.extrude(most, None)?;
        for edge in self.border_edges(&polygon, &frame) {
            let Some(EnvelopeLimit { height, angle }) = limits(&edge) else { continue };
            if !(height >= 0.0 && angle > 0.0 && angle <= std::f64::consts::FRAC_PI_2) {
                let degrees = angle.to_degrees();
                return Err(Error::argument(format!("a limit of {height} m and {degrees} degrees"))
                    .help("use a height from 0, and an angle above 0 and up to 90 degrees"));
            }
            let outward = edge.scope().axes.z_axis;
            // Rises inwards at the angle.
            let normal = (outward * angle.sin() + DVec3::Z * angle.cos()).normalize();
            let plane = CutPlane::through(edge.scope().origin + DVec3::Z * height, normal);
            let ([below, _], _) = solid.cut(&plane)?;
            solid = below
                .ok_or_else(|| Error::geometry("nothing remains of the envelope").help("raise the limits"))?;
        }
        Ok(solid)
    }

    /// Returns a large rectangle inside a face, along the axes of its scope, within 1/48 of the extent of the largest
    /// one; `None` if it is too narrow.
    ///
    /// Method: the largest rectangle of lattice cells that lie inside, which then grows to the outline.
    pub fn inner_rectangle(&self) -> Result<Option<Self>> {
        let (polygon, frame) = self.single_face("inner_rectangle")?;
        let Some([low, high]) = polygon.bounds() else { return Ok(None) };
        let lines = |axis: usize| -> Vec<f64> {
            #[allow(clippy::cast_precision_loss, reason = "few lines")]
            let even =
                (0..=LATTICE).map(|line| low[axis] + (high[axis] - low[axis]) * line as f64 / LATTICE as f64);
            let corners = polygon.points().map(|at| at[axis]).take(LATTICE);
            let mut lines: Vec<f64> = even.chain(corners).collect();
            lines.sort_by(f64::total_cmp);
            lines.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
            lines
        };
        let (columns, rows) = (lines(0), lines(1));
        let inside: Vec<Vec<bool>> = rows
            .windows(2)
            .map(|row| {
                columns
                    .windows(2)
                    .map(|column| {
                        contains_rectangle(
                            &polygon,
                            [DVec2::new(column[0], row[0]), DVec2::new(column[1], row[1])],
                        )
                    })
                    .collect()
            })
            .collect();
        let Some([mut low, mut high]) = largest(&inside, &columns, &rows) else { return Ok(None) };
        for axis in 0..2 {
            grow(&polygon, [&mut low, &mut high], axis);
        }
        let style = self.styles().into_iter().next().flatten();
        let ring = vec![low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
        let Ok(rectangle) = Polygon::turned(burgeon_geometry::Rings(vec![ring])) else { return Ok(None) };
        Ok(Some(Self::of_polygon(&rectangle, &frame, &style).with_trim_of(self)))
    }

    /// Returns the part of faces within a rectangle of the scope's x and y axes (m), measured from the scope's position;
    /// `None` if there is none.
    pub fn crop(&self, low: DVec2, high: DVec2) -> Result<Option<Self>> {
        let mut rest = self.clone();
        for (axis, at, sign) in [(0, low.x, -1.0), (0, high.x, 1.0), (1, low.y, -1.0), (1, high.y, 1.0)] {
            let normal = self.scope().axes.col(axis);
            let plane =
                CutPlane { normal: normal * sign, offset: sign * (self.scope().origin.dot(normal) + at) };
            let ([below, _], _) = rest.cut(&plane)?;
            let Some(below) = below else { return Ok(None) };
            rest = below;
        }
        Ok(Some(rest))
    }

    /// Returns the shape with a scope whose x axis runs along a direction in the plane of its z axis.
    pub(super) fn along(&self, x: DVec3) -> Self {
        let z = self.scope().axes.z_axis;
        self.align(DMat3::from_cols(x, z.cross(x), z))
    }
}

/// Returns true if a rectangle lies inside a polygon: no edge passes through it, and its middle is inside.
fn contains_rectangle(polygon: &Polygon, [low, high]: [DVec2; 2]) -> bool {
    let slack = (high - low) * 1e-9;
    let (low, high) = (low + slack, high - slack);
    let crosses = |[from, to]: [DVec2; 2]| {
        // Clips the edge to the rectangle.
        let (mut begin, mut end) = (0.0_f64, 1.0_f64);
        let along = to - from;
        for axis in 0..2 {
            if along[axis].abs() < 1e-15 {
                if from[axis] <= low[axis] || from[axis] >= high[axis] {
                    return false;
                }
                continue;
            }
            let (a, b) = ((low[axis] - from[axis]) / along[axis], (high[axis] - from[axis]) / along[axis]);
            (begin, end) = (begin.max(a.min(b)), end.min(a.max(b)));
        }
        begin < end
    };
    polygon.contains(low.midpoint(high)) && !polygon.edges().any(crosses)
}

/// Returns the largest rectangle of cells that are inside.
fn largest(inside: &[Vec<bool>], columns: &[f64], rows: &[f64]) -> Option<[DVec2; 2]> {
    let mut best: Option<([DVec2; 2], f64)> = None;
    for bottom in 0..inside.len() {
        let mut free = inside[bottom].clone();
        for top in bottom..inside.len() {
            free.iter_mut().zip(&inside[top]).for_each(|(free, cell)| *free &= cell);
            let mut from = None;
            for column in 0..=free.len() {
                match (free.get(column).copied().unwrap_or(false), from) {
                    (true, None) => from = Some(column),
                    (false, Some(first)) => {
                        let low = DVec2::new(columns[first], rows[bottom]);
                        let high = DVec2::new(columns[column], rows[top + 1]);
                        let area = (high - low).element_product();
                        if best.is_none_or(|(_, most)| area > most) {
                            best = Some(([low, high], area));
                        }
                        from = None;
                    }
                    _ => {}
                }
            }
        }
    }
    best.map(|(rectangle, _)| rectangle)
}

/// Moves both sides of a rectangle along an axis outwards to the outline.
fn grow(polygon: &Polygon, [low, high]: [&mut DVec2; 2], axis: usize) {
    let Some(bounds) = polygon.bounds() else { return };
    for (is_high, limit) in [(false, bounds[0][axis]), (true, bounds[1][axis])] {
        let (mut near, mut far) = (if is_high { high[axis] } else { low[axis] }, limit);
        for _ in 0..40 {
            let middle = f64::midpoint(near, far);
            let (mut a, mut b) = (*low, *high);
            *if is_high { &mut b[axis] } else { &mut a[axis] } = middle;
            *if contains_rectangle(polygon, [a, b]) { &mut near } else { &mut far } = middle;
        }
        // The search ends next to a corner of the outline, whose coordinate is exact.
        let exact = polygon.points().map(|at| at[axis]).find(|corner| (corner - near).abs() < 1e-6);
        *if is_high { &mut high[axis] } else { &mut low[axis] } = exact.unwrap_or(near);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PartSize, Selector, SizedParts};

    fn corner_lot() -> Shape {
        let ring =
            [(0.0, 0.0), (20.0, 0.0), (20.0, 8.0), (8.0, 8.0), (8.0, 20.0), (0.0, 20.0)].map(DVec2::from);
        Shape::plan(&[ring.to_vec()], 0.0).expect("a plan")
    }

    #[test]
    fn parts_by_area_have_these_areas() {
        let lot = corner_lot();
        let areas = PartSizes(vec![
            SizedParts::One(PartSize::Absolute(50.0)),
            SizedParts::Repeated(vec![PartSize::Flexible(60.0)]),
        ]);
        let parts = lot.split_area(SplitAxis::X, &areas).expect("parts").parts;
        let areas: Vec<f64> = parts.iter().map(|(_, part)| part.area()).collect();
        assert!(
            (areas[0] - 50.0).abs() < 1e-6 && (areas.iter().sum::<f64>() - 256.0).abs() < 1e-6,
            "{areas:?}"
        );
        assert!(areas[1..].iter().all(|area| (area - areas[1]).abs() < 1e-5), "{areas:?}");
    }

    #[test]
    fn the_inner_rectangle_of_an_angle_fills_one_wing() {
        let inner = corner_lot().inner_rectangle().expect("a face").expect("a rectangle");
        assert!((inner.area() - 160.0).abs() < 1e-6, "{}", inner.area());
    }

    #[test]
    fn a_cropped_face_is_a_rectangle_and_a_recess_opens_outwards() {
        let wall = &Shape::cuboid(DVec3::new(6.0, 1.0, 3.0)).faces(&Selector::All).expect("faces")[1];
        let hole = wall.crop(DVec2::new(1.0, 0.5), DVec2::new(2.5, 2.5)).expect("a cut").expect("a part");
        assert!((hole.area() - 3.0).abs() < 1e-9 && matches!(hole.body, crate::ShapeBody::Rectangle(_)));
        let inside = hole.recess(0.2).expect("a recess");
        assert!((inside.area() - (3.0 + 2.0 * 3.5 * 0.2)).abs() < 1e-9 && !inside.is_closed());
        let back = &inside.faces(&Selector::Tagged("recess.back".into())).expect("faces")[0];
        assert!(back.normal().abs_diff_eq(wall.normal(), 1e-9) && (back.centroid().y - 0.2).abs() < 1e-9);
    }

    #[test]
    fn an_envelope_is_cut_by_the_planes_of_its_edges() {
        let lot = Shape::rectangle(DVec2::new(10.0, 20.0));
        let front = |edge: &Shape| {
            (edge.scope().axes.z_axis.y < -0.5)
                .then_some(EnvelopeLimit { height: 6.0, angle: std::f64::consts::FRAC_PI_4 })
        };
        let solid = lot.envelope(12.0, front).expect("an envelope");
        // A triangular prism of 6 m by 6 m is missing over the front.
        assert!((solid.volume() - (10.0 * 20.0 * 12.0 - 18.0 * 10.0)).abs() < 1e-6, "{}", solid.volume());
    }
}
