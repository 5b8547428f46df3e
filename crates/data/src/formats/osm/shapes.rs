//! Features selected in an extract, and the geometries built from them.

use rustc_hash::FxHashMap;
use std::borrow::Cow;

use super::places::Place;
use super::rings;
use burgeon_base::budget::Budget;
use burgeon_spatial::Geometry;

/// Tags of a feature, as keys and values.
pub(super) type TagTexts = Vec<(String, String)>;

/// Selected feature.
pub(super) struct OsmRecord {
    /// OpenStreetMap id.
    pub(super) id: i64,
    /// Components of the geometry.
    pub(super) shape: OsmShape,
    /// Tags.
    pub(super) tags: TagTexts,
    /// Alternative of the filter that matched.
    pub(super) alternative: usize,
}

/// Components of a geometry.
pub(super) enum OsmShape {
    /// Position of a node.
    Point(Place),
    /// Nodes of a way.
    Line(Vec<i64>),
    /// Nodes of a closed way.
    Area(Vec<i64>),
    /// Ways of a relation.
    Ways(Vec<i64>),
}

/// Result of building a shape: its parts, and true if nodes are missing.
pub(super) type BuildResult = Result<(Vec<Geometry>, bool), Cow<'static, str>>;

impl OsmRecord {
    /// Returns the feature's id as in OpenStreetMap URLs.
    pub(super) fn name(&self) -> String {
        let kind = match self.shape {
            OsmShape::Point(_) => "node",
            OsmShape::Line(_) | OsmShape::Area(_) => "way",
            OsmShape::Ways(_) => "relation",
        };
        format!("{kind}/{}", self.id)
    }
}

impl OsmShape {
    /// Returns the nodes of the shape.
    pub(super) fn nodes(&self) -> &[i64] {
        match self {
            Self::Line(nodes) | Self::Area(nodes) => nodes,
            Self::Point(_) | Self::Ways(_) => &[],
        }
    }

    /// Returns the ways of the shape.
    pub(super) fn ways(&self) -> &[i64] {
        match self {
            Self::Ways(ways) => ways,
            _ => &[],
        }
    }
}

/// Builds the geometries of a feature.
pub(super) fn build(
    record: &OsmRecord,
    ways: &FxHashMap<i64, Vec<i64>>,
    places: &FxHashMap<i64, Place>,
    budget: &Budget,
) -> BuildResult {
    match &record.shape {
        OsmShape::Point(place) => Ok((vec![Geometry::point(place.degrees())], false)),
        OsmShape::Line(nodes) => lines(nodes, places),
        OsmShape::Area(nodes) => {
            let ring = all_places(nodes, places)?;
            Ok((polygons(rings::of_way(&ring, budget)?), false))
        }
        OsmShape::Ways(members) => {
            let mut borders = Vec::with_capacity(members.len());
            for way in members {
                let nodes = ways.get(way).ok_or_else(|| format!("lacks its part way/{way}"))?;
                borders.push(all_places(nodes, places)?);
            }
            Ok((polygons(rings::assemble(borders.iter().map(Vec::as_slice), budget)?), false))
        }
    }
}

/// Returns the bounds (degrees) of the known positions of a feature; if there are none, the bounds touch no box.
pub(super) fn known_bounds(
    record: &OsmRecord,
    ways: &FxHashMap<i64, Vec<i64>>,
    places: &FxHashMap<i64, Place>,
) -> [f64; 4] {
    let of_ways = record.shape.ways().iter().filter_map(|way| ways.get(way)).flatten();
    let known = record.shape.nodes().iter().chain(of_ways).filter_map(|node| places.get(node));
    let nothing = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    known.fold(nothing, |[west, south, east, north], place| {
        let at = place.degrees();
        [west.min(at.x), south.min(at.y), east.max(at.x), north.max(at.y)]
    })
}

fn polygons(rings: Vec<rings::PolygonRings>) -> Vec<Geometry> {
    let points = |ring: Vec<Place>| ring.into_iter().map(Place::degrees).collect();
    rings
        .into_iter()
        .filter_map(|polygon| Geometry::polygon(polygon.into_iter().map(points).collect::<Vec<_>>()))
        .collect()
}

/// Returns the positions of all nodes; fails if any is missing.
fn all_places(nodes: &[i64], places: &FxHashMap<i64, Place>) -> Result<Vec<Place>, Cow<'static, str>> {
    let found: Vec<Place> = nodes.iter().filter_map(|node| places.get(node)).copied().collect();
    if let Some(odd) = found.iter().find(|place| !place.is_sane()) {
        return Err(format!("has a node at {}", odd.degrees().truncate()).into());
    }
    match nodes.len() - found.len() {
        0 => Ok(found),
        count => Err(format!("lacks {count} of its {} nodes", nodes.len()).into()),
    }
}

/// Returns the lines between consecutive known nodes; nodes may be missing.
fn lines(nodes: &[i64], places: &FxHashMap<i64, Place>) -> BuildResult {
    let known: Vec<Option<Place>> = nodes.iter().map(|node| places.get(node).copied()).collect();
    let lacking = known.iter().filter(|place| place.is_none()).count();
    let mut parts = Vec::new();
    for run in known.split(Option::is_none) {
        let mut run: Vec<Place> = run.iter().flatten().copied().collect();
        run.dedup();
        parts.extend(Geometry::line(run.into_iter().map(Place::degrees).collect()));
    }
    match (parts.is_empty(), lacking) {
        (true, 0) => Err("has fewer than two positions".into()),
        (true, count) => Err(format!("lacks {count} of its {} nodes", nodes.len()).into()),
        (false, count) => Ok((parts, count > 0)),
    }
}
