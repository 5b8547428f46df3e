//! The footprint: a plan on the ground, from which groundwork, walls and a roof rise.
//!
//! Input: a polygon, its neighbours and the ground. Output: a closed building, with a [`Note`](burgeon_kit::Note) for
//! each deviation from the script. A building is never skipped without a report.

mod cover;
#[cfg(test)]
mod cover_tests;
#[cfg(test)]
mod eaves_tests;
mod edges;
mod neighbors;
mod object;
mod prefetch;
mod roof;
mod shell;
mod sides;
#[cfg(test)]
mod tests;
mod walls;

pub use edges::EdgeKeywords;
pub use object::Footprint;
pub use roof::{Roof, RoofDetail};
pub use walls::Walls;
