//! CityJSON 2.0 (OGC 20-072r5), the exchange format of city models.
//!
//! Each chain becomes a city object: a building where its object tells walls from roofs, otherwise what its system says
//! that it is, and else a `GenericCityObject`. What a chain has drawn is one solid where it is closed, with semantic
//! surfaces; triangles in one plane are one polygon. Models that it placed are instances of templates. Coordinates are
//! those of the data's projection, to a millimetre. How things look is not told.

mod document;
mod faces;
mod object;
mod templates;
#[cfg(test)]
mod tests;

pub(super) use document::write;
