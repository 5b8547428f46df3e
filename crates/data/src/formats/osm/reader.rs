//! Reader of a layer in an extract: first the features selected by tags, then the ways of their relations, then the
//! positions of their nodes.

use rayon::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};
use std::borrow::Cow;

use super::blobs::{BlobFile, is_packed_extract};
use super::block::{BlockContents, OsmBlock, Visitor};
use super::choosing::{PlaceSearch, TagChoice, TagSearch, WaySearch};
use super::layers::{LAYERS, ReadyLayer};
use super::meaning::{TagValue, meanings};
use super::places::Place;
use super::shapes::{BuildResult, OsmRecord, build, known_bounds};
use super::xml::{blocks, is_xml_extract};
use crate::content::DataFile;
use crate::features::table::FeatureTable;
use crate::source_options::SourceOptions;
use burgeon_base::MemoryOwner;
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::{listed, shown};
use burgeon_kit::Attribute;
use burgeon_spatial::Crs;

/// Open OpenStreetMap extract.
pub struct OsmFile {
    blobs: BlobFile,
    name: String,
    stem: String,
}

impl OsmFile {
    /// Returns true if a file that begins with `head` is an extract, packed or in XML.
    pub(crate) fn is_one(head: &[u8]) -> bool {
        is_packed_extract(head) || is_xml_extract(head)
    }

    /// Opens an extract.
    pub(crate) fn open(file: DataFile, head: &[u8], wanted: &SourceOptions) -> Result<Self> {
        let stem = file.stem();
        if is_xml_extract(head) {
            let blobs = BlobFile::of_blocks(blocks(&file, &wanted.budget)?, &file.name);
            let stem = stem.into_owned();
            return Ok(Self { blobs, name: file.name, stem });
        }
        let stem = stem.strip_suffix(".osm").unwrap_or(&stem).to_owned();
        let (file, _, name) = file.on_disk("OpenStreetMap extract")?;
        Ok(Self { blobs: BlobFile::open(file, &name, &wanted.budget)?, name, stem })
    }

    pub(crate) fn layers(&self) -> Vec<&str> {
        LAYERS.iter().map(|layer| layer.name).collect()
    }

    pub(crate) fn read(&self, wanted: &SourceOptions) -> Result<FeatureTable> {
        let layer = match &wanted.layer {
            Some(layer) => Some(ReadyLayer::of_name(layer).ok_or_else(|| {
                let names = || LAYERS.iter().map(|layer| layer.name);
                let message = format!("{}: no layer named `{}`", self.name, shown(layer));
                let help = format!("it has {}; or select by tags: {EXAMPLE}", listed(names()));
                Error::not_found("layer", layer, names(), message).help(help)
            })?),
            None => None,
        };
        if layer.is_none() && wanted.tags.is_none() {
            let names = listed(LAYERS.iter().map(|layer| layer.name));
            let help = format!(
                "specify a layer: \"{}:buildings\"; it has {names}; or select by tags: {EXAMPLE}",
                self.name
            );
            return Err(Error::argument(format!(
                "{} is an OpenStreetMap extract, which needs a layer",
                self.name
            ))
            .help(help));
        }
        let label = match layer {
            Some(layer) => format!("{}:{}", self.name, layer.name).into(),
            None => Cow::Borrowed(self.name.as_str()),
        };
        let title = layer.map_or(&*self.stem, |layer| layer.name);
        let mut table = FeatureTable::new(title, &label, Crs::epsg(4326), wanted);
        let choice = TagChoice::new(layer, wanted);
        let records = self.records(&choice, &wanted.budget)?;
        let ways = self.member_ways(&records, &wanted.budget)?;
        let places = self.places(&records, &ways, &wanted.budget)?;
        let build = |record: &OsmRecord| build(record, &ways, &places, &wanted.budget);
        let owner = MemoryOwner::current();
        let built: Vec<BuildResult> =
            records.par_iter().map(|record| owner.charge(|| build(record))).collect();
        let records = records.into_iter().zip(built).map(|(record, built)| {
            // If a box was requested, the position of a feature that cannot be built decides whether it is reported.
            let bounds = built.as_ref().err().map(|_| known_bounds(&record, &ways, &places));
            (record, built, bounds)
        });
        self.fill(&mut table, layer, records, wanted)?;
        Ok(table)
    }

    /// Returns the selected features in file order.
    fn records(&self, choice: &TagChoice, budget: &Budget) -> Result<Vec<OsmRecord>> {
        let owner = MemoryOwner::current();
        let found = (0..self.blobs.len()).into_par_iter().map(|index| {
            let _charged = owner.enter();
            self.blobs.block(index, budget, |bytes| {
                let block = OsmBlock::open(bytes)?;
                let class = choice.words.as_ref().map(|words| block.word_numbers(words));
                let mut choosing = TagSearch { choice, budget, class, records: Vec::new() };
                block.visit(&mut choosing)?;
                Ok(choosing.records)
            })
        });
        let found: Result<Vec<Vec<OsmRecord>>> = found.collect();
        Ok(found?.into_iter().flatten().collect())
    }

    /// Returns the nodes of the ways that are members of relations.
    fn member_ways(&self, records: &[OsmRecord], budget: &Budget) -> Result<FxHashMap<i64, Vec<i64>>> {
        let wanted: FxHashSet<i64> = records.iter().flat_map(|record| record.shape.ways()).copied().collect();
        if wanted.is_empty() {
            return Ok(FxHashMap::default());
        }
        let found = self.collect(
            budget,
            |holds| holds.ways,
            || WaySearch { wanted: &wanted, found: Vec::new(), budget },
        )?;
        // Of duplicates, the first is used.
        let mut ways = FxHashMap::default();
        for (id, nodes) in found.into_iter().flat_map(|members| members.found) {
            ways.entry(id).or_insert(nodes);
        }
        Ok(ways)
    }

    /// Returns the positions of all required nodes.
    fn places(
        &self,
        records: &[OsmRecord],
        ways: &FxHashMap<i64, Vec<i64>>,
        budget: &Budget,
    ) -> Result<FxHashMap<i64, Place>> {
        let mut wanted: FxHashSet<i64> = FxHashSet::default();
        for record in records {
            let of_ways = record.shape.ways().iter().filter_map(|way| ways.get(way)).flatten();
            wanted.extend(record.shape.nodes().iter().chain(of_ways));
        }
        if wanted.is_empty() {
            return Ok(FxHashMap::default());
        }
        budget.take(wanted.len() * 80)?;
        let found = self.collect(
            budget,
            |holds| holds.nodes,
            || PlaceSearch { wanted: &wanted, found: Vec::new(), budget },
        )?;
        let mut places = FxHashMap::with_capacity_and_hasher(wanted.len(), Default::default());
        for (id, place) in found.into_iter().flat_map(|places| places.found) {
            places.entry(id).or_insert(place);
        }
        Ok(places)
    }

    /// Runs a visitor on each block that may contain what it searches for.
    fn collect<V: Visitor + Send>(
        &self,
        budget: &Budget,
        holds: impl Fn(BlockContents) -> bool + Sync,
        visitor: impl Fn() -> V + Sync,
    ) -> Result<Vec<V>> {
        let visit = |index| {
            self.blobs.block(index, budget, |bytes| {
                let (block, mut visitor) = (OsmBlock::open(bytes)?, visitor());
                if holds(block.holds()?) {
                    block.visit(&mut visitor)?;
                }
                Ok(visitor)
            })
        };
        let owner = MemoryOwner::current();
        (0..self.blobs.len()).into_par_iter().map(|index| owner.charge(|| visit(index))).collect()
    }

    /// Adds the built features to the table, with attributes derived from their tags.
    fn fill(
        &self,
        table: &mut FeatureTable,
        layer: Option<&ReadyLayer>,
        records: impl Iterator<Item = (OsmRecord, BuildResult, Option<[f64; 4]>)>,
        wanted: &SourceOptions,
    ) -> Result<()> {
        let mut cut = 0;
        let mut unread: Option<(usize, String)> = None;
        for (record, built, bounds) in records {
            let id = record.name();
            let (parts, lacks) = match built {
                Ok(built) => built,
                Err(why) => {
                    // The error may be an exceeded time limit instead of an invalid feature.
                    wanted.budget.check()?;
                    let error = Error::data(format!("{id} of {} {why}", table.shown));
                    table.refuse_at(
                        id,
                        error.help("download a larger extract, or fix it in OpenStreetMap"),
                        bounds,
                    )?;
                    continue;
                }
            };
            let mut odd: Vec<String> = Vec::new();
            let attributes = self.attributes(table, layer, &record, |key, value| {
                odd.push(format!("{key} = \"{}\" of {id}", shown(value)));
            });
            let before = table.features.len();
            table.push(&id, parts, attributes)?;
            // Features that were not requested are not reported.
            if table.features.len() == before {
                continue;
            }
            cut += usize::from(lacks);
            let count = odd.len();
            if let Some(first) = odd.into_iter().next() {
                unread.get_or_insert((0, first)).0 += count;
            }
        }
        let FeatureTable { shown, notes, .. } = table;
        if cut > 0 {
            let lines = if cut == 1 { "line ends" } else { "lines end" };
            notes.push(format!("{shown}: {cut} {lines} at the boundary of the extract"));
        }
        if let Some((count, first)) = unread {
            let values =
                if count == 1 { "tag is not a number and was" } else { "tags are not numbers and were" };
            notes.push(format!("{shown}: {count} {values} skipped, e.g. {first}"));
        }
        Ok(())
    }

    fn attributes(
        &self,
        table: &mut FeatureTable,
        layer: Option<&ReadyLayer>,
        record: &OsmRecord,
        mut unread: impl FnMut(&str, &str),
    ) -> Vec<(usize, Attribute)> {
        let value = |key: &str| {
            let found = record.tags.iter().find(|(known, _)| known == key);
            found.map(|(_, value)| value.as_str())
        };
        let mut plain: Vec<(&str, Option<Attribute>)> = meanings(value)
            .map(|(name, told)| match told {
                TagValue::Number(number) => (name, Some(Attribute::Number(number))),
                TagValue::Text(text) => (name, Some(table.text(text))),
                TagValue::Unread(text) => {
                    unread(name, text);
                    (name, None)
                }
            })
            .collect();
        if let Some(layer) = layer {
            let kind = layer.key(record.alternative).and_then(value);
            plain.extend(kind.map(|kind| ("kind", Some(table.text(kind)))));
            if layer.name.starts_with("building") {
                let part = value("building:part").is_some_and(|part| part != "no");
                plain.push(("part", Some(Attribute::Boolean(part))));
            }
        }
        let mut attributes = Vec::with_capacity(record.tags.len() + plain.len());
        for (key, value) in &record.tags {
            if !plain.iter().any(|(name, _)| name == key) {
                let text = table.text(value);
                attributes.push((table.name(key), text));
            }
        }
        for (name, value) in plain {
            attributes.extend(value.map(|value| (table.name(name), value)));
        }
        attributes
    }
}

/// Example of selecting a layer by tags.
const EXAMPLE: &str = "source(\"town.osm.pbf\", { tags = { building = true } })";
