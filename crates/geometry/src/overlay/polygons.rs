//! Set operations on polygons.

use super::{BufferSource, BufferStyle, Cap, Join, PolygonArea, buffer, overlay};
use crate::planar::{Polygon, Rings};
use burgeon_base::error::Result;

impl Polygon {
    /// Returns the polygons after moving every edge inwards by `distance` (m), or outwards if it is negative;
    /// empty if no area remains.
    ///
    /// Corners are mitred, and cut off at twice the distance.
    ///
    /// ```
    /// use burgeon_geometry::{Polygon, Rings};
    /// use glam::DVec2;
    ///
    /// // Two rooms, 4 m by 4 m, and a passage between them that is 1 m wide.
    /// let rooms = [
    ///     (0.0, 0.0), (4.0, 0.0), (4.0, 1.5), (7.0, 1.5), (7.0, 0.0), (11.0, 0.0),
    ///     (11.0, 4.0), (7.0, 4.0), (7.0, 2.5), (4.0, 2.5), (4.0, 4.0), (0.0, 4.0),
    /// ];
    /// let rooms = Polygon::new(Rings(vec![rooms.map(DVec2::from).to_vec()]))?;
    /// assert_eq!(rooms.inset(0.25).len(), 1);
    /// let parts = rooms.inset(1.0);
    /// assert_eq!(parts.len(), 2);
    /// assert!(parts.iter().all(|part| (part.area() - 4.0).abs() < 1e-6));
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn inset(&self, distance: f64) -> Vec<Self> {
        let style = BufferStyle { join: Join::Mitre(MITRE), cap: Cap::Flat, quadrant_segments: 1 };
        let own = [Rings::from(self)];
        let source = BufferSource { areas: &own, ..BufferSource::default() };
        polygons(buffer(source, -distance, style))
    }

    /// Returns this polygon minus `others`; empty if they cover it.
    ///
    /// ```
    /// use burgeon_geometry::{Polygon, Rings};
    /// use glam::DVec2;
    ///
    /// let square = |at: f64, side: f64| {
    ///     let ring = [(at, at), (at + side, at), (at + side, at + side), (at, at + side)].map(DVec2::from);
    ///     Polygon::new(Rings(vec![ring.to_vec()]))
    /// };
    /// let left = square(0.0, 4.0)?.without(&[square(3.0, 4.0)?, square(1.0, 1.0)?]);
    /// assert_eq!((left.len(), left[0].holes().len()), (1, 1));
    /// assert!((left[0].area() - 14.0).abs() < 1e-6);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn without(&self, others: &[Self]) -> Vec<Self> {
        let others: PolygonArea = others.iter().map(Rings::from).collect();
        polygons(overlay(&[Rings::from(self)], &others, |[inside, other]| inside && !other))
    }
}

/// Mitre limit, as a multiple of the distance.
const MITRE: f64 = 2.0;

/// Returns the polygons of an area, without slivers that rounding may have created; empty if the work of this
/// thread is cancelled.
fn polygons(area: Result<PolygonArea>) -> Vec<Polygon> {
    area.unwrap_or_default().into_iter().filter_map(|rings| Polygon::turned(rings).ok()).collect()
}
