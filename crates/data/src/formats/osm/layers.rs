//! Predefined layers of an extract, defined by the tags that mappers use.
//!
//! Source: OpenStreetMap wiki, "Map features".

use std::sync::Arc;

use crate::tags::{TagFilter, TagTest};
use burgeon_spatial::GeometryKind;

/// Predefined layer of an extract.
pub(super) struct ReadyLayer {
    /// Name.
    pub(super) name: &'static str,
    /// Type of geometry.
    pub(super) kind: GeometryKind,
    /// Keys of which a feature has one, each with its accepted values; if the list is empty, any value except `no` is
    /// accepted.
    tags: &'static [(&'static str, &'static [&'static str])],
}

/// All layers.
pub(super) const LAYERS: [ReadyLayer; 14] = [
    ReadyLayer { name: "buildings", kind: GeometryKind::Polygon, tags: &[("building", &[])] },
    ReadyLayer { name: "building_parts", kind: GeometryKind::Polygon, tags: &[("building:part", &[])] },
    ReadyLayer { name: "roads", kind: GeometryKind::Line, tags: &[("highway", &[])] },
    ReadyLayer { name: "railways", kind: GeometryKind::Line, tags: &[("railway", &[])] },
    ReadyLayer {
        name: "squares",
        kind: GeometryKind::Polygon,
        tags: &[
            ("highway", &["pedestrian", "footway", "service", "living_street"]),
            ("area:highway", &[]),
            ("place", &["square"]),
        ],
    },
    ReadyLayer {
        name: "water",
        kind: GeometryKind::Polygon,
        tags: &[
            ("natural", &["water", "bay", "strait"]),
            ("water", &[]),
            ("waterway", &["riverbank", "dock", "canal"]),
            ("landuse", &["reservoir", "basin"]),
            ("leisure", &["swimming_pool"]),
            ("amenity", &["fountain"]),
        ],
    },
    ReadyLayer {
        name: "waterways",
        kind: GeometryKind::Line,
        tags: &[("waterway", &["river", "stream", "canal", "drain", "ditch", "tidal_channel"])],
    },
    ReadyLayer { name: "coastlines", kind: GeometryKind::Line, tags: &[("natural", &["coastline"])] },
    ReadyLayer {
        name: "green",
        kind: GeometryKind::Polygon,
        tags: &[
            ("leisure", &["park", "garden", "golf_course", "nature_reserve", "dog_park"]),
            (
                "landuse",
                &[
                    "grass",
                    "forest",
                    "meadow",
                    "village_green",
                    "recreation_ground",
                    "cemetery",
                    "allotments",
                    "orchard",
                    "vineyard",
                    "flowerbed",
                ],
            ),
            ("natural", &["wood", "scrub", "grassland", "heath", "shrubbery"]),
        ],
    },
    ReadyLayer { name: "landuse", kind: GeometryKind::Polygon, tags: &[("landuse", &[])] },
    ReadyLayer { name: "trees", kind: GeometryKind::Point, tags: &[("natural", &["tree"])] },
    ReadyLayer { name: "tree_rows", kind: GeometryKind::Line, tags: &[("natural", &["tree_row"])] },
    ReadyLayer { name: "barriers", kind: GeometryKind::Line, tags: &[("barrier", &[])] },
    ReadyLayer {
        name: "furniture",
        kind: GeometryKind::Point,
        tags: &[
            ("highway", &["street_lamp", "crossing", "traffic_signals", "bus_stop"]),
            (
                "amenity",
                &[
                    "bench",
                    "bicycle_parking",
                    "clock",
                    "drinking_water",
                    "fountain",
                    "post_box",
                    "recycling",
                    "shelter",
                    "telephone",
                    "toilets",
                    "vending_machine",
                    "waste_basket",
                ],
            ),
            ("barrier", &["bollard"]),
            ("emergency", &["fire_hydrant"]),
            ("tourism", &["artwork", "information"]),
            ("advertising", &[]),
        ],
    },
];

impl ReadyLayer {
    /// Returns the layer called `name`.
    pub(super) fn of_name(name: &str) -> Option<&'static Self> {
        LAYERS.iter().find(|layer| layer.name == name)
    }

    /// Returns the filter for its features, with one alternative for each key.
    pub(super) fn filter(&self) -> TagFilter {
        let test = |values: &[&str]| match values {
            [] => TagTest::Set,
            values => TagTest::OneOf(values.iter().map(|value| Arc::from(*value)).collect()),
        };
        let alternatives = self.tags.iter().map(|(key, values)| vec![((*key).into(), test(values))]);
        TagFilter { alternatives: alternatives.collect() }
    }

    /// Returns the key of an alternative.
    pub(super) fn key(&self, alternative: usize) -> Option<&'static str> {
        self.tags.get(alternative).map(|(key, _)| *key)
    }
}

/// Keys that make a closed way an area with any value except `no`, if it has no tag `area`.
const AREAS: [&str; 16] = [
    "amenity",
    "area:highway",
    "boundary",
    "building",
    "building:part",
    "craft",
    "historic",
    "landuse",
    "leisure",
    "office",
    "place",
    "public_transport",
    "shop",
    "tourism",
    "water",
    "military",
];

/// Values of `waterway` that make a closed way an area.
const WATER_AREAS: [&[u8]; 4] = [b"riverbank", b"dock", b"boatyard", b"dam"];

/// Values of `natural` that are lines even if the way is closed.
const NATURAL_LINES: [&[u8]; 6] = [b"coastline", b"cliff", b"ridge", b"arete", b"tree_row", b"valley"];

/// Returns true if the tags of a closed way make it an area.
pub(super) fn is_area<'v>(value: impl Fn(&str) -> Option<&'v [u8]>) -> bool {
    match value("area") {
        Some(area) => area != b"no",
        None => {
            let natural = value("natural").is_some_and(|kind| !NATURAL_LINES.contains(&kind));
            let water = value("waterway").is_some_and(|kind| WATER_AREAS.contains(&kind));
            natural || water || AREAS.iter().any(|key| value(key).is_some_and(|value| value != b"no"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn closed_ways_are_areas_by_their_tags() {
        let is = |tags: &[(&str, &'static str)]| {
            is_area(|key| tags.iter().find(|tag| tag.0 == key).map(|tag| tag.1.as_bytes()))
        };
        assert!(is(&[("building", "yes")]) && is(&[("natural", "wood")]) && is(&[("area", "yes")]));
        assert!(!is(&[("highway", "residential")]) && !is(&[("natural", "cliff")]) && !is(&[]));
        assert!(!is(&[("leisure", "track"), ("area", "no")]) && !is(&[("building", "no")]));
    }
}
