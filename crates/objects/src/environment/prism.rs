//! Prisms over areas, as closed meshes.

use burgeon_base::error::{Error, Result};
use burgeon_geometry::{ClosedMesh, Polygon};
use burgeon_spatial::Geometry;
use glam::DVec2;

/// Returns the prism over each polygon of an area, between the heights `low` and `high` (m).
///
/// The heights of the area's points do not count. Fails if the geometry contains no area.
pub(super) fn prism(area: &Geometry, [low, high]: [f64; 2]) -> Result<Vec<ClosedMesh>> {
    let mut meshes = Vec::new();
    for part in area.parts() {
        let Geometry::Polygon(rings) = part else { continue };
        let polygon = Polygon::turned(rings)?.flat();
        let points: Vec<DVec2> = polygon.points().collect();
        let mut triangles = Vec::new();
        for corners in polygon.triangles()? {
            let [a, b, c] = corners.map(|corner| points[corner]);
            triangles.extend([[a, b, c].map(|at| at.extend(high)), [a, c, b].map(|at| at.extend(low))]);
        }
        for [from, to] in polygon.edges() {
            let [a, b, c, d] = [from.extend(low), to.extend(low), to.extend(high), from.extend(high)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
        meshes.push(ClosedMesh::new(triangles)?);
    }
    if meshes.is_empty() {
        return Err(Error::argument("the geometry contains no area").help("give a polygon, such as a plan"));
    }
    Ok(meshes)
}
