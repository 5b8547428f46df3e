//! Work on a layer's features that another thread does before anyone asks for them.

use std::any::Any;
use std::sync::Arc;

use burgeon_data::Layer;

/// Begins to prepare a layer's features.
pub type BeginPrefetch = fn(&Arc<Layer>) -> Arc<dyn Prefetch>;

/// What is being made of a layer's features before they are asked for.
pub trait Prefetch: Any + Send + Sync {
    /// Makes what comes next, from the first question on until [`Prefetch::end`].
    fn work(&self);

    /// Lets the thread go that works.
    fn end(&self);
}
