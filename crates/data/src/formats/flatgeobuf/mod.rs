//! Reader of FlatGeobuf, `.fgb`: a layer of consecutive features, often preceded by an index of their bounding boxes.
//!
//! Input: a file. Output: a [`FeatureTable`](crate::FeatureTable). Features are read one by one; if only those in a box
//! are wanted, the index selects them. The information in the index and the header is compared with the features,
//! because a changed byte would otherwise yield a plausible position.
//!
//! The reader is our own, because it must be bounded: counts and offsets are checked before memory is allocated for
//! them.
//!
//! Source: the FlatGeobuf specification, version 3, and the binary format of FlatBuffers.

mod buffer;
mod geometry;
mod header;
mod index;
mod reader;
#[cfg(test)]
mod tests;

pub use reader::FlatGeobuf;
