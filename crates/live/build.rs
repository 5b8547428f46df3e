//! Compresses the page's files with gzip, as they are sent.

#[cfg(feature = "server")]
fn main() -> std::io::Result<()> {
    page::compress()
}

#[cfg(not(feature = "server"))]
fn main() {}

#[cfg(feature = "server")]
mod page {
    use std::fs;
    use std::io::{Result, Write as _};
    use std::path::PathBuf;

    use flate2::{Compression, GzBuilder};

    pub(super) fn compress() -> Result<()> {
        let folder = PathBuf::from(std::env::var_os("OUT_DIR").unwrap_or_default());
        for name in [
            "index.html",
            "viewer.js",
            "editor.js",
            "viewer.css",
            "tileset.html",
            "tileset.js",
            "tileset.css",
        ] {
            let path = format!("../../viewer/dist/{name}");
            println!("cargo::rerun-if-changed={path}");
            let packed = fs::File::create(folder.join(format!("{name}.gz")))?;
            let mut encoder = GzBuilder::new().write(packed, Compression::best());
            encoder.write_all(&fs::read(path)?)?;
            encoder.finish()?;
        }
        Ok(())
    }
}
