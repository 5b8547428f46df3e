//! Areas to divide that lie on each other.

use burgeon_base::warning::{Warning, WarningKind};
use burgeon_geometry::Rings;
use burgeon_streets::StreetBlock;
use geo::{Area, BooleanOps, LineString};
use glam::DVec2;
use rayon::prelude::*;

/// Blocks that have less (m²) in common are beside each other.
const LEAST: f64 = 0.01;

/// What to tell of blocks that lie on each other.
pub(super) fn overlapping(blocks: &[StreetBlock]) -> Option<Warning> {
    let polygons: Vec<geo::Polygon> = blocks.iter().map(|block| polygon(&block.rings)).collect();
    let bounds: Vec<[DVec2; 2]> = blocks.iter().map(|block| bounds(&block.rings)).collect();
    let mut order: Vec<usize> = (0..blocks.len()).collect();
    order.sort_by(|&one, &other| bounds[one][0].x.total_cmp(&bounds[other][0].x));
    let shared = |rank: usize| {
        let one = order[rank];
        let [low, high] = bounds[one];
        let mut found = Vec::new();
        for &other in order[rank + 1..].iter().take_while(|&&other| bounds[other][0].x < high.x) {
            if bounds[other][0].y < high.y && bounds[other][1].y > low.y {
                let area = polygons[one].intersection(&polygons[other]).unsigned_area();
                if area > LEAST {
                    found.push((area, [one.min(other), one.max(other)]));
                }
            }
        }
        found
    };
    let mut pairs: Vec<(f64, [usize; 2])> = (0..order.len()).into_par_iter().flat_map_iter(shared).collect();
    pairs.sort_by(|one, other| other.0.total_cmp(&one.0).then(one.1.cmp(&other.1)));
    let (area, pair) = *pairs.first()?;
    let [one, other] = pair.map(|index| &blocks[index].id);
    let more = match pairs.len() - 1 {
        0 => String::new(),
        1 => ", and one more pair of blocks does".into(),
        count => format!(", and {count} more pairs of blocks do"),
    };
    let text = format!(
        "network:lots: the blocks {one:?} and {other:?} have {area:.2} m² in common{more}: their lots overlap"
    );
    Some(
        Warning::new(WarningKind::Doubtful, text)
            .help("give blocks that are beside each other: one:difference(other)"),
    )
}

fn polygon(rings: &Rings<DVec2>) -> geo::Polygon {
    let mut lines = rings.iter().map(|ring| ring.iter().map(|at| (at.x, at.y)).collect::<LineString>());
    let outer = lines.next().unwrap_or_else(|| LineString::new(Vec::new()));
    geo::Polygon::new(outer, lines.collect())
}

fn bounds(rings: &Rings<DVec2>) -> [DVec2; 2] {
    let start = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    rings.iter().flatten().fold(start, |[low, high], at| [low.min(*at), high.max(*at)])
}
