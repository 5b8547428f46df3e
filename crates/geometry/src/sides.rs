//! Which triangle is on the left of a directed edge.

use rustc_hash::FxHashMap;

/// With at most this many points, a table of all pairs is smaller and faster than a map.
const FEW: usize = 48;

/// No triangle.
const NONE: u32 = u32::MAX;

/// The sides of triangles, each with the triangle that it belongs to; of several the last one.
pub(super) enum Sides {
    Table { points: usize, owners: Vec<u32> },
    Map(FxHashMap<(usize, usize), usize>),
}

impl Sides {
    /// The sides of `triangles` over so many points.
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

    /// Forgets a side.
    pub(super) fn remove(&mut self, from: usize, to: usize) {
        match self {
            Self::Table { points, owners } => owners[from * *points + to] = NONE,
            Self::Map(owners) => {
                owners.remove(&(from, to));
            }
        }
    }

    /// The triangle that this is a side of.
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
