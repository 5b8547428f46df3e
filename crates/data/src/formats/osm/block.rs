//! Block of an extract: its strings, and groups of nodes, ways and relations.

use rustc_hash::FxHashMap;

use super::places::Place;
use super::wire::{Deltas, Varints, WireDamage, WireFields, to_signed};

/// Indices of a key and of a value among the strings of a block.
pub(super) type TagNumbers = (usize, usize);

/// Open block.
pub(super) struct OsmBlock<'a> {
    strings: Vec<&'a [u8]>,
    groups: Vec<&'a [u8]>,
    granularity: i64,
    offset: [i64; 2],
}

/// Result of a visit.
pub(super) type VisitResult<T> = Result<T, WireDamage>;

/// Visitor of the elements of a block.
pub(super) trait Visitor {
    /// Reports which tags of nodes are read; `None` skips all nodes.
    fn wants_nodes(&self) -> Option<WantedTags> {
        None
    }

    /// Visits a node.
    fn node(&mut self, _: &OsmBlock<'_>, _id: i64, _: Place, _: &[TagNumbers]) -> VisitResult<()> {
        Ok(())
    }

    /// Visits a way with its nodes.
    fn way(&mut self, _: &OsmBlock<'_>, _id: i64, _: &[TagNumbers], _nodes: Deltas<'_>) -> VisitResult<()> {
        Ok(())
    }

    /// Visits a relation with the ids and the types of its members.
    fn relation(
        &mut self,
        _: &OsmBlock<'_>,
        _id: i64,
        _: &[TagNumbers],
        _members: (Deltas<'_>, Varints<'_>),
    ) -> VisitResult<()> {
        Ok(())
    }
}

/// Selection of the tags of nodes.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum WantedTags {
    /// All tags.
    All,
    /// Positions without tags.
    None,
}

impl<'a> OsmBlock<'a> {
    /// Opens a block.
    pub(super) fn open(bytes: &'a [u8]) -> Result<Self, WireDamage> {
        let mut block = Self { strings: Vec::new(), groups: Vec::new(), granularity: 100, offset: [0; 2] };
        for field in WireFields(bytes) {
            match field? {
                (1, field) => {
                    for text in WireFields(field.bytes()?) {
                        block.strings.push(text?.1.bytes()?);
                    }
                }
                (2, field) => block.groups.push(field.bytes()?),
                (17, field) => block.granularity = field.number()?.cast_signed(),
                (19, field) => block.offset[1] = field.number()?.cast_signed(),
                (20, field) => block.offset[0] = field.number()?.cast_signed(),
                _ => {}
            }
        }
        Ok(block)
    }

    /// Returns the string with an index.
    pub(super) fn string(&self, number: usize) -> Result<&'a [u8], WireDamage> {
        self.strings.get(number).copied().ok_or("refers to a missing string")
    }

    /// Returns for each string its index in `words` plus 1; 0 if it is not in `words`.
    pub(super) fn word_numbers(&self, words: &FxHashMap<Vec<u8>, usize>) -> Vec<usize> {
        self.strings.iter().map(|text| words.get(*text).map_or(0, |number| number + 1)).collect()
    }

    /// Passes all elements to `visitor`.
    pub(super) fn visit(&self, visitor: &mut impl Visitor) -> Result<(), WireDamage> {
        let mut tags = Vec::new();
        for group in &self.groups {
            for field in WireFields(group) {
                match field? {
                    (1, field) => self.node(field.bytes()?, visitor, &mut tags)?,
                    (2, field) => self.dense(field.bytes()?, visitor, &mut tags)?,
                    (3, field) => self.way(field.bytes()?, visitor, &mut tags)?,
                    (4, field) => self.relation(field.bytes()?, visitor, &mut tags)?,
                    _ => {}
                }
            }
        }
        Ok(())
    }

    /// Returns the types of elements in the block.
    pub(super) fn holds(&self) -> Result<BlockContents, WireDamage> {
        let mut holds = BlockContents::default();
        for group in &self.groups {
            // A group contains elements of one type.
            if let Some(field) = WireFields(group).next() {
                let (number, _) = field?;
                holds.nodes |= matches!(number, 1 | 2);
                holds.ways |= number == 3;
            }
        }
        Ok(holds)
    }

    fn place(&self, [east, north]: [i64; 2]) -> Place {
        let nano = |offset: i64, count: i64| offset.wrapping_add(self.granularity.wrapping_mul(count));
        Place([nano(self.offset[0], east), nano(self.offset[1], north)])
    }

    fn node(
        &self,
        bytes: &[u8],
        visitor: &mut impl Visitor,
        tags: &mut Vec<TagNumbers>,
    ) -> Result<(), WireDamage> {
        let Some(wanted) = visitor.wants_nodes() else { return Ok(()) };
        let (mut id, mut place, mut lists) = (0, [0; 2], TagLists::default());
        for field in WireFields(bytes) {
            match field? {
                (1, field) => id = to_signed(field.number()?),
                (8, field) => place[1] = to_signed(field.number()?),
                (9, field) => place[0] = to_signed(field.number()?),
                (number, field) => lists.take(number, field)?,
            }
        }
        if wanted == WantedTags::All {
            lists.read(tags)?;
        }
        visitor.node(self, id, self.place(place), tags)
    }

    fn dense(
        &self,
        bytes: &[u8],
        visitor: &mut impl Visitor,
        tags: &mut Vec<TagNumbers>,
    ) -> Result<(), WireDamage> {
        let Some(wanted) = visitor.wants_nodes() else { return Ok(()) };
        let (mut ids, mut north, mut east) = (Deltas::default(), Deltas::default(), Deltas::default());
        let mut known = Varints::default();
        for field in WireFields(bytes) {
            match field? {
                (1, field) => ids = Deltas::new(field.bytes()?),
                (8, field) => north = Deltas::new(field.bytes()?),
                (9, field) => east = Deltas::new(field.bytes()?),
                (10, field) => known = Varints(field.bytes()?),
                _ => {}
            }
        }
        tags.clear();
        while let Some(id) = ids.next()? {
            let (Some(north), Some(east)) = (north.next()?, east.next()?) else {
                return Err("has fewer positions than nodes");
            };
            if wanted == WantedTags::All {
                tags.clear();
                // The tags of each node end with a zero.
                while let Some(key) = known.next()?.filter(|key| *key != 0) {
                    let value = known.next()?.ok_or("has a key without a value")?;
                    tags.push((key as usize, value as usize));
                }
            }
            visitor.node(self, id, self.place([east, north]), tags)?;
        }
        Ok(())
    }

    fn way(
        &self,
        bytes: &[u8],
        visitor: &mut impl Visitor,
        tags: &mut Vec<TagNumbers>,
    ) -> Result<(), WireDamage> {
        let (mut id, mut nodes, mut lists) = (0, Deltas::default(), TagLists::default());
        for field in WireFields(bytes) {
            match field? {
                (1, field) => id = field.number()?.cast_signed(),
                (8, field) => nodes = Deltas::new(field.bytes()?),
                (number, field) => lists.take(number, field)?,
            }
        }
        lists.read(tags)?;
        visitor.way(self, id, tags, nodes)
    }

    fn relation(
        &self,
        bytes: &[u8],
        visitor: &mut impl Visitor,
        tags: &mut Vec<TagNumbers>,
    ) -> Result<(), WireDamage> {
        let (mut id, mut lists) = (0, TagLists::default());
        let (mut members, mut types) = (Deltas::default(), Varints::default());
        for field in WireFields(bytes) {
            match field? {
                (1, field) => id = field.number()?.cast_signed(),
                (9, field) => members = Deltas::new(field.bytes()?),
                (10, field) => types = Varints(field.bytes()?),
                (number, field) => lists.take(number, field)?,
            }
        }
        lists.read(tags)?;
        visitor.relation(self, id, tags, (members, types))
    }
}

/// Types of elements in a block.
#[derive(Clone, Copy, Default)]
pub(super) struct BlockContents {
    pub(super) nodes: bool,
    pub(super) ways: bool,
}

/// Lists of keys and values of a node, a way or a relation.
#[derive(Default)]
struct TagLists<'a> {
    keys: Varints<'a>,
    values: Varints<'a>,
}

impl<'a> TagLists<'a> {
    fn take(&mut self, number: u64, field: super::wire::WireField<'a>) -> Result<(), WireDamage> {
        match number {
            2 => self.keys = Varints(field.bytes()?),
            3 => self.values = Varints(field.bytes()?),
            _ => {}
        }
        Ok(())
    }

    fn read(mut self, tags: &mut Vec<TagNumbers>) -> Result<(), WireDamage> {
        tags.clear();
        while let Some(key) = self.keys.next()? {
            let value = self.values.next()?.ok_or("has a key without a value")?;
            tags.push((key as usize, value as usize));
        }
        Ok(())
    }
}
