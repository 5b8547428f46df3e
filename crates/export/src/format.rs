//! Descriptions of file formats, and the choice of a format by the name of a file.

use std::path::{Path, PathBuf};

use super::facts::Export;
use super::files::Files;
use burgeon_base::error::{Error, Result};

/// Properties of every file format.
#[derive(Debug, Clone, Copy)]
pub struct FileFormat {
    /// Extensions in lower case and without a dot; texts show the first one.
    pub extensions: &'static [&'static str],
    /// Name and properties for users, such as "glTF 2.0, one file".
    pub title: &'static str,
    /// Path of the second file that a file of the format can have, such as `a.bin` for `a.gltf`.
    pub companion: Option<fn(&Path) -> PathBuf>,
    /// Function that fails if this program was built without the format.
    pub check: fn() -> Result<()>,
}

/// Format of a model: a row of [`FORMATS`](super::FORMATS).
///
/// Formats with the same extension are equal.
#[derive(Debug, Clone, Copy)]
pub struct Format {
    /// Extension, title and files.
    pub file: FileFormat,
    /// Media type of the file on the web.
    pub media_type: &'static str,
    /// Parts of a run that the file describes.
    pub needs: &'static [Need],
    /// Set if the file can include ids and attributes of features ([`SceneFacts::metadata`](super::SceneFacts)).
    pub has_metadata: bool,
    /// Detail of a surface's material in the file; `None` for files without surfaces.
    pub surface: Option<SurfaceDetail>,
    /// Set if copies of textures are written next to the file.
    pub has_textures: bool,
    /// Function that writes an export to a future file.
    pub write: fn(&Export<'_>, &Path, &mut Files) -> Result<()>,
}

/// Detail of a surface's material that a format has, each with all of the ones before.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum SurfaceDetail {
    /// Surfaces without materials.
    Outline,
    /// A colour, with the mean of the texture.
    Color,
    /// A texture.
    Texture,
    /// A normal map with the coordinates of the texture.
    Relief,
    /// A dirt map with coordinates of its own.
    Full,
}

/// Part of a run that a format describes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Need {
    /// Scene. Without it the format describes no drawing.
    Scene,
    /// Camera and size of a render.
    Picture,
    /// Attributes of features.
    Attributes,
    /// Layers of modules that have a geometry.
    Layers,
    /// Sums that interpretations report.
    Reports,
    /// Recipe of the model, if there is one.
    Recipe,
}

impl FileFormat {
    /// Returns the extension, in lower case and without a dot.
    pub const fn extension(&self) -> &'static str {
        match self.extensions {
            [first, ..] => first,
            [] => "",
        }
    }

    /// Fails if this program was built without the format.
    pub fn check(&self) -> Result<()> {
        (self.check)()
    }

    /// Returns the path of the second file that the file at `path` can have.
    pub fn companion(&self, path: &Path) -> Option<PathBuf> {
        self.companion.map(|companion| companion(path))
    }

    /// Returns the part of a file name before the extension, in upper or lower case. `None` if the name has another
    /// extension or no such part.
    pub fn stem<'a>(&self, name: &'a str) -> Option<&'a str> {
        self.extensions.iter().find_map(|extension| {
            let (stem, end) = name.split_at_checked(name.len().checked_sub(extension.len())?)?;
            let stem = stem.strip_suffix('.').filter(|_| end.eq_ignore_ascii_case(extension))?;
            (!stem.is_empty()).then_some(stem)
        })
    }
}

impl Format {
    /// Returns the extension, in lower case and without a dot.
    pub const fn extension(&self) -> &'static str {
        self.file.extension()
    }

    /// Returns true if the format describes this part of a run.
    pub fn needs(&self, need: Need) -> bool {
        self.needs.contains(&need)
    }

    /// Returns true if a scene and a camera are enough for the format.
    pub fn is_of_scenes(&self) -> bool {
        self.needs.iter().all(|need| matches!(need, Need::Scene | Need::Picture | Need::Recipe))
    }
}

impl PartialEq for Format {
    fn eq(&self, other: &Self) -> bool {
        self.extension() == other.extension()
    }
}

impl Eq for Format {}

impl AsRef<FileFormat> for Format {
    fn as_ref(&self) -> &FileFormat {
        &self.file
    }
}

/// Accepts a format that every build of the program has.
pub(super) fn always() -> Result<()> {
    Ok(())
}

/// Lists the extensions of `formats`, with `word` before the last one: ".glb, .gltf and .obj".
pub fn extension_list<'a, F: AsRef<FileFormat> + 'a>(
    formats: impl IntoIterator<Item = &'a F>,
    word: &str,
) -> String {
    let extensions: Vec<String> = formats.into_iter().map(dotted).collect();
    match extensions.as_slice() {
        [others @ .., last] if !others.is_empty() => format!("{} {word} {last}", others.join(", ")),
        few => few.concat(),
    }
}

/// Returns the format of `formats` that the extension of `path` names, in upper or lower case.
///
/// Fails on an unknown or missing extension; the error lists the known ones.
pub(super) fn find<'a, F: AsRef<FileFormat>>(formats: &'a [F], path: &Path) -> Result<&'a F> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    if let Some(format) = formats.iter().find(|format| (*format).as_ref().stem(&name).is_some()) {
        return Ok(format);
    }
    let known = format!("supported formats are {}", extension_list(formats, "and"));
    let Some(extension) = path.extension() else {
        let message = format!("cannot write {}: missing file extension", path.display());
        return Err(Error::usage(message).help(known));
    };
    let extension = extension.to_string_lossy();
    let message = format!("cannot write {}: unknown file extension .{extension}", path.display());
    let extensions: Vec<String> = formats.iter().map(dotted).collect();
    let meant = extensions.iter().map(String::as_str);
    Err(Error::not_found("format", format!(".{extension}"), meant, message).help(known))
}

/// Returns the extension of `format` with its dot.
fn dotted<F: AsRef<FileFormat>>(format: &F) -> String {
    format!(".{}", format.as_ref().extension())
}
