//! Division of polygons by their straight skeletons.

use burgeon_base::Stop;
use burgeon_base::error::{Error, Result};
use burgeon_geometry::Polygon;
use burgeon_geometry::skeleton::Skeleton;
use burgeon_geometry::{Ring, Rings};
use glam::{DVec2, DVec3};

use crate::CutPlane;
use crate::mesh::{EdgeSums, PolygonFace, PolygonMesh, PolygonMeshBuilder, trace_loops};

/// Parts of a polygon at a moment of its wavefront.
#[derive(Debug, Default)]
pub(super) struct Strips {
    /// Areas that the wavefront has passed, in the order of the edges, with the direction of their edge.
    pub border: Vec<(Polygon, DVec2)>,
    /// Areas that it has not reached.
    pub inner: Vec<Polygon>,
}

/// Divides a polygon by the wavefront at `time` (m).
pub(super) fn divide(polygon: &Polygon, skeleton: &Skeleton, time: f64) -> Result<Strips> {
    let points: Vec<DVec3> = skeleton.peaks.iter().map(|peak| peak.at.extend(peak.time)).collect();
    let plane = CutPlane { normal: DVec3::Z, offset: time };
    let mut strips = PolygonMeshBuilder::default();
    let mut border = Vec::new();
    for corners in &skeleton.faces {
        Stop::check_current()?;
        // The points keep their order, on which the rounding of cuts depends, so that neighbours have the same ends.
        let mut used = corners.clone();
        used.sort_unstable();
        used.dedup();
        let number = |point: &usize| u32::try_from(used.partition_point(|known| known < point)).ok();
        let ring: Vec<u32> = corners.iter().filter_map(number).collect();
        let own = used.iter().map(|point| points[*point]).collect();
        let lifted = PolygonMesh::new(own, vec![PolygonFace::of(&ring, &None)]);
        let Some(below) = plane.cut(&lifted, &None)?.below else { continue };
        for face in &below.faces {
            let ring: Vec<DVec3> =
                face.rings[0].iter().map(|point| below.at(*point).truncate().extend(0.0)).collect();
            let flat: Vec<DVec2> = ring.iter().map(|at| at.truncate()).collect();
            strips.face([ring.as_slice()], &None);
            if let Some(ring) = Ring::without_repeats(flat).filter(|ring| ring.area() > 1e-12)
                && let Ok(strip) = Polygon::turned(Rings(vec![ring.into_points()]))
            {
                let [from, to] = [corners[0], corners[1]].map(|peak| skeleton.peaks[peak].at);
                border.push((strip, (to - from).normalize_or(DVec2::X)));
            }
        }
    }
    // What is left has the edges of the polygon that no strip begins at, and the upper edges of the strips.
    let mut rest = EdgeSums::default();
    for ring in polygon {
        let numbers: Vec<u32> = ring.iter().map(|at| strips.point(at.extend(0.0))).collect();
        (0..numbers.len()).for_each(|index| rest.add([numbers[index], numbers[(index + 1) % numbers.len()]]));
    }
    let strips = strips.build();
    strips.faces.iter().flat_map(|face| face.edges()).for_each(|[from, to]| rest.add([to, from]));
    let edges: Vec<[u32; 2]> = rest.rest().collect();
    let loops = trace_loops(&edges, |point| strips.at(point).truncate())
        .ok_or_else(|| Error::geometry("the rest of the face could not be found"))?;
    let flat = |ring: &Vec<u32>| ring.iter().map(|point| strips.at(*point).truncate()).collect();
    let polygons = loops.iter().map(|rings| Rings(rings.iter().map(flat).collect::<Vec<Vec<DVec2>>>()));
    let inner = polygons.filter_map(|rings| Polygon::turned(rings).ok()).filter(|rest| rest.area() > 1e-9);
    Ok(Strips { border, inner: inner.collect() })
}
