//! What every object has.

use std::any::Any;
use std::sync::Arc;

use super::capability::{Draw, Expand, HasLayers, LevelOfDetail, Report, Show, Warn};
use super::{Drawing, Kind, Note, Rewriter, Value};
use burgeon_base::error::Result;
use burgeon_base::warning::Warning;
use burgeon_scene::Scene;

/// Something that a script can make and ask, and that the modules of a chain may draw with.
///
/// What only some can do, such as to draw, is a [`Capability`](super::Capability) of their [`Kind`].
pub trait Object: Any + Send + Sync {
    /// Its type: name, fields, methods and capabilities.
    fn kind(&self) -> &Arc<Kind>;

    /// A copy, for one chain of many.
    fn boxed(&self) -> Box<dyn Object>;

    /// Empties a drawing object before an interpretation pass.
    fn begin(&mut self) {}

    /// Remembers the frame where a branch opens.
    fn push(&mut self) {}

    /// Returns to the frame of the matching [`Object::push`].
    fn pop(&mut self) -> Result<()> {
        Ok(())
    }

    /// Closes what is still open at the end of a pass.
    fn end(&mut self) -> Result<()> {
        Ok(())
    }

    /// Takes the number that its random choices come from; chains with other seeds or features get other ones.
    fn seed(&mut self, _: u64) {}

    /// The object that it extends, whose methods and capabilities it has besides its own.
    fn base(&self) -> Option<&dyn Object> {
        None
    }

    /// The same, to change it.
    fn base_mut(&mut self) -> Option<&mut dyn Object> {
        None
    }
}

/// Capabilities of an object of an unknown type.
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

    /// Adds its drawing to `scene`, if it draws; `name` and `feature` are for its instances.
    pub fn show(&self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()> {
        self.capability::<dyn Show>().map_or(Ok(()), |it| it.show(scene, name, feature))
    }

    /// Adds its drawing to `scene` as `show` does, and may leave the object without it.
    pub fn hand_over(&mut self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()> {
        self.capability_mut::<dyn Show>().map_or(Ok(()), |it| it.hand_over(scene, name, feature))
    }

    /// Returns its [`Drawing`], which knows the module that made each part, if it draws with one.
    pub fn drawing_mut(&mut self) -> Option<&mut Drawing> {
        self.capability_mut::<dyn Draw>().map(|it| it.drawing_mut())
    }

    /// Takes the warnings since the last call.
    pub fn take_warnings(&mut self) -> Vec<Warning> {
        self.capability_mut::<dyn Warn>().map_or_else(Vec::new, |it| it.take_warnings())
    }

    /// Reports whether it expands by itself, and so needs no axiom.
    pub fn expands(&self) -> bool {
        self.kind().has_capability::<dyn Expand>()
    }

    /// Expands, if it expands by itself, what it shows.
    pub fn expand(&mut self, rules: &dyn Rewriter) -> Result<()> {
        self.capability_mut::<dyn Expand>().map_or(Ok(()), |it| it.expand(rules))
    }

    /// Prepares it for a script that is only checked: it expands and shows nothing, and answers as if it were even.
    pub fn sketch(&mut self) {
        if let Some(it) = self.capability_mut::<dyn Expand>() {
            it.sketch();
        }
    }

    /// Sets the level of detail to draw in: 0 the ground plan, 1 blocks, 2 roofs, 3 everything.
    pub fn set_detail(&mut self, detail: u8) {
        if let Some(it) = self.capability_mut::<dyn LevelOfDetail>() {
            it.set_detail(detail);
        }
    }

    /// Returns its features as layers, by name, if it has any.
    pub fn layers(&self) -> Vec<(&'static str, Vec<Value>)> {
        self.capability::<dyn HasLayers>().map_or_else(Vec::new, |it| it.layers())
    }

    /// Returns the notes on what it did otherwise than asked since the pass began.
    pub fn notes(&self) -> &[Note] {
        self.capability::<dyn Report>().map_or(&[], |it| it.notes())
    }
}
