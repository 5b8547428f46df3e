//! Division of shapes along the image that is projected onto their faces.

use std::sync::Arc;

use burgeon_base::error::{Error, Result};
use burgeon_base::{MemoryOwner, Stop};
use glam::DVec3;
use rustc_hash::FxHashMap;

use crate::cut::plane::CutPlane;
use crate::mesh::{PolygonMesh, PolygonMeshBuilder};
use crate::style::FaceStyle;
use crate::{PartSizes, Shape, SplitParts, UvMap};

/// Direction of an image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ImageAxis {
    /// From its left to its right side.
    U,
    /// From its lower to its upper side.
    V,
}

impl ImageAxis {
    /// Returns the coordinate (tiles) of a position (m).
    fn at(self, map: &UvMap, place: DVec3) -> f64 {
        let at = map.at(place);
        if self == Self::U { at.x } else { at.y }
    }

    /// Returns the plane of the positions with a coordinate (tiles).
    fn plane(self, map: &UvMap, at: f64) -> CutPlane {
        let (direction, offset) = if self == Self::U { (map.u, map.offset.x) } else { (map.v, map.offset.y) };
        let length = direction.length();
        let normal = direction / length;
        CutPlane { normal, offset: map.origin.dot(normal) + (at - offset) / length }
    }
}

/// Faces with the same projection.
struct ImageFaces {
    map: UvMap,
    /// Faces that are not yet in a part.
    rest: Option<PolygonMesh>,
}

impl Shape {
    /// Divides the shape along the image that [`Shape::project`] puts on its faces, from the lowest coordinate to the highest:
    /// sizes are in tiles, repetitions of the image.
    ///
    /// Parts of a solid are closed if all faces have the same projection. Otherwise the faces of each projection are cut
    /// separately, and [`SplitParts::open`] is set for a solid. Fails if a face has no projection.
    ///
    /// ```
    /// use burgeon_shapes::{ImageAxis, PartSize, PartSizes, Shape, SizedParts, UvMap};
    /// use glam::DVec2;
    ///
    /// // An image of 2 m by 1.5 m shows four windows side by side.
    /// let wall = Shape::rectangle(DVec2::new(6.0, 3.0));
    /// let wall = wall.project(UvMap::of_plane(&wall.scope(), [0, 1], DVec2::new(2.0, 1.5)));
    /// let sizes = PartSizes(vec![SizedParts::Repeated(vec![PartSize::Absolute(0.25)])]);
    /// assert_eq!(wall.split_image(ImageAxis::U, &sizes)?.parts.len(), 12);
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn split_image(&self, axis: ImageAxis, sizes: &PartSizes) -> Result<SplitParts> {
        let mesh = self.mesh();
        let mut groups = faces_by_projection(&mesh)?;
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for ImageFaces { map, rest } in &groups {
            for place in rest.iter().flat_map(|mesh| &mesh.points) {
                let at = axis.at(map, *place);
                (low, high) = (low.min(at), high.max(at));
            }
        }
        if high - low <= 0.0 || !(high - low).is_finite() {
            let name = if axis == ImageAxis::U { "u" } else { "v" };
            return Err(Error::argument(format!("the image has no extent along {name} on the shape"))
                .help("project the image onto the faces first, with shape:project"));
        }
        let divided = sizes.divide(high - low, Self::most_parts())?;
        let open = groups.len() > 1 && self.is_closed();
        let mut split = SplitParts {
            rest: divided.rest,
            missing: divided.missing,
            negative: divided.negative,
            open,
            ..SplitParts::default()
        };
        for part in &divided.parts {
            Stop::check_current()?;
            let mut pieces = Vec::new();
            for group in &mut groups {
                let Some(mesh) = group.rest.take() else { continue };
                // New faces have the projection, too, so that parts can be divided further.
                let style = Some(Arc::new(FaceStyle { uv: Some(group.map), ..FaceStyle::default() }));
                let halves = axis.plane(&group.map, low + part.to).cut(&mesh, &style)?;
                split.open |= halves.open;
                group.rest = halves.above;
                pieces.extend(halves.below);
            }
            if let Some(mesh) = join(pieces) {
                MemoryOwner::ensure_room(mesh.memory())?;
                split.parts.push((part.entry, Self::of_mesh(mesh, self.scope().axes).with_trim_of(self)));
            }
        }
        Ok(split)
    }
}

/// Returns the faces of each projection, in the order of their first faces.
fn faces_by_projection(mesh: &PolygonMesh) -> Result<Vec<ImageFaces>> {
    let mut groups: Vec<(UvMap, Vec<usize>)> = Vec::new();
    let mut known: FxHashMap<[u64; 11], usize> = FxHashMap::default();
    for (number, face) in mesh.faces.iter().enumerate() {
        let Some(map) = face.style.as_deref().and_then(|style| style.uv) else {
            return Err(Error::argument("a face has no image projected onto it")
                .help("project the image onto the faces first, with shape:project"));
        };
        let group = *known.entry(key_of(&map)).or_insert(groups.len());
        match groups.get_mut(group) {
            Some((_, faces)) => faces.push(number),
            None => groups.push((map, vec![number])),
        }
        if number.is_multiple_of(1024) {
            Stop::check_current()?;
        }
    }
    Ok(groups.into_iter().map(|(map, faces)| ImageFaces { map, rest: Some(mesh.select(faces)) }).collect())
}

/// Returns the numbers of a projection as a key.
fn key_of(map: &UvMap) -> [u64; 11] {
    let UvMap { origin, u, v, offset } = *map;
    let numbers = [origin.x, origin.y, origin.z, u.x, u.y, u.z, v.x, v.y, v.z, offset.x, offset.y];
    numbers.map(f64::to_bits)
}

/// Returns the faces of all meshes as one mesh; `None` without any.
fn join(mut meshes: Vec<PolygonMesh>) -> Option<PolygonMesh> {
    if meshes.len() < 2 {
        return meshes.pop();
    }
    let mut builder = PolygonMeshBuilder::default();
    for mesh in &meshes {
        for face in &mesh.faces {
            let rings: Vec<Vec<DVec3>> =
                face.rings.iter().map(|ring| ring.iter().map(|point| mesh.at(*point)).collect()).collect();
            builder.face(rings.iter().map(Vec::as_slice), &face.style);
        }
    }
    Some(builder.build())
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::{PartSize, Selector, SizedParts};

    fn repeat(size: f64) -> PartSizes {
        PartSizes(vec![SizedParts::Repeated(vec![PartSize::Absolute(size)])])
    }

    #[test]
    fn a_turned_image_is_cut_along_its_own_direction() {
        let wall = Shape::rectangle(DVec2::new(4.0, 4.0));
        let map =
            UvMap::of_plane(&wall.scope(), [0, 1], DVec2::splat(1.0)).rotate(std::f64::consts::FRAC_PI_4);
        let split = wall.project(map).split_image(ImageAxis::U, &repeat(2f64.sqrt())).expect("parts");
        let areas: Vec<f64> = split.parts.iter().map(|(_, part)| part.area()).collect();
        // Corner triangles have the legs 2, middle parts the rest of the half.
        for (area, wanted) in areas.iter().zip([2.0, 6.0, 6.0, 2.0]) {
            assert!((area - wanted).abs() < 1e-9, "{areas:?}");
        }
    }

    #[test]
    fn parts_of_a_solid_with_one_projection_are_closed() {
        let mass = Shape::cuboid(DVec3::new(6.0, 4.0, 3.0));
        let map = UvMap::of_plane(&mass.scope(), [0, 2], DVec2::new(2.0, 3.0));
        let split = mass.project(map).split_image(ImageAxis::U, &repeat(1.0)).expect("parts");
        assert_eq!(split.parts.len(), 3);
        assert!(!split.open && split.parts.iter().all(|(_, part)| part.is_closed()));
        assert!(split.parts.iter().all(|(_, part)| (part.volume() - 24.0).abs() < 1e-9));
        let storeys = split.parts[1].1.split_image(ImageAxis::V, &repeat(0.5)).expect("parts").parts;
        assert!(storeys.len() == 2 && storeys.iter().all(|(_, part)| part.is_closed()));
    }

    #[test]
    fn faces_with_their_own_projections_are_cut_separately() {
        let mass = Shape::cuboid(DVec3::new(6.0, 4.0, 3.0));
        let sides = mass.faces(&Selector::read("side").expect("a selector")).expect("faces");
        let project = |face: &Shape| face.project(UvMap::of_plane(&face.scope(), [0, 1], DVec2::splat(1.0)));
        let meshes = sides.iter().map(|face| project(face).mesh().into_owned()).collect();
        let band = Shape::of_mesh(join(meshes).expect("faces"), glam::DMat3::IDENTITY);
        let split = band.split_image(ImageAxis::V, &repeat(1.0)).expect("parts");
        assert_eq!(split.parts.len(), 3);
        assert!(split.parts.iter().all(|(_, part)| (part.area() - 20.0).abs() < 1e-9));
    }

    #[test]
    fn faces_without_an_image_are_refused() {
        let error = Shape::rectangle(DVec2::ONE).split_image(ImageAxis::U, &repeat(1.0)).unwrap_err();
        assert!(error.to_string().contains("no image"), "{error}");
    }
}
