//! Compresses the definitions of the EPSG registry: as constants, they would take up a fifth of the program.

#[cfg(feature = "projections")]
fn main() -> std::io::Result<()> {
    use std::fmt::Write as _;
    use std::io::Write as _;

    const BLOCK: usize = 128;
    println!("cargo::rerun-if-changed=build.rs");
    let known: Vec<crs_definitions::Def> = (0..=u16::MAX).filter_map(crs_definitions::from_code).collect();
    let (mut packed, mut blocks) = (Vec::new(), String::from("&[\n"));
    for block in known.chunks(BLOCK) {
        let start = packed.len();
        let mut encoder = flate2::write::DeflateEncoder::new(&mut packed, flate2::Compression::best());
        for found in block {
            writeln!(encoder, "{}\t{}\t{}", found.code, found.proj4, found.wkt)?;
        }
        encoder.finish()?;
        let _ = writeln!(blocks, "({}, {start}..{}),", block[0].code, packed.len());
    }
    blocks.push(']');
    let folder = std::path::PathBuf::from(std::env::var_os("OUT_DIR").unwrap_or_default());
    std::fs::write(folder.join("epsg.deflate"), packed)?;
    std::fs::write(folder.join("epsg.rs"), blocks)
}

#[cfg(not(feature = "projections"))]
fn main() {
    println!("cargo::rerun-if-changed=build.rs");
}
