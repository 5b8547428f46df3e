//! Reader of the points and the features of a `.glb` file. It shares no code with the writer.

use std::borrow::Cow;
use std::collections::BTreeMap;

use glam::{DAffine3, DMat4, DQuat, DVec3};
use serde_json::Value;

use super::instances::instance_transforms;
use super::unpack::{unpack_triangles, unpack_vertices};

/// Points and features of a model.
#[derive(Debug, Clone, Default)]
pub struct GlbModel {
    /// Points (m) of all instances with z up, as 3D Tiles turn them.
    pub low: DVec3,
    /// Largest coordinates (m) of the points.
    pub high: DVec3,
    /// Number of points, counted for each instance.
    pub points: usize,
    /// Number of triangles, counted for each instance.
    pub triangles: usize,
    /// Tables of features.
    pub tables: Vec<GlbTable>,
}

/// Table of features.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct GlbTable {
    /// Name of the layer.
    pub name: String,
    /// Ids of the features.
    pub ids: Vec<String>,
}

/// File in memory.
pub(super) struct GlbFile<'a> {
    json: Value,
    binary: &'a [u8],
    /// Views that are compressed in the file.
    unpacked: BTreeMap<usize, Vec<u8>>,
}

/// Array of numbers.
pub(super) struct NumberArray<'a> {
    bytes: &'a [u8],
    stride: usize,
    component: u64,
    is_normalized: bool,
    width: usize,
    pub(super) count: usize,
}

/// Largest depth of nested objects.
const DEPTH: usize = 16;

fn number(value: &Value) -> Option<usize> {
    value.as_u64().and_then(|number| usize::try_from(number).ok())
}

impl<'a> GlbFile<'a> {
    /// Reads the two parts of a file. Fails with the reason.
    fn new(bytes: &'a [u8]) -> Result<Self, Cow<'static, str>> {
        let word =
            |at: usize| -> Option<u32> { Some(u32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?)) };
        if word(0) != Some(0x4654_6c67) || word(4) != Some(2) {
            return Err("it is not a .glb file".into());
        }
        if word(8).map(|length| length as usize) != Some(bytes.len()) {
            return Err("its length is not that in its header".into());
        }
        let length = word(12).unwrap_or(0) as usize;
        let text = bytes.get(20..20 + length).filter(|_| word(16) == Some(0x4e4f_534a));
        let json = serde_json::from_slice(text.ok_or("its first part is not JSON")?)
            .map_err(|error| format!("its JSON cannot be read: {error}"))?;
        let rest = 20 + length;
        let binary = word(rest).map_or(Some(&[][..]), |size| bytes.get(rest + 8..rest + 8 + size as usize));
        let binary = binary.ok_or("its binary part ends too early")?;
        let mut file = Self { json, binary, unpacked: BTreeMap::new() };
        file.unpacked = file.unpack()?;
        Ok(file)
    }

    /// Returns the content of the compressed views.
    fn unpack(&self) -> Result<BTreeMap<usize, Vec<u8>>, Cow<'static, str>> {
        let mut unpacked = BTreeMap::new();
        for (index, view) in self.json["bufferViews"].as_array().into_iter().flatten().enumerate() {
            let packed = &view["extensions"]["EXT_meshopt_compression"];
            if packed.is_null() {
                continue;
            }
            let read = || {
                let begin = number(&packed["byteOffset"]).unwrap_or(0);
                let bytes = self.binary.get(begin..begin.checked_add(number(&packed["byteLength"])?)?)?;
                let (count, stride) = (number(&packed["count"])?, number(&packed["byteStride"])?);
                // A byte stands for at most 16 vertices of one byte, so this bounds the memory.
                if number(&view["byteLength"])? != count.checked_mul(stride)?
                    || count > bytes.len().checked_mul(64)?
                {
                    return None;
                }
                match (packed["mode"].as_str()?, stride) {
                    ("ATTRIBUTES", _) => unpack_vertices(bytes, count, stride),
                    ("TRIANGLES", 2 | 4) => {
                        let indices = unpack_triangles(bytes, count)?;
                        Some(
                            indices.iter().flat_map(|it| it.to_le_bytes().into_iter().take(stride)).collect(),
                        )
                    }
                    _ => None,
                }
            };
            unpacked.insert(index, read().ok_or_else(|| format!("compressed view {index} is invalid"))?);
        }
        Ok(unpacked)
    }

    /// Returns the bytes of a buffer view.
    fn view(&self, index: usize) -> Option<(&[u8], usize)> {
        let view = &self.json["bufferViews"][index];
        let stride = number(&view["byteStride"]).unwrap_or(0);
        if let Some(bytes) = self.unpacked.get(&index) {
            return Some((bytes, stride));
        }
        let begin = number(&view["byteOffset"]).unwrap_or(0);
        let bytes = self.binary.get(begin..begin.checked_add(number(&view["byteLength"])?)?)?;
        Some((bytes, stride))
    }

    /// Returns the array of an accessor. Fails with the reason.
    pub(super) fn array(&self, accessor: &Value) -> Result<NumberArray<'_>, Cow<'static, str>> {
        let index = number(accessor).ok_or("an accessor has no index")?;
        let described = &self.json["accessors"][index];
        let read = || {
            let width = match described["type"].as_str()? {
                "SCALAR" => 1,
                "VEC2" => 2,
                "VEC3" => 3,
                "VEC4" => 4,
                _ => return None,
            };
            let component = described["componentType"].as_u64()?;
            let size = width * component_size(component)?;
            let (bytes, stride) = self.view(number(&described["bufferView"])?)?;
            let bytes = bytes.get(number(&described["byteOffset"]).unwrap_or(0)..)?;
            let (stride, count) = (if stride == 0 { size } else { stride }, number(&described["count"])?);
            let end =
                count.checked_sub(1).map_or(Some(0), |last| last.checked_mul(stride)?.checked_add(size))?;
            let is_normalized = described["normalized"].as_bool().unwrap_or(false);
            (end <= bytes.len()).then_some(NumberArray {
                bytes,
                stride,
                component,
                is_normalized,
                width,
                count,
            })
        };
        read().ok_or_else(|| format!("accessor {index} is invalid").into())
    }

    /// Returns the strings of a property.
    fn strings(&self, property: &Value, count: usize) -> Option<Vec<String>> {
        let (values, _) = self.view(number(&property["values"])?)?;
        let (offsets, _) = self.view(number(&property["stringOffsets"])?)?;
        let wide = property["stringOffsetType"] == "UINT64";
        let at = |index: usize| -> Option<usize> {
            if wide {
                let bytes = offsets.get(index * 8..index * 8 + 8)?.try_into().ok()?;
                return usize::try_from(u64::from_le_bytes(bytes)).ok();
            }
            Some(u32::from_le_bytes(offsets.get(index * 4..index * 4 + 4)?.try_into().ok()?) as usize)
        };
        (0..count).map(|row| String::from_utf8(values.get(at(row)?..at(row + 1)?)?.to_vec()).ok()).collect()
    }

    fn tables(&self) -> Result<Vec<GlbTable>, Cow<'static, str>> {
        let metadata = &self.json["extensions"]["EXT_structural_metadata"];
        let tables = metadata["propertyTables"].as_array().map_or(&[][..], Vec::as_slice);
        let table = |(index, table): (usize, &Value)| {
            let count = number(&table["count"])?;
            let class = &metadata["schema"]["classes"][table["class"].as_str()?]["properties"];
            let described = class.as_object()?.iter().find(|(_, property)| property["semantic"] == "ID");
            let ids = self.strings(&table["properties"][described?.0.as_str()], count)?;
            let name = table["name"].as_str().map_or_else(|| format!("table {index}"), str::to_owned);
            Some(GlbTable { name, ids })
        };
        let read = tables
            .iter()
            .enumerate()
            .map(|it| table(it).ok_or_else(|| format!("property table {} is invalid", it.0).into()));
        read.collect()
    }

    /// Checks that the feature numbers of an array are rows of a table.
    fn check_features(
        &self,
        described: &Value,
        attributes: &Value,
        tables: &[GlbTable],
    ) -> Result<(), Cow<'static, str>> {
        for set in described["featureIds"].as_array().into_iter().flatten() {
            let Some(table) = number(&set["propertyTable"]) else { continue };
            let rows =
                tables.get(table).map(|table| table.ids.len()).ok_or("a feature has no property table")?;
            let attribute = format!("_FEATURE_ID_{}", number(&set["attribute"]).unwrap_or(0));
            let array = self.array(&attributes[attribute.as_str()])?;
            let none = set["nullFeatureId"].as_f64();
            for index in 0..array.count {
                let row = array.item(index)[0];
                #[allow(clippy::cast_precision_loss, reason = "a table has fewer rows than f64 has integers")]
                let is_row = row.fract() == 0.0 && (0.0..rows as f64).contains(&row);
                if !is_row && Some(row) != none {
                    return Err(format!("feature number {row} is not a row of its table of {rows}").into());
                }
            }
        }
        Ok(())
    }
}

/// Checks that there is a normal for each of `points` points, and that normals have length 1.
fn check_normals(normals: &NumberArray<'_>, points: usize) -> Result<(), Cow<'static, str>> {
    if normals.count != points {
        return Err(format!("there are {} normals for {points} points", normals.count).into());
    }
    for index in 0..normals.count {
        let length = normals.point(index).length();
        if !(0.98..1.02).contains(&length) {
            return Err(format!("a normal has the length {length}").into());
        }
    }
    Ok(())
}

fn component_size(component: u64) -> Option<usize> {
    match component {
        5120 | 5121 => Some(1),
        5122 | 5123 => Some(2),
        5125 | 5126 => Some(4),
        _ => None,
    }
}

impl NumberArray<'_> {
    /// Returns an item with zeros after its components. `index` is less than `count`.
    pub(super) fn item(&self, index: usize) -> [f64; 4] {
        let mut item = [0.0; 4];
        let size = component_size(self.component).unwrap_or(1);
        for (number, value) in item.iter_mut().take(self.width).enumerate() {
            let at = index * self.stride + number * size;
            let byte = |offset: usize| self.bytes.get(at + offset).copied().unwrap_or(0);
            let (read, most) = match self.component {
                5120 => (f64::from(byte(0).cast_signed()), 127.0),
                5121 => (f64::from(byte(0)), 255.0),
                5122 => (f64::from(i16::from_le_bytes([byte(0), byte(1)])), 32767.0),
                5123 => (f64::from(u16::from_le_bytes([byte(0), byte(1)])), 65535.0),
                5125 => (f64::from(u32::from_le_bytes([byte(0), byte(1), byte(2), byte(3)])), 1.0),
                _ => (f64::from(f32::from_le_bytes([byte(0), byte(1), byte(2), byte(3)])), 1.0),
            };
            *value = if self.is_normalized { (read / most).max(-1.0) } else { read };
        }
        item
    }

    /// Returns an item as a point.
    pub(super) fn point(&self, index: usize) -> DVec3 {
        let [x, y, z, _] = self.item(index);
        DVec3::new(x, y, z)
    }
}

/// Returns the transform of an object of the file.
fn transform(described: &Value) -> DAffine3 {
    let list =
        |key: &str| -> Option<Vec<f64>> { described[key].as_array()?.iter().map(Value::as_f64).collect() };
    if let Some(matrix) = list("matrix").and_then(|matrix| <[f64; 16]>::try_from(matrix).ok()) {
        return DAffine3::from_mat4(DMat4::from_cols_array(&matrix));
    }
    let vector = |key: &str, default: DVec3| match list(key).as_deref() {
        Some([x, y, z]) => DVec3::new(*x, *y, *z),
        _ => default,
    };
    let rotation = match list("rotation").as_deref() {
        Some([x, y, z, w]) => DQuat::from_xyzw(*x, *y, *z, *w).normalize(),
        _ => DQuat::IDENTITY,
    };
    let (scale, translation) = (vector("scale", DVec3::ONE), vector("translation", DVec3::ZERO));
    DAffine3::from_scale_rotation_translation(scale, rotation, translation)
}

impl GlbModel {
    /// Reads a file. Fails with the reason if it is invalid.
    pub fn read(bytes: &[u8]) -> Result<Self, Cow<'static, str>> {
        let file = GlbFile::new(bytes)?;
        let mut model = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY, ..Self::default() };
        model.tables = file.tables()?;
        let scene = number(&file.json["scene"]).unwrap_or(0);
        let roots = file.json["scenes"][scene]["nodes"].as_array();
        // y up to z up: a quarter turn about x.
        let upright = DAffine3::from_rotation_x(std::f64::consts::FRAC_PI_2);
        for root in roots.into_iter().flatten() {
            model.add(&file, root, &upright, 0)?;
        }
        Ok(model)
    }

    /// Adds an object of the file and those below it.
    fn add(
        &mut self,
        file: &GlbFile<'_>,
        index: &Value,
        parent: &DAffine3,
        depth: usize,
    ) -> Result<(), Cow<'static, str>> {
        if depth > DEPTH {
            return Err("its objects are nested too deeply".into());
        }
        let described = &file.json["nodes"][number(index).ok_or("an object has no index")?];
        let place = *parent * transform(described);
        if let Some(mesh) = number(&described["mesh"]) {
            let extensions = &described["extensions"];
            let instancing = &extensions["EXT_mesh_gpu_instancing"]["attributes"];
            let instances = instance_transforms(file, instancing)?;
            file.check_features(&extensions["EXT_instance_features"], instancing, &self.tables)?;
            for primitive in file.json["meshes"][mesh]["primitives"].as_array().into_iter().flatten() {
                file.check_features(
                    &primitive["extensions"]["EXT_mesh_features"],
                    &primitive["attributes"],
                    &self.tables,
                )?;
                let positions = file.array(&primitive["attributes"]["POSITION"])?;
                check_normals(&file.array(&primitive["attributes"]["NORMAL"])?, positions.count)?;
                let corners = match &primitive["indices"] {
                    Value::Null => positions.count,
                    indices => file.array(indices)?.count,
                };
                for instance in &instances {
                    let whole = place * *instance;
                    for number in 0..positions.count {
                        let point = whole.transform_point3(positions.point(number));
                        if !point.is_finite() {
                            return Err("a point is not finite".into());
                        }
                        (self.low, self.high) = (self.low.min(point), self.high.max(point));
                    }
                    self.points += positions.count;
                    self.triangles += corners / 3;
                }
            }
        }
        for child in described["children"].as_array().into_iter().flatten() {
            self.add(file, child, &place, depth + 1)?;
        }
        Ok(())
    }
}
