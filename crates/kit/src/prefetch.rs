//! Work on a layer's features that another thread does before anyone asks for them.

use std::any::Any;
use std::sync::Arc;

use super::Object;

/// Begins to prepare the features of a source; `None` if the source has nothing to prepare.
pub type BeginPrefetch = fn(&Arc<dyn Object>) -> Option<Arc<dyn Prefetch>>;

/// What is being made of a layer's features before they are asked for.
pub trait Prefetch: Any + Send + Sync {
    /// Makes what comes next, from the first question on until [`Prefetch::end`].
    fn work(&self);

    /// Lets the thread go that works.
    fn end(&self);
}
