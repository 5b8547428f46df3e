//! Geometries near a selection of others.

use burgeon_base::Stop;
use burgeon_base::error::Result;
use glam::DVec2;
use rstar::primitives::Rectangle;
use rstar::{AABB, RTree};

/// Number of geometries between two checks of the stop of the run.
const STRETCH: usize = 4096;

/// Minimum and maximum coordinates (m) of a geometry, horizontally.
pub type BoundingBox = [DVec2; 2];

/// Returns the point that decides to which cell of a grid a geometry with these bounds belongs: their centre.
pub fn representative_point([low, high]: BoundingBox) -> [f64; 2] {
    low.midpoint(high).to_array()
}

/// Returns for each bounding box whether it lies within `reach` (m) of the box of a selected geometry, horizontally and
/// along each axis. A geometry without a box is near nothing. Fails if the current work is stopped.
///
/// ```
/// use burgeon_spatial::{Geometry, near_selection};
///
/// let points = ["POINT (0 0)", "POINT (3 0)", "POINT (90 0)", "POINT EMPTY"].map(Geometry::from_wkt);
/// let bounds: Vec<_> = points.into_iter().flatten().map(|point| point.bounds()).collect();
/// assert_eq!(near_selection(&bounds, |index| index == 0, 5.0)?, [true, true, false, false]);
/// # Ok::<(), burgeon_base::Error>(())
/// ```
pub fn near_selection(
    bounds: &[Option<BoundingBox>],
    selected: impl Fn(usize) -> bool,
    reach: f64,
) -> Result<Vec<bool>> {
    let boxes = bounds.iter().enumerate().filter(|(index, _)| selected(*index));
    let boxes = boxes.filter_map(|(_, bounds)| {
        let [low, high] = (*bounds)?;
        Some(Rectangle::from_corners((low - reach).to_array(), (high + reach).to_array()))
    });
    let tree = RTree::bulk_load(boxes.collect());
    let mut near = Vec::with_capacity(bounds.len());
    for (index, bounds) in bounds.iter().enumerate() {
        if index.is_multiple_of(STRETCH) {
            Stop::check_current()?;
        }
        near.push(bounds.is_some_and(|[low, high]| {
            let envelope = AABB::from_corners(low.to_array(), high.to_array());
            tree.locate_in_envelope_intersecting(&envelope).next().is_some()
        }));
    }
    Ok(near)
}

#[cfg(test)]
mod tests {
    use super::*;
    use burgeon_base::random::Stream;

    #[test]
    fn the_boxes_near_a_selection_are_those_that_a_scan_finds() {
        let mut random = Stream::new(3);
        let bounds: Vec<Option<BoundingBox>> = (0..400)
            .map(|index| {
                let low = DVec2::new(random.uniform(), random.uniform()) * 1000.0;
                let size = DVec2::new(random.uniform(), random.uniform()) * 20.0;
                (index % 50 != 7).then_some([low, low + size])
            })
            .collect();
        for reach in [0.0, 5.0, 60.0] {
            let selected = |index: usize| (100..140).contains(&index);
            let near = near_selection(&bounds, selected, reach).expect("not stopped");
            for (index, own) in bounds.iter().enumerate() {
                let is_near = own.is_some_and(|[low, high]| {
                    (100..140)
                        .filter_map(|other| bounds[other])
                        .any(|[from, to]| (low - reach).cmple(to).all() && (high + reach).cmpge(from).all())
                });
                assert_eq!(near[index], is_near, "{index} {reach}");
            }
        }
    }
}
