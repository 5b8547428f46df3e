//! Ways to formats that Burgeon does not write, through one that it writes.

use std::path::Path;

/// Extensions of formats, and the way to them.
const WAYS: [(&[&str], &str); 12] = [
    (
        &["fbx", "dae", "blend", "abc", "3ds", "max", "c4d", "ma", "mb"],
        "write .glb and open it in a 3D program such as Blender (File, Import, glTF 2.0), which saves and exports this format",
    ),
    (
        &["usd", "usdc", "usdz"],
        "write .usda and convert it: usdcat model.usda -o model.usdc, usdzip model.usdz model.usda",
    ),
    (&["skp"], "write .dxf or .stl and import it in SketchUp"),
    (&["dwg", "dgn"], "write .dxf, which CAD programs open and save in this format"),
    (
        &["step", "stp", "iges", "igs", "sat", "brep"],
        "write .stl or .3mf: models are triangles, not exact surfaces; FreeCAD makes a solid of them",
    ),
    (&["ifc", "gml", "citygml"], "write .city.json; citygml-tools converts it to CityGML"),
    (
        &["jpg", "jpeg", "webp", "bmp", "tif", "tiff", "tga", "exr"],
        "write .png and convert it: magick model.png model.jpg",
    ),
    (&["pdf", "eps", "ai", "ps"], "write .svg and convert it: inkscape model.svg -o model.pdf"),
    (
        &["mp4", "webm", "mov", "avi", "mkv"],
        "write .gif or .apng, or frames for an encoder: --turntable 60 -o frames/%04d.png, then ffmpeg -i frames/%04d.png model.mp4",
    ),
    (
        &["shp", "kml", "fgb", "gpx", "parquet", "geoparquet"],
        "write .gpkg and convert it: ogr2ogr model.shp model.gpkg",
    ),
    (&["b3dm", "i3dm", "cmpt", "json"], "for 3D Tiles, use burgeon tiles; for CityJSON, write .city.json"),
    (
        &["lua"],
        "name the file of the model: -o model.glb; the script comes first: burgeon run tree.lua -o tree.glb",
    ),
];

/// Returns the remedy for a path whose extension names a format that Burgeon does not write, if there is a way to it.
///
/// A way does not lose the model: it names a format that Burgeon writes and a program that reads it.
pub(super) fn way_to(path: &Path) -> Option<&'static str> {
    let extension = path.extension()?.to_str()?.to_ascii_lowercase();
    WAYS.iter().find(|(extensions, _)| extensions.contains(&&*extension)).map(|(_, way)| *way)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FORMATS;

    #[test]
    fn each_way_begins_with_a_format_that_is_written() {
        for (extensions, way) in WAYS {
            let names = |extension: &str| way.contains(&format!(".{extension}"));
            assert!(FORMATS.iter().any(|format| names(format.extension())), "{way}");
            for extension in extensions {
                assert!(
                    FORMATS.iter().all(|format| format.extension() != *extension),
                    "{extension} is written"
                );
            }
        }
        assert!(way_to(Path::new("a/Model.FBX")).is_some() && way_to(Path::new("a.glb")).is_none());
    }
}
