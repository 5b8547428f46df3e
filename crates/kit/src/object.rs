//! Interface of all objects.

use std::any::Any;
use std::sync::Arc;

use super::{Drawing, Kind, Note, Rewriter, Value};
use burgeon_base::error::Result;
use burgeon_base::warning::Warning;
use burgeon_scene::Scene;

/// An object that scripts can make and read, and that the modules of a chain can draw with.
///
/// Optional abilities, such as drawing, are [`Capability`](super::Capability) values of its [`Kind`].
pub trait Object: Any + Send + Sync {
    /// Returns the object's type: name, fields, methods and capabilities.
    fn kind(&self) -> &Arc<Kind>;

    /// Returns a copy. Each chain draws with its own copy.
    fn boxed(&self) -> Box<dyn Object>;

    /// Prepares for an interpretation pass; a drawing object is emptied.
    fn begin(&mut self) {}

    /// Saves the frame at the start of a branch.
    fn push(&mut self) {}

    /// Restores the frame that the matching [`Object::push`] saved.
    fn pop(&mut self) -> Result<()> {
        Ok(())
    }

    /// Completes unfinished content at the end of a pass.
    fn end(&mut self) -> Result<()> {
        Ok(())
    }

    /// Sets the seed of the object's random choices. Chains with other seeds or features get other numbers.
    fn seed(&mut self, _: u64) {}

    /// Returns the base object, whose methods and capabilities this object inherits.
    fn base(&self) -> Option<&dyn Object> {
        None
    }

    /// Returns the base object for changes.
    fn base_mut(&mut self) -> Option<&mut dyn Object> {
        None
    }
}

/// Capabilities of an object of unknown type, with defaults if its kind lacks them.
impl dyn Object {
    /// Returns the number of triangles drawn so far, for the limit. An instance counts as one.
    pub fn triangles(&self) -> usize {
        self.kind().show.as_ref().and_then(|show| show.of(self)).map_or(0, |it| it.triangles())
    }

    /// Adds the drawn content to `scene`, if the object draws; `name` and `feature` are for its instances.
    pub fn show(&self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()> {
        let show = self.kind().show.as_ref().and_then(|show| show.of(self));
        show.map_or(Ok(()), |it| it.show(scene, name, feature))
    }

    /// Adds the drawn content like `show`, but may move it out of the object, because the object is not used again.
    pub fn hand_over(&mut self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()> {
        let kind = Arc::clone(self.kind());
        let show = kind.show.as_ref().and_then(|show| show.of_mut(self));
        show.map_or(Ok(()), |it| it.hand_over(scene, name, feature))
    }

    /// Returns the drawing, if the object draws with a [`Drawing`]. Such drawings can be traced to the modules that
    /// made them.
    pub fn drawing_mut(&mut self) -> Option<&mut Drawing> {
        let kind = Arc::clone(self.kind());
        kind.draw.as_ref()?.of_mut(self).map(|it| it.drawing_mut())
    }

    /// Takes the warnings about the object's construction and about the calls since the last time.
    pub fn take_warnings(&mut self) -> Vec<Warning> {
        let warn = self.kind().warn;
        warn.and_then(|warn| warn.of_mut(self)).map_or_else(Vec::new, |it| it.take_warnings())
    }

    /// Returns true if the object expands its content automatically, so it needs no axiom.
    pub fn expands(&self) -> bool {
        self.kind().expand.is_some()
    }

    /// Expands the content that was last requested, if the object has the capability.
    pub fn expand(&mut self, rules: &dyn Rewriter) -> Result<()> {
        let kind = Arc::clone(self.kind());
        let expand = kind.expand.as_ref().and_then(|expand| expand.of_mut(self));
        expand.map_or(Ok(()), |it| it.expand(rules))
    }

    /// Prepares for a check of the script: nothing is expanded or shown, and read methods return results as for level
    /// ground.
    pub fn sketch(&mut self) {
        let kind = Arc::clone(self.kind());
        if let Some(it) = kind.expand.as_ref().and_then(|expand| expand.of_mut(self)) {
            it.sketch();
        }
    }

    /// Sets the level of detail to draw in: 0 footprints, 1 blocks, 2 roofs, 3 everything.
    pub fn set_detail(&mut self, detail: u8) {
        let kind = Arc::clone(self.kind());
        if let Some(it) = kind.detail.as_ref().and_then(|capability| capability.of_mut(self)) {
            it.set_detail(detail);
        }
    }

    /// Returns the features as named layers; empty if the object has no features.
    pub fn layers(&self) -> Vec<(&'static str, Vec<Value>)> {
        self.kind().layers.as_ref().and_then(|layers| layers.of(self)).map_or_else(Vec::new, |it| it.layers())
    }

    /// Returns the report entries since the pass began.
    pub fn notes(&self) -> &[Note] {
        self.kind().report.as_ref().and_then(|report| report.of(self)).map_or(&[], |it| it.notes())
    }
}
