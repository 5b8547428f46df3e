//! Warnings of images of materials that a format does not have.

use std::path::Path;

use super::check::check;
use super::facts::Export;
use super::files::Files;
use super::format::{Format, SurfaceDetail, extension_list};
use super::formats::FORMATS;
use burgeon_base::error::Result;
use burgeon_base::{Warning, WarningKind};
use burgeon_scene::{Material, Scene};

/// Kind of an image: its name, the detail that a format needs for it, and its presence in a material.
type MaterialImage = (&'static str, SurfaceDetail, fn(&Material) -> bool);

/// Images for which there are warnings. A format without textures has their mean colours, or no colours at all, as its
/// title says.
const KINDS: [MaterialImage; 2] = [
    ("normal map", SurfaceDetail::Relief, |material| material.normal_map.is_some()),
    ("dirt map", SurfaceDetail::Full, |material| material.dirt_map.is_some()),
];

impl Format {
    /// Writes an export to the future file `path`, and adds warnings of what its materials have and the format lacks.
    pub(super) fn export(&self, export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
        (self.write)(export, path, files)?;
        files.warn_all(surface_warnings(self, export.scene, path)?);
        Ok(())
    }
}

/// Returns warnings of the images of shown materials that a file at `path` in a `format` does not have. Fails if the scene
/// is invalid.
fn surface_warnings(format: &Format, scene: &Scene, path: &Path) -> Result<Vec<Warning>> {
    let Some(detail) = format.surface else { return Ok(Vec::new()) };
    let missing: Vec<&MaterialImage> = KINDS.iter().filter(|(_, least, _)| detail < *least).collect();
    if !missing.iter().any(|(_, _, has)| scene.materials.iter().any(has)) {
        return Ok(Vec::new());
    }
    let checked = check(scene)?;
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let mut warnings = Vec::new();
    for (kind, least, has) in missing {
        let materials = scene.materials.iter().zip(&checked.materials);
        let count = materials.filter(|(material, is_shown)| **is_shown && has(material)).count();
        if count == 0 {
            continue;
        }
        let materials = if count == 1 { "a material".into() } else { format!("{count} materials") };
        let message = format!("{name} has no {kind} of {materials}: {}", reason(detail));
        let others = FORMATS.iter().filter(|format| format.surface >= Some(*least));
        let help = format!("write {}, which have it", extension_list(others, "or"));
        warnings.push(Warning::new(WarningKind::NoEffect, message).help(help));
    }
    Ok(warnings)
}

/// Returns the reason why a format of this detail lacks images, as a clause.
fn reason(detail: SurfaceDetail) -> &'static str {
    match detail {
        SurfaceDetail::Outline => "the file has no materials",
        SurfaceDetail::Color => "the file has one colour on a surface",
        SurfaceDetail::Texture => "the file has one image on a surface",
        SurfaceDetail::Relief | SurfaceDetail::Full => "the file has one set of texture coordinates",
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples;
    use super::*;
    use crate::SceneFacts;
    use burgeon_picture::Picture;

    /// Returns the warnings of normal maps and dirt maps that a format gives for a scene.
    fn warnings(format: &Format, scene: &Scene) -> Vec<String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(format!("a.{}", format.extension()));
        let picture = Picture { width: 32, height: 32, ..Picture::default() };
        let mut files = Files::default();
        files.export(&Export { scene, picture: &picture, facts: SceneFacts::default() }, &path).unwrap();
        let all = files.take_warnings();
        all.iter().map(ToString::to_string).filter(|text| text.contains(" map of ")).collect()
    }

    #[test]
    fn each_format_of_scenes_says_which_images_it_does_not_have() {
        let folder = tempfile::tempdir().unwrap();
        let (stained, relief) = (samples::stained_boxes(folder.path()), samples::relief_boxes(folder.path()));
        let mut silent = [Vec::new(), Vec::new()];
        let mut count = 0;
        for format in FORMATS.iter().filter(|format| format.surface.is_some()) {
            for (number, (scene, text)) in
                [(&stained, "has no dirt map of 2 materials"), (&relief, "has no normal map of 2 materials")]
                    .into_iter()
                    .enumerate()
            {
                match warnings(format, scene).as_slice() {
                    [] => silent[number].push(format.extension()),
                    [one] => assert!(one.contains(text), "{one}"),
                    more => panic!("{more:?}"),
                }
            }
            count += 1;
        }
        assert_eq!(count, 13);
        assert_eq!(silent[0], ["glb", "gltf", "html", "png"]);
        assert_eq!(silent[1], ["glb", "gltf", "html", "obj", "usda", "png"]);
    }

    #[test]
    fn a_warning_names_the_file_the_reason_and_the_formats_that_have_the_image() {
        let folder = tempfile::tempdir().unwrap();
        let scene = samples::stained_boxes(folder.path());
        let all = ["ply", "x3d", "usda", "stl"].map(|extension| {
            let path = format!("a.{extension}");
            warnings(Format::of(Path::new(&path)).unwrap(), &scene).concat()
        });
        insta::assert_snapshot!(all.join("\n"), @r"
        a.ply has no dirt map of 2 materials: the file has one colour on a surface
          help: write .glb, .gltf, .html or .png, which have it
        a.x3d has no dirt map of 2 materials: the file has one image on a surface
          help: write .glb, .gltf, .html or .png, which have it
        a.usda has no dirt map of 2 materials: the file has one set of texture coordinates
          help: write .glb, .gltf, .html or .png, which have it
        a.stl has no dirt map of 2 materials: the file has no materials
          help: write .glb, .gltf, .html or .png, which have it
        ");
    }

    #[test]
    fn a_material_that_is_not_shown_causes_no_warning() {
        let folder = tempfile::tempdir().unwrap();
        let mut scene = samples::stained_boxes(folder.path());
        scene.instances.clear();
        let ply = Format::of(Path::new("a.ply")).unwrap();
        assert!(surface_warnings(ply, &scene, Path::new("a.ply")).unwrap().is_empty());
    }

    #[test]
    fn formats_of_scenes_have_surfaces() {
        for format in &FORMATS {
            assert_eq!(format.surface.is_some(), format.needs(crate::Need::Scene), "{}", format.extension());
        }
    }
}
