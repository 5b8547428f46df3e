//! Unvalidated rings.

use std::ops::Deref;

use glam::{DVec2, DVec3};

use super::{Point, is_counter_clockwise};

/// Unvalidated rings, the outer ring first.
///
/// [`Polygon::new`](super::Polygon::new) refuses invalid rings, and [`Plan::new`](crate::Plan::new) repairs them if possible.
#[derive(Debug, Clone, PartialEq)]
pub struct Rings<P = DVec3>(pub Vec<Vec<P>>);

impl Rings<DVec2> {
    /// Returns the rings at a height (m).
    pub fn at_height(&self, height: f64) -> Rings {
        self.iter().map(|ring| ring.iter().map(|at| at.extend(height)).collect()).collect()
    }
}

impl Rings {
    /// Projects the rings onto the horizontal plane.
    pub fn flat(&self) -> Rings<DVec2> {
        self.iter().map(|ring| ring.iter().map(|at| at.truncate()).collect()).collect()
    }
}

impl<P: Point> Rings<P> {
    /// Reverses rings with the wrong direction, so that the outer ring is counter-clockwise and holes are
    /// clockwise. A ring without area counts as clockwise.
    ///
    /// ```
    /// use burgeon_geometry::{Polygon, Rings};
    /// use glam::DVec2;
    ///
    /// let clockwise = [(0.0, 0.0), (0.0, 2.0), (2.0, 2.0), (2.0, 0.0)].map(DVec2::from).to_vec();
    /// let mut rings = Rings(vec![clockwise]);
    /// assert!(Polygon::new(rings.clone()).is_err());
    /// rings.turn();
    /// assert_eq!(Polygon::new(rings)?.area(), 4.0);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
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
