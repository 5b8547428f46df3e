//! Expanded ground: the cells of a view as tiles, and the heights at any point of them.
//!
//! Input: a world, its edits, and a view. Output: tiles, heights, and a map of the ground.

pub(crate) mod ground;
pub(crate) mod reader;
pub(crate) mod tile;
pub(crate) mod view;
