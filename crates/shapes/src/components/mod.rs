//! Components of shapes: faces, edges, holes and connected pieces.

mod edges;
mod faces;
mod pieces;
pub(crate) mod selector;
