//! Writes a scene as a document and its arrays as the binary part.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use super::body::Body;
use super::description::{Description, use_extension};
use super::expand::expand;
use super::material::Textures;
use super::mesh::Arrays;
use super::metadata::Metadata;
use super::packing::MESHOPT;
use super::quantize::{TEXTURE_TRANSFORM, TexCoordRanges};
use super::{InstancePlace, body, camera, film, material, mesh, place};
use crate::check::{SceneCheck, check};
use crate::decompose::{Y_UP_AXES, y_up};
use crate::files::Files;
use crate::film_model::FilmModel;
use crate::film_settings::FilmSettings;
use crate::texture::Images;
use crate::{Export, InstanceStorage, SceneFacts, stem, uri};
use burgeon_base::error::{Error, Result};
use burgeon_base::stop::Stop;
use burgeon_base::text::grouped;
use burgeon_scene::{Scene, ScenePackage};
use glam::DAffine3;
use gltf_json as json;
use json::extras::RawValue;

/// Extension that allows integer attributes.
pub(super) const QUANTIZATION: &str = "KHR_mesh_quantization";

/// Description and the data that it describes.
pub(super) struct Document<'a> {
    description: Description<'a>,
    body: Body<'a>,
    layout: Layout,
    /// Number of repeated instances that have nodes of their own.
    separate: usize,
    /// Largest error (m) of positions along an axis, if they are integers.
    rounding: Option<f64>,
}

/// Mapping from the items of a scene to the nodes and meshes of a document.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Layout {
    /// For each instance of the scene, the node that shows it.
    pub places: Vec<Option<InstancePlace>>,
    /// For each mesh of the scene, its index in the document.
    pub meshes: Vec<Option<usize>>,
}

/// Encodes `scene` as the bytes of a `.glb` file.
///
/// Fails if the scene is invalid, if a texture cannot be read, or if the file exceeds 4 GiB.
pub fn glb(scene: &Scene) -> Result<Vec<u8>> {
    bytes(scene, Arrays::default(), &Stop::default()).map(|(bytes, _)| bytes)
}

/// Encodes `scene` as [`glb`] does, but as small as possible without visible loss, for a viewer. Also returns the
/// layout of the document.
///
/// Primitives with `flat` in their extras require a viewer that supports it: each triangle has the normal of its last
/// corner.
///
/// ```
/// use burgeon_export::gltf::glb_for_viewer;
/// use burgeon_scene::{Mesh, Scene};
///
/// // The mesh has no instance, so the document does not contain it.
/// let scene = Scene { meshes: vec![Mesh::default()], ..Scene::default() };
/// let (bytes, layout) = glb_for_viewer(&scene)?;
/// assert_eq!((&bytes[..4], layout.meshes), (&b"glTF"[..], vec![None]));
/// # Ok::<(), burgeon_base::Error>(())
/// ```
pub fn glb_for_viewer(scene: &Scene) -> Result<(Vec<u8>, Layout)> {
    bytes(scene, Arrays { small: true, ..Arrays::default() }, &Stop::default())
}

/// Encodes `scene` as [`glb_for_viewer`] does, with the same layout, but all surfaces have texture coordinates: in
/// metres if they have no texture. Also fails if `stop` requests cancellation.
pub fn glb_with_texture_coordinates(scene: &Scene, stop: &Stop) -> Result<Vec<u8>> {
    bytes(scene, Arrays { small: true, measured: true, ..Arrays::default() }, stop).map(|(bytes, _)| bytes)
}

/// Encodes `scene` as [`glb_for_viewer`] does, with compressed arrays (`EXT_meshopt_compression`). `allow` may refuse the size
/// (bytes) of the arrays and of the textures, before they are compressed.
pub(crate) fn packed_glb_for_viewer(
    scene: &Scene,
    allow: impl FnOnce(u64, u64) -> Result<()>,
    stop: &Stop,
) -> Result<Vec<u8>> {
    let checked = check(scene)?;
    let images = Images::load_all(&checked)?;
    let pictures: usize = images.files.iter().map(|file| file.bytes.len()).sum();
    let arrays = Arrays { small: true, ..Arrays::default() };
    let facts = SceneFacts::default();
    let mut document = Document::new(&checked, &facts, &images, &Textures::Embedded, (arrays, None), stop)?;
    allow(document.body.length().saturating_sub(pictures as u64), pictures as u64)?;
    document.compress()?;
    stop.check()?;
    let mut bytes = Vec::new();
    document.body.write(document.head()?, &mut bytes, stop).map_err(Error::internal)?;
    stop.check()?;
    Ok(bytes)
}

fn bytes(scene: &Scene, arrays: Arrays, stop: &Stop) -> Result<(Vec<u8>, Layout)> {
    let checked = check(scene)?;
    let images = Images::load_all(&checked)?;
    let document =
        Document::new(&checked, &SceneFacts::default(), &images, &Textures::Embedded, (arrays, None), stop)?;
    let mut bytes = Vec::new();
    let head = document.head()?;
    let length: usize = head.iter().map(|piece| piece.len()).sum();
    bytes.reserve_exact(length + document.body.length() as usize);
    document.body.write(head, &mut bytes, stop).map_err(Error::internal)?;
    stop.check()?;
    Ok((bytes, document.layout))
}

/// Writes one `.glb` file to `path`.
pub(crate) fn write_glb(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
    let expanded = expand_if_chosen(export)?;
    let checked = check(expanded.as_ref().unwrap_or(export.scene))?;
    let images = Images::load_all(&checked)?;
    let stop = files.stop();
    let content = (Arrays::of(&export.facts), None);
    let mut document = Document::new(&checked, &export.facts, &images, &Textures::Embedded, content, &stop)?;
    if export.facts.is_compressed {
        document.compress()?;
    }
    document.write(path, files, &stop)?;
    files.note_all(document.notes(path));
    Ok(())
}

/// Returns the scene with merged instances, if they are requested.
fn expand_if_chosen(export: &Export<'_>) -> Result<Option<Scene>> {
    let is_expanded = export.facts.instances == InstanceStorage::Expanded;
    is_expanded.then(|| expand(export.scene)).transpose()
}

/// Writes one `.glb` file to `path`, with an animation that shows the model of one frame after another.
pub(crate) fn write_film(
    model: &FilmModel,
    settings: &FilmSettings,
    path: &Path,
    files: &mut Files,
) -> Result<()> {
    let checked = check(&model.scene)?;
    let images = Images::load_all(&checked)?;
    let stop = files.stop();
    let content = (Arrays::default(), Some((model, Some(settings))));
    let facts = SceneFacts::default();
    let document = Document::new(&checked, &facts, &images, &Textures::Embedded, content, &stop)?;
    document.write(path, files, &stop)
}

/// Writes one `.glb` file to `path` with the levels of detail of `model`.
pub(crate) fn write_levels(
    model: &FilmModel,
    facts: &SceneFacts<'_>,
    path: &Path,
    files: &mut Files,
) -> Result<()> {
    let checked = check(&model.scene)?;
    let images = Images::load_all(&checked)?;
    let stop = files.stop();
    let content = (Arrays::of(facts), Some((model, None)));
    let mut document = Document::new(&checked, facts, &images, &Textures::Embedded, content, &stop)?;
    if facts.is_compressed {
        document.compress()?;
    }
    document.write(path, files, &stop)?;
    files.note_all(document.notes(path));
    Ok(())
}

/// Writes a `.gltf` file to `path`, with a `.bin` file and copies of the textures next to it.
pub(crate) fn write_gltf(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
    let expanded = expand_if_chosen(export)?;
    let checked = check(expanded.as_ref().unwrap_or(export.scene))?;
    let images = Images::load_all(&checked)?;
    let names = images.copy_names(path, files);
    for (name, file) in names.iter().zip(&images.files) {
        files.copy(&path.with_file_name(name), &file.bytes)?;
    }
    let stop = files.stop();
    let textures = Textures::Beside(names);
    let content = (Arrays::of(&export.facts), None);
    let mut document = Document::new(&checked, &export.facts, &images, &textures, content, &stop)?;
    if let Some(buffer) = document.description.root.buffers.first_mut() {
        buffer.uri = Some(uri(&buffer_name(path)));
        files.write(&buffer_path(path), |out| document.body.write(Vec::new(), out, &stop))?;
    }
    files.write(path, |out| document.description.write_pretty(out))?;
    files.note_all(document.notes(path));
    Ok(())
}

/// Returns the path of the arrays of the `.gltf` file at `path`.
pub(crate) fn buffer_path(path: &Path) -> PathBuf {
    path.with_file_name(buffer_name(path))
}

fn buffer_name(path: &Path) -> String {
    format!("{}.bin", stem(path))
}

/// Returns the extras of the asset: the packages that the scene was made with, its location on the earth, and its recipe. Empty
/// if there are none.
fn asset_extras(packages: &[ScenePackage], facts: &SceneFacts<'_>) -> json::extras::Extras {
    let mut extras = serde_json::Map::new();
    if !packages.is_empty() {
        let package = |it: &ScenePackage| serde_json::json!({ "name": it.name, "version": it.version, "hash": it.hash });
        extras.insert("packages".into(), packages.iter().map(package).collect());
    }
    if let Some(frame) = facts.frame {
        let mut place = frame.world_place().to_json();
        place["axes"] = Y_UP_AXES.into();
        extras.insert("place".into(), place);
    }
    if let Some(recipe) = facts.recipe.and_then(|recipe| serde_json::to_value(recipe).ok()) {
        extras.insert("recipe".into(), recipe);
    }
    let text = serde_json::Value::Object(extras).to_string();
    RawValue::from_string(text).ok().filter(|text| text.get() != "{}")
}

impl<'a> Document<'a> {
    fn new(
        checked: &SceneCheck<'a>,
        facts: &SceneFacts<'a>,
        images: &'a Images,
        textures: &Textures,
        (arrays, film): (Arrays, Option<(&'a FilmModel, Option<&FilmSettings>)>),
        stop: &Stop,
    ) -> Result<Self> {
        stop.check()?;
        let mut description = Description::default();
        description.root.asset = Self::asset(&checked.scene.packages, facts);
        let mut body = Body::default();
        let metadata = Metadata::of(checked.scene, facts);
        if let Some(metadata) = &metadata {
            description.extensions = Some(metadata.write(&mut body));
            metadata.use_extensions(&mut description.root);
        }
        let metadata = metadata.as_ref();
        let ranges =
            if arrays.quantized { TexCoordRanges::measure(checked) } else { TexCoordRanges::default() };
        let materials = material::write(checked, images, textures, &ranges, &mut description.root, &mut body);
        // The viewer reads the extension, and so does what plays films.
        let is_own = arrays.small || film.is_some_and(|(_, settings)| settings.is_some());
        let storage = if is_own { InstanceStorage::Extension } else { facts.instances };
        let costs = place::integer_costs(checked.scene, storage);
        let arrays_of = (arrays, &ranges, costs.as_slice());
        let (meshes, grids) =
            mesh::write(checked, metadata, arrays_of, &materials, &mut description, &mut body, stop);
        stop.check()?;
        let kinds = (arrays, film.map(|(model, _)| model), storage);
        let placed = place::write(checked, metadata, (&meshes, &grids), kinds, &mut description, &mut body);
        if let Some((_, Some(settings))) = film {
            film::write(&placed.frames, settings, &mut description, &mut body);
        }
        let root = &mut description.root;
        if arrays.small || arrays.quantized {
            use_extension(root, QUANTIZATION);
            root.extensions_required.push(QUANTIZATION.into());
        }
        if root.extensions_used.iter().any(|used| used == TEXTURE_TRANSFORM) {
            root.extensions_required.push(TEXTURE_TRANSFORM.into());
        }
        let mut roots = placed.nodes.clone();
        if !is_own {
            camera::write(checked, &mut roots, &mut description)?;
        }
        let extras = scene_extras(&placed.features, checked.scene);
        let nodes = roots.iter().map(|node| json::Index::new(*node as u32)).collect();
        description.root.scenes.push(json::Scene { extensions: None, extras, name: None, nodes });
        body.describe(&mut description.root)?;
        let layout = Layout { places: placed.places, meshes };
        Ok(Self { description, body, layout, separate: placed.separate, rounding: placed.rounding })
    }

    /// Returns the origin of a document, with the packages and the recipe of its scene.
    pub(super) fn asset(packages: &[ScenePackage], facts: &SceneFacts<'_>) -> json::Asset {
        json::Asset {
            generator: Some(format!("Burgeon {}", env!("CARGO_PKG_VERSION"))),
            version: "2.0".into(),
            extras: asset_extras(packages, facts),
            ..json::Asset::default()
        }
    }

    /// Creates a document from its complete description, except its buffer, and the data. Fails if the file exceeds 4 GiB.
    pub(super) fn of_parts(mut description: Description<'a>, body: Body<'a>) -> Result<Self> {
        body.describe(&mut description.root)?;
        Ok(Self { description, body, layout: Layout::default(), separate: 0, rounding: None })
    }

    /// Compresses the arrays of the document.
    fn compress(&mut self) -> Result<()> {
        self.body.compress()?;
        let root = &mut self.description.root;
        (root.buffers, root.buffer_views) = (Vec::new(), Vec::new());
        self.body.describe(root)?;
        if root.buffers.len() > 1 {
            use_extension(root, MESHOPT);
            root.extensions_required.push(MESHOPT.into());
        }
        Ok(())
    }

    /// Returns notes on the file at `path`: the storage of repeated instances, and the error of integers.
    fn notes(&self, path: &Path) -> impl Iterator<Item = String> {
        let rounded = self.rounding.map(|error| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            match error {
                0.0 => format!("{name}: positions are exact, because integers would take more bytes"),
                _ => format!("{name}: positions are rounded by at most {} mm", rounded_up(error * 1000.0)),
            }
        });
        self.instance_note(path).into_iter().chain(rounded)
    }

    /// Returns a note on the storage of the repeated instances in the file at `path`, if there are any.
    fn instance_note(&self, path: &Path) -> Option<String> {
        let places = self.layout.places.iter().flatten();
        let shared = places.filter(|place| place.shared.is_some()).count();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if shared > 0 {
            let shared = grouped(shared);
            return Some(format!(
                "{name}: {shared} instances need EXT_mesh_gpu_instancing; for programs without it, use --instances nodes or expanded"
            ));
        }
        let separate = grouped(self.separate);
        (self.separate > 0).then(|| format!("{name}: {separate} repeated instances are plain nodes"))
    }

    /// Writes the document as a `.glb` file to `path`.
    pub(super) fn write(&self, path: &Path, files: &mut Files, stop: &Stop) -> Result<()> {
        let head = self.head()?;
        files.write(path, |out| self.body.write(head, out, stop))
    }

    /// Returns everything of a `.glb` file except the body, in pieces: both headers and the description between them.
    fn head(&self) -> Result<Vec<Cow<'static, [u8]>>> {
        let mut pieces = self.description.text()?;
        let written: usize = pieces.iter().map(|piece| piece.len()).sum();
        let length = written.next_multiple_of(4);
        pieces.push(Cow::Owned(vec![b' '; length - written]));
        let body = self.body.length();
        let tail = if body > 0 { 8 + body } else { 0 };
        let total = body::within_limit(20 + length as u64 + tail)?;
        let numbers = [2, total, length as u32].map(u32::to_le_bytes);
        pieces.insert(0, Cow::Owned([*b"glTF", numbers[0], numbers[1], numbers[2], *b"JSON"].concat()));
        if body > 0 {
            pieces.push(Cow::Owned([(body as u32).to_le_bytes(), *b"BIN\0"].concat()));
        }
        Ok(pieces)
    }
}

/// Returns a number above zero as text, rounded up to two digits.
fn rounded_up(number: f64) -> String {
    let decimals = 1.0 - number.max(1e-9).log10().floor();
    let unit = 10.0_f64.powf(-decimals);
    #[allow(clippy::cast_sign_loss, reason = "bounded")]
    let shown = decimals.clamp(0.0, 10.0) as usize;
    format!("{:.shown$}", (number / unit).ceil() * unit)
}

/// Returns the extras of the glTF scene: the feature ids of shared instances, and the up vector of the camera if it
/// differs from glTF's.
fn scene_extras(features: &[&str], scene: &Scene) -> Option<Box<RawValue>> {
    let mut extras = serde_json::Map::new();
    if !features.is_empty() {
        extras.insert("features".into(), features.into());
    }
    if let Some(upright) = scene.upright {
        let up = y_up(&DAffine3::from_translation(upright.up())).translation;
        extras.insert("up".into(), up.to_array().as_slice().into());
    }
    let text = serde_json::Value::Object(extras).to_string();
    RawValue::from_string(text).ok().filter(|text| text.get() != "{}")
}
