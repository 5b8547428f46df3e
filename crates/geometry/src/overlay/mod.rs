//! Set operations on areas and buffers, valid by construction.
//!
//! Comes in: rings, lines and points of one or two layers, in any state. Goes out: the area that they enclose or cover, as
//! polygons that are valid in the sense of OGC Simple Features. Edges are divided where they meet until exact predicates
//! find that none crosses another; by then each piece of the plane is on one side of every ring, and the border of any
//! number of pieces consists of rings that neither cross nor touch themselves.
//!
//! Places that were given stay exactly as they are. Those within two units in the last place of the greatest coordinate
//! are one place, and an edge runs through a place that is as near. So narrow are the areas that vanish.
//!
//! All work ends, and before that if the [limits](burgeon_base::work::WorkLimits) of this thread's work say so.

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
