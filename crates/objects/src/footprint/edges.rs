//! The properties of a footprint's edges: keywords, neighbours, and the edge on the street.

use std::borrow::Cow;

use glam::{DVec2, DVec3};
use smallvec::{SmallVec, smallvec};

use super::cover::{self, Cover, WallSpan};
use super::neighbors::Touch;
use super::object::Footprint;
use super::state::Edges;
use crate::facade::template::BLIND;
use burgeon_base::error::{Error, Result};
use burgeon_geometry::planar::edges;

/// Keyword of the edge on the street.
const STREET: &str = "street";
/// Keyword of the edge with the entry.
const ENTRY: &str = "entry door";
/// Cosine of the angle to the street's edge, above which a wall counts as parallel to the street.
const ALONG_STREET: f64 = 0.7;
/// Height (m) by which a neighbour's walls must be lower than eaves that overhang the neighbour.
const LOWER: f64 = 1.0;
/// Height (m) above the given height of the footprint, beyond which walls have a different height.
const ABOVE: f64 = 0.05;
/// Distance (m) by which an edge must be nearer to a street to be preferred to a longer edge.
const NEARER: f64 = 2.0;

impl Edges {
    fn new(footprint: &Footprint) -> Self {
        let plan = &footprint.plan;
        let mut stands_for = vec![None; plan.given()];
        let mut keywords = vec![Vec::new(); plan.polygon().size()];
        for (edge, given) in plan.given_edges().into_iter().enumerate() {
            for number in given {
                stands_for[number] = Some(edge);
                for word in footprint.options.edge_keywords.0.get(&(number + 1)).into_iter().flatten() {
                    add(&mut keywords[edge], word.clone());
                }
            }
        }
        let touch = match &footprint.place {
            Some((all, own)) => all.touch(*own),
            None => Touch { shared: vec![0.0; plan.polygon().size()], ..Touch::default() },
        };
        let always_blind = keywords.iter().map(|words| words.iter().any(|word| word == BLIND)).collect();
        let heights = footprint.known_top().map(|top| [footprint.highest(), top]);
        for (index, (keywords, [a, b])) in keywords.iter_mut().zip(plan.polygon().edges()).enumerate() {
            let hidden = match (heights, touch.covers.get(index)) {
                (Some(heights), Some(covers)) => {
                    cover::hidden_fraction(covers, a.truncate().distance(b.truncate()), heights)
                }
                _ => touch.shared[index],
            };
            if hidden >= 0.5 {
                add(keywords, BLIND);
            }
        }
        let street = street(footprint, &touch);
        if let Some(street) = street {
            add(&mut keywords[street], STREET);
            if !keywords.iter().flatten().any(|word| word == ENTRY) {
                add(&mut keywords[street], ENTRY);
            }
        }
        Self { keywords, always_blind, touch, street, stands_for }
    }
}

fn add(words: &mut Vec<Cow<'static, str>>, word: impl Into<Cow<'static, str>>) {
    let word = word.into();
    if !words.contains(&word) {
        words.push(word);
    }
}

/// Returns the outer edge on the street: the nearest edge that faces a street, otherwise the longest. Prefers edges
/// that are not party walls.
fn street(footprint: &Footprint, touch: &Touch) -> Option<usize> {
    let flat = footprint.plan.flat();
    let outer: Vec<[DVec2; 2]> = flat.outer()?.edges().collect();
    let length = |edge: usize| outer[edge][0].distance(outer[edge][1]);
    let free: Vec<usize> = (0..outer.len()).filter(|&edge| touch.shared[edge] < 0.5).collect();
    let longest = |among: &[usize]| {
        among.iter().copied().max_by(|&a, &b| length(a).total_cmp(&length(b)).then(b.cmp(&a)))
    };
    if let Some(streets) = &footprint.options.streets {
        let mut near: Vec<(usize, f64)> = Vec::new();
        let mut least = f64::INFINITY;
        for &edge in &free {
            let [a, b] = outer[edge].map(|point| point + footprint.origin().truncate());
            if let Some(distance) = streets.facing_distance(a, b, least + NEARER) {
                least = least.min(distance);
                near.push((edge, distance));
            }
        }
        let near = near.iter().filter(|(_, distance)| *distance <= least + NEARER).map(|(edge, _)| *edge);
        if let Some(street) = longest(&near.collect::<Vec<_>>()) {
            return Some(street);
        }
    }
    longest(&free).or_else(|| longest(&(0..outer.len()).collect::<Vec<_>>()))
}

impl Footprint {
    /// Returns the properties of the edges, which are computed on first use.
    fn known_edges(&self) -> &Edges {
        self.edges.get_or_init(|| Edges::new(self))
    }

    /// Returns the keywords of an edge of the plan, by its number over all rings: the given keywords, and "blind",
    /// "street" and "entry door". Excludes the footprint's own keywords.
    pub(super) fn edge_keywords(&self, edge: usize) -> &[Cow<'static, str>] {
        self.known_edges().keywords.get(edge).map_or(&[], Vec::as_slice)
    }

    /// Returns the top (m) of the walls, if it is known before they are built.
    fn known_top(&self) -> Option<f64> {
        self.place.as_ref().and_then(|(all, own)| all.top(*own))
    }

    /// Divides the walls over an edge of this length (m), between two heights (m), into parts of constant covered
    /// height.
    ///
    /// If walls rise above the height given to the footprint, that height is the height of a storey. The neighbours may
    /// then rise as well, so their height is unknown.
    pub(super) fn spans(&self, edge: usize, length: f64, heights: [f64; 2]) -> SmallVec<[WallSpan; 2]> {
        let known = self.known_edges();
        let whole = |covered: f64| smallvec![WallSpan { part: [0.0, length], covered }];
        let is_blind = self.options.keywords.iter().any(|word| word == BLIND);
        if is_blind || known.always_blind.get(edge) == Some(&true) {
            return whole(heights[1] - heights[0]);
        }
        let Some(covers) = known.touch.covers.get(edge).filter(|covers| !covers.is_empty()) else {
            return whole(0.0);
        };
        let base = self.origin().z;
        let is_above = self.known_top().is_some_and(|top| base + heights[1] > top + ABOVE);
        let local =
            |cover: &Cover| Cover { top: if is_above { f64::INFINITY } else { cover.top - base }, ..*cover };
        let covers: SmallVec<[Cover; 4]> = covers.iter().map(local).collect();
        cover::spans(&covers, length, heights)
    }

    /// Returns the "blind" edges of the plan that are not parallel to the street edge.
    pub(super) fn party_walls(&self) -> Vec<usize> {
        let flat = self.plan.flat();
        let all: Vec<DVec2> = flat.edges().map(|[a, b]| (b - a).normalize_or_zero()).collect();
        let Some(street) = self.known_edges().street.map(|street| all[street]) else { return Vec::new() };
        let blind = |edge: &usize| self.edge_keywords(*edge).iter().any(|word| word == BLIND);
        (0..all.len()).filter(blind).filter(|edge| all[*edge].dot(street).abs() < ALONG_STREET).collect()
    }

    /// Returns the maximum overhang (m) over each edge for a roof with overhang `furthest` whose eaves drop by `drop`
    /// (m). An edge is limited by a neighbour that is as high, or too little lower for its roof to stay clear.
    pub(super) fn reach(&self, furthest: f64, drop: f64) -> Vec<f64> {
        let Some((all, own)) = &self.place else { return Vec::new() };
        let height = self.origin().z + self.shell.top - drop - LOWER;
        all.reach(*own, furthest, height)
    }

    /// Converts the number of a given edge, from 1, to an index from 0. Fails if there is no such edge.
    fn given_edge(&self, method: &str, number: u32) -> Result<usize> {
        let count = self.plan.given();
        let number = number as usize;
        if (1..=count).contains(&number) {
            return Ok(number - 1);
        }
        let message = format!("footprint:{method}: unknown edge {number}");
        let error = Error::not_found("edge", number, [], message);
        Err(match count {
            0 => error.help("the footprint has no geometry"),
            _ => error.help(format!(
                "it has the edges 1 to {count}: edges of the outer ring, followed by edges of holes"
            )),
        })
    }

    /// Returns both ends (m) of a given edge.
    pub(super) fn ends(&self, method: &str, number: u32) -> Result<[DVec2; 2]> {
        let index = self.given_edge(method, number)?;
        let given = self.options.geometry.0.iter().flat_map(|ring| edges(ring)).nth(index);
        Ok(given.map_or([DVec2::ZERO; 2], |edge| edge.map(DVec3::truncate)))
    }

    /// Returns the edge of the plan for a given edge, if there is one.
    fn plan_edge(&self, method: &str, number: u32) -> Result<Option<usize>> {
        let index = self.given_edge(method, number)?;
        Ok(self.known_edges().stands_for.get(index).copied().flatten())
    }

    pub(super) fn facing_angle(&self, number: u32) -> Result<f64> {
        let Some(edge) = self.plan_edge("edge_facing", number)? else { return Ok(0.0) };
        let flat = self.plan.flat();
        let found = flat.edges().nth(edge);
        Ok(found.map_or(0.0, |[a, b]| {
            let out = -(b - a).perp();
            out.y.atan2(out.x).to_degrees().rem_euclid(360.0)
        }))
    }

    pub(super) fn words_of(&self, number: u32) -> Result<&[Cow<'static, str>]> {
        Ok(self.plan_edge("edge_has", number)?.map_or(&[], |edge| self.edge_keywords(edge)))
    }

    pub(super) fn part_shared(&self, number: u32) -> Result<f64> {
        let edge = self.plan_edge("shared", number)?;
        Ok(edge.map_or(0.0, |edge| self.known_edges().touch.shared[edge]))
    }

    pub(super) fn neighbor_count(&self) -> u32 {
        self.known_edges().touch.neighbors
    }

    /// Returns the number, from 1, of the longest given edge on the street side, or 0 if there are no edges.
    pub(super) fn on_street(&self) -> u32 {
        let known = self.known_edges();
        let Some(street) = known.street else { return 0 };
        let numbers = (1u32..).zip(&known.stands_for);
        let candidates = numbers.filter(|(_, edge)| **edge == Some(street)).map(|(number, _)| number);
        let length = |number: u32| self.ends("street_edge", number).map_or(0.0, |[a, b]| a.distance(b));
        candidates.max_by(|a, b| length(*a).total_cmp(&length(*b)).then(b.cmp(a))).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::super::options::{EdgeKeywords, FootprintOptions};
    use super::*;
    use crate::LineIndex;
    use burgeon_geometry::{Line, Rings};

    fn ring(points: &[[f64; 2]]) -> Vec<DVec3> {
        points.iter().map(|point| DVec3::new(point[0], point[1], 0.0)).collect()
    }

    fn words(edges: &[(usize, &str)]) -> EdgeKeywords {
        EdgeKeywords(edges.iter().map(|(edge, word)| (*edge, vec![(*word).to_owned()])).collect())
    }

    const RECTANGLE: [[f64; 2]; 4] = [[0.0, 0.0], [10.0, 0.0], [10.0, 6.0], [0.0, 6.0]];

    #[test]
    fn words_keep_the_numbers_of_the_edges_that_were_given() {
        // Point 2 lies on a straight line, and the ring is clockwise.
        let given = [[0.0, 0.0], [0.0, 3.0], [0.0, 6.0], [10.0, 6.0], [10.0, 0.0]];
        let footprint = Footprint::new(FootprintOptions {
            geometry: Rings(vec![ring(&given)]).into(),
            edge_keywords: words(&[(1, "a"), (2, "b"), (4, "c")]),
            ..FootprintOptions::default()
        })
        .unwrap();
        assert_eq!((footprint.edges(), footprint.plan.polygon().size()), (5, 4));
        let has = |edge, word: &str| footprint.edge_has(edge, word.into()).unwrap();
        assert!(has(1, "a") && has(1, "b") && has(2, "a") && !has(2, "c") && has(4, "c") && !has(3, "c"));
        assert_eq!((footprint.edge_length(2).unwrap(), footprint.edge_length(3).unwrap()), (3.0, 10.0));
        assert_eq!((footprint.edge_facing(2).unwrap(), footprint.edge_facing(3).unwrap()), (180.0, 90.0));
        assert!(footprint.edge_has(6, "a".into()).is_err() && footprint.edge_length(0).is_err());
    }

    #[test]
    fn edges_of_holes_count_on_and_words_for_no_edge_are_refused() {
        let hole = ring(&[[2.0, 2.0], [4.0, 2.0], [4.0, 4.0]]);
        let options = |edge| FootprintOptions {
            geometry: Rings(vec![ring(&RECTANGLE), hole.clone()]).into(),
            edge_keywords: words(&[(edge, "gate")]),
            ..FootprintOptions::default()
        };
        let footprint = Footprint::new(options(5)).unwrap();
        assert!(
            footprint.edge_has(5, "gate".into()).unwrap() && !footprint.edge_has(6, "gate".into()).unwrap()
        );
        // The hole is reversed, so its first edge is the plan's last edge.
        assert_eq!(footprint.edge_keywords(6), ["gate"]);
        assert!(Footprint::new(options(8)).is_err());
    }

    #[test]
    fn the_street_edge_is_the_longest_or_the_one_that_faces_the_nearest_street() {
        let make = |streets: Option<LineIndex>, keywords| {
            Footprint::new(FootprintOptions {
                geometry: Rings(vec![ring(&RECTANGLE)]).into(),
                edge_keywords: keywords,
                streets,
                ..FootprintOptions::default()
            })
            .unwrap()
        };
        let plain = make(None, EdgeKeywords::default());
        assert_eq!(plain.street_edge(), 1);
        assert!(plain.edge_has(1, "entry door".into()).unwrap());
        let street = |points: &[[f64; 2]]| LineIndex::of_lines(&[Line::new(ring(points)).unwrap()]);
        // The street to the right passes the corner nearer to edge 1 than to the front that faces the street.
        let right = street(&[[13.0, -40.0], [13.0, 40.0]]);
        let facing = make(Some(right), words(&[(3, "entry door")]));
        assert_eq!(facing.street_edge(), 2);
        assert!(facing.edge_has(2, "street".into()).unwrap());
        assert!(!facing.edge_has(2, "entry door".into()).unwrap());
    }
}
