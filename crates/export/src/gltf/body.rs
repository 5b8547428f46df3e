//! Binary part of a glTF file. It is planned first, so that its description can be written, and then written in chunks.

use std::borrow::Cow;

use super::super::check::proper_triangles;
use super::coordinates::{TexCoordMap, byte_normal, short_normal, y_up};
use super::corners::FaceCorners;
use super::packing::{PackedView, pack_triangles, pack_vertices, unpacked_buffer};
use super::quantize::IntegerArray;
use super::weld::FlatPart;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::stop::Stop;
use burgeon_scene::Part;
use gltf_json as json;
use json::buffer::{Stride, Target, View};
use json::validation::Checked::Valid;
use json::validation::USize64;
use rayon::prelude::*;
use std::io::{self, Write};
use std::ops::Range;
use std::sync::Arc;

#[cfg(target_endian = "big")]
compile_error!("glTF is little-endian and its arrays are written as they lie in memory");

/// Number of items (vertices, triangles, numbers) per chunk. A chunk fits into the cache of a processor core.
const STRETCH: usize = 1 << 14;

/// Approximate number of corners in a batch of meshes.
const BATCH: usize = 1 << 18;

/// Approximate length (bytes) of the description of a view's compression.
const DESCRIPTION: usize = 150;

/// Number of chunks that are prepared while the previous ones are written.
const AHEAD: usize = 16;

/// Type of arrays that share a buffer view. Thousands of small views make a file slow to open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ArrayKind {
    Positions,
    /// Positions as four u16; the last is padding.
    ShortPositions,
    Normals,
    /// Normals as four i8; the last is padding.
    ByteNormals,
    /// Normals as four i16; the last is padding.
    ShortNormals,
    TexCoords,
    /// Texture coordinates as two u16.
    ShortTexCoords,
    /// Feature numbers.
    Features,
    /// Indices as u8.
    Byte,
    /// Indices as u16.
    Short,
    /// Indices as u32.
    Long,
    /// Translations and scales of instances as three numbers.
    InstanceVectors,
    /// Rotations of instances as four numbers.
    InstanceRotations,
    /// Rotations of instances as four i16.
    ShortRotations,
}

/// Array of the body.
pub(super) enum BodyArray<'a> {
    Positions(&'a Part),
    Normals(&'a Part),
    ByteNormals(&'a Part),
    ShortNormals(&'a Part),
    TexCoords(&'a Part, TexCoordMap),
    /// Second texture coordinates of a part.
    SecondTexCoords(&'a Part, TexCoordMap),
    /// Integers in place of an array of single-precision numbers.
    Integers(Box<BodyArray<'a>>, IntegerArray),
    /// Indices of a part as u16, with the number of triangles to write and the number of its first vertex.
    Short(&'a Part, usize, u16),
    Long(&'a Part, usize),
    /// Positions of a welded part.
    Places(Arc<FlatPart>),
    /// Normals of a welded part as four i8.
    FaceNormals(Arc<FlatPart>),
    /// Indices of a welded part as u16, with the number of its first vertex.
    ShortCorners(Arc<FlatPart>, u16),
    LongCorners(Arc<FlatPart>),
    /// Positions of corners.
    CornerPlaces(Arc<FaceCorners<'a>>),
    /// Texture coordinates of corners.
    CornerTexCoords(Arc<FaceCorners<'a>>),
    /// Normals of corners.
    CornerNormals(Arc<FaceCorners<'a>>),
    /// Indices of faces among corners as u16, with the index of the faces and the number of triangles to write.
    ShortFaces(Arc<FaceCorners<'a>>, usize, usize),
    LongFaces(Arc<FaceCorners<'a>>, usize, usize),
    /// Indices below 256 as u8, in place of u16.
    ByteIndices(Box<BodyArray<'a>>),
    Floats(Vec<f32>),
    /// Number that is repeated a number of times.
    Same(f32, usize),
    Shorts(Vec<i16>),
    /// Data that is not an array of numbers, such as text.
    Blob(Vec<u8>),
    Bytes(&'a [u8]),
}

/// Contents of the buffer views of a document, in order.
#[derive(Default)]
pub(super) struct Body<'a> {
    sections: Vec<BufferSection<'a>>,
    /// Corners that the sections of each batch use, and the number of corners in the last batch.
    batches: Vec<Vec<Arc<FaceCorners<'a>>>>,
    corners: usize,
}

/// Content of one buffer view.
struct BufferSection<'a> {
    shared: Option<ArrayKind>,
    /// Number of its batch.
    batch: usize,
    blocks: Vec<BodyArray<'a>>,
    length: u64,
    /// Alignment of its end (bytes).
    alignment: u64,
    /// Description of the view before its compression, if it is compressed.
    packed: Option<PackedView>,
}

/// Several blocks, or a part of one.
struct Stretch<'a> {
    blocks: &'a [BodyArray<'a>],
    /// Range of items to take from each block.
    items: Range<usize>,
    /// Zeros after the items (bytes).
    padding: usize,
    /// Number of its batch.
    batch: usize,
}

impl<'a> Body<'a> {
    /// Adds `block` to the shared view of type `kind`. Returns the view and the offset in it (bytes).
    pub(super) fn share(&mut self, kind: ArrayKind, block: BodyArray<'a>) -> (u32, u64) {
        let batch = self.batches.len();
        let mut sections = self.sections.iter().enumerate().rev().take_while(|(_, it)| it.batch == batch);
        let index = match sections.find(|(_, section)| section.shared == Some(kind)) {
            Some((index, _)) => index,
            None => self.section(Some(kind)),
        };
        let section = &mut self.sections[index];
        let offset = section.length;
        section.length += block.length();
        section.blocks.push(block);
        (index as u32, offset)
    }

    /// Adds `block` as a separate view that begins at a multiple of 8, provided that all views before it are aligned
    /// too.
    pub(super) fn add_aligned(&mut self, block: BodyArray<'a>) -> u32 {
        let index = self.add(block);
        self.sections[index as usize].alignment = 8;
        index
    }

    /// Adds `block` as a separate view.
    pub(super) fn add(&mut self, block: BodyArray<'a>) -> u32 {
        let index = self.section(None);
        self.sections[index].length = block.length();
        self.sections[index].blocks.push(block);
        index as u32
    }

    /// Starts a new batch of views if the current one has many corners. The corners of the first batch stay in memory. Others
    /// are computed again when they are written, and stay in memory while their batch is written.
    pub(super) fn begin_mesh(&mut self) {
        if self.corners > BATCH {
            self.batches.push(Vec::new());
            self.corners = 0;
        }
    }

    /// Registers corners that blocks of this batch will use.
    pub(super) fn show(&mut self, corners: &Arc<FaceCorners<'a>>) {
        if self.batches.is_empty() {
            self.batches.push(Vec::new());
        }
        self.corners += corners.range(false).count;
        if self.batches.len() > 1 {
            corners.release();
        }
        if let Some(batch) = self.batches.last_mut() {
            batch.push(Arc::clone(corners));
        }
    }

    fn section(&mut self, shared: Option<ArrayKind>) -> usize {
        let batch = self.batches.len();
        self.sections.push(BufferSection {
            shared,
            batch,
            blocks: Vec::new(),
            length: 0,
            alignment: 4,
            packed: None,
        });
        self.sections.len() - 1
    }

    /// Compresses the shared views of vertices and triangles (`EXT_meshopt_compression`).
    pub(super) fn compress(&mut self) -> Result<()> {
        let mut released = 0;
        for section in &mut self.sections {
            let Some(kind) = section.shared else { continue };
            // As in `write`, only the corners of one batch stay in memory.
            while released + 1 < section.batch {
                self.batches[released].iter().for_each(|corners| corners.release());
                released += 1;
            }
            let mut bytes = Vec::new();
            section.blocks.iter().for_each(|block| block.write(&(0..usize::MAX), &mut bytes));
            let packed = match (kind, kind.item()) {
                (ArrayKind::Byte, _) => None,
                (ArrayKind::Short | ArrayKind::Long, size) => Some(pack_triangles(&bytes, size)?),
                (_, size) => Some(pack_vertices(&bytes, size)?),
            };
            section.blocks =
                vec![match packed.filter(|(_, packed)| packed.len() + DESCRIPTION < bytes.len()) {
                    Some((view, packed)) => {
                        section.packed = Some(view);
                        section.length = packed.len() as u64;
                        BodyArray::Blob(packed)
                    }
                    None => BodyArray::Blob(bytes),
                }];
        }
        self.batches.drain(..).flatten().for_each(|corners| corners.release());
        self.sections.iter_mut().for_each(|section| section.batch = 0);
        Ok(())
    }

    /// Returns the length (bytes) with padding; each view begins at a multiple of 4.
    pub(super) fn length(&self) -> u64 {
        self.sections.iter().map(BufferSection::end).sum()
    }

    /// Adds the buffer and its views to `root`. Fails if the body exceeds 4 GiB.
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
        let unpacked = self.sections.iter().filter_map(|section| section.packed).map(|view| view.length);
        let unpacked: u64 = unpacked.map(|length| length.next_multiple_of(4)).sum();
        let fallback = (unpacked > 0).then(|| {
            root.push(json::Buffer {
                byte_length: USize64(unpacked),
                name: None,
                uri: None,
                extensions: Some(unpacked_buffer()),
                extras: None,
            })
        });
        let (mut offset, mut unpacked) = (0, 0);
        for section in &self.sections {
            let (buffer, length, begin) = match (section.packed, fallback) {
                (Some(view), Some(fallback)) => (fallback, view.length, unpacked),
                _ => (buffer, section.length, offset),
            };
            unpacked += section.packed.map_or(0, |view| view.length.next_multiple_of(4));
            root.buffer_views.push(View {
                buffer,
                byte_length: USize64(length),
                byte_offset: (begin > 0).then_some(USize64(begin)),
                byte_stride: section.stride().map(Stride),
                name: None,
                target: section.target().map(Valid),
                extensions: section.packed.map(|view| view.describe(offset, section.length)),
                extras: None,
            });
            offset += section.end();
        }
        Ok(())
    }

    /// Writes `head` and exactly [`length`](Self::length) bytes. While one chunk is written, the next ones are
    /// prepared. Fails early if `stop` requests cancellation.
    pub(super) fn write(
        &self,
        head: Vec<Cow<'static, [u8]>>,
        out: &mut (impl Write + Send),
        stop: &Stop,
    ) -> io::Result<()> {
        let mut ready = head;
        let mut spare: Vec<Cow<[u8]>> = Vec::new();
        let mut released = 0;
        for next in self.stretches().chunks(AHEAD) {
            if stop.is_stopped() {
                return Ok(());
            }
            let present = next.first().map_or(0, |stretch| stretch.batch);
            // Sections count batches from 1, because sections before the first batch belong to none.
            while released + 1 < present {
                self.batches[released].iter().for_each(|corners| corners.release());
                released += 1;
            }
            spare.resize_with(next.len(), Cow::default);
            let write = || ready.iter().try_for_each(|bytes| out.write_all(bytes));
            let put =
                || next.par_iter().zip(&mut spare).for_each(|(stretch, bytes)| stretch.put(bytes.to_mut()));
            let (written, ()) = rayon::join(write, put);
            written?;
            // Buffers are reused after writing, because allocating fresh memory pages costs more than filling them.
            std::mem::swap(&mut ready, &mut spare);
        }
        ready.iter().try_for_each(|bytes| out.write_all(bytes))
    }

    /// Divides the body into chunks, in order.
    fn stretches(&self) -> Vec<Stretch<'_>> {
        let mut stretches = Vec::new();
        for section in &self.sections {
            let batch = section.batch;
            let mut rest = section.blocks.as_slice();
            while let Some(first) = rest.first() {
                if first.items() > STRETCH {
                    let parts = (0..first.items()).step_by(STRETCH).map(|from| from..from + STRETCH);
                    let blocks = &rest[..1];
                    stretches.extend(parts.map(|items| Stretch { blocks, items, padding: 0, batch }));
                    rest = &rest[1..];
                    continue;
                }
                let mut sum = 0;
                let fits = |block: &&BodyArray<'_>| {
                    sum += block.items();
                    sum <= STRETCH
                };
                let (blocks, others) = rest.split_at(rest.iter().take_while(fits).count());
                stretches.push(Stretch { blocks, items: 0..usize::MAX, padding: 0, batch });
                rest = others;
            }
            let padding = section.end() - section.length;
            if let Some(last) = stretches.last_mut() {
                last.padding = padding as usize;
            }
        }
        stretches
    }
}

impl Stretch<'_> {
    /// Replaces the content of `bytes` by the chunk.
    fn put(&self, bytes: &mut Vec<u8>) {
        bytes.clear();
        for block in self.blocks {
            block.write(&self.items, bytes);
        }
        bytes.resize(bytes.len() + self.padding, 0);
    }
}

impl BufferSection<'_> {
    /// Returns the length (bytes) with padding.
    fn end(&self) -> u64 {
        self.length.next_multiple_of(self.alignment)
    }

    fn target(&self) -> Option<Target> {
        Some(match self.shared? {
            ArrayKind::Byte | ArrayKind::Short | ArrayKind::Long => Target::ElementArrayBuffer,
            ArrayKind::InstanceVectors | ArrayKind::InstanceRotations | ArrayKind::ShortRotations => {
                return None;
            }
            _ => Target::ArrayBuffer,
        })
    }

    /// Returns the distance (bytes) between vertices, which several accessors that share a view require.
    fn stride(&self) -> Option<usize> {
        let is_vertices = self.target() == Some(Target::ArrayBuffer);
        self.shared.filter(|_| is_vertices).map(ArrayKind::item)
    }
}

impl ArrayKind {
    /// Returns the size of an item (bytes).
    fn item(self) -> usize {
        match self {
            Self::InstanceRotations => 16,
            Self::Positions | Self::Normals | Self::InstanceVectors => 12,
            Self::TexCoords | Self::ShortNormals | Self::ShortPositions | Self::ShortRotations => 8,
            Self::ByteNormals | Self::ShortTexCoords | Self::Features | Self::Long => 4,
            Self::Short => 2,
            Self::Byte => 1,
        }
    }
}

impl BodyArray<'_> {
    fn length(&self) -> u64 {
        let bytes = match self {
            Self::Positions(part) | Self::Normals(part) => part.positions.len() * 12,
            Self::TexCoords(part, _) | Self::SecondTexCoords(part, _) | Self::ShortNormals(part) => {
                part.positions.len() * 8
            }
            Self::ByteNormals(part) => part.positions.len() * 4,
            Self::Integers(array, kind) => array.items() * kind.stride(),
            Self::Short(_, triangles, _) => triangles * 6,
            Self::Long(_, triangles) => triangles * 12,
            Self::Places(welded) => welded.positions.len() * 12,
            Self::FaceNormals(welded) => welded.normals.len() * 4,
            Self::ShortCorners(welded, _) => welded.triangles.len() * 6,
            Self::LongCorners(welded) => welded.triangles.len() * 12,
            Self::CornerPlaces(corners) | Self::CornerNormals(corners) => corners.range(false).count * 12,
            Self::CornerTexCoords(corners) => corners.range(true).count * 8,
            Self::ShortFaces(_, _, triangles) => triangles * 6,
            Self::LongFaces(_, _, triangles) => triangles * 12,
            Self::ByteIndices(shorts) => return shorts.length() / 2,
            Self::Floats(floats) => floats.len() * 4,
            Self::Same(_, count) => count * 4,
            Self::Blob(bytes) => bytes.len(),
            Self::Shorts(shorts) => shorts.len() * 2,
            Self::Bytes(bytes) => bytes.len(),
        };
        bytes as u64
    }

    /// Returns the number of items before degenerate ones are skipped.
    fn items(&self) -> usize {
        match self {
            Self::Positions(part)
            | Self::Normals(part)
            | Self::ByteNormals(part)
            | Self::ShortNormals(part)
            | Self::TexCoords(part, _)
            | Self::SecondTexCoords(part, _) => part.positions.len(),
            Self::Short(part, ..) | Self::Long(part, _) => part.triangles.len(),
            Self::Places(welded) | Self::FaceNormals(welded) => welded.positions.len(),
            Self::ShortCorners(welded, _) | Self::LongCorners(welded) => welded.triangles.len(),
            Self::CornerPlaces(corners) | Self::CornerNormals(corners) => corners.range(false).count,
            Self::CornerTexCoords(corners) => corners.range(true).count,
            Self::ShortFaces(corners, faces, _) | Self::LongFaces(corners, faces, _) => {
                corners.faces(*faces).part.triangles.len()
            }
            Self::Floats(floats) => floats.len(),
            Self::Same(_, count) => *count,
            Self::Integers(array, _) | Self::ByteIndices(array) => array.items(),
            Self::Blob(bytes) => bytes.len(),
            Self::Shorts(shorts) => shorts.len(),
            Self::Bytes(bytes) => bytes.len(),
        }
    }

    /// Writes the `items` that exist.
    fn write(&self, items: &Range<usize>, out: &mut Vec<u8>) {
        let range = items.start..items.end.min(self.items());
        match self {
            Self::Positions(part) => put(out, part.positions[range].iter().map(|at| y_up(*at).to_array())),
            Self::Normals(part) => {
                put(out, part.normals[range].iter().map(|it| y_up(it.vector()).to_array()))
            }
            Self::ByteNormals(part) => put(out, part.normals[range].iter().map(|it| byte_normal(*it))),
            Self::ShortNormals(part) => put(out, part.normals[range].iter().map(|it| short_normal(*it))),
            Self::TexCoords(part, map) => put(out, part.uvs[range].iter().map(|uv| map.of(*uv))),
            Self::SecondTexCoords(part, map) => put(out, range.map(|vertex| map.of(part.second_uv(vertex)))),
            Self::Integers(array, kind) => {
                let mut floats = Vec::new();
                array.write(items, &mut floats);
                kind.put(&floats, out);
            }
            Self::ByteIndices(array) => {
                let mut shorts = Vec::new();
                array.write(items, &mut shorts);
                out.extend(shorts.as_chunks::<2>().0.iter().map(|[low, _]| *low));
            }
            Self::Short(part, _, first) => {
                let shown = proper_triangles(part.triangles.range(range));
                put(out, shown.map(|corners| corners.map(|corner| corner as u16 + first)));
            }
            Self::Long(part, _) => put(out, proper_triangles(part.triangles.range(range))),
            Self::Places(welded) => out.extend_from_slice(bytemuck::cast_slice(&welded.positions[range])),
            Self::FaceNormals(welded) => put(out, welded.normals[range].iter().map(|it| byte_normal(*it))),
            Self::ShortCorners(welded, first) => {
                let triangles = welded.triangles[range].iter();
                put(out, triangles.map(|corners| corners.map(|corner| corner as u16 + first)));
            }
            Self::LongCorners(welded) => {
                out.extend_from_slice(bytemuck::cast_slice(&welded.triangles[range]))
            }
            Self::CornerPlaces(corners) => {
                out.extend_from_slice(bytemuck::cast_slice(&corners.list().positions[range]))
            }
            Self::CornerTexCoords(corners) => {
                out.extend_from_slice(bytemuck::cast_slice(&corners.list().tex_coords[range]))
            }
            Self::CornerNormals(corners) => {
                put(out, corners.list().normals[range].iter().map(|it| y_up(it.vector()).to_array()))
            }
            Self::ShortFaces(corners, faces, _) => {
                let (list, shown) = (corners.list(), corners.faces(*faces).triangles(range));
                put(out, shown.map(|face| face.map(|vertex| list.of[*faces][vertex as usize] as u16)));
            }
            Self::LongFaces(corners, faces, _) => {
                let (list, shown) = (corners.list(), corners.faces(*faces).triangles(range));
                put(out, shown.map(|face| face.map(|vertex| list.of[*faces][vertex as usize])));
            }
            Self::Floats(floats) => out.extend_from_slice(bytemuck::cast_slice(&floats[range])),
            Self::Same(number, _) => range.for_each(|_| out.extend_from_slice(&number.to_le_bytes())),
            Self::Blob(bytes) => out.extend_from_slice(&bytes[range]),
            Self::Shorts(shorts) => out.extend_from_slice(bytemuck::cast_slice(&shorts[range])),
            Self::Bytes(bytes) => out.extend_from_slice(&bytes[range]),
        }
    }
}

/// Appends items as they are stored in memory. The iterator must have an upper bound of its length.
fn put<T: bytemuck::NoUninit>(out: &mut Vec<u8>, items: impl Iterator<Item = T>) {
    let begin = out.len();
    out.resize(begin + items.size_hint().1.unwrap_or(0) * size_of::<T>(), 0);
    let mut end = begin;
    for (place, item) in out[begin..].chunks_exact_mut(size_of::<T>()).zip(items) {
        place.copy_from_slice(bytemuck::bytes_of(&item));
        end += size_of::<T>();
    }
    out.truncate(end);
}

/// Converts `bytes` to the u32 of glTF's headers. Fails if the length exceeds it.
pub(super) fn within_limit(bytes: u64) -> Result<u32> {
    u32::try_from(bytes).map_err(|_| {
        let gigabytes = bytes as f64 / f64::from(1 << 30);
        Error::limit(
            Limit::Format,
            format!("the model takes {gigabytes:.1} GiB, and glTF files end at 4 GiB"),
        )
        .help("write it in parts, with less detail, or with more instances of fewer meshes")
    })
}
