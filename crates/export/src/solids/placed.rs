//! Triangles and normals of instances in the world.

use crate::check::{SceneCheck, triangles};
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::text::grouped;
use burgeon_scene::{Instance, Part};
use glam::{DAffine3, DVec3};

/// Shown instance with its transform to the coordinates of the file (m).
pub(super) struct PlacedMesh<'a> {
    pub(super) parts: &'a [Part],
    pub(super) transform: DAffine3,
    /// Set if the transform mirrors, so that triangles change their orientation.
    pub(super) mirrored: bool,
}

impl<'a> PlacedMesh<'a> {
    /// Returns the shown instances of a scene, relative to the origin of the file.
    pub(super) fn all(checked: &SceneCheck<'a>) -> impl Iterator<Item = Self> + use<'a> {
        let (scene, origin, shown) = (checked.scene, checked.origin, checked.meshes.clone());
        let instances = scene.instances.iter().filter(move |instance| shown[instance.mesh]);
        instances.map(move |instance| {
            let mut transform = instance.transform;
            transform.translation -= origin;
            let mirrored = is_mirrored(instance);
            Self { parts: &scene.meshes[instance.mesh].parts, transform, mirrored }
        })
    }

    /// Returns the triangles of `part` with the orientation that they have in the world.
    pub(super) fn triangles(&self, part: &'a Part) -> impl Iterator<Item = [u32; 3]> + use<'a> {
        let mirrored = self.mirrored;
        triangles(part).map(move |[a, b, c]| if mirrored { [a, c, b] } else { [a, b, c] })
    }
}

/// Returns true if the transform of `instance` mirrors.
pub(super) fn is_mirrored(instance: &Instance) -> bool {
    instance.transform.matrix3.determinant() < 0.0
}

/// Returns the number of triangles that are written: those with three different corners, for each instance.
pub(super) fn written_triangles(checked: &SceneCheck<'_>) -> usize {
    let of_mesh: Vec<usize> =
        checked.parts.iter().map(|parts| parts.iter().map(|part| part.triangles).sum()).collect();
    checked.scene.instances.iter().map(|instance| of_mesh[instance.mesh]).sum()
}

/// Fails if a file of a format that is called `format` would have more than `limit` bytes.
pub(super) fn check_size(format: &str, bytes: u64, limit: u64, triangles: usize) -> Result<()> {
    if bytes <= limit {
        return Ok(());
    }
    let gigabytes = |bytes: u64| bytes as f64 / 1e9;
    let message = format!(
        "{format} with {} triangles would have {:.1} GB; the limit is {:.1} GB",
        grouped(triangles),
        gigabytes(bytes),
        gigabytes(limit)
    );
    Err(Error::limit(Limit::Format, message)
        .help("write a .glb, which stores repeated models once, reduce the model with --lod, or write parts with --parts N"))
}

/// Returns the position of `point` in millimetres.
pub(super) fn millimetres(point: DVec3) -> DVec3 {
    point * 1000.0
}
