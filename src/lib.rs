//! Burgeon: procedural modelling by rewriting. Rules are written in Lua, geometry is computed in Rust.
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
//! This crate contains the program and the public API. Its parts are crates of the workspace, under `crates/`. Each
//! crate uses only crates that precede it on this map, which a test compares with the `use` lines:
//!
//! ```text
//! base       uses ──► nothing
//! macros     uses ──► nothing
//! rewriting  uses ──► base
//! scene      uses ──► base
//! kit        uses ──► base, macros, rewriting, scene
//! geometry   uses ──► base, scene
//! shapes     uses ──► base, geometry, scene
//! streets    uses ──► base, geometry
//! spatial    uses ──► base, geometry, kit
//! data       uses ──► base, kit, spatial
//! sources    uses ──► base, data, kit, spatial
//! terrain    uses ──► base, geometry, scene
//! objects    uses ──► base, data, geometry, kit, rewriting, scene, shapes, spatial, streets, terrain
//! packages   uses ──► base
//! language   uses ──► base, kit, rewriting
//! engine     uses ──► base, kit, language, packages, rewriting, scene, spatial
//! picture    uses ──► base, scene
//! export     uses ──► base, picture, scene, spatial
//! tiles      uses ──► base, data, export, scene, spatial
//! live       uses ──► base, engine, export, picture, scene
//! burgeon    uses ──► base, engine, export, kit, language, live, objects, packages, picture, scene, sources, terrain, tiles
//! python     uses ──► base, burgeon
//! ```
//!
//! - [`error`], [`warning`](mod@warning) and [`text`]: errors, warnings and human-readable text. [`Stop`] cancels work;
//!   a [`Budget`] limits the memory and time for reading untrusted bytes.
//! - [`scene`]: a [`Scene`](scene::Scene) of meshes and instances, ready for export.
//! - [`sources`]: sources of scripts, and SQL over them: a [`Database`](sources::sql::Database) returns
//!   [`QueryRows`](kit::QueryRows).
//! - [`kit`]: the interface of objects. A [`Kind`](kit::Kind) in a [`Registry`](kit::Registry) describes the fields and
//!   methods of an [`Object`](kit::Object).
//! - [`language`]: the scripting API, described once: [`names`](language::names), and the definition file for editors.
//! - [`terrain`]: a [`World`](terrain::World) that is divided by rules, the [`Ground`](terrain::Ground) that is
//!   expanded from it, a [`Globe`](terrain::globe::Globe), and the search for rules that [`fit`](terrain::fit) a height
//!   map.
//! - [`objects`]: the object types of Burgeon, in one [`registry`](objects::registry).
//! - [`script`], [`results`] and [`trace`](mod@trace): the engine, which does not depend on specific object types. A
//!   [`Session`](script::Session) is one run of a script, with one [`Machine`](script::Machine) for each thread. Chains
//!   are rewritten step by step into a [`DerivedSystem`](results::DerivedSystem), and interpreted between the steps.
//! - [`export`] and [`picture`]: the scene as a file ([`Format`](export::Format)) or an image
//!   ([`render`](picture::render)).
//! - [`tiles`]: the features of a country as 3D Tiles. A [`TilePlan`](tiles::TilePlan) divides them, and
//!   [`make_tile`](tiles::make_tile) writes the tiles in any number of processes.
//! - [`packages`]: folders of scripts, models and textures for use by other scripts, and their load order.
//! - [`watch`]: reports changes of the files of a script.
//! - [`presets`]: named values of parameters, in a file next to the script.
//! - [`variations`]: many runs of a script, as thumbnails for comparison.
//! - [`films`]: runs of a script over the values of a parameter, and a model from all sides, as frames of a film.
//! - [`live`]: a [`Live`](live::Live) server shows the scene in the browser, and updates it on every save; a
//!   [`LiveTileset`](live::LiveTileset) shows a tileset. They require the feature `live`, which is enabled by default.
//!
//! A program without scripts uses the other crates directly:
//!
//! - `burgeon-rewriting`: L-systems without Lua. A grammar of patterns matches along a chain, and a stepper makes the next
//!   one.
//! - `burgeon-geometry`: lines, rings and polygons, frames, cross-sections, sweeps, straight skeletons and roofs.
//! - `burgeon-streets`: planar street networks, their surfaces and blocks.
//! - `burgeon-spatial`: geometries as values, with the operations of OGC Simple Features, and coordinate reference
//!   systems.
//! - `burgeon-data`: data files, read into layers of features in metres, or into measured heights.
//!
//! [`run()`] executes all stages, from a file to a scene:
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
//! A script can have parameters, and a [`Session`](script::Session) can be cancelled from another thread:
//!
//! ```
//! # let folder = tempfile::tempdir().map_err(burgeon::Error::other)?;
//! # let path = folder.path().join("fence.lua");
//! let fence = r#"
//!     local posts = param("posts", { default = 3 })
//!     local Post = module("Post", "left")
//!     local fence = lsystem({ object = extruder({ sides = 4 }) })
//!     fence:axiom(Post(posts))
//!     fence:rule("Post(left)", function(this, left)
//!         if left > 0 then return Post(0), Post(left - 1) end
//!     end)
//!     fence:interpret("Post", function(this) this:scale(0.1):extrude(1.2):shift(2, 0) end)
//!     fence:derive(posts)
//! "#;
//! # std::fs::write(&path, fence).map_err(burgeon::Error::other)?;
//! let params = vec![("posts".to_owned(), "5".to_owned())].into();
//! let session = burgeon::script::Session::new(&path, burgeon::script::RunOptions { params, ..burgeon::options() })?;
//! let run = burgeon::run_session(&session)?;
//! assert_eq!(run.params[0].value, burgeon::script::Setting::Number(5.0));
//!
//! session.stop.stop(burgeon::Error::cancellation("the window was closed"));
//! assert!(burgeon::run_session(&session).is_err());
//! # Ok::<(), burgeon::Error>(())
//! ```
//!
//! [`check`] reports the problems of a script without a derivation:
//!
//! ```
//! # let folder = tempfile::tempdir().map_err(burgeon::Error::other)?;
//! # let path = folder.path().join("fence.lua");
//! let script = "local fence = lsystem({ object = extrudr({}) })";
//! # std::fs::write(&path, script).map_err(burgeon::Error::other)?;
//! let error = burgeon::check(&path, burgeon::options()).expect_err("a misspelt name");
//! assert_eq!(error.remedy(), Some("did you mean extruder?"));
//! assert_eq!(error.place().map(|place| place.line), Some(1));
//! # Ok::<(), burgeon::Error>(())
//! ```
//!
//! # Differences from ABOP
//!
//! Scripts have the semantics of *The Algorithmic Beauty of Plants* (ABOP). Two points differ, because that is faster
//! or more useful:
//!
//! - *Rules are prepared.* When a script is loaded, the returns of rules that are written in place, as functions within
//!   the call of `rule`, are rewritten: if the modules and branches of a return are visible in its text, the return
//!   becomes one call that writes all parameters into the columns of the next chain. The results of other returns, and
//!   of functions defined elsewhere, are collected and decomposed, which is slower and has the same meaning. Line
//!   numbers are preserved.
//! - *A derivation ends when nothing can change.* It ends if no rule applies. It also ends after a step in which every
//!   rule that ran left its module unchanged, if the object begins each pass empty and the step draws no random
//!   numbers. Such a step is not counted.
#![recursion_limit = "256"]

// The commands use the public API by the name that other programs use.
extern crate self as burgeon;

mod commands;

pub use commands::run_command;

pub use burgeon_base::{
    Budget, Error, MemoryReservation, Result, Stop, Warning, WarningKind, error, files, locks, random, text,
    warning,
};
pub use burgeon_engine::each_part;
pub use burgeon_engine::run::{Run, RunTimes, run, run_session};
pub use burgeon_engine::{ScriptCheck, check, check_package, declared_types, declared_types_of_package};
pub use burgeon_engine::{results, script, trace};
pub use burgeon_export as export;
pub use burgeon_kit as kit;
pub use burgeon_language as language;
pub use burgeon_live as live;
pub use burgeon_live::{films, presets, variations, watch};
pub use burgeon_objects as objects;
pub use burgeon_packages as packages;
pub use burgeon_picture as picture;
pub use burgeon_scene as scene;
pub use burgeon_sources as sources;
pub use burgeon_terrain as terrain;
pub use burgeon_tiles as tiles;

/// Returns all object types and sources of Burgeon.
pub fn registry() -> kit::Registry {
    let mut registry = objects::registry();
    registry.set_sources(std::sync::Arc::new(sources::DataSources::default()));
    registry
}

/// Returns the default options to run a script, with all object types and sources of Burgeon.
///
/// ```
/// use burgeon::kit::Kind;
///
/// let mut options = burgeon::options();
/// options.seed = 7;
/// assert!(options.registry.get("extruder").is_some());
/// // A program can add types of its own.
/// options.registry.add(Kind::new("lamp", "A street lamp."))?;
/// assert!(options.registry.add(Kind::new("turtle", "Another turtle.")).is_err());
/// # Ok::<(), burgeon::Error>(())
/// ```
pub fn options() -> script::RunOptions {
    script::RunOptions { registry: registry(), ..script::RunOptions::default() }
}
