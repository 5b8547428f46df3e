//! Projections, and the coordinate systems of the EPSG's registry.

use proj4rs::Proj;
use proj4rs::transform::transform;

use burgeon_base::error::{Error, Result};

/// A projection, or longitude and latitude.
#[derive(Clone)]
pub(crate) struct Projection(Proj);

impl Projection {
    /// That of a definition in PROJ's words; what `cannot` makes of the reason, if it cannot be used.
    pub(crate) fn new(definition: &str, cannot: impl Fn(String) -> Error) -> Result<Self> {
        Proj::from_proj_string(definition).map(Self).map_err(|error| cannot(error.to_string()))
    }

    /// Brings a point (m, or radians) into another projection; the reason, if it cannot be.
    pub(crate) fn bring(&self, into: &Self, point: &mut (f64, f64, f64)) -> Result<(), String> {
        transform(&self.0, &into.0, point).map_err(|error| error.to_string())
    }
}

/// The number and the definition of a coordinate system, if the registry has it.
pub(crate) fn known(code: u32) -> Result<Option<(u16, &'static str)>> {
    let found = u16::try_from(code).ok().and_then(crs_definitions::from_code);
    Ok(found.map(|found| (found.code, found.proj4)))
}

/// The definition of a coordinate system in well-known text, if the registry has it.
pub(crate) fn definition(code: u16) -> Result<Option<&'static str>> {
    Ok(crs_definitions::from_code(code).map(|found| found.wkt))
}
