//! Statistics of unplanned towns: grown towns compared with real ones, measured by the same code.

use std::path::Path;

use burgeon_data::{Attribute, Source, SourceOptions};
use burgeon_streets::StreetNetwork;
use glam::DVec2;

/// Radius (m) of the towns, and number of rings of equal width in which their density is measured.
pub(crate) const REACH: f64 = 1000.0;
pub(crate) const RINGS: usize = 4;

/// Names of the measures, in the order of [`looks`].
pub(crate) const NAMES: [&str; 16] = [
    "degree",
    "dead ends",
    "3-way",
    "4-way",
    "circuity",
    "meshedness",
    "order",
    "block",
    "spread",
    "largest",
    "density",
    "decline",
    "zigzags",
    "stubs",
    "triangles",
    "knots",
];

/// Bounds of the mean of each measure over many seeds, as in London, Monaco and Helsinki. Areas are in m²,
/// density in km/km², and zigzags are per kilometre. Spread of blocks: 0.64 in Helsinki, 0.74 in Monaco.
pub(crate) const MEANS: [[f64; 2]; 16] = [
    [2.55, 2.9],
    [0.12, 0.25],
    [0.66, 0.82],
    [0.04, 0.1],
    [1.05, 1.21],
    [0.14, 0.24],
    [0.0, 0.2],
    [1200.0, 7000.0],
    [0.61, 0.75],
    [0.0, 160_000.0],
    [22.0, 42.0],
    [0.0, 1.0],
    [0.0, 2.2],
    [0.0, 0.37],
    [0.0, 0.06],
    [0.0, 0.07],
];

/// Bounds of the measures of each town: the bounds of the means, except for measures that few streets change
/// much.
pub(crate) const EACH: [[f64; 2]; 16] = {
    let [_, _, _, _, _, _, _, _, _, rest @ ..] = MEANS;
    let [largest, density, decline, zigzags, stubs, triangles, knots] = rest;
    [
        [2.4, 3.05],
        [0.06, 0.34],
        [0.55, 0.88],
        [0.02, 0.16],
        [1.02, 1.25],
        [0.1, 0.28],
        [0.0, 0.35],
        [1000.0, 7000.0],
        [0.5, 0.82],
        largest,
        density,
        decline,
        zigzags,
        stubs,
        triangles,
        knots,
    ]
};

/// Measures a network; the decline is the maximum quotient of densities of neighbouring rings around the
/// centre.
pub(crate) fn looks(network: &StreetNetwork) -> [f64; 16] {
    let of = network.measures();
    let [ends, three, four] = of.shares;
    let rings = network.density_by_distance(DVec2::ZERO, REACH, RINGS);
    let decline = rings.windows(2).map(|pair| pair[1] / pair[0].max(1e-9)).fold(0.0, f64::max);
    [
        of.degree,
        ends,
        three,
        four,
        of.circuity,
        of.meshedness,
        of.orientation_order,
        of.block,
        of.block_spread,
        of.largest,
        of.density,
        decline,
        of.zigzags,
        of.stubs,
        of.triangles,
        of.knots,
    ]
}

/// Returns the measures outside of their bounds.
pub(crate) fn faults(of: &[f64; 16], bounds: &[[f64; 2]; 16]) -> Vec<String> {
    let all = NAMES.iter().zip(of).zip(bounds);
    let wrong = all.filter(|((_, value), [least, most])| !(least..=most).contains(value));
    wrong.map(|((name, value), [least, most])| format!("{name} {value:.3}, not {least} to {most}")).collect()
}

/// Reads the car streets of a real town, without driveways; reports that the town is skipped if its data is
/// missing.
pub(crate) fn real(file: &str) -> Option<StreetNetwork> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data").join(file);
    if !path.is_file() {
        eprintln!("skipped: there is no ../shared/data/{file}");
        return None;
    }
    let wanted = SourceOptions { layer: Some("roads".to_owned()), ..SourceOptions::default() };
    let table =
        Source::open(&path, file).and_then(|source| source.read(file, &wanted)).expect("a layer of roads");
    let kind = table.names.iter().position(|name| name == "highway").expect("the kind of a road");
    let is_street = |attributes: &[(usize, Attribute)]| {
        let found = attributes.iter().find(|(name, _)| *name == kind);
        let Some((_, Attribute::Text(kind))) = found else { return false };
        let main = ["motorway", "trunk", "primary", "secondary", "tertiary"];
        main.contains(&kind.trim_end_matches("_link"))
            || ["residential", "unclassified", "living_street"].contains(&&**kind)
    };
    let streets = table.features.iter().filter(|feature| is_street(&feature.attributes));
    let lines =
        streets.map(|street| street.geometry.points().map(|at| at.truncate()).collect::<Vec<DVec2>>());
    let lines: Vec<Vec<DVec2>> = lines.collect();
    // The measures do not depend on the position, and coordinates near the origin are more precise.
    let origin = lines.iter().flatten().next().copied().unwrap_or_default();
    let lines: Vec<Vec<DVec2>> =
        lines.iter().map(|line| line.iter().map(|at| *at - origin).collect()).collect();
    Some(StreetNetwork::survey(&lines).expect("a network"))
}
