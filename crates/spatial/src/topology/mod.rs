//! Topological relations of two geometries, decided by exact predicates.
//!
//! Input: two [prepared](prepared) geometries of one dimension each. Output: the nine cells of their
//! relation.
//!
//! Nothing is rounded: the ends of edges keep their exact coordinates, and crossings within edges are never
//! computed, because crossing borders of two areas determine the relation. If borders only touch, each
//! contact is the end of an edge.

mod cells;
mod prepared;
#[cfg(test)]
mod tests;

pub(crate) use cells::relate;
pub use prepared::PreparedGeometry;
