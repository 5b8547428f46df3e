//! Lines and rings as edges, and their relative positions, decided by exact predicates.
//!
//! Input: lines and rings as points. Output: intersections of edges, sides of areas on which points and edges
//! lie, and defects of areas. Nothing is rounded: crossings within edges are never computed.

mod contacts;
mod edges;
mod locate;
mod validity;

pub(crate) use contacts::{Contacts, WalkSides};
pub(crate) use edges::WayEdges;
pub(crate) use locate::{is_on_any, place_in};
pub(crate) use validity::{multi_polygon_flaw, polygon_flaw};
