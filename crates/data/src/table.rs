//! What a layer holds, as it stands in its file.

use std::sync::Arc;

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::{Crs, SourceOptions};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::{listed, shown};
use burgeon_spatial::{Geometry, GeometryKind};

/// What a feature knows under a name.
#[derive(Debug, Clone, PartialEq)]
pub enum Attribute {
    /// True or false.
    Boolean(bool),
    /// A finite number.
    Number(f64),
    /// Text.
    Text(Arc<str>),
    /// A list or an object of GeoJSON.
    Nested(Arc<serde_json::Value>),
}

/// A record with a geometry.
#[derive(Debug, Clone)]
pub struct Feature {
    /// Tells it from all others of its layer.
    pub id: String,
    /// Where it is: a geometry of one part.
    pub geometry: Geometry,
    /// What it knows: the number of the name in [`FeatureTable::names`], and the value. Shared by the parts of a geometry.
    pub attributes: Arc<[(usize, Attribute)]>,
}

/// A layer as it stands in its file.
#[derive(Debug)]
pub struct FeatureTable {
    /// The layer's name.
    pub layer: String,
    /// File and layer, for messages.
    pub shown: String,
    /// The coordinate system, or why it is not known.
    pub crs: Result<Crs>,
    /// The names of attributes, in the order of the file.
    pub names: Vec<String>,
    /// The features in the order of the file, one for each part of a geometry.
    pub features: Vec<Feature>,
    /// How many records the features come from: fewer where some have several parts.
    pub records: usize,
    /// How many features had no geometry, or one without extent, and were left out.
    pub empty: usize,
    /// The ids of features whose geometry cannot be read, and why; they are left out.
    pub refused: Vec<(String, Error)>,
    /// The ids that are taken, each with the number that was tried last behind it.
    ids: FxHashMap<String, usize>,
    budget: Arc<Budget>,
}

impl FeatureTable {
    pub(super) fn new(layer: &str, shown: &str, crs: Result<Crs>, budget: Arc<Budget>) -> Self {
        Self {
            layer: layer.to_owned(),
            shown: shown.to_owned(),
            crs,
            names: Vec::new(),
            features: Vec::new(),
            records: 0,
            empty: 0,
            refused: Vec::new(),
            ids: FxHashMap::default(),
            budget,
        }
    }

    /// A layer with attributes called `names`, whose features are [pushed](Self::push) by another reader; `shown` is what
    /// messages call it.
    pub fn of_layer(
        layer: &str,
        shown: &str,
        crs: Result<Crs>,
        names: Vec<String>,
        budget: Arc<Budget>,
    ) -> Self {
        Self { names, ..Self::new(layer, shown, crs, budget) }
    }

    /// Adds a feature for each of `parts`; with an id that is taken, it becomes `id.2`, `id.3` and so on.
    ///
    /// Fails if reading is to end, or if there is no memory left for more.
    pub fn push(
        &mut self,
        id: &str,
        parts: Vec<Geometry>,
        attributes: Vec<(usize, Attribute)>,
    ) -> Result<()> {
        self.budget.tick()?;
        if parts.is_empty() {
            self.empty += 1;
            return Ok(());
        }
        let known: usize = attributes.iter().map(|(_, value)| 40 + value.weight()).sum();
        let points: usize = parts.iter().map(|part| part.points().count() * 24).sum();
        // Each id is kept twice, in a list and in a map.
        self.budget.take(known + points + parts.len() * (300 + 2 * id.len()))?;
        self.records += 1;
        let attributes: Arc<[(usize, Attribute)]> = attributes.into();
        for geometry in parts {
            let id = self.fresh(id);
            self.features.push(Feature { id, geometry, attributes: Arc::clone(&attributes) });
        }
        Ok(())
    }

    /// The table with what is wanted of it: a coordinate system in place of its own, one kind of geometry, so many
    /// features. Fails if nothing is left.
    pub fn finished(mut self, wanted: &SourceOptions) -> Result<Self> {
        if let Some(code) = wanted.crs {
            self.crs = Crs::epsg(code);
        }
        self.choose(wanted.kind)?;
        if let Some(limit) = wanted.limit {
            self.features.truncate(limit);
        }
        if let (true, Some((_, error))) = (self.features.is_empty(), self.refused.first()) {
            return Err(error.clone());
        }
        if self.features.is_empty() {
            let what = &self.shown;
            return Err(match (&wanted.condition, wanted.limit) {
                (_, Some(0)) => {
                    Error::argument(format!("limit = 0 leaves no feature of {what}")).help("leave limit out")
                }
                (Some(condition), _) => Error::data(format!("no feature of {what} meets where {condition}"))
                    .help("burgeon sources FILE lists attributes and their values"),
                (None, _) if self.empty > 0 => Error::data(format!("{what} has no features with a geometry")),
                (None, _) => Error::data(format!("{what} has no features")),
            }
            .help("check the file: burgeon sources FILE"));
        }
        Ok(self)
    }

    /// Leaves out a feature for the reason that `error` gives. Fails as [`FeatureTable::push`] does.
    pub(super) fn refuse(&mut self, id: String, error: Error) -> Result<()> {
        self.budget.tick()?;
        self.budget.take(500 + id.len())?;
        self.refused.push((id, error.of_data()));
        Ok(())
    }

    /// Leaves out the features of which `why` tells something.
    pub(super) fn refuse_those(
        &mut self,
        why: impl Fn(&mut Feature) -> Option<Error> + Send + Sync,
    ) -> Result<()> {
        let wrong: Vec<Option<Error>> = self.features.par_iter_mut().map(why).collect();
        if wrong.iter().all(Option::is_none) {
            return Ok(());
        }
        for (feature, wrong) in std::mem::take(&mut self.features).into_iter().zip(wrong) {
            match wrong {
                Some(error) => self.refuse(feature.id, error)?,
                None => self.features.push(feature),
            }
        }
        Ok(())
    }

    /// Leaves out features with coordinates that are no finite numbers.
    pub(super) fn refuse_endless(&mut self) -> Result<()> {
        let name = self.shown.clone();
        self.refuse_those(|feature| {
            let endless = feature.geometry.points().any(|point| !point.is_finite());
            endless.then(|| {
                let id = shown(&feature.id);
                Error::data(format!("feature {id} of {name} has a coordinate that is not a finite number"))
                    .help("repair the file, or leave the feature out")
            })
        })
    }

    fn fresh(&mut self, id: &str) -> String {
        let Some(mut count) = self.ids.get(id).copied() else {
            self.ids.insert(id.to_owned(), 1);
            return id.to_owned();
        };
        loop {
            count += 1;
            let unique = format!("{id}.{count}");
            if !self.ids.contains_key(&unique) {
                self.ids.insert(unique.clone(), 1);
                if let Some(last) = self.ids.get_mut(id) {
                    *last = count;
                }
                return unique;
            }
        }
    }

    /// The number of the attribute `name`, and an error that lists those that there are if there is none.
    pub(super) fn column(&self, name: &str) -> Result<usize> {
        self.names.iter().position(|known| known == name).ok_or_else(|| {
            let names = || self.names.iter().map(String::as_str);
            let message = format!("{} has no attribute called {}", self.shown, shown(name));
            Error::not_found("attribute", name, names(), message).help(format!("it has {}", listed(names())))
        })
    }

    /// Takes the features' ids from the attribute `name`, where one is given and a feature has it.
    pub(super) fn identify(&mut self, name: Option<&str>) -> Result<()> {
        let Some(name) = name else { return Ok(()) };
        let column = self.column(name)?;
        self.ids.clear();
        for mut feature in std::mem::take(&mut self.features) {
            let known = feature.attributes.iter().find(|(index, _)| *index == column);
            let id = known.map_or_else(|| feature.id.clone(), |(_, value)| value.as_id());
            feature.id = self.fresh(&id);
            self.features.push(feature);
        }
        Ok(())
    }

    /// Leaves only geometries of the kind that is wanted, of which there must be one.
    pub(super) fn choose(&mut self, kind: Option<GeometryKind>) -> Result<()> {
        let Some(kind) = kind else { return Ok(()) };
        let there: Vec<&str> = GeometryKind::SINGLE
            .iter()
            .filter(|known| self.features.iter().any(|feature| feature.geometry.kind() == **known))
            .map(|known| known.name())
            .collect();
        self.features.retain(|feature| feature.geometry.kind() == kind);
        if self.features.is_empty() && !there.is_empty() {
            return Err(Error::argument(format!(
                "{} has geometries of kind {}, none of kind {}",
                self.shown,
                there.join(" and "),
                kind.name()
            ))
            .help("name another layer, or leave kind out"));
        }
        Ok(())
    }
}

impl Attribute {
    /// About how much memory (bytes) it takes besides its place in a list.
    fn weight(&self) -> usize {
        fn nested(value: &serde_json::Value) -> usize {
            use serde_json::Value as Json;
            match value {
                Json::String(text) => 80 + text.len(),
                Json::Array(items) => 80 + items.iter().map(nested).sum::<usize>(),
                Json::Object(fields) => {
                    80 + fields.iter().map(|(name, value)| 80 + name.len() + nested(value)).sum::<usize>()
                }
                _ => 80,
            }
        }
        match self {
            Self::Boolean(_) | Self::Number(_) => 0,
            Self::Text(text) => 16 + text.len(),
            Self::Nested(value) => nested(value),
        }
    }

    /// The value as a feature's id.
    pub(super) fn as_id(&self) -> String {
        match self {
            Self::Boolean(value) => value.to_string(),
            Self::Number(value) => value.to_string(),
            Self::Text(text) => text.to_string(),
            Self::Nested(value) => value.to_string(),
        }
    }

    /// `boolean`, `number`, `text` or `table`.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Boolean(_) => "boolean",
            Self::Number(_) => "number",
            Self::Text(_) => "text",
            Self::Nested(_) => "table",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_and_repeated_ids_are_numbered_on() {
        let mut table = FeatureTable::new("a", "a", Crs::epsg(4326), Arc::default());
        let point = Geometry::point([0.0; 3]);
        table.push("12", vec![point.clone(), point.clone(), point.clone()], Vec::new()).unwrap();
        table.push("12.2", vec![point.clone()], Vec::new()).unwrap();
        table.push("12", vec![point], Vec::new()).unwrap();
        let ids: Vec<&str> = table.features.iter().map(|feature| feature.id.as_str()).collect();
        assert_eq!(ids, ["12", "12.2", "12.3", "12.2.2", "12.4"]);
    }
    #[test]
    fn many_equal_ids_take_no_longer_than_others() {
        let mut table = FeatureTable::new("a", "a", Crs::epsg(4326), Arc::default());
        for number in 0..200_000 {
            let id = if number % 3 == 0 { format!("a.{number}") } else { "a".to_owned() };
            table.push(&id, vec![Geometry::point([0.0; 3])], Vec::new()).unwrap();
        }
        let ids: std::collections::HashSet<_> = table.features.iter().map(|feature| &feature.id).collect();
        assert_eq!(ids.len(), 200_000);
    }
}
