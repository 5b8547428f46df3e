//! What was chosen of an extract, and the geometries that come of it.

use rustc_hash::FxHashMap;

use super::places::Place;
use super::rings;
use crate::Geometry;
use burgeon_base::budget::Budget;

/// What the tags of a feature are.
pub(super) type TagTexts = Vec<(String, String)>;

/// What was chosen.
pub(super) struct OsmRecord {
    /// Its number in OpenStreetMap.
    pub(super) id: i64,
    /// What its geometry is made of.
    pub(super) shape: OsmShape,
    /// Its tags.
    pub(super) tags: TagTexts,
    /// The alternative of the filter that held.
    pub(super) alternative: usize,
}

/// What a geometry is made of.
pub(super) enum OsmShape {
    /// The place of a node.
    Point(Place),
    /// The nodes of a way.
    Line(Vec<i64>),
    /// The nodes of a closed way.
    Area(Vec<i64>),
    /// The ways of a relation.
    Ways(Vec<i64>),
}

/// What comes of a shape: its parts, and whether it lacks nodes.
pub(super) type BuildResult = Result<(Vec<Geometry>, bool), String>;

impl OsmRecord {
    /// The feature's id, as OpenStreetMap's pages have it.
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
    /// The nodes that it is made of.
    pub(super) fn nodes(&self) -> &[i64] {
        match self {
            Self::Line(nodes) | Self::Area(nodes) => nodes,
            Self::Point(_) | Self::Ways(_) => &[],
        }
    }

    /// The ways that it is made of.
    pub(super) fn ways(&self) -> &[i64] {
        match self {
            Self::Ways(ways) => ways,
            _ => &[],
        }
    }
}

/// Makes geometries of a record.
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
                let nodes = ways.get(way).ok_or_else(|| format!("lacks way/{way}, which is a part of it"))?;
                borders.push(all_places(nodes, places)?);
            }
            Ok((polygons(rings::assemble(borders.iter().map(Vec::as_slice), budget)?), false))
        }
    }
}

/// The bounds of what is known of a record (degrees); those of nothing touch no box.
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

/// The places of all nodes, of which none may be missing.
fn all_places(nodes: &[i64], places: &FxHashMap<i64, Place>) -> Result<Vec<Place>, String> {
    let found: Vec<Place> = nodes.iter().filter_map(|node| places.get(node)).copied().collect();
    if let Some(odd) = found.iter().find(|place| !place.is_sane()) {
        return Err(format!("has a node at {}", odd.degrees().truncate()));
    }
    match nodes.len() - found.len() {
        0 => Ok(found),
        count => Err(format!("lacks {count} of its {} nodes", nodes.len())),
    }
}

/// The lines that there are between nodes of which some may be missing.
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
        (true, 0) => Err("has fewer than two places".to_owned()),
        (true, count) => Err(format!("lacks {count} of its {} nodes", nodes.len())),
        (false, count) => Ok((parts, count > 0)),
    }
}
