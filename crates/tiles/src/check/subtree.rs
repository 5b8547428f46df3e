//! Reader of subtree files of implicit tiling. It shares no code with the writer.

use std::borrow::Cow;

use serde_json::Value;

/// Subtree file.
pub(super) struct SubtreeFile {
    /// Tiles in the order of the file.
    pub(super) tiles: Vec<SubtreeTile>,
    /// Columns and rows of the subtrees below, in their level.
    pub(super) children: Vec<[u32; 2]>,
}

/// Available tile of a subtree.
pub(super) struct SubtreeTile {
    /// Level, column and row in the subtree.
    pub(super) place: [u32; 3],
    pub(super) has_content: bool,
    pub(super) bounds: [f64; 12],
    pub(super) error: f64,
}

/// Views of the binary part of a file.
struct Views<'a> {
    views: Vec<&'a [u8]>,
}

fn number(value: &Value) -> Option<usize> {
    value.as_u64().and_then(|number| usize::try_from(number).ok())
}

impl<'a> Views<'a> {
    fn new(document: &Value, binary: &'a [u8]) -> Result<Self, Cow<'static, str>> {
        let mut views = Vec::new();
        for view in document["bufferViews"].as_array().into_iter().flatten() {
            let (begin, length) = (number(&view["byteOffset"]), number(&view["byteLength"]));
            let bytes =
                begin.zip(length).and_then(|(begin, length)| binary.get(begin..begin.checked_add(length)?));
            views.push(
                bytes.filter(|_| begin.is_some_and(|begin| begin % 8 == 0)).ok_or("a view is invalid")?,
            );
        }
        Ok(Self { views })
    }

    fn get(&self, index: &Value) -> Result<&'a [u8], Cow<'static, str>> {
        number(index)
            .and_then(|index| self.views.get(index).copied())
            .ok_or(Cow::Borrowed("a view is missing"))
    }

    /// Returns the bits of an availability.
    fn bits(&self, availability: &Value, length: usize) -> Result<Vec<bool>, Cow<'static, str>> {
        let constant = match &availability["constant"] {
            Value::Null => None,
            value => Some(value.as_u64().filter(|bit| *bit < 2).ok_or("a constant is not 0 or 1")?),
        };
        if let Some(bit) = constant {
            return Ok(vec![bit == 1; length]);
        }
        let bytes = self.get(&availability["bitstream"])?;
        if bytes.len() != length.div_ceil(8) {
            return Err(
                format!("a bit stream has {} bytes instead of {}", bytes.len(), length.div_ceil(8)).into()
            );
        }
        let mut bits: Vec<bool> =
            bytes.iter().flat_map(|byte| (0..8).map(move |bit| byte >> bit & 1 == 1)).collect();
        if bits.drain(length..).any(|bit| bit) {
            return Err("an unused bit is set".into());
        }
        let count = bits.iter().filter(|bit| **bit).count();
        if number(&availability["availableCount"]).is_some_and(|told| told != count) {
            return Err(format!("availableCount is not the {count} of the bit stream").into());
        }
        Ok(bits)
    }

    /// Returns the numbers of a property of `count` rows with `width` numbers.
    fn numbers(&self, property: &Value, count: usize, width: usize) -> Result<Vec<f64>, Cow<'static, str>> {
        let bytes = self.get(&property["values"])?;
        if bytes.len() != count * width * 8 {
            return Err("a property has the wrong number of values".into());
        }
        Ok(bytes
            .chunks_exact(8)
            .map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap_or_default()))
            .collect())
    }
}

/// Returns the column and the row with a number in Morton's order.
fn place(mut number: usize) -> [u32; 2] {
    let mut place = [0; 2];
    let mut bit = 0;
    while number > 0 {
        place[0] |= u32::from(number & 1 == 1) << bit;
        place[1] |= u32::from(number & 2 == 2) << bit;
        (number, bit) = (number / 4, bit + 1);
    }
    place
}

impl SubtreeFile {
    /// Reads a file with subtrees of `levels` levels. `schema` describes the metadata of tiles. Fails with the reason.
    pub(super) fn read(bytes: &[u8], levels: u32, schema: &Value) -> Result<Self, Cow<'static, str>> {
        let long = |at: usize| -> Option<usize> {
            usize::try_from(u64::from_le_bytes(bytes.get(at..at + 8)?.try_into().ok()?)).ok()
        };
        if bytes.get(..8) != Some(&b"subt\x01\0\0\0"[..]) {
            return Err("it is not a subtree file of version 1".into());
        }
        let (text, size) = long(8).zip(long(16)).ok_or("its header is incomplete")?;
        let parts = text.checked_add(24).filter(|end| *end <= bytes.len()).map(|end| bytes.split_at(end));
        let (head, binary) = parts.ok_or("its JSON ends too early")?;
        if text % 8 != 0 || size % 8 != 0 || binary.len() != size {
            return Err("its parts do not have the lengths of the header, or no multiples of 8".into());
        }
        let document: Value = serde_json::from_slice(&head[24..])
            .map_err(|error| format!("its JSON cannot be read: {error}"))?;
        let views = Views::new(&document, binary)?;
        let starts: Vec<usize> = (0..=levels).map(|level| ((1_usize << (2 * level)) - 1) / 3).collect();
        let all = starts.last().copied().unwrap_or(0);
        let present = views.bits(&document["tileAvailability"], all)?;
        let content = views.bits(&document["contentAvailability"][0], all)?;
        let below = views.bits(&document["childSubtreeAvailability"], 1 << (2 * levels))?;
        let count = present.iter().filter(|bit| **bit).count();
        let table =
            &document["propertyTables"][number(&document["tileMetadata"]).ok_or("it has no metadata")?];
        if number(&table["count"]) != Some(count) {
            return Err(format!("its metadata are not those of {count} tiles").into());
        }
        let class = &schema["classes"][table["class"].as_str().unwrap_or_default()]["properties"];
        let named = |semantic: &str| -> Result<&Value, Cow<'static, str>> {
            let mut properties = class.as_object().into_iter().flatten();
            let name =
                properties.find(|(_, property)| property["semantic"] == semantic).map(|(name, _)| name);
            Ok(&table["properties"][name.ok_or_else(|| format!("the schema has no {semantic}"))?])
        };
        let bounds = views.numbers(named("TILE_BOUNDING_BOX")?, count, 12)?;
        let errors = views.numbers(named("TILE_GEOMETRIC_ERROR")?, count, 1)?;
        let rows = bounds.chunks_exact(12).zip(errors);
        let mut tiles = Vec::new();
        let numbers = present.iter().enumerate().filter(|(_, bit)| **bit).map(|(number, _)| number);
        for (number, (bounds, error)) in numbers.zip(rows) {
            let level = starts.partition_point(|start| *start <= number) - 1;
            let in_level = number - starts[level];
            let [x, y] = place(in_level);
            if level > 0 && !present[starts[level - 1] + in_level / 4] {
                return Err("a tile has no parent".into());
            }
            let level = u32::try_from(level).unwrap_or(u32::MAX);
            let bounds = bounds.try_into().unwrap_or_default();
            tiles.push(SubtreeTile { place: [level, x, y], has_content: content[number], bounds, error });
        }
        if content.iter().zip(&present).any(|(content, tile)| *content && !tile) {
            return Err("a content has no tile".into());
        }
        let parents = all - (1 << (2 * (levels - 1)));
        let mut children = Vec::new();
        for (number, _) in below.iter().enumerate().filter(|(_, bit)| **bit) {
            if !present[parents + number / 4] {
                return Err("a subtree below has no parent".into());
            }
            children.push(place(number));
        }
        if tiles.first().is_none_or(|tile| tile.place != [0; 3]) {
            return Err("it has no tile".into());
        }
        Ok(Self { tiles, children })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::TileId;
    use proptest::prelude::*;
    use std::collections::BTreeSet;

    /// Reads the tiles of files that begin at the root, as level, column, row, error and content.
    fn read_all(files: &[(TileId, Vec<u8>)], levels: u32) -> BTreeSet<([u32; 3], u64, bool)> {
        let schema = crate::join::example_subtree().1;
        let (mut tiles, mut open, mut read) = (BTreeSet::new(), vec![TileId::ROOT], 0);
        while let Some(root) = open.pop() {
            let (_, bytes) = files.iter().find(|(id, _)| *id == root).unwrap();
            read += 1;
            let file = SubtreeFile::read(bytes, levels, &schema).unwrap();
            for tile in file.tiles {
                let [level, x, y] = tile.place;
                assert_eq!(tile.bounds, [tile.error; 12]);
                let place = [root.level + level, (root.x << level) + x, (root.y << level) + y];
                tiles.insert((place, tile.error.to_bits(), tile.has_content));
            }
            open.extend(file.children.iter().map(|[x, y]| TileId {
                level: root.level + levels,
                x: (root.x << levels) + x,
                y: (root.y << levels) + y,
            }));
        }
        assert_eq!(read, files.len());
        tiles
    }

    proptest! {
        #[test]
        fn subtrees_of_any_number_of_levels_list_the_same_tiles(
            leaves in prop::collection::vec((0..9_u32, 0..512_u32, 0..512_u32), 1..40), levels in 1..5_u32,
        ) {
            let mut places = BTreeSet::from([TileId::ROOT]);
            for (level, x, y) in leaves {
                let leaf = TileId { level, x: x >> (9 - level), y: y >> (9 - level) };
                places.extend((0..=level).map(|level| leaf.ancestor(level)));
            }
            let places: Vec<TileId> = places.into_iter().collect();
            let numbered = places.iter().zip(0_u32..);
            let expected = numbered.map(|(id, number)| ([id.level, id.x, id.y], f64::from(number).to_bits(), number.is_multiple_of(2)));
            let files = crate::join::numbered_subtrees(&places, levels);
            prop_assert_eq!(read_all(&files, levels), expected.collect());
        }
    }

    #[test]
    fn damaged_files_are_refused_without_a_panic() {
        let (bytes, schema) = crate::join::example_subtree();
        assert_eq!(SubtreeFile::read(&bytes, 2, &schema).unwrap().tiles.len(), 3);
        assert!(SubtreeFile::read(&bytes, 3, &schema).is_err());
        for end in 0..bytes.len() {
            assert!(SubtreeFile::read(&bytes[..end], 2, &schema).is_err());
        }
        for index in 0..bytes.len() {
            let mut changed = bytes.clone();
            changed[index] ^= 0x41;
            let _ = SubtreeFile::read(&changed, 2, &schema);
        }
    }
}
