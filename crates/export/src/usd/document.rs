//! Layer: the stage, the instances, and the order of both.

use super::text::{quote, tuple, write_list};
use super::{material, shape};
use crate::check::{SceneCheck, check};
use crate::decompose::{Steps, Trs, decompose};
use crate::facts::Export;
use crate::files::Files;
use crate::texture::Images;
use crate::xml::identifier;
use burgeon_base::error::Result;
use burgeon_scene::Instance;
use glam::{DAffine3, DVec3};
use rustc_hash::FxHashMap;
use std::io::{self, Write};
use std::path::Path;

/// Minimum number of instances of a point instancer.
const ENOUGH: usize = 16;

/// Properties that the instances of a point instancer have in common, and that they are mirrored.
type InstancerKey<'a> = (usize, &'a str, Option<&'a str>, bool);

/// Instances of a point instancer.
struct InstancerGroup<'a> {
    key: InstancerKey<'a>,
    first: &'a Instance,
    places: Vec<Trs>,
}

/// Writes a `.usda` file to `path`, with copies of the textures next to it.
pub(crate) fn write(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
    let checked = check(export.scene)?;
    let images = Images::load_with_normals(&checked)?;
    let names = images.copy_names(path, files);
    for (name, file) in names.iter().zip(&images.files) {
        files.copy(&path.with_file_name(name), &file.bytes)?;
    }
    let place = export.facts.frame.map(|frame| format!("The origin is at {}.", frame.world_place()));
    let stop = files.stop();
    files.write(path, |out| {
        let (generator, place) = (env!("CARGO_PKG_VERSION"), place.unwrap_or_default());
        let doc = quote(&format!("Burgeon {generator}. {place}"));
        writeln!(out, "#usda 1.0\n(\n    defaultPrim = \"World\"\n    doc = {doc}")?;
        writeln!(out, "    metersPerUnit = 1\n    upAxis = \"Z\"\n)\n\ndef Xform \"World\"\n{{")?;
        if checked.origin != DVec3::ZERO {
            let DVec3 { x, y, z } = checked.origin;
            writeln!(out, "    double3 xformOp:translate = ({x}, {y}, {z})")?;
            writeln!(out, "    uniform token[] xformOpOrder = [\"xformOp:translate\"]")?;
        }
        material::write(&checked, &images, &names, out)?;
        write_instances(&checked, out)?;
        writeln!(out, "}}\n\nclass \"Meshes\"\n{{")?;
        for (index, mesh) in
            checked.scene.meshes.iter().enumerate().filter(|(index, _)| checked.meshes[*index])
        {
            if stop.is_stopped() {
                return Ok(());
            }
            shape::write(&checked, index, mesh, out)?;
        }
        writeln!(out, "}}")
    })
}

/// Writes the shown instances.
fn write_instances(checked: &SceneCheck<'_>, out: &mut impl Write) -> io::Result<()> {
    let scene = checked.scene;
    let mut counts: FxHashMap<InstancerKey<'_>, usize> = FxHashMap::default();
    let mut uses = vec![0_usize; scene.meshes.len()];
    let shown = || scene.instances.iter().enumerate().filter(|(_, it)| checked.meshes[it.mesh]);
    for (_, instance) in shown() {
        *counts.entry(key(instance)).or_default() += 1;
        uses[instance.mesh] += 1;
    }
    let mut groups: Vec<InstancerGroup<'_>> = Vec::new();
    let mut known: FxHashMap<InstancerKey<'_>, usize> = FxHashMap::default();
    for (number, instance) in shown() {
        let mut transform = instance.transform;
        transform.translation -= checked.origin;
        let key = key(instance);
        if counts[&key] >= ENOUGH
            && let Steps::One(trs) = decompose(&(mirror(key.3) * transform))
        {
            let group = *known.entry(key).or_insert_with(|| {
                groups.push(InstancerGroup { key, first: instance, places: Vec::new() });
                groups.len() - 1
            });
            groups[group].places.push(trs);
            continue;
        }
        let name = identifier("instance", number, &instance.name);
        let target = shape::prim_path(instance.mesh, &scene.meshes[instance.mesh]);
        writeln!(out, "    def Xform \"{name}\" (")?;
        write_display_name(instance, out)?;
        if uses[instance.mesh] > 1 {
            writeln!(out, "        instanceable = true")?;
        }
        writeln!(out, "        prepend references = <{target}>\n    )\n    {{")?;
        write_feature(instance, out)?;
        let rows = transform.matrix3.to_cols_array_2d().map(|row| tuple(row.iter().chain(&[0.0])));
        let last = tuple(transform.translation.to_array().iter().chain(&[1.0]));
        let [x, y, z] = rows;
        writeln!(out, "        matrix4d xformOp:transform = ({x}, {y}, {z}, {last})")?;
        writeln!(out, "        uniform token[] xformOpOrder = [\"xformOp:transform\"]\n    }}")?;
    }
    for (number, group) in groups.iter().enumerate() {
        write_instancer(checked, number, group, out)?;
    }
    Ok(())
}

fn key(instance: &Instance) -> InstancerKey<'_> {
    let mirrored = instance.transform.matrix3.determinant() < 0.0;
    (instance.mesh, &instance.name, instance.feature.as_deref(), mirrored)
}

/// Returns the transform of an instancer whose instances are mirrored.
fn mirror(mirrored: bool) -> DAffine3 {
    DAffine3::from_scale(DVec3::new(if mirrored { -1.0 } else { 1.0 }, 1.0, 1.0))
}

fn write_instancer(
    checked: &SceneCheck<'_>,
    number: usize,
    group: &InstancerGroup<'_>,
    out: &mut impl Write,
) -> io::Result<()> {
    let InstancerGroup { key: (mesh, name, _, mirrored), first, places } = group;
    let name = identifier("instances", number, name);
    let target = shape::prim_path(*mesh, &checked.scene.meshes[*mesh]);
    writeln!(out, "    def PointInstancer \"{name}\" (")?;
    write_display_name(first, out)?;
    writeln!(out, "    )\n    {{")?;
    write_feature(first, out)?;
    if *mirrored {
        // Programs choose the visible side once for all instances of an instancer.
        writeln!(out, "        float3 xformOp:scale = (-1, 1, 1)")?;
        writeln!(out, "        uniform token[] xformOpOrder = [\"xformOp:scale\"]")?;
    }
    let quaternion = |trs: &Trs| {
        let [x, y, z, w] = trs.rotation.as_quat().to_array();
        [w, x, y, z]
    };
    write_list(out, "int[] protoIndices", places.iter().map(|_| 0))?;
    // Halves are too coarse for large models; programs before USD 24.11 read only halves.
    write_list(out, "quath[] orientations", places.iter().map(|trs| tuple(&quaternion(trs))))?;
    write_list(out, "quatf[] orientationsf", places.iter().map(|trs| tuple(&quaternion(trs))))?;
    write_list(
        out,
        "point3f[] positions",
        places.iter().map(|it| tuple(&it.translation.as_vec3().to_array())),
    )?;
    write_list(out, "float3[] scales", places.iter().map(|it| tuple(&it.scale.as_vec3().to_array())))?;
    writeln!(out, "        rel prototypes = </World/{name}/Prototype>\n")?;
    writeln!(
        out,
        "        def Xform \"Prototype\" (\n            prepend references = <{target}>\n        )"
    )?;
    writeln!(out, "        {{\n        }}\n    }}")
}

/// Writes the name of an instance for people, as metadata of its prim.
fn write_display_name(instance: &Instance, out: &mut impl Write) -> io::Result<()> {
    if instance.name.is_empty() {
        return Ok(());
    }
    writeln!(out, "        displayName = {}", quote(&instance.name))
}

/// Writes the id of the feature of an instance.
fn write_feature(instance: &Instance, out: &mut impl Write) -> io::Result<()> {
    match &instance.feature {
        Some(feature) => writeln!(out, "        custom string userProperties:feature = {}", quote(feature)),
        None => Ok(()),
    }
}
