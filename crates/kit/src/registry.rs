//! Object types and sources that the scripts of a run can use.

use std::sync::Arc;

use super::{Kind, SourceProvider};
use burgeon_base::error::{Error, Result};

/// Object types by name, in the order of insertion, and sources.
#[derive(Debug, Clone, Default)]
pub struct Registry {
    kinds: Vec<Arc<Kind>>,
    sources: Option<Arc<dyn SourceProvider>>,
    /// Error for the first type that was skipped when the registry was collected from an iterator.
    problem: Option<Error>,
}

impl Registry {
    /// Creates a registry of all types of a list. Fails if two types have the same name.
    ///
    /// ```
    /// use burgeon_kit::{Kind, Registry};
    ///
    /// let registry = Registry::try_from_kinds([Kind::new("bead", "A bead."), Kind::new("string", "Beads in a row.")])?;
    /// assert!(registry.get("bead").is_some() && registry.get("Bead").is_none());
    ///
    /// let twice = Registry::try_from_kinds([Kind::new("bead", "A bead."), Kind::new("bead", "Another.")]);
    /// let error = twice.expect_err("two of a name");
    /// assert_eq!(error.message(), "object type `bead` is already declared, as a built-in type");
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn try_from_kinds(kinds: impl IntoIterator<Item = impl Into<Arc<Kind>>>) -> Result<Self> {
        let mut registry = Self::default();
        kinds.into_iter().try_for_each(|kind| registry.add(kind))?;
        Ok(registry)
    }

    /// Adds a type. Fails if a type of that name exists.
    pub fn add(&mut self, kind: impl Into<Arc<Kind>>) -> Result<()> {
        let kind = kind.into();
        self.refuse_taken(&kind.name)?;
        self.kinds.push(kind);
        Ok(())
    }

    /// Fails if a type called `name` exists.
    pub fn refuse_taken(&self, name: &str) -> Result<()> {
        let Some(known) = self.get(name) else { return Ok(()) };
        let place = known.script.as_ref().and_then(|script| script.place());
        let place = place.map(|place| format!("in {place}"));
        let place = place.as_deref().unwrap_or("as a built-in type");
        Err(Error::argument(format!("object type `{name}` is already declared, {place}"))
            .help("rename this one, or add methods to the other: extend(constructor, { ... })"))
    }

    /// Fails if the registry was collected from types of which two have the same name.
    pub fn check(&self) -> Result<()> {
        self.problem.clone().map_or(Ok(()), Err)
    }

    /// Sets the sources that scripts can load and query.
    pub fn set_sources(&mut self, sources: Arc<dyn SourceProvider>) {
        self.sources = Some(sources);
    }

    /// Returns the sources that scripts can load and query, if there are any.
    pub fn sources(&self) -> Option<&Arc<dyn SourceProvider>> {
        self.sources.as_ref()
    }

    /// Returns the type called `name`.
    pub fn get(&self, name: &str) -> Option<&Arc<Kind>> {
        self.kinds.iter().find(|kind| kind.name == name)
    }

    /// Returns all types, in the order of insertion.
    pub fn kinds(&self) -> impl Iterator<Item = &Arc<Kind>> {
        self.kinds.iter()
    }
}

/// Collects all types of a list. Of two types with the same name, only the first is kept. [`Registry::check`] then
/// fails, and no script runs with such a registry. [`Registry::try_from_kinds`] fails immediately.
impl FromIterator<Arc<Kind>> for Registry {
    fn from_iter<I: IntoIterator<Item = Arc<Kind>>>(kinds: I) -> Self {
        let mut registry = Self::default();
        for kind in kinds {
            if let Err(error) = registry.add(kind) {
                registry.problem.get_or_insert(error);
            }
        }
        registry
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_that_stands_twice_in_a_list_is_told() {
        let kind = |name: &'static str| Arc::new(Kind::new(name, "A thing."));
        let registry: Registry = ["bead", "string"].map(kind).into_iter().collect();
        assert!(registry.check().is_ok());
        let registry: Registry = ["bead", "string", "bead", "string"].map(kind).into_iter().collect();
        assert_eq!(registry.kinds().count(), 2);
        let error = registry.check().expect_err("two of a name").to_string();
        assert!(error.contains("object type `bead` is already declared, as a built-in type"), "{error}");
    }
}
