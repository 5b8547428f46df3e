//! Snapping of positions that are almost equal: adjacent vertices, ends just before another line, and vertices next to
//! a line.

use rstar::primitives::{GeomWithData, Line as IndexLine};
use rstar::{AABB, RTree};
use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::strand::StreetStrand;
use crate::plan::grid::{GridPlace, PER_METRE, WholePlace, foot};
use burgeon_geometry::planar;
use glam::DVec2;

/// Maximum distance (m) between a street and its input line, except at an end that is moved onto another street.
const TOLERANCE: f64 = 0.1;
/// Snap distance (m) between vertices, and between a line and a vertex.
const NEAR: f64 = 0.03;
/// Snap distance (m) between the end of a line and another line.
pub(super) const END: f64 = 0.5;

/// Merges positions that are almost equal, and removes vertices without effect.
pub(super) fn snap(strands: &mut [StreetStrand]) {
    unite_vertices(strands);
    simplify(strands);
    lead_ends(strands);
    lead_past_vertices(strands);
    for strand in strands {
        strand.places.dedup();
    }
}

/// Known vertices, by level and cell.
#[derive(Default)]
struct KnownVertices {
    cells: FxHashMap<(i32, [i64; 2]), SmallVec<[GridPlace; 2]>>,
}

impl KnownVertices {
    #[allow(clippy::cast_possible_truncation, reason = "a cell is some dozens of steps wide")]
    fn cell(place: GridPlace) -> [i64; 2] {
        let wide = (NEAR * PER_METRE).ceil() as i64;
        place.steps().map(|steps| steps.div_euclid(wide))
    }

    /// Returns the nearest known vertex of a level within `NEAR` of a position.
    fn nearest_vertex(&self, level: i32, place: GridPlace) -> Option<GridPlace> {
        let [x, y] = Self::cell(place);
        let around = (-1..=1).flat_map(|east| (-1..=1).map(move |north| [x + east, y + north]));
        let known = around.filter_map(|cell| self.cells.get(&(level, cell))).flatten().copied();
        let distance = |other: GridPlace| other.metres().distance(place.metres());
        let near = known.map(|other| (distance(other), other)).filter(|(distance, _)| *distance <= NEAR);
        near.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))).map(|(_, other)| other)
    }

    fn add(&mut self, level: i32, place: GridPlace) {
        self.cells.entry((level, Self::cell(place))).or_default().push(place);
    }
}

fn unite_vertices(strands: &mut [StreetStrand]) {
    let mut levels: Vec<i32> = strands.iter().map(|strand| strand.level).collect();
    levels.sort_unstable_by_key(|level| (level.abs(), *level));
    levels.dedup();
    let mut known = KnownVertices::default();
    for StreetStrand { level, places, .. } in strands {
        let last = places.len() - 1;
        for (index, place) in places.iter_mut().enumerate() {
            let mut found = known.nearest_vertex(*level, *place);
            if found.is_none() && (index == 0 || index == last) {
                // A bridge may end at a vertex of a street of another level.
                found = levels.iter().find_map(|other| known.nearest_vertex(*other, *place));
            }
            match found {
                Some(found) => *place = found,
                None => known.add(*level, *place),
            }
        }
        places.dedup();
    }
}

/// Counts the uses of each vertex by strands; a strand that uses a vertex twice counts twice.
fn uses(strands: &[StreetStrand]) -> FxHashMap<GridPlace, u32> {
    let mut uses = FxHashMap::default();
    for place in strands.iter().flat_map(|strand| &strand.places) {
        *uses.entry(*place).or_default() += 1;
    }
    uses
}

/// Removes vertices that belong to a single strand and are within the tolerance of the simplified line.
fn simplify(strands: &mut [StreetStrand]) {
    let uses = uses(strands);
    for strand in strands {
        let mut kept: Vec<GridPlace> = Vec::new();
        let mut part: Vec<GridPlace> = Vec::new();
        let last = strand.places.len() - 1;
        for (index, place) in strand.places.iter().enumerate() {
            part.push(*place);
            if index == last || (index > 0 && uses.get(place).is_some_and(|count| *count > 1)) {
                let aside = |place: GridPlace, ends: [GridPlace; 2]| {
                    foot(place.metres(), ends.map(GridPlace::metres)).0
                };
                let simple = planar::simplified(&part, TOLERANCE, aside);
                kept.extend(simple);
                part = vec![*place];
            }
        }
        kept.dedup();
        strand.places = kept;
    }
}

/// Vertices to add to strands: strand, segment, parameter along the segment (0 to 1), and position.
type NewVertices = Vec<(usize, usize, f64, GridPlace)>;

fn add_vertices(strands: &mut [StreetStrand], mut added: NewVertices) {
    added.sort_by(|a, b| (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2)).then(a.3.cmp(&b.3)));
    for (strand, segment, _, place) in added.into_iter().rev() {
        strands[strand].places.insert(segment + 1, place);
    }
    for strand in strands {
        strand.places.dedup();
    }
}

type SegmentIndex = RTree<GeomWithData<IndexLine<[f64; 2]>, (usize, usize)>>;

fn segments(strands: &[StreetStrand]) -> SegmentIndex {
    let all = strands.iter().enumerate().flat_map(|(number, strand)| {
        strand.places.windows(2).enumerate().map(move |(segment, pair)| {
            let [a, b] = [pair[0], pair[1]].map(|end| end.metres().to_array());
            GeomWithData::new(IndexLine::new(a, b), (number, segment))
        })
    });
    RTree::bulk_load(all.collect())
}

fn search_box(at: DVec2, margin: f64) -> AABB<[f64; 2]> {
    AABB::from_corners((at - margin).to_array(), (at + margin).to_array())
}

/// Moves ends that no other strand shares onto the nearest line within [`END`].
fn lead_ends(strands: &mut [StreetStrand]) {
    let uses = uses(strands);
    let index = segments(strands);
    let mut added = NewVertices::new();
    let mut moved: Vec<(usize, bool, GridPlace)> = Vec::new();
    for (number, strand) in strands.iter().enumerate() {
        let last = strand.places.len() - 1;
        for is_last in [false, true] {
            let end = strand.places[if is_last { last } else { 0 }];
            let beside = strand.places[if is_last { last.saturating_sub(1) } else { 1.min(last) }];
            if uses.get(&end).is_some_and(|count| *count > 1) {
                continue;
            }
            let own = if is_last { last.saturating_sub(1) } else { 0 };
            let at = end.metres();
            let near = index.locate_in_envelope_intersecting(&search_box(at, END)).filter_map(|item| {
                let (other, segment) = item.data;
                let level = strands[other].level;
                let fits = level == strand.level || (strand.level != 0 && level == 0);
                if !fits || (other == number && segment == own) {
                    return None;
                }
                let line = [segment, segment + 1].map(|vertex| strands[other].places[vertex].metres());
                let (distance, along) = foot(at, line);
                (distance <= END).then_some((distance, other, segment, along, line))
            });
            let nearest = near.min_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
            let Some((_, other, segment, along, [from, to])) = nearest else { continue };
            let at = from.lerp(to, along);
            let ends = [segment, segment + 1].map(|vertex| strands[other].places[vertex]);
            let target = ends.into_iter().find(|end| end.metres().distance(at) <= NEAR);
            let Some(place) = target.or_else(|| GridPlace::nearest(at)) else { continue };
            if place == beside {
                continue;
            }
            moved.push((number, is_last, place));
            if target.is_none() {
                added.push((other, segment, along, place));
            }
        }
    }
    for (number, is_last, place) in moved {
        let places = &mut strands[number].places;
        let end = if is_last { places.len() - 1 } else { 0 };
        places[end] = place;
    }
    add_vertices(strands, added);
}

/// Routes lines through the vertices of other lines within [`NEAR`], so no segment is shorter than that.
fn lead_past_vertices(strands: &mut [StreetStrand]) {
    let index = segments(strands);
    let mut added = NewVertices::new();
    for strand in strands.iter() {
        for place in &strand.places {
            let at = place.metres();
            for item in index.locate_in_envelope_intersecting(&search_box(at, NEAR)) {
                let (other, segment) = item.data;
                let ends = [segment, segment + 1].map(|vertex| strands[other].places[vertex]);
                if strands[other].level != strand.level || ends.contains(place) {
                    continue;
                }
                let (distance, along) = foot(at, ends.map(GridPlace::metres));
                if distance <= NEAR && along > 0.0 && along < 1.0 {
                    added.push((other, segment, along, *place));
                }
            }
        }
    }
    added.sort_by_key(|(strand, segment, _, place)| (*strand, *segment, *place));
    added.dedup_by(|a, b| (a.0, a.1, a.3) == (b.0, b.1, b.3));
    add_vertices(strands, added);
}
