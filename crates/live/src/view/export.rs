//! Download of the present model as a file, in the formats of a scene.

use std::fs::{self, File};
use std::io::{BufReader, Cursor};
use std::sync::Arc;

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::message::FormatMessage;
use burgeon_base::error::{Error, ErrorKind, Result};
use burgeon_base::stop::Stop;
use burgeon_engine::script::RecipeDraft;
use burgeon_export::{Export, FORMATS, Files, Format, Need};
use burgeon_picture::{Background, Picture, SunPosition};
use burgeon_scene::Recipe;

/// Maximum width and height (pixels) of a render.
const LARGEST: u32 = 8192;

/// Least distance (m) at which haze hides two thirds of a surface.
const DENSEST: f64 = 1e-3;

/// File to download.
pub(super) struct Download {
    /// Suggested file name.
    pub name: String,
    pub media_type: &'static str,
    pub bytes: Vec<u8>,
}

/// Returns the formats that a page offers: those of a scene that this program was built with.
pub(super) fn downloads() -> Vec<FormatMessage> {
    let formats = FORMATS.iter().filter(|format| format.is_of_scenes() && format.file.check().is_ok());
    let message = |format: &Format| FormatMessage {
        extension: format.extension(),
        title: format.file.title,
        picture: format.needs(Need::Picture),
    };
    formats.map(message).collect()
}

/// Returns the result of `make`, which runs in a separate thread pool. Runs in progress share the global pool and must
/// not wait for a large render.
pub(super) fn run_separately<T: Send>(make: impl FnOnce() -> T + Send) -> T {
    match rayon::ThreadPoolBuilder::new().thread_name(|_| "burgeon export".to_owned()).build() {
        Ok(pool) => pool.install(make),
        Err(_) => make(),
    }
}

/// Returns the recipe of the present model; `None` if it would be too large.
pub(super) fn complete(draft: &RecipeDraft) -> Result<Option<Recipe>> {
    match draft.complete() {
        Err(error) if matches!(error.kind(), ErrorKind::Limit(_)) => Ok(None),
        recipe => recipe.map(Some),
    }
}

/// Encodes a model as a file called `name`, whose extension selects the format. Several files are combined into one archive.
/// Fails soon after a stop was requested.
pub(super) fn download(export: &Export<'_>, name: &str, stop: &Arc<Stop>) -> Result<Download> {
    stop.check()?;
    let format = Format::of(name.as_ref())?;
    let stem = format.file.stem(name).unwrap_or(name);
    // The parts of a model refer to each other by the stem.
    let stem: String =
        stem.chars().map(|it| if it.is_alphanumeric() || "-_. ()".contains(it) { it } else { '_' }).collect();
    let stem = stem.trim_matches(['.', ' ']);
    let stem = if stem.is_empty() { "model" } else { stem };
    let name = format!("{stem}.{}", format.extension());
    let failed = |error: std::io::Error| Error::system(format!("cannot write a temporary file: {error}"));
    let folder = tempfile::tempdir().map_err(failed)?;
    let mut written = Files::new(stop);
    written.export(export, &folder.path().join(&name))?;
    written.publish()?;
    let mut files = Vec::new();
    for entry in fs::read_dir(folder.path()).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        files.push((entry.file_name().to_string_lossy().into_owned(), entry.path()));
    }
    files.sort();
    if let [(_, path)] = &files[..] {
        return Ok(Download { name, media_type: format.media_type, bytes: fs::read(path).map_err(failed)? });
    }
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .compression_level(Some(1))
        .large_file(true);
    for (name, path) in files {
        stop.check()?;
        archive.start_file(name, options).map_err(|error| Error::internal(error.to_string()))?;
        // A large model in memory in addition to its archive would need too much memory.
        let mut file = BufReader::with_capacity(1 << 18, File::open(&path).map_err(failed)?);
        std::io::copy(&mut file, &mut archive).map_err(failed)?;
    }
    let bytes = archive.finish().map_err(|error| Error::internal(error.to_string()))?.into_inner();
    Ok(Download { name: format!("{stem}.{}.zip", format.extension()), media_type: "application/zip", bytes })
}

/// Parses the render settings in the query of a URL: `azimuth`, `elevation` (degrees), `width`, `height` (pixels),
/// `sun_azimuth`, `sun_elevation` (degrees), `haze` (m), and `sky`, which is 1 for a background with a sky.
///
/// Sizes that would take too long are reduced. Fails on other names and on values that are not numbers.
pub(super) fn picture(query: &str) -> Result<Picture> {
    let mut picture = Picture::default();
    let mut sun = [None; 2];
    for pair in query.split('&').filter(|pair| !pair.is_empty()) {
        let (name, value) = pair.split_once('=').unwrap_or((pair, ""));
        let number: f64 = value
            .parse()
            .ok()
            .filter(|number: &f64| number.is_finite())
            .ok_or_else(|| Error::argument(format!("{name} is a number, not {value:?}")))?;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "bounded before")]
        let pixels = number.clamp(1.0, f64::from(LARGEST)).round() as u32;
        match name {
            "azimuth" => picture.azimuth = Some(number.rem_euclid(360.0)),
            "elevation" => picture.elevation = Some(number.clamp(-90.0, 90.0)),
            "width" => picture.width = pixels,
            "height" => picture.height = pixels,
            "sun_azimuth" => sun[0] = Some(number.rem_euclid(360.0)),
            "sun_elevation" => sun[1] = Some(number.clamp(1.0, 90.0)),
            "haze" => picture.haze = Some(number.max(DENSEST)),
            "sky" if number > 0.0 => picture.background = Background::Sky,
            "sky" => {}
            _ => {
                return Err(Error::argument(format!("unknown field {name:?} of an image")).help(
                    "it has azimuth, elevation, width, height, sun_azimuth, sun_elevation, haze and sky",
                ));
            }
        }
    }
    if let [Some(azimuth), Some(elevation)] = sun {
        picture.sun = Some(SunPosition { azimuth, elevation });
    }
    Ok(picture)
}

#[cfg(test)]
mod tests {
    use super::*;
    use burgeon_export::SceneFacts;
    use burgeon_scene::Scene;

    #[test]
    fn a_run_does_not_wait_for_an_export() {
        use std::sync::Mutex;
        use std::sync::mpsc::channel;
        use std::time::Duration;

        let (begun, begins) = channel();
        let (ended, ends) = channel();
        let (begun, ends) = (Mutex::new(begun), Mutex::new(ends));
        let export = std::thread::spawn(move || {
            run_separately(|| {
                rayon::broadcast(|_| {
                    begun.lock().unwrap().send(()).unwrap();
                    // All threads of the pool are busy until the run has ended.
                    ends.lock().unwrap().recv_timeout(Duration::from_secs(5)).is_ok()
                })
            })
        });
        begins.recv().unwrap();
        let busy = rayon::current_num_threads();
        rayon::join(|| (), || ());
        (0..busy).for_each(|_| ended.send(()).unwrap());
        assert!(export.join().unwrap().into_iter().all(|ended| ended));
    }

    #[test]
    fn a_page_offers_the_formats_of_a_scene_and_sends_its_camera_for_renders() {
        let offered = downloads();
        let extensions: Vec<&str> = offered.iter().map(|format| format.extension).collect();
        assert!(extensions.contains(&"glb") && !extensions.contains(&"gpkg"), "{extensions:?}");
        let pictures = offered.iter().filter(|format| format.picture).map(|format| format.extension);
        let expected: &[&str] = if burgeon_export::PNG.file.check().is_ok() { &["png"] } else { &[] };
        assert_eq!(pictures.collect::<Vec<_>>(), expected);
    }

    #[test]
    fn a_query_wishes_a_picture_of_at_most_the_largest_size() {
        let wished = picture("azimuth=-30&elevation=95.5&width=99999&height=0").unwrap();
        assert_eq!((wished.azimuth, wished.elevation), (Some(330.0), Some(90.0)));
        assert_eq!((wished.width, wished.height), (LARGEST, 1));
        assert_eq!(picture("").unwrap(), Picture::default());
        let lit = picture("sun_azimuth=-90&sun_elevation=0&haze=250&sky=1").unwrap();
        assert_eq!(lit.sun, Some(SunPosition { azimuth: 270.0, elevation: 1.0 }));
        assert_eq!((lit.haze, lit.background), (Some(250.0), Background::Sky));
        assert_eq!(picture("sun_azimuth=5&sky=0").unwrap(), Picture::default());
        for wrong in ["width", "width=", "width=NaN", "height=inf", "depth=3", "width=1&=", "azimuth=%31"] {
            assert!(picture(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn names_lose_what_has_a_meaning_in_paths_and_formats_of_several_files_become_archives() {
        let scene = Scene::default();
        let picture = Picture::default();
        let export = Export { scene: &scene, picture: &picture, facts: SceneFacts::default() };
        let name = |name: &str| download(&export, name, &Arc::default()).map(|it| it.name);
        assert_eq!(name("to wer-2.glb").unwrap(), "to wer-2.glb");
        assert_eq!(name("../../etc/\"x\r\n.GLB").unwrap(), "_.._etc__x__.glb");
        assert_eq!(name("..glb").unwrap(), "model.glb");
        assert_eq!(name("tower.html").unwrap(), "tower.html");
        assert!(name("tower.obj").unwrap().starts_with("tower.obj"));
        assert!(name("tower.exe").is_err() && name("glb").is_err());
    }
}
