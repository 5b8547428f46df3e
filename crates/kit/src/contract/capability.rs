//! Capabilities of types of objects, as their kinds declare them.
//!
//! A capability is a trait that some types of objects implement. A new capability is a trait, and
//! [`Kind::can`](crate::Kind::can) with [`capability!`](crate::capability!) at each type that has it.

use std::any::{Any, TypeId};
use std::sync::Arc;

use crate::{Drawing, Object, Rewriter, Value};
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
    /// Creates a capability of two functions that convert an object. [`capability!`](crate::capability!) writes them.
    pub fn new(of: fn(&dyn Object) -> Option<&C>, of_mut: fn(&mut dyn Object) -> Option<&mut C>) -> Self {
        Self { of, of_mut }
    }

    /// Returns the object as a `C`, or `None` if neither its type nor a type that it extends declares the capability.
    pub fn of<'a>(&self, object: &'a dyn Object) -> Option<&'a C> {
        (self.of)(object)
    }

    /// Returns the object's capability for changes, as [`Self::of`] does.
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
    /// Returns the report entries since the pass began, of the kind
    /// [`SimplifiedFeature`](burgeon_base::WarningKind::SimplifiedFeature).
    fn notes(&self) -> &[Warning];
}

/// Capability to provide features for layered files.
pub trait HasLayers {
    /// Returns the layers with their names. A layer is a list of features as scripts see them: tables with an id, a
    /// geometry and attributes.
    fn layers(&self) -> Vec<(&'static str, Vec<Value>)>;
}

/// Function that shares data between all objects of a system, once they all exist and before the first query by a rule.
pub type Gather = fn(&mut [Box<dyn Object>]);

/// Compares, shows and reads an object by its content, as a value: two equal ones stand for one another.
pub trait ObjectContent {
    /// Returns true if `other` has the same type and the same content.
    fn equals(&self, other: &dyn Object) -> bool;

    /// Adds the content to a hash, so that equal objects add the same.
    fn hash(&self, state: &mut dyn std::hash::Hasher);

    /// Returns a short text of the content for messages and traces.
    fn text(&self) -> String;

    /// Returns the approximate memory of the content (bytes).
    fn memory(&self) -> usize;

    /// Returns the object as a position (m), if it is one point.
    fn position(&self) -> Option<glam::DVec3>;

    /// Returns the parts that `fragment` replaces a module by; `None` if the object has no parts.
    fn fragments(&self) -> Option<Vec<Value>>;
}

/// Capability to be divided into parts, which become modules without a value of Lua for each part.
pub trait IntoParts {
    /// Prepares a method with these arguments, all of whose results are parts; `None` for other methods, and for arguments that
    /// the method refuses.
    fn prepare_parts(&self, method: &str, arguments: &[Value]) -> Option<PartMaker>;
}

/// Function that divides an object into parts, each with the number of the entry, such as the size of a split, that made it, from 0.
pub type PartMaker = Arc<dyn Fn(&dyn Object) -> Result<Vec<(u32, Arc<dyn Object>)>> + Send + Sync>;
