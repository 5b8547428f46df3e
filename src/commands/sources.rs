//! `burgeon sources`: what data files hold.

use std::path::PathBuf;

use burgeon::sources::Listing;
use burgeon::{Error, Result};
use clap::Args;
use serde_json::json;

use super::report;

/// Lists the layers of data files, with their attributes, coordinate systems and extents
#[derive(Args)]
pub(crate) struct Sources {
    /// GeoJSON files and GeoPackages
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,

    /// Prints one JSON document, for machines, in place of text for people
    #[arg(long)]
    json: bool,
}

impl Sources {
    pub(crate) fn json(&self) -> bool {
        self.json
    }

    pub(crate) fn run(&self) -> Result<()> {
        let (mut listings, mut problems): (Vec<Listing>, Vec<Error>) = (Vec::new(), Vec::new());
        for file in &self.files {
            match Listing::read(file) {
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
