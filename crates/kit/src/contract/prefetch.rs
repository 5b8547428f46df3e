//! Preparation of a layer's features in another thread before a script uses them.

use std::any::Any;
use std::sync::Arc;

use crate::Object;

/// Begins to prepare the features of a source; `None` if the source has nothing to prepare.
pub type BeginPrefetch = fn(&Arc<dyn Object>) -> Option<Arc<dyn Prefetch>>;

/// Preparation of a layer's features in advance.
pub trait Prefetch: Any + Send + Sync {
    /// Prepares features in order, from the first query until [`Prefetch::end`].
    fn work(&self);

    /// Stops the working thread.
    fn end(&self);
}
