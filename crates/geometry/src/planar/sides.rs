//! Lookup of the triangle to the left of a directed edge.

use rustc_hash::FxHashMap;

/// Maximum number of points for a table of all pairs, which is then smaller and faster than a map.
const FEW: usize = 48;

/// Marker for a side without a triangle.
const NONE: u32 = u32::MAX;

/// Directed sides of triangles, each with its triangle; a later triangle replaces an earlier one.
pub(super) enum Sides {
    Table { points: usize, owners: Vec<u32> },
    Map(FxHashMap<(usize, usize), usize>),
}

impl Sides {
    /// Collects the sides of `triangles` over this number of points.
    pub(super) fn of(triangles: &[[usize; 3]], points: usize) -> Self {
        let mut sides = if points <= FEW {
            Self::Table { points, owners: vec![NONE; points * points] }
        } else {
            Self::Map(FxHashMap::with_capacity_and_hasher(3 * triangles.len(), rustc_hash::FxBuildHasher))
        };
        for (index, &triangle) in triangles.iter().enumerate() {
            sides.add(triangle, index);
        }
        sides
    }

    /// Adds the three sides of a triangle.
    pub(super) fn add(&mut self, [a, b, c]: [usize; 3], triangle: usize) {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            match self {
                Self::Table { points, owners } => {
                    owners[from * *points + to] = u32::try_from(triangle).unwrap_or(NONE);
                }
                Self::Map(owners) => {
                    owners.insert((from, to), triangle);
                }
            }
        }
    }

    /// Removes a side.
    pub(super) fn remove(&mut self, from: usize, to: usize) {
        match self {
            Self::Table { points, owners } => owners[from * *points + to] = NONE,
            Self::Map(owners) => {
                owners.remove(&(from, to));
            }
        }
    }

    /// Returns the triangle with this side.
    pub(super) fn owner(&self, from: usize, to: usize) -> Option<usize> {
        match self {
            Self::Table { points, owners } => {
                Some(owners[from * points + to]).filter(|owner| *owner != NONE).map(|owner| owner as usize)
            }
            Self::Map(owners) => owners.get(&(from, to)).copied(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_side_belongs_to_the_triangle_on_its_left_whatever_the_number_of_points() {
        for points in [4, FEW + 1] {
            let mut sides = Sides::of(&[[0, 1, 2], [0, 2, 3]], points);
            assert_eq!((sides.owner(2, 0), sides.owner(0, 2), sides.owner(1, 0)), (Some(0), Some(1), None));
            sides.remove(2, 0);
            sides.add([2, 1, 3], 5);
            assert_eq!((sides.owner(2, 0), sides.owner(3, 2), sides.owner(2, 3)), (None, Some(5), Some(1)));
        }
    }
}
