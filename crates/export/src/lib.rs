//! Export: writes a scene as a model, a render or a drawing that other programs open.
//!
//! Input: a [`Scene`] in metres, z up. Output: one file, or several files that belong together, in the format of the
//! path's extension, from the table [`FORMATS`]. The crate never changes the scene and never leaves incomplete files: everything is
//! written next to the path under temporary names ([`Files`]) and published when all of it is complete. The same scene
//! results in the same bytes.
//!
//! Terrain heights are written by [`heights`], from a grid instead of a scene. A film of several scenes or renders is
//! written by [`films`].
//!
//! Every format rejects a scene with invalid references (`check`), omits the parts that are not shown, and moves a
//! model that is far from the world's origin to a nearby origin (`check::origin`).

#![allow(
    clippy::cast_possible_truncation,
    reason = "coordinates lose precision on purpose, and counts are checked against each format's limit"
)]

mod check;
mod city;
mod color;
mod conversions;
mod decompose;
mod facts;
mod files;
mod film_model;
mod film_settings;
pub mod films;
mod format;
mod formats;
pub mod gltf;
pub mod heights;
pub mod layers;
mod level_storage;
mod levels;
pub mod obj;
mod page;
mod recipe;
mod render;
mod solids;
mod surface_warning;
pub mod svg;
mod table;
mod target;
mod temporary;
mod texture;
mod usd;
mod x3d;
mod xml;

#[cfg(test)]
mod samples;

pub use city::write_city_sequence;
pub use facts::{Export, InstanceStorage, SceneFacts, SystemFacts};
pub use files::{Files, OpenFile, Out, Stoppable};
pub use format::{FileFormat, Format, Need, SurfaceDetail, extension_list};
pub use formats::{FORMATS, GLB, PAGE, PNG};
pub use level_storage::LevelStorage;
pub use levels::LevelModel;
pub use page::{PAGE_TRIANGLES, refused_page};
pub use recipe::read_recipe;
pub use render::png;
pub use temporary::abandon;

use burgeon_base::error::Result;
use burgeon_picture::Picture;
use burgeon_scene::Scene;
use std::io;
use std::path::Path;

/// Writes `scene` to `path` in the format of its extension; only `.png` uses `picture`.
///
/// `.gltf`, `.obj` and `.x3d` write additional files next to `path` whose names begin with its stem. On failure all
/// files are as before. Fails as [`Files::scene`] does.
///
/// ```
/// use burgeon_picture::Picture;
/// use burgeon_scene::{Instance, Mesh, Scene};
/// use glam::{DAffine3, Vec3};
///
/// # let (transform, name, feature) = (DAffine3::IDENTITY, String::from("tile"), None);
/// # let instance = Instance { mesh: 0, transform, name, feature, origin: None, placement: None, meaning: None };
/// let mut scene = Scene { instances: vec![instance], meshes: vec![Mesh::default()], ..Scene::default() };
/// let material = scene.material(&Default::default());
/// let part = scene.meshes[0].part(material);
/// part.positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
/// # (part.normals, part.uvs) = (vec![burgeon_scene::Normal::Z; 3], vec![glam::Vec2::ZERO; 3]);
/// part.triangles.push([0, 1, 2]);
/// let folder = tempfile::tempdir()?;
/// burgeon_export::write(&scene, &folder.path().join("tile.obj"), &Picture::default())?;
/// let text = std::fs::read_to_string(folder.path().join("tile.obj"))?;
/// assert_eq!(text.lines().filter(|line| line.starts_with("v ")).count(), 3);
/// assert!(folder.path().join("tile.mtl").exists());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write(scene: &Scene, path: &Path, picture: &Picture) -> Result<()> {
    let mut files = Files::default();
    files.scene(scene, path, picture)?;
    files.publish()
}

impl Files {
    /// Writes `scene` to the future file `path`, in the format of its extension; only `.png` uses `picture`.
    ///
    /// The export has no facts beyond the geometry. Fails as [`export`](Files::export) does.
    pub fn scene(&mut self, scene: &Scene, path: &Path, picture: &Picture) -> Result<()> {
        self.export(&Export { scene, picture, facts: SceneFacts::default() }, path)
    }

    /// Writes an export to the future file `path`, in the format of its extension.
    ///
    /// `.gltf`, `.obj` and `.x3d` write additional files next to `path` whose names begin with its stem. Fails as
    /// [`write`](Files::write) does, if the extension is unknown, if the scene is invalid, if a texture cannot be read,
    /// or if a point is outside the domain of the format's projection.
    pub fn export(&mut self, export: &Export<'_>, path: &Path) -> Result<()> {
        let format = Format::of(path)?;
        format.file.check()?;
        format.export(export, path, self)
    }
}

/// Writes one file completely or not at all. A target that is not a regular file, such as a pipe, receives the whole
/// content at once.
///
/// ```
/// use std::io::Write;
///
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("report.txt");
/// burgeon_export::write_file(&path, |out| out.write_all(b"done"))?;
/// assert_eq!(std::fs::read_to_string(&path)?, "done");
/// // A failure leaves the file as it was.
/// burgeon_export::write_file(&path, |_| Err(std::io::Error::other("no data"))).expect_err("the content fails");
/// assert_eq!(std::fs::read_to_string(&path)?, "done");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_file(path: &Path, content: impl FnOnce(&mut Out) -> io::Result<()>) -> Result<()> {
    let mut files = Files::default();
    files.write(path, content)?;
    files.publish()
}

/// Checks that [`Files::publish`] could write all of these files, to be called before a long run. It leaves no files
/// behind.
///
/// Fails if two paths are the same file, if a folder does not exist or is not writable, or if a path is a folder.
///
/// ```
/// use burgeon_export::check_files;
///
/// let folder = tempfile::tempdir()?;
/// let (model, picture) = (folder.path().join("town.glb"), folder.path().join("town.png"));
/// assert!(check_files([&*model, &*picture]).is_ok() && !model.exists());
/// assert!(check_files([&*model, &*model]).is_err());
/// assert!(check_files([&*folder.path().join("missing/town.glb")]).is_err());
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn check_files<'a>(paths: impl IntoIterator<Item = &'a Path>) -> Result<()> {
    let mut files = Files::default();
    paths.into_iter().try_for_each(|path| files.write(path, |_| Ok(())))
}

/// Returns the name of `path` without its extension.
fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// Encodes a file name as a relative reference (RFC 3986).
fn uri(name: &str) -> String {
    let mut uri = String::with_capacity(name.len());
    for byte in name.bytes() {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' => uri.push(char::from(byte)),
            _ => uri.push_str(&format!("%{byte:02X}")),
        }
    }
    uri
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Samples are kept in the folder `BURGEON_SAMPLES` if it is set, so that validators can check them.
    #[test]
    fn every_sample_is_written_in_every_format_and_leaves_no_temporary_file() {
        let temporary = tempfile::tempdir().unwrap();
        let folder = std::env::var_os("BURGEON_SAMPLES").map_or(temporary.path().to_path_buf(), Into::into);
        let samples = samples::all(temporary.path());
        assert_eq!(samples.len(), 17);
        for (name, scene) in &samples {
            for format in FORMATS.iter().filter(|format| **format != PNG) {
                let path = folder.join(format!("{name}.{}", format.extension()));
                check_files([path.as_path()]).unwrap();
                write(scene, &path, &Picture::default()).unwrap();
                // A table without reports has only its head.
                assert!(
                    path.metadata().unwrap().len() >= "system,feature\n".len() as u64,
                    "{}",
                    path.display()
                );
            }
        }
        for entry in std::fs::read_dir(folder).unwrap() {
            let name = entry.unwrap().file_name().into_string().unwrap();
            assert!(!name.ends_with(".part"), "{name} is left behind");
        }
    }

    #[test]
    fn a_refused_scene_leaves_the_older_files_as_they_were() {
        let folder = tempfile::tempdir().unwrap();
        let mut scene = samples::boxes(2);
        scene.meshes[0].parts[0].positions[0].x = f32::NAN;
        for name in ["a.glb", "a.gltf", "a.bin", "a.obj", "a.mtl", "a.svg"] {
            std::fs::write(folder.path().join(name), "old").unwrap();
        }
        for name in ["a.glb", "a.gltf", "a.obj", "a.svg"] {
            let error = write(&scene, &folder.path().join(name), &Picture::default()).unwrap_err();
            assert!(error.to_string().contains("box"), "{error}");
        }
        let mut count = 0;
        for entry in std::fs::read_dir(folder.path()).unwrap() {
            assert_eq!(std::fs::read_to_string(entry.unwrap().path()).unwrap(), "old");
            count += 1;
        }
        assert_eq!(count, 6);
    }

    #[test]
    fn a_picture_becomes_a_png_of_its_size() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let picture = Picture { width: 40, height: 30, ..Picture::default() };
        write(&samples::boxes(1), &path, &picture).unwrap();
        let image = burgeon_scene::image::decode(&std::fs::read(path).unwrap()).unwrap();
        assert_eq!((image.width(), image.height()), (40, 30));
    }
}
