//! `burgeon run --frames` and `--turntable`: films.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Instant;

use super::RunCommand;
use crate::commands::progress::ProgressDisplay;
use crate::commands::report;
use crate::commands::shared::end_on_interrupt;
use burgeon::export::films::{FILM_FORMATS, FilmContent, FilmFormat, FilmSettings, FilmWriter};
use burgeon::export::{Format, PNG, extension_list};
use burgeon::films::{Film, FrameAxis, MOST_FRAMES, Turntable};
use burgeon::picture::{Background, Picture};
use burgeon::{Error, Result, Stop};
use clap::Args;
use serde_json::json;

/// Flags of films.
#[derive(Args, Clone)]
pub(crate) struct FilmFlags {
    /// Writes a film
    #[arg(long, value_name = "[NAME=]FIRST:LAST:STEP", value_parser = axis, help = frames_help(), help_heading = "Films")]
    #[arg(allow_hyphen_values = true, group = "film", conflicts_with_all = OTHERS)]
    pub(super) frames: Option<FrameAxis>,

    /// Writes a film of N frames in which the camera goes once around the model
    #[arg(long, value_name = "N", value_parser = turns, help_heading = "Films", allow_negative_numbers = true)]
    #[arg(group = "film", conflicts_with_all = OTHERS, conflicts_with_all = ["camera", "from"])]
    pub(super) turntable: Option<u32>,

    /// Frames per second of a film
    #[arg(long, value_name = "N", value_parser = speed, default_value_t = 25.0, help_heading = "Films")]
    #[arg(allow_negative_numbers = true, requires = "film")]
    pub(super) fps: f64,

    /// Maximum number of frames of a film
    #[arg(long, value_name = "N", value_parser = frame_count, default_value_t = MOST_FRAMES, help_heading = "Limits")]
    #[arg(allow_negative_numbers = true, requires = "film")]
    pub(super) frame_limit: u32,
}

/// Options that a film does not have.
const OTHERS: [&str; 11] = [
    "quality",
    "watch",
    "parts",
    "part",
    "save_preset",
    "chain",
    "heights",
    "edits",
    "tiles",
    "metadata",
    "report",
];

fn frames_help() -> String {
    let formats = extension_list(&FILM_FORMATS, "or");
    format!(
        "Writes a film, one run for each value of the parameter time, or of NAME, to a {formats} file, or to a file for \
         each frame by a pattern such as frames/%04d.{}; steps is the number of steps",
        PNG.extension()
    )
}

impl RunCommand {
    /// Fails if an output is a film, for which options are missing.
    pub(super) fn refuse_films(&self) -> Result<()> {
        let is_film = |path: &&PathBuf| Format::of(path).is_err() && FilmFormat::of(path).is_ok();
        match self.output.iter().find(is_film) {
            Some(path) => {
                let message =
                    format!("{} holds the frames of a film, and this is a single run", path.display());
                Err(Error::usage(message).help("add --frames FIRST:LAST:STEP or --turntable N"))
            }
            None => Ok(()),
        }
    }

    /// Returns the settings of a film with `frames` frames, and the picture of its renders.
    fn film_settings(&self, frames: u32) -> (FilmSettings, Picture) {
        let picture = self.picture.picture(self.size);
        let transparent = picture.background == Background::Clear;
        (FilmSettings { frames, fps: self.film.fps, size: self.size, transparent }, picture)
    }

    /// Creates the writer of a film. Fails if there is no output, or if one of them cannot hold the film.
    fn film_writer(&self, settings: FilmSettings, memory: usize, stop: &Arc<Stop>) -> Result<FilmWriter> {
        if self.output.is_empty() {
            return Err(Error::usage("a film has no file").help(format!(
                "write it to a {} file, such as -o film.{}",
                extension_list(&FILM_FORMATS, "or"),
                FILM_FORMATS[0].extension()
            )));
        }
        FilmWriter::new(&self.output, settings, memory, stop)
    }

    /// Writes a film over the values of a parameter.
    pub(super) fn run_frames(&self, axis: &FrameAxis) -> Result<()> {
        end_on_interrupt()?;
        let begin = Instant::now();
        let mut options = self.script.options()?;
        // A film prints the texts of all its runs only if their places are wanted.
        options.reports.print = None;
        self.place_prints(&mut options);
        if options.params.set.iter().any(|(name, _)| name == axis.name()) {
            let name = axis.name();
            return Err(Error::usage(format!("--set and --frames both use `{name}`; remove one"))
                .help(format!("remove --set {name} or --frames {name}")));
        }
        let strict = options.strict;
        let (settings, picture) = self.film_settings(axis.count_within(self.film.frame_limit)?);
        let mut writer = self.film_writer(settings, options.limits.memory, &Arc::default())?;
        let film = Film::new(&self.script.script, options, axis, self.film.frame_limit)?;
        let mut warnings = Vec::new();
        {
            let progress = Arc::clone(&film.progress);
            let _progress = ProgressDisplay::saying(move || progress.message(), !self.script.json);
            let mut checked = false;
            film.make(writer.needs(), &picture, |frame| {
                if !checked {
                    refuse_inputs(&writer, &film.inputs())?;
                    checked = true;
                }
                writer.add(frame)
            })?;
            warnings.extend(writer.take_warnings());
            if let (true, Some(first)) = (strict, warnings.first()) {
                return Err(first.clone().into_error());
            }
            writer.finish()?;
        }
        let (modules, triangles) = film.largest();
        warnings.splice(..0, film.warnings());
        if self.script.json {
            let document = json!({
                "ok": true,
                "frames": settings.frames,
                "fps": settings.fps,
                "param": axis.name(),
                "values": [axis.value(0), axis.value(settings.frames - 1)],
                "modules": modules,
                "triangles": triangles,
                "warnings": report::warnings_json(&warnings),
                "seconds": { "film": settings.time_of(settings.frames), "total": begin.elapsed().as_secs_f64() },
                "peak_memory_mb": report::peak_memory(),
            });
            return report::print(&format!("{document}\n"));
        }
        report::eprint(&film_text(&settings, begin));
        report::eprint(&format!("up to {}\n", report::sizes(modules, triangles)));
        report::eprint(&report::memory_text());
        report::eprint(&report::warnings(&warnings));
        Ok(())
    }

    /// Runs the script once, and writes a film of its model from all sides.
    pub(super) fn run_turntable(&self, frames: u32) -> Result<()> {
        end_on_interrupt()?;
        let begin = Instant::now();
        if frames > self.film.frame_limit {
            let most = self.film.frame_limit;
            return Err(Error::usage(format!("{frames} frames exceed the maximum of {most}"))
                .help("use fewer frames, or raise the limit: --frame-limit N"));
        }
        let session = self.session()?;
        let (settings, picture) = self.film_settings(frames);
        let mut writer = self.film_writer(settings, session.options.limits.memory, &session.stop)?;
        if writer.needs().scenes {
            let images = FILM_FORMATS.iter().filter(|it| matches!(it.content, FilmContent::Images(_)));
            return Err(Error::usage("a turntable consists of renders, and a model file cannot hold them")
                .help(format!(
                    "write a {} file, or a pattern such as frames/%04d.{}",
                    extension_list(images, "or"),
                    PNG.extension()
                )));
        }
        let mut run = {
            let _progress = ProgressDisplay::show(&session, !self.script.json);
            burgeon::run_session(&session)?
        };
        if run.systems.is_empty() {
            let script = self.script.script.display();
            return Err(Error::script(format!("{script} derives no system, so there is nothing to show"))
                .help("end it with system:derive()"));
        }
        run.note_packages(&session)?;
        let inputs = session.sought().into_iter().filter(|(_, exists)| *exists).map(|(path, _)| path);
        refuse_inputs(&writer, &inputs.collect())?;
        let rendering = Instant::now();
        let done = Arc::new(AtomicU32::new(0));
        {
            let shown = Arc::clone(&done);
            let message = move || format!("{} of {frames} frames", shown.load(Ordering::Relaxed));
            let _progress = ProgressDisplay::saying(message, !self.script.json);
            let turntable = Turntable::new(&run.scene, &picture, frames, &done)?;
            let threads = session.options.worker_threads();
            turntable.make(writer.needs(), threads, &session.stop, |frame| writer.add(frame))?;
            writer.finish()?;
        }
        let (writing, total) = (rendering.elapsed(), begin.elapsed());
        if self.script.json {
            let mut summary = report::summary_json(&run, writing, total);
            (summary["frames"], summary["fps"]) = (frames.into(), settings.fps.into());
            report::print(&format!("{summary}\n"))?;
        } else {
            report::eprint(&film_text(&settings, begin));
            report::eprint(&report::summary(&run, writing, total, None));
        }
        // Exiting the process frees all memory at once, which is faster than dropping the values.
        std::mem::forget((run, session));
        Ok(())
    }
}

/// Returns the line of a summary about the film.
fn film_text(settings: &FilmSettings, begin: Instant) -> String {
    let FilmSettings { frames, fps, .. } = settings;
    let seconds = settings.time_of(*frames);
    format!(
        "{frames} frames, {seconds:.2} s at {fps} frames per second; {} in all\n",
        report::time(begin.elapsed())
    )
}

/// Fails if a file of the film is one that the script has read.
fn refuse_inputs(writer: &FilmWriter, inputs: &BTreeSet<PathBuf>) -> Result<()> {
    let read: BTreeSet<PathBuf> = inputs.iter().filter_map(|path| path.canonicalize().ok()).collect();
    let is_read =
        |path: &PathBuf| path.canonicalize().is_ok_and(|path| path.is_file() && read.contains(&path));
    match writer.paths().into_iter().find(is_read) {
        Some(path) => Err(Error::usage(format!("cannot write {}: the script reads it", path.display()))
            .help("specify another file")),
        None => Ok(()),
    }
}

fn axis(text: &str) -> Result<FrameAxis, String> {
    text.parse::<FrameAxis>().map_err(|error| error.to_string())
}

fn turns(text: &str) -> Result<u32, &'static str> {
    match text.parse() {
        Ok(frames) if frames >= 2 => Ok(frames),
        _ => Err("write an integer of at least 2"),
    }
}

fn frame_count(text: &str) -> Result<u32, &'static str> {
    match text.parse() {
        Ok(frames) if frames > 0 => Ok(frames),
        _ => Err("write an integer of at least 1"),
    }
}

fn speed(text: &str) -> Result<f64, &'static str> {
    match text.parse::<f64>() {
        Ok(fps) if (0.1..=1000.0).contains(&fps) => Ok(fps),
        _ => Err("write a number of frames per second from 0.1 to 1000"),
    }
}
