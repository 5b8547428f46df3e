//! Worker: one thread that runs the script with the latest request and encodes the model.

use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant, SystemTime};

use axum::body::Bytes;

use super::console::Console;
use super::job::{PROBLEMS, RunJob, options};
use super::message::{Cause, Event, ModelMessage, ParamMessage};
use super::request::Inputs;
use super::state::{ActiveRun, LiveState, PresentModel, ServerState, content_hash};
use super::urls::model_url;
use super::{LiveEvent, describe};
use crate::presets::Presets;
use crate::watch::{Watch, unsettled};
use burgeon_base::error::{Error, ErrorKind, Limit, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_base::text::panic_message;
use burgeon_base::warning::Warning;
use burgeon_engine::run::{Run, run_session};
use burgeon_engine::script::{CurvesFile, Limits, RecipeDraft, Session, make_ready};
use burgeon_export::gltf::{self, Layout};

/// Interval of progress reports to pages.
const TICK: Duration = Duration::from_millis(100);

/// Maximum size (bytes) of a model that is sent to pages. Browsers do not support larger arrays.
const LARGEST: usize = 2_000_000_000;

/// Time for which an existing file may be missing, as during a save, before pages are informed.
const MISSING: Duration = Duration::from_millis(150);

/// Maximum time for which failures are withheld because files are changing.
const DOUBT: Duration = Duration::from_secs(2);

/// Limits of a run in idle time that only determines the number of steps.
const IDLE_LIMITS: Limits = Limits {
    time: Duration::from_secs(10),
    memory: 1 << 30,
    whole_program: false,
    modules: 5_000_000,
    triangles: 10_000_000,
    file: None,
};

/// Outcome of a run.
enum RunOutcome {
    NewModel(Box<NewModel>),
    Missing,
    Failed(Error),
    Cancelled,
}

struct NewModel {
    run: Run,
    file: ModelFile,
    /// Description for pages, except for the parts that depend on the request.
    message: ModelMessage,
    recipe: RecipeDraft,
}

/// Encoded model for pages.
#[derive(Default)]
struct ModelFile {
    /// File name, which is a hash of the content, and the content; `None` if the model is empty.
    content: Option<(String, Bytes)>,
    layout: Layout,
    /// Reason for omitting the content, if the model is too large.
    note: Option<String>,
}

/// Executes runs until the server stops.
pub(super) fn work(state: &ServerState, watch: &Watch) {
    let mut followed: Vec<(PathBuf, bool)> = Vec::new();
    while let Some(job) = next(state) {
        let since = SystemTime::now();
        let mut session = None;
        let attempt = catch_unwind(AssertUnwindSafe(|| attempt(state, &job, &mut session)));
        let outcome = attempt.unwrap_or_else(|panic| RunOutcome::Failed(internal(panic.as_ref())));
        // Missing files that the run looked for are watched too, because the run may succeed once they exist.
        let mut files = session.as_ref().map(|session| session.sought()).unwrap_or_default();
        // These files are watched from the start.
        files.extend(constant_inputs(state).into_iter().map(|path| (path, true)));
        for path in [Presets::path_of(&state.script), CurvesFile::path_of(&state.script)] {
            let there = path.is_file();
            files.push((path, there));
        }
        if let Some(session) = &session {
            files.extend(super::tools::find_package_presets(state, session));
        }
        if matches!(outcome, RunOutcome::Cancelled) {
            // The cancelled run has not reached all of its files.
            followed.extend(files);
        } else {
            followed = files;
        }
        watch.follow(followed.clone(), since);
        let failed = matches!(outcome, RunOutcome::Failed(_) | RunOutcome::Missing);
        let outcome = match failed && is_superseded(state, &job, &followed, watch) {
            true => RunOutcome::Cancelled,
            false => outcome,
        };
        finish(state, job, session.as_deref(), outcome);
        drop(session);
        if let Some(inputs) = wants_last_step(state) {
            let found = catch_unwind(AssertUnwindSafe(|| last_step(state, &inputs)));
            note_last_step(state, inputs, found.ok().flatten());
        }
        if state.lock().due.is_none() {
            make_ready();
        }
    }
}

/// Waits until `files`, with which a run has failed, have been stable for a while. Returns true if a newer run is due.
/// The run may have read a file that was only half written.
fn is_superseded(state: &ServerState, job: &RunJob, files: &[(PathBuf, bool)], watch: &Watch) -> bool {
    let gone = job.due.cause == Cause::Save && files.iter().any(|(path, there)| *there && !path.exists());
    let young = unsettled(files.iter().map(|(path, _)| path.as_path()));
    let wait = young.max(gone.then_some(MISSING)).unwrap_or_default();
    let mut inner = state.lock();
    // Do not wait for a file that is written continuously.
    if inner.doubts.is_some_and(|since| since.elapsed() > DOUBT) {
        return false;
    }
    inner.doubts.get_or_insert_with(Instant::now);
    let end = Instant::now() + wait;
    while inner.due.is_none() && !inner.over {
        let Some(left) = end.checked_duration_since(Instant::now()) else {
            drop(inner);
            watch.catch_up();
            return state.lock().due.is_some();
        };
        inner = state.wake.wait_timeout(inner, left).recover().0;
    }
    true
}

/// Sends the progress of the run to pages, until the server stops.
pub(super) fn report(state: &ServerState) {
    let mut inner = state.lock();
    while !inner.over {
        if inner.running.as_ref().is_none_or(|running| running.background) {
            inner = state.wake.wait(inner).recover();
            continue;
        }
        drop(inner);
        std::thread::sleep(TICK);
        inner = state.lock();
        if let Some(running) =
            inner.running.as_ref().filter(|it| !it.background && it.begin.elapsed() >= TICK)
        {
            if let Some(printed) = running.console.news(state, running.run) {
                state.send(&printed);
            }
            let (step, steps, modules) = running.session.progress.counts();
            let message = running.session.progress.message(running.begin.elapsed());
            state.send(&Event::Progress { run: running.run, message, step, steps, modules });
        }
    }
}

/// Returns the files that affect the result even if the script cannot be read.
pub(super) fn constant_inputs(state: &ServerState) -> Vec<PathBuf> {
    std::iter::once(&state.script).chain(&state.options.inputs.stdlib).cloned().collect()
}

/// Waits for the next run; `None` if the server stops.
fn next(state: &ServerState) -> Option<RunJob> {
    let mut inner = state.lock();
    loop {
        if inner.over {
            return None;
        }
        if let Some(due) = inner.due.take() {
            inner.runs += 1;
            let run = inner.runs;
            state.send(&Event::Working { run, cause: due.cause, files: due.files.clone() });
            let request = inner.request.clone();
            let inputs = request.inputs(inner.generation);
            return Some(RunJob { run, due, request, inputs, console: Arc::default() });
        }
        inner = state.wake.wait(inner).recover();
    }
}

/// Registers `session` as the run that others can cancel; without a job, pages are not informed about it. Returns the
/// flag that is set on cancellation.
fn register(state: &ServerState, job: Option<&RunJob>, session: &Arc<Session>) -> Arc<AtomicBool> {
    let mut inner = state.lock();
    let cancelled = Arc::new(AtomicBool::new(inner.over || inner.due.is_some()));
    if cancelled.load(Ordering::Acquire) {
        session.stop.stop(Error::cancellation("there is something newer"));
    }
    inner.running = Some(ActiveRun {
        run: job.map_or(0, |job| job.run),
        cause: job.map_or(Cause::Steps, |job| job.due.cause),
        files: job.map(|job| job.due.files.clone()).unwrap_or_default(),
        session: Arc::clone(session),
        begin: Instant::now(),
        cancelled: Arc::clone(&cancelled),
        background: job.is_none(),
        console: job.map(|job| Arc::clone(&job.console)).unwrap_or_default(),
    });
    state.wake.notify_all();
    cancelled
}

fn attempt(state: &ServerState, job: &RunJob, kept: &mut Option<Arc<Session>>) -> RunOutcome {
    if std::fs::metadata(&state.script).is_err_and(|error| error.kind() == std::io::ErrorKind::NotFound) {
        return RunOutcome::Missing;
    }
    let mut options = options(state, &job.inputs);
    options.reports.print = Some(Console::receiver(&job.console, options.reports.print.take()));
    let session = match Session::new(&state.script, options) {
        Ok(session) => session,
        Err(error) => return RunOutcome::Failed(error),
    };
    *kept = Some(Arc::clone(&session));
    let cancelled = register(state, Some(job), &session);
    let made = run_session(&session).and_then(|run| {
        if cancelled.load(Ordering::Acquire) {
            return Err(Error::cancellation("there is something newer"));
        }
        let (file, mut message) =
            rayon::join(|| encode(&run), || describe::describe(state, job, &session, &run));
        let (file, time) = file?;
        message.nothing = file.note.clone().or(message.nothing);
        if let Some((hash, bytes)) = &file.content {
            message.url = Some(model_url(hash));
            message.bytes = bytes.len();
        }
        message.times.encode = describe::ms(time);
        message.times.total = describe::ms(job.due.at.elapsed());
        let recipe = session.recipe(&run.params);
        Ok(NewModel { run, file, message, recipe })
    });
    match made {
        _ if cancelled.load(Ordering::Acquire) => RunOutcome::Cancelled,
        Ok(made) => RunOutcome::NewModel(Box::new(made)),
        Err(error) => RunOutcome::Failed(error),
    }
}

/// Encodes the model. Returns the file and the time taken.
fn encode(run: &Run) -> Result<(ModelFile, Duration)> {
    let begin = Instant::now();
    if run.scene.triangles() == 0 {
        return Ok((ModelFile::default(), begin.elapsed()));
    }
    let nothing = |note: String| ModelFile { note: Some(note), ..ModelFile::default() };
    let file = match gltf::glb_for_viewer(&run.scene) {
        Ok((glb, layout)) if glb.len() <= LARGEST => {
            ModelFile { content: Some((content_hash(&glb), glb.into())), layout, note: None }
        }
        Ok((glb, _)) => nothing(format!(
            "the model has {} MB, which is too large for the live view",
            glb.len() / 1_000_000
        )),
        // The scene is valid, or the run would have failed, so it is too large for any file.
        Err(error) if *error.kind() == ErrorKind::Limit(Limit::Format) => nothing(error.to_string()),
        Err(error) => return Err(error),
    };
    Ok((file, begin.elapsed()))
}

fn internal(panic: &(dyn std::any::Any + Send)) -> Error {
    Error::internal(format!("internal error: {}", panic_message(panic)))
        .help("this is a bug in Burgeon; please report it with the script")
}

/// Stores the outcome of a run, and informs pages and the process that started the server.
fn finish(state: &ServerState, job: RunJob, session: Option<&Session>, outcome: RunOutcome) {
    let mut inner = state.lock();
    if !matches!(outcome, RunOutcome::Cancelled) {
        inner.doubts = None;
    }
    let running = inner.running.take();
    let quick = running.as_ref().map(|running| running.begin.elapsed());
    // A page has cancelled the run just before its end, and the request has already been restored.
    let stopped = running.is_some_and(|running| running.cancelled.load(Ordering::Acquire));
    let outcome = if stopped && inner.due.is_none() { RunOutcome::Cancelled } else { outcome };
    if let Some(session) = session.filter(|_| !matches!(outcome, RunOutcome::Cancelled)) {
        inner.files = session.files();
    }
    if !matches!(outcome, RunOutcome::Cancelled) || inner.due.is_none() {
        let printed = job.console.message(state, job.run);
        // Most scripts print nothing, and then pages are told only if another run has.
        if !job.console.is_empty() || inner.printed.is_some() {
            state.send(&printed);
        }
        inner.printed = (!job.console.is_empty()).then_some(printed);
    }
    let mut notices = Vec::new();
    let mut gone = None;
    match outcome {
        RunOutcome::Cancelled => inner.report_cancelled(state, job.run),
        RunOutcome::Missing => {
            let text = format!("script not found: {}", state.script.display());
            inner.end_badly(state, job.inputs, Event::Waiting { text: text.clone() });
            notices.push(LiveEvent::Waiting(text));
        }
        RunOutcome::Failed(error) => {
            let number = error.problems().count();
            let errors = error.problems().take(PROBLEMS).map(|problem| state.error_json(problem)).collect();
            let (run, cause) = (job.run, job.due.cause);
            let text = error.to_string();
            let params = inner.requested_params();
            let seed = inner.request.seed().to_string();
            let event = Event::Error { run, cause, text, errors, number, params, seed };
            inner.end_badly(state, job.inputs, event);
            notices.push(LiveEvent::Failed(error));
        }
        RunOutcome::NewModel(made) => {
            let NewModel { run, file, mut message, recipe } = *made;
            let RunJob { mut request, inputs, .. } = job;
            message.params = request.params(&run.params);
            inner.request.params(&run.params);
            message.last_step = inner.last_step_of(&inputs, message.steps);
            message.preset = inner.request.preset();
            let ModelFile { content, layout, note } = file;
            let old = content.map(|(hash, bytes)| inner.keep(hash, bytes));
            notices.push(LiveEvent::Model {
                triangles: message.triangles,
                modules: message.modules,
                total: Duration::from_secs_f64(message.times.total / 1e3),
            });
            inner.params = Some(run.params.clone());
            inner.trouble = None;
            inner.cancelled = None;
            inner.stale = None;
            inner.took = quick.unwrap_or_default();
            inner.finished = Some(inputs.clone());
            state.send(&Event::Model(Box::new(message.clone())));
            let left_out = session.map(Session::left_out).unwrap_or_default();
            notices.extend(inner.tell_left_out(state, &left_out));
            notices.extend(inner.new_warnings(&run.warnings));
            let remark = describe::remark(state, &run).map(|(text, help)| format!("{text}: {help}"));
            let new: BTreeSet<String> = remark.into_iter().chain(note).collect();
            notices.extend(new.difference(&inner.notes).cloned().map(LiveEvent::Text));
            inner.notes = new;
            let (run, layout, recipe) = (Arc::new(run), Arc::new(layout), Arc::new(recipe));
            let model = PresentModel { run, request, inputs, layout, message, recipe };
            gone = Some((inner.shown.replace(Arc::new(model)), old));
        }
    }
    drop(inner);
    // Freeing large models takes a while.
    drop(gone);
    for notice in notices {
        state.tell(&notice);
    }
}

impl LiveState {
    /// Returns the parameters of the shown model with the requested values; empty if there is no model.
    fn requested_params(&mut self) -> Vec<ParamMessage> {
        let shown = self.shown.as_ref();
        shown.map(|shown| self.request.requested_params(&shown.run.params)).unwrap_or_default()
    }

    fn end_badly(&mut self, state: &ServerState, inputs: Inputs, event: Event) {
        self.params = None;
        self.cancelled = None;
        self.grow_stale();
        self.finished = Some(inputs);
        state.send(&event);
        self.trouble = Some(event);
    }

    /// Returns the warnings that the previous run did not have.
    fn new_warnings(&mut self, warnings: &[Warning]) -> Vec<LiveEvent> {
        let text = |it: &Warning| format!("{:?} {}", it.place(), it.message());
        let new = warnings.iter().filter(|warning| !self.warnings.contains(&text(warning)));
        let notices = new.cloned().map(LiveEvent::Warning).collect();
        self.warnings = warnings.iter().map(text).collect();
        notices
    }

    /// Reports values that the script no longer accepts, once each.
    fn tell_left_out(&mut self, state: &ServerState, left_out: &[(String, Error)]) -> Vec<LiveEvent> {
        let texts: Vec<String> = left_out
            .iter()
            .map(|(name, error)| format!("the value of {name} is not used: {error}"))
            .collect();
        let mut notices = Vec::new();
        for text in texts.iter().filter(|text| !self.left_out.contains(*text)) {
            state.send(&Event::Note { text: text.clone() });
            notices.push(LiveEvent::Text(text.clone()));
        }
        self.left_out = texts.into_iter().collect();
        notices
    }

    /// Returns the total number of steps for a run with these inputs that took `steps`; an estimate if the run was
    /// limited and the number is unknown.
    fn last_step_of(&mut self, inputs: &Inputs, steps: usize) -> usize {
        let whole = inputs.unlimited();
        if inputs.steps.is_none_or(|limit| steps < limit) {
            self.last_step = Some((whole, steps));
            return steps;
        }
        match &self.last_step {
            Some((known, last)) if *known == whole => *last,
            _ => self.shown.as_ref().map_or(0, |shown| shown.message.last_step).max(steps),
        }
    }
}

/// Returns the inputs of the shown model without their limit, if its total number of steps is unknown.
fn wants_last_step(state: &ServerState) -> Option<Inputs> {
    let inner = state.lock();
    let inputs = inner.finished.as_ref()?;
    if inner.due.is_some() || inner.over || inner.trouble.is_some() || inputs.steps.is_none() {
        return None;
    }
    let whole = inputs.unlimited();
    (inner.last_step.as_ref().is_none_or(|(known, _)| *known != whole)).then_some(whole)
}

/// Runs the script without a step limit, only to count the steps. Returns `None` if a newer run cancels it.
fn last_step(state: &ServerState, inputs: &Inputs) -> Option<usize> {
    let mut options = options(state, inputs);
    options.reports.print = None;
    options.reports.profile = false;
    let limits = &mut options.limits;
    limits.time = limits.time.min(IDLE_LIMITS.time);
    limits.memory = limits.memory.min(IDLE_LIMITS.memory);
    limits.modules = limits.modules.min(IDLE_LIMITS.modules);
    limits.triangles = limits.triangles.min(IDLE_LIMITS.triangles);
    let session = Session::new(&state.script, options).ok()?;
    let cancelled = register(state, None, &session);
    let run = run_session(&session);
    let stopped = cancelled.load(Ordering::Acquire);
    match run {
        _ if stopped => None,
        Ok(run) => run.systems.iter().map(|system| system.steps).max(),
        // The derivation has at least as many steps as it completed.
        Err(_) => Some(session.progress.counts().0),
    }
}

fn note_last_step(state: &ServerState, inputs: Inputs, found: Option<usize>) {
    let mut inner = state.lock();
    inner.running = None;
    let (Some(found), Some(steps)) = (found, inner.shown.as_ref().map(|shown| shown.message.steps)) else {
        return;
    };
    let last_step = found.max(steps);
    inner.last_step = Some((inputs, last_step));
    let Some(shown) = inner.shown.as_mut() else { return };
    Arc::make_mut(shown).message.last_step = last_step;
    inner.present().into_iter().for_each(|model| state.send(&Event::Model(Box::new(model))));
}
