//! Assembly of polygons from the member ways of a multipolygon, which form its border together.
//!
//! Method: the segments of the ways form a planar graph. The interior is determined by counting borders (even-odd
//! rule), so the roles of members are ignored. The border of each connected interior part is traversed. If a walk
//! returns to a position, a ring is split off, so rings that touch at points are separated.

use std::borrow::Cow;
use std::cmp::Ordering;

use rustc_hash::FxHashMap;

use super::places::{Place, area};
use burgeon_base::budget::Budget;

/// Rings of a polygon: the outer ring, then its holes, without repeating the first position at the end.
pub(super) type PolygonRings = Vec<Vec<Place>>;

/// Assembles the polygons whose border is `ways`. Fails with the reason.
pub(super) fn assemble<'w>(
    ways: impl Iterator<Item = &'w [Place]>,
    budget: &Budget,
) -> Result<Vec<PolygonRings>, Cow<'static, str>> {
    let graph = Graph::new(ways, budget)?;
    graph.refuse_crossing(budget)?;
    let walks = graph.walks();
    let inside = graph.find_inner_sides(&walks, budget)?;
    graph.polygons(&walks, &inside, budget)
}

/// Returns the polygons of a closed way: one, or several if the way passes through a position twice. The last position
/// equals the first.
pub(super) fn of_way(places: &[Place], budget: &Budget) -> Result<Vec<PolygonRings>, Cow<'static, str>> {
    let mut ring = places.to_vec();
    ring.dedup();
    ring.pop();
    let mut sorted = ring.clone();
    sorted.sort_unstable();
    if sorted.windows(2).any(|pair| pair[0] == pair[1]) {
        return assemble(std::iter::once(places), budget);
    }
    if ring.len() < 3 || area(&ring) == 0 {
        return Err("has no area".into());
    }
    Ok(vec![vec![ring]])
}

/// Positions and segments of a border. The half-edge `2 * s` leads along the segment `s`, and `2 * s + 1` leads back.
struct Graph {
    places: Vec<Place>,
    /// Index of the start position of each half-edge.
    from: Vec<usize>,
    /// Next half-edge along the face to the left of each half-edge.
    next: Vec<usize>,
}

fn tick(budget: &Budget) -> Result<(), Cow<'static, str>> {
    budget.tick().map_err(|error| error.into_message().into())
}

fn place_text(place: Place) -> String {
    let at = place.degrees();
    format!("{}, {}", at.x, at.y)
}

impl Graph {
    fn new<'w>(ways: impl Iterator<Item = &'w [Place]>, budget: &Budget) -> Result<Self, Cow<'static, str>> {
        let mut segments: Vec<[Place; 2]> = Vec::new();
        for way in ways {
            budget.take(way.len() * 150).map_err(|error| error.into_message())?;
            let pairs = way.windows(2).filter(|pair| pair[0] != pair[1]);
            segments.extend(pairs.map(|pair| [pair[0].min(pair[1]), pair[0].max(pair[1])]));
        }
        segments.sort_unstable();
        // Two borders that coincide cancel out.
        let mut single: Vec<[Place; 2]> = Vec::with_capacity(segments.len());
        for segment in segments {
            match single.last() {
                Some(last) if *last == segment => drop(single.pop()),
                _ => single.push(segment),
            }
        }
        if single.is_empty() {
            return Err("has no area".into());
        }
        let mut places: Vec<Place> = single.iter().flatten().copied().collect();
        places.sort_unstable();
        places.dedup();
        let number = |place: &Place| places.binary_search(place).unwrap_or_default();
        let from: Vec<usize> = single.iter().flatten().map(number).collect();
        let mut graph = Self { places, next: vec![0; from.len()], from };
        graph.connect()?;
        Ok(graph)
    }

    fn place(&self, edge: usize) -> Place {
        self.places[self.from[edge]]
    }

    fn ends(&self, segment: usize) -> [Place; 2] {
        [self.place(2 * segment), self.place(2 * segment + 1)]
    }

    /// Computes the successor of each half-edge. Fails if a border ends.
    fn connect(&mut self) -> Result<(), Cow<'static, str>> {
        let mut around: Vec<usize> = (0..self.from.len()).collect();
        around.sort_unstable_by(|a, b| {
            self.from[*a].cmp(&self.from[*b]).then_with(|| {
                let centre = self.place(*a);
                by_angle(centre.to(self.place(a ^ 1)), centre.to(self.place(b ^ 1)))
            })
        });
        let mut rest = &around[..];
        while let Some(first) = rest.first() {
            let from = self.from[*first];
            let count = rest.iter().take_while(|edge| self.from[**edge] == from).count();
            let (here, after) = rest.split_at(count);
            if !count.is_multiple_of(2) {
                return Err(
                    format!("has an open boundary, which ends at {}", place_text(self.places[from])).into()
                );
            }
            // A walk leaves a position by the next half-edge to the right, so the face to its left stays the same.
            for (at, edge) in here.iter().enumerate() {
                self.next[edge ^ 1] = here[(at + count - 1) % count];
            }
            rest = after;
        }
        Ok(())
    }

    /// Fails if segments cross or overlap.
    fn refuse_crossing(&self, budget: &Budget) -> Result<(), Cow<'static, str>> {
        // Segments are sorted by their western ends.
        let segments: Vec<[Place; 2]> = (0..self.from.len() / 2).map(|at| self.ends(at)).collect();
        for (at, [a, b]) in segments.iter().enumerate() {
            let (low, high) = (a.0[1].min(b.0[1]), a.0[1].max(b.0[1]));
            for [c, d] in segments[at + 1..].iter().take_while(|[c, _]| c.0[0] <= b.0[0]) {
                tick(budget)?;
                if c.0[1].max(d.0[1]) < low || c.0[1].min(d.0[1]) > high {
                    continue;
                }
                let sides =
                    [a.turn(*b, *c), a.turn(*b, *d), c.turn(*d, *a), c.turn(*d, *b)].map(i128::signum);
                let crosses = sides[0] * sides[1] < 0 && sides[2] * sides[3] < 0;
                // Collinear segments overlap if each begins before the other one ends.
                let along = sides == [0; 4] && a.max(c) < b.min(d);
                if crosses || along {
                    return Err(format!("has boundaries that cross near {}", place_text(*c)).into());
                }
            }
        }
        Ok(())
    }

    /// Returns the walks along the faces; each walk has one face to its left.
    fn walks(&self) -> Walks {
        let mut walks = Walks { begins: Vec::new(), of: vec![usize::MAX; self.next.len()] };
        for begin in 0..self.next.len() {
            if walks.of[begin] == usize::MAX {
                self.walk(begin).for_each(|edge| walks.of[edge] = walks.begins.len());
                walks.begins.push(begin);
            }
        }
        walks
    }

    /// Returns the half-edges of the walk that begins with a half-edge.
    fn walk(&self, begin: usize) -> impl Iterator<Item = usize> {
        let mut next = Some(begin);
        std::iter::from_fn(move || {
            let edge = next?;
            next = Some(self.next[edge]).filter(|edge| *edge != begin);
            Some(edge)
        })
    }

    /// Returns for each walk whether the interior is to its left, and its component.
    fn find_inner_sides(&self, walks: &Walks, budget: &Budget) -> Result<Vec<WalkSide>, Cow<'static, str>> {
        let mut sides: Vec<Option<WalkSide>> = vec![None; walks.begins.len()];
        for first in 0..walks.begins.len() {
            if sides[first].is_some() {
                continue;
            }
            // Crossing a border changes between interior and exterior; at first it is unknown which is which.
            let component = first;
            let mut members = Vec::new();
            let mut stack = vec![(first, false)];
            while let Some((walk, is_inside)) = stack.pop() {
                if sides[walk].is_some() {
                    continue;
                }
                sides[walk] = Some(WalkSide { is_inside, component });
                members.push(walk);
                for edge in self.walk(walks.begins[walk]) {
                    tick(budget)?;
                    let beyond = walks.of[edge ^ 1];
                    if sides[beyond].is_none() {
                        stack.push((beyond, !is_inside));
                    }
                }
            }
            // The exterior of the component is to the left of its only clockwise walk.
            let around = |walk: &usize| {
                let ring: Vec<Place> = self.walk(walks.begins[*walk]).map(|edge| self.place(edge)).collect();
                area(&ring)
            };
            let outer = members.iter().copied().min_by_key(around).unwrap_or(first);
            let at = self.place(walks.begins[first]);
            let mut odd = false;
            for segment in 0..self.from.len() / 2 {
                tick(budget)?;
                let own = sides[walks.of[2 * segment]].is_some_and(|side| side.component == component);
                let [a, b] = self.ends(segment);
                odd ^= !own && at.sees(a, b);
            }
            let wrong = sides[outer].is_some_and(|side| side.is_inside) != odd;
            for walk in members {
                if let Some(side) = &mut sides[walk] {
                    side.is_inside ^= wrong;
                }
            }
        }
        Ok(sides.into_iter().flatten().collect())
    }

    /// Returns the polygons bounded by the walks with the interior to their left.
    fn polygons(
        &self,
        walks: &Walks,
        sides: &[WalkSide],
        budget: &Budget,
    ) -> Result<Vec<PolygonRings>, Cow<'static, str>> {
        let (mut polygons, mut loose): (Vec<PolygonRings>, Vec<Vec<Place>>) = (Vec::new(), Vec::new());
        for (begin, side) in walks.begins.iter().zip(sides) {
            tick(budget)?;
            if !side.is_inside {
                continue;
            }
            let (outer, holes): (Vec<_>, Vec<_>) = self
                .rings(*begin)
                .into_iter()
                .filter(|ring| area(ring) != 0)
                .partition(|ring| area(ring) > 0);
            let mut outer = outer.into_iter();
            match outer.next() {
                Some(first) => {
                    polygons.push(std::iter::once(first).chain(holes).collect());
                    polygons.extend(outer.map(|ring| vec![ring]));
                }
                None => loose.extend(holes),
            }
        }
        let sizes: Vec<i128> = polygons.iter().map(|polygon| area(&polygon[0])).collect();
        for hole in loose {
            let at = hole[0];
            let mut around: Option<usize> = None;
            for (index, polygon) in polygons.iter().enumerate() {
                tick(budget)?;
                let ring = &polygon[0];
                let pairs = ring.iter().zip(ring.iter().cycle().skip(1));
                let is_in = pairs.filter(|(a, b)| at.sees(**a, **b)).count() % 2 == 1;
                if is_in && around.is_none_or(|best| sizes[index] < sizes[best]) {
                    around = Some(index);
                }
            }
            match around {
                Some(index) => polygons[index].push(hole),
                None => return Err(format!("has a hole outside its area, at {}", place_text(at)).into()),
            }
        }
        if polygons.is_empty() { Err("has no area".into()) } else { Ok(polygons) }
    }

    /// Returns the rings of a walk; no ring passes through a position twice.
    fn rings(&self, begin: usize) -> Vec<Vec<Place>> {
        let mut rings = Vec::new();
        let mut path: Vec<Place> = Vec::new();
        let mut positions: FxHashMap<usize, usize> = FxHashMap::default();
        let mut visited: Vec<usize> = Vec::new();
        for edge in self.walk(begin) {
            let number = self.from[edge];
            if let Some(position) = positions.get(&number).copied() {
                rings.push(path.split_off(position));
                for gone in visited.drain(position..) {
                    positions.remove(&gone);
                }
            }
            positions.insert(number, path.len());
            visited.push(number);
            path.push(self.place(edge));
        }
        rings.push(path);
        rings
    }
}

/// Walks along the faces of the plane.
struct Walks {
    /// First half-edge of each walk.
    begins: Vec<usize>,
    /// Walk of each half-edge.
    of: Vec<usize>,
}

/// Face to the left of a walk.
#[derive(Clone, Copy)]
struct WalkSide {
    is_inside: bool,
    /// Index of the connected component of the border.
    component: usize,
}

/// Compares directions counter-clockwise, starting from the west.
fn by_angle(a: [i128; 2], b: [i128; 2]) -> Ordering {
    let half = |[x, y]: [i128; 2]| y > 0 || (y == 0 && x > 0);
    half(a).cmp(&half(b)).then_with(|| (b[0] * a[1] - b[1] * a[0]).cmp(&0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ways(ways: &[&[[i64; 2]]]) -> Vec<Vec<Place>> {
        ways.iter().map(|way| way.iter().map(|at| Place(*at)).collect()).collect()
    }

    /// Returns twice the areas of the rings of each polygon.
    fn areas(given: &[&[[i64; 2]]]) -> Result<Vec<Vec<i128>>, String> {
        let given = ways(given);
        let made = assemble(given.iter().map(Vec::as_slice), &Budget::default())?;
        Ok(made.iter().map(|polygon| polygon.iter().map(|ring| area(ring)).collect()).collect())
    }

    const SQUARE: &[[i64; 2]] = &[[0, 0], [10, 0], [10, 10], [0, 10], [0, 0]];

    #[test]
    fn rings_are_chained_from_ways_in_any_order_and_direction() {
        let parts: &[&[[i64; 2]]] =
            &[&[[10, 10], [10, 0]], &[[0, 0], [0, 10], [10, 10]], &[[10, 0], [5, 0], [0, 0]]];
        assert_eq!(areas(parts), Ok(vec![vec![200]]));
    }

    #[test]
    fn holes_islands_in_holes_and_rings_that_touch_are_told_apart() {
        let hole: &[[i64; 2]] = &[[2, 2], [8, 2], [8, 8], [2, 8], [2, 2]];
        let island: &[[i64; 2]] = &[[4, 4], [6, 4], [6, 6], [4, 6], [4, 4]];
        assert_eq!(areas(&[SQUARE, hole]), Ok(vec![vec![200, -72]]));
        assert_eq!(areas(&[island, hole, SQUARE]), Ok(vec![vec![200, -72], vec![8]]));
        // A hole that touches the outer ring at a point, and two holes that touch each other.
        let touching: &[[i64; 2]] = &[[0, 0], [4, 2], [2, 4], [0, 0]];
        assert_eq!(areas(&[SQUARE, touching]), Ok(vec![vec![200, -12]]));
        let second: &[[i64; 2]] = &[[8, 8], [9, 8], [8, 9], [8, 8]];
        assert_eq!(areas(&[SQUARE, hole, second]), Ok(vec![vec![200, -1, -72]]));
        // Two holes that share a border are merged.
        let left: &[[i64; 2]] = &[[2, 2], [5, 2], [5, 8], [2, 8], [2, 2]];
        let right: &[[i64; 2]] = &[[5, 2], [8, 2], [8, 8], [5, 8], [5, 2]];
        assert_eq!(areas(&[SQUARE, left, right]), Ok(vec![vec![200, -72]]));
        // A hole that touches the outer ring at two points divides the polygon.
        let across: &[[i64; 2]] = &[[0, 0], [6, 4], [10, 10], [4, 6], [0, 0]];
        assert_eq!(areas(&[SQUARE, across]), Ok(vec![vec![80], vec![80]]));
        // Two squares that touch at a point.
        let other: &[[i64; 2]] = &[[10, 10], [12, 10], [12, 12], [10, 12], [10, 10]];
        assert_eq!(areas(&[SQUARE, other]), Ok(vec![vec![200], vec![8]]));
    }

    #[test]
    fn what_is_no_border_is_refused_with_the_place() {
        let open: &[[i64; 2]] = &[[0, 0], [10, 0], [10, 10]];
        assert_eq!(areas(&[open]).unwrap_err(), "has an open boundary, which ends at 0, 0");
        let crossing: &[[i64; 2]] = &[[5, 5], [15, 5], [15, 15], [5, 15], [5, 5]];
        assert!(areas(&[SQUARE, crossing]).unwrap_err().starts_with("has boundaries that cross near "));
        let along: &[[i64; 2]] = &[[0, 0], [5, 0], [5, -5], [0, -5], [0, 0]];
        assert!(areas(&[SQUARE, along]).unwrap_err().starts_with("has boundaries that cross near "));
        for nothing in [&[] as &[[i64; 2]], &[[1, 1]], &[[1, 1], [1, 1]], &[[0, 0], [1, 0], [0, 0]]] {
            assert_eq!(areas(&[nothing]).unwrap_err(), "has no area");
        }
        assert_eq!(areas(&[SQUARE, SQUARE]).unwrap_err(), "has no area");
    }

    #[test]
    fn a_way_that_comes_to_a_place_again_becomes_several() {
        let of = |places: &[[i64; 2]]| {
            let places: Vec<Place> = places.iter().map(|at| Place(*at)).collect();
            of_way(&places, &Budget::default()).map(|made| made.len())
        };
        assert_eq!(of(SQUARE), Ok(1));
        assert_eq!(of(&[[0, 0], [2, 0], [4, 4], [6, 4], [4, 6], [4, 4], [0, 2], [0, 0]]), Ok(2));
        assert_eq!(of(&[[0, 0], [1, 0], [2, 0], [0, 0]]).unwrap_err(), "has no area");
    }
}
