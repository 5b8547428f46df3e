//! Cross-sections: the flat shapes that sweeps move along a path.
//!
//! Input: rings of points in any state. Output: sections with clean outlines, divided into faces; errors name the
//! invalid point.

pub(crate) mod outline;
pub(crate) mod point;
pub(crate) mod section;
mod shapes;
mod simplify;
pub(crate) mod skin;
