//! Worlds: squares of ground that rules divide into cells.
//!
//! Input: rule tables, systems, measured heights. Output: blocks of cells, which depend only on the world and their
//! positions.

pub(crate) mod block;
pub(crate) mod height_source;
pub(crate) mod noise;
pub(crate) mod table;
pub(crate) mod world;
