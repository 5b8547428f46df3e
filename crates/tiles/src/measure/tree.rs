//! Tree of boxes around triangles, for the nearest triangle of a point.

use glam::{DVec3, Vec3};

/// Corners (m) of a triangle.
pub(super) type TriangleCorners = [DVec3; 3];

/// Largest number of triangles in a box that is not divided.
const FEW: usize = 8;

/// TreeBounds (m) of points along the axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct TreeBounds {
    pub low: DVec3,
    pub high: DVec3,
}

impl TreeBounds {
    /// Returns the bounds of points; `None` without points.
    pub(super) fn of(points: impl IntoIterator<Item = DVec3>) -> Option<Self> {
        let grow = |Self { low, high }: Self, point| Self { low: low.min(point), high: high.max(point) };
        let mut points = points.into_iter();
        let first = points.next()?;
        Some(points.fold(Self { low: first, high: first }, grow))
    }

    /// Returns the largest difference (m) from others along an axis. The point that is farthest along it has at least this distance
    /// from the others.
    pub(super) fn difference(&self, other: &Self) -> f64 {
        (self.low - other.low).abs().max((self.high - other.high).abs()).max_element()
    }
}

/// Triangles in a tree of boxes.
///
/// ```
/// use burgeon_tiles::measure::TriangleTree;
/// use glam::DVec3;
///
/// let tree = TriangleTree::new(vec![[DVec3::ZERO, DVec3::X, DVec3::Y]]);
/// assert_eq!(tree.nearest(DVec3::new(0.2, 0.2, 3.0), 0.0), Some((3.0, 0)));
/// ```
#[derive(Debug, Clone, Default)]
pub struct TriangleTree {
    triangles: Vec<TriangleCorners>,
    boxes: Vec<TriangleBox>,
}

/// Box around triangles.
#[derive(Debug, Clone, Copy)]
struct TriangleBox {
    low: DVec3,
    high: DVec3,
    /// First triangle, and the number of triangles.
    first: usize,
    count: usize,
    /// Second half of the box; the first half follows the box. 0 if the box is not divided.
    second: usize,
}

impl TriangleBox {
    /// Returns the square of the distance (m²) of a point from the box.
    fn distance(&self, point: DVec3) -> f64 {
        (self.low - point).max(point - self.high).max(DVec3::ZERO).length_squared()
    }
}

impl TriangleTree {
    /// Builds the tree.
    pub fn new(triangles: Vec<TriangleCorners>) -> Self {
        let mut items: Vec<TreeItem> = triangles.iter().zip(0..).map(TreeItem::new).collect();
        let mut boxes = Vec::with_capacity(triangles.len());
        if !triangles.is_empty() {
            divide(&triangles, &mut items, 0, &mut boxes);
        }
        let triangles = items.iter().map(|item| triangles[item.number as usize]).collect();
        Self { triangles, boxes }
    }

    /// Returns the triangles.
    pub fn triangles(&self) -> &[TriangleCorners] {
        &self.triangles
    }

    /// Returns the distance (m) of the nearest triangle from a point, and its number; or of one that is at most `enough` (m) away.
    /// `None` without triangles.
    pub fn nearest(&self, point: DVec3, enough: f64) -> Option<(f64, usize)> {
        let enough = enough.max(0.0) * enough.max(0.0);
        let mut best = (f64::INFINITY, None);
        // A tree of 2^32 triangles has this depth, and each level leaves one half open.
        let mut open = [(0.0, 0_usize); 64];
        let mut count = 1;
        while count > 0 && best.0 > enough {
            count -= 1;
            let (distance, index) = open[count];
            let Some(inner) = self.boxes.get(index).filter(|_| distance < best.0) else { continue };
            if inner.second == 0 {
                for number in inner.first..inner.first + inner.count {
                    let distance = distance_squared(&self.triangles[number], point);
                    if distance < best.0 {
                        best = (distance, Some(number));
                    }
                }
                continue;
            }
            let halves = [index + 1, inner.second].map(|half| (self.boxes[half].distance(point), half));
            // The nearer half is taken first.
            let [a, b] = halves;
            for half in if a.0 < b.0 { [b, a] } else { [a, b] } {
                if let Some(place) = open.get_mut(count).filter(|_| half.0 < best.0) {
                    (*place, count) = (half, count + 1);
                }
            }
        }
        best.1.map(|number| (best.0.sqrt(), number))
    }

    /// Returns the triangles whose boxes are at most `distance` (m) from the box around a triangle; `None` if they are more than
    /// `most`.
    pub(super) fn near(
        &self,
        corners: &TriangleCorners,
        distance: f64,
        most: usize,
    ) -> Option<Vec<TriangleCorners>> {
        let [a, b, c] = *corners;
        let (low, high) = (a.min(b).min(c) - distance, a.max(b).max(c) + distance);
        let meets =
            |other_low: DVec3, other_high: DVec3| low.cmple(other_high).all() && other_low.cmple(high).all();
        let mut found = Vec::new();
        let mut open = if self.boxes.is_empty() { Vec::new() } else { vec![0] };
        while let Some(index) = open.pop() {
            let inner = &self.boxes[index];
            if !meets(inner.low, inner.high) {
                continue;
            }
            match self.halves(index) {
                Some([first, second]) => open.extend([second, first]),
                None => found.extend(
                    self.in_box(index).iter().filter(|[a, b, c]| meets(a.min(*b).min(*c), a.max(*b).max(*c))),
                ),
            }
            if found.len() > most {
                return None;
            }
        }
        Some(found)
    }

    /// Returns the halves of a box; `None` if it is not divided.
    pub(super) fn halves(&self, index: usize) -> Option<[usize; 2]> {
        let second = self.boxes[index].second;
        (second > 0).then_some([index + 1, second])
    }

    /// Returns the triangles in a box.
    pub(super) fn in_box(&self, index: usize) -> &[TriangleCorners] {
        let TriangleBox { first, count, .. } = self.boxes[index];
        &self.triangles[first..first + count]
    }

    /// Returns the corners of a box, the lowest first and the highest last.
    pub(super) fn box_corners(&self, index: usize) -> [DVec3; 8] {
        let TriangleBox { low, high, .. } = self.boxes[index];
        std::array::from_fn(|corner| {
            let of = |axis: usize| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] };
            DVec3::new(of(0), of(1), of(2))
        })
    }

    /// Returns the diagonal (m) of the box around all triangles.
    pub fn diagonal(&self) -> f64 {
        self.boxes.first().map_or(0.0, |whole| (whole.high - whole.low).length())
    }
}

/// Place of a triangle, by which it is put into a half of a box: small, because it is moved at each level of the tree.
#[derive(Clone, Copy)]
struct TreeItem {
    /// Sum of the corners.
    sum: Vec3,
    number: u32,
}

impl TreeItem {
    fn new((corners, number): (&TriangleCorners, u32)) -> Self {
        Self { sum: corners.iter().sum::<DVec3>().as_vec3(), number }
    }
}

/// Adds the boxes around the triangles of some items, the first of which has the index `first`, and returns the bounds of all.
fn divide(
    triangles: &[TriangleCorners],
    items: &mut [TreeItem],
    first: usize,
    boxes: &mut Vec<TriangleBox>,
) -> TreeBounds {
    let (index, count) = (boxes.len(), items.len());
    boxes.push(TriangleBox { low: DVec3::ZERO, high: DVec3::ZERO, first, count, second: 0 });
    let bounds = if count <= FEW {
        TreeBounds::of(items.iter().flat_map(|item| triangles[item.number as usize]))
            .unwrap_or(TreeBounds { low: DVec3::ZERO, high: DVec3::ZERO })
    } else {
        let (low, high) = items.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), item| {
            (low.min(item.sum), high.max(item.sum))
        });
        let size = high - low;
        let axis = if size.x >= size.y && size.x >= size.z { 0 } else { 1 + usize::from(size.z > size.y) };
        let middle = count / 2;
        items.select_nth_unstable_by(middle, |a, b| a.sum[axis].total_cmp(&b.sum[axis]));
        let (lower, upper) = items.split_at_mut(middle);
        let a = divide(triangles, lower, first, boxes);
        boxes[index].second = boxes.len();
        let b = divide(triangles, upper, first + middle, boxes);
        TreeBounds { low: a.low.min(b.low), high: a.high.max(b.high) }
    };
    (boxes[index].low, boxes[index].high) = (bounds.low, bounds.high);
    bounds
}

/// Returns the square of the distance (m²) of a point from a triangle.
///
/// Method: the region of the triangle's plane that contains the point's projection (Ericson, "Real-Time Collision Detection",
/// 2005, section 5.1.5).
pub(super) fn distance_squared(&[a, b, c]: &TriangleCorners, point: DVec3) -> f64 {
    let (ab, ac, ap) = (b - a, c - a, point - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return ap.length_squared();
    }
    let bp = point - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return bp.length_squared();
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let part = if d1 - d3 > 0.0 { d1 / (d1 - d3) } else { 0.0 };
        return (ap - ab * part).length_squared();
    }
    let cp = point - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return cp.length_squared();
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let part = if d2 - d6 > 0.0 { d2 / (d2 - d6) } else { 0.0 };
        return (ap - ac * part).length_squared();
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        let whole = (d4 - d3) + (d5 - d6);
        let part = if whole > 0.0 { (d4 - d3) / whole } else { 0.0 };
        return (bp - (c - b) * part).length_squared();
    }
    let sum = va + vb + vc;
    if sum > 0.0 { (ap - ab * (vb / sum) - ac * (vc / sum)).length_squared() } else { ap.length_squared() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = DVec3> {
        (-10.0..10.0_f64, -10.0..10.0_f64, -10.0..10.0_f64).prop_map(|(x, y, z)| DVec3::new(x, y, z))
    }

    proptest! {
        #[test]
        fn the_distance_is_the_least_over_the_points_of_the_triangle(
            corners in prop::array::uniform3(point()), place in point(),
        ) {
            let [a, b, c] = corners;
            let distance = distance_squared(&corners, place).sqrt();
            let mut least = f64::INFINITY;
            for i in 0..=60 {
                for j in 0..=60 - i {
                    let (u, v) = (f64::from(i) / 60.0, f64::from(j) / 60.0);
                    least = least.min((a + (b - a) * u + (c - a) * v - place).length());
                }
            }
            let step = ((b - a).length() + (c - a).length()) / 60.0;
            prop_assert!(distance <= least + 1e-9 && least <= distance + step, "{distance} {least}");
        }

        #[test]
        fn the_nearest_triangle_of_the_tree_is_that_of_a_search_through_all(
            triangles in prop::collection::vec(prop::array::uniform3(point()), 0..60), place in point(),
        ) {
            let tree = TriangleTree::new(triangles);
            let all = tree.triangles().iter().map(|corners| distance_squared(corners, place).sqrt());
            let least = all.reduce(f64::min);
            let found = tree.nearest(place, 0.0);
            prop_assert_eq!(found.map(|(distance, _)| distance), least);
            if let Some((distance, number)) = found {
                prop_assert_eq!(distance_squared(&tree.triangles()[number], place).sqrt(), distance);
                let near = tree.nearest(place, 4.0).unwrap().0;
                prop_assert!(near == distance || near <= 4.0);
            }
        }
    }
}
