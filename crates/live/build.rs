//! Compresses the page's files with gzip, as they are sent.

use std::fs;
use std::io::{Result, Write as _};
use std::path::PathBuf;

use flate2::{Compression, GzBuilder};

fn main() -> Result<()> {
    let folder = PathBuf::from(std::env::var_os("OUT_DIR").unwrap_or_default());
    for name in ["index.html", "viewer.js", "viewer.css"] {
        let path = format!("../../viewer/dist/{name}");
        println!("cargo::rerun-if-changed={path}");
        let packed = fs::File::create(folder.join(format!("{name}.gz")))?;
        let mut encoder = GzBuilder::new().write(packed, Compression::best());
        encoder.write_all(&fs::read(path)?)?;
        encoder.finish()?;
    }
    Ok(())
}
