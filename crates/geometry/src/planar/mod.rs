//! Plane geometry: lines, rings and polygons with guaranteed invariants.
//!
//! Input: points in any state. Output: shapes with guaranteed invariants, or an error with the invalid point
//! and a remedy. This module does not check whether rings intersect: [`Plan`](crate::Plan) does, and repairs
//! them if possible.
//!
//! | Type        | Invariant                                                                                    |
//! |-------------|----------------------------------------------------------------------------------------------|
//! | [`Rings`]   | none: unvalidated rings                                                                      |
//! | [`Line`]    | at least two finite points, each different from the previous one                             |
//! | [`Ring`]    | at least three such points, and the last one differs from the first                          |
//! | [`Polygon`] | rings, also as seen from above; the outer ring is counter-clockwise, the holes are clockwise |
//!
//! A point may have a height, which shapes keep with its position; measurements are horizontal.

mod convert;
mod line;
mod measure;
mod orientation;
mod point;
mod polygon;
mod ring;
mod rings;
mod sides;
mod strings;
#[cfg(test)]
mod tests;
mod touching_points;
mod triangulation;

pub use line::Line;
pub use measure::{contains, distance, edges, foot, simplified, twice_area};
pub use orientation::{is_counter_clockwise, is_flat};
pub use point::Point;
pub use polygon::Polygon;
pub use ring::{Ring, hull};
pub use rings::Rings;

pub(crate) use measure::{coord, kept, orientation};
pub(crate) use strings::geo_polygon;
pub(crate) use triangulation::{triangulate, triangulate_constrained};
