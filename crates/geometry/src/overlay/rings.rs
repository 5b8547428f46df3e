//! Conversion of the selected areas of a subdivision to valid polygons.
//!
//! Method: the border of the selection is walked so that at every node the next edge bounds the same face of
//! the inside; a walk that returns to a node is split there. So rings neither cross nor touch themselves,
//! areas that are connected only by a point become several polygons, and a hole that touches the outer ring
//! stays a hole. A walk without an outer ring belongs to the polygon whose border lies below its leftmost
//! node.

use glam::DVec2;

use super::noding::SHARED;
use super::predicates::side;
use super::subdivision::Subdivision;
use crate::planar::Rings;

const NONE: u32 = u32::MAX;

/// Edges of a border, directed from right to left if the inside is below them.
struct BorderWalks<'a> {
    of: &'a Subdivision,
    /// Side of the inside, by edge: 1 if only above, -1 if only below, otherwise 0.
    sides: Vec<i8>,
    /// Next edge of each edge of the border.
    next: Vec<u32>,
    /// Number of border edges at each node.
    degrees: Vec<u32>,
}

/// A walk along a border: its outer ring, if any, and its holes.
#[derive(Default)]
struct RingWalk {
    outer: Option<Vec<u32>>,
    holes: Vec<Vec<u32>>,
    /// First edge of the walk: it begins at the leftmost node, below the others there.
    least: u32,
}

impl Subdivision {
    /// Returns the polygons of the faces for whose winding numbers by layer `keep` returns true.
    ///
    /// The area outside all rings is never included. Outer rings are counter-clockwise and holes are
    /// clockwise.
    ///
    /// ```
    /// use burgeon_geometry::overlay::{LayerWay, Subdivision, WayKind};
    /// use glam::DVec2;
    ///
    /// let square = |at: f64| {
    ///     let ring = [(at, at), (at + 2.0, at), (at + 2.0, at + 2.0), (at, at + 2.0)];
    ///     LayerWay { layer: 0, kind: WayKind::Ring, places: ring.map(DVec2::from).to_vec() }
    /// };
    /// let plane = Subdivision::new(&[square(0.0), square(1.0)])?;
    /// let covered_twice = plane.areas(|[count, _]| count == 2);
    /// assert_eq!((covered_twice.len(), plane.areas(|[count, _]| count == 1).len()), (1, 2));
    /// assert!(covered_twice[0][0].contains(&DVec2::new(2.0, 1.0)));
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn areas(&self, keep: impl Fn([i32; 2]) -> bool) -> Vec<Rings<DVec2>> {
        let sides: Vec<i8> = self
            .edges
            .iter()
            .map(|edge| match [keep(edge.above), keep(edge.below)] {
                [true, false] => 1,
                [false, true] => -1,
                _ => 0,
            })
            .collect();
        let mut border = BorderWalks {
            of: self,
            sides,
            next: vec![NONE; self.edges.len()],
            degrees: vec![0; self.places.len()],
        };
        border.link();
        let walks = border.walks();
        border.polygons(walks)
    }
}

impl BorderWalks<'_> {
    /// Finds the next edge of each edge.
    fn link(&mut self) {
        let mut star: Vec<(u32, bool)> = Vec::new();
        for (node, around) in self.of.stars() {
            star.clear();
            star.extend(around.iter().filter(|(edge, _)| self.sides[*edge as usize] != 0));
            self.degrees[node as usize] = star.len() as u32;
            for (index, (edge, is_right)) in star.iter().enumerate() {
                // The inside is above an edge that is walked from its left end.
                if *is_right == (self.sides[*edge as usize] > 0) {
                    self.next[*edge as usize] = star[(index + star.len() - 1) % star.len()].0;
                }
            }
        }
    }

    /// Returns the node at which an edge begins along the walk.
    fn begin(&self, edge: u32) -> u32 {
        self.of.edges[edge as usize].ends[usize::from(self.sides[edge as usize] < 0)]
    }

    /// Walks along the border, beginning with the first edges in sweep order.
    fn walks(&self) -> Vec<RingWalk> {
        let mut walks = Vec::new();
        let mut done = vec![false; self.sides.len()];
        // Position of each node in the current walk.
        let mut places: Vec<u32> = vec![NONE; self.of.places.len()];
        let mut walk: Vec<u32> = Vec::new();
        for least in 0..self.sides.len() as u32 {
            if self.sides[least as usize] == 0 || done[least as usize] {
                continue;
            }
            let mut made = RingWalk { least, ..RingWalk::default() };
            let mut edge = least;
            while !done[edge as usize] {
                done[edge as usize] = true;
                let node = self.begin(edge);
                let before = places[node as usize];
                if before != NONE {
                    let ring: Vec<u32> = walk.drain(before as usize..).collect();
                    ring.iter().for_each(|edge| places[self.begin(*edge) as usize] = NONE);
                    self.note(&mut made, ring);
                }
                places[node as usize] = walk.len() as u32;
                walk.push(edge);
                edge = self.next[edge as usize];
            }
            walk.iter().for_each(|edge| places[self.begin(*edge) as usize] = NONE);
            let ring = std::mem::take(&mut walk);
            self.note(&mut made, ring);
            walks.push(made);
        }
        walks
    }

    /// Adds a ring to a walk.
    fn note(&self, walk: &mut RingWalk, ring: Vec<u32>) {
        let place = |edge: u32| self.of.places[self.begin(edge) as usize];
        let before = |one: DVec2, two: DVec2| one.x < two.x || one.x == two.x && one.y < two.y;
        let least = (0..ring.len())
            .reduce(|best, at| if before(place(ring[at]), place(ring[best])) { at } else { best })
            .unwrap_or(0);
        let count = ring.len();
        let [last, corner, next] =
            [least + count - 1, least, least + 1].map(|index| place(ring[index % count]));
        if side(last, corner, next) > 0.0 && walk.outer.is_none() {
            walk.outer = Some(ring);
        } else {
            walk.holes.push(ring);
        }
    }

    /// Assembles the polygons of walks: walks without an outer ring are holes of others.
    fn polygons(&self, walks: Vec<RingWalk>) -> Vec<Rings<DVec2>> {
        // Nearest border edge below each edge.
        let mut under: Vec<u32> = Vec::with_capacity(self.sides.len());
        for edge in &self.of.edges {
            let found = edge.under.map_or(NONE, |below| {
                if self.sides[below as usize] != 0 { below } else { under[below as usize] }
            });
            under.push(found);
        }
        // Polygon of each edge.
        let mut owners: Vec<u32> = vec![NONE; self.sides.len()];
        let mut polygons: Vec<Vec<Vec<u32>>> = Vec::new();
        // Walks are sorted by their first edges, so the walk below a walk comes earlier.
        for RingWalk { outer, holes, least } in walks {
            let below = under[least as usize];
            let polygon = if outer.is_some() {
                polygons.push(Vec::new());
                polygons.len() as u32 - 1
            } else if below != NONE {
                owners[below as usize]
            } else {
                NONE
            };
            for ring in outer.into_iter().chain(holes) {
                ring.iter().for_each(|edge| owners[*edge as usize] = polygon);
                if let Some(rings) = polygons.get_mut(polygon as usize) {
                    rings.push(ring);
                }
            }
        }
        polygons.iter().map(|rings| rings.iter().map(|ring| self.ring(ring)).collect()).collect()
    }

    /// Returns the points of a ring, beginning with the first input point. Collinear points that are not
    /// points of the input ring at that position are dropped.
    fn ring(&self, edges: &[u32]) -> Vec<DVec2> {
        let count = edges.len();
        let is_corner = |index: &usize| {
            let (last, next) = (edges[(index + count - 1) % count], edges[*index]);
            let node = self.begin(next);
            if self.degrees[node as usize] > 2 {
                return true;
            }
            let [one, two] = [last, next].map(|edge| self.of.edges[edge as usize].source);
            let owner = self.of.owners[node as usize];
            if one == two && one != SHARED && (owner == Some(one) || owner == Some(SHARED)) {
                return true;
            }
            let place = |edge: u32| self.of.places[self.begin(edge) as usize];
            side(place(last), place(next), place(edges[(index + 1) % count])) != 0.0
        };
        let mut nodes: Vec<u32> =
            (0..count).filter(is_corner).map(|index| self.begin(edges[index])).collect();
        let first = (0..nodes.len()).min_by_key(|index| nodes[*index]).unwrap_or(0);
        nodes.rotate_left(first);
        nodes.into_iter().map(|node| self.of.places[node as usize]).collect()
    }
}
