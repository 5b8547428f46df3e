//! Content of files and databases, and heights of files, without a script.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;
use std::sync::Arc;

use burgeon_base::budget::Budget;
use burgeon_base::error::Result;
use burgeon_data::Listing;
use burgeon_data::elevation::{HeightOptions, Raster};

/// Lists the content of the data file at `file`, or of the PostGIS database with this address.
pub fn list_content(file: &Path, budget: &Arc<Budget>) -> Result<Listing> {
    match file.to_str() {
        Some(text) if text.starts_with("postgres://") || text.starts_with("postgresql://") => {
            list_database(text, budget)
        }
        _ => Listing::read(file, budget),
    }
}

#[cfg(feature = "postgis")]
fn list_database(address: &str, budget: &Arc<Budget>) -> Result<Listing> {
    use crate::sql::postgis::{Server, ServerAddress};
    Server::new(&ServerAddress::parse(address)?, None).listing(budget)
}

#[cfg(not(feature = "postgis"))]
fn list_database(_: &str, _: &Arc<Budget>) -> Result<Listing> {
    Err(burgeon_base::error::Error::left_out("databases", "postgis"))
}

/// Reads the heights of the file at `path`, called `name` in messages, for their shape alone: a file without a position, and
/// a PNG without a range of heights are read too.
pub fn read_height_shape(path: &Path, name: &str, budget: &Budget) -> Result<Raster> {
    let range = |height: f64| is_png(path).then_some(height);
    let wanted = HeightOptions {
        low: range(0.0),
        high: range(1.0),
        bounds: Some([0.0, 0.0, 1e6, 1e6]),
        anywhere: true,
        ..HeightOptions::default()
    };
    Raster::open(path, name, &wanted, budget)
}

/// Returns true if the file at `path` begins as a PNG; false if it cannot be read, which a later read reports.
fn is_png(path: &Path) -> bool {
    let mut head = [0; 4];
    File::open(path).and_then(|mut file| file.read_exact(&mut head)).is_ok() && &head == b"\x89PNG"
}
