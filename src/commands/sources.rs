//! `burgeon sources`: lists the content of data files.

use std::path::PathBuf;
use std::time::Duration;

use burgeon::sources::{Listing, list_content};
use burgeon::{Budget, Error, Result};
use clap::Args;
use serde_json::json;

use super::report;
use super::shared::{megabytes, seconds};

/// Lists the layers of data files and databases, with their attributes, coordinate systems and extents
#[derive(Args)]
pub(crate) struct SourcesCommand {
    /// Data files: GeoJSON, GeoPackage, FlatGeobuf, Shapefile, CSV, GML, CityGML, CityJSON, KML, GPX, .osm, .osm.pbf;
    /// or PostGIS databases: postgres://USER:PASSWORD@HOST/NAME
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,

    /// Stops after this time
    #[arg(long, value_name = "SECONDS", default_value_t = 300.0, value_parser = seconds,
          allow_negative_numbers = true, help_heading = "Limits")]
    time_limit: f64,

    /// Memory limit for reading
    #[arg(long, value_name = "MEGABYTES", default_value_t = 2048, value_parser = megabytes,
          allow_negative_numbers = true, help_heading = "Limits")]
    memory_limit: u32,

    /// Prints machine-readable JSON instead of text
    #[arg(long)]
    json: bool,
}

impl SourcesCommand {
    pub(crate) fn json(&self) -> bool {
        self.json
    }

    pub(crate) fn run(&self) -> Result<()> {
        let (mut listings, mut problems): (Vec<Listing>, Vec<Error>) = (Vec::new(), Vec::new());
        let time = Duration::from_secs_f64(self.time_limit);
        let budget = Budget::within(time, self.memory_limit as usize * 1_000_000);
        for file in &self.files {
            match list_content(file, &budget) {
                Ok(listing) => listings.push(listing),
                Err(error) => problems.push(error),
            }
        }
        if !problems.is_empty() {
            return Err(Error::several(problems));
        }
        if self.json {
            let files: Vec<_> = listings.iter().map(Listing::to_json).collect();
            report::print(&format!("{}\n", json!({ "ok": true, "files": files })))?;
        } else {
            for listing in &listings {
                report::print(&listing.text())?;
            }
        }
        Ok(())
    }
}
