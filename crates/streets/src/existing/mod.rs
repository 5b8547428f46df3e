//! Streets that exist before a network grows, such as those of a survey.
//!
//! An existing street is a fact: it is added where it lies, to within 0.1 m, whatever the constraints ask of streets
//! that grow. Lines of one level meet in junctions where they cross or touch. Lines of different levels meet only where one
//! of them ends on a vertex of the other.

mod insertion;
mod noding;
mod snapping;
#[cfg(test)]
pub(crate) mod tests;

pub(crate) use insertion::StreetStrand;
pub use insertion::{ExistingLoss, ExistingLossReason, ExistingReport, ExistingStreet};
pub(crate) use noding::node;
