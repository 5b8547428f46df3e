//! The bytes of a glTF file and of those beside it, and the columns of numbers in them.

use base64::Engine;
use gltf_json::accessor::{ComponentType, Type};
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index, Root, buffer};

use super::{Wanted, broken};
use crate::error::Result;

/// The buffers of a file.
pub(super) struct Bytes<'a> {
    buffers: Vec<std::borrow::Cow<'a, [u8]>>,
}

impl<'a> Bytes<'a> {
    /// Reads all buffers; `own` is that of the file itself.
    pub(super) fn load(root: &Root, own: Option<&'a [u8]>, wanted: &mut Wanted<'_>) -> Result<Self> {
        let mut buffers = Vec::new();
        for (index, buffer) in root.buffers.iter().enumerate() {
            let bytes = match (&buffer.uri, own) {
                (Some(uri), _) => address(uri, wanted)?.into(),
                (None, Some(own)) if index == 0 => own.into(),
                (None, _) => return Err(broken(wanted.name, format!("buffer {index} has no content"))),
            };
            let bytes: std::borrow::Cow<'a, [u8]> = bytes;
            if (bytes.len() as u64) < buffer.byte_length.0 {
                return Err(broken(wanted.name, format!("buffer {index} ends too early")));
            }
            buffers.push(bytes);
        }
        Ok(Self { buffers })
    }

    /// The bytes of a view, and how far apart (bytes) its items are if it says so.
    pub(super) fn view(
        &self,
        root: &Root,
        index: Index<buffer::View>,
    ) -> Result<(&[u8], Option<usize>), String> {
        let none = || format!("view {} lies outside of its buffer", index.value());
        let view = root.get(index).ok_or_else(none)?;
        let buffer = self.buffers.get(view.buffer.value()).ok_or_else(none)?;
        let offset = usize::try_from(view.byte_offset.map_or(0, |offset| offset.0)).map_err(|_| none())?;
        let length = usize::try_from(view.byte_length.0).map_err(|_| none())?;
        let bytes = buffer.get(offset..).and_then(|rest| rest.get(..length)).ok_or_else(none)?;
        Ok((bytes, view.byte_stride.map(|stride| stride.0)))
    }

    /// The items of an accessor, each of `N` numbers; whole numbers are scaled to 1 where they are normalized.
    pub(super) fn column<const N: usize>(
        &self,
        root: &Root,
        index: Index<Accessor>,
    ) -> Result<Vec<[f32; N]>, String> {
        let (accessor, size) = self.described(root, index, N)?;
        let read = |bytes: &[u8]| -> f32 {
            let scale = |value: f32, most: f32| if accessor.normalized { value / most } else { value };
            match *bytes {
                [a] => scale(f32::from(a), 255.0),
                [a, b] => scale(f32::from(u16::from_le_bytes([a, b])), 65535.0),
                [a, b, c, d] => f32::from_le_bytes([a, b, c, d]),
                _ => 0.0,
            }
        };
        let mut items = Vec::new();
        self.each(root, accessor, size * N, |bytes| {
            items.push(std::array::from_fn(|at| read(&bytes[at * size..(at + 1) * size])));
        })?;
        Ok(items)
    }

    /// The items of an accessor of whole numbers.
    pub(super) fn indices(&self, root: &Root, index: Index<Accessor>) -> Result<Vec<u32>, String> {
        let (accessor, size) = self.described(root, index, 1)?;
        if matches!(&accessor.component_type, Checked::Valid(component) if component.0 == ComponentType::F32)
        {
            return Err(format!("accessor {} has no whole numbers", index.value()));
        }
        let mut items = Vec::new();
        self.each(root, accessor, size, |bytes| {
            items.push(match *bytes {
                [a] => u32::from(a),
                [a, b] => u32::from(u16::from_le_bytes([a, b])),
                [a, b, c, d] => u32::from_le_bytes([a, b, c, d]),
                _ => 0,
            });
        })?;
        Ok(items)
    }

    /// An accessor of items of `count` numbers, and the size (bytes) of a number.
    fn described<'r>(
        &self,
        root: &'r Root,
        index: Index<Accessor>,
        count: usize,
    ) -> Result<(&'r Accessor, usize), String> {
        let number = index.value();
        let accessor = root.get(index).ok_or_else(|| format!("there is no accessor {number}"))?;
        if accessor.sparse.is_some() {
            return Err(format!("accessor {number} is sparse, which is not read"));
        }
        let fits = match &accessor.type_ {
            Checked::Valid(kind) => kind.multiplicity() == count && *kind != Type::Mat2,
            Checked::Invalid => false,
        };
        let size = match &accessor.component_type {
            Checked::Valid(component) => match component.0 {
                ComponentType::U8 => 1,
                ComponentType::U16 => 2,
                ComponentType::U32 | ComponentType::F32 => 4,
                ComponentType::I8 | ComponentType::I16 => 0,
            },
            Checked::Invalid => 0,
        };
        if !fits || size == 0 {
            return Err(format!("accessor {number} has items of another type than is read"));
        }
        Ok((accessor, size))
    }

    fn each(
        &self,
        root: &Root,
        accessor: &Accessor,
        size: usize,
        mut take: impl FnMut(&[u8]),
    ) -> Result<(), String> {
        let outside = || "an accessor reaches outside of its view".to_owned();
        // Without a view all numbers are 0, which is no shape.
        let (bytes, stride) = self.view(root, accessor.buffer_view.ok_or_else(outside)?)?;
        let stride = stride.unwrap_or(size).max(1);
        let offset =
            usize::try_from(accessor.byte_offset.map_or(0, |offset| offset.0)).map_err(|_| outside())?;
        let count = usize::try_from(accessor.count.0).map_err(|_| outside())?;
        if count == 0 {
            return Ok(());
        }
        let last = (count - 1).checked_mul(stride).and_then(|last| last.checked_add(offset));
        if last.and_then(|last| last.checked_add(size)).is_none_or(|end| end > bytes.len()) {
            return Err(outside());
        }
        for item in 0..count {
            let from = offset + item * stride;
            take(&bytes[from..from + size]);
        }
        Ok(())
    }
}

/// What an address in the file means: content in the address itself, or a file beside it.
pub(super) fn address(uri: &str, wanted: &mut Wanted<'_>) -> Result<Vec<u8>> {
    let Some(data) = uri.strip_prefix("data:") else { return (wanted.beside)(&plain(uri)) };
    let coded = data.split_once(";base64,").map(|(_, coded)| coded);
    let engine = base64::engine::general_purpose::STANDARD;
    coded
        .and_then(|coded| engine.decode(coded).ok())
        .ok_or_else(|| broken(wanted.name, "it holds data that is not base64"))
}

/// An address without its escapes, `%20` and the like.
fn plain(uri: &str) -> String {
    let bytes = uri.as_bytes();
    let (mut found, mut at) = (Vec::new(), 0);
    while at < bytes.len() {
        let escaped = (bytes[at] == b'%')
            .then(|| uri.get(at + 1..at + 3).and_then(|digits| u8::from_str_radix(digits, 16).ok()))
            .flatten();
        found.push(escaped.unwrap_or(bytes[at]));
        at += if escaped.is_some() { 3 } else { 1 };
    }
    String::from_utf8_lossy(&found).into_owned()
}
