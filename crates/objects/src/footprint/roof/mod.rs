//! The upper part of a building: its roof and what stands on it.
//!
//! Comes in: what `footprint:roof` takes. Goes out: patches, and models on them, in the footprint's drawing. The shape of a
//! roof is never worked out here, but in the geometry.

mod cover;
mod detail;
mod kinds;
mod replace;
#[cfg(test)]
mod tests;

pub use cover::Roof;
pub use detail::RoofDetail;
