//! Interface of all objects.

use std::any::Any;
use std::sync::Arc;

use super::capability::{Draw, Expand, HasLayers, LevelOfDetail, Report, Show, Warn};
use crate::{Drawing, Kind, Rewriter, Value};
use burgeon_base::error::Result;
use burgeon_base::warning::Warning;
use burgeon_scene::Scene;

/// An object that scripts can make and read, and that the modules of a chain can draw with.
///
/// Optional abilities, such as drawing, are [`Capability`](crate::Capability) values of its [`Kind`].
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
    /// Returns the object as one with the capability `C`, if it has it.
    pub fn capability<C: ?Sized + 'static>(&self) -> Option<&C> {
        self.kind().capability::<C>()?.of(self)
    }

    /// Returns the object as a mutable one with the capability `C`, if it has it.
    pub fn capability_mut<C: ?Sized + 'static>(&mut self) -> Option<&mut C> {
        self.kind().capability::<C>()?.of_mut(self)
    }

    /// Returns the number of triangles drawn so far, for the limit; an instance counts as one.
    pub fn triangles(&self) -> usize {
        self.capability::<dyn Show>().map_or(0, |it| it.triangles())
    }

    /// Adds the drawn content to `scene`, if the object draws; `name` and `feature` are for its instances.
    pub fn show(&self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()> {
        self.capability::<dyn Show>().map_or(Ok(()), |it| it.show(scene, name, feature))
    }

    /// Adds the drawn content like `show`, but may move it out of the object, because the object is not used again.
    pub fn hand_over(&mut self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()> {
        self.capability_mut::<dyn Show>().map_or(Ok(()), |it| it.hand_over(scene, name, feature))
    }

    /// Returns the drawing, if the object draws with a [`Drawing`]. Such drawings can be traced to the modules that
    /// made them.
    pub fn drawing_mut(&mut self) -> Option<&mut Drawing> {
        self.capability_mut::<dyn Draw>().map(|it| it.drawing_mut())
    }

    /// Takes the warnings about the object's construction and about the calls since the last time.
    pub fn take_warnings(&mut self) -> Vec<Warning> {
        self.capability_mut::<dyn Warn>().map_or_else(Vec::new, |it| it.take_warnings())
    }

    /// Returns true if the object expands its content automatically, so it needs no axiom.
    pub fn expands(&self) -> bool {
        self.kind().has_capability::<dyn Expand>()
    }

    /// Expands the content that was last requested, if the object has the capability.
    pub fn expand(&mut self, rules: &dyn Rewriter) -> Result<()> {
        self.capability_mut::<dyn Expand>().map_or(Ok(()), |it| it.expand(rules))
    }

    /// Prepares for a check of the script: nothing is expanded or shown, and read methods return results as for level
    /// ground.
    pub fn sketch(&mut self) {
        if let Some(it) = self.capability_mut::<dyn Expand>() {
            it.sketch();
        }
    }

    /// Sets the level of detail to draw in: 0 footprints, 1 blocks, 2 roofs, 3 everything.
    pub fn set_detail(&mut self, detail: u8) {
        if let Some(it) = self.capability_mut::<dyn LevelOfDetail>() {
            it.set_detail(detail);
        }
    }

    /// Returns the features as named layers; empty if the object has no features.
    pub fn layers(&self) -> Vec<(&'static str, Vec<Value>)> {
        self.capability::<dyn HasLayers>().map_or_else(Vec::new, |it| it.layers())
    }

    /// Returns the report entries since the pass began.
    pub fn notes(&self) -> &[Warning] {
        self.capability::<dyn Report>().map_or(&[], |it| it.notes())
    }
}
