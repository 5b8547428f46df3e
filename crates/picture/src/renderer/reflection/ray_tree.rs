//! Tree of boxes, in which a ray finds the items that it may meet.

use glam::Vec3A;

/// Maximum number of items in a leaf.
const LEAF: usize = 4;
/// Maximum depth of a tree. Each level halves the items, so 32 levels hold more than can be numbered.
const DEEPEST: usize = 64;

/// Minimum and maximum corner of a box.
pub(super) type RayBox = [Vec3A; 2];

/// Binary tree of boxes along the axes.
#[derive(Debug)]
pub(super) struct RayTree {
    nodes: Vec<TreePart>,
    /// Numbers of the items, those of each leaf together.
    order: Vec<u32>,
}

/// Part of a tree: a leaf with items, or two smaller parts.
#[derive(Debug, Clone, Copy)]
struct TreePart {
    corners: RayBox,
    /// Index of the first item in the order, or of the first of both parts.
    first: u32,
    /// Number of items; 0 if there are parts.
    count: u32,
}

impl RayTree {
    /// Creates the tree of items with these boxes. Items whose box is not finite are never found.
    ///
    /// Method: median split of the centres along the longest axis.
    pub(super) fn new(boxes: &[RayBox]) -> Self {
        let finite = |item: &u32| boxes[*item as usize].iter().all(|corner| corner.is_finite());
        let mut order: Vec<u32> = (0..boxes.len() as u32).filter(finite).collect();
        let mut nodes = vec![TreePart { corners: [Vec3A::ZERO; 2], first: 0, count: 0 }];
        let mut open = vec![(0, 0..order.len())];
        while let Some((node, range)) = open.pop() {
            let items = &mut order[range.clone()];
            let hull = |of: &dyn Fn(u32) -> RayBox| {
                let none = [Vec3A::INFINITY, Vec3A::NEG_INFINITY];
                items.iter().fold(none, |[low, high], item| {
                    let [a, b] = of(*item);
                    [low.min(a), high.max(b)]
                })
            };
            let center = |item: u32| boxes[item as usize][0] + boxes[item as usize][1];
            let corners = hull(&|item| boxes[item as usize]);
            let [low, high] = hull(&|item| [center(item); 2]);
            if items.len() <= LEAF {
                nodes[node] = TreePart { corners, first: range.start as u32, count: items.len() as u32 };
                continue;
            }
            let size = high - low;
            let axis = (0..3).max_by(|a, b| size[*a].total_cmp(&size[*b])).unwrap_or(0);
            let middle = items.len() / 2;
            items.select_nth_unstable_by(middle, |a, b| {
                center(*a)[axis].total_cmp(&center(*b)[axis]).then(a.cmp(b))
            });
            let first = nodes.len();
            nodes[node] = TreePart { corners, first: first as u32, count: 0 };
            nodes.extend([TreePart { corners, first: 0, count: 0 }; 2]);
            open.push((first, range.start..range.start + middle));
            open.push((first + 1, range.start + middle..range.end));
        }
        Self { nodes, order }
    }

    /// Returns the box of all items.
    pub(super) fn corners(&self) -> RayBox {
        self.nodes[0].corners
    }

    /// Calls `test` with the items whose boxes a ray meets before the distance `nearest`, nearer boxes first. `test` may lower
    /// the distance. The ray need not have unit length, which is the unit of distances.
    pub(super) fn each(
        &self,
        origin: Vec3A,
        direction: Vec3A,
        nearest: &mut f32,
        mut test: impl FnMut(u32, &mut f32),
    ) {
        let steep = Vec3A::select(direction.abs().cmplt(Vec3A::splat(1e-20)), Vec3A::splat(1e-20), direction);
        let inverse = steep.recip();
        let enter = |part: &TreePart| {
            let [low, high] = part.corners.map(|corner| (corner - origin) * inverse);
            let (from, to) = (low.min(high).max_element().max(0.0), low.max(high).min_element());
            if from <= to { from } else { f32::INFINITY }
        };
        let mut waiting = [(0_u32, 0.0_f32); DEEPEST];
        let mut count = usize::from(enter(&self.nodes[0]) < *nearest);
        while count > 0 {
            count -= 1;
            let (index, distance) = waiting[count];
            if distance >= *nearest {
                continue;
            }
            let part = self.nodes[index as usize];
            if part.count > 0 {
                let items = &self.order[part.first as usize..(part.first + part.count) as usize];
                items.iter().for_each(|item| test(*item, nearest));
                continue;
            }
            let Some([a, b]) = self.nodes.get(part.first as usize..).and_then(|parts| parts.first_chunk())
            else {
                continue;
            };
            let mut parts = [(part.first, enter(a)), (part.first + 1, enter(b))];
            // The part that waits last is visited first.
            if parts[0].1 < parts[1].1 {
                parts.swap(0, 1);
            }
            for (index, distance) in parts {
                if distance < *nearest && count < DEEPEST {
                    waiting[count] = (index, distance);
                    count += 1;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::points::spread;
    use super::*;

    #[test]
    fn a_ray_finds_the_same_nearest_box_as_a_search_of_all() {
        let boxes: Vec<RayBox> = (0..500)
            .map(|i| {
                let at = spread(i, 500).as_vec3a() * (1.0 + (i % 7) as f32);
                [at - 0.2, at + 0.2]
            })
            .collect();
        let tree = RayTree::new(&boxes);
        let mut met = 0;
        for i in 0..300 {
            let (origin, target) =
                (spread(i, 300).as_vec3a() * 12.0, spread(i * 7 % 300, 300).as_vec3a() * 4.0);
            let direction = (target - origin).normalize();
            let enter = |[low, high]: RayBox| {
                let (a, b) = ((low - origin) / direction, (high - origin) / direction);
                let (from, to) = (a.min(b).max_element().max(0.0), a.max(b).min_element());
                if from <= to { from } else { f32::INFINITY }
            };
            let expected = boxes.iter().map(|corners| enter(*corners)).fold(f32::INFINITY, f32::min);
            let mut nearest = f32::INFINITY;
            tree.each(origin, direction, &mut nearest, |item, nearest| {
                *nearest = nearest.min(enter(boxes[item as usize]));
            });
            assert!((nearest - expected).abs() < 1e-4 || nearest == expected, "{nearest} {expected}");
            met += usize::from(nearest.is_finite());
        }
        assert!(met > 50, "{met} rays meet a box");
    }

    #[test]
    fn a_tree_of_nothing_and_a_box_that_is_not_finite_are_never_met() {
        for boxes in [vec![], vec![[Vec3A::NAN; 2]]] {
            let mut count = 0;
            RayTree::new(&boxes).each(Vec3A::NEG_X, Vec3A::X, &mut f32::MAX.clone(), |_, _| count += 1);
            assert_eq!(count, 0);
        }
    }
}
