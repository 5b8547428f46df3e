//! Moves geometries between the metres around the run's origin and the coordinates that statements have.

use burgeon_data::ReferenceFrame;
use burgeon_spatial::Geometry;

/// From the projection's coordinates to the run's.
pub(crate) fn enter(geometry: Geometry, frame: Option<&ReferenceFrame>) -> Geometry {
    shifted(geometry, frame, -1.0)
}

/// From the run's coordinates to the projection's.
pub(crate) fn leave(geometry: &Geometry, frame: Option<&ReferenceFrame>) -> Geometry {
    shifted(geometry.clone(), frame, 1.0)
}

fn shifted(mut geometry: Geometry, frame: Option<&ReferenceFrame>, sign: f64) -> Geometry {
    if let Some(frame) = frame {
        for point in geometry.points_mut() {
            point.x += sign * frame.origin[0];
            point.y += sign * frame.origin[1];
        }
    }
    geometry
}

/// The way between a run and the coordinate system of a server.
#[cfg(feature = "postgis")]
pub(crate) struct Move<'a>(Option<burgeon_data::Passage<'a>>);

#[cfg(feature = "postgis")]
impl<'a> Move<'a> {
    /// The way that leaves all where it is.
    pub(crate) fn nowhere() -> Self {
        Self(None)
    }

    /// The way between a frame and a coordinate system.
    pub(crate) fn between(
        frame: &'a ReferenceFrame,
        crs: &burgeon_data::Crs,
    ) -> burgeon_base::error::Result<Self> {
        frame.passage(crs).map(|passage| Self(Some(passage)))
    }

    /// A value of the server as the run has it.
    pub(crate) fn bring_in(&self, cell: crate::Cell) -> crate::Cell {
        self.moved(cell, |passage, at| passage.enter(at))
    }

    /// A value of the run as the server has it.
    pub(crate) fn bring_out(&self, cell: crate::Cell) -> crate::Cell {
        self.moved(cell, |passage, at| passage.leave(at))
    }

    fn moved(
        &self,
        cell: crate::Cell,
        way: impl Fn(&burgeon_data::Passage<'_>, [f64; 2]) -> [f64; 2],
    ) -> crate::Cell {
        use std::sync::Arc;
        match (cell, &self.0) {
            (crate::Cell::Geometry(geometry), Some(passage)) => {
                let mut moved = Arc::unwrap_or_clone(geometry);
                for point in moved.points_mut() {
                    [point.x, point.y] = way(passage, [point.x, point.y]);
                }
                crate::Cell::Geometry(Arc::new(moved))
            }
            (cell, _) => cell,
        }
    }
}
