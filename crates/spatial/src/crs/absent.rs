//! Replacement for projections in programs built without the feature `projections`.

use burgeon_base::error::{Error, Result};

fn left_out<T>() -> Result<T> {
    Err(Error::left_out("data formats", "data"))
}

/// Projection; never constructed without the feature `projections`.
#[derive(Clone)]
pub(crate) enum Projection {}

impl Projection {
    pub(crate) fn new(_definition: &str, _cannot: impl Fn(String) -> Error) -> Result<Self> {
        left_out()
    }

    pub(crate) fn bring(&self, _into: &Self, _point: &mut (f64, f64, f64)) -> Result<(), String> {
        match *self {}
    }
}

pub(crate) fn find_system(_code: u32) -> Result<Option<(u16, String)>> {
    left_out()
}

/// Fails, because the EPSG registry needs the feature `projections`.
pub fn definition(_code: u16) -> Result<Option<String>> {
    left_out()
}

pub(crate) fn unshifted_datum(_code: Option<u16>, _proj: &str) -> Option<String> {
    None
}
