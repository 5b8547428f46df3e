//! Streets that exist before a network grows, such as surveyed streets.
//!
//! An existing street is a fact: it is added at its position, to within 0.1 m, even if it violates the constraints on
//! streets that grow. Lines of the same level meet in junctions where they cross or touch. Lines of different levels
//! meet only if one of them ends on a vertex of the other.

mod insertion;
mod noding;
mod snapping;
mod strand;
#[cfg(test)]
pub(crate) mod tests;

pub use insertion::{ExistingLoss, ExistingLossReason, ExistingReport, ExistingStreet};
pub(crate) use noding::node;
pub(crate) use strand::StreetStrand;
