//! City objects, and their conversion to features.

use super::shape::CityShape;
use crate::features::table::FeatureTable;
use crate::formats::typing::{TextTypes, as_number};
use burgeon_base::budget::Budget;
use burgeon_base::error::Result;
use burgeon_kit::Attribute;
use std::borrow::Cow;

/// Value of an object.
#[derive(Debug, Clone)]
pub(in crate::formats) enum CityValue {
    /// XML text, which may be a number.
    Text(String),
    /// JSON value.
    Known(Attribute),
}

/// City object, such as a building, a road, or a tree.
#[derive(Debug, Default)]
pub(in crate::formats) struct CityRecord {
    /// Id, if any.
    pub(in crate::formats) id: Option<String>,
    pub(in crate::formats) values: Vec<(Cow<'static, str>, CityValue)>,
    pub(in crate::formats) shape: CityShape,
    /// Parts, such as building parts.
    pub(in crate::formats) parts: Vec<CityRecord>,
}

impl CityRecord {
    /// Adds a text value; several values of one name are joined in a list.
    pub(in crate::formats) fn add_text(&mut self, name: &str, value: &str) {
        if value.is_empty() {
            return;
        }
        match self.values.iter_mut().find(|(known, _)| known == name) {
            Some((_, CityValue::Text(known))) => {
                known.push(';');
                known.push_str(value);
            }
            Some(_) => {}
            None => self.values.push((Cow::Owned(name.to_owned()), CityValue::Text(value.to_owned()))),
        }
    }

    /// Adds the features of the object to `table`: one for the object itself, and one for each part with a geometry,
    /// which inherits the attributes of the object. If the object has only a footprint, the parts are omitted, because
    /// the footprint covers all of them.
    ///
    /// Fails like [`FeatureTable::push`].
    pub(in crate::formats) fn add_to(
        mut self,
        table: &mut FeatureTable,
        types: &mut TextTypes,
        budget: &Budget,
    ) -> Result<()> {
        let parts = std::mem::take(&mut self.parts);
        let is_whole = !self.shape.surfaces.is_empty() && self.shape.is_flat();
        let heights = self.shape.heights().or_else(|| {
            let of_parts = parts.iter().filter_map(|part| part.shape.heights());
            of_parts.reduce(|[low, high], [lower, higher]| [low.min(lower), high.max(higher)])
        });
        if !self.shape.is_empty() || parts.is_empty() {
            self.push(heights, table, types, budget)?;
        }
        if is_whole {
            return Ok(());
        }
        for mut part in parts {
            let heights = part.shape.heights();
            for (name, value) in &self.values {
                if !part.values.iter().any(|(known, _)| known == name) {
                    part.values.push((name.clone(), value.clone()));
                }
            }
            if let Some(id) = &self.id {
                part.values.push(("parent".into(), CityValue::Known(Attribute::Text(id.as_str().into()))));
            }
            part.push(heights, table, types, budget)?;
        }
        Ok(())
    }

    /// Adds the feature of the object itself. Its height, ground height and number of storeys are also stored in
    /// `height`, `ground` and `levels`.
    fn push(
        &self,
        heights: Option<[f64; 2]>,
        table: &mut FeatureTable,
        types: &mut TextTypes,
        budget: &Budget,
    ) -> Result<()> {
        let parts = self.shape.footprint(budget)?;
        let mut attributes: Vec<(usize, Attribute)> = Vec::with_capacity(self.values.len() + 3);
        for (name, value) in &self.values {
            attributes.push(match value {
                CityValue::Text(text) => types.attribute(table, name, text),
                CityValue::Known(value) => (table.name(name), value.clone()),
            });
        }
        let number = |name: &str| {
            self.values.iter().find(|(known, _)| known == name).and_then(|(_, value)| value.number())
        };
        let measured = number("measuredHeight");
        let plain = [
            ("height", measured.or_else(|| heights.map(|[low, high]| high - low))),
            ("ground", heights.map(|[low, _]| low)),
            ("levels", number("storeysAboveGround")),
        ];
        for (name, value) in plain {
            let is_new = !self.values.iter().any(|(known, _)| known == name);
            if let (Some(value), true) = (value, is_new) {
                attributes.push((table.name(name), Attribute::Number(value)));
            }
        }
        match &self.id {
            Some(id) => table.push(id, parts, attributes),
            None => table.push_unnamed(parts, attributes),
        }
    }
}

impl CityValue {
    fn number(&self) -> Option<f64> {
        match self {
            Self::Text(text) => as_number(text),
            Self::Known(Attribute::Number(number)) => Some(*number),
            Self::Known(_) => None,
        }
    }
}
