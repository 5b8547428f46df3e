//! What some types of objects can do and others cannot, as their kinds declare it.

use super::declare::{as_mut, as_ref};
use super::{Drawing, Note, Object, Rewriter, Value};
use burgeon_base::error::Result;
use burgeon_base::warning::Warning;
use burgeon_scene::Scene;

/// How an object is asked as one that can do `C`.
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
    /// The object as one that can; `None` if neither its type nor that of an object it extends is
    /// the one whose kind declared this.
    pub fn of<'a>(&self, object: &'a dyn Object) -> Option<&'a C> {
        (self.of)(object)
    }

    /// The same, to change it.
    pub fn of_mut<'a>(&self, object: &'a mut dyn Object) -> Option<&'a mut C> {
        (self.of_mut)(object)
    }
}

/// The capability `dyn $capability` of objects of type `$object`.
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

/// Adds something to the scene.
pub trait Show {
    /// The number of triangles drawn so far, for the limit; an instance counts as one.
    fn triangles(&self) -> usize {
        0
    }

    /// Adds what it has drawn to `scene`; `name` and `feature` are for its instances.
    fn show(&self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()>;

    /// As [`Show::show`], but may give away what it has drawn, for nobody will look at the object again.
    fn hand_over(&mut self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()> {
        self.show(scene, name, feature)
    }
}

/// Draws with a [`Drawing`], and so shows it, has its triangles counted, and tells which module made what. `#[object]`
/// writes it for a struct with one field of that type.
pub trait Draw {
    /// What it has drawn.
    fn drawing(&self) -> &Drawing;

    /// The same, to draw more.
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

/// Expands what it shows by itself, and so can stand without an axiom.
pub trait Expand {
    /// Expands what it was last asked to show, before the first pass and after each; `rules` are those of other systems.
    fn expand(&mut self, rules: &dyn Rewriter) -> Result<()>;

    /// Takes that its script is only checked: nothing is expanded or shown, and it answers as if it were even.
    fn sketch(&mut self);
}

/// Draws more or less of what it shows.
pub trait LevelOfDetail {
    /// Takes the level of detail to draw in: 0 the ground plan, 1 blocks, 2 roofs, 3 everything.
    fn set_detail(&mut self, detail: u8);
}

/// Warns, with the line of the call after which it is asked.
pub trait Warn {
    /// Gives away what people should know of how it was made, and of what it was asked since it was asked this last.
    fn take_warnings(&mut self) -> Vec<Warning>;
}

/// Tells what it had to do otherwise than it was asked.
pub trait Report {
    /// What that was since the pass began.
    fn notes(&self) -> &[Note];
}

/// Knows features, for files of layers.
pub trait HasLayers {
    /// Its layers, by name: each a list of features as scripts have them, tables with an id, a geometry and attributes.
    fn layers(&self) -> Vec<(&'static str, Vec<Value>)>;
}

/// Lets all objects of a system know of one another, once there are all of them and before a rule asks.
pub type Gather = fn(&mut [Box<dyn Object>]);
