//! Checks that every format runs on a scene before it writes the first byte.

use burgeon_base::error::{Error, Result};
use burgeon_scene::{Mesh, Part, Scene};
use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// Largest coordinate (m) and largest number of a transform. Products of two such numbers still fit into f32.
const LARGEST: f64 = 1e15;

/// Scene that can be written, with the parts of it that are shown.
#[derive(Debug)]
pub(super) struct SceneCheck<'a> {
    /// Checked scene, unchanged.
    pub(super) scene: &'a Scene,
    /// For each mesh, true if an instance names the mesh and the mesh has a triangle.
    pub(super) meshes: Vec<bool>,
    /// For each mesh, the extents of its parts; empty if no instance names the mesh.
    pub(super) parts: Vec<Vec<PartExtent>>,
    /// For each material, true if a triangle of a shown mesh uses it.
    pub(super) materials: Vec<bool>,
    /// Origin (m) of the file's coordinates.
    pub(super) origin: DVec3,
}

/// Extent of a checked part, stored so that the part is measured only once.
#[derive(Debug, Clone, Copy)]
pub(super) struct PartExtent {
    /// Number of its [`triangles`].
    pub(super) triangles: usize,
    /// Bounding box (m) of its points; both corners are the origin if there are no points.
    pub(super) low: Vec3,
    pub(super) high: Vec3,
}

/// Checks a scene. Fails if a shown part of it refers to something that does not exist or contains a number that is not
/// finite.
pub(super) fn check(scene: &Scene) -> Result<SceneCheck<'_>> {
    let mut meshes = vec![false; scene.meshes.len()];
    for (i, instance) in scene.instances.iter().enumerate() {
        let name = || item_label("instance", &instance.name, i);
        let Some(shown) = meshes.get_mut(instance.mesh) else {
            return Err(Error::internal(format!("{} refers to the missing mesh {}", name(), instance.mesh)));
        };
        *shown = true;
        if !instance.transform.to_cols_array().iter().all(|number| number.abs() <= LARGEST) {
            let error = Error::geometry(format!(
                "the transform of {} has numbers that are not finite or too large",
                name()
            ));
            return Err(error.help("look for a division by zero in a length, a scale or an angle"));
        }
    }
    let measured = scene.meshes.par_iter().zip(&meshes).map(|(mesh, shown)| {
        let parts = mesh.parts.iter().filter(|_| *shown);
        parts.map(|part| check_part(scene, part)).collect()
    });
    let measured: Vec<Result<Vec<PartExtent>, String>> = measured.collect();
    let mut materials = vec![false; scene.materials.len()];
    let mut parts = Vec::with_capacity(meshes.len());
    for (i, (mesh, measured)) in scene.meshes.iter().zip(measured).enumerate() {
        let measured = measured.map_err(|what| unsound(mesh, i, &what))?;
        let shown = || mesh.parts.iter().zip(&measured).filter(|(_, measured)| measured.triangles > 0);
        meshes[i] = shown().next().is_some();
        for (part, _) in shown() {
            materials[part.material] = true;
        }
        parts.push(measured);
    }
    let boxes = scene.meshes.iter().zip(&parts).map(|(mesh, parts)| bounds(mesh, parts));
    let bounds = scene.bounds_of(&boxes.collect::<Vec<_>>());
    Ok(SceneCheck { scene, meshes, parts, materials, origin: origin(bounds) })
}

/// Returns the bounding box (m) of the `measured` parts of `mesh`.
fn bounds(mesh: &Mesh, measured: &[PartExtent]) -> Option<(DVec3, DVec3)> {
    let parts = mesh.parts.iter().zip(measured).filter(|(part, _)| !part.positions.is_empty());
    let boxes = parts.map(|(_, PartExtent { low, high, .. })| (low.as_dvec3(), high.as_dvec3()));
    boxes.reduce(|(a, b), (low, high)| (a.min(low), b.max(high)))
}

/// Returns the triangles of `part` with three different corners. The others have no area and are not written.
pub(super) fn triangles(part: &Part) -> impl Iterator<Item = [u32; 3]> + Clone + '_ {
    proper_triangles(part.triangles.iter())
}

/// Filters `triangles` to those with three different corners.
pub(super) fn proper_triangles<T: Iterator<Item = [u32; 3]> + Clone>(
    triangles: T,
) -> impl Iterator<Item = [u32; 3]> + Clone + use<T> {
    triangles.filter(|[a, b, c]| a != b && b != c && c != a)
}

/// Returns the parts of `mesh` that have a triangle.
pub(super) fn shown_parts(mesh: &Mesh) -> impl Iterator<Item = &Part> {
    mesh.parts.iter().filter(|part| triangles(part).next().is_some())
}

/// Returns the origin (m) of the file's coordinates: the world's origin, or whole metres near the centre of `bounds` if
/// the centre is more than 10 km away.
///
/// At 10 km an f32 still resolves a millimetre. Heights are kept unless the centre's height exceeds 10 km too.
pub(super) fn origin(bounds: Option<(DVec3, DVec3)>) -> DVec3 {
    let far = 10_000.0;
    let centre = bounds.map_or(DVec3::ZERO, |(low, high)| (low + high) * 0.5);
    if centre.length() <= far {
        return DVec3::ZERO;
    }
    // Rounded to f32, so that a file that stores the origin as f32 stores it exactly.
    let whole = centre.round().as_vec3().as_dvec3();
    if centre.z.abs() > far { whole } else { whole.with_z(0.0) }
}

/// Returns a label for an item of type `kind`: its number, and its name if it has one.
pub(super) fn item_label(kind: &str, name: &str, index: usize) -> String {
    if name.is_empty() { format!("{kind} {index}") } else { format!("{kind} {index} ({name:?})") }
}

fn unsound(mesh: &Mesh, index: usize, what: &str) -> Error {
    let error = Error::geometry(format!("{} {what}", item_label("mesh", &mesh.name, index)));
    error.help("look for a division by zero or an empty shape in what built it")
}

/// Measures `part`. Fails with the end of a sentence about its mesh.
fn check_part(scene: &Scene, part: &Part) -> Result<PartExtent, String> {
    let Some(material) = scene.materials.get(part.material) else {
        return Err(format!("refers to the missing material {}", part.material));
    };
    let count = part.positions.len();
    if part.normals.len() != count || part.uvs.len() != count {
        return Err("does not have one normal and one texture coordinate for each point".into());
    }
    if part.triangles.iter().flatten().any(|corner| corner as usize >= count) {
        return Err("has a triangle with a missing point".into());
    }
    let usable = |number: f32| f64::from(number.abs()) <= LARGEST;
    if !part.positions.iter().all(|p| usable(p.x) && usable(p.y) && usable(p.z)) {
        return Err("has a point with coordinates that are not finite or too large".into());
    }
    if let Some(size) = material.image_size() {
        let [width, height] = size;
        if !size.iter().all(|size| *size > 0.0 && size.is_finite()) {
            return Err(format!("has a texture of {width} m by {height} m"));
        }
        let relief = material.normal_map.as_ref().map(|map| &map.image);
        #[allow(clippy::float_cmp, reason = "the sizes come from one field")]
        if material.texture.iter().chain(relief).any(|image| image.size != size) {
            return Err("has a texture and a normal map of different sizes".into());
        }
        if let Some([width, height]) = material.dirt_map.as_ref().map(|dirt| dirt.image.size)
            && ![width, height].iter().all(|size| *size > 0.0 && size.is_finite())
        {
            return Err(format!("has a dirt map of {width} m by {height} m"));
        }
        if part.second_uvs.len() > count || !part.second_uvs.iter().all(|uv| usable(uv.x) && usable(uv.y)) {
            return Err("has second texture coordinates that are not finite, too large or too many".into());
        }
        if !part.uvs.iter().all(|uv| usable(uv.x) && usable(uv.y)) {
            return Err("has texture coordinates that are not finite or too large".into());
        }
    }
    let first = part.positions.first().copied().unwrap_or_default();
    let (low, high) =
        part.positions.iter().fold((first, first), |(low, high), p| (low.min(*p), high.max(*p)));
    Ok(PartExtent { triangles: triangles(part).count(), low, high })
}

#[cfg(test)]
mod tests {
    use super::super::samples;
    use super::*;

    #[test]
    fn a_scene_that_names_what_it_does_not_have_is_refused() {
        let refused = |break_it: fn(&mut Scene)| {
            let mut scene = samples::boxes(1);
            break_it(&mut scene);
            check(&scene).unwrap_err().message().to_owned()
        };
        insta::assert_snapshot!(
            refused(|it| it.instances[0].mesh = 7), @r#"instance 0 ("box 0") refers to the missing mesh 7"#
        );
        insta::assert_snapshot!(
            refused(|it| it.instances[0].transform.translation.x = f64::NAN),
            @r#"the transform of instance 0 ("box 0") has numbers that are not finite or too large"#
        );
        insta::assert_snapshot!(
            refused(|it| it.meshes[0].parts[0].material = 9), @r#"mesh 0 ("box") refers to the missing material 9"#
        );
        insta::assert_snapshot!(
            refused(|it| it.meshes[0].parts[0].triangles.push([0, 99, 1])),
            @r#"mesh 0 ("box") has a triangle with a missing point"#
        );
        insta::assert_snapshot!(
            refused(|it| it.meshes[0].parts[0].positions[0].y = f32::INFINITY),
            @r#"mesh 0 ("box") has a point with coordinates that are not finite or too large"#
        );
        insta::assert_snapshot!(
            refused(|it| it.meshes[0].parts[0].normals.truncate(23)),
            @r#"mesh 0 ("box") does not have one normal and one texture coordinate for each point"#
        );
    }

    #[test]
    fn a_near_model_keeps_its_coordinates_and_a_far_one_is_counted_from_whole_metres() {
        let around = |centre: DVec3| origin(Some((centre - 3.0, centre + 3.0)));
        assert_eq!(around(DVec3::new(9000.0, 2000.3, 40.0)), DVec3::ZERO);
        assert_eq!(around(DVec3::new(531_000.4, 4_556_000.7, 80.5)), DVec3::new(531_000.0, 4_556_001.0, 0.0));
        assert_eq!(origin(None), DVec3::ZERO);
    }
}
