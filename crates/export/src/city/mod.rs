//! CityJSON 2.0 (OGC 20-072r5), the exchange format of city models, as one document or as a sequence of features.
//!
//! Each chain becomes a city object: a building if its object distinguishes walls from roofs, otherwise the class that
//! its system specifies, otherwise a `GenericCityObject`. Closed drawings of a chain become one solid with semantic
//! surfaces; coplanar triangles are merged into one polygon. Models that the chain placed are instances of templates.
//! Coordinates are in the projection of the data, rounded to a millimetre. Materials and textures are not written.

mod boundaries;
mod document;
mod faces;
mod object;
mod templates;
#[cfg(test)]
mod tests;

pub use document::write_city_sequence;
pub(super) use document::{write, write_sequence};
