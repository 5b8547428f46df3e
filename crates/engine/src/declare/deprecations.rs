//! Deprecated names: each used name gets one warning, at the first line that uses it.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use super::session::Session;
use burgeon_base::error::{Result, SourcePlace};
use burgeon_base::locks::LockRecovery;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_kit::{Deprecation, Field, Registry, Table};
use burgeon_language::deprecated_names;

/// Deprecated names, and the names that scripts have used.
#[derive(Default)]
pub(crate) struct Deprecations {
    /// Deprecated values, such as constructors.
    names: Arc<BTreeMap<String, Deprecation>>,
    /// Names that were used, with the first location. Threads reach a line in any order, so the minimum is
    /// kept.
    used: Mutex<BTreeMap<String, (Deprecation, Option<SourcePlace>)>>,
}

impl Deprecations {
    pub(super) fn new(registry: &Registry) -> Self {
        Self { names: Arc::new(deprecated_names(registry)), used: Mutex::default() }
    }

    /// Returns one warning for each name that was used.
    pub(super) fn warnings(&self) -> Vec<Warning> {
        let used = self.used.lock().recover();
        let warning = |(name, (deprecation, place)): (&String, &(Deprecation, Option<SourcePlace>))| {
            let warning = Warning::new(WarningKind::Deprecated, deprecation.message(name));
            warning.help(format!("use {} instead", deprecation.instead)).at_place(place.as_ref())
        };
        used.iter().map(warning).collect()
    }
}

impl Session {
    /// Returns the deprecated names of values.
    pub(crate) fn deprecated_names(&self) -> &Arc<BTreeMap<String, Deprecation>> {
        &self.deprecated.names
    }

    /// Replaces the former names of `fields` in the table of `owner`, and records them as used at `place`. Fails if a
    /// field has both names.
    pub(crate) fn replace_former_names<'a>(
        &self,
        owner: &str,
        fields: &[Field],
        table: &'a Table,
        place: Option<&SourcePlace>,
    ) -> Result<Cow<'a, Table>> {
        for former in Field::former_names(fields, table) {
            self.use_deprecated(&format!("{owner}.{}", former.name), former, place);
        }
        Field::replace_former_names(owner, fields, table)
    }

    /// Records that a script uses the deprecated `name` at `place`.
    pub(crate) fn use_deprecated(&self, name: &str, deprecation: &Deprecation, place: Option<&SourcePlace>) {
        let mut used = self.deprecated.used.lock().recover();
        match used.get_mut(name) {
            Some((_, first)) => {
                if place.is_some() && (first.is_none() || place < first.as_ref()) {
                    *first = place.cloned();
                }
            }
            None => {
                used.insert(name.to_owned(), (deprecation.clone(), place.cloned()));
            }
        }
    }
}
