//! Image files of a scene's materials.

use super::check::{SceneCheck, item_label};
use super::color::linear;
use super::files::Files;
use super::stem;
use burgeon_base::error::{Error, Result};
use burgeon_scene::image::{self, ImageKind};
use burgeon_scene::{Material, Texture};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Image files that shown materials use, each once, in the order of the materials.
pub(super) struct Images {
    /// Image files.
    pub(super) files: Vec<ImageFile>,
    /// For each material of the scene, the index of the file of its texture.
    pub(super) of_material: Vec<Option<usize>>,
    /// The same of its normal map; `None` if the format has no normal maps.
    pub(super) normals: Vec<Option<usize>>,
    /// The same of its dirt map; `None` if the format has no second set of texture coordinates.
    pub(super) dirt: Vec<Option<usize>>,
}

/// PNG or JPEG file, unchanged.
pub(super) struct ImageFile {
    path: PathBuf,
    /// Content of an image without a file, which distinguishes it from others.
    content: Option<Arc<[u8]>>,
    /// Content of the file, unchanged.
    pub(super) bytes: Vec<u8>,
    /// PNG or JPEG, according to the content and not the name.
    kind: ImageKind,
    /// Set if its pixels have an alpha channel.
    pub(super) has_alpha: bool,
}

impl Images {
    /// Reads the files of textures. Fails if one of them does not exist or is neither PNG nor JPEG.
    pub(super) fn load(checked: &SceneCheck<'_>) -> Result<Self> {
        let none = vec![None; checked.scene.materials.len()];
        let mut images =
            Self { files: Vec::new(), of_material: Vec::new(), normals: none.clone(), dirt: none };
        images.of_material = images.read_all(checked, "texture", |material| material.texture.as_ref())?;
        Ok(images)
    }

    /// Reads the files of textures, normal maps and dirt maps. Fails as [`load`](Self::load) does.
    pub(super) fn load_all(checked: &SceneCheck<'_>) -> Result<Self> {
        let mut images = Self::load_with_normals(checked)?;
        images.dirt = images
            .read_all(checked, "dirt map", |material| material.dirt_map.as_ref().map(|map| &map.image))?;
        Ok(images)
    }

    /// Reads the files of textures and of normal maps. Fails as [`load`](Self::load) does.
    pub(super) fn load_with_normals(checked: &SceneCheck<'_>) -> Result<Self> {
        let mut images = Self::load(checked)?;
        images.normals = images
            .read_all(checked, "normal map", |material| material.normal_map.as_ref().map(|map| &map.image))?;
        Ok(images)
    }

    /// Reads the image that `of` returns of each shown material. Returns the index of each file.
    fn read_all(
        &mut self,
        checked: &SceneCheck<'_>,
        what: &str,
        of: impl Fn(&Material) -> Option<&Texture>,
    ) -> Result<Vec<Option<usize>>> {
        let materials = checked.scene.materials.iter().enumerate();
        let index = |(i, material): (usize, &Material)| {
            let image = of(material).filter(|_| checked.materials[i]);
            image.map(|image| self.add(image, what, &item_label("material", &material.name, i))).transpose()
        };
        materials.map(index).collect()
    }

    /// Returns the index of an image, which is read if it is new.
    fn add(&mut self, image: &Texture, what: &str, material: &str) -> Result<usize> {
        let same = |file: &ImageFile| file.path == image.path && file.content == image.content;
        if let Some(known) = self.files.iter().position(same) {
            return Ok(known);
        }
        self.files.push(ImageFile::read(image, what, material)?);
        Ok(self.files.len() - 1)
    }

    /// Returns a file name for a copy of each image next to the export at `main`, such as `city_brick.png`.
    ///
    /// The names begin with the stem of the export, differ from each other and from the other names in `files`, and do
    /// not overwrite a source.
    pub(super) fn copy_names(&self, main: &Path, files: &Files) -> Vec<String> {
        let place = |path: &Path| fs::canonicalize(path).ok();
        let sources: Vec<_> = self.files.iter().filter_map(|file| place(&file.path)).collect();
        let mut names: Vec<String> = Vec::new();
        for file in &self.files {
            let own = if file.content.is_some() { plain(&file.stem()) } else { file.stem() };
            let stem = format!("{}_{own}", stem(main));
            let mut name = format!("{stem}.{}", file.extension());
            let mut count = 1;
            let is_taken = |name: &String| {
                let path = main.with_file_name(name);
                names.contains(name)
                    || place(&path).is_some_and(|it| sources.contains(&it))
                    || files.has(&path, &file.bytes) == Some(false)
            };
            while is_taken(&name) {
                count += 1;
                name = format!("{stem}_{count}.{}", file.extension());
            }
            names.push(name);
        }
        names
    }
}

/// Maximum size of an image file (bytes).
const LARGEST: u64 = 1_000_000_000;

impl ImageFile {
    fn read(texture: &Texture, what: &str, material: &str) -> Result<Self> {
        let path = &texture.path;
        let refused = |why: &dyn std::fmt::Display| {
            Error::file(path, format!("cannot read the {what} {} of {material}: {why}", path.display()))
        };
        let bytes = match &texture.content {
            Some(content) => content.to_vec(),
            None => burgeon_base::files::read(path, LARGEST).map_err(|error| {
                refused(&error).help("correct the path, which is relative to the script's folder")
            })?,
        };
        let remedy = "give a PNG or JPEG file that an image viewer opens";
        let kind =
            ImageKind::of(&bytes).ok_or_else(|| refused(&"it is neither PNG nor JPEG").help(remedy))?;
        let has_alpha = image::has_alpha(&bytes).map_err(|error| refused(&error.message()).help(remedy))?;
        let content = texture.content.clone();
        Ok(Self { path: path.clone(), content, bytes, kind, has_alpha })
    }

    /// Returns the file's name without folder and extension, or the whole name of an image without a file.
    pub(super) fn stem(&self) -> String {
        if self.content.is_some() {
            return self.path.to_string_lossy().into_owned();
        }
        self.path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// Returns `png` or `jpg`.
    pub(super) fn extension(&self) -> &'static str {
        self.kind.extension()
    }

    /// Returns the media type, such as `image/png`.
    pub(super) fn media_type(&self) -> &'static str {
        self.kind.media_type()
    }

    /// Computes the mean colour of the pixels weighted by opacity, linear from 0 to 1; white if the file is damaged.
    ///
    /// Fails in builds that do not decode images.
    pub(super) fn mean_color(&self) -> Result<[f32; 3]> {
        image::check()?;
        let Ok(image) = image::decode(&self.bytes) else { return Ok([1.0; 3]) };
        let lights: [f64; 256] = std::array::from_fn(|byte| f64::from(linear(byte as f32 / 255.0)));
        let mut sum = [0.0; 4];
        for [color @ .., alpha] in image.pixels() {
            let opacity = f64::from(*alpha);
            for (sum, byte) in sum.iter_mut().zip(color) {
                *sum += lights[usize::from(*byte)] * opacity;
            }
            sum[3] += opacity;
        }
        let [.., opacity] = sum;
        Ok(if opacity > 0.0 { [0, 1, 2].map(|channel| (sum[channel] / opacity) as f32) } else { [1.0; 3] })
    }
}

/// Maximum number of characters of an image's own name in the name of its copy. File systems allow about 255 bytes in
/// total.
const LONGEST: usize = 48;

/// Converts the name of an image without a file to a portable file name. Tiles, for example, are named by level, column
/// and row.
fn plain(name: &str) -> String {
    let name = Path::new(name).with_extension("");
    let letter = |letter: char| if letter.is_alphanumeric() || "-_.".contains(letter) { letter } else { '_' };
    name.to_string_lossy().chars().take(LONGEST).map(letter).collect()
}

#[cfg(test)]
mod tests {
    use super::super::check::check;
    use super::super::samples;
    use super::*;

    #[test]
    fn an_image_that_two_materials_share_is_read_once_and_its_mean_colour_is_known() {
        let folder = tempfile::tempdir().unwrap();
        let scene = samples::textured_boxes(folder.path());
        let images = Images::load(&check(&scene).unwrap()).unwrap();
        assert_eq!(images.of_material, [Some(0), Some(1), Some(0)]);
        let [red, green, blue] = images.files[0].mean_color().unwrap();
        assert!(red > 0.1 && green > 0.02 && blue < 0.05, "{red} {green} {blue}");
        assert!(!images.files[0].has_alpha);
        assert_eq!((images.files[0].extension(), images.files[1].extension()), ("png", "jpg"));
    }

    #[test]
    fn a_copy_never_overwrites_a_source() {
        let folder = tempfile::tempdir().unwrap();
        let mut scene = samples::textured_boxes(folder.path());
        let own = folder.path().join("out_brick.png");
        fs::copy(folder.path().join("brick.png"), &own).unwrap();
        if let Some(texture) = &mut scene.materials[1].texture {
            texture.path = own;
        }
        let images = Images::load(&check(&scene).unwrap()).unwrap();
        let main = folder.path().join("out.gltf");
        assert_eq!(images.copy_names(&main, &Files::default()), ["out_brick_2.png", "out_out_brick.png"]);
    }

    #[test]
    fn an_image_that_is_called_by_level_column_and_row_is_copied_under_a_name_for_files() {
        let folder = tempfile::tempdir().unwrap();
        let mut scene = samples::textured_boxes(folder.path());
        let content: Arc<[u8]> = fs::read(folder.path().join("brick.png")).unwrap().into();
        let long = "ä".repeat(300);
        for (material, name) in
            ["land 1 0/0/0.png", "a\\b: *?\"<>|\n.png", &format!("{long}.png")].into_iter().enumerate()
        {
            if let Some(texture) = &mut scene.materials[material].texture {
                (texture.path, texture.content) = (name.into(), Some(content.clone()));
            }
        }
        let images = Images::load(&check(&scene).unwrap()).unwrap();
        let long = format!("out_{}.png", "ä".repeat(LONGEST));
        let names = images.copy_names(&folder.path().join("out.gltf"), &Files::default());
        assert_eq!(names[..2], ["out_land_1_0_0_0.png", "out_a_b_________.png"]);
        assert!(names[2..].iter().all(|name| *name == long) && long.len() < 120, "{names:?}");
        crate::write(&scene, &folder.path().join("out.obj"), &Default::default()).unwrap();
        crate::write(&scene, &folder.path().join("out.gltf"), &Default::default()).unwrap();
        assert!(names.iter().all(|name| folder.path().join(name).is_file()));
    }

    #[test]
    fn a_texture_that_is_missing_or_no_image_is_refused_by_name() {
        let folder = tempfile::tempdir().unwrap();
        let scene = samples::textured_boxes(folder.path());
        let said = || {
            let error = Images::load(&check(&scene).unwrap()).map(|_| ()).unwrap_err().to_string();
            error.replace(&folder.path().display().to_string(), "FOLDER")
        };
        fs::write(folder.path().join("brick.png"), "no image").unwrap();
        insta::assert_snapshot!(said(), @r#"
        cannot read the texture FOLDER/brick.png of material 0 ("brick"): it is neither PNG nor JPEG
          help: give a PNG or JPEG file that an image viewer opens
        "#);
        fs::remove_file(folder.path().join("brick.png")).unwrap();
        assert!(said().contains("brick.png of material 0"), "{}", said());
    }
}
