//! Fewer points.

use burgeon_geometry::Rings;
use burgeon_spatial::Geometry;
use glam::{DVec2, DVec3};

/// A geometry with fewer points: none that is left out was farther than `distance` from what stays. Rings of which fewer
/// than three points are left go.
///
/// Method: Douglas and Peucker, "Algorithms for the reduction of the number of points required to represent a digitized
/// line or its caricature", 1973.
pub(super) fn simplified(geometry: &Geometry, distance: f64) -> Geometry {
    let line = |points: &[DVec3]| reduced(points, distance);
    let rings = |rings: &Rings| {
        let kept = rings.iter().enumerate().map(|(index, ring)| {
            let closed: Vec<DVec3> = ring.iter().chain(ring.first()).copied().collect();
            let mut kept = line(&closed);
            kept.pop();
            (index, kept)
        });
        let kept: Vec<(usize, Vec<DVec3>)> = kept.filter(|(_, ring)| ring.len() >= 3).collect();
        // Without its border there is no area.
        match kept.first() {
            Some((0, _)) => Rings(kept.into_iter().map(|(_, ring)| ring).collect()),
            _ => Rings(Vec::new()),
        }
    };
    match geometry {
        Geometry::Line(points) => Geometry::Line(line(points)),
        Geometry::MultiLine(lines) => Geometry::MultiLine(lines.iter().map(|points| line(points)).collect()),
        Geometry::Polygon(polygon) => Geometry::Polygon(rings(polygon)),
        Geometry::MultiPolygon(polygons) => {
            Geometry::MultiPolygon(polygons.iter().map(rings).filter(|rings| !rings.is_empty()).collect())
        }
        Geometry::Collection(members) => {
            Geometry::Collection(members.iter().map(|member| simplified(member, distance)).collect())
        }
        other => other.clone(),
    }
}

fn reduced(points: &[DVec3], distance: f64) -> Vec<DVec3> {
    if points.len() < 3 {
        return points.to_vec();
    }
    let mut kept = vec![false; points.len()];
    let last = points.len() - 1;
    (kept[0], kept[last]) = (true, true);
    let mut open = vec![(0, last)];
    while let Some((from, to)) = open.pop() {
        let between = (from + 1..to).map(|index| (index, apart(points[index], points[from], points[to])));
        let farthest = between.reduce(|best, next| if next.1 > best.1 { next } else { best });
        if let Some((index, far)) = farthest
            && far > distance
        {
            kept[index] = true;
            open.extend([(from, index), (index, to)]);
        }
    }
    points.iter().zip(kept).filter(|(_, kept)| *kept).map(|(point, _)| *point).collect()
}

/// How far a point is from a line, as seen from above.
fn apart(point: DVec3, from: DVec3, to: DVec3) -> f64 {
    let (point, from, to): (DVec2, DVec2, DVec2) = (point.truncate(), from.truncate(), to.truncate());
    let (way, own) = (to - from, point - from);
    let length = way.length_squared();
    let part = if length > 0.0 { (own.dot(way) / length).clamp(0.0, 1.0) } else { 0.0 };
    own.distance(way * part)
}
