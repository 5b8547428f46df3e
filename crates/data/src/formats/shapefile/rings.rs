//! Assembly of polygons from rings: outer rings should be clockwise, holes counter-clockwise, and the file does not assign
//! holes to outer rings.

use glam::DVec3;

use burgeon_base::budget::Budget;
use burgeon_base::error::Result;
use burgeon_spatial::Geometry;

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

/// Assembles polygons from rings. A hole belongs to the smallest outer ring around it.
///
/// If a hole is outside all outer rings, the orientation means nothing, as in files of some programs: rings around an
/// odd number of other rings are then holes.
pub(super) fn polygons(rings: Vec<Vec<DVec3>>, budget: &Budget) -> Result<Vec<Geometry>> {
    let rings: Vec<Vec<DVec3>> = rings.into_iter().filter(|ring| ring.len() > 2).collect();
    if let [_] = rings[..] {
        return Ok(Geometry::polygon(rings).into_iter().collect());
    }
    let boxes: Vec<[DVec3; 2]> = rings.iter().map(|ring| bounds(ring)).collect();
    let mut is_hole: Vec<bool> = rings.iter().map(|ring| turn(ring) > 0.0).collect();
    let mut owners = owners(&rings, &boxes, &is_hole, budget)?;
    let is_loose = |owners: &[Option<usize>], is_hole: &[bool]| {
        owners.iter().zip(is_hole).any(|(owner, is_hole)| *is_hole && owner.is_none())
    };
    if is_loose(&owners, &is_hole) {
        for (ring, is_hole) in is_hole.iter_mut().enumerate() {
            let mut around = 0;
            for other in 0..rings.len() {
                budget.tick()?;
                around += usize::from(surrounds(&rings, &boxes, other, ring, budget)?);
            }
            *is_hole = around % 2 == 1;
        }
        owners = self::owners(&rings, &boxes, &is_hole, budget)?;
    }
    let mut polygons: Vec<Vec<Vec<DVec3>>> = vec![Vec::new(); rings.len()];
    let (mut outer, mut holes) = (Vec::new(), Vec::new());
    for (number, ring) in rings.into_iter().enumerate() {
        match owners[number].filter(|_| is_hole[number]) {
            Some(owner) => holes.push((owner, ring)),
            None => outer.push((number, ring)),
        }
    }
    // The outer ring is the first one of its polygon.
    for (number, ring) in outer.into_iter().chain(holes) {
        polygons[number].push(ring);
    }
    let polygons = polygons.into_iter().filter(|rings| !rings.is_empty());
    Ok(polygons.filter_map(Geometry::polygon).collect())
}

/// Returns the smallest outer ring around each hole.
fn owners(
    rings: &[Vec<DVec3>],
    boxes: &[[DVec3; 2]],
    is_hole: &[bool],
    budget: &Budget,
) -> Result<Vec<Option<usize>>> {
    let outer: Vec<usize> = (0..rings.len()).filter(|ring| !is_hole[*ring]).collect();
    let size = |ring: usize| (boxes[ring][1] - boxes[ring][0]).truncate().element_product();
    let mut owners = vec![None; rings.len()];
    for hole in (0..rings.len()).filter(|ring| is_hole[*ring]) {
        let mut owner: Option<usize> = None;
        for ring in outer.iter().copied() {
            budget.tick()?;
            if owner.is_none_or(|least| size(ring) < size(least))
                && surrounds(rings, boxes, ring, hole, budget)?
            {
                owner = Some(ring);
            }
        }
        owners[hole] = owner;
    }
    Ok(owners)
}

/// Returns true if a ring is inside another one.
fn surrounds(
    rings: &[Vec<DVec3>],
    boxes: &[[DVec3; 2]],
    outer: usize,
    inner: usize,
    budget: &Budget,
) -> Result<bool> {
    let [[outer_low, outer_high], [low, high]] = [outer, inner].map(|ring| boxes[ring].map(DVec3::truncate));
    let is_around = outer_low.cmple(low).all() && outer_high.cmpge(high).all();
    Ok(outer != inner && is_around && holds(&rings[outer], &rings[inner], budget)?)
}
