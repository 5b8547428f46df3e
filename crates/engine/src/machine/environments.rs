//! Environments of a derivation.

use std::borrow::Cow;
use std::sync::{Arc, RwLock};

use mlua::Value as LuaValue;

use super::convert::to_value;
use burgeon_base::error::{Error, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_kit::{Environment, Object, Value};

/// Environments of a derivation, in the state that interpretations change and rules read.
pub(crate) struct Environments(Vec<RwLock<Box<dyn Object>>>);

impl Environments {
    /// Creates the environments of a derivation as the script has made them; `None` if there are none.
    pub(crate) fn new(made: &[Arc<dyn Object>]) -> Option<Arc<Self>> {
        let states: Vec<_> = made.iter().map(|object| RwLock::new(object.boxed())).collect();
        (!states.is_empty()).then(|| Arc::new(Self(states)))
    }

    /// Returns the state of `object`, if it is one of the environments `made`, as this machine has made them.
    pub(crate) fn state_of(
        &self,
        made: &[Arc<dyn Object>],
        object: &Arc<dyn Object>,
    ) -> Option<&RwLock<Box<dyn Object>>> {
        self.0.get(made.iter().position(|known| Arc::ptr_eq(known, object))?)
    }

    /// Prepares the environments for an interpretation pass.
    pub(crate) fn begin_pass(&self) {
        self.0.iter().for_each(|state| state.write().recover().begin());
    }

    /// Completes an interpretation pass.
    pub(crate) fn end_pass(&self) -> Result<()> {
        self.0.iter().try_for_each(|state| {
            let mut state = state.write().recover();
            state.capability_mut::<dyn Environment>().map_or(Ok(()), |environment| environment.end_pass())
        })
    }
}

/// Returns the environments that a script gives to a system: an object, or a list of objects.
pub(super) fn environments_of(value: &LuaValue) -> Result<Vec<Arc<dyn Object>>> {
    let values = match to_value(value, false)? {
        Value::Table(table) => {
            Arc::unwrap_or_clone(table).entries.into_iter().map(|(_, value)| value).collect()
        }
        value => vec![value],
    };
    let environments = values.into_iter().map(|value| match value {
        Value::Object(object) if object.kind().has_capability::<dyn Environment>() => Ok(object),
        other => Err(Error::argument(format!(
            "lsystem: an environment is an object such as shadow_voxels(), not {}",
            match &other {
                Value::Object(object) => Cow::Owned(object.kind().with_article()),
                other => Cow::Borrowed(other.describe()),
            }
        ))
        .help("write local light = shadow_voxels(), and lsystem({ object = turtle(), environment = { light } })")),
    });
    environments.collect()
}
