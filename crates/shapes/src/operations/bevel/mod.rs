//! Chamfers and fillets along convex edges.
//!
//! Input: a solid, a distance and a number of segments. Output: the solid without a wedge along each edge. Wedges that are apart
//! from each other are subtracted together, so that the work grows with the number of edges.

mod room;
mod solid;
mod wedge;

pub use solid::BeveledSolid;
