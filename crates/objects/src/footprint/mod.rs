//! The footprint: a plan on the ground, from which groundwork, walls and a roof rise.
//!
//! Comes in: a polygon, its neighbours and the ground. Goes out: a closed building, with a [`Note`](burgeon_kit::Note) where
//! it is not as asked. It never leaves out a building without saying so.

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
