//! Table of the export formats.
//!
//! The command line, its help and errors, the live view and its page read this table. A new format is a row here.

use std::path::Path;

use super::conversions::way_to;
use super::format::Need::{Attributes, Layers, Picture, Recipe, Reports, Scene};
use super::format::{FileFormat, Format, SurfaceDetail, always, find};
use super::{city, gltf, layers, obj, page, render, solids, svg, table, usd, x3d};
use burgeon_base::error::Result;
use burgeon_scene::image;

/// Binary glTF, which terrain tiles and the models of the live view use too.
pub const GLB: Format = Format {
    file: FileFormat { extensions: &["glb"], title: "glTF 2.0, one file", companion: None, check: always },
    media_type: "model/gltf-binary",
    needs: &[Scene, Recipe],
    has_metadata: true,
    surface: Some(SurfaceDetail::Full),
    has_textures: false,
    write: gltf::write_glb,
};

/// Renders, which contact sheets use too.
pub const PNG: Format = Format {
    file: FileFormat {
        extensions: &["png"],
        title: "render with soft shadows",
        companion: None,
        check: image::check,
    },
    media_type: "image/png",
    needs: &[Scene, Picture],
    has_metadata: false,
    surface: Some(SurfaceDetail::Full),
    has_textures: false,
    write: render::write,
};

/// Page that needs no server.
pub const PAGE: Format = Format {
    file: FileFormat {
        extensions: &["html"],
        title: "page with the model and its script, for any browser",
        companion: None,
        check: always,
    },
    media_type: "text/html",
    needs: &[Scene, Recipe],
    has_metadata: true,
    surface: Some(SurfaceDetail::Full),
    has_textures: false,
    write: page::write,
};

/// All formats of a model, in the order in which messages list them.
pub static FORMATS: [Format; 17] = [
    GLB,
    Format {
        file: FileFormat {
            extensions: &["gltf"],
            title: "glTF 2.0, as text",
            companion: Some(gltf::buffer_path),
            check: always,
        },
        media_type: "model/gltf+json",
        needs: &[Scene, Recipe],
        has_metadata: true,
        surface: Some(SurfaceDetail::Full),
        has_textures: true,
        write: gltf::write_gltf,
    },
    PAGE,
    // Instances become copies.
    Format {
        file: FileFormat {
            extensions: &["obj"],
            title: "Wavefront OBJ",
            companion: Some(obj::library_path),
            check: always,
        },
        media_type: "model/obj",
        needs: &[Scene],
        has_metadata: false,
        surface: Some(SurfaceDetail::Relief),
        has_textures: true,
        write: obj::write,
    },
    // Instances become references and point instancers.
    Format {
        file: FileFormat { extensions: &["usda"], title: "USD, as text", companion: None, check: always },
        media_type: "model/vnd.usda",
        needs: &[Scene],
        has_metadata: false,
        surface: Some(SurfaceDetail::Relief),
        has_textures: true,
        write: usd::write,
    },
    // Triangles in millimetres.
    Format {
        file: FileFormat {
            extensions: &["stl"],
            title: "STL, triangles in millimetres",
            companion: None,
            check: always,
        },
        media_type: "model/stl",
        needs: &[Scene],
        has_metadata: false,
        surface: Some(SurfaceDetail::Outline),
        has_textures: false,
        write: solids::write_stl,
    },
    Format {
        file: FileFormat {
            extensions: &["3mf"],
            title: "3MF, for printers, in millimetres",
            companion: None,
            check: solids::check_three_mf,
        },
        media_type: "model/3mf",
        needs: &[Scene],
        has_metadata: false,
        surface: Some(SurfaceDetail::Color),
        has_textures: false,
        write: solids::write_three_mf,
    },
    Format {
        file: FileFormat {
            extensions: &["ply"],
            title: "PLY, with normals and colours",
            companion: None,
            check: always,
        },
        media_type: "application/ply",
        needs: &[Scene],
        has_metadata: false,
        surface: Some(SurfaceDetail::Color),
        has_textures: false,
        write: solids::write_ply,
    },
    PNG,
    // A plan, or an elevation of a thin upright model.
    Format {
        file: FileFormat {
            extensions: &["svg"],
            title: "architectural drawing",
            companion: None,
            check: always,
        },
        media_type: "image/svg+xml",
        needs: &[Scene],
        has_metadata: false,
        surface: Some(SurfaceDetail::Color),
        has_textures: false,
        write: svg::write,
    },
    Format {
        file: FileFormat {
            extensions: &["x3d"],
            title: "X3D 3.3, for x3dom",
            companion: None,
            check: always,
        },
        media_type: "model/x3d+xml",
        needs: &[Scene],
        has_metadata: false,
        surface: Some(SurfaceDetail::Texture),
        has_textures: true,
        write: x3d::write,
    },
    Format {
        file: FileFormat {
            extensions: &["city.json"],
            title: "CityJSON 2.0, buildings and other city objects",
            companion: None,
            check: always,
        },
        media_type: "application/city+json",
        needs: &[Scene, Attributes],
        has_metadata: false,
        surface: Some(SurfaceDetail::Outline),
        has_textures: false,
        write: city::write,
    },
    Format {
        file: FileFormat {
            extensions: &["city.jsonl"],
            title: "CityJSONSeq 2.0, a city object per line",
            companion: None,
            check: always,
        },
        media_type: "application/city+json-seq",
        needs: &[Scene, Attributes],
        has_metadata: false,
        surface: Some(SurfaceDetail::Outline),
        has_textures: false,
        write: city::write_sequence,
    },
    Format {
        file: FileFormat {
            extensions: &["geojson"],
            title: "GeoJSON, layers of modules in degrees",
            companion: None,
            check: always,
        },
        media_type: "application/geo+json",
        needs: &[Layers],
        has_metadata: false,
        surface: None,
        has_textures: false,
        write: layers::write_geojson_file,
    },
    Format {
        file: FileFormat {
            extensions: &["dxf"],
            title: "DXF R12, layers of modules as polylines",
            companion: None,
            check: always,
        },
        media_type: "image/vnd.dxf",
        needs: &[Layers],
        has_metadata: false,
        surface: None,
        has_textures: false,
        write: layers::write_dxf_file,
    },
    Format {
        file: FileFormat {
            extensions: &["gpkg"],
            title: "GeoPackage, layers of modules",
            companion: None,
            check: layers::check_geopackage,
        },
        media_type: "application/geopackage+sqlite3",
        needs: &[Layers],
        has_metadata: false,
        surface: None,
        has_textures: false,
        write: layers::write_geopackage_file,
    },
    Format {
        file: FileFormat {
            extensions: &["csv"],
            title: "table of the numbers that the script reports",
            companion: None,
            check: always,
        },
        media_type: "text/csv",
        needs: &[Reports],
        has_metadata: false,
        surface: None,
        has_textures: false,
        write: table::write,
    },
];

impl Format {
    /// Returns the format that the extension of `path` names, in upper or lower case.
    ///
    /// Fails on an unknown or missing extension; the error lists the known ones.
    ///
    /// ```
    /// use burgeon_export::Format;
    /// use std::path::Path;
    ///
    /// assert_eq!(Format::of(Path::new("out/Town.GLB"))?.media_type, "model/gltf-binary");
    /// assert_eq!(Format::of(Path::new("town.city.json"))?.extension(), "city.json");
    /// let error = Format::of(Path::new("town.blend")).expect_err("no such format");
    /// assert!(error.to_string().contains("open it in a 3D program"), "{error}");
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn of(path: &Path) -> Result<&'static Self> {
        find(&FORMATS, path).map_err(|error| match way_to(path) {
            Some(way) => error.rather_help(way),
            None => error,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Export, Files, SceneFacts, samples};
    use burgeon_picture::Picture as Camera;
    use std::collections::BTreeSet;
    use std::io::Write;
    use std::path::PathBuf;

    #[test]
    fn an_extension_picks_the_format_in_any_case() {
        assert_eq!(Format::of(Path::new("out/a.b/tower.GLB")).unwrap(), &GLB);
        for format in &FORMATS {
            let extension = format.extension();
            assert_eq!(Format::of(Path::new(&format!("x.{extension}"))).unwrap(), format);
            assert_eq!(format.file.stem(&format!("x.y.{}", extension.to_uppercase())), Some("x.y"));
            for name in [format!("x{extension}"), format!(".{extension}"), format!("x.{extension}x")] {
                assert!(Format::of(Path::new(&name)).is_err(), "{name}");
            }
        }
    }

    #[test]
    fn each_row_has_an_extension_of_its_own_a_title_and_a_media_type() {
        let mut extensions = BTreeSet::new();
        for format in &FORMATS {
            assert!(!format.file.extensions.is_empty() && !format.needs.is_empty(), "{format:?}");
            for extension in format.file.extensions {
                assert_eq!(*extension, extension.to_lowercase());
                assert!(extensions.insert(extension), "{extension}");
            }
            assert!(!format.file.title.is_empty() && format.media_type.contains('/'), "{format:?}");
        }
    }

    #[test]
    fn a_format_writes_its_companion_and_textures_and_no_other_files() {
        let folder = tempfile::tempdir().unwrap();
        let scene = samples::all(folder.path()).into_iter().find(|(name, _)| *name == "textured").unwrap().1;
        let mut count = 0;
        for format in FORMATS.iter().filter(|format| format.is_of_scenes() && !format.needs(Picture)) {
            let out = tempfile::tempdir().unwrap();
            let path = out.path().join(format!("a b.{}", format.extension()));
            crate::write(&scene, &path, &Camera::default()).unwrap();
            let written: BTreeSet<PathBuf> =
                std::fs::read_dir(out.path()).unwrap().map(|entry| entry.unwrap().path()).collect();
            let own: BTreeSet<PathBuf> = format.file.companion(&path).into_iter().chain([path]).collect();
            assert!(written.is_superset(&own), "{own:?}: {written:?}");
            assert_eq!(written.len() > own.len(), format.has_textures, "{own:?}: {written:?}");
            count += 1;
        }
        assert_eq!(count, 10);
    }

    #[test]
    fn a_row_is_enough_for_a_format() {
        fn write(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
            files.write(path, |out| write!(out, "{}", export.scene.triangles()))
        }
        let row = Format {
            file: FileFormat { extensions: &["count"], title: "a number", companion: None, check: always },
            write,
            ..GLB
        };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.COUNT");
        let table = [GLB, row];
        let format = find(&table, &path).unwrap();
        let export =
            Export { scene: &samples::boxes(2), picture: &Camera::default(), facts: SceneFacts::default() };
        let mut files = Files::default();
        (format.write)(&export, &path, &mut files).unwrap();
        files.publish().unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "24");
        let error = find(&table, Path::new("a.cuont")).unwrap_err().to_string();
        assert!(error.contains("did you mean .count?"), "{error}");
    }

    #[test]
    fn an_unknown_extension_is_refused_with_a_suggestion() {
        insta::assert_snapshot!(Format::of(Path::new("a/tower.gtlf")).unwrap_err(), @r"
        cannot write a/tower.gtlf: unknown file extension .gtlf
          help: did you mean .gltf?
        ");
        insta::assert_snapshot!(find(&FORMATS[..3], Path::new("tower.step")).unwrap_err(), @r"
        cannot write tower.step: unknown file extension .step
          help: supported formats are .glb, .gltf and .html
        ");
    }

    #[test]
    fn a_missing_extension_is_refused() {
        insta::assert_snapshot!(find(&FORMATS[..1], Path::new("a.b/tower")).unwrap_err(), @r"
        cannot write a.b/tower: missing file extension
          help: supported formats are .glb
        ");
    }
}
