//! The bytes of a glTF file and of its external files, and the arrays of numbers in them.

use std::rc::Rc;

use base64::Engine;
use gltf_json::accessor::{ComponentType, Type};
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index, Root, buffer};
use rustc_hash::FxHashMap;

use super::options::{ImportOptions, broken_file};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};

/// The buffers of a file.
pub(super) struct Bytes<'a> {
    buffers: Vec<std::borrow::Cow<'a, [u8]>>,
}

impl<'a> Bytes<'a> {
    /// Reads all buffers; `own` is the binary chunk of the file itself.
    pub(super) fn load(root: &Root, own: Option<&'a [u8]>, wanted: &mut ImportOptions<'_>) -> Result<Self> {
        let mut buffers = Vec::new();
        for (index, buffer) in root.buffers.iter().enumerate() {
            let bytes = match (&buffer.uri, own) {
                (Some(uri), _) => address(uri, wanted)?.into(),
                (None, Some(own)) if index == 0 => own.into(),
                (None, _) => return Err(broken_file(wanted.name, format!("buffer {index} is empty"))),
            };
            let bytes: std::borrow::Cow<'a, [u8]> = bytes;
            if (bytes.len() as u64) < buffer.byte_length.0 {
                return Err(broken_file(wanted.name, format!("buffer {index} ends too early")));
            }
            buffers.push(bytes);
        }
        Ok(Self { buffers })
    }

    /// Returns the bytes of a view, and the stride (bytes) of its items if specified.
    pub(super) fn view(
        &self,
        root: &Root,
        index: Index<buffer::View>,
    ) -> Result<(&[u8], Option<usize>), String> {
        let none = || format!("view {} is outside its buffer", index.value());
        let view = root.get(index).ok_or_else(none)?;
        let buffer = self.buffers.get(view.buffer.value()).ok_or_else(none)?;
        let offset = usize::try_from(view.byte_offset.map_or(0, |offset| offset.0)).map_err(|_| none())?;
        let length = usize::try_from(view.byte_length.0).map_err(|_| none())?;
        let bytes = buffer.get(offset..).and_then(|rest| rest.get(..length)).ok_or_else(none)?;
        Ok((bytes, view.byte_stride.map(|stride| stride.0)))
    }
}

/// The arrays of numbers of a file, each read once even if several primitives share it.
pub(super) struct NumberColumns<'a> {
    pub root: &'a Root,
    pub bytes: &'a Bytes<'a>,
    pub budget: &'a Budget,
    pairs: ColumnCache<[f32; 2]>,
    triples: ColumnCache<[f32; 3]>,
    fours: ColumnCache<[f32; 4]>,
    indices: ColumnCache<u32>,
}

type ColumnCache<T> = FxHashMap<usize, Rc<[T]>>;

impl<'a> NumberColumns<'a> {
    pub(super) fn new(root: &'a Root, bytes: &'a Bytes<'a>, budget: &'a Budget) -> Self {
        let (pairs, triples) = (ColumnCache::default(), ColumnCache::default());
        Self {
            root,
            bytes,
            budget,
            pairs,
            triples,
            fours: ColumnCache::default(),
            indices: ColumnCache::default(),
        }
    }

    /// Returns the items of an accessor, each of two numbers. Normalized integers are scaled to 1.
    pub(super) fn pairs(&mut self, index: Index<Accessor>) -> Result<Rc<[[f32; 2]]>> {
        let mut known = std::mem::take(&mut self.pairs);
        let column = self.read_cached(&mut known, index, Self::column);
        self.pairs = known;
        column
    }

    /// Returns the items of an accessor, each of three numbers.
    pub(super) fn triples(&mut self, index: Index<Accessor>) -> Result<Rc<[[f32; 3]]>> {
        let mut known = std::mem::take(&mut self.triples);
        let column = self.read_cached(&mut known, index, Self::column);
        self.triples = known;
        column
    }

    /// Returns the items of an accessor, each of four numbers.
    pub(super) fn fours(&mut self, index: Index<Accessor>) -> Result<Rc<[[f32; 4]]>> {
        let mut known = std::mem::take(&mut self.fours);
        let column = self.read_cached(&mut known, index, Self::column);
        self.fours = known;
        column
    }

    /// Returns the items of an accessor of integers.
    pub(super) fn indices(&mut self, index: Index<Accessor>) -> Result<Rc<[u32]>> {
        let mut known = std::mem::take(&mut self.indices);
        let column = self.read_cached(&mut known, index, Self::whole);
        self.indices = known;
        column
    }

    fn read_cached<T>(
        &self,
        known: &mut ColumnCache<T>,
        index: Index<Accessor>,
        read: impl FnOnce(&Self, Index<Accessor>) -> Result<Vec<T>>,
    ) -> Result<Rc<[T]>> {
        if let Some(column) = known.get(&index.value()) {
            return Ok(Rc::clone(column));
        }
        let column: Rc<[T]> = read(self, index)?.into();
        known.insert(index.value(), Rc::clone(&column));
        Ok(column)
    }

    fn column<const N: usize>(&self, index: Index<Accessor>) -> Result<Vec<[f32; N]>> {
        let (accessor, component) = self.description(index, N)?;
        let size = component.size();
        let scale =
            |value: f32, most: f32| if accessor.normalized { (value / most).max(-1.0) } else { value };
        let read = |bytes: &[u8]| -> f32 {
            match (component, bytes) {
                (ComponentType::U8, &[a]) => scale(f32::from(a), 255.0),
                (ComponentType::I8, &[a]) => scale(f32::from(i8::from_le_bytes([a])), 127.0),
                (ComponentType::U16, &[a, b]) => scale(f32::from(u16::from_le_bytes([a, b])), 65535.0),
                (ComponentType::I16, &[a, b]) => scale(f32::from(i16::from_le_bytes([a, b])), 32767.0),
                (_, &[a, b, c, d]) => f32::from_le_bytes([a, b, c, d]),
                _ => 0.0,
            }
        };
        let mut items = Vec::new();
        self.each(accessor, size * N, size_of::<[f32; N]>(), |bytes| {
            items.push(std::array::from_fn(|at| read(&bytes[at * size..(at + 1) * size])));
        })?;
        Ok(items)
    }

    fn whole(&self, index: Index<Accessor>) -> Result<Vec<u32>> {
        let (accessor, component) = self.description(index, 1)?;
        if matches!(component, ComponentType::F32 | ComponentType::I8 | ComponentType::I16) {
            return Err(Error::data(format!("accessor {} does not contain integers", index.value())));
        }
        let mut items = Vec::new();
        self.each(accessor, component.size(), size_of::<u32>(), |bytes| {
            items.push(match *bytes {
                [a] => u32::from(a),
                [a, b] => u32::from(u16::from_le_bytes([a, b])),
                [a, b, c, d] => u32::from_le_bytes([a, b, c, d]),
                _ => 0,
            });
        })?;
        Ok(items)
    }

    /// Returns the number of components of an accessor's items, or 0 if there is no such accessor.
    pub(super) fn width(&self, index: Index<Accessor>) -> usize {
        match self.root.get(index).map(|accessor| &accessor.type_) {
            Some(Checked::Valid(kind)) => kind.multiplicity(),
            _ => 0,
        }
    }

    /// Returns an accessor with items of `count` numbers, and its component type. Fails if the accessor is unsupported.
    fn description(&self, index: Index<Accessor>, count: usize) -> Result<(&'a Accessor, ComponentType)> {
        let number = index.value();
        let accessor =
            self.root.get(index).ok_or_else(|| Error::data(format!("missing accessor {number}")))?;
        if accessor.sparse.is_some() {
            return Err(Error::data(format!("accessor {number} is sparse, which is not supported")));
        }
        let fits = match &accessor.type_ {
            Checked::Valid(kind) => kind.multiplicity() == count && *kind != Type::Mat2,
            Checked::Invalid => false,
        };
        match &accessor.component_type {
            Checked::Valid(component) if fits => Ok((accessor, component.0)),
            _ => Err(Error::data(format!("accessor {number} has items of an unsupported type"))),
        }
    }

    /// Calls `take` with the bytes of each item, and charges the budget `kept` bytes per item.
    fn each(&self, accessor: &Accessor, size: usize, kept: usize, mut take: impl FnMut(&[u8])) -> Result<()> {
        let outside = || Error::data("an accessor extends outside its view");
        // Without a view, all numbers are 0, which is not a shape.
        let view = accessor.buffer_view.ok_or_else(outside)?;
        let (bytes, stride) = self.bytes.view(self.root, view).map_err(Error::data)?;
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
        self.budget.take(count.saturating_mul(kept))?;
        for item in 0..count {
            if item.is_multiple_of(MANY) {
                self.budget.check()?;
            }
            let from = offset + item * stride;
            take(&bytes[from..from + size]);
        }
        Ok(())
    }
}

/// Number of items that are read between two checks of the budget.
pub(super) const MANY: usize = 1 << 16;

/// Returns the content of a URI in the file: data in the URI itself, or an external file.
pub(super) fn address(uri: &str, wanted: &mut ImportOptions<'_>) -> Result<Vec<u8>> {
    let Some(data) = uri.strip_prefix("data:") else { return (wanted.beside)(&plain(uri)) };
    let coded = data.split_once(";base64,").map(|(_, coded)| coded);
    wanted.budget.take(coded.map_or(0, str::len))?;
    let engine = base64::engine::general_purpose::STANDARD;
    coded
        .and_then(|coded| engine.decode(coded).ok())
        .ok_or_else(|| broken_file(wanted.name, "it contains data that is not base64"))
}

/// Decodes the percent-encoding of a URI, such as `%20`.
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
