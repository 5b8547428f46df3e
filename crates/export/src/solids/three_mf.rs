//! 3MF, which slicers and print services read: meshes in millimetres, base materials, and components for instances.
//!
//! Specification: 3MF Consortium, "3D Manufacturing Format Core Specification", 1.3, 2021.

use super::open_edges::{self, count_open, weld};
use super::placed::{check_size, is_mirrored, written_triangles};
use super::ply::colors;
use crate::check::{SceneCheck, check as check_scene, triangles};
use crate::facts::Export;
use crate::files::{Files, Out};
use crate::xml::escape_attribute;
use burgeon_base::error::Result;
use burgeon_base::stop::Stop;
use burgeon_scene::{Instance, Mesh};
use glam::{DAffine3, DVec3, Vec3};
use rustc_hash::FxHashMap;
use std::io::{self, Write};
use std::path::Path;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// Maximum size (bytes) of the text, above which archives need extensions that many readers do not have.
const LIMIT: u64 = 4_000_000_000;

/// Bytes of text of a triangle with its share of the points, and of an instance.
const SIZES: [usize; 2] = [75, 200];

const CONTENT_TYPES: &str = concat!(
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n",
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">",
    "<Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>",
    "<Default Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>",
    "</Types>\n"
);

const RELATIONSHIPS: &str = concat!(
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n",
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">",
    "<Relationship Target=\"/3D/3dmodel.model\" Id=\"model\" ",
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>",
    "</Relationships>\n"
);

/// Accepts the format, which this program has.
#[allow(clippy::unnecessary_wraps, reason = "the replacement without the feature fails")]
pub(crate) fn check() -> Result<()> {
    Ok(())
}

/// Writes a `.3mf` file to `path`. Fails before it writes if its text would exceed 4 GB.
pub(crate) fn write(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
    let checked = check_scene(export.scene)?;
    let shown = checked.scene.meshes.iter().zip(&checked.meshes).filter(|(_, shown)| **shown);
    let triangles: usize = shown.map(|(mesh, _)| mesh.triangles()).sum();
    let size = triangles * SIZES[0] + checked.scene.instances.len() * SIZES[1];
    check_size("the text of a .3mf file", size as u64, LIMIT, written_triangles(&checked))?;
    let colors = colors(&checked)?;
    let stop = files.stop();
    let mut counts = vec![0; checked.scene.meshes.len()];
    files.write(path, |out| {
        let mut archive = ZipWriter::new(out);
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .compression_level(Some(1));
        for (name, text) in [("[Content_Types].xml", CONTENT_TYPES), ("_rels/.rels", RELATIONSHIPS)] {
            archive.start_file(name, options)?;
            archive.write_all(text.as_bytes())?;
        }
        archive.start_file("3D/3dmodel.model", options)?;
        let mut model = ModelWriter { checked: &checked, text: Vec::new(), archive, next: 2 };
        model.write(&colors, &mut counts, &stop)?;
        model.archive.finish()?;
        Ok(())
    })?;
    files.warn(open_edges::warning(&checked, &counts, path));
    Ok(())
}

/// Writer of the model in the archive.
struct ModelWriter<'a, 'b> {
    checked: &'a SceneCheck<'a>,
    /// Text that is not yet in the archive.
    text: Vec<u8>,
    archive: ZipWriter<&'b mut Out>,
    /// Id of the next object. The materials have id 1.
    next: usize,
}

/// Mesh of a file: of a mesh of the scene, or its mirror image.
type MeshKey = (usize, bool);

/// Instances of one name and feature, which become one object.
struct ObjectGroup<'a> {
    first: &'a Instance,
    /// Ids of the meshes, and the transforms of the instances (m).
    members: Vec<(usize, DAffine3)>,
}

impl ModelWriter<'_, '_> {
    fn write(&mut self, colors: &[[u8; 4]], counts: &mut [usize], stop: &Stop) -> io::Result<()> {
        let scene = self.checked.scene;
        let DVec3 { x, y, z } = self.checked.origin;
        write!(
            self.text,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"millimeter\" xml:lang=\"en-US\" \
             xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n\
             <metadata name=\"Application\">Burgeon {}</metadata>\n\
             <metadata name=\"Description\">z up, counted from ({x}, {y}, {z}) m</metadata>\n<resources>\n",
            env!("CARGO_PKG_VERSION")
        )?;
        let materials = self.write_materials(colors)?;
        let mut ids: FxHashMap<MeshKey, usize> = FxHashMap::default();
        let mut groups: Vec<ObjectGroup<'_>> = Vec::new();
        let mut known = FxHashMap::default();
        for instance in scene.instances.iter().filter(|instance| self.checked.meshes[instance.mesh]) {
            if stop.is_stopped() {
                return Ok(());
            }
            let mut transform = instance.transform;
            transform.translation -= self.checked.origin;
            let mirrored = is_mirrored(instance);
            let mesh = &scene.meshes[instance.mesh];
            let id = if is_flat(&transform) {
                // The format has no transforms that flatten, so the mesh is stored flat.
                let id = self.write_mesh(mesh, &materials, transform, false, &mut counts[instance.mesh])?;
                transform = DAffine3::IDENTITY;
                id
            } else {
                let mirror = DAffine3::from_scale(DVec3::new(if mirrored { -1.0 } else { 1.0 }, 1.0, 1.0));
                transform *= mirror;
                let key = (instance.mesh, mirrored);
                match ids.get(&key) {
                    Some(id) => *id,
                    None => {
                        let count = &mut counts[instance.mesh];
                        let id = self.write_mesh(mesh, &materials, mirror, mirrored, count)?;
                        ids.insert(key, id);
                        id
                    }
                }
            };
            let group = *known.entry((&instance.name, &instance.feature)).or_insert_with(|| {
                groups.push(ObjectGroup { first: instance, members: Vec::new() });
                groups.len() - 1
            });
            groups[group].members.push((id, transform));
        }
        let first = self.next;
        for group in &groups {
            self.write_group(group)?;
        }
        self.text.extend_from_slice(b"</resources>\n<build>\n");
        for id in first..self.next {
            writeln!(self.text, "<item objectid=\"{id}\"/>")?;
            self.flush(1 << 16)?;
        }
        self.text.extend_from_slice(b"</build>\n</model>\n");
        self.flush(0)
    }

    /// Writes the base materials. Returns the index of each shown material.
    fn write_materials(&mut self, colors: &[[u8; 4]]) -> io::Result<Vec<usize>> {
        let shown = &self.checked.materials;
        let mut count = 0;
        let numbers = shown.iter().map(|shown| {
            count += usize::from(*shown);
            count.saturating_sub(1)
        });
        let numbers = numbers.collect();
        if count == 0 {
            return Ok(numbers);
        }
        self.text.extend_from_slice(b"<basematerials id=\"1\">\n");
        let materials = self.checked.scene.materials.iter().zip(colors).zip(shown);
        for ((material, [r, g, b, a]), _) in materials.filter(|(_, shown)| **shown) {
            let name = if material.name.is_empty() { "material" } else { &material.name };
            let name = attribute_text(name);
            writeln!(self.text, "<base name=\"{name}\" displaycolor=\"#{r:02X}{g:02X}{b:02X}{a:02X}\"/>")?;
        }
        self.text.extend_from_slice(b"</basematerials>\n");
        Ok(numbers)
    }

    /// Writes `mesh` with `transform` (m) as an object and returns its id. `open` becomes its number of open edges.
    fn write_mesh(
        &mut self,
        mesh: &Mesh,
        materials: &[usize],
        transform: DAffine3,
        turned: bool,
        open: &mut usize,
    ) -> io::Result<usize> {
        let id = self.next;
        self.next += 1;
        let (welded, points) = weld(mesh);
        *open = count_open(mesh, &welded);
        let shown = mesh.parts.iter().find(|part| !part.triangles.is_empty());
        let main = shown.map_or(0, |part| materials[part.material]);
        write!(self.text, "<object id=\"{id}\" type=\"model\" pid=\"1\" pindex=\"{main}\"")?;
        if !mesh.name.is_empty() {
            write!(self.text, " name=\"{}\"", attribute_text(&mesh.name))?;
        }
        self.text.extend_from_slice(b"><mesh>\n<vertices>\n");
        for point in points.iter().map(|point: &Vec3| transform.transform_point3(point.as_dvec3()) * 1000.0) {
            for (key, number) in
                [(&b"<vertex x=\""[..], point.x), (b"\" y=\"", point.y), (b"\" z=\"", point.z)]
            {
                self.text.extend_from_slice(key);
                push_decimal(&mut self.text, number);
            }
            self.text.extend_from_slice(b"\"/>\n");
            self.flush(1 << 16)?;
        }
        self.text.extend_from_slice(b"</vertices>\n<triangles>\n");
        for (part, welded) in mesh.parts.iter().zip(&welded) {
            let material = materials[part.material];
            let suffix =
                if material == main { String::new() } else { format!("\" pid=\"1\" p1=\"{material}") };
            for corners in triangles(part) {
                let [a, mut b, mut c] = corners.map(|corner| welded[corner as usize]);
                if a == b || b == c || c == a {
                    continue;
                }
                if turned {
                    std::mem::swap(&mut b, &mut c);
                }
                for (key, corner) in [(&b"<triangle v1=\""[..], a), (b"\" v2=\"", b), (b"\" v3=\"", c)] {
                    self.text.extend_from_slice(key);
                    push_whole(&mut self.text, u64::from(corner));
                }
                self.text.extend_from_slice(suffix.as_bytes());
                self.text.extend_from_slice(b"\"/>\n");
                self.flush(1 << 16)?;
            }
        }
        self.text.extend_from_slice(b"</triangles>\n</mesh></object>\n");
        Ok(id)
    }

    /// Writes an object with a component for each instance.
    fn write_group(&mut self, group: &ObjectGroup<'_>) -> io::Result<()> {
        let Instance { name, feature, mesh, .. } = group.first;
        let name = if name.is_empty() { &self.checked.scene.meshes[*mesh].name } else { name };
        write!(self.text, "<object id=\"{}\"", self.next)?;
        self.next += 1;
        for (key, value) in [("name", Some(name)), ("partnumber", feature.as_ref())] {
            if let Some(value) = value.filter(|value| !value.is_empty()) {
                write!(self.text, " {key}=\"{}\"", attribute_text(value))?;
            }
        }
        self.text.extend_from_slice(b"><components>\n");
        for (id, transform) in &group.members {
            write!(self.text, "<component objectid=\"{id}\"")?;
            if *transform != DAffine3::IDENTITY {
                self.text.extend_from_slice(b" transform=\"");
                let matrix = transform.matrix3.to_cols_array();
                for number in matrix {
                    // The shortest text of an f32 has no exponent.
                    write!(self.text, "{} ", number as f32 + 0.0)?;
                }
                let translation = (transform.translation * 1000.0).to_array();
                for (i, number) in translation.into_iter().enumerate() {
                    self.text.extend_from_slice(if i > 0 { b" " } else { b"" });
                    push_decimal(&mut self.text, number);
                }
                self.text.push(b'"');
            }
            self.text.extend_from_slice(b"/>\n");
            self.flush(1 << 16)?;
        }
        self.text.extend_from_slice(b"</components></object>\n");
        Ok(())
    }

    /// Writes the text to the archive if it is longer than `length`.
    fn flush(&mut self, length: usize) -> io::Result<()> {
        if self.text.len() > length {
            self.archive.write_all(&self.text)?;
            self.text.clear();
        }
        Ok(())
    }
}

/// Escapes `text` for an attribute. Line breaks become spaces, because lib3mf reads no numeric character references.
fn attribute_text(text: &str) -> String {
    escape_attribute(&text.replace(['\t', '\n', '\r'], " "))
}

/// Returns true if `transform` has no inverse.
fn is_flat(transform: &DAffine3) -> bool {
    let columns = transform.matrix3;
    let size = columns.x_axis.length() * columns.y_axis.length() * columns.z_axis.length();
    columns.determinant().abs() <= 1e-9 * size || size == 0.0
}

/// Appends `number` with at most four decimals: a ten-thousandth of a millimetre.
fn push_decimal(text: &mut Vec<u8>, number: f64) {
    let units = (number * 1e4).round();
    if units.abs() >= 9e18 {
        text.extend_from_slice(format!("{number:.0}").as_bytes());
        return;
    }
    let units = units as i64;
    if units < 0 {
        text.push(b'-');
    }
    let (whole, mut rest) = (units.unsigned_abs() / 10_000, units.unsigned_abs() % 10_000);
    push_whole(text, whole);
    if rest > 0 {
        text.push(b'.');
        let mut unit = 1000;
        while rest > 0 {
            text.push(b'0' + (rest / unit) as u8);
            rest %= unit;
            unit /= 10;
        }
    }
}

/// Appends an integer.
fn push_whole(text: &mut Vec<u8>, mut number: u64) {
    let mut digits = [0; 20];
    let mut first = digits.len();
    loop {
        first -= 1;
        digits[first] = b'0' + (number % 10) as u8;
        number /= 10;
        if number == 0 {
            break;
        }
    }
    text.extend_from_slice(&digits[first..]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_rounded_to_a_ten_thousandth() {
        let text = |number| {
            let mut text = Vec::new();
            push_decimal(&mut text, number);
            String::from_utf8(text).unwrap()
        };
        let numbers = [0.0, -0.000_04, -0.5, 1.000_1, 1_234_567.05, -12.0, 0.010_05, 1e16];
        let texts = ["0", "0", "-0.5", "1.0001", "1234567.05", "-12", "0.0101", "10000000000000000"];
        assert_eq!(numbers.map(text), texts);
    }
}
