//! Burgeon: procedural modelling by rewriting. Rules are written in Lua, geometry is made in Rust.
//!
//! ```text
//! script.lua ──► script ──► rules ──────► derive ⇄ interpret ──────────► scene ──────► export | picture | live
//!     ▲          (Lua VMs)  (grammar,     (parallel  (rules change       (meshes,      (glTF, OBJ, SVG, PNG,
//!   watch                    immutable)    rewriting) object state)       instances)    a page in the browser)
//!  (on a save,                                 ▲          ▲
//!   again)                                     └─ objects ┘  read-only while rewriting, mutable while
//!                                                    ▲       interpreting
//!                                                    └────── geometry
//! ```
//!
//! This crate is the program and the way into the house: its parts are members of the workspace, under `crates/`. Each
//! uses only those that stand before it on this map, which a test holds against the `use` lines:
//!
//! ```text
//! base       uses ──► nothing
//! macros     uses ──► nothing
//! scene      uses ──► base
//! geometry   uses ──► base, scene
//! spatial    uses ──► base, geometry
//! streets    uses ──► base, geometry
//! data       uses ──► base, spatial
//! query      uses ──► base, data, geometry, spatial
//! kit        uses ──► base, data, geometry, macros, scene, spatial
//! language   uses ──► kit
//! terrain    uses ──► base, geometry, kit, scene
//! objects    uses ──► base, data, geometry, kit, scene, streets, terrain
//! packages   uses ──► base
//! analysis   uses ──► base, kit, language, packages
//! engine     uses ──► analysis, base, data, kit, language, packages, query, scene
//! picture    uses ──► base, scene
//! export     uses ──► base, data, picture, scene
//! watch      uses ──► base
//! presets    uses ──► base, engine, export, watch
//! variations uses ──► base, engine, kit, picture, scene
//! live       uses ──► base, engine, export, kit, picture, presets, scene, variations, watch
//! burgeon    uses ──► base, data, engine, export, geometry, kit, language, live, objects, packages, picture, presets, query, scene, spatial, terrain, variations, watch
//! ```
//!
//! - [`error`], [`warning`](mod@warning) and [`text`]: what a person is told when something is wrong, and when
//!   something hardly can be meant. [`Stop`] ends work that nobody waits for; a [`Budget`] is what reading foreign bytes
//!   may take.
//! - [`scene`]: a [`Scene`](scene::Scene) of meshes and instances, ready to be written.
//! - [`geometry`]: lines, rings and polygons, frames, cross-sections, sweeps, straight skeletons and roofs, without rules
//!   or scripts.
//! - [`spatial`]: a [`Geometry`](spatial::Geometry) as a value, with the operations of OGC Simple Features.
//! - [`sources`]: data files, read into a [`Layer`](sources::Layer) of features in metres, or into a
//!   [`Relief`](sources::elevation::Relief) of measured heights.
//! - [`query`]: SQL over layers, in a database within the program: a [`Database`](query::Database) gives a
//!   [`QueryAnswer`](query::QueryAnswer).
//! - [`kit`]: the contract of objects. A [`Kind`](kit::Kind) in a [`Registry`](kit::Registry) says what an
//!   [`Object`](kit::Object) can do; a [`Grammar`](rewriting::Grammar) of [`Pattern`](rewriting::Pattern)s matches
//!   along a [`Chain`](rewriting::Chain), without Lua.
//! - [`language`]: what scripts can use, told once: [`names`](language::names), and the definition file for editors.
//! - [`terrain`]: a [`World`](terrain::World) that is divided by rules, the [`Ground`](terrain::Ground) that is expanded
//!   of it, a [`Globe`](terrain::globe::Globe), and the search for rules that [`fit`](terrain::fit) a height map.
//! - [`objects`]: the types of objects that come with Burgeon, in one [`registry`](objects::registry).
//! - [`script`], [`results`] and [`trace`](mod@trace), the engine, which knows no type of object by name: a
//!   [`Session`](script::Session) is one run of a script, in one [`Machine`](script::Machine) for each thread; chains are
//!   rewritten step by step into a [`DerivedSystem`](results::DerivedSystem), and interpreted in between.
//! - [`export`] and [`picture`]: the scene as a file ([`Format`](export::Format)) or an image
//!   ([`render`](picture::render)).
//! - [`packages`]: folders of scripts, models and textures that other scripts use, and the order that they come in.
//! - [`watch`]: tells when the files of a script have changed.
//! - [`presets`]: values of parameters under names, in a file beside the script.
//! - [`variations`]: many runs of a script, as thumbnails to choose from.
//! - [`live`]: a [`Live`](live::Live) server shows the scene on a page in the browser, and shows it anew on every
//!   save. It is behind the feature `live`, which is on unless turned off.
//!
//! [`run()`] goes the whole way, from a file to a scene:
//!
//! ```
//! use std::path::Path;
//!
//! use burgeon::{export, picture::Picture};
//!
//! # fn main() -> burgeon::Result<()> {
//! let run = burgeon::run(Path::new("scripts/tower.lua"), burgeon::options())?;
//! assert!(run.scene.triangles() > 0);
//! # let folder = std::env::temp_dir().join(format!("burgeon-doc-{}", std::process::id()));
//! # std::fs::create_dir_all(&folder).map_err(burgeon::Error::other)?;
//! # let path = folder.join("tower.glb");
//! export::write(&run.scene, &path, &Picture::default())?;
//! # std::fs::remove_dir_all(&folder).map_err(burgeon::Error::other)?;
//! # Ok(())
//! # }
//! ```
//!
//! # Where it takes a shorter way
//!
//! The meaning of a script is that of *The Algorithmic Beauty of Plants*. Two things are done otherwise, since that
//! is faster or more useful:
//!
//! - *Rules are prepared.* When a script is loaded, the returns of rules that are written in place, as functions
//!   within the call of `rule`, are rewritten: where the modules and branches of a return can be seen in its text,
//!   it becomes one call that writes all parameters into the columns of the next chain. The results of other
//!   returns, and of functions from elsewhere, are collected and taken apart: slower, with the same meaning. Line
//!   numbers stay as they are.
//! - *A derivation ends when nothing can change.* Not only when no rule applies: also after a step in which every
//!   rule that ran left its module as it was, if the object begins each pass empty and nothing draws random
//!   numbers. Such a step is not counted.
#![recursion_limit = "256"]

pub use burgeon_base::{
    Budget, Error, MemoryReservation, Result, Stop, Warning, WarningKind, error, locks, random, text, warning,
};
pub use burgeon_data as sources;
pub use burgeon_engine::run::{Run, RunTimes, run, run_session};
pub use burgeon_engine::{ScriptCheck, check, check_package, declared_types, declared_types_of_package};
pub use burgeon_engine::{results, script, trace};
pub use burgeon_export as export;
pub use burgeon_geometry as geometry;
pub use burgeon_kit as kit;
pub use burgeon_language as language;
#[cfg(feature = "live")]
pub use burgeon_live as live;
pub use burgeon_objects as objects;
pub use burgeon_packages as packages;
pub use burgeon_picture as picture;
pub use burgeon_presets as presets;
pub use burgeon_query as query;
pub use burgeon_rewriting as rewriting;
pub use burgeon_scene as scene;
pub use burgeon_spatial as spatial;
pub use burgeon_terrain as terrain;
pub use burgeon_variations as variations;
pub use burgeon_watch as watch;

/// How a script is run unless something else is said, with all the types of objects that come with Burgeon.
pub fn options() -> script::RunOptions {
    script::RunOptions { registry: objects::registry(), ..script::RunOptions::default() }
}
