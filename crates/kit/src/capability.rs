//! Capabilities of types of objects, as their kinds declare them.
//!
//! A capability is a trait that some types of objects implement. A new capability is a trait, and
//! [`Kind::can`](super::Kind::can) with [`capability!`](crate::capability!) at each type that has it.

use std::any::{Any, TypeId};
use std::sync::Arc;

use super::{Drawing, Note, Object, Rewriter, Value};
use burgeon_base::error::Result;
use burgeon_base::warning::Warning;
use burgeon_scene::Scene;

/// Access to an object as one that implements the trait `C`.
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
    /// Creates a capability of two functions that convert an object. [`capability!`](crate::capability!) writes them.
    pub fn new(of: fn(&dyn Object) -> Option<&C>, of_mut: fn(&mut dyn Object) -> Option<&mut C>) -> Self {
        Self { of, of_mut }
    }

    /// Returns the object as a `C`, or `None` if neither its type nor a type that it extends declares the capability.
    pub fn of<'a>(&self, object: &'a dyn Object) -> Option<&'a C> {
        (self.of)(object)
    }

    /// Returns the object as a mutable `C`, as [`Capability::of`] does.
    pub fn of_mut<'a>(&self, object: &'a mut dyn Object) -> Option<&'a mut C> {
        (self.of_mut)(object)
    }
}

/// Creates the [`Capability`] of a trait for a type of object: `capability!(Extruder: Warn)`.
#[macro_export]
macro_rules! capability {
    ($object:ty: $capability:path) => {
        $crate::Capability::<dyn $capability>::new(
            |object| $crate::declare::as_ref::<$object>(object).map(|it| it as &dyn $capability),
            |object| $crate::declare::as_mut::<$object>(object).map(|it| it as &mut dyn $capability),
        )
    };
}

/// Capabilities of a kind, at most one of each trait.
#[derive(Clone, Default)]
pub struct Capabilities(Vec<(TypeId, Arc<dyn Any + Send + Sync>)>);

impl Capabilities {
    /// Returns the capability of the trait `C`, if it is declared.
    pub fn get<C: ?Sized + 'static>(&self) -> Option<Capability<C>> {
        let (_, capability) = self.0.iter().find(|(id, _)| *id == TypeId::of::<C>())?;
        capability.downcast_ref().copied()
    }

    /// Adds a capability, in place of an earlier one of the same trait.
    pub fn insert<C: ?Sized + 'static>(&mut self, capability: Capability<C>) {
        self.0.retain(|(id, _)| *id != TypeId::of::<C>());
        self.0.push((TypeId::of::<C>(), Arc::new(capability)));
    }
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

/// Compares, shows and reads an object by its content, as a value: two equal ones stand for one another.
pub trait ObjectContent {
    /// Returns true if `other` has the same type and the same content.
    fn equals(&self, other: &dyn Object) -> bool;

    /// Adds the content to a hash, so that equal objects add the same.
    fn hash(&self, state: &mut dyn std::hash::Hasher);

    /// Returns a short text of the content for messages and traces.
    fn text(&self) -> String;

    /// Returns the object as a position (m), if it is one point.
    fn position(&self) -> Option<glam::DVec3>;

    /// Returns the parts that `fragment` replaces a module by; `None` if the object has no parts.
    fn fragments(&self) -> Option<Vec<Value>>;
}

/// Has fields that scripts read without a call.
pub trait Members {
    /// Returns the value of the field `name`, if the object has it.
    fn member(&self, name: &str) -> Option<Value>;
}
