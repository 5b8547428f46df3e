//! Heights over the plan of a mapped roof: flat facets of a triangulate_constrained triangulation.

use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;

use super::map_nodes::MapNodes;
use crate::planar::{contains, distance, triangulate_constrained, twice_area};
use crate::roof::field::HeightPlane;
use burgeon_base::error::{Error, Result};
use burgeon_base::work::WorkLimits;

/// Difference (m) up to which the corners of neighbouring triangles are in one plane.
const FLAT: f64 = 1e-3;
/// Width (m) below which a triangle has the plane of a neighbour.
const NARROW: f64 = 1e-6;

/// Flat facets over a plan; beyond the outline, the facets along it continue.
#[derive(Debug, Clone)]
pub(in crate::roof) struct MappedSurface {
    places: Vec<DVec2>,
    triangles: Vec<[usize; 3]>,
    /// Plane of each triangle.
    facets: Vec<usize>,
    /// Edges of the outline between nodes, in order, each with its plane and the following edge.
    border: Vec<BorderEdge>,
    /// Directions in which the border between two planes continues outwards, by the node where it begins.
    rays: Vec<Option<DVec2>>,
    /// Area (m²) of level triangles at the eaves.
    pub(in crate::roof) level: f64,
}

/// An edge of the outline.
#[derive(Debug, Clone, Copy)]
struct BorderEdge {
    ends: [usize; 2],
    plane: usize,
    previous: usize,
    next: usize,
}

impl MappedSurface {
    /// Creates the facets, and their planes. Fails if the outline cannot be triangulated, or the work of this thread is
    /// cancelled.
    pub(in crate::roof) fn new(nodes: &MapNodes) -> Result<(Self, Vec<HeightPlane>)> {
        let MapNodes { places, heights, segments, border, .. } = nodes;
        let outline: Vec<[usize; 2]> =
            border.iter().flat_map(|edge| edge.windows(2)).map(|pair| [pair[0], pair[1]]).collect();
        let mut triangles = triangulate_constrained(places, &outline, segments).ok_or_else(|| {
            Error::geometry("the lines of the roof and the outline of the plan are too near to one another")
                .help("move the points of the lines away from the outline, or exactly onto it")
        })?;
        raise_level(&mut triangles, places, heights, &outline, segments);
        let limits = WorkLimits::current();
        let corners = |triangle: [usize; 3]| triangle.map(|node| places[node].extend(heights[node]));
        let sides = sides_of(&triangles);
        let mut order: Vec<usize> = (0..triangles.len()).collect();
        let area = |index: &usize| twice_area(triangles[*index].map(|node| places[node]));
        order.sort_by(|one, two| area(two).total_cmp(&area(one)).then(one.cmp(two)));
        let mut facets = vec![usize::MAX; triangles.len()];
        let mut planes: Vec<HeightPlane> = Vec::new();
        for seed in order {
            if facets[seed] != usize::MAX {
                continue;
            }
            limits.check()?;
            let plane = plane_of(corners(triangles[seed]));
            let mut pending = vec![seed];
            while let Some(triangle) = pending.pop() {
                if facets[triangle] != usize::MAX {
                    continue;
                }
                facets[triangle] = planes.len();
                let [a, b, c] = triangles[triangle];
                for side in [[b, a], [c, b], [a, c]] {
                    let Some(&next) = sides.get(&side) else { continue };
                    let is_flat = corners(triangles[next])
                        .iter()
                        .all(|at| (plane.height_at(at.truncate()) - at.z).abs() < FLAT);
                    if facets[next] == usize::MAX && is_flat {
                        pending.push(next);
                    }
                }
            }
            planes.push(plane);
        }
        let level = triangles
            .iter()
            .zip(0..)
            .filter(|(triangle, _)| triangle.iter().all(|node| heights[*node] == 0.0));
        let level = level.map(|(_, index)| area(&index) / 2.0).sum();
        let mut surface = Self {
            places: places.clone(),
            border: border_edges(nodes, &sides, &facets),
            rays: vec![None; places.len()],
            triangles,
            facets,
            level,
        };
        surface.continue_outwards(&planes);
        Ok((surface, planes))
    }

    /// Computes the directions in which borders between planes continue beyond the outline.
    fn continue_outwards(&mut self, planes: &[HeightPlane]) {
        for edge in &self.border {
            let before = &self.border[edge.previous];
            if before.plane == edge.plane {
                continue;
            }
            let [from, at] = before.ends.map(|node| self.places[node]);
            let way = |[a, b]: [DVec2; 2]| (b - a).normalize_or_zero();
            let outward = |way: DVec2| -way.perp();
            let ways = [way([from, at]), way(edge.ends.map(|node| self.places[node]))];
            let mut out = (outward(ways[0]) + outward(ways[1])).normalize_or(ways[0]);
            let bend = planes[before.plane].gradient - planes[edge.plane].gradient;
            let line = bend.perp().normalize_or_zero();
            let line = if line.dot(out) < 0.0 { -line } else { line };
            // Planes that meet in a line along an edge of the outline have a step between them beyond it.
            if line.dot(outward(ways[0])) > 0.05 && line.dot(outward(ways[1])) > 0.05 {
                out = line;
            }
            self.rays[edge.ends[0]] = Some(out);
        }
    }

    /// Returns the index of the plane at a place.
    pub(in crate::roof) fn index(&self, place: DVec2) -> usize {
        let corners = |triangle: &[usize; 3]| triangle.map(|node| self.places[node]);
        if let Some(triangle) = self.triangles.iter().position(|triangle| contains(&corners(triangle), place))
        {
            return self.facets[triangle];
        }
        let off = |edge: &BorderEdge| distance(edge.ends.map(|node| self.places[node]), place);
        let nearest = self.border.iter().min_by(|one, two| off(one).total_cmp(&off(two)));
        let Some(edge) = nearest else { return 0 };
        let side = |node: usize| self.rays[node].map_or(0.0, |ray| ray.perp_dot(place - self.places[node]));
        if side(edge.ends[0]) < 0.0 {
            self.border[edge.previous].plane
        } else if side(edge.ends[1]) > 0.0 {
            self.border[edge.next].plane
        } else {
            edge.plane
        }
    }

    /// Returns the lines between planes; beyond the outline up to a distance (m).
    pub(in crate::roof) fn lines(&self, reach: f64) -> Vec<Vec<DVec2>> {
        let sides = sides_of(&self.triangles);
        let mut lines: Vec<Vec<DVec2>> = Vec::new();
        for (index, &[a, b, c]) in self.triangles.iter().enumerate() {
            for [from, to] in [[a, b], [b, c], [c, a]] {
                let other = sides.get(&[to, from]);
                if other.is_some_and(|other| from < to && self.facets[*other] != self.facets[index]) {
                    lines.push([from, to].map(|node| self.places[node]).to_vec());
                }
            }
        }
        let rays = self.rays.iter().zip(&self.places);
        lines.extend(rays.filter_map(|(ray, at)| ray.map(|ray| vec![*at, *at + ray * reach])));
        lines
    }
}

/// Returns the triangle to the left of each directed side.
fn sides_of(triangles: &[[usize; 3]]) -> FxHashMap<[usize; 2], usize> {
    let sides =
        |(index, &[a, b, c]): (usize, &[usize; 3])| [([a, b], index), ([b, c], index), ([c, a], index)];
    triangles.iter().enumerate().flat_map(sides).collect()
}

/// Returns the edges of the outline with their planes.
fn border_edges(nodes: &MapNodes, sides: &FxHashMap<[usize; 2], usize>, facets: &[usize]) -> Vec<BorderEdge> {
    let mut edges: Vec<BorderEdge> = Vec::new();
    let mut first = 0;
    for line in &nodes.border {
        for pair in line.windows(2) {
            let ends = [pair[0], pair[1]];
            let plane = sides.get(&ends).map_or(0, |triangle| facets[*triangle]);
            let index = edges.len();
            edges.push(BorderEdge { ends, plane, previous: index.saturating_sub(1), next: index + 1 });
        }
        // The ring ends where it began.
        let last = edges.len().saturating_sub(1);
        if edges.get(first).zip(edges.get(last)).is_some_and(|(begin, end)| begin.ends[0] == end.ends[1]) {
            edges[first].previous = last;
            edges[last].next = first;
            first = edges.len();
        }
    }
    edges
}

/// Returns the plane through three corners (m).
fn plane_of([a, b, c]: [DVec3; 3]) -> HeightPlane {
    let normal = (b - a).cross(c - a);
    let longest = [a - b, b - c, c - a].map(|side| side.truncate().length()).into_iter().fold(0.0, f64::max);
    let gradient = if normal.z > NARROW * longest { -normal.truncate() / normal.z } else { DVec2::ZERO };
    HeightPlane { at: a.truncate(), height: a.z, gradient }
}

/// Flips edges so that fewer triangles are level at the eaves.
fn raise_level(
    triangles: &mut [[usize; 3]],
    places: &[DVec2],
    heights: &[f64],
    outline: &[[usize; 2]],
    segments: &[[usize; 2]],
) {
    let mut fixed: Vec<[usize; 2]> =
        outline.iter().chain(segments).map(|[a, b]| [*a.min(b), *a.max(b)]).collect();
    fixed.sort_unstable();
    let is_level = |triangle: &[usize; 3]| triangle.iter().all(|node| heights[*node] == 0.0);
    let mut sides = sides_of(triangles);
    // Each flip leaves one level triangle less.
    for _ in 0..triangles.len() {
        let mut flipped = false;
        for index in 0..triangles.len() {
            let [a, b, c] = triangles[index];
            if !is_level(&triangles[index]) {
                continue;
            }
            for [from, to, tip] in [[a, b, c], [b, c, a], [c, a, b]] {
                if fixed.binary_search(&[from.min(to), from.max(to)]).is_ok() {
                    continue;
                }
                let Some(&other) = sides.get(&[to, from]) else { continue };
                let Some(far) = triangles[other].into_iter().find(|node| *node != from && *node != to) else {
                    continue;
                };
                let pair = [[from, far, tip], [far, to, tip]];
                let is_wide = |triangle: &[usize; 3]| {
                    let [a, b, c] = triangle.map(|node| places[node]);
                    let longest = [a - b, b - c, c - a].map(DVec2::length).into_iter().fold(0.0, f64::max);
                    twice_area([a, b, c]) > 0.02 * longest
                };
                if heights[far] > 0.0 && pair.iter().all(is_wide) {
                    (triangles[index], triangles[other]) = (pair[0], pair[1]);
                    for (triangle, [a, b, c]) in [(index, pair[0]), (other, pair[1])] {
                        [[a, b], [b, c], [c, a]].into_iter().for_each(|side| {
                            sides.insert(side, triangle);
                        });
                    }
                    sides.remove(&[from, to]);
                    sides.remove(&[to, from]);
                    flipped = true;
                    break;
                }
            }
        }
        if !flipped {
            break;
        }
    }
}
