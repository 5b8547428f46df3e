//! Moves geometries between metres relative to the run's origin and the coordinates in statements.

use burgeon_base::error::{Error, Result};
use burgeon_spatial::{Crs, Geometry, ReferenceFrame};

/// Converts a geometry from the projection's coordinates to the run's.
pub(crate) fn enter(geometry: Geometry, frame: Option<&ReferenceFrame>) -> Geometry {
    shift(geometry, frame, -1.0)
}

/// Converts a geometry from the run's coordinates to the projection's.
pub(crate) fn leave(geometry: &Geometry, frame: Option<&ReferenceFrame>) -> Geometry {
    shift(geometry.clone(), frame, 1.0)
}

/// Converts a geometry from a reference system to the run's coordinates. Fails if it has no position there.
pub(crate) fn enter_from(mut geometry: Geometry, code: u32, frame: &ReferenceFrame) -> Result<Geometry> {
    let crs = Crs::epsg(code)?;
    let passage = frame.passage(&crs)?;
    for point in geometry.points_mut() {
        [point.x, point.y] = passage.enter([point.x, point.y]);
    }
    if geometry.is_sound() {
        return Ok(geometry);
    }
    Err(Error::data(format!("a geometry of EPSG:{code} has no place in {}", frame.name))
        .help("check its reference system: ST_SetSRID and ST_Transform take EPSG's codes"))
}

/// Transforms a geometry to another reference system. `None` is the run's projection. Fails if it has no position
/// there.
pub(crate) fn transform(
    geometry: &Geometry,
    from: Option<u32>,
    to: Option<u32>,
    frame: &ReferenceFrame,
) -> Result<Geometry> {
    let mut geometry = match from {
        Some(code) => enter_from(geometry.clone(), code, frame)?,
        None => enter(geometry.clone(), Some(frame)),
    };
    let Some(code) = to else { return Ok(leave(&geometry, Some(frame))) };
    let crs = Crs::epsg(code)?;
    let passage = frame.passage(&crs)?;
    for point in geometry.points_mut() {
        [point.x, point.y] = passage.leave([point.x, point.y]);
    }
    if geometry.is_sound() {
        return Ok(geometry);
    }
    Err(Error::data(format!("a geometry has no place in EPSG:{code}"))
        .help("check its reference system: ST_SetSRID and ST_Transform take EPSG's codes"))
}

fn shift(mut geometry: Geometry, frame: Option<&ReferenceFrame>, sign: f64) -> Geometry {
    if let Some(frame) = frame {
        for point in geometry.points_mut() {
            point.x += sign * frame.origin[0];
            point.y += sign * frame.origin[1];
        }
    }
    geometry
}

/// The transformation between a run and the coordinate system of a server.
#[cfg(feature = "postgis")]
pub(crate) struct Move<'a>(Option<burgeon_spatial::Passage<'a>>);

#[cfg(feature = "postgis")]
impl<'a> Move<'a> {
    /// Returns the identity transformation.
    pub(crate) fn identity() -> Self {
        Self(None)
    }

    /// Returns the transformation between a frame and a coordinate system.
    pub(crate) fn between(frame: &'a ReferenceFrame, crs: &Crs) -> Result<Self> {
        frame.passage(crs).map(|passage| Self(Some(passage)))
    }

    /// Converts a value from the server's coordinates to the run's.
    pub(crate) fn bring_in(&self, cell: crate::sql::Cell) -> crate::sql::Cell {
        self.move_points(cell, |passage, at| passage.enter(at))
    }

    /// Converts a value from the run's coordinates to the server's.
    pub(crate) fn bring_out(&self, cell: crate::sql::Cell) -> crate::sql::Cell {
        self.move_points(cell, |passage, at| passage.leave(at))
    }

    fn move_points(
        &self,
        cell: crate::sql::Cell,
        way: impl Fn(&burgeon_spatial::Passage<'_>, [f64; 2]) -> [f64; 2],
    ) -> crate::sql::Cell {
        use std::sync::Arc;
        match (cell, &self.0) {
            (crate::sql::Cell::Geometry(geometry), Some(passage)) => {
                let mut moved = Arc::unwrap_or_clone(geometry);
                for point in moved.points_mut() {
                    [point.x, point.y] = way(passage, [point.x, point.y]);
                }
                crate::sql::Cell::Geometry(Arc::new(moved))
            }
            (cell, _) => cell,
        }
    }
}
