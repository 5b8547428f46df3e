//! Rings as they were given.

use std::ops::Deref;

use glam::{DVec2, DVec3};

use super::Polygon;

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
