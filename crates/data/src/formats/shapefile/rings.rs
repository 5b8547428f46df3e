//! Assembly of polygons from rings: outer rings are clockwise, holes are counter-clockwise, and the file does not
//! assign holes to outer rings.

use glam::DVec3;

use crate::Geometry;
use burgeon_base::budget::Budget;
use burgeon_base::error::Result;

/// Returns twice the signed area of a ring; positive if it is counter-clockwise.
fn turn(ring: &[DVec3]) -> f64 {
    let Some(first) = ring.first() else { return 0.0 };
    let pairs = ring.windows(2).map(|pair| {
        let [a, b] = [pair[0] - first, pair[1] - first].map(|way| way.truncate());
        a.perp_dot(b)
    });
    pairs.sum()
}

/// Returns the minimum and maximum coordinates.
fn bounds(ring: &[DVec3]) -> [DVec3; 2] {
    let (low, high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    ring.iter().fold([low, high], |[low, high], point| [low.min(*point), high.max(*point)])
}

/// Returns true if a point is inside a ring: a ray to the east crosses the ring an odd number of times.
fn contains(ring: &[DVec3], point: DVec3) -> bool {
    let crosses = ring.windows(2).filter(|pair| {
        let (a, b) = (pair[0], pair[1]);
        (a.y > point.y) != (b.y > point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)
    });
    crosses.count() % 2 == 1
}

/// Returns true if a hole is inside an outer ring, by a majority of its points that are not on the ring.
fn holds(outer: &[DVec3], hole: &[DVec3], budget: &Budget) -> Result<bool> {
    let (mut inside, mut outside) = (0, 0);
    let beside = hole.iter().filter(|point| !outer.contains(point));
    // The midpoints of its sides decide for a hole whose corners are all on the ring.
    let middles = hole.windows(2).map(|pair| pair[0].midpoint(pair[1]));
    for point in beside.copied().chain(middles).take(9) {
        budget.tick()?;
        if contains(outer, point) { inside += 1 } else { outside += 1 }
    }
    Ok(inside > outside)
}

/// Assembles polygons from rings. A hole belongs to the smallest outer ring around it. A hole outside all outer rings
/// becomes a polygon, because many programs write rings of either orientation.
pub(super) fn polygons(rings: Vec<Vec<DVec3>>, budget: &Budget) -> Result<Vec<Geometry>> {
    let rings: Vec<Vec<DVec3>> = rings.into_iter().filter(|ring| ring.len() > 2).collect();
    if let [_] = rings[..] {
        return Ok(Geometry::polygon(rings).into_iter().collect());
    }
    let turns: Vec<f64> = rings.iter().map(|ring| turn(ring)).collect();
    let (mut polygons, mut holes): (Vec<Vec<Vec<DVec3>>>, Vec<Vec<DVec3>>) = (Vec::new(), Vec::new());
    for (ring, turn) in rings.into_iter().zip(&turns) {
        if *turn <= 0.0 { polygons.push(vec![ring]) } else { holes.push(ring) }
    }
    let boxes: Vec<[DVec3; 2]> = polygons.iter().map(|polygon| bounds(&polygon[0])).collect();
    let mut loose = Vec::new();
    for hole in holes {
        let [low, high] = bounds(&hole).map(|corner| corner.truncate());
        let mut owner: Option<(f64, usize)> = None;
        for (number, [outer_low, outer_high]) in boxes.iter().enumerate() {
            budget.tick()?;
            let around = outer_low.truncate().cmple(low).all() && outer_high.truncate().cmpge(high).all();
            let size = (*outer_high - *outer_low).truncate().element_product();
            if around
                && owner.is_none_or(|(least, _)| size < least)
                && holds(&polygons[number][0], &hole, budget)?
            {
                owner = Some((size, number));
            }
        }
        match owner {
            Some((_, number)) => polygons[number].push(hole),
            None => loose.push(vec![hole]),
        }
    }
    polygons.extend(loose);
    Ok(polygons.into_iter().filter_map(Geometry::polygon).collect())
}
