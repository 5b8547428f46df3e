//! Roofs whose height is a function of the place, over any plan with holes.
//!
//! Input: the walls as a [`Support`](super::Support), the form of the roof, and its ridge. Output: flat patches that close
//! the walls. Method: lines at which the slope changes divide the plan; each part is raised to its plane, and upright faces
//! close the differences in height, along the outline and between the parts. This module draws nothing.

mod axis;
mod cells;
mod faces;
mod forms;
mod heights;
mod onion;
mod profiles;
mod radial;
mod raise;
#[cfg(test)]
mod tests;

pub use axis::RidgeAxis;
pub use forms::FieldRoof;
pub(super) use heights::{HeightField, HeightPlane, PlaneRule};
pub(super) use raise::cover as raised;
