//! Files: a scene becomes a model, a picture or a drawing that other programs open.
//!
//! Comes in: a [`Scene`] in metres, z up. Goes out: one file, or several that belong together, picked by the
//! path's extension ([`Format`]). It never changes the scene, and it never leaves half a file: everything is
//! written beside the path under temporary names (`file`) and appears when all of it is there. The same
//! scene gives the same bytes.
//!
//! Heights of the ground are written by [`heights`], from a grid and not from a scene.
//!
//! Every format refuses a scene that names what it does not have (`check`), leaves out what is not shown,
//! and moves a model that is far from the world's origin near to its own (`check::origin`).

#![allow(
    clippy::cast_possible_truncation,
    reason = "coordinates lose precision on purpose, and counts are checked against each format's limit"
)]

mod check;
mod color;
mod file;
mod format;
pub mod gltf;
pub mod heights;
pub mod obj;
pub mod svg;
mod texture;

#[cfg(test)]
mod samples;

pub use format::Format;

use crate::error::Result;
use crate::picture::{self, Picture};
use crate::scene::Scene;
use file::Files;
use std::fs::File;
use std::io::{self, BufWriter, Cursor, Write};
use std::path::Path;

/// Writes `scene` to `path` in the format of its extension; `picture` matters to `.png` alone.
///
/// `.gltf` and `.obj` bring files beside `path` whose names begin with its stem. On failure everything is as
/// it was before. Fails as [`check_writable`] does, if the scene is not sound, if a texture cannot be read,
/// and if the disk is full.
pub fn write(scene: &Scene, path: &Path, picture: &Picture) -> Result<()> {
    let format = Format::of(path)?;
    let mut files = Files::beside(path)?;
    match format {
        Format::Glb => gltf::write_glb(scene, &mut files)?,
        Format::Gltf => gltf::write_gltf(scene, &mut files)?,
        Format::Obj => obj::write(scene, &mut files)?,
        Format::Png => {
            let png = png(scene, picture)?;
            files.write(path, |out| out.write_all(&png))?;
        }
        Format::Svg => {
            let drawing = svg::svg(scene)?;
            files.write(path, |out| out.write_all(drawing.as_bytes()))?;
        }
    }
    files.publish()
}

/// Whether [`write()`] could write to `path`: to be asked before a long run. It leaves nothing behind.
///
/// Fails if the extension is not a format, the folder is not there or takes no files, or `path` is a folder.
pub fn check_writable(path: &Path) -> Result<()> {
    Format::of(path)?;
    check_file(path)
}

/// Whether [`write_file()`] could write to `path`: to be asked before a long run. It leaves nothing behind.
///
/// Fails if the folder is not there or takes no files, or `path` is a folder.
pub fn check_file(path: &Path) -> Result<()> {
    let mut files = Files::beside(path)?;
    files.write(path, |_| Ok(()))
}

/// Writes one file whole or not at all; what is no regular file, such as a pipe, is written as it comes.
pub fn write_file(path: &Path, content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> Result<()> {
    if path.metadata().is_ok_and(|known| !known.is_file() && !known.is_dir()) {
        let written = File::options().write(true).open(path).and_then(|file| {
            let mut out = BufWriter::new(file);
            content(&mut out).and_then(|()| out.flush())
        });
        return written
            .map_err(|error| crate::error::Error::new(format!("cannot write {}: {error}", path.display())));
    }
    let mut files = Files::beside(path)?;
    files.write(path, content)?;
    files.publish()
}

/// The picture of `scene` as a PNG file. Fails as [`picture::render`] does.
pub fn png(scene: &Scene, picture: &Picture) -> Result<Vec<u8>> {
    encode_png(&picture::render(scene, picture)?)
}

/// `image` as a PNG file.
pub fn encode_png(image: &image::RgbaImage) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    image
        .write_to(&mut Cursor::new(&mut bytes), image::ImageFormat::Png)
        .map_err(|error| crate::error::Error::new(format!("cannot encode the picture as PNG: {error}")))?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The samples go to the folder `BURGEON_SAMPLES` if it is set, where validators can look at them.
    #[test]
    fn every_sample_is_written_in_every_format_and_leaves_no_temporary_file() {
        let temporary = tempfile::tempdir().unwrap();
        let folder = std::env::var_os("BURGEON_SAMPLES").map_or(temporary.path().to_path_buf(), Into::into);
        let samples = samples::all(temporary.path());
        assert_eq!(samples.len(), 16);
        for (name, scene) in &samples {
            for format in Format::ALL.into_iter().filter(|format| *format != Format::Png) {
                let path = folder.join(format!("{name}.{}", format.extension()));
                check_writable(&path).unwrap();
                write(scene, &path, &Picture::default()).unwrap();
                assert!(path.metadata().unwrap().len() > 20, "{}", path.display());
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
        assert_eq!(image::open(path).unwrap().into_rgba8().dimensions(), (40, 30));
    }
}
