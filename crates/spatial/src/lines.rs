//! Linear referencing, simplification, and offset lines.

use burgeon_base::error::{Error, Result};
use burgeon_geometry::Rings;
use burgeon_geometry::planar::simplified;
use glam::{DVec2, DVec3};

use super::edges::{Edge, EdgeTree, edges, with_heights};
use super::measure::length;
use super::parts::closed;
use super::plane::collect_polygons;
use super::{BufferCap, BufferOptions, Geometry};

impl Geometry {
    /// Returns the horizontal direction from the first point of a line to its last (degrees): 0 is east, 90
    /// is north. `None` for other types, and if both points have the same position.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// assert_eq!(Geometry::from_wkt("LINESTRING (1 1, 5 2, 4 4)")?.direction(), Some(45.0));
    /// assert_eq!(Geometry::from_wkt("LINESTRING (0 0, 0 -3)")?.direction(), Some(270.0));
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn direction(&self) -> Option<f64> {
        let line = self.line_points()?;
        let way = (*line.last()? - *line.first()?).truncate();
        let is_way = way != DVec2::ZERO && way.is_finite();
        is_way.then(|| way.y.atan2(way.x).to_degrees().rem_euclid(360.0))
    }

    /// Returns the point at a fraction of a line's horizontal length: 0 is the first point, 1 the last.
    ///
    /// Heights are interpolated linearly. Empty for an empty line; fails for other types.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let path = Geometry::from_wkt("LINESTRING Z (0 0 0, 10 0 5)")?;
    /// assert_eq!(path.line_interpolate(0.2)?.to_wkt(), "POINT Z (2 0 1)");
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn line_interpolate(&self, part: f64) -> Result<Self> {
        let line = self.as_line("line_interpolate")?;
        check_part("line_interpolate", part)?;
        Ok(Self::Point((!line.is_empty()).then(|| along(line, part * length(line)))))
    }

    /// Returns the part of a line between two fractions of its horizontal length in ascending order; a point
    /// if both are equal.
    ///
    /// Empty for an empty line; fails for other types.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let path = Geometry::from_wkt("LINESTRING (0 0, 4 0, 4 4)")?;
    /// assert_eq!(path.line_substring(0.25, 0.75)?.to_wkt(), "LINESTRING (2 0, 4 0, 4 2)");
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn line_substring(&self, from: f64, to: f64) -> Result<Self> {
        let line = self.as_line("line_substring")?;
        check_part("line_substring", from)?;
        check_part("line_substring", to)?;
        if from > to {
            return Err(Error::argument(format!("line_substring: {to} is before {from}"))
                .help("pass the smaller fraction first"));
        }
        if line.is_empty() {
            return Ok(Self::empty(1));
        }
        let whole = length(line);
        let [begin, end] = [from * whole, to * whole];
        let (mut points, mut walked) = (vec![along(line, begin)], 0.0);
        for pair in line.windows(2) {
            walked += length(pair);
            if walked > begin && walked < end {
                points.push(pair[1]);
            }
        }
        points.push(along(line, end));
        points.dedup();
        Ok(Self::line(points).unwrap_or_else(|| Self::Point(Some(along(line, begin)))))
    }

    /// Returns the fraction (0 to 1) of a line's length at the point nearest to another geometry. `None` if
    /// either is empty; fails for other types.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let road = Geometry::from_wkt("LINESTRING (0 0, 30 0, 30 10)")?;
    /// assert_eq!(road.line_locate(&Geometry::from_wkt("POINT (10 5)")?)?, Some(0.25));
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn line_locate(&self, other: &Self) -> Result<Option<f64>> {
        let line = self.as_line("line_locate")?;
        let Some([place, _]) = self.nearest_points(other) else { return Ok(None) };
        let place = place.truncate();
        let (mut walked, mut best) = (0.0, (f64::INFINITY, 0.0));
        for edge in edges(self) {
            let nearest = edge.nearest(place).truncate();
            let far = nearest.distance_squared(place);
            if far < best.0 {
                best = (far, walked + edge.ends[0].truncate().distance(nearest));
            }
            walked += length(&edge.ends);
        }
        let whole = length(line);
        Ok(Some(if whole > 0.0 { (best.1 / whole).min(1.0) } else { 0.0 }))
    }

    /// Returns the points of a line; fails for other types.
    fn as_line(&self, method: &str) -> Result<&[DVec3]> {
        match self {
            Self::Line(points) if self.is_sound() => Ok(points),
            Self::Line(_) => Ok(&[]),
            _ => Err(Error::argument(format!("{method} takes a line, not a {}", self.kind().name()))
                .help("use one line of it: geometry_n, exterior_ring or segments")),
        }
    }

    /// Removes points that are within `tolerance` (m) of the line between others.
    ///
    /// Areas may lose parts, and rings that cross afterwards are repaired.
    ///
    /// Method: D. Douglas and T. Peucker, "Algorithms for the reduction of the number of points required to represent
    /// a digitized line or its caricature", 1973.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let path = Geometry::from_wkt("LINESTRING (0 0, 5 0.1, 10 0, 10 8)")?;
    /// assert_eq!(path.simplify(0.5).to_wkt(), "LINESTRING (0 0, 10 0, 10 8)");
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn simplify(&self, tolerance: f64) -> Self {
        if !self.is_sound() || tolerance.is_nan() {
            return self.clone();
        }
        match self {
            Self::Point(_) | Self::MultiPoint(_) => self.clone(),
            Self::Line(line) => Self::Line(simplified(line, tolerance, aside)),
            Self::MultiLine(lines) => {
                Self::MultiLine(lines.iter().map(|line| simplified(line, tolerance, aside)).collect())
            }
            Self::Polygon(_) | Self::MultiPolygon(_) => {
                let mut parts = Vec::new();
                collect_polygons(self, &mut |rings| {
                    let rings = rings.iter().map(|ring| simplified(&closed(ring), tolerance, aside));
                    parts.extend(Self::polygon(rings.filter(|ring| ring.len() > 3).collect::<Rings>()));
                });
                let made = Self::gathered(parts);
                if made.is_empty() {
                    Self::empty(2)
                } else if made.is_valid() {
                    made
                } else {
                    with_heights(made.dissolved(), &[self])
                }
            }
            Self::Collection(members) => {
                Self::Collection(members.iter().map(|member| member.simplify(tolerance)).collect())
            }
        }
    }

    /// Returns the parallel line at `distance` (m) to the left, or to the right if it is negative.
    ///
    /// `options` define the outer corners. The result has the direction of the line and does not cross
    /// itself, so it may have several parts or be empty. For areas, it is the border at that distance
    /// outside, or inside if it is negative. Fails for points.
    ///
    /// Method: the part of the buffer's border on that side.
    ///
    /// ```
    /// use burgeon_spatial::{BufferJoin, BufferOptions, Geometry};
    ///
    /// let kerb = Geometry::from_wkt("LINESTRING (0 0, 10 0, 10 10)")?;
    /// let options = BufferOptions { join: BufferJoin::Mitre, ..BufferOptions::default() };
    /// assert!((kerb.offset(2.0, &options)?.length() - 16.0).abs() < 1e-6);
    /// assert!((kerb.offset(-2.0, &options)?.length() - 24.0).abs() < 1e-6);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn offset(&self, distance: f64, options: &BufferOptions) -> Result<Self> {
        match self.dimension() {
            2 => return Ok(self.buffer(distance, options)?.boundary()),
            1 => {}
            _ => {
                return Err(Error::argument(format!(
                    "offset takes lines or areas, not a {}",
                    self.kind().name()
                ))
                .help("buffer converts points to an area"));
            }
        }
        if distance == 0.0 {
            return Ok(self.clone());
        }
        let options = BufferOptions { cap: BufferCap::Flat, ..*options };
        let mut made = Vec::new();
        for line in self.parts().into_iter().filter(|part| part.dimension() == 1) {
            let around = line.buffer(distance.abs(), &options)?;
            made.extend(side(&line, &around, distance));
        }
        let made = Self::gathered(made);
        Ok(if made.is_empty() { Self::empty(1) } else { with_heights(made, &[self]) })
    }
}

/// Returns the parts of the border of a line's buffer that lie to its left, or to its right.
fn side(line: &Geometry, around: &Geometry, distance: f64) -> Vec<Geometry> {
    let own = edges(line);
    let tree = EdgeTree::new(own.clone());
    let is_beside = |[a, b]: [DVec3; 2]| {
        let middle = ((a + b) / 2.0).truncate();
        let Some((edge, near)) = tree.nearest_edge(middle) else { return false };
        let way = |edge: &Edge| (edge.ends[1] - edge.ends[0]).truncate();
        // A point whose nearest point is a corner lies on the outer side of the corner's turn.
        let before = own.get((edge.number + own.len() - 1) % own.len());
        let behind = own.get((edge.number + 1) % own.len());
        let corner = if near == edge.ends[1] {
            behind.filter(|next| next.ends[0] == near).map(|next| way(&edge).perp_dot(way(next)))
        } else if near == edge.ends[0] {
            before.filter(|last| last.ends[1] == near).map(|last| way(last).perp_dot(way(&edge)))
        } else {
            None
        };
        let beside = way(&edge).perp_dot(middle - near.truncate());
        let aside = corner.filter(|turn| *turn != 0.0).map_or(beside, |turn| -turn);
        // The straight cuts at the ends of the buffer pass through the ends of the line.
        near.truncate().distance(middle) > 0.9 * distance.abs() && (aside > 0.0) == (distance > 0.0)
    };
    let mut found = Vec::new();
    collect_polygons(around, &mut |rings| {
        for ring in rings.iter() {
            let edges: Vec<[DVec3; 2]> = burgeon_geometry::planar::edges(ring).collect();
            let kept: Vec<bool> = edges.iter().map(|edge| is_beside(*edge)).collect();
            // Start at the first edge that does not belong to the side.
            let Some(begin) = kept.iter().position(|kept| !kept) else {
                found.push(closed(ring));
                continue;
            };
            let mut open = false;
            for index in (0..edges.len()).map(|index| (begin + index) % edges.len()) {
                let [a, b] = edges[index];
                match found.last_mut() {
                    Some(run) if kept[index] && open => run.push(b),
                    _ if kept[index] => found.push(vec![a, b]),
                    _ => {}
                }
                open = kept[index];
            }
        }
    });
    // The border on the left runs against the direction of the line.
    if distance > 0.0 {
        found.iter_mut().for_each(|run| run.reverse());
    }
    found.into_iter().map(Geometry::Line).collect()
}

fn check_part(method: &str, part: f64) -> Result<()> {
    if (0.0..=1.0).contains(&part) {
        return Ok(());
    }
    Err(Error::argument(format!("{method} needs a fraction from 0 to 1, not {part}"))
        .help("0 is the first point of the line and 1 the last"))
}

/// Returns the point of a non-empty line at a horizontal distance (m) from its first point.
pub(crate) fn along(line: &[DVec3], mut far: f64) -> DVec3 {
    for pair in line.windows(2) {
        let long = length(pair);
        if far < long {
            return pair[0].lerp(pair[1], (far / long).max(0.0));
        }
        far -= long;
    }
    line.last().copied().unwrap_or_default()
}

/// Returns the horizontal distance (m) of a point from the segment between two others.
fn aside(point: DVec3, ends: [DVec3; 2]) -> f64 {
    let place = point.truncate();
    Edge { ends, number: 0 }.nearest(place).truncate().distance(place)
}
