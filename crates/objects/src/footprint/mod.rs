//! The footprint: a plan on the ground, from which groundwork, walls and a roof rise.
//!
//! Input: a polygon, its neighbours and the ground. Output: a closed building, with a [`Warning`](burgeon_base::Warning) for
//! each deviation from the script. A building is never skipped without a report.

mod cover;
#[cfg(test)]
mod cover_tests;
#[cfg(test)]
mod eaves_tests;
mod edges;
mod methods;
mod neighbors;
mod object;
mod options;
mod prefetch;
mod roof;
mod shell;
mod sides;
mod state;
#[cfg(test)]
mod tests;
mod walls;

pub use object::Footprint;
pub use options::EdgeKeywords;
pub use walls::Walls;
