//! The types of objects that the scripts of a run can use.

use std::sync::Arc;

use super::Kind;
use burgeon_base::error::{Error, Result};

/// Types of objects by name, in the order in which they were added.
#[derive(Debug, Clone, Default)]
pub struct Registry {
    kinds: Vec<Arc<Kind>>,
}

impl Registry {
    /// Adds a type. Fails if there is one of that name.
    pub fn add(&mut self, kind: impl Into<Arc<Kind>>) -> Result<()> {
        let kind = kind.into();
        if self.get(&kind.name).is_some() {
            return Err(Error::argument(format!("there is a type of object called {} already", kind.name))
                .help("give it another name"));
        }
        self.kinds.push(kind);
        Ok(())
    }

    /// The type called `name`.
    pub fn get(&self, name: &str) -> Option<&Arc<Kind>> {
        self.kinds.iter().find(|kind| kind.name == name)
    }

    /// All types, in the order in which they were added.
    pub fn kinds(&self) -> impl Iterator<Item = &Arc<Kind>> {
        self.kinds.iter()
    }
}
