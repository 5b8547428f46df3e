//! Searches through the blocks of an extract: for features selected by tags, for ways, and for the positions of nodes.

use rustc_hash::{FxHashMap, FxHashSet};

use super::block::{OsmBlock, TagNumbers, VisitResult, Visitor, WantedTags};
use super::layers::{ReadyLayer, is_area};
use super::places::Place;
use super::shapes::{OsmRecord, OsmShape};
use super::wire::{Deltas, Varints};
use crate::source_options::SourceOptions;
use crate::tags::TagFilter;
use burgeon_base::budget::Budget;
use burgeon_spatial::GeometryKind;

/// Selection of features in an extract.
pub(super) struct TagChoice {
    /// Tag filters; all must match.
    filters: Vec<TagFilter>,
    /// Keys of which a feature must have one; `None` if there is no such requirement.
    pub(super) words: Option<FxHashMap<Vec<u8>, usize>>,
    /// Type of geometry; any if `None`.
    kind: Option<GeometryKind>,
    /// Set if tags decide whether a closed way is an area.
    by_tags: bool,
}

impl TagChoice {
    pub(super) fn new(layer: Option<&ReadyLayer>, wanted: &SourceOptions) -> Self {
        let filters: Vec<TagFilter> =
            layer.map(ReadyLayer::filter).into_iter().chain(wanted.tags.clone()).collect();
        let words = filters.iter().find_map(TagFilter::needed_keys).map(|keys| {
            keys.into_iter().enumerate().map(|(number, key)| (key.as_bytes().to_vec(), number)).collect()
        });
        let kind = layer.map_or(wanted.kind, |layer| Some(layer.kind));
        Self { filters, words, kind, by_tags: layer.is_some() || kind.is_none() }
    }

    fn wants(&self, kind: GeometryKind) -> bool {
        self.kind.is_none_or(|wanted| wanted == kind)
    }
}

/// Search for selected features.
pub(super) struct TagSearch<'c> {
    pub(super) choice: &'c TagChoice,
    pub(super) budget: &'c Budget,
    /// For each string of the block, a number above 0 if it is one of the required keys.
    pub(super) class: Option<Vec<usize>>,
    pub(super) records: Vec<OsmRecord>,
}

/// Fails if the reading must end.
fn told_to_go_on(budget: &Budget) -> VisitResult<()> {
    budget.tick().map_err(|_| "takes too much")
}

/// Returns the value of a key among tags.
fn value_of<'b>(block: &OsmBlock<'b>, tags: &[TagNumbers], key: &str) -> Option<&'b [u8]> {
    let found = tags.iter().find(|(number, _)| block.string(*number) == Ok(key.as_bytes()));
    found.and_then(|(_, value)| block.string(*value).ok())
}

impl TagSearch<'_> {
    /// Returns the matching alternative, if the tags are selected.
    fn alternative(&self, block: &OsmBlock<'_>, tags: &[TagNumbers]) -> VisitResult<Option<usize>> {
        told_to_go_on(self.budget)?;
        if let Some(class) = &self.class
            && !tags.iter().any(|(key, _)| class.get(*key).is_some_and(|class| *class > 0))
        {
            return Ok(None);
        }
        let value = |key: &str| value_of(block, tags, key);
        let mut alternative = None;
        for filter in &self.choice.filters {
            let Some(found) = filter.alternative(value) else { return Ok(None) };
            alternative.get_or_insert(found);
        }
        Ok(alternative)
    }

    fn take(
        &mut self,
        block: &OsmBlock<'_>,
        (id, tags, alternative): (i64, &[TagNumbers], usize),
        shape: OsmShape,
    ) -> VisitResult<()> {
        let mut taken = Vec::with_capacity(tags.len());
        let mut weight = 100 + 8 * (shape.nodes().len() + shape.ways().len());
        for (key, value) in tags {
            let [key, value] = [block.string(*key)?, block.string(*value)?];
            weight += 80 + key.len() + value.len();
            let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
            taken.push((text(key), text(value)));
        }
        self.budget.take(weight).map_err(|_| "takes too much")?;
        self.records.push(OsmRecord { id, shape, tags: taken, alternative });
        Ok(())
    }
}

impl Visitor for TagSearch<'_> {
    fn wants_nodes(&self) -> Option<WantedTags> {
        self.choice.wants(GeometryKind::Point).then_some(WantedTags::All)
    }

    fn node(&mut self, block: &OsmBlock<'_>, id: i64, place: Place, tags: &[TagNumbers]) -> VisitResult<()> {
        // Most nodes have no tags and only define positions of ways.
        if tags.is_empty() {
            return told_to_go_on(self.budget);
        }
        match self.alternative(block, tags)? {
            Some(alternative) => self.take(block, (id, tags, alternative), OsmShape::Point(place)),
            None => Ok(()),
        }
    }

    fn way(
        &mut self,
        block: &OsmBlock<'_>,
        id: i64,
        tags: &[TagNumbers],
        nodes: Deltas<'_>,
    ) -> VisitResult<()> {
        let (lines, areas) =
            (self.choice.wants(GeometryKind::Line), self.choice.wants(GeometryKind::Polygon));
        if !(lines || areas) {
            return Ok(());
        }
        let Some(alternative) = self.alternative(block, tags)? else { return Ok(()) };
        let nodes = all(nodes)?;
        let closed = nodes.len() > 3 && nodes.first() == nodes.last();
        let is_area = closed
            && areas
            && match self.choice.by_tags {
                true => is_area(|key| value_of(block, tags, key)),
                false => value_of(block, tags, "area") != Some(b"no"),
            };
        match (is_area, lines) {
            (true, _) => self.take(block, (id, tags, alternative), OsmShape::Area(nodes)),
            (false, true) => self.take(block, (id, tags, alternative), OsmShape::Line(nodes)),
            (false, false) => Ok(()),
        }
    }

    fn relation(
        &mut self,
        block: &OsmBlock<'_>,
        id: i64,
        tags: &[TagNumbers],
        (mut members, mut types): (Deltas<'_>, Varints<'_>),
    ) -> VisitResult<()> {
        let kind = value_of(block, tags, "type");
        if !self.choice.wants(GeometryKind::Polygon) || !matches!(kind, Some(b"multipolygon" | b"boundary")) {
            return Ok(());
        }
        let Some(alternative) = self.alternative(block, tags)? else { return Ok(()) };
        let mut ways = Vec::new();
        while let Some(member) = members.next()? {
            // Nodes and relations among the members are labels and the like.
            if types.next()?.ok_or("has a member without a type")? == 1 {
                ways.push(member);
            }
        }
        self.take(block, (id, tags, alternative), OsmShape::Ways(ways))
    }
}

/// Collects the decoded numbers.
fn all(mut deltas: Deltas<'_>) -> VisitResult<Vec<i64>> {
    let mut numbers = Vec::new();
    while let Some(number) = deltas.next()? {
        numbers.push(number);
    }
    Ok(numbers)
}

/// Search for ways by id.
pub(super) struct WaySearch<'w> {
    pub(super) wanted: &'w FxHashSet<i64>,
    pub(super) found: Vec<(i64, Vec<i64>)>,
    pub(super) budget: &'w Budget,
}

impl Visitor for WaySearch<'_> {
    fn way(&mut self, _: &OsmBlock<'_>, id: i64, _: &[TagNumbers], nodes: Deltas<'_>) -> VisitResult<()> {
        told_to_go_on(self.budget)?;
        if self.wanted.contains(&id) {
            let nodes = all(nodes)?;
            self.budget.take(100 + nodes.len() * 8).map_err(|_| "takes too much")?;
            self.found.push((id, nodes));
        }
        Ok(())
    }
}

/// Search for the positions of nodes by id.
pub(super) struct PlaceSearch<'w> {
    pub(super) wanted: &'w FxHashSet<i64>,
    pub(super) found: Vec<(i64, Place)>,
    pub(super) budget: &'w Budget,
}

impl Visitor for PlaceSearch<'_> {
    fn wants_nodes(&self) -> Option<WantedTags> {
        Some(WantedTags::None)
    }

    fn node(&mut self, _: &OsmBlock<'_>, id: i64, place: Place, _: &[TagNumbers]) -> VisitResult<()> {
        told_to_go_on(self.budget)?;
        if self.wanted.contains(&id) {
            self.found.push((id, place));
        }
        Ok(())
    }
}
