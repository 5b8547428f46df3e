//! Search for pairs of edges whose bounding boxes intersect.

use burgeon_base::error::Result;
use burgeon_base::work::WorkLimits;
use glam::DVec2;
use rstar::{AABB, RTree, RTreeObject};

/// Minimum number of candidates for the search with a tree, and the minimum mean number of candidates that
/// overlap each one along an axis.
const MANY: usize = 600;
const MANY_BESIDE: f64 = 160.0;

/// Number of pairs between two checks for cancellation.
const PAIRS: usize = 1024;

/// Bounding box of an edge or a point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Candidate {
    pub(super) low: DVec2,
    pub(super) high: DVec2,
    /// Index of the edge, or node of the point.
    pub(super) index: u32,
    /// Marks a candidate that has not been compared with the others.
    pub(super) is_fresh: bool,
    pub(super) is_point: bool,
}

impl RTreeObject for Candidate {
    type Envelope = AABB<[f64; 2]>;

    fn envelope(&self) -> Self::Envelope {
        AABB::from_corners(self.low.to_array(), self.high.to_array())
    }
}

impl Candidate {
    fn key(&self) -> (bool, u32) {
        (self.is_point, self.index)
    }
}

/// Calls `each` with all pairs of which one is fresh and whose bounding boxes are within `near` of each
/// other.
///
/// The order depends only on the candidates. Fails if the work of this thread is cancelled.
pub(super) fn for_pairs(
    candidates: &mut Vec<Candidate>,
    near: f64,
    limits: &WorkLimits,
    mut each: impl FnMut(&Candidate, &Candidate),
) -> Result<()> {
    let mut count = 0_usize;
    let mut poll = || {
        count += 1;
        if count.is_multiple_of(PAIRS) { limits.check() } else { Ok(()) }
    };
    limits.check()?;
    if candidates.iter().any(|it| !it.is_fresh) {
        (0..2).for_each(|axis| keep_beside_fresh(candidates, near, axis));
    }
    // Sort along the axis on which the candidates overlap less.
    let sum = candidates.iter().fold(DVec2::ZERO, |sum, it| sum + (it.high - it.low));
    let axis = usize::from(sum.x > sum.y);
    let low = candidates.iter().fold(f64::INFINITY, |low, it| low.min(it.low[axis]));
    let high = candidates.iter().fold(f64::NEG_INFINITY, |high, it| high.max(it.high[axis]));
    if candidates.len() >= MANY && sum[axis] > MANY_BESIDE * (high - low) {
        let tree = RTree::bulk_load(candidates.clone());
        let mut others: Vec<Candidate> = Vec::new();
        for one in candidates.iter().filter(|it| it.is_fresh) {
            let around = AABB::from_corners((one.low - near).to_array(), (one.high + near).to_array());
            others.clear();
            // Pairs of two fresh candidates are compared once.
            others.extend(
                tree.locate_in_envelope_intersecting(&around)
                    .filter(|two| !two.is_fresh || two.key() > one.key()),
            );
            others.sort_unstable_by_key(Candidate::key);
            for two in &others {
                poll()?;
                each(one, two);
            }
        }
        return Ok(());
    }
    candidates.sort_unstable_by(|a, b| a.low[axis].total_cmp(&b.low[axis]).then(a.key().cmp(&b.key())));
    let other = 1 - axis;
    for (number, one) in candidates.iter().enumerate() {
        let [below, beyond] = [one.low[other] - near, one.high[other] + near];
        let last = one.high[axis] + near;
        for two in candidates[number + 1..].iter().take_while(|two| two.low[axis] <= last) {
            if two.low[other] <= beyond && below <= two.high[other] && (one.is_fresh || two.is_fresh) {
                poll()?;
                each(one, two);
            }
        }
    }
    Ok(())
}

/// Removes candidates that are not fresh and do not overlap a fresh candidate along an axis.
fn keep_beside_fresh(candidates: &mut Vec<Candidate>, near: f64, axis: usize) {
    let fresh = candidates.iter().filter(|it| it.is_fresh);
    let mut spans: Vec<[f64; 2]> = fresh.map(|it| [it.low[axis] - near, it.high[axis] + near]).collect();
    spans.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
    spans.dedup_by(|next, last| {
        let joins = next[0] <= last[1];
        if joins {
            last[1] = last[1].max(next[1]);
        }
        joins
    });
    candidates.retain(|it| {
        let first = spans.partition_point(|span| span[1] < it.low[axis]);
        it.is_fresh || spans.get(first).is_some_and(|span| span[0] <= it.high[axis])
    });
}
