//! The detection of areas to divide that overlap.

use burgeon_base::warning::{Warning, WarningKind};
use burgeon_streets::StreetBlock;
use glam::DVec2;

/// Maximum common area (m²) of adjacent blocks that do not overlap.
const LEAST: f64 = 0.01;
/// Maximum number of overlapping pairs to count, because each pair takes time and more pairs add no information.
const MOST: usize = 100;
/// Maximum number of pairs with intersecting boxes to compare: thousands of nested blocks have millions of pairs.
const MOST_COMPARED: usize = 100_000;

/// Returns the warning about blocks whose lots overlap.
pub(super) fn overlapping(blocks: &[&StreetBlock]) -> Option<Warning> {
    let mut areas: Vec<(&StreetBlock, [DVec2; 2])> =
        blocks.iter().map(|block| (*block, bounds(block))).collect();
    areas.sort_by(|(_, [one, _]), (_, [other, _])| one.x.total_cmp(&other.x));
    let (mut count, mut compared) = (0, 0);
    let mut greatest: Option<(f64, &str, &str)> = None;
    'blocks: for (rank, (one, [low, high])) in areas.iter().enumerate() {
        for (other, [near_low, near_high]) in &areas[rank + 1..] {
            if near_low.x >= high.x {
                break;
            } else if near_low.y < high.y && near_high.y > low.y {
                compared += 1;
                if compared > MOST_COMPARED {
                    break 'blocks;
                }
                let common = one.common_area(other);
                if common > LEAST {
                    count += 1;
                    if greatest.is_none_or(|(most, ..)| common > most) {
                        greatest = Some((common, &one.id, &other.id));
                    }
                    if count == MOST {
                        break 'blocks;
                    }
                }
            }
        }
    }
    let Some((common, one, other)) = greatest else {
        // The pairs that were not compared may overlap.
        let text =
            format!("network:lots: of blocks around one another, only {MOST_COMPARED} pairs were compared");
        let help = "divide fewer blocks at once, and check that none overlap: one:intersection(other):area()";
        return (compared > MOST_COMPARED).then(|| Warning::new(WarningKind::Doubtful, text).help(help));
    };
    let more = match count - 1 {
        0 => String::new(),
        1 => ", and one more pair of blocks overlaps".into(),
        _ if count == MOST || compared > MOST_COMPARED => {
            format!(", and at least {} more pairs of blocks overlap", count - 1)
        }
        more => format!(", and {more} more pairs of blocks overlap"),
    };
    let text = format!(
        "network:lots: the blocks {one:?} and {other:?} overlap by {common:.2} m²{more}, so lots overlap"
    );
    Some(
        Warning::new(WarningKind::Doubtful, text)
            .help("use blocks that do not overlap: one:difference(other)"),
    )
}

fn bounds(block: &StreetBlock) -> [DVec2; 2] {
    let start = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    block.rings.iter().flatten().fold(start, |[low, high], at| [low.min(*at), high.max(*at)])
}
