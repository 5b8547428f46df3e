//! Content of a layer, as stored in its file.

use std::sync::Arc;

use rayon::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};

use super::attribute_pool::AttributePool;
use super::derived_id::derived_id;
use super::feature::Feature;
use super::selection::FeatureSelection;
use super::taken_ids::TakenIds;
use crate::source_options::SourceOptions;
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::{listed, shown};
use burgeon_kit::Attribute;
use burgeon_spatial::Crs;
use burgeon_spatial::{Geometry, GeometryKind};

/// Layer as stored in its file.
#[derive(Debug)]
pub struct FeatureTable {
    /// Name of the layer.
    pub layer: String,
    /// File and layer, for messages.
    pub shown: String,
    /// Coordinate system, or the reason why it is unknown.
    pub crs: Result<Crs>,
    /// Attribute names, in file order.
    pub names: Vec<String>,
    /// Features in file order, one for each part of a geometry.
    pub features: Vec<Feature>,
    /// Number of records; less than the number of features if records have several parts.
    pub records: usize,
    /// Number of skipped features without a geometry, or with one without extent.
    pub empty: usize,
    /// Number of these features that have points, but too few distinct ones.
    pub(crate) collapsed: usize,
    /// Ids of the first features without a geometry.
    pub empty_ids: Vec<String>,
    /// Ids of the first records whose id another record of the table has already.
    pub repeated_ids: Vec<String>,
    /// Key of the last record that was read; `None` if the records have no keys.
    pub(crate) last_key: Option<i64>,
    /// Ids of skipped features whose geometry cannot be read, with the reasons.
    pub refused: Vec<(String, Error)>,
    /// Other messages about reading the layer.
    pub notes: Vec<String>,
    /// Number of features without an id, which received an id derived from their content.
    pub derived: usize,
    /// For each attribute, the number of features without a geometry that have it.
    pub(crate) unplaced: Vec<usize>,
    selection: FeatureSelection,
    ids: TakenIds,
    /// Indices of the attribute names.
    numbers: FxHashMap<String, usize>,
    /// Recent short texts, which many features share.
    texts: FxHashSet<Arc<str>>,
    pool: AttributePool,
    /// Indices of the features that are further parts of the preceding record, in order.
    further: Vec<usize>,
    /// Limits on the resources for examining the features.
    pub(crate) budget: Arc<Budget>,
}

/// Returns the approximate memory (bytes) that a geometry uses in addition to the value itself.
fn weight(geometry: &Geometry) -> usize {
    geometry.lists().iter().map(|list| if list.len() > 1 { 48 + 24 * list.len() } else { 0 }).sum()
}

/// Maximum number of remembered ids, of features without a geometry and of repeated ids.
const REMEMBERED_IDS: usize = 1000;

/// Maximum number of remembered texts, and maximum length of such a text (bytes).
const TEXTS: usize = 4096;
const LONGEST_TEXT: usize = 40;

impl FeatureTable {
    /// Creates an empty table of a layer, which keeps the features that `wanted` selects.
    pub(crate) fn new(layer: &str, shown: &str, crs: Result<Crs>, wanted: &SourceOptions) -> Self {
        let SourceOptions { kind, within, limit, .. } = *wanted;
        Self {
            layer: layer.to_owned(),
            shown: shown.to_owned(),
            crs,
            names: Vec::new(),
            features: Vec::new(),
            records: 0,
            empty: 0,
            collapsed: 0,
            empty_ids: Vec::new(),
            repeated_ids: Vec::new(),
            last_key: None,
            refused: Vec::new(),
            notes: Vec::new(),
            derived: 0,
            unplaced: Vec::new(),
            selection: FeatureSelection { kind, within, limit, seen: [false; 3] },
            ids: TakenIds::new(),
            numbers: FxHashMap::default(),
            texts: FxHashSet::default(),
            pool: AttributePool::new(),
            further: Vec::new(),
            budget: Arc::clone(&wanted.budget),
        }
    }

    /// Creates a layer with attributes called `names`, whose features are [pushed](Self::push) by another reader;
    /// `shown` is its name in messages.
    pub fn of_layer(
        layer: &str,
        shown: &str,
        crs: Result<Crs>,
        names: Vec<String>,
        wanted: &SourceOptions,
    ) -> Self {
        Self { names, ..Self::new(layer, shown, crs, wanted) }
    }

    /// Returns the index of the attribute called `name`; adds it if it is new.
    pub(crate) fn name(&mut self, name: &str) -> usize {
        match self.numbers.get(name) {
            Some(number) => *number,
            None => {
                let number = self.names.len();
                self.names.push(name.to_owned());
                self.numbers.insert(name.to_owned(), number);
                number
            }
        }
    }

    /// Returns a text as an attribute; features share frequent texts.
    pub(crate) fn text(&mut self, text: &str) -> Attribute {
        if text.len() > LONGEST_TEXT {
            return Attribute::Text(text.into());
        }
        if let Some(known) = self.texts.get(text) {
            return Attribute::Text(Arc::clone(known));
        }
        if self.texts.len() >= TEXTS {
            self.texts.clear();
        }
        let text: Arc<str> = text.into();
        self.texts.insert(Arc::clone(&text));
        Attribute::Text(text)
    }

    /// Returns true if the requested number of features has been reached.
    pub(crate) fn is_full(&self) -> bool {
        self.selection.limit.is_some_and(|limit| self.features.len() >= limit)
    }

    /// Returns true if there was a geometry, kept or not.
    pub(crate) fn has_seen(&self) -> bool {
        self.selection.seen.contains(&true)
    }

    /// Adds a feature for each selected part; if the id is taken, the feature gets `id.2`, `id.3` and so on.
    ///
    /// Fails if reading must end, or if the memory budget is exceeded.
    pub fn push(
        &mut self,
        id: &str,
        parts: Vec<Geometry>,
        attributes: Vec<(usize, Attribute)>,
    ) -> Result<()> {
        self.budget.tick()?;
        if parts.is_empty() {
            self.add_empty_record(id, &attributes, None);
            return Ok(());
        }
        let several = parts.len() > 1;
        let keeps: Vec<bool> = parts.iter().map(|part| self.selection.keeps(part)).collect();
        if self.is_full() || !keeps.contains(&true) {
            return Ok(());
        }
        let (attributes, is_new) = self.pool.intern(attributes);
        let own = if is_new { &*attributes } else { &[] };
        let known: usize = own.iter().map(|(_, value)| 32 + value.weight()).sum();
        let points: usize = parts.iter().map(weight).sum();
        self.budget.take(40 + known + points + parts.len() * (size_of::<Feature>() + 16))?;
        self.records += 1;
        let first = self.features.len();
        for (mut geometry, keeps) in parts.into_iter().zip(keeps) {
            if !keeps {
                if several {
                    self.ids.skip(id, &self.features);
                }
                continue;
            }
            if self.is_full() {
                break;
            }
            let fresh = self.ids.fresh(id, &self.features);
            if self.features.len() == first && fresh != *id && self.repeated_ids.len() < REMEMBERED_IDS {
                self.repeated_ids.push(id.to_owned());
            }
            let id = fresh;
            self.budget.take(id.weight())?;
            geometry.compact();
            if self.features.len() > first {
                self.further.push(self.features.len());
            }
            self.features.push(Feature { id, geometry, attributes: Arc::clone(&attributes) });
        }
        Ok(())
    }

    /// Adds features without an id, like [`push`](Self::push). The id is a hash of the geometry and the attributes, so
    /// it does not change when other features are added, removed or reordered. Identical features are numbered.
    pub(crate) fn push_unnamed(
        &mut self,
        parts: Vec<Geometry>,
        attributes: Vec<(usize, Attribute)>,
    ) -> Result<()> {
        let id = derived_id(&parts, &attributes, &self.names);
        let before = self.features.len();
        self.push(&id, parts, attributes)?;
        self.derived += usize::from(self.features.len() > before);
        Ok(())
    }

    /// Adds features with the value of the attribute `column` as the id; features without that attribute get a derived
    /// id.
    #[cfg(feature = "data")]
    pub(crate) fn push_identified(
        &mut self,
        column: Option<usize>,
        parts: Vec<Geometry>,
        attributes: Vec<(usize, Attribute)>,
    ) -> Result<()> {
        let own = attributes.iter().find(|(number, _)| Some(*number) == column);
        match own.map(|(_, value)| value.text()).filter(|id| !id.is_empty()) {
            Some(id) => self.push(&id, parts, attributes),
            None => self.push_unnamed(parts, attributes),
        }
    }

    /// Counts a feature without a geometry, and remembers its id, like [`add_empty`](Self::add_empty).
    pub(crate) fn add_empty_record(
        &mut self,
        id: &str,
        attributes: &[(usize, Attribute)],
        bounds: Option<[f64; 4]>,
    ) {
        let before = self.empty;
        self.add_empty(attributes, bounds);
        if self.empty > before && self.empty_ids.len() < REMEMBERED_IDS {
            self.empty_ids.push(id.to_owned());
        }
    }

    /// Counts a feature without a geometry. If it has points, but too few for a geometry, they are within `bounds`.
    ///
    /// If a box was requested, features outside the box or without a position are not counted.
    pub(crate) fn add_empty(&mut self, attributes: &[(usize, Attribute)], bounds: Option<[f64; 4]>) {
        if self.selection.within.is_some() && !bounds.is_some_and(|bounds| self.concerns(Some(bounds))) {
            return;
        }
        self.empty += 1;
        self.collapsed += usize::from(bounds.is_some());
        for (number, _) in attributes {
            if self.unplaced.len() <= *number {
                self.unplaced.resize(*number + 1, 0);
            }
            self.unplaced[*number] += 1;
        }
    }

    /// Returns true if a feature with these bounds may touch the requested box, if any; also if the bounds are unknown.
    pub(crate) fn concerns(&self, bounds: Option<[f64; 4]>) -> bool {
        self.selection.may_touch(bounds)
    }

    /// Skips a feature like [`refuse`](Self::refuse), unless its bounds are outside the requested box.
    pub(crate) fn refuse_at(&mut self, id: String, error: Error, bounds: Option<[f64; 4]>) -> Result<()> {
        if self.concerns(bounds) { self.refuse(id, error) } else { self.budget.tick() }
    }

    /// Keeps the features with these indices, which must be sorted, and at most `limit` of them.
    pub(crate) fn keep(&mut self, kept: &[usize], limit: Option<usize>) {
        let mut kept = kept.iter().take(limit.unwrap_or(usize::MAX)).copied().peekable();
        let mut further = self.further.iter().copied().peekable();
        // Index of the first feature of the record, for each kept feature.
        let mut firsts = Vec::new();
        let (mut number, mut first) = (0, 0);
        self.features.retain(|_| {
            if further.next_if_eq(&number).is_none() {
                first = number;
            }
            let keeps = kept.next_if_eq(&number).is_some();
            if keeps {
                firsts.push(first);
            }
            number += 1;
            keeps
        });
        self.further = (1..firsts.len()).filter(|number| firsts[*number] == firsts[number - 1]).collect();
        self.records = firsts.len() - self.further.len();
    }

    /// Returns the table after applying the options: the coordinate system, the geometry type and the number of
    /// features. Fails if no features remain, unless the options choose records.
    pub fn finish(mut self, wanted: &SourceOptions) -> Result<Self> {
        if let Some(code) = wanted.crs {
            self.crs = Crs::epsg(code);
        }
        self.derived = self.derived.min(self.features.len());
        // The pool would keep attributes that a condition has removed.
        self.pool = AttributePool::new();
        if wanted.records.is_some() {
            // Other records of the layer may have features.
            return Ok(self);
        }
        self.check_kind()?;
        if let (true, Some((_, error))) = (self.features.is_empty() && !self.has_seen(), self.refused.first())
        {
            return Err(error.clone());
        }
        if self.features.is_empty() {
            return Err(no_features(&self, wanted).help("check the file: burgeon sources FILE"));
        }
        Ok(self)
    }

    /// Skips a feature for the reason in `error`. Fails like [`FeatureTable::push`].
    pub fn refuse(&mut self, id: String, error: Error) -> Result<()> {
        self.budget.tick()?;
        self.budget.take(500 + id.len())?;
        self.refused.push((id, error.of_data()));
        Ok(())
    }

    /// Skips the features for which `why` returns an error; it gets the name of the layer in messages.
    pub(crate) fn refuse_those(
        &mut self,
        why: impl Fn(&str, &mut Feature) -> Option<Error> + Send + Sync,
    ) -> Result<()> {
        let shown = &self.shown;
        let wrong: Vec<Option<Error>> =
            self.features.par_iter_mut().map(|feature| why(shown, feature)).collect();
        if wrong.iter().all(Option::is_none) {
            return Ok(());
        }
        let kept: Vec<usize> = (0..wrong.len()).filter(|number| wrong[*number].is_none()).collect();
        for (number, error) in wrong.into_iter().enumerate() {
            if let Some(error) = error {
                self.refuse(self.features[number].id.to_string(), error)?;
            }
        }
        self.keep(&kept, None);
        Ok(())
    }

    /// Skips features with coordinates that are not finite.
    pub(crate) fn refuse_endless(&mut self) -> Result<()> {
        self.refuse_those(|name, feature| {
            let endless = feature.geometry.points().any(|point| !point.is_finite());
            endless.then(|| {
                let id = shown(&feature.id);
                Error::data(format!("feature {id} of {name} has a coordinate that is not a finite number"))
                    .help("repair the file, or remove the feature")
            })
        })
    }

    /// Returns the index of the attribute `name`; if there is none, fails with a list of the attributes.
    pub(crate) fn column(&self, name: &str) -> Result<usize> {
        self.names.iter().position(|known| known == name).ok_or_else(|| {
            let names = || self.names.iter().map(String::as_str);
            let message = format!("{}: unknown attribute `{}`", self.shown, shown(name));
            Error::not_found("attribute", name, names(), message).help(format!("it has {}", listed(names())))
        })
    }

    /// Sets the features' ids from the attribute `name`, if given, for features with that attribute.
    pub(crate) fn identify(&mut self, name: Option<&str>) -> Result<()> {
        let Some(name) = name else { return Ok(()) };
        let column = self.column(name)?;
        self.ids = TakenIds::new();
        self.repeated_ids.clear();
        let mut without = 0;
        for mut feature in std::mem::take(&mut self.features) {
            let known = feature.attributes.iter().find(|(index, _)| *index == column);
            without += usize::from(known.is_none());
            let id = known.map_or_else(|| feature.id.to_string(), |(_, value)| value.text());
            feature.id = self.ids.fresh(&id, &self.features);
            if feature.id != *id && self.repeated_ids.len() < REMEMBERED_IDS {
                self.repeated_ids.push(id);
            }
            self.features.push(feature);
        }
        self.derived = self.derived.min(without);
        Ok(())
    }

    /// Fails if there were geometries, but none of the requested type.
    pub(crate) fn check_kind(&self) -> Result<()> {
        let Some(kind) = self.selection.kind else { return Ok(()) };
        let seen = |known: &GeometryKind| self.selection.seen.get(*known as usize) == Some(&true);
        let there: Vec<&str> =
            GeometryKind::SINGLE.iter().filter(|known| seen(known)).map(|known| known.name()).collect();
        if there.is_empty() || seen(&kind) {
            return Ok(());
        }
        Err(Error::argument(format!(
            "{} has only geometries of kind {}, not of kind {}",
            self.shown,
            there.join(" and "),
            kind.name()
        ))
        .help("specify another layer, or remove kind"))
    }
}

/// Returns the error for a table without features.
fn no_features(table: &FeatureTable, wanted: &SourceOptions) -> Error {
    let what = &table.shown;
    if wanted.limit == Some(0) {
        return Error::argument(format!("limit = 0 excludes all features of {what}")).help("remove limit");
    }
    if let Some(condition) = &wanted.condition {
        return Error::data(format!("no feature of {what} matches where {condition}"))
            .help("run burgeon sources FILE to list attributes and their values");
    }
    if let (Some([west, south, east, north]), true) = (wanted.within, table.has_seen()) {
        let place = format!("{{ {west}, {south}, {east}, {north} }}");
        return Error::data(format!("no feature of {what} touches within = {place}"))
            .help("within is { west, south, east, north } in the coordinates of the file; run burgeon sources FILE to list them");
    }
    if wanted.tags.is_some() {
        return Error::data(format!("no feature of {what} has these tags"))
            .help("look up the tags: https://wiki.openstreetmap.org/wiki/Map_features");
    }
    if table.empty > 0 {
        return Error::data(format!("{what} has no features with a geometry"));
    }
    Error::data(format!("{what} has no features"))
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn what_is_not_wanted_is_not_kept_and_changes_no_id() {
        let (point, line) = (Geometry::point([1.0; 3]), Geometry::Line(vec![DVec3::ZERO, DVec3::ONE]));
        let far = Geometry::Line(vec![DVec3::splat(5.0), DVec3::splat(6.0)]);
        let kind = Some(GeometryKind::Line);
        let read = |wanted: SourceOptions| {
            let mut table = FeatureTable::new("a", "a", Crs::epsg(4326), &wanted);
            table
                .push("1", vec![point.clone(), line.clone(), point.clone(), far.clone()], Vec::new())
                .unwrap();
            table.push("2", vec![line.clone()], Vec::new()).unwrap();
            table.features.iter().map(|feature| feature.id.to_string()).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(read(SourceOptions::default()), "1 1.2 1.3 1.4 2");
        assert_eq!(read(SourceOptions { kind, ..SourceOptions::default() }), "1.2 1.4 2");
        assert_eq!(read(SourceOptions { kind, limit: Some(2), ..SourceOptions::default() }), "1.2 1.4");
        let within = Some([1.0, 0.5, 4.0, 4.0]);
        assert_eq!(read(SourceOptions { within, ..SourceOptions::default() }), "1 1.2 1.3 2");
    }

    #[test]
    fn features_that_know_the_same_share_it_and_stay_records_of_their_own() {
        let mut table = FeatureTable::new("a", "a", Crs::epsg(4326), &SourceOptions::default());
        let point = Geometry::point([1.0; 3]);
        let numbers = [0.0, -0.0, 0.0, 7.0, 7.0, 7.0];
        for (id, number) in numbers.into_iter().enumerate() {
            let parts = vec![point.clone(); if id == 4 { 3 } else { 1 }];
            table.push(&id.to_string(), parts, vec![(0, Attribute::Number(number))]).unwrap();
        }
        let signs: Vec<bool> = (table.features.iter())
            .map(|feature| matches!(feature.attributes[0].1, Attribute::Number(it) if it.is_sign_negative()))
            .collect();
        assert_eq!(signs, [false, true, false, false, false, false, false, false]);
        let shares =
            |a: usize, b: usize| Arc::ptr_eq(&table.features[a].attributes, &table.features[b].attributes);
        assert!(shares(3, 4) && shares(4, 6) && shares(6, 7) && !shares(0, 1));
        // Of 0, 1, 2, 3, 4, 4.2, 4.3 and 5.
        table.keep(&[2, 3, 5, 6, 7], None);
        assert_eq!((table.features.len(), table.records), (5, 4));
        table.keep(&[1, 3, 4], Some(2));
        assert_eq!((table.features.len(), table.records), (2, 2));
        table.keep(&[0], None);
        assert_eq!((table.features[0].id.to_string().as_str(), table.records), ("3", 1));
    }

    #[test]
    fn a_feature_takes_little() {
        assert!(size_of::<Feature>() <= 64, "{}", size_of::<Feature>());
        let mut table = FeatureTable::new("a", "a", Crs::epsg(4326), &SourceOptions::default());
        let [a, b] = ["residential"; 2].map(|text| table.text(text));
        assert!(matches!((a, b), (Attribute::Text(a), Attribute::Text(b)) if Arc::ptr_eq(&a, &b)));
    }
}
