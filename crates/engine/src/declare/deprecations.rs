//! Names that will go: scripts that use one are told once, with the first line on which they do.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use super::session::Session;
use burgeon_base::error::SourcePlace;
use burgeon_base::locks::LockRecovery;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_kit::{Deprecation, Registry};
use burgeon_language::deprecated_names;

/// The names that will go, and those of them that were used.
#[derive(Default)]
pub(crate) struct Deprecations {
    /// Values, such as constructors.
    names: Arc<BTreeMap<String, Deprecation>>,
    /// What was used, as people write it, and where first: threads come to a line in any order.
    used: Mutex<BTreeMap<String, (Deprecation, Option<SourcePlace>)>>,
}

impl Deprecations {
    pub(super) fn new(registry: &Registry) -> Self {
        Self { names: Arc::new(deprecated_names(registry)), used: Mutex::default() }
    }

    /// A warning for each name that was used.
    pub(super) fn warnings(&self) -> Vec<Warning> {
        let used = self.used.lock().recover();
        let warning = |(name, (deprecation, place)): (&String, &(Deprecation, Option<SourcePlace>))| {
            let warning = Warning::new(WarningKind::Deprecated, deprecation.message(name));
            warning.help(format!("use {} instead", deprecation.instead)).at(place.clone())
        };
        used.iter().map(warning).collect()
    }
}

impl Session {
    /// The names of values that will go.
    pub(crate) fn deprecated_names(&self) -> &Arc<BTreeMap<String, Deprecation>> {
        &self.deprecated.names
    }

    /// Takes notice that a script uses `name`, as people write it, in `place`.
    pub(crate) fn use_deprecated(&self, name: &str, deprecation: &Deprecation, place: Option<SourcePlace>) {
        let mut used = self.deprecated.used.lock().recover();
        match used.get_mut(name) {
            Some((_, first)) => {
                if place.is_some() && (first.is_none() || place < *first) {
                    *first = place;
                }
            }
            None => {
                used.insert(name.to_owned(), (deprecation.clone(), place));
            }
        }
    }
}
