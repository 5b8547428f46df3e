//! Edits of the ground, stored separately from the rules.
//!
//! Input: edits of objects, and a world. Output: changed heights, and the file of edits.

pub(crate) mod bed;
pub(crate) mod edit;
pub(crate) mod local_edits;
pub(crate) mod store;
