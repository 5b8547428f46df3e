//! Extracts that are made for tests, down to their bytes.

use super::read;
use crate::{FeatureTable, SourceOptions};
use burgeon_base::error::Result;

pub(super) fn varint(bytes: &mut Vec<u8>, mut number: u64) {
    while number > 127 {
        bytes.push((number & 127) as u8 | 128);
        number >>= 7;
    }
    bytes.push(number as u8);
}

pub(super) fn number(key: u64, number: u64) -> Vec<u8> {
    let mut bytes = Vec::new();
    varint(&mut bytes, key << 3);
    varint(&mut bytes, number);
    bytes
}

pub(super) fn message(key: u64, content: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    varint(&mut bytes, key << 3 | 2);
    varint(&mut bytes, content.len() as u64);
    [&bytes, content].concat()
}

pub(super) fn zigzag(number: i64) -> u64 {
    (number << 1 ^ number >> 63) as u64
}

pub(super) fn numbers(key: u64, numbers: impl IntoIterator<Item = u64>) -> Vec<u8> {
    let mut bytes = Vec::new();
    numbers.into_iter().for_each(|number| varint(&mut bytes, number));
    message(key, &bytes)
}

pub(super) fn deltas(key: u64, all: &[i64]) -> Vec<u8> {
    let mut last = 0;
    numbers(key, all.iter().map(|number| zigzag(number.wrapping_sub(std::mem::replace(&mut last, *number)))))
}

pub(super) fn blob(kind: &str, content: Vec<u8>) -> Vec<u8> {
    let head = [message(1, kind.as_bytes()), number(3, content.len() as u64)].concat();
    [&(head.len() as u32).to_be_bytes()[..], &head, &content].concat()
}

pub(super) fn deflated(bytes: &[u8], claimed: usize) -> Vec<u8> {
    let mut packed = Vec::with_capacity(bytes.len() + 1000);
    let mut stream = flate2::Compress::new(flate2::Compression::default(), true);
    stream.compress_vec(bytes, &mut packed, flate2::FlushCompress::Finish).unwrap();
    [number(2, claimed as u64), message(3, &packed)].concat()
}

pub(super) type TagSlice<'a> = &'a [(&'a str, &'a str)];

/// A file as it is made: its texts, and what goes into its groups.
#[derive(Default)]
pub(super) struct Extract {
    texts: Vec<String>,
    pub(super) groups: Vec<Vec<u8>>,
}

impl Extract {
    pub(super) fn text(&mut self, text: &str) -> u64 {
        let found = self.texts.iter().position(|known| known == text);
        let at = found.unwrap_or_else(|| {
            self.texts.push(text.to_owned());
            self.texts.len() - 1
        });
        at as u64 + 1
    }

    pub(super) fn tags(&mut self, tags: TagSlice<'_>) -> Vec<u8> {
        let keys: Vec<u64> = tags.iter().map(|tag| self.text(tag.0)).collect();
        let values: Vec<u64> = tags.iter().map(|tag| self.text(tag.1)).collect();
        [numbers(2, keys), numbers(3, values)].concat()
    }

    /// Nodes with ids and places (ten-millionths of a degree) in one dense group; the last has tags.
    pub(super) fn nodes(mut self, nodes: &[(i64, i64, i64)], tags: TagSlice<'_>) -> Self {
        let list = |get: fn(&(i64, i64, i64)) -> i64| nodes.iter().map(get).collect::<Vec<_>>();
        let mut known: Vec<u64> = vec![0; nodes.len() - 1];
        for (key, value) in tags {
            known.extend([self.text(key), self.text(value)]);
        }
        known.push(0);
        let dense = [
            deltas(1, &list(|node| node.0)),
            deltas(8, &list(|node| node.2)),
            deltas(9, &list(|node| node.1)),
            numbers(10, known),
        ];
        self.groups.push(message(2, &dense.concat()));
        self
    }

    pub(super) fn way(mut self, id: i64, nodes: &[i64], tags: TagSlice<'_>) -> Self {
        let way = [number(1, id as u64), self.tags(tags), deltas(8, nodes)].concat();
        self.groups.push(message(3, &way));
        self
    }

    pub(super) fn relation(mut self, id: i64, members: &[(u64, i64)], tags: TagSlice<'_>) -> Self {
        let ids: Vec<i64> = members.iter().map(|member| member.1).collect();
        let types = numbers(10, members.iter().map(|member| member.0));
        let roles = numbers(8, members.iter().map(|_| 0));
        let relation = [number(1, id as u64), self.tags(tags), roles, deltas(9, &ids), types].concat();
        self.groups.push(message(4, &relation));
        self
    }

    pub(super) fn block(&self) -> Vec<u8> {
        let texts: Vec<u8> = std::iter::once("")
            .chain(self.texts.iter().map(String::as_str))
            .flat_map(|text| message(1, text.as_bytes()))
            .collect();
        let groups: Vec<u8> = self.groups.iter().flat_map(|group| message(2, group)).collect();
        [message(1, &texts), groups].concat()
    }

    pub(super) fn bytes(&self) -> Vec<u8> {
        let block = self.block();
        [header(&[]), blob("OSMData", deflated(&block, block.len()))].concat()
    }

    pub(super) fn read(&self, wanted: SourceOptions) -> Result<FeatureTable> {
        read(&self.bytes(), wanted)
    }
}

pub(super) fn header(needed: &[&str]) -> Vec<u8> {
    let all = ["OsmSchema-V0.6", "DenseNodes"].iter().chain(needed);
    let content: Vec<u8> = all.flat_map(|needed| message(4, needed.as_bytes())).collect();
    blob("OSMHeader", message(1, &content))
}
