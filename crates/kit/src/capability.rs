//! Capabilities that only some object types have, as their kinds declare them.

use super::declare::{as_mut, as_ref};
use super::{Drawing, Note, Object, Rewriter, Value};
use burgeon_base::error::Result;
use burgeon_base::warning::Warning;
use burgeon_scene::Scene;

/// Conversion of an object to the capability `C`.
pub struct Capability<C: ?Sized + 'static> {
    of: fn(&dyn Object) -> Option<&C>,
    of_mut: fn(&mut dyn Object) -> Option<&mut C>,
}

impl<C: ?Sized> Clone for Capability<C> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<C: ?Sized> Copy for Capability<C> {}

impl<C: ?Sized> Capability<C> {
    /// Returns the object's capability. `None` if neither the object's type nor a base type of it is the type whose
    /// kind declared the capability.
    pub fn of<'a>(&self, object: &'a dyn Object) -> Option<&'a C> {
        (self.of)(object)
    }

    /// Returns the object's capability for changes, as [`Self::of`] does.
    pub fn of_mut<'a>(&self, object: &'a mut dyn Object) -> Option<&'a mut C> {
        (self.of_mut)(object)
    }
}

/// Creates the capability `dyn $capability` of objects of type `$object`.
macro_rules! capability {
    ($object:ident: $capability:ident) => {
        Capability {
            of: |object| as_ref::<$object>(object).map(|it| it as &dyn $capability),
            of_mut: |object| as_mut::<$object>(object).map(|it| it as &mut dyn $capability),
        }
    };
}

pub(super) fn show<T: Object + Show>() -> Capability<dyn Show> {
    capability!(T: Show)
}

pub(super) fn draw<T: Object + Draw>() -> Capability<dyn Draw> {
    capability!(T: Draw)
}

pub(super) fn expand<T: Object + Expand>() -> Capability<dyn Expand> {
    capability!(T: Expand)
}

pub(super) fn detail<T: Object + LevelOfDetail>() -> Capability<dyn LevelOfDetail> {
    capability!(T: LevelOfDetail)
}

pub(super) fn layers<T: Object + HasLayers>() -> Capability<dyn HasLayers> {
    capability!(T: HasLayers)
}

pub(super) fn warn<T: Object + Warn>() -> Capability<dyn Warn> {
    capability!(T: Warn)
}

pub(super) fn report<T: Object + Report>() -> Capability<dyn Report> {
    capability!(T: Report)
}

/// Capability to add content to the scene.
pub trait Show {
    /// Returns the number of triangles drawn so far, for the limit. An instance counts as one.
    fn triangles(&self) -> usize {
        0
    }

    /// Adds the drawn content to `scene`; `name` and `feature` are for the instances.
    fn show(&self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()>;

    /// Adds the drawn content like [`Show::show`], but may move it out of the object, because the object is not used
    /// again.
    fn hand_over(&mut self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()> {
        self.show(scene, name, feature)
    }
}

/// Capability to draw with a [`Drawing`]. The engine then shows the drawing, counts its triangles and traces which
/// module drew which part. `#[object]` implements it for a struct with one field of that type.
pub trait Draw {
    /// Returns the drawing.
    fn drawing(&self) -> &Drawing;

    /// Returns the drawing for changes.
    fn drawing_mut(&mut self) -> &mut Drawing;
}

impl<T: Draw> Show for T {
    fn triangles(&self) -> usize {
        self.drawing().triangles()
    }

    fn show(&self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()> {
        self.drawing().clone().show(scene, name, feature)
    }

    fn hand_over(&mut self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()> {
        std::mem::take(self.drawing_mut()).show(scene, name, feature)
    }
}

/// Capability to expand the shown content automatically, so the object needs no axiom.
pub trait Expand {
    /// Expands the content that was last requested, before the first pass and after each pass; `rules` are the rules of
    /// other systems.
    fn expand(&mut self, rules: &dyn Rewriter) -> Result<()>;

    /// Prepares for a check of the script: nothing is expanded or shown, and read methods return results as for level
    /// ground.
    fn sketch(&mut self);
}

/// Capability to draw in several levels of detail.
pub trait LevelOfDetail {
    /// Sets the level of detail to draw in: 0 footprints, 1 blocks, 2 roofs, 3 everything.
    fn set_detail(&mut self, detail: u8);
}

/// Capability to warn. The engine adds the line of the preceding call.
pub trait Warn {
    /// Takes the warnings about the object's construction and about the calls since the last time.
    fn take_warnings(&mut self) -> Vec<Warning>;
}

/// Capability to report results that differ from the request.
pub trait Report {
    /// Returns the report entries since the pass began.
    fn notes(&self) -> &[Note];
}

/// Capability to provide features for layered files.
pub trait HasLayers {
    /// Returns the layers with their names. A layer is a list of features as scripts see them: tables with an id, a
    /// geometry and attributes.
    fn layers(&self) -> Vec<(&'static str, Vec<Value>)>;
}

/// Function that shares data between all objects of a system, once they all exist and before the first query by a rule.
pub type Gather = fn(&mut [Box<dyn Object>]);
