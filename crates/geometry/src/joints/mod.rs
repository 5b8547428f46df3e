//! Trees of tubes as one closed surface, with smooth joints.
//!
//! Input: axes with radii or contours, each of which begins at a point of another. Output: a closed mesh; a branch that
//! does not fit into its joint is a closed body of its own.

pub(crate) mod axis;
mod body;
mod hull;
mod outline;
mod patch;
mod placement;
mod route;
#[cfg(test)]
mod tests;
mod tree;
pub(crate) mod tubes;
