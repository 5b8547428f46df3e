//! Formats that are recognised but not supported, with instructions for converting them.

use std::path::Path;

use burgeon_base::error::{Error, Result};

/// Supported formats.
pub(crate) const FORMATS: &str = "supported formats are GeoJSON, GeoPackage, FlatGeobuf, Shapefile, CSV, GML, CityGML, CityJSON, KML, GPX, .osm and .osm.pbf";

/// Conversion with GDAL.
const OGR: &str = "convert it: ogr2ogr out.gpkg FILE";

/// First bytes of a file, its description, and the remedy.
const BEGINNINGS: [(&[u8], &str, &str); 36] = [
    (b"PAR1", "a GeoParquet file", OGR),
    (b"ARROW1", "an Arrow (Feather) file", OGR),
    (b"AC10", "an AutoCAD drawing (DWG)", "save it as DXF, and convert that: ogr2ogr out.gpkg FILE.dxf"),
    (
        b"AutoCAD Binary DXF",
        "a drawing (binary DXF)",
        "save it as a text DXF, and convert that: ogr2ogr out.gpkg FILE.dxf",
    ),
    (
        b"LASF",
        "a point cloud (LAS or LAZ)",
        "convert it to heights: pdal translate FILE out.tif --writers.gdal.resolution=1",
    ),
    (b"ply", "a mesh (PLY)", "convert it to .glb, and place it: model(\"FILE.glb\")"),
    (b"glTF", "a model (glTF)", "place it: model(\"FILE.glb\")"),
    (
        b"ISO-10303-21",
        "a building model (IFC or STEP)",
        "convert it: IfcConvert FILE out.glb, and place it: model(\"out.glb\")",
    ),
    (b"!table", "a MapInfo table (TAB)", OGR),
    (b"!TABLE", "a MapInfo table (TAB)", OGR),
    (b"\x00\x01\x00\x00Standard Jet DB", "a personal geodatabase (MDB)", OGR),
    (b"\x00\x01\x00\x00Standard ACE DB", "an Access database", OGR),
    (b"PMTiles", "a map tile file (PMTiles)", "convert it: ogr2ogr out.gpkg FILE, of one zoom level"),
    (
        b"\x89HDF",
        "an HDF5 or NetCDF file",
        "convert its heights: gdal_translate NETCDF:FILE:VARIABLE out.tif",
    ),
    (b"CDF\x01", "a NetCDF file", "convert its heights: gdal_translate NETCDF:FILE:VARIABLE out.tif"),
    (b"CDF\x02", "a NetCDF file", "convert its heights: gdal_translate NETCDF:FILE:VARIABLE out.tif"),
    (
        b"PGDMP",
        "a database dump (pg_dump)",
        "load it into PostGIS, and read the database: source(\"postgres://...\")",
    ),
    (b"II*\0", "a raster (TIFF)", "to read heights, write elevation(\"FILE\")"),
    (b"MM\0*", "a raster (TIFF)", "to read heights, write elevation(\"FILE\")"),
    (b"\x89PNG", "an image (PNG)", "to read heights from it, write elevation(\"FILE\")"),
    (b"\xff\xd8\xff", "an image (JPEG)", "specify a file of features"),
    (b"%PDF", "a PDF", "get the data that it was drawn from"),
    (b"BZh", "compressed with bzip2", "unpack it: bunzip2 FILE"),
    (b"\xfd7zXZ", "compressed with xz", "unpack it: unxz FILE"),
    (b"\x28\xb5\x2f\xfd", "compressed with zstd", "unpack it: unzstd FILE"),
    (b"7z\xbc\xaf\x27\x1c", "compressed with 7-Zip", "unpack it: 7z x FILE"),
    (b"Rar!", "compressed with RAR", "unpack it: unrar x FILE"),
    (
        b"\xff\xe0\x04o5m2",
        "an OpenStreetMap extract (o5m)",
        "convert it: osmium cat FILE -o out.osm.pbf, or osmconvert",
    ),
    (
        b"\xd0\xcf\x11\xe0",
        "an old Office document",
        "save its table as .csv, with columns of longitude and latitude",
    ),
    (b"version https://git-lfs", "a Git LFS pointer, not the data itself", "get the data: git lfs pull"),
    (b"<!DOCTYPE html", "a web page, not data", "the download failed, or needs a login; download it again"),
    (b"<!doctype html", "a web page, not data", "the download failed, or needs a login; download it again"),
    (b"<html", "a web page, not data", "the download failed, or needs a login; download it again"),
    (b"ncols", "a raster (ASCII grid)", "to read heights, write elevation(\"FILE\")"),
    (b"NCOLS", "a raster (ASCII grid)", "to read heights, write elevation(\"FILE\")"),
    (b"solid ", "a mesh (STL)", "convert it to .glb, and place it: model(\"FILE.glb\")"),
];

/// File extension, description, and remedy, for files that cannot be recognised from their first bytes.
const EXTENSIONS: [(&str, &str, &str); 24] = [
    ("dbf", "the table of a shapefile", "specify its .shp file, and keep all its files in one folder"),
    ("shx", "the index of a shapefile", "specify its .shp file, and keep all its files in one folder"),
    (
        "prj",
        "the coordinate system of a shapefile",
        "specify its .shp file, and keep all its files in one folder",
    ),
    ("cpg", "the encoding of a shapefile", "specify its .shp file, and keep all its files in one folder"),
    ("dxf", "a drawing (DXF)", OGR),
    ("dwg", "an AutoCAD drawing (DWG)", "save it as DXF, and convert that: ogr2ogr out.gpkg FILE.dxf"),
    ("dgn", "a MicroStation drawing (DGN)", OGR),
    ("mif", "a MapInfo file (MIF)", OGR),
    ("mid", "the table of a MapInfo file", "convert its .mif file: ogr2ogr out.gpkg FILE.mif"),
    ("map", "a part of a MapInfo table", "convert its .tab file: ogr2ogr out.gpkg FILE.tab"),
    ("gdb", "a part of a File Geodatabase", "convert the whole folder: ogr2ogr out.gpkg FOLDER.gdb"),
    ("gdbtable", "a part of a File Geodatabase", "convert the whole folder: ogr2ogr out.gpkg FOLDER.gdb"),
    (
        "laz",
        "a point cloud (LAZ)",
        "convert it to heights: pdal translate FILE out.tif --writers.gdal.resolution=1",
    ),
    ("hgt", "a raster of heights (SRTM)", "to read heights, write elevation(\"FILE\")"),
    ("asc", "a raster of heights (ASCII grid)", "to read heights, write elevation(\"FILE\")"),
    ("000", "a nautical chart (S-57)", OGR),
    ("e00", "an ArcInfo coverage", OGR),
    ("mvt", "a map tile (MVT)", OGR),
    ("mbtiles", "a map tile file (MBTiles)", OGR),
    ("parquet", "a GeoParquet file", OGR),
    ("tar", "an archive (tar)", "unpack it: tar xf FILE"),
    ("sql", "SQL statements", "load them into PostGIS, and read the database: source(\"postgres://...\")"),
    ("xlsx", "a spreadsheet", "save its table as .csv, with columns of longitude and latitude"),
    ("skp", "a SketchUp model", "export it as .glb, and place it: model(\"FILE.glb\")"),
];

fn error(name: &str, what: &str, remedy: &str) -> Error {
    Error::data(format!("{name} is {what}, which is not supported as a source")).help(remedy)
}

/// Fails if a file that begins with `head` has a known but unsupported format.
pub(crate) fn refuse_beginning(head: &[u8], name: &str) -> Result<()> {
    let text = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head).trim_ascii_start();
    let found = BEGINNINGS.iter().find(|(begins, ..)| head.starts_with(begins) || text.starts_with(begins));
    if let Some((_, what, remedy)) = found {
        return Err(error(name, what, remedy));
    }
    if head.get(257..262) == Some(b"ustar") {
        return Err(error(name, "an archive (tar)", "unpack it: tar xf FILE"));
    }
    // The first group of a DXF is a comment or the first section.
    let mut lines = text.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii);
    if let (Some(b"0"), Some(b"SECTION")) | (Some(b"999"), Some(_)) = (lines.next(), lines.next())
        && lines.next().is_some()
    {
        return Err(error(name, "a drawing (DXF)", OGR));
    }
    Ok(())
}

/// Fails if the extension is that of a known but unsupported format; used if the content is not recognised.
pub(crate) fn refuse_extension(path: &Path, name: &str) -> Result<()> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let found = EXTENSIONS.iter().find(|(known, ..)| *known == extension);
    found.map_or(Ok(()), |(_, what, remedy)| Err(error(name, what, remedy)))
}

/// Returns the error for a folder whose format is known but unsupported.
pub(crate) fn folder(path: &Path, name: &str) -> Option<Error> {
    let extension = path.extension()?.to_string_lossy().to_ascii_lowercase();
    (extension == "gdb").then(|| error(name, "a File Geodatabase", "convert it: ogr2ogr out.gpkg FOLDER.gdb"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_that_are_not_read_are_told_by_name_with_a_way_to_convert_them() {
        let told = |head: &[u8]| refuse_beginning(head, "a").unwrap_err().to_string();
        for head in [
            &b"PAR1\x15\x04"[..],
            b"AC1027\0\0",
            b"  0\r\nSECTION\r\n  2\r\nHEADER\r\n",
            b"999\ncomment\n0\nSECTION\n",
            b"LASF\0\0",
            b"ISO-10303-21;",
            b"!table\r\n!version 300",
            b"\r\n<!DOCTYPE html><html>",
            b"version https://git-lfs.github.com/spec/v1",
            b"BZh91AY",
            b"II*\0\x08",
        ] {
            let told = told(head);
            assert!(told.contains("which is not supported as a source") && told.contains("help: "), "{told}");
        }
        for head in [&b"{\"type\""[..], b"<?xml", b"", b"0\n", b"name,lon,lat\n"] {
            assert!(refuse_beginning(head, "a").is_ok(), "{head:?}");
        }
        assert!(
            refuse_extension(Path::new("a/b.DXF"), "b").is_err()
                && refuse_extension(Path::new("b.csv"), "b").is_ok()
        );
        assert!(
            folder(Path::new("town.gdb"), "town.gdb").is_some()
                && folder(Path::new("town"), "town").is_none()
        );
    }
}
