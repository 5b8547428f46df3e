//! Lines and rings as edges, and how they lie to each other, decided by exact predicates.
//!
//! Comes in: ways of places. Goes out: where edges meet, on which side of areas places and edges lie, and what is wrong
//! with areas. Nothing is rounded: where edges cross between their ends is never computed.

mod contacts;
mod edges;
mod locate;
mod validity;

pub(crate) use contacts::{Contacts, WalkSides};
pub(crate) use edges::WayEdges;
pub(crate) use locate::{is_on_any, place_in};
pub(crate) use validity::{multi_polygon_flaw, polygon_flaw};
