//! Variations of a script: runs that differ in the seed or in one parameter, as thumbnails for comparison.
//!
//! Input: a script, and the property that changes from run to run ([`VariationAxis`]). Output: a [`Variation`] for each
//! run, in order, with its render or its error; [`sheet`] combines the renders. The same input results in the same
//! bytes for any number of threads. An error in one run never affects the others.

mod axis;
mod letters;
mod runs;
mod sheet;

pub use axis::{MOST, VariationAxis};
pub use runs::{Framing, Thumbnail, Variation, Variations};
pub(crate) use runs::{find_param, scene_bytes};
pub use sheet::{SheetLayout, sheet};
