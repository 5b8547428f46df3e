//! Sources of scripts: data files, lists and PostGIS servers, and read-only SQL over them.
//!
//! Input: the calls of `source` and the queries of a run, through the contract [`SourceProvider`]. Output: layers of
//! features in metres around the origin of the run, and rows in a fixed order. Sources are never written to, and a
//! statement reads only the tables that were added.
//!
//! - [`DataSources`] is the provider, which a program adds to its registry.
//! - [`list_content`] lists files and databases without a script. The results of a run contain its [`ReferenceFrame`].
//! - [`sql`] queries layers in an embedded database, in a subset of PostGIS's dialect.
//! - [`sql::postgis`] queries PostGIS servers.

mod listing;
#[cfg(feature = "data")]
pub mod sql;
mod store;

pub use burgeon_data::{Layer, Listing, companions};
pub use burgeon_spatial::ReferenceFrame;
pub use listing::{list_content, read_height_shape};
pub use store::{DataSources, SourceSurvey, SourceWindow, SurveyedSource, WindowBox};

#[cfg(doc)]
use burgeon_kit::SourceProvider;
