//! What every object has.

use std::any::Any;
use std::sync::Arc;

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

/// What the capabilities of its kind make of an object whose type is not known.
impl dyn Object {
    /// The number of triangles drawn so far, for the limit; an instance counts as one.
    pub fn triangles(&self) -> usize {
        self.kind().show.as_ref().and_then(|show| show.of(self)).map_or(0, |it| it.triangles())
    }

    /// Adds what it has drawn to `scene`, if it draws; `name` and `feature` are for its instances.
    pub fn show(&self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()> {
        let show = self.kind().show.as_ref().and_then(|show| show.of(self));
        show.map_or(Ok(()), |it| it.show(scene, name, feature))
    }

    /// As `show`, but may give away what it has drawn, for nobody will look at the object again.
    pub fn hand_over(&mut self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()> {
        let kind = Arc::clone(self.kind());
        let show = kind.show.as_ref().and_then(|show| show.of_mut(self));
        show.map_or(Ok(()), |it| it.hand_over(scene, name, feature))
    }

    /// Where it draws, if it draws with a [`Drawing`]: then people can ask which module made what.
    pub fn drawing_mut(&mut self) -> Option<&mut Drawing> {
        let kind = Arc::clone(self.kind());
        kind.draw.as_ref()?.of_mut(self).map(|it| it.drawing_mut())
    }

    /// Gives away what people should know of how it was made, and of what it was asked since it was asked this last.
    pub fn take_warnings(&mut self) -> Vec<Warning> {
        let warn = self.kind().warn;
        warn.and_then(|warn| warn.of_mut(self)).map_or_else(Vec::new, |it| it.take_warnings())
    }

    /// Whether it expands what it shows by itself, and so can stand without an axiom.
    pub fn expands(&self) -> bool {
        self.kind().expand.is_some()
    }

    /// Expands what it was last asked to show, if it does so by itself.
    pub fn expand(&mut self, rules: &dyn Rewriter) -> Result<()> {
        let kind = Arc::clone(self.kind());
        let expand = kind.expand.as_ref().and_then(|expand| expand.of_mut(self));
        expand.map_or(Ok(()), |it| it.expand(rules))
    }

    /// Takes that its script is only checked: nothing is expanded or shown, and it answers as if it were even.
    pub fn sketch(&mut self) {
        let kind = Arc::clone(self.kind());
        if let Some(it) = kind.expand.as_ref().and_then(|expand| expand.of_mut(self)) {
            it.sketch();
        }
    }

    /// Takes the level of detail to draw in: 0 the ground plan, 1 blocks, 2 roofs, 3 everything.
    pub fn set_detail(&mut self, detail: u8) {
        let kind = Arc::clone(self.kind());
        if let Some(it) = kind.detail.as_ref().and_then(|capability| capability.of_mut(self)) {
            it.set_detail(detail);
        }
    }

    /// Its features as layers, by name, if it has any.
    pub fn layers(&self) -> Vec<(&'static str, Vec<Value>)> {
        self.kind().layers.as_ref().and_then(|layers| layers.of(self)).map_or_else(Vec::new, |it| it.layers())
    }

    /// What it had to do otherwise than it was asked since the pass began.
    pub fn notes(&self) -> &[Note] {
        self.kind().report.as_ref().and_then(|report| report.of(self)).map_or(&[], |it| it.notes())
    }
}
