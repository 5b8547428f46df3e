//! Reads FlatGeobuf, `.fgb`: a layer of features in a row, often with an index of their boxes before them.
//!
//! Comes in: a file. Goes out: a [`FeatureTable`](crate::FeatureTable). Features are read one by one, and where only those in a box
//! are wanted, only those that the index has there. What the index and the header tell is compared with what is
//! there, since a changed byte would otherwise be a place like any other.
//!
//! The reader is our own, since it must be bounded: counts and offsets are checked before anything is made of them.
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
