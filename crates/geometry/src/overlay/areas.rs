//! Set operations on areas.

use burgeon_base::error::Result;
use burgeon_base::work::WorkLimits;
use glam::DVec2;

use super::noding::{LayerWay, WayKind};
use super::pairs::{Candidate, for_pairs};
use super::subdivision::Subdivision;
use crate::planar::Rings;

/// Number of areas that are joined in one step.
const AT_ONCE: usize = 4;

/// An area: polygons, with counter-clockwise outer rings and clockwise holes.
pub type PolygonArea = Vec<Rings<DVec2>>;

/// Fill rule of rings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fill {
    /// Points with a winding number other than zero are inside.
    NonZero,
    /// Points with an odd winding number are inside.
    EvenOdd,
}

/// Returns the rings of polygons as ways of a layer.
pub fn ring_ways(area: &[Rings<DVec2>], layer: usize) -> impl Iterator<Item = LayerWay> + '_ {
    let rings = area.iter().flat_map(|rings| rings.iter());
    rings.map(move |ring| LayerWay { layer, kind: WayKind::Ring, places: ring.clone() })
}

/// Computes the area that rings enclose by a fill rule, as a valid area: rings that cross or touch are
/// divided.
///
/// Fails if the work of this thread is cancelled.
///
/// ```
/// use burgeon_geometry::overlay::{Fill, fill};
/// use burgeon_geometry::{Polygon, Rings};
/// use glam::DVec2;
///
/// // A pentagram: its centre has the winding number 2.
/// let star = (0..5).map(|i| DVec2::from_angle(f64::from(2 * i) * std::f64::consts::TAU / 5.0)).collect();
/// let star = [Rings(vec![star])];
/// assert_eq!(fill(&star, Fill::NonZero)?.len(), 1);
/// assert_eq!(fill(&star, Fill::EvenOdd)?.len(), 5);
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
pub fn fill(area: &[Rings<DVec2>], rule: Fill) -> Result<PolygonArea> {
    let ways: Vec<LayerWay> = ring_ways(area, 0).collect();
    Ok(Subdivision::new(&ways)?.areas(|[around, _]| match rule {
        Fill::NonZero => around != 0,
        Fill::EvenOdd => around % 2 != 0,
    }))
}

/// Computes the area for which `keep` returns true, given membership in the first and in the second area.
///
/// Rings use the non-zero fill rule.
///
/// Fails if the work of this thread is cancelled.
///
/// ```
/// use burgeon_geometry::overlay::overlay;
/// use burgeon_geometry::{Polygon, Rings};
/// use glam::DVec2;
///
/// let square = |at: f64| -> Rings<DVec2> {
///     Rings(vec![[(at, at), (at + 2.0, at), (at + 2.0, at + 2.0), (at, at + 2.0)].map(DVec2::from).to_vec()])
/// };
/// let both = overlay(&[square(0.0)], &[square(1.0)], |[first, second]| first && second)?;
/// let both = Polygon::new(both[0].clone())?;
/// assert_eq!((both.size(), both.area(), both.contains(DVec2::splat(1.5))), (4, 1.0, true));
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
pub fn overlay(
    first: &[Rings<DVec2>],
    second: &[Rings<DVec2>],
    keep: impl Fn([bool; 2]) -> bool,
) -> Result<PolygonArea> {
    let parts: Vec<(usize, &Rings<DVec2>)> =
        first.iter().map(|rings| (0, rings)).chain(second.iter().map(|rings| (1, rings))).collect();
    let mut made = PolygonArea::new();
    for group in groups(parts.iter().map(|(_, rings)| *rings))? {
        let ways: Vec<LayerWay> = group
            .iter()
            .flat_map(|index| ring_ways(std::slice::from_ref(parts[*index].1), parts[*index].0))
            .collect();
        made.extend(Subdivision::new(&ways)?.areas(|around| keep(around.map(|count| count != 0))));
    }
    Ok(made)
}

/// Computes the union of polygons, with the non-zero fill rule for the rings of each polygon.
///
/// Fails if the work of this thread is cancelled.
///
/// Method: polygons whose bounding boxes intersect, directly or through others, are joined in groups of four
/// neighbours, so that covered edges are removed early.
///
/// ```
/// use burgeon_geometry::Rings;
/// use burgeon_geometry::overlay::unite;
/// use glam::DVec2;
///
/// let house = |x: f64| -> Rings<DVec2> {
///     Rings(vec![[(x, 0.0), (x + 1.0, 0.0), (x + 1.0, 5.0), (x, 5.0)].map(DVec2::from).to_vec()])
/// };
/// let row = unite((0..10).map(|x| house(f64::from(x))).collect())?;
/// assert_eq!(row[0][0].len(), 4);
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
pub fn unite(parts: Vec<Rings<DVec2>>) -> Result<PolygonArea> {
    let mut valid = Vec::with_capacity(parts.len());
    for rings in &parts {
        valid.push(fill(std::slice::from_ref(rings), Fill::NonZero)?);
    }
    unite_valid(valid)
}

/// Computes the union of areas, each of which is valid.
pub(super) fn unite_valid(areas: Vec<PolygonArea>) -> Result<PolygonArea> {
    let mut made = PolygonArea::new();
    let owners = owners(&areas);
    let mut all: Vec<Rings<DVec2>> = areas.into_iter().flatten().collect();
    let middles: Vec<DVec2> = all.iter().map(middle).collect();
    // Each polygon is in one group.
    for mut group in groups(all.iter())? {
        if is_of_one(&group, &owners) {
            made.extend(group.into_iter().map(|index| std::mem::take(&mut all[index])));
            continue;
        }
        let low = group.iter().fold(DVec2::INFINITY, |low, index| low.min(middles[*index]));
        let high = group.iter().fold(DVec2::NEG_INFINITY, |high, index| high.max(middles[*index]));
        let axis = usize::from((high - low).y > (high - low).x);
        group.sort_by(|a, b| middles[*a][axis].total_cmp(&middles[*b][axis]));
        let sorted = group.into_iter().map(|index| vec![std::mem::take(&mut all[index])]);
        made.extend(join(sorted.collect())?);
    }
    Ok(made)
}

fn middle(rings: &Rings<DVec2>) -> DVec2 {
    let [low, high] = bounds(rings);
    low.midpoint(high)
}

/// Joins valid areas in groups until one area remains.
fn join(mut areas: Vec<PolygonArea>) -> Result<PolygonArea> {
    while areas.len() > 1 {
        areas = areas.chunks(AT_ONCE).map(join_few).collect::<Result<_>>()?;
    }
    Ok(areas.pop().unwrap_or_default())
}

/// Joins a few valid areas in one step.
fn join_few(areas: &[PolygonArea]) -> Result<PolygonArea> {
    let all: Vec<&Rings<DVec2>> = areas.iter().flatten().collect();
    let owners = owners(areas);
    let mut made = PolygonArea::new();
    for group in groups(all.iter().copied())? {
        if is_of_one(&group, &owners) {
            made.extend(group.into_iter().map(|index| all[index].clone()));
            continue;
        }
        let ways: Vec<LayerWay> =
            group.iter().flat_map(|index| ring_ways(std::slice::from_ref(all[*index]), 0)).collect();
        made.extend(Subdivision::new(&ways)?.areas(|[around, _]| around != 0));
    }
    Ok(made)
}

/// Returns the index of the area of each polygon.
fn owners(areas: &[PolygonArea]) -> Vec<usize> {
    areas.iter().enumerate().flat_map(|(index, area)| std::iter::repeat_n(index, area.len())).collect()
}

/// Returns true if all polygons of a group belong to one area.
fn is_of_one(group: &[usize], owners: &[usize]) -> bool {
    group.windows(2).all(|pair| owners[pair[0]] == owners[pair[1]])
}

fn bounds(rings: &Rings<DVec2>) -> [DVec2; 2] {
    let places = rings.iter().flatten();
    places.fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[low, high], at| [low.min(*at), high.max(*at)])
}

/// Groups polygons whose bounding boxes intersect; returns their indices in order, sorted by the first of
/// each group.
#[allow(clippy::cast_possible_truncation, reason = "fewer polygons than 2^32 fit into memory")]
fn groups<'a>(all: impl Iterator<Item = &'a Rings<DVec2>>) -> Result<Vec<Vec<usize>>> {
    let mut boxes: Vec<Candidate> = all
        .map(bounds)
        .enumerate()
        .map(|(index, [low, high])| Candidate {
            low,
            high,
            index: index as u32,
            is_fresh: true,
            is_point: false,
        })
        .collect();
    let count = boxes.len();
    if count == 1 {
        return Ok(vec![vec![0]]);
    }
    let most = boxes.iter().fold(0.0_f64, |most, it| most.max(it.low.abs().max(it.high.abs()).max_element()));
    // Maximum distance that rounding can move a point from an edge that it should touch.
    let near = 4.0 * f64::EPSILON * most;
    let mut first: Vec<usize> = (0..count).collect();
    fn root(first: &mut [usize], mut index: usize) -> usize {
        while first[index] != index {
            first[index] = first[first[index]];
            index = first[index];
        }
        index
    }
    for_pairs(&mut boxes, near, &WorkLimits::current(), |one, two| {
        let [a, b] = [one, two].map(|it| root(&mut first, it.index as usize));
        first[a.max(b)] = a.min(b);
    })?;
    let mut groups: Vec<Vec<usize>> = vec![Vec::new(); count];
    for index in 0..count {
        let root = root(&mut first, index);
        groups[root].push(index);
    }
    groups.retain(|group| !group.is_empty());
    Ok(groups)
}
