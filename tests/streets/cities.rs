//! Invariants of whole towns for any seed: buildings overlap neither streets nor each other, lots have street fronts,
//! and the network is connected.

use std::path::PathBuf;

use burgeon::objects::{Footprint, Network};
use burgeon::script::RunOptions;
use burgeon_streets::{LotOptions, LotPattern, LotUse, StreetNetwork, SurfaceOptions};
use glam::{DVec2, DVec3};

use crate::check::{Whole, meet, side, whole};

/// Script of a town, with the search radius (m) and the minimum detour ratio for joining its dead ends, and the
/// parameters of a small town of its type.
pub(crate) struct Town {
    pub(crate) script: &'static str,
    joint: (f64, f64),
    /// Radius (m) of its turning circles.
    turning: f64,
    /// Number of seeds that the tests examine.
    #[allow(dead_code, reason = "the bench has its own")]
    pub(crate) seeds: u64,
    set: &'static [(&'static str, &'static str)],
}

pub(crate) const TOWNS: [Town; 4] = [
    Town {
        script: "city.lua",
        joint: (40.0, 2.5),
        turning: 0.0,
        seeds: 4,
        set: &[("extent", "260"), ("detail", "0"), ("trees", "false")],
    },
    Town {
        script: "city.lua",
        joint: (40.0, 2.5),
        turning: 0.0,
        seeds: 4,
        set: &[("extent", "260"), ("detail", "0"), ("trees", "false"), ("hills", "40")],
    },
    Town {
        script: "oldtown.lua",
        joint: (170.0, 1.8),
        turning: 0.0,
        seeds: 4,
        set: &[("extent", "130"), ("trees", "false")],
    },
    Town {
        script: "village.lua",
        joint: (90.0, 2.0),
        turning: 6.0,
        seeds: 4,
        set: &[("extent", "150"), ("trees", "false")],
    },
];

/// Counts in a town.
#[derive(Debug, Default)]
pub(crate) struct TownFigures {
    pub(crate) buildings: usize,
    /// Pairs of buildings that intersect.
    pub(crate) overlaps: usize,
    /// Buildings that intersect a carriageway or a sidewalk.
    pub(crate) on_street: usize,
    pub(crate) pieces: usize,
    /// Pairs of streets that share a point without a junction.
    pub(crate) crossings: usize,
    /// Minimum angle (degrees) at a junction, minus the minimum that the script requires.
    pub(crate) angle: f64,
    pub(crate) components: usize,
    pub(crate) dead_ends: usize,
    /// Dead ends that could be joined.
    pub(crate) joinable: u32,
    pub(crate) lots: usize,
    /// Building lots without a front on a street.
    pub(crate) landlocked: usize,
    /// Relative difference between the areas of lots and of their blocks, and between the areas of blocks and streets
    /// and of the region that they fill.
    pub(crate) area: f64,
    /// Rank correlation between the heights of buildings and the hierarchy depth of their street, if the script
    /// provides both.
    pub(crate) correlation: Option<f64>,
}

impl TownFigures {
    /// Returns the fraction of dead ends that cannot be joined; 1 if none can be joined.
    pub(crate) fn joined(&self) -> f64 {
        if self.joinable == 0 { 1.0 } else { 1.0 - f64::from(self.joinable) / self.dead_ends.max(1) as f64 }
    }

    /// Returns the first violated invariant of a town.
    pub(crate) fn fault(&self) -> Option<&'static str> {
        let faults = [
            (self.pieces < 6 || self.buildings < 6, "hardly anything is there"),
            (self.overlaps > 0, "buildings overlap"),
            (self.on_street > 0, "buildings are on streets"),
            (self.crossings > 0, "streets cross"),
            (self.angle < 0.0, "streets meet at too small an angle"),
            (self.components != 1, "the network falls apart"),
            (self.joined() < 0.95, "dead ends could be joined"),
            (self.landlocked > 0, "lots have no access"),
            (self.area > 1e-6, "areas do not add up"),
        ];
        faults.into_iter().find(|(is_so, _)| *is_so).map(|(_, fault)| fault)
    }
}

impl Town {
    /// Returns the script's name with its parameters.
    pub(crate) fn name(&self) -> String {
        let set = self.set.iter().filter(|(name, _)| !["detail", "trees"].contains(name));
        set.fold(self.script.to_owned(), |name, (option, value)| format!("{name} {option}={value}"))
    }
}

/// Ring in integer steps of 2^-40 m, with its bounding box.
struct Outline {
    ring: Vec<Whole>,
    low: Whole,
    high: Whole,
}

impl Outline {
    #[allow(clippy::cast_possible_truncation, reason = "towns are within 2^53 steps")]
    fn new(ring: impl IntoIterator<Item = DVec2>) -> Self {
        let step = (1_u64 << 40) as f64;
        let ring: Vec<Whole> = ring
            .into_iter()
            .map(|at| ((at.x * step).round() as i128, (at.y * step).round() as i128))
            .collect();
        let start = ring[0];
        let low = ring.iter().fold(start, |low, at| (low.0.min(at.0), low.1.min(at.1)));
        let high = ring.iter().fold(start, |high, at| (high.0.max(at.0), high.1.max(at.1)));
        Self { ring, low, high }
    }

    fn edges(&self) -> impl Iterator<Item = [Whole; 2]> + '_ {
        (0..self.ring.len()).map(|index| [self.ring[index], self.ring[(index + 1) % self.ring.len()]])
    }

    /// Returns true if a position is inside, and not on the border.
    fn holds(&self, at: Whole) -> bool {
        let on = |[a, b]: [Whole; 2]| {
            side(a, b, at) == 0
                && a.0.min(b.0) <= at.0
                && at.0 <= a.0.max(b.0)
                && a.1.min(b.1) <= at.1
                && at.1 <= a.1.max(b.1)
        };
        let crossed = self.edges().filter(|[a, b]| {
            (a.1 <= at.1 && at.1 < b.1 && side(*a, *b, at) > 0)
                || (b.1 <= at.1 && at.1 < a.1 && side(*a, *b, at) < 0)
        });
        crossed.count() % 2 == 1 && !self.edges().any(on)
    }

    /// Returns a position inside, next to the lowest corner.
    fn inner(&self) -> Whole {
        let count = self.ring.len();
        let lowest = (0..count).min_by_key(|index| (self.ring[*index].1, self.ring[*index].0)).unwrap_or(0);
        let [before, at, after] = [count - 1, 0, 1].map(|offset| self.ring[(lowest + offset) % count]);
        let near = |before: i128, at: i128, after: i128| at + ((before - at + after - at) >> 16);
        (near(before.0, at.0, after.0), near(before.1, at.1, after.1))
    }

    /// Returns true if the interiors intersect.
    fn overlaps(&self, other: &Self) -> bool {
        if self.low.0 > other.high.0
            || other.low.0 > self.high.0
            || self.low.1 > other.high.1
            || other.low.1 > self.high.1
        {
            return false;
        }
        let crosses = self.edges().any(|[a, b]| {
            other.edges().any(|[c, d]| side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0)
        });
        crosses
            || self.ring.iter().any(|at| other.holds(*at))
            || other.ring.iter().any(|at| self.holds(*at))
            || other.holds(self.inner())
    }
}

/// Returns the pairs of outlines of two lists, or of one, whose interiors intersect.
fn overlapping(one: &[Outline], two: Option<&[Outline]>) -> Vec<(usize, usize)> {
    let mut order: Vec<usize> = (0..two.unwrap_or(one).len()).collect();
    let others = two.unwrap_or(one);
    order.sort_by_key(|index| others[*index].low.0);
    let widest = others.iter().map(|it| it.high.0 - it.low.0).max().unwrap_or(0);
    let mut found = Vec::new();
    for (number, outline) in one.iter().enumerate() {
        let first = order.partition_point(|index| others[*index].low.0 < outline.low.0 - widest);
        for other in order[first..].iter().take_while(|other| others[**other].low.0 <= outline.high.0) {
            if (two.is_some() || number < *other) && outline.overlaps(&others[*other]) {
                found.push((number, *other));
            }
        }
    }
    found
}

/// Returns the surfaces of streets from above as triangles: carriageways, medians and sidewalks.
fn street_surfaces(network: &StreetNetwork, options: SurfaceOptions) -> Vec<[DVec2; 3]> {
    let surfaces = network.surfaces(options, &Default::default());
    let medians = surfaces.medians.iter().map(|median| &median.top);
    let tops = surfaces.carriageways.iter().chain(medians).flat_map(|surface| {
        let corner = |index: u32| surface.points[index as usize].truncate();
        surface.triangles.iter().map(move |corners| corners.map(corner))
    });
    let walks = surfaces.sidewalks.iter().flat_map(|walk| {
        (0..walk.kerb.len()).flat_map(|index| {
            let next = (index + 1) % walk.kerb.len();
            let quad = [walk.kerb[index], walk.kerb[next], walk.edge[next], walk.edge[index]];
            let [a, b, c, d] = quad.map(DVec3::truncate);
            [[a, b, c], [a, c, d]]
        })
    });
    tops.chain(walks).collect()
}

fn area(ring: &[DVec2]) -> f64 {
    ring.windows(2).map(|pair| (pair[0] - ring[0]).perp_dot(pair[1] - ring[0])).sum::<f64>() / 2.0
}

/// Computes the rank correlation of pairs (C. Spearman, 1904); equal values have the mean of their ranks.
fn rank_correlation(pairs: &[(f64, f64)]) -> f64 {
    let ranks = |values: Vec<f64>| -> Vec<f64> {
        let below = |value: f64| values.iter().filter(|other| **other < value).count() as f64;
        let same = |value: f64| values.iter().filter(|other| other.total_cmp(&value).is_eq()).count() as f64;
        values.iter().map(|value| below(*value) + same(*value) / 2.0).collect()
    };
    let [one, two] =
        [ranks(pairs.iter().map(|it| it.0).collect()), ranks(pairs.iter().map(|it| it.1).collect())];
    let mean = pairs.len() as f64 / 2.0;
    let product =
        |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| (a - mean) * (b - mean)).sum() };
    product(&one, &two) / (product(&one, &one) * product(&two, &two)).sqrt()
}

/// Counts all figures in the town of a script; its extent is that of the script's small town unless `extent` is given.
pub(crate) fn figures(town: &Town, seed: u64, extent: Option<&str>) -> TownFigures {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("scripts").join(town.script);
    let mut set: Vec<_> =
        town.set.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
    set.extend(extent.map(|extent| ("extent".to_owned(), extent.to_owned())));
    let run = burgeon::run(&path, RunOptions { seed, params: set.into(), lod: 0, ..burgeon::options() })
        .unwrap_or_else(|error| panic!("{}, seed {seed}: {error}", town.script));
    let objects = || {
        run.systems.iter().flat_map(|system| &system.objects).map(|object| {
            let any: &dyn std::any::Any = &**object;
            any
        })
    };
    let grown = objects().find_map(|object| object.downcast_ref::<Network>()).expect("a network");
    let network = grown.network();
    let mut figures = TownFigures {
        pieces: network.size(),
        components: network.components(),
        dead_ends: grown.dead_ends() as usize,
        joinable: grown.joinable(Some(town.joint.0), Some(town.joint.1)).expect("a radius"),
        ..TownFigures::default()
    };

    // Streets.
    let pieces: Vec<_> =
        network.pieces().map(|(id, _)| (network.ends(id), network.line(id).map(whole))).collect();
    let mut least = 180.0_f64;
    for (index, (ends, line)) in pieces.iter().enumerate() {
        for (others, other) in &pieces[..index] {
            let shared: Vec<u32> = ends.iter().copied().filter(|end| others.contains(end)).collect();
            let [junction] = shared[..] else {
                figures.crossings += usize::from(!shared.is_empty() || meet(*line, *other));
                continue;
            };
            let way = |ends: &[u32; 2]| {
                let far = if ends[0] == junction { ends[1] } else { ends[0] };
                network.at(far) - network.at(junction)
            };
            least = least.min(way(ends).angle_to(way(others)).abs().to_degrees());
        }
    }
    figures.angle = least - network.constraints().least_angle();

    // Buildings: those on top of others are inside them.
    let footprints: Vec<&Footprint> =
        objects().filter_map(|object| object.downcast_ref::<Footprint>()).collect();
    let is_lowest = |it: &&Footprint| match it.attribute("tier".into()) {
        burgeon::kit::Value::Number(tier) => tier < 1.5,
        _ => true,
    };
    let grounded: Vec<&Footprint> =
        footprints.into_iter().filter(|it| !it.rings().is_empty()).filter(is_lowest).collect();
    let outlines: Vec<Outline> =
        grounded.iter().map(|it| Outline::new(it.rings()[0].iter().map(|at| at.truncate()))).collect();
    figures.buildings = outlines.len();
    figures.overlaps = overlapping(&outlines, None).len();
    let options = SurfaceOptions { turning: town.turning };
    let triangles = street_surfaces(network, options);
    let surfaces: Vec<Outline> =
        triangles.iter().filter(|it| area(&it[..]).abs() > 1e-9).map(|it| Outline::new(*it)).collect();
    let mut on_street: Vec<usize> =
        overlapping(&outlines, Some(&surfaces)).into_iter().map(|(building, _)| building).collect();
    on_street.dedup();
    figures.on_street = on_street.len();
    let pairs: Vec<(f64, f64)> = grounded
        .iter()
        .filter_map(|it| match (it.attribute("total".into()), it.attribute("street_depth".into())) {
            (burgeon::kit::Value::Number(height), burgeon::kit::Value::Number(depth)) => {
                Some((height, depth))
            }
            _ => None,
        })
        .collect();
    figures.correlation = (pairs.len() > 2).then(|| rank_correlation(&pairs));

    // Lots of all uses, and areas.
    let blocks = network.lot_blocks(options);
    let of = |rings: &[Vec<DVec2>]| rings.iter().map(|ring| area(ring)).sum::<f64>();
    let of_blocks: f64 = blocks.iter().map(|block| of(&block.rings)).sum();
    for (_, pattern) in LotPattern::ALL {
        let wanted = LotOptions { pattern, ..LotOptions::new(14.0, 20.0) };
        let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
        let mut random = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let lots: Vec<_> = blocks.iter().flat_map(|block| block.divide(&wanted, &mut random)).collect();
        let built = lots.iter().filter(|lot| lot.purpose == LotUse::Building);
        figures.lots += built.clone().count();
        figures.landlocked +=
            built.filter(|lot| lot.fronts.is_empty() || lot.front_length < wanted.min_width - 1e-9).count();
        let of_lots: f64 = lots.iter().map(|lot| lot.area).sum();
        figures.area = figures.area.max((of_lots - of_blocks).abs() / of_blocks.max(1.0));
    }
    // Streets, blocks and the outside fill the plane: the outer border of the sidewalks encloses streets and blocks.
    let walks = network.surfaces(options, &Default::default()).sidewalks;
    let flat = |ring: &[DVec3]| ring.iter().map(|at| at.truncate()).collect::<Vec<DVec2>>();
    let outside: f64 = walks.iter().map(|walk| area(&flat(&walk.edge))).filter(|area| *area < 0.0).sum();
    let of_streets: f64 = triangles.iter().map(|corners| area(&corners[..])).sum();
    let gap = (of_streets + of_blocks + outside).abs() / outside.abs().max(1.0);
    figures.area = figures.area.max(gap);
    figures
}
