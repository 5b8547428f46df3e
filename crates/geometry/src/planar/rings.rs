//! Rings as they were given.

use std::ops::Deref;

use glam::{DVec2, DVec3};

use super::{Point, Polygon, is_counter_clockwise};

/// Rings as somebody gave them, the outer one first: nothing is promised of their points.
///
/// [`Polygon::new`] refuses those that keep no promise, and [`Plan::new`](crate::Plan::new) makes the best of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Rings<P = DVec3>(pub Vec<Vec<P>>);

impl Rings<DVec2> {
    /// The rings at a height (m).
    pub fn at_height(&self, height: f64) -> Rings {
        self.iter().map(|ring| ring.iter().map(|at| at.extend(height)).collect()).collect()
    }
}

impl Rings {
    /// The rings as seen from above.
    pub fn flat(&self) -> Rings<DVec2> {
        self.iter().map(|ring| ring.iter().map(|at| at.truncate()).collect()).collect()
    }
}

impl<P: Point> Rings<P> {
    /// Turns those rings around that run the wrong way: the outer one is to be counter-clockwise, holes clockwise. A ring
    /// without area is taken for clockwise.
    pub fn turn(&mut self) {
        for (index, ring) in self.0.iter_mut().enumerate() {
            let places: Vec<DVec2> = ring.iter().map(|point| point.flat()).collect();
            if is_counter_clockwise(&places) != (index == 0) {
                ring.reverse();
            }
        }
    }
}

impl<P> Default for Rings<P> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<P> Deref for Rings<P> {
    type Target = [Vec<P>];

    fn deref(&self) -> &[Vec<P>] {
        &self.0
    }
}

impl<P> From<Vec<Vec<P>>> for Rings<P> {
    fn from(rings: Vec<Vec<P>>) -> Self {
        Self(rings)
    }
}

impl<P> FromIterator<Vec<P>> for Rings<P> {
    fn from_iter<I: IntoIterator<Item = Vec<P>>>(rings: I) -> Self {
        Self(rings.into_iter().collect())
    }
}

impl<P: Clone> From<&Polygon<P>> for Rings<P> {
    fn from(polygon: &Polygon<P>) -> Self {
        polygon.iter().map(|ring| ring.to_vec()).collect()
    }
}
