//! Preparation of a layer's features in another thread before a script uses them.

use std::any::Any;
use std::sync::Arc;

use burgeon_data::Layer;

/// Function that starts preparing a layer's features.
pub type BeginPrefetch = fn(&Arc<Layer>) -> Arc<dyn Prefetch>;

/// Preparation of a layer's features in advance.
pub trait Prefetch: Any + Send + Sync {
    /// Prepares features in order, from the first query until [`Prefetch::end`].
    fn work(&self);

    /// Stops the working thread.
    fn end(&self);
}
