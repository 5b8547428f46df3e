//! Assembles a document: prototypes first, then the instances in the order of the scene.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;

use super::super::check::{SceneCheck, check, shown_parts};
use super::super::decompose::{Steps, decompose, y_up};
use super::super::files::Files;
use super::super::texture::Images;
use super::super::{Export, stem, uri};
use super::shape::{self, LookReference, Looks, numbers, title, write_feature};
use crate::xml::{escape_list_item, identifier};
use burgeon_base::error::Result;
use burgeon_scene::{Instance, ScenePackage};
use burgeon_spatial::ReferenceFrame;
use glam::{DAffine3, DQuat, DVec3};
use rayon::prelude::*;
use rustc_hash::FxHashMap;

/// Number of items that are serialised at a time.
const CHUNK: usize = 128;

/// Parameters of prototypes, which are also fields of `Transform`: name, type and default.
const FIELDS: [[&str; 3]; 4] = [
    ["translation", "SFVec3f", "0 0 0"],
    ["rotation", "SFRotation", "0 0 1 0"],
    ["scale", "SFVec3f", "1 1 1"],
    ["scaleOrientation", "SFRotation", "0 0 1 0"],
];

/// Mesh of the scene, or its mirror image. X3D does not define which side of a face is visible if its scale is
/// negative.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct ShownMesh {
    mesh: usize,
    mirrored: bool,
}

/// Method of writing the instances of a mesh.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Sharing {
    /// Written in place, for the only instance of the mesh.
    Alone,
    /// Written as a prototype that the instances use.
    Prototype,
    /// Defined under a name in the item with this number; other items refer to it.
    From(usize),
}

/// Item of the document.
#[derive(Clone, Copy)]
enum DocumentItem<'a> {
    Prototype(ShownMesh),
    Placed(&'a Instance, ShownMesh),
}

/// Order of the items in a document, and the items that define shared parts.
struct DocumentPlan<'a> {
    checked: &'a SceneCheck<'a>,
    items: Vec<DocumentItem<'a>>,
    sharing: FxHashMap<ShownMesh, Sharing>,
    /// For each material, the number of the item that defines it under its name.
    defined: Vec<Option<usize>>,
}

/// Writes an `.x3d` file to `path`, and copies of the textures next to it.
pub(crate) fn write(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
    let Export { scene, facts, .. } = export;
    let checked = check(scene)?;
    let images = Images::load(&checked)?;
    let names = images.copy_names(path, files);
    for (name, file) in names.iter().zip(&images.files) {
        files.copy(&path.with_file_name(name), &file.bytes)?;
    }
    let image = |file: &Option<usize>| file.map(|file| uri(&names[file]));
    let looks = Looks { materials: &scene.materials, images: images.of_material.iter().map(image).collect() };
    let plan = DocumentPlan::new(&checked);
    let head = head(&stem(path), checked.origin, &scene.packages, facts.frame);
    files.write(path, |out| {
        out.write_all(head.as_bytes())?;
        for (number, chunk) in plan.items.chunks(CHUNK).enumerate() {
            let first = number * CHUNK;
            let texts: Vec<String> =
                (first..first + chunk.len()).into_par_iter().map(|item| plan.text(item, &looks)).collect();
            texts.iter().try_for_each(|text| out.write_all(text.as_bytes()))?;
        }
        out.write_all(tail(checked.origin).as_bytes())
    })
}

/// Returns the text before the items.
fn head(name: &str, origin: DVec3, packages: &[ScenePackage], frame: Option<&ReferenceFrame>) -> String {
    let version = env!("CARGO_PKG_VERSION");
    // The names, versions and hashes of packages have no characters that XML requires to escape.
    let packages: String = packages
        .iter()
        .map(|it| format!("<meta name='package' content='{} {} {}'/>\n", it.name, it.version, it.hash))
        .collect();
    let place = frame.map_or_else(String::new, |frame| {
        format!("<meta name='place' content='The origin is at {}.'/>\n", frame.world_place())
    });
    let mut head = format!(
        "<?xml version='1.0' encoding='UTF-8'?>\n\
         <!DOCTYPE X3D PUBLIC 'ISO//Web3D//DTD X3D 3.3//EN' 'http://www.web3d.org/specifications/x3d-3.3.dtd'>\n\
         <X3D profile='Immersive' version='3.3' xmlns:xsd='http://www.w3.org/2001/XMLSchema-instance' \
         xsd:noNamespaceSchemaLocation='http://www.web3d.org/specifications/x3d-3.3.xsd'>\n\
         <head>\n\
         <meta name='title' content='{}'/>\n\
         <meta name='generator' content='Burgeon {version}'/>\n\
         <meta name='description' content='Metres, y up: east is x, north is -z.'/>\n\
{packages}{place}\
         </head>\n\
         <Scene>\n",
        title(name)
    );
    if origin != DVec3::ZERO {
        let origin = y_up(&DAffine3::from_translation(origin)).translation.as_vec3() + 0.0;
        head.push_str("<Transform translation='");
        numbers(origin.to_array(), &mut head);
        head.push_str("'>\n");
    }
    head
}

fn tail(origin: DVec3) -> &'static str {
    if origin == DVec3::ZERO { "</Scene>\n</X3D>\n" } else { "</Transform>\n</Scene>\n</X3D>\n" }
}

impl<'a> DocumentPlan<'a> {
    fn new(checked: &'a SceneCheck<'a>) -> Self {
        let scene = checked.scene;
        let shown: Vec<(&Instance, ShownMesh)> = scene
            .instances
            .iter()
            .filter(|instance| checked.meshes[instance.mesh])
            .map(|instance| {
                let mirrored = instance.transform.matrix3.determinant() < 0.0;
                (instance, ShownMesh { mesh: instance.mesh, mirrored })
            })
            .collect();
        let mut sharing: FxHashMap<ShownMesh, Sharing> = FxHashMap::default();
        let mut prototypes = Vec::new();
        let mut seen: FxHashMap<ShownMesh, usize> = FxHashMap::default();
        for (instance, mesh) in &shown {
            let count = seen.entry(*mesh).or_default();
            *count += 1;
            let is_shared = *count == 2;
            let sharing = sharing.entry(*mesh).or_insert(Sharing::Alone);
            if is_shared && instance.placement.is_some() {
                *sharing = Sharing::Prototype;
                prototypes.push(DocumentItem::Prototype(*mesh));
            } else if is_shared {
                *sharing = Sharing::From(usize::MAX);
            }
        }
        let mut plan =
            Self { checked, items: prototypes, sharing, defined: vec![None; scene.materials.len()] };
        for (instance, mesh) in shown {
            let number = plan.items.len();
            plan.items.push(DocumentItem::Placed(instance, mesh));
            let has_shapes = match plan.sharing.get_mut(&mesh) {
                Some(Sharing::From(first)) if *first == usize::MAX => {
                    *first = number;
                    true
                }
                Some(Sharing::Alone) => true,
                _ => false,
            };
            if has_shapes {
                for part in shown_parts(&scene.meshes[mesh.mesh]) {
                    plan.defined[part.material].get_or_insert(number);
                }
            }
        }
        plan
    }

    /// Returns the text of item number `number`.
    fn text(&self, number: usize, looks: &Looks<'_>) -> String {
        let mut text = String::new();
        match self.items[number] {
            DocumentItem::Prototype(mesh) => self.write_prototype(mesh, looks, &mut text),
            DocumentItem::Placed(instance, mesh) => {
                self.write_placed(number, instance, mesh, looks, &mut text)
            }
        }
        text
    }

    fn write_prototype(&self, mesh: ShownMesh, looks: &Looks<'_>, out: &mut String) {
        let _ = write!(out, "<ProtoDeclare name='{}'><ProtoInterface>", self.name(mesh));
        for [name, kind, default] in FIELDS {
            let _ = write!(
                out,
                "<field name='{name}' type='{kind}' accessType='inputOutput' value='{default}'/>"
            );
        }
        out.push_str("<field name='feature' type='MFString' accessType='inputOutput'/>");
        out.push_str("</ProtoInterface>\n<ProtoBody><Transform><IS>");
        for [name, ..] in FIELDS {
            let _ = write!(out, "<connect nodeField='{name}' protoField='{name}'/>");
        }
        out.push_str(
            "</IS><MetadataString name='feature'><IS><connect nodeField='value' protoField='feature'/></IS></MetadataString>\n",
        );
        let shapes = &self.checked.scene.meshes[mesh.mesh];
        // A name is only valid within its prototype.
        shape::write(shapes, mesh.mirrored, looks, |_| LookReference::Own, out);
        out.push_str("</Transform></ProtoBody></ProtoDeclare>\n");
    }

    fn write_placed(
        &self,
        number: usize,
        instance: &Instance,
        mesh: ShownMesh,
        looks: &Looks<'_>,
        out: &mut String,
    ) {
        let values = self.place(instance, mesh);
        let name = self.name(mesh);
        let sharing = self.sharing.get(&mesh).copied().unwrap_or(Sharing::Alone);
        let feature = instance.feature.as_deref();
        if sharing == Sharing::Prototype {
            let _ = write!(out, "<ProtoInstance name='{name}'>");
            for (field, value) in values {
                let _ = write!(out, "<fieldValue name='{field}' value='{value}'/>");
            }
            if let Some(feature) = feature {
                let _ = write!(out, "<fieldValue name='feature' value='{}'/>", escape_list_item(feature));
            }
            out.push_str("</ProtoInstance>\n");
            return;
        }
        out.push_str("<Transform");
        for (field, value) in values {
            let _ = write!(out, " {field}='{value}'");
        }
        out.push('>');
        if let Some(feature) = feature {
            write_feature(feature, out);
        }
        out.push('\n');
        let refer = |material: usize| {
            if self.defined[material] == Some(number) { LookReference::Defined } else { LookReference::Used }
        };
        let shapes = &self.checked.scene.meshes[mesh.mesh];
        match sharing {
            Sharing::From(first) if first != number => {
                let _ = writeln!(out, "<Group USE='{name}'/>");
            }
            Sharing::From(_) => {
                let _ = writeln!(out, "<Group DEF='{name}'>");
                shape::write(shapes, mesh.mirrored, looks, refer, out);
                out.push_str("</Group>\n");
            }
            _ => shape::write(shapes, mesh.mirrored, looks, refer, out),
        }
        out.push_str("</Transform>\n");
    }

    fn name(&self, mesh: ShownMesh) -> String {
        let kind = if mesh.mirrored { "mirrored" } else { "mesh" };
        identifier(kind, mesh.mesh, &self.checked.scene.meshes[mesh.mesh].name)
    }

    /// Returns the fields of an instance's transform that differ from the default.
    fn place(&self, instance: &Instance, mesh: ShownMesh) -> Vec<(&'static str, String)> {
        let mut transform = instance.transform;
        transform.translation -= self.checked.origin;
        if mesh.mirrored {
            transform *= DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0));
        }
        let (place, turn, scale, axes) = match decompose(&y_up(&transform)) {
            Steps::One(trs) => (trs.translation, trs.rotation, trs.scale, DQuat::IDENTITY),
            // Rotated into the axes of the scale, and back.
            Steps::Two(rest, first) => (rest.translation, rest.rotation * first, rest.scale, first.inverse()),
        };
        let vector = |vector: DVec3| {
            let mut text = String::new();
            numbers((vector.as_vec3() + 0.0).to_array(), &mut text);
            text
        };
        let values = [vector(place), rotation(turn), vector(scale), rotation(axes)];
        let all = FIELDS.iter().zip(values);
        all.filter(|([_, _, default], value)| value != default)
            .map(|([name, ..], value)| (*name, value))
            .collect()
    }
}

/// Formats a rotation as an axis and an angle (radians).
fn rotation(turn: DQuat) -> String {
    let turn = if turn.w < 0.0 { -turn } else { turn };
    let (axis, angle) = turn.to_axis_angle();
    let mut text = String::new();
    if (angle as f32) == 0.0 {
        return FIELDS[1][2].to_owned();
    }
    numbers(axis.as_vec3().extend(angle as f32).to_array().map(|number| number + 0.0), &mut text);
    text
}
