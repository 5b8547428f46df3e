//! Geometries near a selection of others.

use glam::DVec2;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

/// Minimum and maximum coordinates (m) of a geometry, horizontally.
pub type BoundingBox = [DVec2; 2];

/// Returns for each bounding box whether it lies within `reach` (m) of the box of a selected geometry, horizontally and
/// along each axis. A geometry without a box is near nothing.
pub fn near_selection(
    bounds: &[Option<[DVec2; 2]>],
    selected: impl Fn(usize) -> bool,
    reach: f64,
) -> Vec<bool> {
    let envelope = |[low, high]: BoundingBox, margin: f64| {
        AABB::from_corners((low - margin).to_array(), (high + margin).to_array())
    };
    let boxes = bounds.iter().enumerate();
    let boxes = boxes.filter_map(|(index, bounds)| {
        let corners = envelope((*bounds)?, 0.0);
        Some(GeomWithData::new(Rectangle::from_aabb(corners), index))
    });
    let tree = RTree::bulk_load(boxes.collect());
    let mut near = vec![false; bounds.len()];
    for (_, bounds) in bounds.iter().enumerate().filter(|(index, _)| selected(*index)) {
        if let Some(bounds) = bounds {
            let found = tree.locate_in_envelope_intersecting(&envelope(*bounds, reach));
            found.for_each(|other| near[other.data] = true);
        }
    }
    near
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
            let near = near_selection(&bounds, selected, reach);
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
