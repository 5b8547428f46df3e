//! Features of a source that a run over a part builds and shows.

use std::sync::Arc;

use mlua::{AnyUserData, Value as LuaValue};

use super::source::{each_feature, layer_of};
use crate::machine::Machine;
use crate::machine::convert::to_value;
use burgeon_base::error::Result;
use burgeon_kit::{Parameter, Value};
use burgeon_spatial::{BoundingBox, GeometryInput, GeometryObject, near_selection};

/// Role of a feature in a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FeatureRole {
    /// Built and shown.
    Shown,
    /// Built only for the features near it.
    Neighbor,
    /// Not built.
    Absent,
}

/// Roles of the features of a source.
pub(super) struct PartSelection {
    /// Empty if all features are shown.
    roles: Vec<FeatureRole>,
}

impl PartSelection {
    /// Selects the features of the run's part.
    pub(super) fn new(machine: &Machine, source: &AnyUserData) -> Result<Self> {
        let Some(part) = machine.session.options.part else { return Ok(Self { roles: Vec::new() }) };
        let bounds = bounds(machine, source)?;
        let layer = layer_of(source);
        let choice = machine.session.options.choice.as_ref();
        let is_chosen = |index: usize| {
            choice.is_none_or(|choice| match &layer {
                Some(layer) => choice.contains(layer.attribute_names(), layer.attributes(index)),
                None => choice.contains(&[], &[]),
            })
        };
        let shown = |(index, it): (usize, &Option<BoundingBox>)| {
            part.contains(index, bounds.len(), *it) && is_chosen(index)
        };
        let shown: Vec<bool> = bounds.iter().enumerate().map(shown).collect();
        let near = if part.reach > 0.0 {
            near_selection(&bounds, |index| shown[index], part.reach)?
        } else {
            vec![false; bounds.len()]
        };
        let role = |(shown, near)| match (shown, near) {
            (true, _) => FeatureRole::Shown,
            (false, true) => FeatureRole::Neighbor,
            (false, false) => FeatureRole::Absent,
        };
        Ok(Self { roles: shown.into_iter().zip(near).map(role).collect() })
    }

    /// Returns the role of the feature with this number, from 0.
    pub(super) fn role(&self, index: usize) -> FeatureRole {
        self.roles.get(index).copied().unwrap_or(FeatureRole::Shown)
    }

    /// Returns true if all features of the source are shown.
    pub(super) fn is_whole(&self) -> bool {
        self.roles.is_empty()
    }
}

/// Returns the bounding boxes (m) of a source's features.
fn bounds(machine: &Machine, source: &AnyUserData) -> Result<Vec<Option<BoundingBox>>> {
    if let Some(layer) = layer_of(source) {
        let bounds = |feature| {
            let geometry = Arc::clone(&layer).geometry(feature, None)?;
            GeometryObject::of(&*geometry)?.bounds()
        };
        return Ok((0..layer.count()).map(bounds).collect());
    }
    let mut bounds = Vec::new();
    let each = |_: usize, feature: LuaValue, _: Option<&str>| {
        let geometry = match to_value(&feature, true) {
            Ok(value @ Value::Table(_)) => GeometryInput::from_value(value).ok(),
            _ => None,
        };
        bounds.push(geometry.and_then(|shape| shape.geometry().bounds()));
        Ok(())
    };
    each_feature(machine.lua(), source, None, each, |error| machine.translate(error))?;
    Ok(bounds)
}
