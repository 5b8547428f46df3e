//! Set operations on areas and buffers, valid by construction.
//!
//! Input: rings, lines and points of one or two layers, valid or not. Output: the area that they enclose or
//! cover, as valid polygons in the sense of OGC Simple Features. Edges are divided where they intersect until
//! exact predicates confirm that no two cross. Then each face of the plane is on one side of every ring, and
//! the border of any set of faces consists of rings that neither cross nor touch themselves.
//!
//! Input points keep their exact coordinates. Points within two units in the last place of the largest
//! coordinate are merged, and an edge passes through every point that is as close. Therefore only areas as
//! narrow as that vanish.
//!
//! All operations terminate, earlier if the [limits](burgeon_base::work::WorkLimits) of this thread's work
//! require it.

mod areas;
mod buffer;
mod nodes;
mod noding;
mod outline;
mod pairs;
mod polygons;
mod predicates;
mod rings;
mod subdivision;
#[cfg(test)]
mod tests;

pub use areas::{Fill, PolygonArea, fill, overlay, ring_ways, unite};
pub use buffer::{BufferSource, buffer};
pub use noding::{LayerWay, WayKind};
pub use outline::{BufferStyle, Cap, Join};
pub use subdivision::{Subdivision, SubdivisionEdge};
