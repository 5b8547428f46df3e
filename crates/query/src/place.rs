//! Moves geometries between the metres around the run's origin and the projection's own coordinates.

use burgeon_data::ReferenceFrame;
use burgeon_spatial::Geometry;

/// From the projection's coordinates to the run's.
pub(crate) fn enter(geometry: Geometry, frame: Option<&ReferenceFrame>) -> Geometry {
    moved(geometry, frame, -1.0)
}

/// From the run's coordinates to the projection's.
pub(crate) fn leave(geometry: &Geometry, frame: Option<&ReferenceFrame>) -> Geometry {
    moved(geometry.clone(), frame, 1.0)
}

fn moved(mut geometry: Geometry, frame: Option<&ReferenceFrame>, sign: f64) -> Geometry {
    if let Some(frame) = frame {
        for point in geometry.points_mut() {
            point.x += sign * frame.origin[0];
            point.y += sign * frame.origin[1];
        }
    }
    geometry
}
