//! From blocks to lots: areas that are disjoint, fill their block, and have fronts on streets.
//!
//! Comes in: the blocks of a network or areas of data, [`LotOptions`], and random numbers of whoever asks. Goes out:
//! [`Lot`]s. It never looks from one block at another, so a change in one leaves the lots of all others.
//!
//! Corners lie on a grid of 2^-20 m, on which all borders are decided exactly: lots share corners and whole edges, no
//! edges meet but at their ends, and areas add up to those of the block but for the rounding of corners on its border.

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
