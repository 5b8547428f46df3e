//! Wavefront OBJ, the text format that almost every modelling program reads.
//!
//! OBJ has no instances, so each instance becomes a separate object in world coordinates. OBJ does not define axes
//! either: y is up here, as in glTF. Materials have the classic lighting parameters and, for programs that support
//! them, the physically based `Pr`, `Pm` and `norm`.

use std::borrow::Cow;

use super::check::{SceneCheck, check, shown_parts, triangles};
use super::color::{fraction, srgb};
use super::decompose::normal_matrix;
use super::facts::Export;
use super::files::Files;
use super::stem;
use super::texture::Images;
use burgeon_base::error::Result;
use burgeon_base::text::grouped;
use burgeon_base::{Warning, WarningKind};
use burgeon_scene::{Instance, Material, Part};
use burgeon_spatial::ReferenceFrame;
use glam::DVec3;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Writes an `.obj` file to `path`, with its `.mtl` file and copies of the textures next to it.
pub(super) fn write(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
    let Export { scene, facts, .. } = export;
    let checked = check(scene)?;
    files.warn(size_warning(&checked, path));
    let images = Images::load_with_normals(&checked)?;
    let copies: Vec<String> =
        images.copy_names(path, files).iter().map(|name| word(name, "texture")).collect();
    for (name, file) in copies.iter().zip(&images.files) {
        files.copy(&path.with_file_name(name), &file.bytes)?;
    }
    let names = material_names(&scene.materials);
    let library = library_name(path);
    files.write(&path.with_file_name(&library), |out| {
        writeln!(out, "{}", heading())?;
        for (i, material) in scene.materials.iter().enumerate().filter(|(i, _)| checked.materials[*i]) {
            let copy = |file: usize| copies[file].as_str();
            let files = [images.of_material[i].map(copy), images.normals[i].map(copy)];
            write_material(material, &names[i], files, out)?;
        }
        Ok(())
    })?;
    files.write(path, |out| write_objects(&checked, facts.frame, &names, &library, out))
}

/// Smallest file (bytes) that causes a warning about its size.
const NOTABLE: usize = 50_000_000;

/// Ratio of the sizes of an `.obj` and a `.glb` file from which on there is a warning.
const RATIO: usize = 10;

/// Returns a warning if the file at `path` will be much larger than a `.glb` file, because it repeats its instances.
fn size_warning(checked: &SceneCheck<'_>, path: &Path) -> Option<Warning> {
    // Bytes of the points and triangles of each mesh: as text, and in arrays.
    let sizes: Vec<[usize; 2]> = checked
        .scene
        .meshes
        .iter()
        .zip(&checked.parts)
        .map(|(mesh, measured)| {
            let points: usize = mesh.parts.iter().map(|part| part.positions.len()).sum();
            let triangles: usize = measured.iter().map(|part| part.triangles).sum();
            if triangles == 0 { [0, 0] } else { [points * 55 + triangles * 40, points * 16 + triangles * 8] }
        })
        .collect();
    let instances = &checked.scene.instances;
    let text = instances.iter().fold(0_usize, |sum, it| sum.saturating_add(sizes[it.mesh][0]));
    let arrays = sizes.iter().map(|[_, arrays]| arrays).sum::<usize>() + instances.len() * 40;
    if text < NOTABLE || text / RATIO < arrays {
        return None;
    }
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let message = format!(
        "{name} has about {} MB, {} times as much as a .glb, because it repeats {} instances",
        grouped(text / 1_000_000),
        grouped(text / arrays.max(1)),
        grouped(instances.len())
    );
    Some(
        Warning::new(WarningKind::LargeFile, message)
            .help("write a .glb or a .usda, which store repeated models once"),
    )
}

/// Returns the path of the materials of the `.obj` file at `path`.
pub(super) fn library_path(path: &Path) -> PathBuf {
    path.with_file_name(library_name(path))
}

fn library_name(path: &Path) -> String {
    word(&format!("{}.mtl", stem(path)), "materials.mtl")
}

fn heading() -> String {
    format!("# Burgeon {}", env!("CARGO_PKG_VERSION"))
}

/// Writes everything except the materials, whose `names` are in the file `library`.
fn write_objects(
    checked: &SceneCheck<'_>,
    frame: Option<&ReferenceFrame>,
    names: &[String],
    library: &str,
    out: &mut impl Write,
) -> io::Result<()> {
    writeln!(out, "{}\n# Metres, y up: east is x, north is -z.", heading())?;
    let DVec3 { x, y, z } = y_up(checked.origin) + 0.0;
    if checked.origin != DVec3::ZERO {
        writeln!(out, "# Counted from ({x}, {y}, {z}): add this to each point for its place in the world.")?;
    }
    if let Some(frame) = frame {
        writeln!(out, "# The origin is at {}.", frame.world_place())?;
    }
    for package in &checked.scene.packages {
        writeln!(out, "# package {} {} {}", package.name, package.version, package.hash)?;
    }
    writeln!(out, "mtllib {library}")?;
    let mut numbers = ObjNumbers { point: 1, tex_coord: 1 };
    for instance in checked.scene.instances.iter().filter(|instance| checked.meshes[instance.mesh]) {
        let mesh = &checked.scene.meshes[instance.mesh];
        let name = if instance.name.is_empty() { &mesh.name } else { &instance.name };
        writeln!(out, "o {}", word(name, "object"))?;
        if let Some(feature) = &instance.feature {
            writeln!(out, "# feature {}", feature.replace(char::is_control, " "))?;
        }
        for part in shown_parts(mesh) {
            writeln!(out, "usemtl {}", names[part.material])?;
            let size = checked.scene.materials[part.material].image_size();
            write_part(part, size, instance, checked.origin, &mut numbers, out)?;
        }
    }
    Ok(())
}

/// Numbers of the next point and texture coordinate. OBJ counts from 1 through the whole file.
struct ObjNumbers {
    point: u64,
    tex_coord: u64,
}

/// Writes the points and triangles of `part`; `size` is the size (m) of its images.
fn write_part(
    part: &Part,
    size: Option<[f64; 2]>,
    instance: &Instance,
    origin: DVec3,
    numbers: &mut ObjNumbers,
    out: &mut impl Write,
) -> io::Result<()> {
    let turned = normal_matrix(&instance.transform.matrix3);
    for position in &part.positions {
        let point = instance.transform.transform_point3(position.as_dvec3()) - origin;
        write_vector("v", point, out)?;
    }
    for normal in part.normals.iter().map(|normal| normal.vector()) {
        write_vector("vn", (turned * normal.as_dvec3()).try_normalize().unwrap_or(DVec3::Z), out)?;
    }
    if let Some([width, height]) = size {
        for uv in &part.uvs {
            writeln!(out, "vt {} {}", (f64::from(uv.x) / width) as f32, (f64::from(uv.y) / height) as f32)?;
        }
    }
    let mirrored = instance.transform.matrix3.determinant() < 0.0;
    for [a, b, c] in triangles(part) {
        out.write_all(b"f")?;
        for corner in if mirrored { [a, c, b] } else { [a, b, c] } {
            let point = numbers.point + u64::from(corner);
            match size {
                Some(_) => write!(out, " {point}/{}/{point}", numbers.tex_coord + u64::from(corner))?,
                None => write!(out, " {point}//{point}")?,
            }
        }
        out.write_all(b"\n")?;
    }
    numbers.point += part.positions.len() as u64;
    if size.is_some() {
        numbers.tex_coord += part.uvs.len() as u64;
    }
    Ok(())
}

/// Writes a vector of the scene, z up, as the shortest decimals that represent the same f32.
fn write_vector(key: &str, vector: DVec3, out: &mut impl Write) -> io::Result<()> {
    let [x, y, z] = (y_up(vector).as_vec3() + 0.0).to_array();
    writeln!(out, "{key} {x} {y} {z}")
}

fn y_up(vector: DVec3) -> DVec3 {
    DVec3::new(vector.x, vector.z, -vector.y)
}

fn write_material(
    material: &Material,
    name: &str,
    [texture, normal]: [Option<&str>; 2],
    out: &mut impl Write,
) -> io::Result<()> {
    let [r, g, b, opacity] = material.base_color.map(fraction);
    let (metallic, roughness) = (fraction(material.metallic), fraction(material.roughness));
    // Specular reflection: 4 % of the light for dielectrics, and the metal's own colour for metals.
    let specular = [r, g, b].map(|color| 0.04 + (color - 0.04) * metallic);
    // Exponent of Blinn and Phong for the same roughness (Karis, "Specular BRDF Reference", 2013).
    let exponent = (2.0 / roughness.max(0.045).powi(4) - 2.0).clamp(0.0, 1000.0);
    writeln!(out, "newmtl {name}\nillum 2")?;
    for (key, color) in [("Kd", [r, g, b]), ("Ks", specular), ("Ke", material.emissive)] {
        let [r, g, b] = color.map(srgb);
        writeln!(out, "{key} {r} {g} {b}")?;
    }
    writeln!(out, "Ns {exponent}\nd {opacity}\nPr {roughness}\nPm {metallic}")?;
    if let Some(texture) = texture {
        writeln!(out, "map_Kd {texture}")?;
    }
    if let Some((file, map)) = normal.zip(material.normal_map.as_ref()) {
        // Of the same extension as `Pr` and `Pm`, with the option of `bump`.
        match map.scale {
            1.0 => writeln!(out, "norm {file}")?,
            scale => writeln!(out, "norm -bm {scale} {file}")?,
        }
    }
    Ok(())
}

/// Returns a unique word for each material, as similar to its name as possible.
fn material_names(materials: &[Material]) -> Vec<String> {
    let mut names: Vec<String> = Vec::with_capacity(materials.len());
    let mut taken = rustc_hash::FxHashSet::default();
    for material in materials {
        let plain = word(&material.name, "material");
        let mut name = Cow::Borrowed(&*plain);
        let mut count = 1;
        while taken.contains(&*name) {
            count += 1;
            name = Cow::Owned(format!("{plain}_{count}"));
        }
        let name = name.into_owned();
        taken.insert(name.clone());
        names.push(name);
    }
    names
}

/// Replaces the characters of `name` that would end a name or a line in OBJ. Returns `other` if `name` is empty.
fn word(name: &str, other: &str) -> String {
    let name = if name.is_empty() { other } else { name };
    name.replace(|letter: char| letter.is_whitespace() || letter.is_control() || letter == '#', "_")
}

#[cfg(test)]
mod tests {
    use super::super::samples;
    use super::*;
    use burgeon_scene::Scene;

    /// Content of an OBJ file: the points, the triangles with the indices of their normals, and the text.
    struct ObjContent {
        points: Vec<DVec3>,
        normals: Vec<DVec3>,
        faces: Vec<[[usize; 2]; 3]>,
        text: String,
    }

    fn read(path: &Path) -> ObjContent {
        let text = std::fs::read_to_string(path).unwrap();
        let mut read = ObjContent { points: vec![], normals: vec![], faces: vec![], text: text.clone() };
        for line in text.lines() {
            let mut words = line.split(' ');
            let key = words.next().unwrap();
            if key == "f" {
                let corner = |word: &str| {
                    let mut numbers = word.split('/').map(|it| it.parse::<usize>().unwrap_or(1) - 1);
                    [numbers.next().unwrap(), numbers.nth(1).unwrap()]
                };
                let corners: Vec<_> = words.map(corner).collect();
                read.faces.push(corners.try_into().unwrap());
            } else if key == "v" || key == "vn" {
                let numbers: Vec<f64> = words.map(|it| it.parse().unwrap()).collect();
                let vector = DVec3::from_slice(&numbers);
                if key == "v" { read.points.push(vector) } else { read.normals.push(vector) }
            }
        }
        read
    }

    fn write_and_read(scene: &Scene) -> ObjContent {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a b.obj");
        super::super::write(scene, &path, &burgeon_picture::Picture::default()).unwrap();
        read(&path)
    }

    #[test]
    fn instances_become_objects_with_the_same_volume_and_normals_outside() {
        for (name, scene) in
            [("turned", samples::boxes(5)), ("sheared and mirrored", samples::twisted_tower())]
        {
            let read = write_and_read(&scene);
            assert_eq!(read.faces.len(), scene.triangles(), "{name}");
            let mut volume = 0.0;
            for face in &read.faces {
                let [a, b, c] = face.map(|[point, _]| read.points[point]);
                volume += a.dot(b.cross(c)) / 6.0;
                let outside = (b - a).cross(c - a);
                assert!(
                    face.iter()
                        .all(|[_, normal]| read.normals[*normal].dot(outside) > 0.99 * outside.length())
                );
            }
            let real = samples::volume(&scene);
            assert!(real > 0.1 && (volume - real).abs() < 1e-4 * real, "{name}: {volume} is not {real}");
        }
    }

    #[test]
    fn a_far_model_is_counted_from_whole_metres_that_the_file_tells() {
        let read = write_and_read(&samples::far_box());
        assert!(read.text.contains("# Counted from (531000, 0, -4556000): add this"), "{}", read.text);
        assert!(read.points.iter().all(|point| point.length() < 200.0));
    }

    #[test]
    fn a_file_that_grows_to_ten_times_a_glb_causes_a_warning_that_estimates_its_size() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.obj");
        let warnings = |scene: &Scene| {
            let mut files = Files::default();
            files.scene(scene, &path, &burgeon_picture::Picture::default()).unwrap();
            let warnings: Vec<String> = files.take_warnings().iter().map(|it| it.to_string()).collect();
            files.publish().unwrap();
            warnings
        };
        let scene = samples::many(40_000);
        let told = warnings(&scene);
        assert_eq!(told.len(), 1);
        let size = path.metadata().unwrap().len() as f64;
        let estimate = told[0].strip_prefix("a.obj has about ").and_then(|it| it.split(' ').next());
        let estimate: f64 = estimate.unwrap().parse::<f64>().unwrap() * 1e6;
        assert!((0.7..1.4).contains(&(size / estimate)), "{size} is not {estimate}");
        assert!(warnings(&samples::hill(200)).is_empty() && warnings(&samples::many(500)).is_empty());
    }

    #[test]
    fn names_that_repeat_or_have_spaces_become_different_words() {
        let named = |name: &str| Material { name: name.into(), ..Material::default() };
        let names = material_names(&[named("red brick"), named("red\tbrick"), named(""), named("Ziegel_ü")]);
        assert_eq!(names, ["red_brick", "red_brick_2", "material", "Ziegel_ü"]);
    }

    #[test]
    fn a_box_reads_as_text() {
        let mut scene = samples::boxes(1);
        scene.meshes[0].parts[0].triangles.truncate(1);
        scene.instances[0].feature = Some("way/7".into());
        let text = write_and_read(&scene).text;
        let lines: Vec<_> = text.lines().filter(|line| !line.starts_with("# Burgeon")).collect();
        assert_eq!(
            lines[..6],
            [
                "# Metres, y up: east is x, north is -z.",
                "mtllib a_b.mtl",
                "o box_0",
                "# feature way/7",
                "usemtl plaster",
                "v 0.5 0 0.5",
            ]
        );
        assert_eq!(lines.last(), Some(&"f 1//1 2//2 3//3"));
    }

    #[test]
    fn normal_maps_are_copied_and_named_with_their_scale() {
        let folder = tempfile::tempdir().unwrap();
        let scene = samples::relief_boxes(folder.path());
        let path = folder.path().join("out.obj");
        super::super::write(&scene, &path, &burgeon_picture::Picture::default()).unwrap();
        let library = std::fs::read_to_string(folder.path().join("out.mtl")).unwrap();
        assert!(library.contains("map_Kd out_brick.png\nnorm out_waves.png"), "{library}");
        assert!(library.contains("norm -bm 0.5 out_waves.png"), "{library}");
        assert!(folder.path().join("out_waves.png").is_file());
        let model = std::fs::read_to_string(&path).unwrap();
        assert_eq!(model.lines().filter(|line| line.starts_with("vt ")).count(), 72);
    }

    #[test]
    fn textures_are_copied_and_named() {
        let folder = tempfile::tempdir().unwrap();
        let scene = samples::textured_boxes(folder.path());
        let path = folder.path().join("out.obj");
        super::super::write(&scene, &path, &burgeon_picture::Picture::default()).unwrap();
        let library = std::fs::read_to_string(folder.path().join("out.mtl")).unwrap();
        assert!(
            library.contains("map_Kd out_brick.png") && library.contains("map_Kd out_leaf.jpg"),
            "{library}"
        );
        assert_eq!(
            std::fs::read(folder.path().join("out_brick.png")).unwrap(),
            std::fs::read(folder.path().join("brick.png")).unwrap()
        );
        assert!(read(&path).text.contains("vt 2 1.5"));
    }
}
