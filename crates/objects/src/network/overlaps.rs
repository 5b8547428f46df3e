//! Areas to divide that lie on each other.

use burgeon_base::warning::{Warning, WarningKind};
use burgeon_geometry::Polygon;
use burgeon_streets::StreetBlock;
use glam::DVec2;

/// Blocks that have less (m²) in common are beside each other.
const LEAST: f64 = 0.01;

/// What to tell of blocks that lie on each other.
pub(super) fn overlapping(blocks: &[StreetBlock]) -> Option<Warning> {
    let mut areas: Vec<(usize, Polygon, [DVec2; 2])> = blocks
        .iter()
        .enumerate()
        .filter_map(|(index, block)| {
            let area = Polygon::new(block.rings.clone()).ok()?;
            let bounds = area.bounds()?;
            Some((index, area, bounds))
        })
        .collect();
    areas.sort_by(|(.., [one, _]), (.., [other, _])| one.x.total_cmp(&other.x));
    let mut pairs: Vec<(f64, [usize; 2])> = Vec::new();
    for (rank, (one, area, [low, high])) in areas.iter().enumerate() {
        for (other, near, [near_low, near_high]) in &areas[rank + 1..] {
            if near_low.x >= high.x {
                break;
            } else if near_low.y < high.y && near_high.y > low.y {
                let left: f64 = area.without(std::slice::from_ref(near)).iter().map(Polygon::area).sum();
                if area.area() - left > LEAST {
                    pairs.push((area.area() - left, [*one.min(other), *one.max(other)]));
                }
            }
        }
    }
    pairs.sort_by(|one, other| other.0.total_cmp(&one.0).then(one.1.cmp(&other.1)));
    let (common, pair) = pairs.first()?;
    let [one, other] = pair.map(|index| &blocks[index].id);
    let more = match pairs.len() - 1 {
        0 => String::new(),
        1 => ", and one more pair of blocks does".into(),
        count => format!(", and {count} more pairs of blocks do"),
    };
    let text = format!(
        "network:lots: the blocks {one:?} and {other:?} have {common:.2} m² in common{more}: their lots overlap"
    );
    Some(
        Warning::new(WarningKind::Doubtful, text)
            .help("give blocks that are beside each other: one:difference(other)"),
    )
}
