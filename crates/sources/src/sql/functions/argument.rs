//! Geometry arguments of functions.

use std::sync::OnceLock;

use burgeon_base::budget::Budget;
use burgeon_spatial::{Geometry, PreparedGeometry};

use crate::sql::{blob, plane};

/// A geometry that was read, and values derived from it on demand.
#[derive(Debug)]
pub(crate) struct GeometryArgument {
    /// Geometry.
    pub geometry: Geometry,
    flat: OnceLock<geo::Geometry<f64>>,
    prepared: OnceLock<PreparedGeometry>,
}

impl GeometryArgument {
    /// Reads the geometry in a blob. Fails with the reason.
    pub(crate) fn read(bytes: &[u8], budget: &Budget) -> Result<Self, String> {
        blob::read(bytes, budget).map(Self::from)
    }

    /// Returns the geometry in two dimensions, in `geo`'s types.
    pub(crate) fn flat(&self) -> &geo::Geometry<f64> {
        self.flat.get_or_init(|| plane::flat(&self.geometry))
    }

    /// Returns the geometry prepared for comparisons with others.
    pub(crate) fn prepared_geometry(&self) -> &PreparedGeometry {
        self.prepared.get_or_init(|| PreparedGeometry::new(&self.geometry))
    }
}

impl From<Geometry> for GeometryArgument {
    fn from(geometry: Geometry) -> Self {
        Self { geometry, flat: OnceLock::new(), prepared: OnceLock::new() }
    }
}
