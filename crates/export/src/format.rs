//! Export formats of a scene.

use burgeon_base::error::{Error, Result};
use burgeon_scene::image;
use std::path::Path;

/// File format of an export.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// glTF 2.0 in one binary file, textures included.
    Glb,
    /// glTF 2.0 as readable JSON, with a `.bin` file and the textures next to it.
    Gltf,
    /// Wavefront OBJ, with a `.mtl` file and the textures next to it. Instances become copies.
    Obj,
    /// Render of the scene.
    Png,
    /// Drawing to scale: a plan, or an elevation of a thin upright model.
    Svg,
    /// X3D 3.3 in XML, with the textures next to it.
    X3d,
    /// CityJSON 2.0: buildings with their surfaces, and other city objects.
    CityJson,
    /// GeoJSON: the modules of the final chains that have a geometry, in degrees.
    GeoJson,
    /// GeoPackage of the same modules, with a layer for each symbol.
    GeoPackage,
}

impl Format {
    /// All formats, in the order in which messages list them.
    pub const ALL: [Self; 9] = [
        Self::Glb,
        Self::Gltf,
        Self::Obj,
        Self::Png,
        Self::Svg,
        Self::X3d,
        Self::CityJson,
        Self::GeoJson,
        Self::GeoPackage,
    ];

    /// Formats that need only the scene and no facts about the run.
    pub const OF_SCENES: [Self; 6] = [Self::Glb, Self::Gltf, Self::Obj, Self::Png, Self::Svg, Self::X3d];

    /// Returns the extension, in lower case and without a dot.
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Glb => "glb",
            Self::Gltf => "gltf",
            Self::Obj => "obj",
            Self::Png => "png",
            Self::Svg => "svg",
            Self::X3d => "x3d",
            Self::CityJson => "city.json",
            Self::GeoJson => "geojson",
            Self::GeoPackage => "gpkg",
        }
    }

    /// Lists the extensions of all formats, with `word` before the last one: ".glb, .gltf and .obj".
    ///
    /// ```
    /// use burgeon_export::Format;
    ///
    /// assert!(Format::extension_list("or").ends_with(".geojson or .gpkg"));
    /// ```
    pub fn extension_list(word: &str) -> String {
        let [others @ .., last] = Self::ALL.map(|format| format!(".{}", format.extension()));
        format!("{} {word} {last}", others.join(", "))
    }

    /// Returns true if the format stores layers of modules and nothing of the scene.
    pub fn has_layers(self) -> bool {
        matches!(self, Self::GeoJson | Self::GeoPackage)
    }

    /// Fails if this program was built without the format.
    pub fn check(self) -> Result<()> {
        match self {
            Self::Png => image::check(),
            Self::GeoPackage => burgeon_data::check_geopackage(),
            _ => Ok(()),
        }
    }

    /// Returns the format that the extension of `path` names, in upper or lower case.
    ///
    /// Fails on an unknown or missing extension; the error lists the known ones.
    ///
    /// ```
    /// use burgeon_export::Format;
    /// use std::path::Path;
    ///
    /// assert_eq!(Format::of(Path::new("out/Town.GLB"))?, Format::Glb);
    /// assert_eq!(Format::of(Path::new("town.city.json"))?, Format::CityJson);
    /// let error = Format::of(Path::new("town.blend")).expect_err("no such format");
    /// assert!(error.to_string().contains("gltf"), "{error}");
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn of(path: &Path) -> Result<Self> {
        let known = format!("supported formats are {}", Self::extension_list("and"));
        let Some(extension) = path.extension() else {
            let message = format!("cannot write {}: missing file extension", path.display());
            return Err(Error::usage(message).help(known));
        };
        let extension = extension.to_string_lossy();
        let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        let ends = |format: &Self| {
            name.strip_suffix(format.extension()).is_some_and(|stem| stem.len() > 1 && stem.ends_with('.'))
        };
        if let Some(format) = Self::ALL.into_iter().find(ends) {
            return Ok(format);
        }
        let message = format!("cannot write {}: unknown file extension .{extension}", path.display());
        let extensions = Self::ALL.map(|format| format!(".{}", format.extension()));
        let meant = extensions.iter().map(String::as_str);
        Err(Error::not_found("format", format!(".{extension}"), meant, message).help(known))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_extension_picks_the_format_in_any_case() {
        assert_eq!(Format::of(Path::new("out/a.b/tower.GLB")).unwrap(), Format::Glb);
        for format in Format::ALL {
            assert_eq!(Format::of(Path::new(&format!("x.{}", format.extension()))).unwrap(), format);
            assert!(Format::of(Path::new(&format!("x{}", format.extension()))).is_err());
        }
    }

    #[test]
    fn an_unknown_extension_is_refused_with_a_suggestion() {
        insta::assert_snapshot!(Format::of(Path::new("a/tower.gtlf")).unwrap_err(), @r"
        cannot write a/tower.gtlf: unknown file extension .gtlf
          help: did you mean .gltf?
        ");
        insta::assert_snapshot!(Format::of(Path::new("tower.step")).unwrap_err(), @r"
        cannot write tower.step: unknown file extension .step
          help: supported formats are .glb, .gltf, .obj, .png, .svg, .x3d, .city.json, .geojson and .gpkg
        ");
    }

    #[test]
    fn a_missing_extension_is_refused() {
        insta::assert_snapshot!(Format::of(Path::new("a.b/tower")).unwrap_err(), @r"
        cannot write a.b/tower: missing file extension
          help: supported formats are .glb, .gltf, .obj, .png, .svg, .x3d, .city.json, .geojson and .gpkg
        ");
    }
}
