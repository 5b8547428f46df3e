//! Names that a script can use without declaring them.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::AtomicUsize;

use burgeon_kit::Deprecation;
use burgeon_rewriting::Signature;
use rustc_hash::{FxHashMap, FxHashSet};

/// Names that a script can use without declaring them.
#[derive(Debug, Clone, Default)]
pub struct Globals {
    /// Names of all values.
    pub names: Vec<String>,
    /// Modules among the names, with their signatures.
    pub modules: FxHashMap<String, Signature>,
    /// Constructors of objects among the names.
    pub kinds: Vec<String>,
    /// Methods of objects that never change, such as geometries.
    pub value_methods: FxHashSet<String>,
    /// Deprecated names.
    pub deprecated: Arc<BTreeMap<String, Deprecation>>,
    /// Counter for the shapes of the run's rules.
    pub shapes: Arc<AtomicUsize>,
    /// Set if calls are to be checked against the declarations.
    pub checks_calls: bool,
}
