//! Table of the formats of films.
//!
//! The command line, its help and errors read this table. A new format is a row here.

use super::encode;
use super::encoder::FrameEncoder;
use crate::files::Files;
use crate::film_model::FilmModel;
use crate::film_settings::FilmSettings;
use crate::format::{FileFormat, always, find};
use crate::gltf;
use burgeon_base::error::Result;
use burgeon_scene::image;
use std::io;
use std::path::Path;

/// Format of a film: a row of [`FILM_FORMATS`].
#[derive(Debug, Clone, Copy)]
pub struct FilmFormat {
    /// Extension, title and files.
    pub file: FileFormat,
    /// Media type of the file on the web.
    pub media_type: &'static str,
    /// Maximum number of frames per second.
    pub fastest: f64,
    /// Content of a frame.
    pub content: FilmContent,
}

/// Content of the frames of a film.
#[derive(Debug, Clone, Copy)]
pub enum FilmContent {
    /// Renders, with the function that creates an encoder.
    Images(fn(&FilmSettings) -> io::Result<Box<dyn FrameEncoder>>),
    /// Scenes, with the function that writes all of them.
    Scenes(fn(&FilmModel, &FilmSettings, &Path, &mut Files) -> Result<()>),
}

/// All formats of films, in the order in which messages list them.
pub static FILM_FORMATS: [FilmFormat; 3] = [
    FilmFormat {
        file: FileFormat {
            extensions: &["gif"],
            title: "animated GIF, with a palette for each frame",
            companion: None,
            check: image::check,
        },
        media_type: "image/gif",
        // Browsers slow down films with delays below 1/50 s.
        fastest: 50.0,
        content: FilmContent::Images(encode::gif),
    },
    FilmFormat {
        file: FileFormat {
            extensions: &["apng"],
            title: "animated PNG, with all colours",
            companion: None,
            check: image::check,
        },
        media_type: "image/apng",
        fastest: 1000.0,
        content: FilmContent::Images(encode::apng),
    },
    FilmFormat {
        file: FileFormat {
            extensions: &["glb"],
            title: "glTF 2.0 with an animation that shows one model after another",
            companion: None,
            check: always,
        },
        media_type: "model/gltf-binary",
        fastest: 1000.0,
        content: FilmContent::Scenes(gltf::write_film),
    },
];

impl FilmFormat {
    /// Returns the extension, in lower case and without a dot.
    pub const fn extension(&self) -> &'static str {
        self.file.extension()
    }

    /// Returns the format that the extension of `path` names, in upper or lower case.
    ///
    /// Fails on an unknown or missing extension; the error lists the known ones.
    ///
    /// ```
    /// use burgeon_export::films::FilmFormat;
    /// use std::path::Path;
    ///
    /// assert_eq!(FilmFormat::of(Path::new("growth.GIF"))?.media_type, "image/gif");
    /// assert!(FilmFormat::of(Path::new("growth.obj")).is_err());
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn of(path: &Path) -> Result<&'static Self> {
        find(&FILM_FORMATS, path)
    }
}

impl AsRef<FileFormat> for FilmFormat {
    fn as_ref(&self) -> &FileFormat {
        &self.file
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn each_row_has_an_extension_a_title_a_media_type_and_a_speed() {
        let extensions: BTreeSet<&str> = FILM_FORMATS.iter().map(FilmFormat::extension).collect();
        assert_eq!(extensions.len(), FILM_FORMATS.len());
        for format in &FILM_FORMATS {
            assert!(
                !format.extension().is_empty() && format.extension() == format.extension().to_lowercase()
            );
            assert!(
                !format.file.title.is_empty() && format.media_type.contains('/') && format.fastest >= 25.0
            );
        }
    }
}
