//! City models: common parts of CityGML and CityJSON.
//!
//! Input: the surfaces of an object in space, with their roles. Output: its footprint and its height. CityJSON is read
//! here; CityGML is read by the [GML](super::gml) reader, because it uses GML geometries.
//!
//! Source: OGC 12-019, 20-010 and 21-006r2, CityGML 2 and 3; OGC 20-072r5, CityJSON.

mod boundaries;
mod cityjson;
mod model;
mod shape;
#[cfg(test)]
mod tests;

pub(crate) use cityjson::CityJson;
pub(in crate::formats) use model::CityRecord;
pub(in crate::formats) use shape::{CitySurface, SurfaceRole};
