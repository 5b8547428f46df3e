//! Models of cities: what CityGML and CityJSON have in common.
//!
//! Comes in: the surfaces of an object in space, with their roles. Goes out: its footprint, and its height. CityJSON is read here,
//! CityGML by the reader of [GML](super::gml), whose geometries it has.
//!
//! Source: OGC 12-019, 20-010 and 21-006r2, CityGML 2 and 3; OGC 20-072r5, CityJSON.

mod cityjson;
mod model;
mod shape;
#[cfg(test)]
mod tests;

pub(crate) use cityjson::CityJson;
pub(in crate::formats) use model::CityRecord;
pub(in crate::formats) use shape::{CitySurface, SurfaceRole};
