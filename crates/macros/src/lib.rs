//! Attributes that declare what scripts can do with a type of object, and where it draws.
//!
//! Comes in: an `impl` block or a struct, as anyone would write it. Goes out: the same, and what the contract of
//! objects, the crate `burgeon_kit`, needs to know of it. They never read a file, and keep nothing.

mod attribute;
mod doc;
mod draw;
mod fields;
mod methods;

use proc_macro::TokenStream;

/// Declares the methods of an object type: an `impl` block whose methods scripts can call.
///
/// It takes the name of the type in scripts, and the path of the contract where that is not `::burgeon_kit`:
/// `#[methods("beads", crate = burgeon::kit)]`. The block stays as it is; besides, the type gets `methods`, which lists
/// them. `&self` methods may be called while rewriting, `&mut self` ones while interpreting. Arguments are of types
/// that implement `Parameter`, results of types that implement `Answer`.
///
/// Every method is public, takes `self`, has no type parameters, and has a doc comment, which is also its help in
/// scripts. An argument's unit is the one in round brackets after its name in the doc: "by `height` (m)".
///
/// ```
/// # use std::sync::Arc;
/// # use burgeon_kit::{Kind, Object, methods};
/// #[derive(Clone)]
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
/// # impl Object for Tower {
/// #     fn kind(&self) -> &Arc<Kind> { unreachable!() }
/// #     fn boxed(&self) -> Box<dyn Object> { Box::new(self.clone()) }
/// # }
/// assert_eq!(Tower::methods()[0].doc, "Raises it by `height` (m).");
/// ```
///
/// What else the type can do stands in a second block. These are refused: a method that scripts could not call,
///
/// ```compile_fail
/// # use std::sync::Arc;
/// # use burgeon_kit::{Kind, Object, methods};
/// # #[derive(Clone)]
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
/// # impl Object for Tower {
/// #     fn kind(&self) -> &Arc<Kind> { unreachable!() }
/// #     fn boxed(&self) -> Box<dyn Object> { Box::new(self.clone()) }
/// # }
/// ```
///
/// and one of which nobody would know what it does.
///
/// ```compile_fail
/// # use std::sync::Arc;
/// # use burgeon_kit::{Kind, Object, methods};
/// # #[derive(Clone)]
/// # pub struct Tower {
/// #     height: f64,
/// # }
/// #[methods("tower")]
/// impl Tower {
///     pub fn raise(&mut self, height: f64) {
///         self.height += height;
///     }
/// }
/// # impl Object for Tower {
/// #     fn kind(&self) -> &Arc<Kind> { unreachable!() }
/// #     fn boxed(&self) -> Box<dyn Object> { Box::new(self.clone()) }
/// # }
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

/// Says where an object has its drawing: `Draw` for a struct with one field of type `Drawing`.
///
/// The path of the contract, where that is not `::burgeon_kit`, stands beside it: `#[draw(crate = burgeon::kit)]`.
///
/// ```
/// # use std::sync::Arc;
/// # use burgeon_kit::{Draw, Drawing, Kind, Object};
/// #[derive(Clone, Draw)]
/// pub struct Tower {
///     height: f64,
///     drawing: Drawing,
/// }
///
/// let tower = Tower { height: 12.0, drawing: Drawing::default() };
/// assert_eq!(tower.drawing().triangles(), 0);
/// ```
///
/// Without a drawing there is nothing to say.
///
/// ```compile_fail
/// # use burgeon_kit::Draw;
/// #[derive(Draw)]
/// pub struct Tower {
///     height: f64,
/// }
/// ```
#[proc_macro_derive(Draw, attributes(draw))]
pub fn draw(item: TokenStream) -> TokenStream {
    draw::expand(item.into()).unwrap_or_else(syn::Error::into_compile_error).into()
}
