//! How two geometries lie to each other, decided by exact predicates.
//!
//! Comes in: two [prepared](prepared) geometries of one dimension each. Goes out: the nine cells of their relation.
//!
//! Nothing is rounded: the ends of edges are as they were given, and where edges cross between their ends is never
//! computed, since two areas whose borders cross have all in common that a relation can tell. Where borders only touch,
//! each place where they do is the end of an edge.

mod cells;
mod prepared;
#[cfg(test)]
mod tests;

pub(crate) use cells::relate;
pub use prepared::PreparedGeometry;
