//! The adjacency of a system's footprints: the parts of each edge that other footprints touch.

use std::hash::Hasher;
use std::sync::{Arc, OnceLock};

use glam::DVec2;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};
use rustc_hash::{FxHashMap, FxHasher};
use smallvec::SmallVec;

use super::Footprint;
use super::cover::Cover;
use burgeon_geometry::Plan;
use burgeon_kit::Object;
use burgeon_kit::declare::as_mut;

/// Maximum gap or overlap (m) of walls that touch.
const APART: f64 = 0.3;
/// Cosine of the maximum angle (8 degrees) between walls that touch.
const OPPOSITE: f64 = 0.990_27;
/// Minimum length (m) along which buildings touch.
const LEAST: f64 = 0.1;
/// Minimum width (m) of an obstacle in front of an edge. A narrower obstacle is ignored.
const NARROW: f64 = 0.01;

type IndexedBox = GeomWithData<Rectangle<[f64; 2]>, u32>;

/// All footprints of a system. Shared data is computed on first use.
pub(super) struct Neighborhood {
    plans: Vec<(Arc<Plan>, DVec2)>,
    /// Top (m) of each footprint's walls, if it is known before they are built.
    tops: Vec<Option<f64>>,
    map: OnceLock<FootprintMap>,
}

/// The positions of the footprints. Footprints with equal walls share one outline.
struct FootprintMap {
    /// Walls of all outlines.
    walls: Vec<WallEnds>,
    /// Index of each outline's first wall, and the total number of walls at the end.
    begins: Vec<usize>,
    /// Outline of each footprint.
    outlines: Vec<u32>,
    /// Owners of each outline.
    owners: Vec<OutlineOwners>,
    boxes: RTree<IndexedBox>,
}

/// The footprints that have the same walls.
#[derive(Default)]
struct OutlineOwners {
    count: u32,
    /// Footprint with the highest walls, and the height (m) at which they end. `second` is the top of the next highest.
    highest: Option<(usize, f64)>,
    second: f64,
}

impl OutlineOwners {
    fn add(&mut self, footprint: usize, top: f64) {
        self.count += 1;
        let other = match self.highest {
            Some((_, known)) if known >= top => top,
            known => {
                self.highest = Some((footprint, top));
                known.map_or(f64::NEG_INFINITY, |(_, top)| top)
            }
        };
        self.second = if self.count > 2 { self.second.max(other) } else { other };
    }

    /// Returns the highest top (m) of the walls of the owners other than `own`.
    fn top_besides(&self, own: usize) -> f64 {
        match self.highest {
            Some((highest, top)) if highest != own => top,
            _ => self.second,
        }
    }
}

impl FootprintMap {
    fn new(plans: &[(Arc<Plan>, DVec2)], tops: &[Option<f64>]) -> Self {
        let mut map = Self {
            walls: Vec::new(),
            begins: vec![0],
            outlines: Vec::with_capacity(plans.len()),
            owners: Vec::new(),
            boxes: RTree::default(),
        };
        // Outlines by the hash of their walls.
        let mut known: FxHashMap<u64, SmallVec<[u32; 1]>> = FxHashMap::default();
        for (footprint, ((plan, origin), top)) in plans.iter().zip(tops).enumerate() {
            let outline = map.outline(&mut known, plan, *origin);
            map.outlines.push(outline);
            if let Some(owners) = map.owners.get_mut(outline as usize) {
                // Walls that are not built yet may have any height.
                owners.add(footprint, top.unwrap_or(f64::INFINITY));
            }
        }
        let boxes = (0u32..).zip(0..map.owners.len()).filter_map(|(index, outline)| {
            let [low, high] = bounds(map.walls_of(outline))?;
            let (low, high) = (low - APART, high + APART);
            Some(GeomWithData::new(Rectangle::from_corners(low.to_array(), high.to_array()), index))
        });
        map.boxes = RTree::bulk_load(boxes.collect());
        map
    }

    /// Returns the outline of a plan at a position, and adds it if no outline has the same walls.
    fn outline(&mut self, known: &mut FxHashMap<u64, SmallVec<[u32; 1]>>, plan: &Plan, origin: DVec2) -> u32 {
        let begin = self.walls.len();
        self.walls.extend(plan.polygon().edges().map(|edge| edge.map(|point| point.truncate() + origin)));
        let mut hasher = FxHasher::default();
        for number in self.walls[begin..].iter().flatten().flat_map(|end| end.to_array()) {
            hasher.write_u64(number.to_bits());
        }
        let alike = known.entry(hasher.finish()).or_default();
        if let Some(same) = alike.iter().find(|other| self.walls_of(**other as usize) == &self.walls[begin..])
        {
            self.walls.truncate(begin);
            return *same;
        }
        let outline = u32::try_from(self.owners.len()).unwrap_or(u32::MAX);
        alike.push(outline);
        self.begins.push(self.walls.len());
        self.owners.push(OutlineOwners::default());
        outline
    }

    /// Returns the outlines whose boxes intersect `around`, in order, each with the number of its owners other than
    /// `own`.
    fn around(&self, own: usize, around: &AABB<[f64; 2]>) -> SmallVec<[(&IndexedBox, u32); 16]> {
        let found = self.boxes.locate_in_envelope_intersecting(around).filter_map(|found| {
            let count = self.owners.get(found.data as usize)?.count;
            let others = count - u32::from(self.outlines.get(own) == Some(&found.data));
            (others > 0).then_some((found, others))
        });
        let mut found: SmallVec<[_; 16]> = found.collect();
        found.sort_unstable_by_key(|(found, _)| found.data);
        found
    }

    /// Returns the walls of a footprint.
    fn walls_at(&self, own: usize) -> &[WallEnds] {
        self.outlines.get(own).map_or(&[], |outline| self.walls_of(*outline as usize))
    }

    /// Returns the walls of an outline.
    fn walls_of(&self, outline: usize) -> &[WallEnds] {
        match self.begins.get(outline..outline + 2) {
            Some(&[begin, end]) => &self.walls[begin..end],
            _ => &[],
        }
    }
}

/// The two ends (m) of an edge.
type WallEnds = [DVec2; 2];

/// The contact of a footprint with the other footprints.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Touch {
    /// Touched fraction, 0 to 1, of each edge's length, over all rings.
    pub shared: Vec<f64>,
    /// Covers of each edge, with heights (m) in world coordinates. Empty if no edge is covered.
    pub covers: Vec<Vec<Cover>>,
    /// Number of neighbours.
    pub neighbors: u32,
}

/// Connects the footprints among `objects` with one another.
pub(super) fn gather(objects: &mut [Box<dyn Object>]) {
    let mut found: Vec<&mut Footprint> =
        objects.iter_mut().filter_map(|object| as_mut::<Footprint>(&mut **object)).collect();
    let plans = found.iter().map(|footprint| (Arc::clone(&footprint.plan), footprint.origin().truncate()));
    let top = |footprint: &&mut Footprint| {
        footprint.options.height.map(|height| footprint.origin().z + footprint.plan.ground().1 + height.0)
    };
    let (plans, tops) = (plans.collect(), found.iter().map(top).collect());
    let all = Arc::new(Neighborhood { plans, tops, map: OnceLock::new() });
    for (index, footprint) in found.iter_mut().enumerate() {
        footprint.place = Some((Arc::clone(&all), index));
        footprint.edges = Arc::default();
    }
}

fn bounds(walls: &[WallEnds]) -> Option<[DVec2; 2]> {
    let [first, _] = *walls.first()?;
    Some(walls.iter().fold([first; 2], |[low, high], [point, _]| [low.min(*point), high.max(*point)]))
}

impl Neighborhood {
    fn map(&self) -> &FootprintMap {
        self.map.get_or_init(|| FootprintMap::new(&self.plans, &self.tops))
    }

    /// Computes the contact of footprint `own` with the others: walls that face it, at an angle of at most 8 degrees
    /// and a distance of at most 0.3 m.
    pub(super) fn touch(&self, own: usize) -> Touch {
        let map = self.map();
        let walls = map.walls_at(own);
        let Some([low, high]) = bounds(walls) else { return Touch::default() };
        let mut covers: Vec<Vec<Cover>> = vec![Vec::new(); walls.len()];
        let mut neighbors = 0;
        let around = AABB::from_corners(low.to_array(), high.to_array());
        for (other, count) in map.around(own, &around) {
            let near = |[a, b]: &&WallEnds| {
                a.max(*b).cmpge(low - APART).all() && a.min(*b).cmple(high + APART).all()
            };
            let theirs = map.walls_of(other.data as usize).iter().filter(near);
            let theirs: SmallVec<[WallEnds; 16]> = theirs.copied().collect();
            let [least, most] = [other.geom().lower(), other.geom().upper()].map(DVec2::from);
            let mut longest = 0f64;
            let top = map.owners[other.data as usize].top_besides(own);
            for (&[a, b], covers) in walls.iter().zip(&mut covers) {
                // The box is already enlarged by the maximum gap of walls that touch.
                if a.max(b).cmplt(least).any() || a.min(b).cmpgt(most).any() {
                    continue;
                }
                for part in theirs.iter().filter_map(|their| overlap([a, b], *their)) {
                    longest = longest.max(part[1] - part[0]);
                    covers.push(Cover { part, top });
                }
            }
            neighbors += if longest >= LEAST { count } else { 0 };
        }
        let shared = walls.iter().zip(&covers).map(|([a, b], covers)| {
            let length = a.distance(*b);
            if length > 0.0 { (union(covers) / length).min(1.0) } else { 0.0 }
        });
        let shared = shared.collect();
        if covers.iter().all(Vec::is_empty) {
            covers.clear();
        }
        Touch { shared, covers, neighbors }
    }

    /// Returns the top (m) of a footprint's walls, if it is known before they are built.
    pub(super) fn top(&self, own: usize) -> Option<f64> {
        self.tops.get(own).copied().flatten()
    }

    /// Returns the available overhang (m) over each edge of footprint `own`: half the distance to others in front of
    /// the edge, so that both have room, at most `furthest`, and 0 where they touch. Ignores footprints that end below
    /// `height` (m).
    pub(super) fn reach(&self, own: usize, furthest: f64, height: f64) -> Vec<f64> {
        let map = self.map();
        let walls = map.walls_at(own);
        let mut reach = vec![f64::INFINITY; walls.len()];
        let (Some([low, high]), Some((plan, _))) = (bounds(walls), self.plans.get(own)) else { return reach };
        let search = 2.0 * furthest + APART;
        let (low, high) = (low - search, high + search);
        let around = AABB::from_corners(low.to_array(), high.to_array());
        let is_near = |[a, b]: &&WallEnds| a.max(*b).cmpge(low).all() && a.min(*b).cmple(high).all();
        let others = map.around(own, &around).into_iter().map(|(found, _)| found.data as usize);
        let in_the_way = others.filter(|&other| map.owners[other].top_besides(own) > height);
        let theirs: Vec<WallEnds> =
            in_the_way.flat_map(|other| map.walls_of(other).iter().filter(is_near)).copied().collect();
        for (wall, reach) in walls.iter().zip(&mut reach) {
            let mut parts = theirs.iter().filter_map(|their| overlap(*wall, *their));
            if parts.any(|[begin, end]| end - begin > APART) {
                *reach = 0.0;
            }
        }
        for (edge, front) in
            fronts(walls, plan.polygon().iter().map(|ring| ring.len()), &reach).iter().enumerate()
        {
            let distances = theirs.iter().filter_map(|their| front.distance(*their, search));
            let free = distances.map(|distance| if distance <= APART { 0.0 } else { distance / 2.0 });
            reach[edge] = free.fold(reach[edge], f64::min);
        }
        reach
    }
}

/// The area in front of an edge: bounded by the mitres at its ends, or by the lines of adjacent edges that others
/// touch.
struct FrontArea {
    from: DVec2,
    out: DVec2,
    /// Points and directions of the half-planes that bound the area.
    sides: [[DVec2; 2]; 2],
}

/// Returns the area in front of each edge of rings of these sizes. An edge that others touch has a `reach` of 0.
fn fronts(walls: &[WallEnds], sizes: impl Iterator<Item = usize>, reach: &[f64]) -> Vec<FrontArea> {
    let mut fronts = Vec::with_capacity(walls.len());
    for count in sizes {
        let first = fronts.len();
        for index in 0..count {
            let [a, b] = walls[first + index];
            let along = (b - a).normalize_or_zero();
            let side = |neighbour: usize, end: DVec2, way: DVec2| {
                let neighbour = first + neighbour % count;
                let [c, d] = walls[neighbour];
                let turned = (d - c).normalize_or_zero();
                let inward = turned.perp();
                // Walls that touch may overlap by this distance.
                if reach[neighbour] == 0.0 && inward.dot(way) > 0.0 {
                    [end + inward * APART, inward]
                } else {
                    [end, way]
                }
            };
            let sides = [side(index + count - 1, a, along), side(index + 1, b, -along)];
            fronts.push(FrontArea { from: a, out: -along.perp(), sides });
        }
    }
    fronts
}

impl FrontArea {
    /// Returns the distance (m) to the nearest point of a wall in front of the edge, at most `most`.
    fn distance(&self, [mut a, mut b]: WallEnds, most: f64) -> Option<f64> {
        let near = [self.from + self.out * most, -self.out];
        let behind = [self.from - self.out * APART, self.out];
        for [at, way] in [near, behind, self.sides[0], self.sides[1]] {
            let [from, to] = [a, b].map(|point| way.dot(point - at));
            if from.max(to) <= 0.0 {
                return None;
            }
            if from.min(to) < 0.0 {
                let crossing = a.lerp(b, from / (from - to));
                *(if from < 0.0 { &mut a } else { &mut b }) = crossing;
            }
        }
        let along = self.out.perp();
        let wide = along.dot(b - a).abs() > NARROW;
        wide.then(|| self.out.dot(a - self.from).min(self.out.dot(b - self.from)))
    }
}

/// Returns the start and end (m) along `wall` at which the wall `their` touches it.
fn overlap([a, b]: WallEnds, [c, d]: WallEnds) -> Option<[f64; 2]> {
    let low = a.min(b) - APART;
    let high = a.max(b) + APART;
    if c.max(d).cmplt(low).any() || c.min(d).cmpgt(high).any() {
        return None;
    }
    let (along, back) = ((b - a).try_normalize()?, (c - d).try_normalize()?);
    if along.dot(back) < OPPOSITE {
        return None;
    }
    // The other wall is reversed to run in the same direction: coordinates along this wall and to its left.
    let [from, to] = [d - a, c - a].map(|point| DVec2::new(point.dot(along), along.perp_dot(point)));
    let (mut begin, mut end) = (from.x.max(0.0), to.x.min(a.distance(b)));
    let slope = (to.y - from.y) / (to.x - from.x);
    if slope.abs() > 1e-9 {
        let at = |side: f64| from.x + (side - from.y) / slope;
        let [one, two] = [at(-APART), at(APART)];
        begin = begin.max(one.min(two));
        end = end.min(one.max(two));
    } else if from.y.abs() > APART {
        return None;
    }
    (end - begin > 1e-3).then_some([begin, end])
}

/// Returns the total length (m) covered by `covers`, without counting overlaps twice.
fn union(covers: &[Cover]) -> f64 {
    let mut parts: SmallVec<[[f64; 2]; 8]> = covers.iter().map(|cover| cover.part).collect();
    parts.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let (mut length, mut reached) = (0.0, f64::NEG_INFINITY);
    for [begin, end] in parts {
        if end > reached {
            length += end - begin.max(reached);
            reached = end;
        }
    }
    length
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::object::FootprintOptions;
    use super::*;
    use burgeon_geometry::Rings;

    fn all(rings: &[&[[f64; 2]]]) -> Neighborhood {
        let plan = |ring: &&[[f64; 2]]| {
            let ring = ring.iter().map(|point| DVec3::new(point[0], point[1], 0.0)).collect();
            (Arc::new(Plan::new(&Rings(vec![ring])).unwrap()), DVec2::ZERO)
        };
        let tops = vec![None; rings.len()];
        Neighborhood { plans: rings.iter().map(plan).collect(), tops, map: OnceLock::new() }
    }

    fn rectangle(x: f64, y: f64, width: f64, depth: f64) -> Vec<[f64; 2]> {
        vec![[x, y], [x + width, y], [x + width, y + depth], [x, y + depth]]
    }

    #[test]
    fn walls_that_touch_are_shared_as_far_as_they_overlap() {
        let (a, b) = (rectangle(0.0, 0.0, 10.0, 8.0), rectangle(10.2, 4.0, 10.0, 8.0));
        let alone = rectangle(0.0, 8.5, 4.0, 4.0);
        let all = all(&[&a, &b, &alone]);
        let touch = all.touch(0);
        assert_eq!(touch.neighbors, 1);
        assert_eq!(touch.shared, [0.0, 0.5, 0.0, 0.0]);
        assert_eq!(all.touch(1).shared, [0.0, 0.0, 0.0, 0.5]);
        assert_eq!(all.touch(2), Touch { shared: vec![0.0; 4], ..Touch::default() });
    }

    #[test]
    fn two_neighbours_along_one_wall_cover_it_together_and_once() {
        let long = rectangle(0.0, 0.0, 20.0, 8.0);
        let (left, right) = (rectangle(0.0, 8.0, 12.0, 5.0), rectangle(10.0, 8.1, 8.0, 5.0));
        let touch = all(&[&long, &left, &right]).touch(0);
        assert_eq!(touch.neighbors, 2);
        assert!((touch.shared[2] - 0.9).abs() < 1e-9, "{touch:?}");
    }

    #[test]
    fn outlines_that_are_there_several_times_count_as_often_and_are_compared_once() {
        let (house, beside) = (rectangle(0.0, 0.0, 10.0, 8.0), rectangle(10.0, 0.0, 10.0, 8.0));
        // The rectangle is so thin that each wall touches the opposite wall of an equal rectangle.
        let thin = rectangle(0.0, 50.0, 10.0, 0.2);
        let mut rings: Vec<&[[f64; 2]]> = vec![&house; 500];
        rings.extend([&beside[..], &beside, &thin, &thin, &thin]);
        let mut all = all(&rings);
        let touch = |own: usize| {
            let Touch { shared, neighbors, .. } = all.touch(own);
            (shared, neighbors)
        };
        assert_eq!(touch(0), (vec![0.0, 1.0, 0.0, 0.0], 2));
        assert_eq!(touch(500), (vec![0.0, 0.0, 0.0, 1.0], 500));
        assert_eq!((all.touch(504).neighbors, all.touch(504).shared[0]), (2, 1.0));
        assert_eq!(all.map().owners.len(), 3);
        // Only the second of the adjacent houses is high enough to be in the way.
        assert_eq!(all.reach(0, 1.0, 5.0)[1], 0.0);
        all.tops = vec![Some(3.0); rings.len()];
        all.tops[501] = Some(6.0);
        all.map = OnceLock::new();
        assert_eq!(all.reach(0, 1.0, 5.0)[1], 0.0);
        assert_eq!(all.reach(0, 1.0, 6.0)[1], f64::INFINITY);
        all.tops[503] = Some(6.0);
        all.map = OnceLock::new();
        // A footprint is not in its own way, but in the way of its duplicates.
        assert_eq!([502, 503, 504].map(|own| all.reach(own, 1.0, 5.0)[0]), [0.0, f64::INFINITY, 0.0]);
    }

    #[test]
    fn walls_askew_touch_only_where_they_are_near() {
        let wall = rectangle(0.0, 0.0, 10.0, 8.0);
        // The slope is a twentieth: within 0.3 m along 6 of 10 m.
        let askew = [[0.0, 8.0], [10.0, 8.5], [10.0, 14.0], [0.0, 14.0]];
        let turned = [[0.0, 8.0], [10.0, 10.0], [10.0, 14.0], [0.0, 14.0]];
        let shared = |other: &[[f64; 2]]| all(&[&wall, other]).touch(0).shared[2];
        assert!((shared(&askew) - 0.6).abs() < 1e-6, "{}", shared(&askew));
        assert_eq!(shared(&turned), 0.0);
    }

    #[test]
    fn a_building_that_fills_a_courtyard_touches_its_walls() {
        let point = |&[x, y]: &[f64; 2]| DVec3::new(x, y, 0.0);
        let ring = |ring: Vec<[f64; 2]>| ring.iter().map(point).collect::<Vec<_>>();
        let make = |rings: Vec<Vec<DVec3>>| {
            let options = FootprintOptions { geometry: Rings(rings).into(), ..FootprintOptions::default() };
            Box::new(Footprint::new(options).unwrap()) as Box<dyn Object>
        };
        let outer = make(vec![ring(rectangle(0.0, 0.0, 20.0, 20.0)), ring(rectangle(5.0, 5.0, 10.0, 10.0))]);
        let inner = make(vec![ring(rectangle(5.0, 5.0, 10.0, 10.0))]);
        let mut objects = vec![outer, inner];
        gather(&mut objects);
        let shared = |object: &dyn Object, edge: f64| {
            let any: &dyn std::any::Any = object;
            any.downcast_ref::<Footprint>().unwrap().shared(edge as u32).unwrap()
        };
        assert_eq!((1..=8).map(|edge| shared(&*objects[0], f64::from(edge))).sum::<f64>(), 4.0);
        assert_eq!((1..=4).map(|edge| shared(&*objects[1], f64::from(edge))).sum::<f64>(), 4.0);
    }
}
