//! Surfaces of networks with existing streets, whose junctions may be nearer to one another than their corners are wide, and
//! whose streets may lie side by side.
//!
//! Comes in: a network. Goes out, level by level, one triangulation of all that its streets cover, in which every edge is
//! shared: carriageways, sidewalks and the blocks between them. Each street, bend, corner and end is a small part; what
//! belongs to which surface is decided by the parts that cover it, so no two streets are too near for it.

mod cover;
mod levels;
mod loops;
mod mesh;
mod room;
mod surfaces;
#[cfg(test)]
mod tests;

pub(crate) use levels::{MergeCache, MergeOptions, MergedBlock, MergedLevel, MergedStreets};
pub(crate) use room::goes_on;
