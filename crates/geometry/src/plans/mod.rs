//! Building footprints.
//!
//! Input: rings that may cross, touch, or have narrow openings. Output: a plan with clean outlines, and a report of its
//! repairs.

pub(crate) mod plan;
mod repair;
mod slits;
