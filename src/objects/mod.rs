//! The objects that rules read and interpretation rules change, one type to a file.
//!
//! Comes in: values from scripts. Goes out: geometry for the scene. Objects know nothing of Lua or of chains.
//!
//! A new type is a new file and one line in [`KINDS`]: a struct, `fields!` for what its constructor takes,
//! `methods!` for what scripts may call, and an implementation of [`Object`].

mod boxed;
mod colors;
#[doc(hidden)]
#[macro_use]
pub mod declare;
mod distance;
mod drawing;
mod elevation;
mod extruder;
pub mod facade;
mod features;
mod footprint;
pub(crate) mod import;
mod makers;
mod model;
mod note;
mod parameter;
pub mod planet;
mod seed;
mod streets;
mod surface;
pub mod terrain;
mod turtle;
mod universe;
mod value;

pub use boxed::Boxed;
pub use declare::{Argument, Call, Field, Kind, Method};
pub use drawing::Drawing;
pub use elevation::{Elevation, ElevationOptions};
pub use extruder::Extruder;
pub use facade::{Facade, Template, Templates, Wall};
pub use features::{Features, Shape};
pub(crate) use footprint::Ahead;
pub use footprint::{Detail, EdgeKeywords, Footprint, Rings, Roof, Walls};
pub(crate) use makers::Makers;
pub use model::Model;
pub use note::Note;
pub use parameter::{Answer, Color, Expected, Parameter, Vector};
pub use planet::Planet;
pub use seed::Seed;
pub use streets::{Lines, Streets};
pub use surface::Surface;
pub use terrain::Terrain;
pub use turtle::Turtle;
pub use universe::Universe;
pub use value::{Key, Table, Value};

use std::any::Any;

use crate::error::Result;
use crate::scene::Scene;
use crate::terrain::Divide;
use crate::warning::Warning;

/// The built-in types that scripts can construct.
pub static KINDS: &[&Kind] = &[
    &Extruder::KIND,
    &Footprint::KIND,
    &Planet::KIND,
    &Streets::KIND,
    &Terrain::KIND,
    &Turtle::KIND,
    &Universe::KIND,
    &facade::PANEL,
    &facade::BORDERED,
    &facade::EXTRUDED,
    &facade::LIST,
    &facade::GRID,
    &Template::KIND,
    &Facade::KIND,
];

/// Lets all objects of a system know of one another.
pub type Gather = fn(&mut [Box<dyn Object>]);

/// Something that a script can make and ask, and that the modules of a chain may draw with.
///
/// A method that takes `&self` may be called while rewriting, one that takes `&mut self` only while interpreting.
pub trait Object: Any + Send + Sync {
    /// Its type: name, fields and methods.
    fn kind(&self) -> &'static Kind;

    /// A copy, for one chain of many.
    fn boxed(&self) -> Box<dyn Object>;

    /// What lets all objects of a system know of one another, once there are all of them and before a rule asks.
    fn gathers(&self) -> Option<Gather> {
        None
    }

    /// Empties a drawing object before an interpretation pass.
    fn begin(&mut self) {}

    /// Whether [`Object::begin`] forgets all that earlier passes did.
    fn begins_empty(&self) -> bool {
        false
    }

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

    /// Takes the level of detail to draw in: 0 the ground plan, 1 blocks, 2 roofs, 3 everything.
    fn set_detail(&mut self, _: u8) {}

    /// Gives away what people should know of how it was made, and of what it was asked since it was asked this last.
    fn take_warnings(&mut self) -> Vec<Warning> {
        Vec::new()
    }

    /// Whether it expands what it shows by itself, and so can stand without an axiom.
    fn grows(&self) -> bool {
        false
    }

    /// Expands what it was last asked to show, before the first pass and after each; `divide` runs the rules of other
    /// systems for it.
    fn grow(&mut self, _: &dyn Divide) -> Result<()> {
        Ok(())
    }

    /// Takes that its script is only checked: nothing is expanded or shown, and it answers as if it were even.
    fn sketch(&mut self) {}

    /// What it had to do otherwise than it was asked since the pass began.
    fn notes(&self) -> &[Note] {
        &[]
    }

    /// The number of triangles drawn so far, for the limit; an instance counts as one.
    fn triangles(&self) -> usize {
        0
    }

    /// Where it draws, if it draws with a [`Drawing`]: then people can ask which module made what.
    fn drawing(&mut self) -> Option<&mut Drawing> {
        None
    }

    /// Adds what it has drawn to `scene`, if it draws; `name` and `feature` are for its instances.
    fn show(&self, _scene: &mut Scene, _name: &str, _feature: Option<&str>) -> Result<()> {
        Ok(())
    }

    /// As [`Object::show`], but may give away what it has drawn, for nobody will look at the object again.
    fn hand_over(&mut self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()> {
        self.show(scene, name, feature)
    }
}
