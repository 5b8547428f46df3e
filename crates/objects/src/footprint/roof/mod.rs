//! The upper part of a building: its roof and the objects on the roof.
//!
//! Input: the options of `footprint:roof`. Output: patches, and models on them, in the footprint's drawing. The shape
//! of a roof is computed in the geometry crate, never here.

mod cover;
mod replace;
mod smooth;
#[cfg(test)]
mod tests;
