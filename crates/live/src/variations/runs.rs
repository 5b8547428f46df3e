//! Runs of the variations on all threads.

use super::axis::{self, VariationAxis};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, Mutex};

use burgeon_base::error::{Error, Result, SourcePlace};
use burgeon_base::locks::LockRecovery;
use burgeon_base::stop::Stop;
use burgeon_base::warning::Warning;
use burgeon_engine::run::{declare, no_such, run_session};
use burgeon_engine::script::{Control, Param, RunOptions, Session, Setting};
use burgeon_picture::{Extent, Picture, Quality, render_within};
use burgeon_scene::Scene;
use burgeon_scene::image::{self, Image};

/// Memory limit (bytes) for completed scenes that wait for a common camera. Scenes beyond it are computed again.
const HELD: usize = 1 << 30;

/// Relation between the cameras of the cells.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Framing {
    /// Common camera of all cells, which shows each model completely, so that sizes can be compared. No cell is
    /// delivered before all scripts have run.
    #[default]
    Together,
    /// Separate cameras: each model fills its cell, from its best viewpoint.
    Each,
}

/// Variation of a script.
#[derive(Debug)]
pub struct Variation {
    /// Index of the variation, from 0.
    pub index: usize,
    /// Display label: `seed 7`, `twist 30 deg`.
    pub label: String,
    /// Seed of the run.
    pub seed: u64,
    /// Varied parameter and its value.
    pub set: Option<(String, String)>,
    /// Result of the run.
    pub made: Result<Thumbnail>,
}

/// Result of a variation.
#[derive(Debug)]
pub struct Thumbnail {
    /// Render of the model.
    pub picture: Image,
    /// Parameters of the script, with their values.
    pub params: Vec<Param>,
    /// Number of modules of all chains.
    pub modules: usize,
    /// Number of triangles, counted for each instance.
    pub triangles: usize,
    /// Warnings, in the order of files and lines.
    pub warnings: Vec<Warning>,
    /// Locations of the systems that have a seed of their own.
    pub seeded: Vec<SourcePlace>,
}

/// Set of variations of a script.
pub struct Variations {
    /// Cancellation signal. After cancellation no further cells are delivered.
    pub stop: Arc<Stop>,
    script: PathBuf,
    options: RunOptions,
    plans: Vec<VariationPlan>,
    ran: AtomicUsize,
}

/// Cell before its run.
struct VariationPlan {
    label: String,
    seed: u64,
    set: Option<(String, String)>,
}

/// Completed run, before rendering.
struct VariationRun {
    scene: Option<Scene>,
    extent: Extent,
    params: Vec<Param>,
    modules: usize,
    triangles: usize,
    warnings: Vec<Warning>,
    seeded: Vec<SourcePlace>,
}

impl Variations {
    /// Plans the variations of `script`, otherwise run with `options`, whose limits apply to each run.
    ///
    /// Fails if there are none or more than [`MOST`](super::MOST), without the feature `pictures`, and if the script
    /// has no such parameter or rejects one of the values. If the script itself fails, the cells report the error.
    pub fn new(script: &Path, mut options: RunOptions, over: &VariationAxis) -> Result<Self> {
        image::check()?;
        options.reports.print = None;
        let plans: Vec<VariationPlan> = match over {
            VariationAxis::Seeds(seeds) => seeds
                .iter()
                .map(|seed| VariationPlan { label: format!("seed {seed}"), seed: *seed, set: None })
                .collect(),
            VariationAxis::Param { name, values } => {
                let param = find_param(script, &options, name)?;
                let all = match values.as_slice() {
                    [] => every_value(&param)?,
                    values => values.iter().map(String::as_str).collect(),
                };
                all.into_iter()
                    .map(|value| {
                        let label = label(&param, &param.accept(value)?);
                        let set = Some((name.clone(), value.to_owned()));
                        Ok(VariationPlan { label, seed: options.seed, set })
                    })
                    .collect::<Result<_>>()?
            }
        };
        axis::check_count(plans.len() as f64, "use fewer of them")?;
        let script = script.to_path_buf();
        Ok(Self { stop: Arc::default(), script, options, plans, ran: AtomicUsize::new(0) })
    }

    /// Returns the number of variations.
    #[allow(clippy::len_without_is_empty, reason = "there is always one")]
    pub fn len(&self) -> usize {
        self.plans.len()
    }

    /// Returns the number of scripts that have run so far.
    pub fn ran(&self) -> usize {
        self.ran.load(Ordering::Relaxed).min(self.plans.len())
    }

    /// Computes all variations and passes each to `take` in order, as soon as it and all previous ones are finished.
    ///
    /// `picture` contains the settings of each cell; a draft is rendered at twice the size, so that its edges are
    /// smooth. Fails if cancellation is requested, with its reason, or if `picture` is invalid.
    pub fn make(&self, picture: &Picture, framing: Framing, mut take: impl FnMut(Variation)) -> Result<()> {
        picture.check()?;
        self.ran.store(0, Ordering::Relaxed);
        match framing {
            Framing::Each => self.each(
                |number| {
                    let mut ran = self.run(number, None)?;
                    let extent = std::mem::take(&mut ran.extent);
                    self.render(number, ran, &extent, picture)
                },
                |number, made| take(self.cell(number, made)),
            ),
            Framing::Together => {
                let held = AtomicUsize::new(0);
                let mut extent = Extent::default();
                let mut waiting = Vec::new();
                self.each(
                    |number| self.run(number, Some(&held)),
                    |_, ran| {
                        if let Ok(ran) = &ran {
                            extent.join(&ran.extent);
                        }
                        waiting.push(Mutex::new(Some(ran)));
                    },
                )?;
                self.each(
                    |number| {
                        let ran = waiting[number].lock().recover().take();
                        let ran = ran.unwrap_or_else(|| Err(Error::internal("it was made twice")))?;
                        self.render(number, ran, &extent, picture)
                    },
                    |number, made| take(self.cell(number, made)),
                )
            }
        }
    }

    fn cell(&self, index: usize, made: Result<Thumbnail>) -> Variation {
        let VariationPlan { label, seed, set } = &self.plans[index];
        Variation { index, label: label.clone(), seed: *seed, set: set.clone(), made }
    }

    /// Runs the script for a cell. Keeps the scene unless the `held` scenes take too much memory.
    fn run(&self, number: usize, held: Option<&AtomicUsize>) -> Result<VariationRun> {
        let plan = &self.plans[number];
        let mut options = self.options.clone();
        options.seed = plan.seed;
        options.stop = Some(Arc::clone(&self.stop));
        options.params.set.extend(plan.set.clone());
        options.threads = Some((self.options.worker_threads() / self.workers()).max(1));
        let session = Session::new(&self.script, options)?;
        let run = run_session(&session);
        self.ran.fetch_add(1, Ordering::Relaxed);
        let run = run?;
        if run.systems.is_empty() {
            let script = self.script.display();
            return Err(Error::script(format!("{script} derives no system, so there is nothing to render"))
                .help("end it with system:derive()"));
        }
        let modules = run.systems.iter().map(|system| system.modules()).sum();
        let seeded = run.systems.iter().filter(|system| system.has_own_seed);
        let seeded = seeded.filter_map(|system| system.place.clone()).collect();
        let (triangles, extent) = (run.scene.triangles(), Extent::of(&run.scene)?);
        let room = held.is_none_or(|held| {
            let size = scene_bytes(&run.scene);
            held.fetch_add(size, Ordering::Relaxed).saturating_add(size) < HELD
        });
        let scene = room.then_some(run.scene);
        let (params, warnings) = (run.params, run.warnings);
        Ok(VariationRun { scene, extent, params, modules, triangles, warnings, seeded })
    }

    fn render(
        &self,
        number: usize,
        ran: VariationRun,
        extent: &Extent,
        picture: &Picture,
    ) -> Result<Thumbnail> {
        let scene = match ran.scene {
            Some(scene) => scene,
            None => self.run(number, None)?.scene.unwrap_or_default(),
        };
        let picture = thumbnail(&scene, extent, picture, &self.stop)?;
        let VariationRun { params, modules, triangles, warnings, seeded, .. } = ran;
        Ok(Thumbnail { picture, params, modules, triangles, warnings, seeded })
    }

    fn workers(&self) -> usize {
        self.options.worker_threads().min(self.plans.len())
    }

    /// Calls `work` for every cell, in several threads, and passes the results to `take` in order.
    fn each<T: Send>(
        &self,
        work: impl Fn(usize) -> Result<T> + Sync,
        mut take: impl FnMut(usize, Result<T>),
    ) -> Result<()> {
        let next = AtomicUsize::new(0);
        let worker = |outbox: Sender<(usize, Result<T>)>| {
            while !self.stop.is_stopped() {
                let number = next.fetch_add(1, Ordering::Relaxed);
                if number >= self.plans.len() || outbox.send((number, work(number))).is_err() {
                    break;
                }
            }
        };
        std::thread::scope(|scope| {
            let (outbox, inbox) = channel();
            for outbox in std::iter::repeat_n(outbox, self.workers()) {
                let worker = &worker;
                scope.spawn(move || worker(outbox));
            }
            let mut early = BTreeMap::new();
            let mut expected = 0;
            for (number, result) in inbox {
                if self.stop.is_stopped() {
                    break;
                }
                early.insert(number, result);
                while let Some(result) = early.remove(&expected) {
                    take(expected, result);
                    expected += 1;
                }
            }
        });
        self.stop.check()
    }
}

fn thumbnail(scene: &Scene, extent: &Extent, picture: &Picture, stop: &Stop) -> Result<Image> {
    let (width, height) = (picture.width, picture.height);
    if picture.quality != Quality::Draft || width.max(height) > Picture::LARGEST / 2 {
        return render_within(scene, Some(extent), picture, stop);
    }
    let large = Picture { width: 2 * width, height: 2 * height, ..picture.clone() };
    let large = render_within(scene, Some(extent), &large, stop)?;
    Ok(Image::from_fn(width, height, |x, y| {
        let four = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| large.pixel(2 * x + i, 2 * y + j));
        mean(four)
    }))
}

/// Computes the mean colour of pixels with different opacities.
fn mean(pixels: [[u8; 4]; 4]) -> [u8; 4] {
    let opacity: u32 = pixels.iter().map(|pixel| u32::from(pixel[3])).sum();
    let color = |i: usize| {
        let sum: u32 = pixels.iter().map(|pixel| u32::from(pixel[i]) * u32::from(pixel[3])).sum();
        ((sum + opacity / 2) / opacity.max(1)) as u8
    };
    [color(0), color(1), color(2), ((opacity + 2) / 4) as u8]
}

/// Returns the parameter `name` of `script`.
pub(crate) fn find_param(script: &Path, options: &RunOptions, name: &str) -> Result<Param> {
    let mut options = RunOptions { check: true, ..options.clone() };
    let short = name.rsplit('.').next().unwrap_or(name);
    options.params.set.retain(|(known, _)| known != name && known != short);
    let session = Session::new(script, options)?;
    // A script that fails may have declared the parameter before; each cell reports the failure.
    let ran = declare(&session);
    let params = session.params();
    match Param::find(&params, name)? {
        Some(param) => Ok(param.clone()),
        None => {
            ran?;
            Err(no_such(session.script(), name, &params))
        }
    }
}

/// Returns all values of a parameter with a list of choices.
fn every_value(param: &Param) -> Result<Vec<&str>> {
    match &param.control {
        Control::Choice(choices) => Ok(choices.iter().map(String::as_str).collect()),
        Control::Switch => Ok(vec!["false", "true"]),
        _ => Err(Error::argument(format!("param {} has no choices", param.name))
            .help(format!("specify the values: {}=LOW..HIGH:STEP or {}=A,B,C", param.name, param.name))),
    }
}

fn label(param: &Param, value: &Setting) -> String {
    let unit = if param.unit.is_empty() { String::new() } else { format!(" {}", param.unit) };
    format!("{} {value}{unit}", param.name)
}

/// Estimates the memory (bytes) of `scene`.
pub(crate) fn scene_bytes(scene: &Scene) -> usize {
    let parts = scene.meshes.iter().flat_map(|mesh| &mesh.parts);
    let meshes: usize = parts.map(|part| part.positions.len() * 32 + part.triangles.len() * 12).sum();
    meshes + scene.instances.len() * 200
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCRIPT: &str = r#"local n = param("n", { default = 2, min = 1, max = 6, unit = "m" })
param("kind", { default = "a", choices = { "a", "b" } })
local A = module("A", "x")
local s = lsystem({ object = turtle({ width = 0.2 }) })
s:axiom(A(n))
s:rule("A(x)", function(this, x)
  if n == 3 then error("three") end
  print("loud")
  return F(x * random(0.9, 1.1))
end)
s:derive()
"#;

    fn made(over: &VariationAxis, threads: usize, framing: Framing) -> Vec<Variation> {
        let folder = tempfile::tempdir().unwrap();
        let script = folder.path().join("s.lua");
        std::fs::write(&script, SCRIPT).unwrap();
        let options = RunOptions {
            threads: Some(threads),
            registry: burgeon_objects::registry(),
            ..RunOptions::default()
        };
        let picture = Picture { width: 40, height: 50, quality: Quality::Draft, ..Picture::default() };
        let mut cells = Vec::new();
        let variations = Variations::new(&script, options, over).unwrap();
        variations.make(&picture, framing, |cell| cells.push(cell)).unwrap();
        assert_eq!((cells.len(), variations.ran()), (variations.len(), variations.len()));
        cells
    }

    fn pixels(cell: &Variation) -> Option<&[u8]> {
        cell.made.as_ref().ok().map(|made| made.picture.bytes())
    }

    #[test]
    fn cells_come_in_order_and_are_the_same_for_any_number_of_threads() {
        for framing in [Framing::Together, Framing::Each] {
            let over = VariationAxis::seeds("1..5").unwrap();
            let (one, three) = (made(&over, 1, framing), made(&over, 3, framing));
            for (index, (a, b)) in one.iter().zip(&three).enumerate() {
                assert_eq!(
                    (a.index, a.seed, a.label.as_str()),
                    (index, index as u64 + 1, &*format!("seed {}", index + 1))
                );
                assert!(pixels(a).is_some() && pixels(a) == pixels(b));
            }
            assert_ne!(pixels(&one[0]), pixels(&one[1]));
        }
    }

    #[test]
    fn a_run_that_fails_leaves_the_others_alone() {
        let cells = made(&VariationAxis::sweep("n=1..5").unwrap(), 2, Framing::Together);
        let labels: Vec<&str> = cells.iter().map(|cell| cell.label.as_str()).collect();
        assert_eq!(labels, ["n 1 m", "n 2 m", "n 3 m", "n 4 m", "n 5 m"]);
        for cell in &cells {
            match &cell.made {
                Ok(made) => assert_eq!((made.params.len(), made.modules), (2, 1)),
                Err(error) => assert!(cell.index == 2 && error.message() == "three", "{error}"),
            }
        }
    }

    #[test]
    fn a_parameter_alone_takes_every_choice() {
        let cells = made(&VariationAxis::sweep("kind").unwrap(), 2, Framing::Each);
        let labels: Vec<&str> = cells.iter().map(|cell| cell.label.as_str()).collect();
        assert_eq!(labels, ["kind a", "kind b"]);
    }

    #[test]
    fn a_stop_ends_the_work_with_its_reason() {
        let folder = tempfile::tempdir().unwrap();
        let script = folder.path().join("s.lua");
        std::fs::write(&script, "while true do end\n").unwrap();
        let over = VariationAxis::seeds("1..9").unwrap();
        let variations = Variations::new(
            &script,
            RunOptions { registry: burgeon_objects::registry(), ..RunOptions::default() },
            &over,
        )
        .unwrap();
        let stop = Arc::clone(&variations.stop);
        let stopper = std::thread::spawn(move || {
            std::thread::sleep(std::time::Duration::from_millis(100));
            stop.stop(Error::cancellation("enough"));
        });
        let begin = std::time::Instant::now();
        let error = variations.make(&Picture::default(), Framing::Each, |_| panic!("a cell")).unwrap_err();
        assert!(error.message() == "enough" && begin.elapsed().as_secs() < 5, "{error}");
        stopper.join().unwrap();
    }
}
