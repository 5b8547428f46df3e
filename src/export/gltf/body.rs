//! The binary part of a glTF: planned first, so that its description can be written, then streamed.

use super::super::check::triangles;
use crate::error::{Error, Result};
use crate::scene::Part;
use glam::Vec3;
use gltf_json as json;
use json::buffer::{Stride, Target, View};
use json::validation::Checked::Valid;
use json::validation::USize64;
use std::io::{self, Write};

#[cfg(target_endian = "big")]
compile_error!("glTF is little-endian and its arrays are written as they lie in memory");

/// The most (bytes) that is put together in memory before it is written.
const GATHERED: u64 = 200 << 20;

/// Vertices or triangles that are converted at a time.
const BATCH: usize = 4096;

/// Arrays that share a buffer view, since thousands of small views make a file slow to open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shared {
    Positions,
    Normals,
    /// Normals as four i8, of which the last is nothing.
    ByteNormals,
    /// Normals as four i16, of which the last is nothing.
    ShortNormals,
    TexCoords,
    /// Indices as u16.
    Short,
    /// Indices as u32.
    Long,
}

/// An array of the body.
pub(super) enum Block<'a> {
    Positions(&'a Part),
    Normals(&'a Part),
    ByteNormals(&'a Part),
    ShortNormals(&'a Part),
    /// The texture coordinates of a part whose texture has this width and height (m).
    TexCoords(&'a Part, [f64; 2]),
    /// The indices of a part whose vertices begin with this number, as u16.
    Short(&'a Part, u16),
    Long(&'a Part),
    Floats(Vec<f32>),
    Bytes(&'a [u8]),
}

/// What the buffer views of a document show, in order.
#[derive(Default)]
pub(super) struct Body<'a> {
    sections: Vec<Section<'a>>,
}

/// What one buffer view shows.
struct Section<'a> {
    shared: Option<Shared>,
    blocks: Vec<Block<'a>>,
    length: u64,
}

impl<'a> Body<'a> {
    /// Adds `block` to the view of its kind. Returns the view and the offset in it (bytes).
    pub(super) fn share(&mut self, kind: Shared, block: Block<'a>) -> (json::Index<View>, u64) {
        let index = match self.sections.iter().position(|section| section.shared == Some(kind)) {
            Some(index) => index,
            None => self.section(Some(kind)),
        };
        let section = &mut self.sections[index];
        let offset = section.length;
        section.length += block.length();
        section.blocks.push(block);
        (json::Index::new(index as u32), offset)
    }

    /// Adds `block` as a view of its own.
    pub(super) fn add(&mut self, block: Block<'a>) -> json::Index<View> {
        let index = self.section(None);
        self.sections[index].length = block.length();
        self.sections[index].blocks.push(block);
        json::Index::new(index as u32)
    }

    fn section(&mut self, shared: Option<Shared>) -> usize {
        self.sections.push(Section { shared, blocks: Vec::new(), length: 0 });
        self.sections.len() - 1
    }

    /// Length (bytes) with padding; each view begins at a multiple of 4.
    pub(super) fn length(&self) -> u64 {
        self.sections.iter().map(|section| section.length.next_multiple_of(4)).sum()
    }

    /// Adds the buffer and its views to `root`. Fails beyond 4 GiB.
    pub(super) fn describe(&self, root: &mut json::Root) -> Result<()> {
        let length = self.length();
        within_limit(length)?;
        if length == 0 {
            return Ok(());
        }
        let buffer = root.push(json::Buffer {
            byte_length: USize64(length),
            name: None,
            uri: None,
            extensions: None,
            extras: None,
        });
        let mut offset = 0;
        for section in &self.sections {
            root.buffer_views.push(View {
                buffer,
                byte_length: USize64(section.length),
                byte_offset: (offset > 0).then_some(USize64(offset)),
                byte_stride: section.stride().map(Stride),
                name: None,
                target: section.target().map(Valid),
                extensions: None,
                extras: None,
            });
            offset += section.length.next_multiple_of(4);
        }
        Ok(())
    }

    /// All of it in memory, unless it is too large to be there twice.
    pub(super) fn gathered(&self) -> io::Result<Option<Vec<u8>>> {
        if self.length() > GATHERED {
            return Ok(None);
        }
        let mut bytes = Vec::with_capacity(self.length() as usize);
        self.write(&mut bytes)?;
        Ok(Some(bytes))
    }

    /// Writes exactly [`length`](Self::length) bytes.
    pub(super) fn write(&self, out: &mut impl Write) -> io::Result<()> {
        for section in &self.sections {
            for block in &section.blocks {
                block.write(out)?;
            }
            let padding = section.length.next_multiple_of(4) - section.length;
            out.write_all(&[0; 4][..padding as usize])?;
        }
        Ok(())
    }
}

impl Section<'_> {
    fn target(&self) -> Option<Target> {
        Some(match self.shared? {
            Shared::Short | Shared::Long => Target::ElementArrayBuffer,
            _ => Target::ArrayBuffer,
        })
    }

    /// Bytes from one vertex to the next; several accessors may share a view only if it says so.
    fn stride(&self) -> Option<usize> {
        match self.shared? {
            Shared::Positions | Shared::Normals => Some(12),
            Shared::TexCoords | Shared::ShortNormals => Some(8),
            Shared::ByteNormals => Some(4),
            Shared::Short | Shared::Long => None,
        }
    }
}

impl Block<'_> {
    fn length(&self) -> u64 {
        let bytes = match self {
            Self::Positions(part) | Self::Normals(part) => part.positions.len() * 12,
            Self::TexCoords(part, _) | Self::ShortNormals(part) => part.positions.len() * 8,
            Self::ByteNormals(part) => part.positions.len() * 4,
            Self::Short(part, _) => triangles(part).count() * 6,
            Self::Long(part) => triangles(part).count() * 12,
            Self::Floats(floats) => floats.len() * 4,
            Self::Bytes(bytes) => bytes.len(),
        };
        bytes as u64
    }

    fn write(&self, out: &mut impl Write) -> io::Result<()> {
        match self {
            Self::Positions(part) => stream(out, part.positions.iter().map(|at| y_up(*at).to_array())),
            Self::Normals(part) => stream(out, part.normals.iter().map(|it| y_up(unit(*it)).to_array())),
            Self::ByteNormals(part) => stream(out, part.normals.iter().map(|it| byte_normal(*it))),
            Self::ShortNormals(part) => stream(out, part.normals.iter().map(|it| short_normal(*it))),
            Self::TexCoords(part, size) => stream(out, part.uvs.iter().map(|uv| tex_coord(*uv, *size))),
            Self::Short(part, first) => {
                stream(out, triangles(part).map(|corners| corners.map(|corner| corner as u16 + first)))
            }
            Self::Long(part) => stream(out, triangles(part)),
            Self::Floats(floats) => out.write_all(bytemuck::cast_slice(floats)),
            Self::Bytes(bytes) => out.write_all(bytes),
        }
    }
}

/// Writes items as they lie in memory, a batch at a time.
fn stream<T: bytemuck::NoUninit>(out: &mut impl Write, mut items: impl Iterator<Item = T>) -> io::Result<()> {
    let mut batch = Vec::with_capacity(BATCH);
    loop {
        batch.extend(items.by_ref().take(BATCH));
        if batch.is_empty() {
            return Ok(());
        }
        out.write_all(bytemuck::cast_slice(&batch))?;
        batch.clear();
    }
}

/// A vector of the scene, z up, in glTF's coordinates, y up. Adding zero turns -0 into 0.
pub(super) fn y_up(vector: Vec3) -> Vec3 {
    Vec3::new(vector.x, vector.z, -vector.y) + 0.0
}

/// `normal` at length 1 after rounding; upwards if it has no direction.
pub(super) fn unit(normal: Vec3) -> Vec3 {
    // As near as f32 comes to it already.
    if (normal.length_squared() - 1.0).abs() < 2e-7 {
        return normal;
    }
    let exact = normal.as_dvec3();
    match exact.try_normalize() {
        Some(unit) => unit.as_vec3(),
        None => Vec3::Z,
    }
}

/// A unit vector as parts of 127, and a zero.
#[allow(clippy::cast_possible_truncation, reason = "bounded before")]
fn byte_normal(normal: Vec3) -> [i8; 4] {
    let [x, y, z] = (y_up(unit(normal)) * 127.0).round().to_array();
    [x as i8, y as i8, z as i8, 0]
}

/// A unit vector as parts of 32767, and a zero.
#[allow(clippy::cast_possible_truncation, reason = "bounded before")]
fn short_normal(normal: Vec3) -> [i16; 4] {
    let [x, y, z] = (y_up(unit(normal)) * 32767.0).round().to_array();
    [x as i16, y as i16, z as i16, 0]
}

/// Texture coordinates in metres, v upwards, as parts of the image, v downwards.
fn tex_coord(uv: glam::Vec2, size: [f64; 2]) -> [f32; 2] {
    [(f64::from(uv.x) / size[0]) as f32, (1.0 - f64::from(uv.y) / size[1]) as f32]
}

/// `bytes` as the u32 that glTF's headers have, or what to do about it.
pub(super) fn within_limit(bytes: u64) -> Result<u32> {
    u32::try_from(bytes).map_err(|_| {
        let gigabytes = bytes as f64 / f64::from(1 << 30);
        Error::new(format!("the model takes {gigabytes:.1} GiB, and glTF files end at 4 GiB"))
            .help("write it in parts, with less detail, or with more instances of fewer meshes")
    })
}
