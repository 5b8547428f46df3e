//! Compression of buffer views.
//!
//! Specification: Khronos Group, "EXT_meshopt_compression", 2021. Vertices have version 0 of the format and triangles version 1.

use burgeon_base::error::{Error, Result};
use gltf_json as json;
use serde_json::{Value, json};

/// Extension of compressed views.
pub(super) const MESHOPT: &str = "EXT_meshopt_compression";

/// Description of a view before its compression.
#[derive(Debug, Clone, Copy)]
pub(super) struct PackedView {
    mode: &'static str,
    stride: usize,
    count: usize,
    /// Length (bytes) before the compression.
    pub(super) length: u64,
}

/// Compresses the vertices of a view: items of `stride` bytes, a multiple of 4.
pub(super) fn pack_vertices(bytes: &[u8], stride: usize) -> Result<(PackedView, Vec<u8>)> {
    fn pack<const N: usize>(bytes: &[u8]) -> meshopt::Result<Vec<u8>> {
        let items: Vec<[u8; N]> = bytes.chunks_exact(N).filter_map(|item| item.try_into().ok()).collect();
        meshopt::encode_vertex_buffer_level(&items, 2, Some(0))
    }
    let packed = match stride {
        4 => pack::<4>(bytes),
        8 => pack::<8>(bytes),
        12 => pack::<12>(bytes),
        16 => pack::<16>(bytes),
        other => return Err(Error::internal(format!("vertices of {other} bytes cannot be compressed"))),
    };
    let packed = packed.map_err(|error| Error::internal(format!("cannot compress vertices: {error}")))?;
    let view =
        PackedView { mode: "ATTRIBUTES", stride, count: bytes.len() / stride, length: bytes.len() as u64 };
    Ok((view, packed))
}

/// Compresses the triangles of a view: indices of 2 or 4 bytes.
pub(super) fn pack_triangles(bytes: &[u8], stride: usize) -> Result<(PackedView, Vec<u8>)> {
    let index = |item: &[u8]| item.iter().rev().fold(0_u32, |index, byte| index << 8 | u32::from(*byte));
    let indices: Vec<u32> = bytes.chunks_exact(stride).map(index).collect();
    let vertices = indices.iter().max().map_or(0, |most| *most as usize + 1);
    let packed = meshopt::encode_index_buffer(&indices, vertices)
        .map_err(|error| Error::internal(format!("cannot compress triangles: {error}")))?;
    let view = PackedView { mode: "TRIANGLES", stride, count: indices.len(), length: bytes.len() as u64 };
    Ok((view, packed))
}

impl PackedView {
    /// Returns the extension of the view, whose compressed bytes are in the first buffer.
    pub(super) fn describe(&self, offset: u64, length: u64) -> json::extensions::buffer::View {
        let described = json!({
            "buffer": 0, "byteOffset": offset, "byteLength": length,
            "byteStride": self.stride, "count": self.count, "mode": self.mode,
        });
        let mut extensions = json::extensions::buffer::View::default();
        extensions.others.insert(MESHOPT.into(), described);
        extensions
    }
}

/// Returns the extension of the buffer that has the offsets of the views before their compression, and no bytes.
pub(super) fn unpacked_buffer() -> json::extensions::buffer::Buffer {
    let mut extensions = json::extensions::buffer::Buffer::default();
    extensions.others.insert(MESHOPT.into(), Value::from_iter([("fallback", true)]));
    extensions
}
