//! Runs of a script over the values of a parameter, and their renders with one camera.

use super::axis::FrameAxis;
use super::order::in_order;
use super::prints::FilmPrints;
use crate::variations::{find_param, scene_bytes};
use burgeon_base::error::{Error, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_base::stop::Stop;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_engine::run::run_session;
use burgeon_engine::script::{Control, DerivationStore, RunOptions, Session};
use burgeon_export::films::{FilmFrame, FilmNeeds};
use burgeon_picture::{Extent, Picture, Quality, render_within};
use burgeon_scene::Scene;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

/// Name that stands for the number of derivation steps, unless the script has a parameter of this name.
const STEPS: &str = "steps";

/// Film of a script: one run for each value of a parameter.
pub struct Film {
    /// Cancellation signal. After cancellation no further frames are delivered.
    pub stop: Arc<Stop>,
    /// Progress, for display.
    pub progress: Arc<FilmProgress>,
    script: PathBuf,
    options: RunOptions,
    axis: FrameAxis,
    frames: u32,
    /// Set if the frames differ in the number of steps.
    of_steps: bool,
    found: Mutex<FilmFindings>,
    prints: Option<FilmPrints>,
}

/// Counts of a film that is being made.
#[derive(Debug, Default)]
pub struct FilmProgress {
    /// Number of frames.
    frames: AtomicUsize,
    /// Number of measured and of completed frames.
    measured: AtomicUsize,
    made: AtomicUsize,
}

impl FilmProgress {
    /// Returns a progress message.
    pub fn message(&self) -> String {
        let load = |count: &AtomicUsize| count.load(Ordering::Relaxed);
        let (frames, measured, made) = (load(&self.frames), load(&self.measured), load(&self.made));
        match made {
            0 => format!("{measured} of {frames} frames measured"),
            _ => format!("{made} of {frames} frames"),
        }
    }
}

/// Observations of all runs so far.
#[derive(Default)]
struct FilmFindings {
    /// Files that the runs have read.
    inputs: BTreeSet<PathBuf>,
    warnings: Vec<Warning>,
    /// Set if a frame shows something.
    has_triangles: bool,
    /// Largest numbers of modules and triangles of a frame.
    modules: usize,
    triangles: usize,
}

/// Frame that was measured, with as much of it as there is memory for.
#[derive(Default)]
struct MeasuredFrame {
    /// Set if the model is inside the expected extent.
    is_expected: bool,
    extent: Extent,
    scene: Option<Scene>,
    /// Complete frame, whose render shows the expected extent.
    frame: Option<FilmFrame>,
}

/// Maximum number of frames from which the extent of the others is expected.
const SAMPLES: usize = 5;

impl Film {
    /// Prepares a film of `script` with the values of `axis`, at most `most` frames. The limits of `options` apply to
    /// each run, and the receiver of printed texts gets those of each frame when the frame is passed on.
    ///
    /// The name `steps` stands for the number of derivation steps, unless the script has a parameter of this name.
    /// Fails if there are too many frames, and if the script has no such parameter or rejects one of the values.
    pub fn new(script: &Path, mut options: RunOptions, axis: &FrameAxis, most: u32) -> Result<Self> {
        let frames = axis.count_within(most)?;
        let prints = options.reports.print.take().map(FilmPrints::new);
        let of_steps = match find_param(script, &options, axis.name()) {
            Ok(param) => {
                if !matches!(param.control, Control::Number { .. }) {
                    let message =
                        format!("param {} is not a number, so frames cannot run over it", param.name);
                    return Err(Error::argument(message).help("name a number: --frames NAME=FIRST:LAST:STEP"));
                }
                (0..frames).try_for_each(|number| param.accept(&axis.text(number)).map(|_| ()))?;
                false
            }
            Err(error) if axis.name() != STEPS || error.kind().code() != "not-found" => {
                return Err(error.help(format!(
                    "declare it, {} = param(\"{}\", {{ default = 1 }}), or name another: --frames NAME=FIRST:LAST:STEP",
                    axis.name(),
                    axis.name()
                )));
            }
            Err(_) => {
                if let Some(value) =
                    (0..frames).map(|number| axis.value(number)).find(|value| !is_step(*value))
                {
                    return Err(Error::argument(format!("{value} is not a number of steps"))
                        .help("use integers of at least 0, such as --frames steps=0:12"));
                }
                true
            }
        };
        if of_steps {
            // A longer derivation continues a shorter one.
            options.inputs.derivations.get_or_insert_with(|| Arc::new(DerivationStore::default()));
        }
        let progress = FilmProgress { frames: AtomicUsize::new(frames as usize), ..FilmProgress::default() };
        Ok(Self {
            stop: Arc::new(Stop::under(options.stop.take())),
            progress: Arc::new(progress),
            script: script.to_path_buf(),
            options,
            axis: axis.clone(),
            frames,
            of_steps,
            found: Mutex::default(),
            prints,
        })
    }

    /// Returns the number of frames.
    pub fn frames(&self) -> u32 {
        self.frames
    }

    /// Returns the files that the runs have read so far.
    pub fn inputs(&self) -> BTreeSet<PathBuf> {
        self.found.lock().recover().inputs.clone()
    }

    /// Returns the largest numbers of modules and of triangles of a frame.
    pub fn largest(&self) -> (usize, usize) {
        let found = self.found.lock().recover();
        (found.modules, found.triangles)
    }

    /// Returns the warnings of all runs, each once. Empty models are normal unless all of them are empty.
    pub fn warnings(&self) -> Vec<Warning> {
        let found = self.found.lock().recover();
        let is_normal = |warning: &Warning| warning.kind() == WarningKind::EmptyModel && found.has_triangles;
        let mut warnings: Vec<Warning> =
            found.warnings.iter().filter(|warning| !is_normal(warning)).cloned().collect();
        warnings.sort_by(|a, b| {
            let places = (a.place().is_none(), a.place()).cmp(&(b.place().is_none(), b.place()));
            places.then_with(|| a.message().cmp(b.message()))
        });
        warnings
    }

    /// Makes all frames, with the parts that `needs` names, and passes each to `take`, in order. `picture` has the
    /// settings of the renders, which share a camera that shows the model of every frame completely, unless the picture
    /// has its own view.
    ///
    /// If there are renders, all scripts run before the first frame is passed on. Renders that would take more than a
    /// quarter of the memory limit are made again. Fails if a frame fails, with its error, or if `picture` is invalid.
    pub fn make(
        &self,
        needs: FilmNeeds,
        picture: &Picture,
        mut take: impl FnMut(FilmFrame) -> Result<()>,
    ) -> Result<()> {
        picture.check()?;
        let count = self.frames as usize;
        let picture = Picture { quality: Quality::Film, ..picture.clone() };
        let (extent, waiting) = match needs.images {
            true => self.measure_all(needs, &picture).inspect_err(|_| self.pass_prints(count))?,
            false => Default::default(),
        };
        let frame = |number: usize| {
            let measured = waiting.get(number).map(|frame| std::mem::take(&mut *frame.lock().recover()));
            let measured = measured.unwrap_or_default();
            let frame = match (measured.frame, measured.scene) {
                (Some(frame), _) => frame,
                (None, Some(scene)) => self.frame(scene, needs, &extent, &picture)?,
                (None, None) => self.frame(self.run(number, needs)?, needs, &extent, &picture)?,
            };
            self.progress.made.fetch_add(1, Ordering::Relaxed);
            Ok(frame)
        };
        let made = in_order(count, self.threads(), &self.stop, frame, |number, frame| {
            self.pass_prints(number);
            take(frame)
        });
        if made.is_err() {
            self.pass_prints(count);
        }
        made
    }

    /// Passes on what the runs of the frames up to `number` have printed.
    fn pass_prints(&self, number: usize) {
        if let Some(prints) = &self.prints {
            prints.pass(&self.axis, u32::try_from(number).unwrap_or(u32::MAX));
        }
    }

    /// Runs the script for all frames. Returns the extent that the renders show, and the frames.
    ///
    /// The extent of a few frames often contains all others, as with a plant that grows. As long as it does, a frame is
    /// rendered at once, so that its scene is made once and need not be kept. The result depends on the extents alone,
    /// not on the memory or the order of the threads.
    fn measure_all(
        &self,
        needs: FilmNeeds,
        picture: &Picture,
    ) -> Result<(Extent, Vec<Mutex<MeasuredFrame>>)> {
        let count = self.frames as usize;
        let most = self.options.limits.memory / 4;
        let held = AtomicUsize::new(0);
        let has_room = |size: usize, most: usize| {
            let fits = held.fetch_add(size, Ordering::Relaxed).saturating_add(size) < most;
            if !fits {
                held.fetch_sub(size, Ordering::Relaxed);
            }
            fits
        };
        let mut samples: Vec<usize> = (0..SAMPLES).map(|i| i * (count - 1) / (SAMPLES - 1)).collect();
        samples.dedup();
        let mut expected = Extent::default();
        let mut known: Vec<Mutex<Option<MeasuredFrame>>> = Vec::new();
        known.resize_with(count, Mutex::default);
        let sample = |i: usize| {
            // A frame that fails is run again below, so that the error is that of the first such frame.
            let Ok((scene, extent)) = self.measure(samples[i], needs) else { return Ok(None) };
            let scene = has_room(scene_bytes(&scene), most / 2).then_some(scene);
            Ok(Some(MeasuredFrame { extent, scene, ..MeasuredFrame::default() }))
        };
        in_order(samples.len(), self.threads(), &self.stop, sample, |i, frame| {
            if let Some(frame) = &frame {
                expected.join_outline(&frame.extent);
            }
            *known[samples[i]].lock().recover() = frame;
            Ok(())
        })?;
        let is_exceeded = AtomicBool::new(false);
        let measure = |number: usize| {
            let (scene, extent) = match known[number].lock().recover().take() {
                Some(MeasuredFrame { scene: Some(scene), extent, .. }) => {
                    held.fetch_sub(scene_bytes(&scene), Ordering::Relaxed);
                    (scene, extent)
                }
                Some(_) | None => self.measure(number, needs)?,
            };
            let is_expected = expected.contains(&extent);
            is_exceeded.fetch_or(!is_expected, Ordering::Relaxed);
            let mut measured = MeasuredFrame { is_expected, extent, ..MeasuredFrame::default() };
            if is_exceeded.load(Ordering::Relaxed) {
                measured.scene = has_room(scene_bytes(&scene), most).then_some(scene);
            } else if has_room(frame_bytes(picture, needs, &scene), most) {
                measured.frame = Some(self.frame(scene, needs, &expected, picture)?);
            }
            self.progress.measured.fetch_add(1, Ordering::Relaxed);
            Ok(measured)
        };
        let (mut extent, mut waiting) = (Extent::default(), Vec::new());
        in_order(count, self.threads(), &self.stop, measure, |_, frame| {
            extent.join_outline(&frame.extent);
            waiting.push(frame);
            Ok(())
        })?;
        if waiting.iter().all(|frame| frame.is_expected) {
            extent = expected;
        } else {
            waiting.iter_mut().for_each(|frame| frame.frame = None);
        }
        Ok((extent, waiting.into_iter().map(Mutex::new).collect()))
    }

    /// Returns the frame of `scene`, whose render shows `extent`.
    fn frame(&self, scene: Scene, needs: FilmNeeds, extent: &Extent, picture: &Picture) -> Result<FilmFrame> {
        let frame = if needs.images {
            FilmFrame::of_image(needs, render_within(&scene, Some(extent), picture, &self.stop)?)?
        } else {
            FilmFrame::default()
        };
        Ok(FilmFrame { scene: needs.scenes.then_some(scene), ..frame })
    }

    /// Returns the number of frames that are made at the same time.
    fn threads(&self) -> usize {
        self.options.worker_threads().min(self.frames as usize).max(1)
    }

    /// Runs the script for a frame, and measures its scene.
    fn measure(&self, number: usize, needs: FilmNeeds) -> Result<(Scene, Extent)> {
        let scene = self.run(number, needs)?;
        let extent = Extent::of(&scene).map_err(|error| self.noting(number, error))?;
        Ok((scene, extent))
    }

    /// Runs the script for a frame.
    fn run(&self, number: usize, needs: FilmNeeds) -> Result<Scene> {
        let frame = u32::try_from(number).unwrap_or(u32::MAX);
        self.run_frame(frame, needs).map_err(|error| self.noting(number, error))
    }

    /// Returns the error of a frame, with its number and value unless the film was cancelled.
    fn noting(&self, number: usize, error: Error) -> Error {
        let number = u32::try_from(number).unwrap_or(u32::MAX);
        match self.stop.is_stopped() {
            true => error,
            false => error.noting(&self.axis.label(number)),
        }
    }

    fn run_frame(&self, number: u32, needs: FilmNeeds) -> Result<Scene> {
        let mut options = self.options.clone();
        options.stop = Some(Arc::clone(&self.stop));
        options.reports.print = self.prints.as_ref().map(|prints| prints.of_frame(number));
        if self.of_steps {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked before")]
            let steps = self.axis.value(number) as usize;
            options.steps = Some(options.steps.map_or(steps, |most| most.min(steps)));
        } else {
            options.params.set.push((self.axis.name().to_owned(), self.axis.text(number)));
        }
        options.threads = Some((self.options.worker_threads() / self.threads()).max(1));
        let session = Session::new(&self.script, options)?;
        let mut run = run_session(&session)?;
        if needs.scenes {
            run.note_packages(&session)?;
        }
        if run.systems.is_empty() {
            let script = self.script.display();
            return Err(Error::script(format!("{script} derives no system, so there is nothing to show"))
                .help("end it with system:derive()"));
        }
        let triangles = run.scene.triangles();
        self.note(&session, run.systems.iter().map(|system| system.modules()).sum(), triangles, run.warnings);
        Ok(run.scene)
    }

    fn note(&self, session: &Session, modules: usize, triangles: usize, warnings: Vec<Warning>) {
        let mut found = self.found.lock().recover();
        found.inputs.extend(session.sought().into_iter().filter(|(_, exists)| *exists).map(|(path, _)| path));
        found.has_triangles |= triangles > 0;
        found.modules = found.modules.max(modules);
        found.triangles = found.triangles.max(triangles);
        for warning in warnings {
            if !found.warnings.iter().any(|known| known.is_same(&warning)) {
                found.warnings.push(warning);
            }
        }
    }
}

/// Returns the memory of a frame that waits (bytes).
fn frame_bytes(picture: &Picture, needs: FilmNeeds, scene: &Scene) -> usize {
    let image = picture.width as usize * picture.height as usize * 4;
    // A render as a PNG file is rarely larger than the render.
    image * (1 + usize::from(needs.files)) + if needs.scenes { scene_bytes(scene) } else { 0 }
}

/// Returns true if `value` is a number of derivation steps.
fn is_step(value: f64) -> bool {
    value >= 0.0 && value <= f64::from(u32::MAX) && value.fract() == 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCRIPT: &str = r#"local time = param("time", { default = 1, min = 0, max = 9 })
param("kind", { default = "a", choices = { "a", "b" } })
local A = module("A", "x")
local s = lsystem({ object = turtle({ width = 0.2 }) })
s:axiom(A(1))
s:rule("A(x)", function(this, x)
  if time == 5 then error("five") end
  return F(x * (0.5 + time)), A(x * random(0.4, 0.9))
end)
s:derive(4)
"#;

    /// Script whose model is much taller at a time between those from which the extent is expected.
    const JUMP: &str = r#"local time = param("time", { default = 1, min = 0, max = 9 })
local s = lsystem({ object = turtle({ width = 0.2 }) })
s:axiom(F(if time == 3 then 9 else 1))
s:derive(0)
"#;

    fn film(axis: &str, threads: usize, memory: usize) -> Result<(tempfile::TempDir, Film)> {
        film_of(SCRIPT, axis, threads, memory)
    }

    fn film_of(text: &str, axis: &str, threads: usize, memory: usize) -> Result<(tempfile::TempDir, Film)> {
        let folder = tempfile::tempdir().unwrap();
        let script = folder.path().join("s.lua");
        std::fs::write(&script, text).unwrap();
        let mut options = RunOptions {
            threads: Some(threads),
            registry: burgeon_objects::registry(),
            ..RunOptions::default()
        };
        options.limits.memory = memory;
        let film = Film::new(&script, options, &axis.parse()?, 100)?;
        Ok((folder, film))
    }

    fn images(axis: &str, threads: usize, memory: usize) -> Result<Vec<FilmFrame>> {
        images_of(SCRIPT, axis, threads, memory)
    }

    fn images_of(text: &str, axis: &str, threads: usize, memory: usize) -> Result<Vec<FilmFrame>> {
        let (_folder, film) = film_of(text, axis, threads, memory)?;
        let picture = Picture { width: 40, height: 30, ..Picture::default() };
        let needs = FilmNeeds { images: true, files: false, scenes: true };
        let mut frames = Vec::new();
        film.make(needs, &picture, |frame| {
            frames.push(frame);
            Ok(())
        })?;
        assert_eq!(film.progress.message(), format!("{0} of {0} frames", frames.len()));
        Ok(frames)
    }

    #[test]
    fn frames_are_the_same_for_any_number_of_threads_and_whether_scenes_fit_into_memory() {
        let one = images("0:2:0.5", 1, 1 << 30).unwrap();
        assert_eq!(one.len(), 5);
        assert!(one.windows(2).all(|pair| pair[0].image != pair[1].image));
        assert_eq!(images("0:2:0.5", 3, 1 << 30).unwrap(), one);
        // A quarter of this is less than a scene.
        assert_eq!(images("0:2:0.5", 2, 20_000_000).unwrap(), one);
        let mut back = images("2:0:-0.5", 2, 1 << 30).unwrap();
        back.reverse();
        assert_eq!(back, one);
    }

    #[test]
    fn a_model_that_is_largest_between_the_samples_is_shown_completely() {
        let frames = images_of(JUMP, "0:8", 2, 1 << 30).unwrap();
        let top = |frame: &FilmFrame| frame.image.as_ref().unwrap().row(0).to_vec();
        assert!(frames[2].image != frames[3].image && frames[2].image == frames[4].image);
        assert_eq!(top(&frames[3]), top(&frames[2]));
        assert_eq!(images_of(JUMP, "0:8", 1, 1 << 30).unwrap(), frames);
        assert_eq!(images_of(JUMP, "0:8", 2, 20_000_000).unwrap(), frames);
    }

    #[test]
    fn frames_over_the_number_of_steps_continue_and_are_as_those_of_single_runs() {
        let frames = images("steps=0:4", 2, 1 << 30).unwrap();
        let triangles: Vec<usize> =
            frames.iter().map(|frame| frame.scene.as_ref().unwrap().triangles()).collect();
        assert!(triangles[0] == 0 && triangles.is_sorted() && triangles[4] > triangles[1], "{triangles:?}");
        let last = images("steps=4:4", 1, 1 << 30).unwrap();
        assert_eq!(last[0].scene, frames[4].scene);
    }

    #[test]
    fn the_first_frame_that_fails_is_named() {
        let error = images("4:6:0.5", 2, 1 << 30).unwrap_err();
        assert!(error.message().contains("five (frame 2, time 5)"), "{error}");
    }

    #[test]
    fn values_that_the_script_refuses_are_refused_before_a_run() {
        let refused = |axis: &str| film(axis, 1, 1 << 30).err().unwrap().to_string().replace('\\', "/");
        assert!(refused("0:10").starts_with("param time is 10, out of its range"), "{}", refused("0:10"));
        assert!(refused("tim=0:3").contains("did you mean time?"), "{}", refused("tim=0:3"));
        assert!(refused("kind=0:3").contains("not a number"), "{}", refused("kind=0:3"));
        assert!(refused("steps=0:3:0.5").contains("0.5 is not a number of steps"));
        assert!(refused("0:9:0.01").contains("901 frames exceed the maximum of 100"));
    }
}
