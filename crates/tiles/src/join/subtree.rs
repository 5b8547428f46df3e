//! Subtree files of implicit tiling.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use crate::plan::TileId;

/// Tile with implicit tiling, without its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ImplicitTile {
    /// Bounding box (m) in the axes of the root.
    pub(super) bounds: [f64; 12],
    /// Geometric error (m).
    pub(super) error: f64,
    /// True if the tile has content.
    pub(super) has_content: bool,
}

/// Returns the subtree files of `tiles`, which are counted from the root, each with its place. A subtree has `levels` levels.
pub(super) fn subtrees(tiles: &BTreeMap<TileId, ImplicitTile>, levels: u32) -> Vec<(TileId, Vec<u8>)> {
    let mut found: BTreeMap<TileId, Subtree<'_>> = BTreeMap::new();
    for (id, tile) in tiles {
        let root = id.ancestor(id.level - id.level % levels);
        found.entry(root).or_default().tiles.insert(index_of(id.within(root)), tile);
        if let (true, Some(parent)) = (*id == root, root.parent()) {
            let above = parent.ancestor(parent.level - parent.level % levels);
            found.entry(above).or_default().children.push(morton(root.within(above)));
        }
    }
    found.iter().map(|(root, subtree)| (*root, subtree.file(levels))).collect()
}

/// Tiles of a subtree by their numbers.
#[derive(Default)]
struct Subtree<'a> {
    tiles: BTreeMap<usize, &'a ImplicitTile>,
    /// Numbers of the subtrees below, in their level.
    children: Vec<usize>,
}

/// Returns the number of tiles of the first `levels` levels.
fn count(levels: u32) -> usize {
    ((1 << (2 * levels)) - 1) / 3
}

/// Returns the number of a tile in its level, in Morton's order: the bits of its column and of its row alternate.
fn morton(tile: TileId) -> usize {
    (0..tile.level).fold(0, |sum, bit| {
        let of = |value: u32| (value >> bit & 1) as usize;
        sum | of(tile.x) << (2 * bit) | of(tile.y) << (2 * bit + 1)
    })
}

/// Returns the number of a tile in its subtree, level after level.
fn index_of(tile: TileId) -> usize {
    count(tile.level) + morton(tile)
}

/// Binary part of a subtree file.
#[derive(Default)]
struct SubtreeBuffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
}

impl SubtreeBuffer {
    /// Adds a buffer view, and returns its number.
    fn view(&mut self, bytes: &[u8]) -> usize {
        self.views.push(json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() }));
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(8), 0);
        self.views.len() - 1
    }

    /// Adds the availability of tiles, and returns its description.
    fn availability(&mut self, bits: &[bool]) -> Value {
        let count = bits.iter().filter(|bit| **bit).count();
        if count == 0 || count == bits.len() {
            return json!({ "constant": u8::from(count > 0) });
        }
        let byte = |bits: &[bool]| {
            bits.iter().enumerate().fold(0, |byte, (number, bit)| byte | u8::from(*bit) << number)
        };
        let bytes: Vec<u8> = bits.chunks(8).map(byte).collect();
        json!({ "bitstream": self.view(&bytes), "availableCount": count })
    }
}

impl Subtree<'_> {
    /// Returns the file.
    fn file(&self, levels: u32) -> Vec<u8> {
        let mut buffer = SubtreeBuffer::default();
        let bits = |length: usize, numbers: &mut dyn Iterator<Item = usize>| -> Vec<bool> {
            let mut bits = vec![false; length];
            numbers.for_each(|number| bits[number] = true);
            bits
        };
        let all = count(levels);
        let tile_availability = buffer.availability(&bits(all, &mut self.tiles.keys().copied()));
        let contents = self.tiles.iter().filter(|(_, tile)| tile.has_content);
        let content_availability = buffer.availability(&bits(all, &mut contents.map(|(number, _)| *number)));
        let below = 1 << (2 * levels);
        let child_availability = buffer.availability(&bits(below, &mut self.children.iter().copied()));
        let present: Vec<&ImplicitTile> = self.tiles.values().copied().collect();
        let bounds: Vec<u8> =
            present.iter().flat_map(|tile| tile.bounds).flat_map(f64::to_le_bytes).collect();
        let errors: Vec<u8> = present.iter().flat_map(|tile| tile.error.to_le_bytes()).collect();
        let (bounds, errors) = (buffer.view(&bounds), buffer.view(&errors));
        let SubtreeBuffer { bytes, views } = buffer;
        let document = json!({
            "buffers": [{ "byteLength": bytes.len() }],
            "bufferViews": views,
            "tileAvailability": tile_availability,
            "contentAvailability": [content_availability],
            "childSubtreeAvailability": child_availability,
            "propertyTables": [{
                "class": "tile",
                "count": present.len(),
                "properties": { "boundingBox": { "values": bounds }, "geometricError": { "values": errors } },
            }],
            "tileMetadata": 0,
        });
        let mut text = document.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(8), b' ');
        let mut file = b"subt".to_vec();
        file.extend(1_u32.to_le_bytes());
        file.extend((text.len() as u64).to_le_bytes());
        file.extend((bytes.len() as u64).to_le_bytes());
        file.extend(text);
        file.extend(bytes);
        file
    }
}

/// Returns the schema of the metadata of tiles.
pub(super) fn schema() -> Value {
    json!({
        "id": "tiles",
        "classes": { "tile": { "properties": {
            "boundingBox": {
                "type": "SCALAR", "componentType": "FLOAT64", "array": true, "count": 12, "required": true,
                "semantic": "TILE_BOUNDING_BOX",
            },
            "geometricError": {
                "type": "SCALAR", "componentType": "FLOAT64", "required": true, "semantic": "TILE_GEOMETRIC_ERROR",
            },
        } } },
    })
}

/// Returns the subtree files of tiles, each with a number as its error and content if the number is even.
#[cfg(test)]
pub(crate) fn numbered_subtrees(places: &[TileId], levels: u32) -> Vec<(TileId, Vec<u8>)> {
    let tile = |number: u32| {
        let error = f64::from(number);
        ImplicitTile { bounds: [error; 12], error, has_content: number.is_multiple_of(2) }
    };
    let tiles = places.iter().zip(0..).map(|(place, number)| (*place, tile(number))).collect();
    subtrees(&tiles, levels)
}

/// Returns a subtree file of two levels with three tiles, and its schema.
#[cfg(test)]
pub(crate) fn example_subtree() -> (Vec<u8>, Value) {
    let tile = ImplicitTile { bounds: [1.0; 12], error: 2.0, has_content: true };
    let places = ["0/0/0", "1/1/0", "1/1/1", "2/3/3"].map(|place| place.parse::<TileId>());
    let tiles = places.into_iter().flatten().map(|place| (place, tile)).collect();
    (subtrees(&tiles, 2).swap_remove(0).1, schema())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_follow_mortons_curve_level_after_level() {
        let number = |text: &str| index_of(text.parse().unwrap());
        let of = ["0/0/0", "1/0/0", "1/1/0", "1/0/1", "1/1/1", "2/0/0", "2/1/0", "2/0/1", "2/2/1", "2/3/3"];
        assert_eq!(of.map(number), [0, 1, 2, 3, 4, 5, 6, 7, 11, 20]);
    }

    #[test]
    fn headers_and_views_begin_at_multiples_of_eight_bytes() {
        let tile = ImplicitTile { bounds: [1.0; 12], error: 2.0, has_content: true };
        let mut tiles: BTreeMap<TileId, ImplicitTile> = BTreeMap::new();
        for place in ["0/0/0", "1/1/0", "2/2/1", "3/5/3", "3/4/3"] {
            tiles.insert(place.parse().unwrap(), tile);
        }
        let files = subtrees(&tiles, 2);
        let places: Vec<String> = files.iter().map(|(place, _)| place.to_string()).collect();
        assert_eq!(places, ["0/0/0", "2/2/1"]);
        for (_, file) in files {
            let word = |at: usize| {
                usize::try_from(u64::from_le_bytes(file[at..at + 8].try_into().unwrap())).unwrap()
            };
            let (text, binary) = (word(8), word(16));
            assert_eq!(
                (&file[..4], text % 8, binary % 8, file.len()),
                (&b"subt"[..], 0, 0, 24 + text + binary)
            );
            let document: Value = serde_json::from_slice(&file[24..24 + text]).unwrap();
            for view in document["bufferViews"].as_array().unwrap() {
                assert_eq!(view["byteOffset"].as_u64().unwrap() % 8, 0);
            }
            // Two of the five tiles of the first subtree, and three of those of the second.
            let bits = document["tileAvailability"]["bitstream"].as_u64().unwrap() as usize;
            let offset = document["bufferViews"][bits]["byteOffset"].as_u64().unwrap() as usize;
            assert!([0b00101, 0b11001].contains(&file[24 + text + offset]), "{:b}", file[24 + text + offset]);
        }
    }
}
