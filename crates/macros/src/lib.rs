//! Attributes that declare an object type and its scripting API.
//!
//! Input: an ordinary `impl` block or struct. Output: the same item, and the description that the contract of objects,
//! the crate `burgeon_kit`, needs. The attributes never read files, and keep no state.

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
/// The arguments are the name of the type in scripts, and the path of the contract if it is not `::burgeon_kit`:
/// `#[methods("beads", crate = burgeon::kit)]`. The block is kept unchanged. In addition, the type gets `methods`,
/// which lists the methods. `&self` methods are read methods, which rules can call; `&mut self` methods are write
/// methods, which only interpretations can call. Arguments have types that implement `Parameter`, results have types
/// that implement `Answer`.
///
/// Every method is public, takes `self`, has no type parameters, and has a doc comment, which is also its help in
/// scripts. The doc gives the unit of an argument in round brackets after the argument's name, "by `height` (m)", and
/// likewise its default: "over `margin` (m, 5 unless given)".
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
/// Other methods of the type belong in a second block. The attribute refuses a method that scripts cannot call,
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
/// and a method without documentation.
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
/// The arguments are the owner of the table for messages, and the path of the contract if it is not `::burgeon_kit`:
/// `#[fields("beads", crate = burgeon::kit)]`. The struct gets `Debug`, `Clone`, `Default`, `fields`, which lists the
/// fields, and `from_table`, which refuses unknown names and wrong types.
///
/// Every field is public, has a type that implements `Parameter`, and has a doc comment with the unit in round
/// brackets. An omitted field has the value of its `#[default(...)]`, or the `Default` of its type.
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
/// The attribute refuses a field that scripts cannot set, or that has no doc comment.
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

/// Declares an object type: a struct that scripts construct, and whose `#[methods]` they call.
///
/// The first argument is the name of the type in scripts. The struct gets `Clone`, `Object`, and `kind`, the
/// description for scripts and registries. The first paragraph of its doc comment is its help in scripts.
///
/// Its public fields are the fields of the constructor, as with `#[fields]`: each has a doc comment and a default. The
/// other fields are its state, which begins with their defaults. For this purpose the struct gets `Default`, `fields`
/// and `from_table`.
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
/// - capabilities, named as the methods of `Kind`: `draws` (in its field of type `Drawing`), `shows`, `expands`,
///   `has_detail`, `has_layers`, `reports` and `warns`. Each except `draws` requires an implementation of its trait;
/// - `begins_empty`: each pass discards the results of earlier passes. The state is reset to its defaults; a drawing
///   keeps its memory;
/// - `first = "field"`, `example = "..."`, `gathers = function`, `prefetches = function`, as its `Kind` takes them;
/// - `deprecates("height", "1.3", "size")`: a deprecated name, the version that deprecates it, and its replacement; can
///   be repeated;
/// - `renames("height", "1.3", "size")`: the former name of a field or method, the version that deprecates it, and the
///   present name; can be repeated. Scripts can still use the former name;
/// - `make = function`: the function of the type that makes an object from a script's `&Table`, if reading the fields
///   is not enough;
/// - `options = TowerOptions`: the constructor takes the fields of that struct, which has `#[fields]`, and `new` makes
///   an object from the struct, unless `make` names another function. Scripts then cannot set public fields;
/// - `loader = ...`: objects are loaded from files; `given`: scripts cannot construct objects, and receive them from
///   elsewhere;
/// - hooks that the engine calls, with the method of the type that implements them: `begin = restart`, and likewise
///   `push`, `pop`, `end` and `seed`;
/// - `crate = burgeon::kit`: the path of the contract, if it is not `::burgeon_kit`.
///
/// The attribute refuses a type without documentation,
///
/// ```compile_fail
/// # use burgeon_kit::{methods, object};
/// #[object("tower")]
/// pub struct Tower {}
/// # #[methods("tower")]
/// # impl Tower {}
/// ```
///
/// a type that draws but has no drawing,
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
/// a type that declares a capability without implementing it,
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
/// and a type that names a missing method.
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
