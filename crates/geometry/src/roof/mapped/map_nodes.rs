//! Points and segments of a mapped roof: the corners of the plan, and lines that neither cross nor leave it.

use geo::kernels::Orientation;
use glam::{DVec2, DVec3};

use super::roof_map::{MapLineKind, MapProblem, RoofMap, UnusedLine};
use crate::planar::{Polygon, distance, foot, orientation};
use crate::roof::Rise;
use burgeon_base::error::Result;
use burgeon_base::work::WorkLimits;

/// Distance (m) within which points of lines are at one place, or on the outline.
const SNAP: f64 = 0.05;
/// Difference (m) below which heights at one place are equal.
const SAME: f64 = 0.01;

/// Position of a node relative to the outline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum OutlineAnchor {
    /// A corner of the outline.
    Corner,
    /// On an edge of the outline, by its number.
    Edge(usize),
    /// Inside the outline.
    Inside,
}

/// A line of the map as nodes.
#[derive(Debug, Clone)]
struct NodeChain {
    kind: MapLineKind,
    number: usize,
    nodes: Vec<usize>,
}

/// Nodes of a plan and of the lines on it.
#[derive(Debug, Clone)]
pub(in crate::roof) struct MapNodes {
    /// Places (m): first the corners of the plan, in their order.
    pub(super) places: Vec<DVec2>,
    pub(super) anchors: Vec<OutlineAnchor>,
    /// Heights (m) above the eaves.
    pub(super) heights: Vec<f64>,
    /// Segments between nodes.
    pub(super) segments: Vec<[usize; 2]>,
    /// Nodes of each edge of the outline, with both ends.
    pub(super) border: Vec<Vec<usize>>,
    /// Lines that are not used as they are given.
    pub(in crate::roof) unused: Vec<UnusedLine>,
}

impl MapNodes {
    /// Places the lines of a map on a plan, with the height of the roof where they have none. Fails if the work of this thread
    /// is cancelled.
    pub(in crate::roof) fn new(map: &RoofMap, walls: &Polygon, rise: Rise) -> Result<Self> {
        let mut placing = Placing::new(walls);
        let lines = map.ridges.iter().map(|line| (MapLineKind::Ridge, line));
        let lines = lines.chain(map.edges.iter().map(|line| (MapLineKind::Edge, line)));
        let mut count = [0; 2];
        for (kind, line) in lines {
            let number = &mut count[usize::from(kind == MapLineKind::Edge)];
            *number += 1;
            placing.limits.check()?;
            if let Err((at, problem)) = placing.add_line(kind, *number, line) {
                placing.unused.push(UnusedLine { kind, number: *number, at, problem });
            }
        }
        for (number, apex) in (1..).zip(&map.apexes) {
            if let Err((at, problem)) = placing.add_apex(number, *apex) {
                placing.unused.push(UnusedLine { kind: MapLineKind::Apex, number, at, problem });
            }
        }
        placing.divide()?;
        placing.remove_crossings()?;
        placing.finish(rise)
    }

    /// Returns true if no line and no apex can be used.
    pub(in crate::roof) fn is_empty(&self) -> bool {
        self.segments.is_empty() && self.places.len() == self.border.len()
    }

    /// Moves the nodes on the outline to the outline `outer`, which has as many edges.
    pub(in crate::roof) fn move_to(&mut self, outer: &Polygon) {
        let edges: Vec<[DVec2; 2]> = outer.edges().collect();
        let corners: Vec<DVec2> = outer.points().collect();
        for (node, anchor) in self.anchors.iter().enumerate() {
            match anchor {
                OutlineAnchor::Corner => {
                    self.places[node] = corners.get(node).copied().unwrap_or(self.places[node])
                }
                OutlineAnchor::Edge(edge) => {
                    if let Some(&[a, b]) = edges.get(*edge) {
                        self.places[node] = a + (b - a) * foot([a, b], self.places[node]);
                    }
                }
                OutlineAnchor::Inside => {}
            }
        }
    }
}

/// Lines while they are placed.
struct Placing<'a> {
    walls: &'a Polygon,
    edges: Vec<[DVec2; 2]>,
    places: Vec<DVec2>,
    anchors: Vec<OutlineAnchor>,
    /// Given heights (m); 0 for the height of the roof.
    given: Vec<Option<f64>>,
    chains: Vec<NodeChain>,
    apexes: Vec<usize>,
    unused: Vec<UnusedLine>,
    limits: WorkLimits,
}

impl<'a> Placing<'a> {
    fn new(walls: &'a Polygon) -> Self {
        let places: Vec<DVec2> = walls.points().collect();
        Self {
            walls,
            edges: walls.edges().collect(),
            anchors: vec![OutlineAnchor::Corner; places.len()],
            given: vec![None; places.len()],
            places,
            chains: Vec::new(),
            apexes: Vec::new(),
            unused: Vec::new(),
            limits: WorkLimits::current(),
        }
    }

    /// Returns the node at a place, or a new one; fails if the place is outside the plan.
    fn node(&mut self, place: DVec2) -> Result<usize, (DVec2, MapProblem)> {
        let nearest = |a: &(f64, usize), b: &(f64, usize)| a.0.total_cmp(&b.0);
        let near = self.places.iter().map(|at| at.distance(place)).zip(0..).min_by(nearest);
        if let Some((_, node)) = near.filter(|near| near.0 < SNAP) {
            return Ok(node);
        }
        let beside = self.edges.iter().map(|edge| distance(*edge, place)).zip(0..).min_by(nearest);
        let (place, anchor) = match beside {
            Some((off, edge)) if off < SNAP => {
                let ends = self.edges[edge];
                (ends[0] + (ends[1] - ends[0]) * foot(ends, place), OutlineAnchor::Edge(edge))
            }
            _ if self.walls.contains(place) => (place, OutlineAnchor::Inside),
            _ => return Err((place, MapProblem::Outside)),
        };
        // On the outline, the place may be nearer to a node than before.
        let near = self.places.iter().map(|at| at.distance(place)).zip(0..).min_by(nearest);
        if let Some((_, node)) = near.filter(|near| near.0 < SNAP) {
            return Ok(node);
        }
        self.places.push(place);
        self.anchors.push(anchor);
        self.given.push(None);
        Ok(self.places.len() - 1)
    }

    /// Sets the height (m) of a node, unless it has one.
    fn raise(&mut self, kind: MapLineKind, number: usize, node: usize, height: f64) {
        let own = if height > 0.0 { height } else { 0.0 };
        match self.given[node] {
            None if own > 0.0 || kind != MapLineKind::Edge => self.given[node] = Some(own),
            Some(other) if own > 0.0 && (own - other).abs() > SAME => {
                if other == 0.0 {
                    self.given[node] = Some(own);
                } else {
                    let problem = MapProblem::OtherHeight(own, other);
                    self.unused.push(UnusedLine { kind, number, at: self.places[node], problem });
                }
            }
            _ => {}
        }
    }

    fn add_line(
        &mut self,
        kind: MapLineKind,
        number: usize,
        line: &[DVec3],
    ) -> Result<(), (DVec2, MapProblem)> {
        let first = line.first().map(|at| at.truncate()).unwrap_or_default();
        if let Some(low) = line.iter().find(|at| at.z < 0.0) {
            return Err((low.truncate(), MapProblem::BelowEaves));
        }
        let known = self.places.len();
        let nodes: Result<Vec<usize>, _> = line.iter().map(|at| self.node(at.truncate())).collect();
        let result = nodes.and_then(|mut nodes| {
            let heights: Vec<(usize, f64)> = nodes.iter().copied().zip(line.iter().map(|at| at.z)).collect();
            nodes.dedup();
            if nodes.len() < 2 {
                return Err((first, MapProblem::Empty));
            }
            match nodes.windows(2).find_map(|pair| self.exit([pair[0], pair[1]])) {
                Some(at) => Err((at, MapProblem::Outside)),
                None => Ok((nodes, heights)),
            }
        });
        match result {
            Ok((nodes, heights)) => {
                for (node, height) in heights {
                    self.raise(kind, number, node, height);
                }
                self.chains.push(NodeChain { kind, number, nodes });
                Ok(())
            }
            Err(problem) => {
                self.places.truncate(known);
                self.anchors.truncate(known);
                self.given.truncate(known);
                Err(problem)
            }
        }
    }

    fn add_apex(&mut self, number: usize, apex: DVec3) -> Result<(), (DVec2, MapProblem)> {
        if apex.z < 0.0 {
            return Err((apex.truncate(), MapProblem::BelowEaves));
        }
        let node = self.node(apex.truncate())?;
        self.raise(MapLineKind::Apex, number, node, apex.z);
        self.apexes.push(node);
        Ok(())
    }

    /// Returns the place at which a segment leaves the plan, if it does.
    fn exit(&self, [a, b]: [usize; 2]) -> Option<DVec2> {
        let ends = [self.places[a], self.places[b]];
        // A place on the outline is there up to rounding.
        let is_near = |edge: &[DVec2; 2]| {
            ends.iter().any(|at| distance(*edge, *at) < SNAP)
                || edge.iter().any(|at| distance(ends, *at) < SNAP)
        };
        if let Some(edge) = self.edges.iter().find(|edge| crosses(ends, **edge) && !is_near(edge)) {
            return Some(crossing(ends, *edge));
        }
        // A segment between two places of the outline may lie outside it.
        let middle = ends[0].midpoint(ends[1]);
        let is_beside = self.edges.iter().any(|edge| distance(*edge, middle) < SNAP);
        (!is_beside && !self.walls.contains(middle)).then_some(middle)
    }

    /// Divides segments at the nodes on them.
    fn divide(&mut self) -> Result<()> {
        let mut used: Vec<usize> = self.chains.iter().flat_map(|chain| &chain.nodes).copied().collect();
        used.extend(&self.apexes);
        used.extend(0..self.edges.len());
        used.sort_unstable();
        used.dedup();
        for chain in &mut self.chains {
            self.limits.check()?;
            let mut nodes = Vec::with_capacity(chain.nodes.len());
            for pair in chain.nodes.windows(2) {
                nodes.push(pair[0]);
                nodes.extend(nodes_between(&self.places, [pair[0], pair[1]], &used));
            }
            nodes.extend(chain.nodes.last());
            nodes.dedup();
            chain.nodes = nodes;
        }
        Ok(())
    }

    /// Removes the lines that cross the outline or earlier lines.
    fn remove_crossings(&mut self) -> Result<()> {
        let all: Vec<usize> = (0..self.places.len()).collect();
        let outline = self.border(&all, &all);
        let mut kept: Vec<[usize; 2]> =
            outline.iter().flat_map(|edge| edge.windows(2)).map(|pair| [pair[0], pair[1]]).collect();
        let mut chains = Vec::with_capacity(self.chains.len());
        for chain in std::mem::take(&mut self.chains) {
            self.limits.check()?;
            let segments = || chain.nodes.windows(2).map(|pair| [pair[0], pair[1]]);
            let ends = |segment: [usize; 2]| segment.map(|node| self.places[node]);
            let own: Vec<[usize; 2]> = segments().collect();
            let found = own.iter().enumerate().find_map(|(index, segment)| {
                let others = kept.iter().chain(&own[..index]);
                let mut crossed = others.filter(|other| crosses(ends(*segment), ends(**other)));
                crossed.next().map(|other| crossing(ends(*segment), ends(*other)))
            });
            match found {
                Some(at) => {
                    let NodeChain { kind, number, .. } = chain;
                    self.unused.push(UnusedLine { kind, number, at, problem: MapProblem::Crossing });
                }
                None => {
                    kept.extend(own);
                    chains.push(chain);
                }
            }
        }
        self.chains = chains;
        Ok(())
    }

    /// Computes the heights, and removes edges without one.
    fn finish(mut self, rise: Rise) -> Result<MapNodes> {
        let high = self.roof_height(rise);
        let on_outline = |anchor: &OutlineAnchor| *anchor != OutlineAnchor::Inside;
        let mut heights: Vec<Option<f64>> = self
            .given
            .iter()
            .zip(&self.anchors)
            .map(|(given, anchor)| match given {
                Some(height) => Some(if *height > 0.0 { *height } else { high }),
                None => on_outline(anchor).then_some(0.0),
            })
            .collect();
        loop {
            self.limits.check()?;
            let (mut changed, mut ends) = (false, false);
            for chain in &self.chains {
                changed |= interpolate(&chain.nodes, &self.places, &mut heights);
            }
            if !changed {
                // The end of an edge without a height is level.
                for chain in &self.chains {
                    ends = ends || level_ends(&chain.nodes, &mut heights);
                }
                if !ends {
                    break;
                }
            }
        }
        let mut segments: Vec<[usize; 2]> = Vec::new();
        let mut is_used = vec![false; self.places.len()];
        (0..self.edges.len()).chain(self.apexes.iter().copied()).for_each(|node| is_used[node] = true);
        for NodeChain { kind, number, nodes } in &self.chains {
            if nodes.iter().any(|node| heights[*node].is_none()) {
                let at = self.places[nodes[0]];
                self.unused.push(UnusedLine {
                    kind: *kind,
                    number: *number,
                    at,
                    problem: MapProblem::NoHeight,
                });
                continue;
            }
            nodes.iter().for_each(|node| is_used[*node] = true);
            segments.extend(nodes.windows(2).map(|pair| [pair[0].min(pair[1]), pair[0].max(pair[1])]));
        }
        segments.sort_unstable();
        segments.dedup();
        let mut names = vec![usize::MAX; is_used.len()];
        let kept: Vec<usize> = (0..is_used.len()).filter(|node| is_used[*node]).collect();
        kept.iter().enumerate().for_each(|(name, node)| names[*node] = name);
        let border = self.border(&kept, &names);
        self.unused.sort_by_key(|line| (line.kind as usize, line.number));
        Ok(MapNodes {
            places: kept.iter().map(|node| self.places[*node]).collect(),
            anchors: kept.iter().map(|node| self.anchors[*node]).collect(),
            heights: kept.iter().map(|node| heights[*node].unwrap_or(0.0)).collect(),
            segments: segments.iter().map(|ends| ends.map(|node| names[node])).collect(),
            border,
            unused: self.unused,
        })
    }

    /// Returns the height (m) of the roof: of a slope from the outline to the furthest ridge, or else across the plan.
    fn roof_height(&self, rise: Rise) -> f64 {
        let slope = match rise {
            Rise::Height(height) => return height,
            Rise::Slope(slope) => slope,
        };
        let level: Vec<DVec2> = (0..self.places.len())
            .filter(|node| self.given[*node] == Some(0.0))
            .map(|node| self.places[node])
            .collect();
        let nearest =
            |at: &DVec2| self.edges.iter().map(|edge| distance(*edge, *at)).fold(f64::INFINITY, f64::min);
        let run = level.iter().map(nearest).fold(0.0, f64::max);
        if run > SNAP {
            return slope * run;
        }
        // A ridge along the outline has its slope on one side.
        let away = |corner: DVec2| level.iter().map(|at| at.distance(corner)).fold(f64::INFINITY, f64::min);
        let far = self.walls.points().map(away).filter(|far| far.is_finite()).fold(0.0, f64::max);
        slope * far.max(SNAP)
    }

    /// Returns the nodes along each edge of the outline.
    fn border(&self, kept: &[usize], names: &[usize]) -> Vec<Vec<usize>> {
        let mut first = 0;
        let mut border = Vec::with_capacity(self.edges.len());
        for ring in self.walls {
            let count = ring.len();
            for index in 0..count {
                let edge = first + index;
                let [a, b] = self.edges[edge];
                let mut on: Vec<usize> = kept
                    .iter()
                    .copied()
                    .filter(|node| self.anchors[*node] == OutlineAnchor::Edge(edge))
                    .collect();
                on.sort_by(|one, two| {
                    foot([a, b], self.places[*one]).total_cmp(&foot([a, b], self.places[*two]))
                });
                let ends = [edge, first + (index + 1) % count];
                border
                    .push([ends[0]].into_iter().chain(on).chain([ends[1]]).map(|node| names[node]).collect());
            }
            first += count;
        }
        border
    }
}

/// Returns the nodes on a segment, from its first end to its second.
fn nodes_between(places: &[DVec2], [a, b]: [usize; 2], nodes: &[usize]) -> Vec<usize> {
    let ends = [places[a], places[b]];
    let is_on = |node: &&usize| {
        let place = places[**node];
        let at = foot(ends, place);
        **node != a && **node != b && at > 0.0 && at < 1.0 && distance(ends, place) < SNAP
    };
    let mut on: Vec<usize> = nodes.iter().filter(is_on).copied().collect();
    on.sort_by(|one, two| foot(ends, places[*one]).total_cmp(&foot(ends, places[*two])));
    on
}

/// Returns true if two segments cross between their ends.
fn crosses([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    let sides = |from: DVec2, to: DVec2, ends: [DVec2; 2]| {
        let [one, two] = ends.map(|at| orientation(from, to, at));
        one != two && one != Orientation::Collinear && two != Orientation::Collinear
    };
    sides(a, b, [c, d]) && sides(c, d, [a, b])
}

/// Returns the place at which two segments cross.
fn crossing([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> DVec2 {
    let (way, other) = (b - a, d - c);
    let turn = way.perp_dot(other);
    if turn == 0.0 { a.midpoint(b) } else { a + way * ((c - a).perp_dot(other) / turn) }
}

/// Interpolates the heights of nodes between two known ones; returns true if any was unknown.
fn interpolate(nodes: &[usize], places: &[DVec2], heights: &mut [Option<f64>]) -> bool {
    let mut changed = false;
    let mut last: Option<usize> = None;
    for index in 0..nodes.len() {
        let Some(to) = heights[nodes[index]] else { continue };
        if let Some(begin) = last.filter(|begin| index - begin > 1) {
            let from = heights[nodes[begin]].unwrap_or(to);
            let step = |at: usize| places[nodes[at]].distance(places[nodes[at + 1]]);
            let length: f64 = (begin..index).map(step).sum();
            let mut gone = 0.0;
            for at in begin + 1..index {
                gone += step(at - 1);
                heights[nodes[at]] = Some(from + (to - from) * gone / length.max(1e-9));
            }
            changed = true;
        }
        last = Some(index);
    }
    changed
}

/// Gives the unknown ends of a line the height of the nearest known node; returns true if there were any.
fn level_ends(nodes: &[usize], heights: &mut [Option<f64>]) -> bool {
    let known: Vec<usize> = (0..nodes.len()).filter(|index| heights[nodes[*index]].is_some()).collect();
    let (Some(&first), Some(&last)) = (known.first(), known.last()) else { return false };
    let before: Vec<usize> = (0..first).collect();
    let after: Vec<usize> = (last + 1..nodes.len()).collect();
    before.iter().for_each(|index| heights[nodes[*index]] = heights[nodes[first]]);
    after.iter().for_each(|index| heights[nodes[*index]] = heights[nodes[last]]);
    !before.is_empty() || !after.is_empty()
}
