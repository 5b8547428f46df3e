//! The plane: lines, rings and polygons, with what is promised of each and measured on it once.
//!
//! Comes in: points as somebody gave them. Goes out: shapes that keep their promises, or an error that says which
//! point breaks one and what to do. Whether rings meet each other is not looked at here: [`Plan`](crate::Plan) does
//! that, and repairs what it can.
//!
//! | Type        | What is promised                                                                             |
//! |-------------|----------------------------------------------------------------------------------------------|
//! | [`Rings`]   | nothing: rings as they were given                                                            |
//! | [`Line`]    | two points or more, each finite and other than the one before                                |
//! | [`Ring`]    | three points or more, the same, and the last one is not the first again                      |
//! | [`Polygon`] | the same as seen from above; its outer ring is counter-clockwise and its holes are clockwise |
//!
//! A point may have a height: it goes along with its place, and what is measured is measured as seen from above.

mod convert;
mod line;
mod measure;
mod orientation;
mod point;
mod polygon;
mod ring;
mod rings;
#[cfg(test)]
mod tests;

pub use line::Line;
pub use measure::{contains, distance, edges, foot, hull, simplified, twice_area};
pub use orientation::{is_counter_clockwise, is_flat};
pub use point::Point;
pub use polygon::Polygon;
pub use ring::Ring;
pub use rings::Rings;

pub(crate) use convert::geo_polygon;
pub(crate) use measure::{coord, kept, orientation};
