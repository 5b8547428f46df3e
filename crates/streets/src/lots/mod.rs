//! Division of blocks into lots: areas that are disjoint, fill their block, and have fronts along streets.
//!
//! Input: the blocks of a network or areas from data, [`LotOptions`], and random numbers from the caller. Output:
//! [`Lot`]s. Each block is divided independently, so a change in one block does not affect the lots of others.
//!
//! Corners are on a grid of 2^-20 m, on which all borders are tested exactly: lots share corners and whole edges, edges
//! meet only at their ends, and the areas add up to the area of the block, except for the rounding of corners on its
//! border.

mod block;
mod boxes;
mod divide;
mod fine;
mod measure;
mod options;
mod partition;
mod row;
mod strips;
#[cfg(test)]
mod tests;

pub use block::{BlockSide, StreetBlock};
pub use divide::{Lot, LotUse};
pub(crate) use fine::{FinePlace, meet as fine_meet, side as fine_side};
pub use options::{LotOptions, LotPattern};
