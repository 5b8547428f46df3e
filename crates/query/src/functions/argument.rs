//! A geometry as functions get it.

use std::sync::OnceLock;

use burgeon_base::budget::Budget;
use burgeon_spatial::{Geometry, PreparedGeometry};

use crate::{blob, plane};

/// A geometry that was read, and what was made of it.
#[derive(Debug)]
pub(crate) struct GeometryArgument {
    /// The geometry.
    pub geometry: Geometry,
    flat: OnceLock<geo::Geometry<f64>>,
    prepared: OnceLock<PreparedGeometry>,
}

impl GeometryArgument {
    /// The geometry in a blob. Fails with the reason.
    pub(crate) fn read(bytes: &[u8], budget: &Budget) -> Result<Self, String> {
        blob::read(bytes, budget).map(Self::from)
    }

    /// The geometry as seen from above.
    pub(crate) fn flat(&self) -> &geo::Geometry<f64> {
        self.flat.get_or_init(|| plane::flat(&self.geometry))
    }

    /// The geometry, ready to be compared with others.
    pub(crate) fn prepared(&self) -> &PreparedGeometry {
        self.prepared.get_or_init(|| PreparedGeometry::new(&self.geometry))
    }
}

impl From<Geometry> for GeometryArgument {
    fn from(geometry: Geometry) -> Self {
        Self { geometry, flat: OnceLock::new(), prepared: OnceLock::new() }
    }
}
