//! Surfaces of networks with existing streets. Their junctions may be closer together than their corners are wide, and
//! their streets may overlap or run side by side.
//!
//! Input: a network. Output: for each level, one triangulation of the area that its streets cover, with shared edges:
//! carriageways, sidewalks, and the blocks between them. Each street, bend, corner and end is a small part. The parts
//! that cover a triangle determine its surface, so streets can be arbitrarily close to each other.

mod cover;
mod levels;
mod loops;
mod mesh;
mod surfaces;
#[cfg(test)]
mod tests;
