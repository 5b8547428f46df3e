//! Writes a film to one or several files, frame by frame.

use super::encoder::FrameEncoder;
use super::formats::{FILM_FORMATS, FilmContent, FilmFormat};
use super::pattern::FramePattern;
use crate::files::{Files, OpenFile};
use crate::film_model::FilmModel;
use crate::film_settings::FilmSettings;
use crate::format::{Format, Need, extension_list};
use crate::{Export, PNG, SceneFacts, stem};
use burgeon_base::Warning;
use burgeon_base::error::{Error, Result};
use burgeon_base::stop::Stop;
use burgeon_picture::Picture;
use burgeon_scene::Scene;
use burgeon_scene::image::{Image, encode};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Parts of a frame that a [`FilmWriter`] needs.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct FilmNeeds {
    /// Set if it needs renders.
    pub images: bool,
    /// Set if it needs renders as PNG files.
    pub files: bool,
    /// Set if it needs scenes.
    pub scenes: bool,
}

/// Frame of a film, with the parts that [`FilmWriter::needs`] names.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FilmFrame {
    /// Render.
    pub image: Option<Image>,
    /// Render as a PNG file.
    pub file: Option<Vec<u8>>,
    /// Scene.
    pub scene: Option<Scene>,
}

impl FilmFrame {
    /// Creates a frame of a render, encoded if `needs` says so.
    pub fn of_image(needs: FilmNeeds, image: Image) -> Result<Self> {
        let file = needs.files.then(|| encode(&image)).transpose()?;
        Ok(Self { image: Some(image), file, scene: None })
    }
}

/// Writer of a film.
///
/// ```
/// use burgeon_base::Stop;
/// use burgeon_export::films::{FilmFrame, FilmSettings, FilmWriter};
/// use burgeon_scene::image::Image;
/// use std::sync::Arc;
///
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("night.gif");
/// let settings = FilmSettings { frames: 2, fps: 25.0, size: (8, 6), transparent: false };
/// let mut film = FilmWriter::new(&[path.clone()], settings, 1 << 30, &Arc::new(Stop::new()))?;
/// for grey in [40, 20] {
///     let image = Some(Image::filled(8, 6, [grey, grey, grey, 255]));
///     film.add(FilmFrame { image, ..FilmFrame::default() })?;
/// }
/// assert!(!path.exists());
/// film.finish()?;
/// assert!(std::fs::read(&path)?.starts_with(b"GIF89a"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct FilmWriter {
    settings: FilmSettings,
    targets: Vec<FilmTarget>,
    /// Models of all frames, if a target needs them.
    model: Option<FilmModel>,
    files: Files,
    /// Number of frames so far.
    number: usize,
}

/// File of a film, or files of its frames.
enum FilmTarget {
    Frames(&'static Format, FramePattern),
    Images(PathBuf, fn(&FilmSettings) -> io::Result<Box<dyn FrameEncoder>>, Option<Box<FrameFile>>),
    Scenes(PathBuf, fn(&FilmModel, &FilmSettings, &Path, &mut Files) -> Result<()>),
}

/// Animated image that is being written.
struct FrameFile {
    file: OpenFile,
    encoder: Box<dyn FrameEncoder>,
}

impl FrameFile {
    fn open(
        files: &Files,
        path: &Path,
        encoder: fn(&FilmSettings) -> io::Result<Box<dyn FrameEncoder>>,
        settings: &FilmSettings,
    ) -> Result<Self> {
        let file = files.open(path)?;
        let encoder = encoder(settings).map_err(|error| file.error(&error))?;
        Ok(Self { file, encoder })
    }

    fn add(&mut self, image: &Image) -> Result<()> {
        self.encoder.add(image, self.file.out()).map_err(|error| self.file.error(&error))
    }

    fn finish(self, files: &mut Files) -> Result<()> {
        let Self { mut file, encoder } = self;
        encoder.finish(file.out()).map_err(|error| file.error(&error))?;
        files.close(file)
    }
}

impl FilmWriter {
    /// Creates a writer of a film to these `paths`: files in one of the [`FILM_FORMATS`], and patterns of names with one
    /// file for each frame. Models in memory may take `memory` (bytes).
    ///
    /// Fails if a format cannot hold frames or cannot be this fast, or if a file could not be written.
    pub fn new(paths: &[PathBuf], settings: FilmSettings, memory: usize, stop: &Arc<Stop>) -> Result<Self> {
        let targets: Vec<FilmTarget> =
            paths.iter().map(|path| FilmTarget::of(path, &settings)).collect::<Result<_>>()?;
        let has_scenes = targets.iter().any(|target| matches!(target, FilmTarget::Scenes(..)));
        let model = has_scenes.then(|| FilmModel::new(memory));
        // Written to find out whether it is possible, and dropped.
        let mut files = Files::default();
        for target in &targets {
            match target {
                FilmTarget::Frames(_, pattern) => {
                    pattern.folder().map_or(Ok(()), |folder| files.folder(folder))?;
                    files.write(&pattern.path(0), |_| Ok(()))?;
                }
                FilmTarget::Images(path, ..) | FilmTarget::Scenes(path, _) => {
                    files.write(path, |_| Ok(()))?
                }
            }
        }
        Ok(Self { settings, targets, model, files: Files::new(stop), number: 0 })
    }

    /// Returns the parts of a frame that [`add`](Self::add) takes.
    pub fn needs(&self) -> FilmNeeds {
        let mut needs = FilmNeeds::default();
        for target in &self.targets {
            match target {
                FilmTarget::Frames(format, _) if format.needs(Need::Picture) => {
                    (needs.images, needs.files) = (true, true);
                }
                FilmTarget::Images(..) => needs.images = true,
                FilmTarget::Frames(..) | FilmTarget::Scenes(..) => needs.scenes = true,
            }
        }
        needs
    }

    /// Returns the paths of all files that the film writes.
    pub fn paths(&self) -> Vec<PathBuf> {
        let paths = self.targets.iter().flat_map(|target| match target {
            FilmTarget::Frames(format, pattern) => {
                let paths = (0..self.settings.frames as usize).map(|number| pattern.path(number));
                paths.flat_map(|path| format.file.companion(&path).into_iter().chain([path])).collect()
            }
            FilmTarget::Images(path, ..) | FilmTarget::Scenes(path, _) => vec![path.clone()],
        });
        paths.collect()
    }

    /// Adds the next frame. A file of a single frame is complete afterwards.
    ///
    /// Fails if a file cannot be written, if a scene is invalid, or if the models take too much memory.
    pub fn add(&mut self, frame: FilmFrame) -> Result<()> {
        let missing = || Error::internal("a frame of the film is incomplete");
        for target in &mut self.targets {
            match target {
                FilmTarget::Frames(format, pattern) => {
                    let mut files = Files::new(&self.files.stop());
                    pattern.folder().map_or(Ok(()), |folder| files.folder(folder))?;
                    let path = pattern.path(self.number);
                    if format.needs(Need::Picture) {
                        let bytes = frame.file.as_ref().ok_or_else(missing)?;
                        files.write(&path, |out| out.write_all(bytes))?;
                    } else {
                        let scene = frame.scene.as_ref().ok_or_else(missing)?;
                        let (picture, facts) = (&Picture::default(), SceneFacts::default());
                        format.export(&Export { scene, picture, facts }, &path, &mut files)?;
                        if self.number == 0 {
                            self.files.warn_all(files.take_warnings());
                        }
                    }
                    files.publish()?;
                }
                FilmTarget::Images(path, encoder, file) => {
                    if file.is_none() {
                        *file = Some(Box::new(FrameFile::open(&self.files, path, *encoder, &self.settings)?));
                    }
                    let image = frame.image.as_ref().ok_or_else(missing)?;
                    file.as_mut().map_or_else(|| Err(missing()), |file| file.add(image))?;
                }
                FilmTarget::Scenes(..) => {}
            }
        }
        if let Some(model) = &mut self.model {
            model.add(frame.scene.ok_or_else(missing)?)?;
        }
        self.number += 1;
        Ok(())
    }

    /// Takes the warnings about the files of the first frame, which are alike in the others.
    pub fn take_warnings(&mut self) -> Vec<Warning> {
        self.files.take_warnings()
    }

    /// Publishes the files of all frames together. Fails if frames are missing.
    pub fn finish(self) -> Result<()> {
        let Self { settings, targets, model, mut files, number } = self;
        if number != settings.frames as usize {
            return Err(Error::internal(format!("the film has {number} frames of {}", settings.frames)));
        }
        for target in targets {
            match target {
                FilmTarget::Images(_, _, Some(file)) => file.finish(&mut files)?,
                FilmTarget::Scenes(path, write) => {
                    model.as_ref().map_or(Ok(()), |model| write(model, &settings, &path, &mut files))?;
                }
                FilmTarget::Images(..) | FilmTarget::Frames(..) => {}
            }
        }
        files.publish()
    }
}

impl FilmTarget {
    /// Returns the target at `path`. Fails if its format cannot hold the frames.
    fn of(path: &Path, settings: &FilmSettings) -> Result<Self> {
        if let Some(pattern) = FramePattern::of(path)? {
            let format = Format::of(path)?;
            format.file.check()?;
            if !format.is_of_scenes() {
                return Err(cannot_hold(path));
            }
            return Ok(Self::Frames(format, pattern));
        }
        let Ok(format) = FilmFormat::of(path) else {
            Format::of(path)?;
            return Err(cannot_hold(path));
        };
        format.file.check()?;
        if settings.fps > format.fastest {
            let (extension, fastest) = (format.extension(), format.fastest);
            let message =
                format!("a .{extension} file has at most {fastest} frames per second, not {}", settings.fps);
            return Err(Error::usage(message).help(format!("use --fps {fastest} or less")));
        }
        let path = path.to_owned();
        Ok(match format.content {
            FilmContent::Images(encoder) => Self::Images(path, encoder, None),
            FilmContent::Scenes(write) => Self::Scenes(path, write),
        })
    }
}

/// Returns the error for a file whose format cannot hold frames.
fn cannot_hold(path: &Path) -> Error {
    let films = extension_list(&FILM_FORMATS, "and");
    let extension = match Format::of(path) {
        Ok(format) if format.is_of_scenes() => format.extension(),
        _ => PNG.extension(),
    };
    let name = path.with_file_name(format!("{}-%04d.{extension}", stem(path)));
    Error::usage(format!("{} cannot hold the frames of a film", path.display())).help(format!(
        "write {films} files, or one file for each frame by a pattern such as {}",
        name.display()
    ))
}
