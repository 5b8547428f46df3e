//! Attributes that declare a type of object, and what scripts can do with it.
//!
//! Input: an `impl` block or a struct, as anyone would write it. Output: the same, and what the contract of
//! objects, the crate `burgeon_kit`, needs to know of it. They never read a file, and keep nothing.

mod attribute;
mod doc;
mod draw;
mod fields;
mod methods;
mod object;
mod object_arguments;

use proc_macro::TokenStream;

/// Declares the methods of an object type: an `impl` block whose methods scripts can call.
///
/// It takes the name of the type in scripts, and the path of the contract where that is not `::burgeon_kit`:
/// `#[methods("beads", crate = burgeon::kit)]`. The block stays as it is; besides, the type gets `methods`, which lists
/// them. `&self` methods may be called while rewriting, `&mut self` ones while interpreting. Arguments are of types
/// that implement `Parameter`, results of types that implement `Answer`.
///
/// Every method is public, takes `self`, has no type parameters, and has a doc comment, which is also its help in
/// scripts. An argument's unit is the one in round brackets after its name in the doc, "by `height` (m)", and so is its
/// default: "over `margin` (m, 5 unless given)".
///
/// ```
/// # use burgeon_kit::{methods, object};
/// /// A tower.
/// #[object("tower")]
/// pub struct Tower {
///     height: f64,
/// }
///
/// #[methods("tower")]
/// impl Tower {
///     /// Raises it by `height` (m).
///     pub fn raise(&mut self, height: f64) {
///         self.height += height;
///     }
/// }
///
/// assert_eq!(Tower::methods()[0].doc, "Raises it by `height` (m).");
/// ```
///
/// What else the type can do stands in a second block. These are refused: a method that scripts could not call,
///
/// ```compile_fail
/// # use burgeon_kit::{methods, object};
/// # /// A tower.
/// # #[object("tower")]
/// # pub struct Tower {
/// #     height: f64,
/// # }
/// #[methods("tower")]
/// impl Tower {
///     /// Raises it by `height` (m).
///     fn raise(&mut self, height: f64) {
///         self.height += height;
///     }
/// }
/// ```
///
/// and one of which nobody would know what it does.
///
/// ```compile_fail
/// # use burgeon_kit::{methods, object};
/// # /// A tower.
/// # #[object("tower")]
/// # pub struct Tower {
/// #     height: f64,
/// # }
/// #[methods("tower")]
/// impl Tower {
///     pub fn raise(&mut self, height: f64) {
///         self.height += height;
///     }
/// }
/// ```
#[proc_macro_attribute]
pub fn methods(arguments: TokenStream, item: TokenStream) -> TokenStream {
    attribute::expand(arguments.into(), item.into(), methods::expand).into()
}

/// Declares the table that a constructor or a method takes: a struct with documented, defaulted fields.
///
/// It takes what the table is for, which messages name, and the path of the contract where that is not
/// `::burgeon_kit`: `#[fields("beads", crate = burgeon::kit)]`. The struct gets `Debug`, `Clone`, `Default`, `fields`, which
/// lists them, and `from_table`, which refuses unknown names and wrong types.
///
/// Every field is public, has a type that implements `Parameter`, and has a doc comment with the unit in round
/// brackets. A field that is left out is what its `#[default(...)]` says, or the `Default` of its type.
///
/// ```
/// # use burgeon_kit::fields;
/// /// What `tower { ... }` takes.
/// #[fields("tower")]
/// pub struct TowerOptions {
///     /// How high it is (m).
///     #[default(12.0)]
///     pub height: f64,
///     /// Whether it has a bell.
///     pub bell: bool,
/// }
///
/// assert_eq!(TowerOptions::default().height, 12.0);
/// assert_eq!(TowerOptions::fields()[0].unit.as_deref(), Some("m"));
/// ```
///
/// A field that scripts could not give is refused, as is one without a doc comment.
///
/// ```compile_fail
/// # use burgeon_kit::fields;
/// /// What `tower { ... }` takes.
/// #[fields("tower")]
/// pub struct TowerOptions {
///     /// How high it is (m).
///     #[default(12.0)]
///     height: f64,
/// }
/// ```
#[proc_macro_attribute]
pub fn fields(arguments: TokenStream, item: TokenStream) -> TokenStream {
    attribute::expand(arguments.into(), item.into(), fields::expand).into()
}

/// Declares a type of object: a struct that scripts make, and ask with its `#[methods]`.
///
/// It takes the name of the type in scripts. The struct gets `Clone`, `kind`, which scripts and a registry know it by, and
/// `Object`. The first paragraph of its doc comment is its help in scripts.
///
/// Its public fields are what the constructor takes, as those of `#[fields]`: each has a doc comment, and a default. The
/// others are its state, which begins with their defaults. It gets `Default`, `fields` and `from_table` for that.
///
/// ```
/// # use burgeon_kit::{Drawing, Object, methods, object};
/// /// A tower.
/// #[object("tower", draws, begins_empty)]
/// pub struct Tower {
///     /// How high it is at first (m).
///     #[default(12.0)]
///     pub height: f64,
///     floors: u32,
///     drawing: Drawing,
/// }
///
/// #[methods("tower")]
/// impl Tower {
///     /// Adds a floor.
///     pub fn add(&mut self) {
///         self.floors += 1;
///     }
/// }
///
/// assert_eq!((&*Tower::kind().name, &*Tower::kind().doc), ("tower", "A tower."));
/// let mut tower = Tower::default();
/// tower.add();
/// tower.begin();
/// assert_eq!((tower.height, tower.floors), (12.0, 0));
/// ```
///
/// After the name, in any order:
///
/// - `draws`: it draws in its field of type `Drawing`;
/// - `can(Warn, Report)`: traits that it implements, as which the engine uses it: `Show`, `Expand`, `LevelOfDetail`,
///   `HasLayers`, `Report`, `Warn`, and any other one;
/// - `begins_empty`: each pass begins as if there had been none before. Its state gets its defaults again, a drawing keeps
///   its memory;
/// - `first = "field"`, `example = "..."`, `functions = list`, `gathers = function`, `prefetches = function`, as its `Kind` takes them;
/// - `deprecates("height", "1.3", "size")`: a name that will go, since when, and what is used instead; as often as needed;
/// - `make = function`: the function of the type that makes one of a script's `&Table`, where there is more to do than to
///   read it;
/// - `options = TowerOptions`: the constructor takes the fields of that struct, which has `#[fields]`, and `new` makes one
///   of it, unless `make` names another function. Public fields are no matter of scripts then;
/// - `loader = ...`: it is made of a file; `given`: something else gives it;
/// - what the engine calls, and the method of the type that does it: `begin = restart`, and in the same way `push`, `pop`,
///   `end` and `seed`;
/// - `crate = burgeon::kit`: the path of the contract, where that is not `::burgeon_kit`.
///
/// These are refused: a type of which nobody would know what it is,
///
/// ```compile_fail
/// # use burgeon_kit::{methods, object};
/// #[object("tower")]
/// pub struct Tower {}
/// # #[methods("tower")]
/// # impl Tower {}
/// ```
///
/// one that draws nowhere,
///
/// ```compile_fail
/// # use burgeon_kit::{methods, object};
/// /// A tower.
/// #[object("tower", draws)]
/// pub struct Tower {}
/// # #[methods("tower")]
/// # impl Tower {}
/// ```
///
/// one that says it can do what it cannot,
///
/// ```compile_fail,E0277
/// # use burgeon_kit::{methods, object};
/// /// A tower.
/// #[object("tower", can(burgeon_kit::Expand))]
/// pub struct Tower {}
/// # #[methods("tower")]
/// # impl Tower {}
/// ```
///
/// and one that names a method it does not have.
///
/// ```compile_fail,E0599
/// # use burgeon_kit::{methods, object};
/// /// A tower.
/// #[object("tower", begin = restart)]
/// pub struct Tower {}
/// # #[methods("tower")]
/// # impl Tower {}
/// ```
#[proc_macro_attribute]
pub fn object(arguments: TokenStream, item: TokenStream) -> TokenStream {
    attribute::expand(arguments.into(), item.into(), object::expand).into()
}
