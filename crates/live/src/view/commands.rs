//! Commands of pages: each message is answered, or changes the request and starts a run.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use axum::extract::ws::Utf8Bytes;
use tokio::sync::broadcast::Receiver;
use tokio::sync::mpsc::Sender;

use super::message::{self, Cause, Event, PageCommand};
use super::request::seed;
use super::socket::PageState;
use super::state::{DueRun, LiveState, ServerState};
use super::{cameras, curves, parts, source, tools, trace};
use burgeon_base::error::{Error, Result};
use burgeon_engine::script::CurvesFile;

impl PageState for ServerState {
    fn greet(&self) -> (Vec<Utf8Bytes>, Receiver<Utf8Bytes>) {
        self.greeting()
    }

    fn reply(self: &Arc<Self>, text: &str, page: &Sender<Utf8Bytes>) -> Option<Utf8Bytes> {
        self.ask(text, page).map(|event| self.to_text(&event))
    }
}

impl ServerState {
    /// Executes the command in `text`, a page's message. Returns the answer to that page; slow answers are sent through
    /// `page`.
    pub(super) fn ask(self: &Arc<Self>, text: &str, page: &Sender<Utf8Bytes>) -> Option<Event> {
        let refused = |id: Option<u64>, error: &Error| Some(Event::rejection(id, error));
        match message::read(text) {
            Err(refused) => Some(*refused),
            Ok(PageCommand::Pick(pick)) => Some(trace::pick(self, &pick)),
            Ok(PageCommand::Highlight { id, file, line }) => Some(trace::highlight(self, id, &file, line)),
            Ok(PageCommand::Chain { id, system, chain, module }) => {
                Some(trace::chain(self, id, system, chain, module))
            }
            Ok(PageCommand::Camera { id, name, view, azimuth, aspect }) => {
                let wanted = cameras::WantedCamera { name, view, azimuth, aspect };
                Some(cameras::find(self, id, &wanted))
            }
            Ok(PageCommand::Parts { id, search }) => Some(parts::list(self, id, &search)),
            Ok(PageCommand::Part { id, system, chain, symbol }) => {
                Some(parts::find(self, id, system, chain, symbol.as_deref()))
            }
            Ok(PageCommand::Variations { id, seeds, param, values }) => {
                tools::variations(self, id, tools::parse_axis(seeds.as_deref(), param, values), page.clone())
            }
            Ok(PageCommand::Preset { action, name, replace }) => tools::preset(self, &action, &name, replace),
            Ok(PageCommand::Outline { id, param, points }) => {
                Some(curves::outline(self, id, &param, &points))
            }
            Ok(PageCommand::Store { id, param, points }) => Some(curves::store(self, id, &param, &points)),
            Ok(PageCommand::Read { id, file }) => Some(source::read(self, id, &file)),
            Ok(PageCommand::Write { id, file, text, hash }) => {
                Some(source::write(self, id, &file, &text, &hash))
            }
            Ok(PageCommand::Open { file, line }) => {
                self.open(&file, line.unwrap_or(1)).err().and_then(|error| refused(None, &error))
            }
            Ok(PageCommand::Cancel {}) => {
                let mut inner = self.lock();
                let waiting = inner.due.take().is_some();
                let running = inner.stop("it was cancelled");
                if waiting || running {
                    inner.take_back(self);
                }
                if waiting && !running {
                    let run = inner.runs + 1;
                    inner.report_cancelled(self, run);
                }
                let idle = !waiting && !running;
                idle.then(|| Event::rejection(None, &Error::unavailable("nothing is running")))
            }
            Ok(PageCommand::Set { id, params }) => {
                self.change(id, Cause::Parameters, |inner| inner.request.set(params, inner.params.as_deref()))
            }
            Ok(PageCommand::Reset {}) => self.change(None, Cause::Parameters, |inner| {
                inner.request.reset();
                Ok(())
            }),
            Ok(PageCommand::Seed { seed: wished }) => self.change(None, Cause::Seed, |inner| {
                inner.request.set_seed(seed(&wished)?);
                Ok(())
            }),
            Ok(PageCommand::Steps { steps }) => self.change(None, Cause::Steps, |inner| {
                inner.request.steps = steps;
                Ok(())
            }),
        }
    }

    /// Changes the request and schedules a run for it, or returns the present model if it already fits. `id` is the id
    /// of the message, if it has one.
    pub(super) fn change(
        &self,
        id: Option<u64>,
        cause: Cause,
        change: impl FnOnce(&mut LiveState) -> Result<()>,
    ) -> Option<Event> {
        let mut inner = self.lock();
        if let Err(error) = change(&mut inner) {
            return Some(Event::rejection(id, &error));
        }
        let same = inner.finished.as_ref() == Some(&inner.request.inputs(inner.generation));
        let idle = inner.due.is_none() && inner.running.as_ref().is_none_or(|running| running.background);
        if same && idle {
            let present =
                inner.trouble.clone().or_else(|| inner.present().map(|it| Event::Model(Box::new(it))));
            if inner.cancelled.take().is_none() {
                return present;
            }
            // The present model is shown again, so inform all pages.
            present.iter().for_each(|event| self.send(event));
            return None;
        }
        inner.post(DueRun { cause, files: Vec::new(), at: Instant::now() });
        self.wake.notify_all();
        None
    }

    /// Opens a line of a file in the editor. Fails if there is no editor or the file does not belong to the script.
    fn open(&self, file: &str, line: usize) -> Result<()> {
        let Some(editor) = &self.editor else {
            return Err(
                Error::usage("no editor was specified").help("start with --editor 'code -g {file}:{line}'")
            );
        };
        editor.open(&self.own_file(file)?, line.max(1))
    }

    /// Returns the path of the script's file that errors and the list of files refer to by `name`.
    pub(super) fn own_file(&self, name: &str) -> Result<PathBuf> {
        let mut own: Vec<PathBuf> = self.lock().files.clone();
        own.extend(
            [&self.script]
                .into_iter()
                .chain(&self.options.inputs.stdlib)
                .chain([&CurvesFile::path_of(&self.script)])
                .filter_map(|path| path.canonicalize().ok()),
        );
        let script = self.script.canonicalize().unwrap_or_else(|_| self.script.clone());
        let root = script.parent().unwrap_or(Path::new("."));
        let candidates = [PathBuf::from(name), root.join(name)];
        let found =
            candidates.iter().filter_map(|path| path.canonicalize().ok()).find(|path| own.contains(path));
        let mut alike: Vec<&PathBuf> = own.iter().filter(|path| path.ends_with(name)).collect();
        alike.sort();
        alike.dedup();
        match (found, &alike[..]) {
            (Some(path), _) => Ok(path),
            // The name of a link to the script differs from the name of its target.
            (None, _) if name == self.script_name() => Ok(script),
            // A file in another folder by its file name, if that name is unique.
            (None, [path]) if !name.is_empty() => Ok((*path).clone()),
            (None, _) => {
                Err(Error::not_found("file", name, [], format!("{name:?} is not a file of the script")))
            }
        }
    }

    /// Returns the engine's name of `path`, a file of the script.
    pub(super) fn engine_name(&self, path: &Path) -> String {
        let is = |known: &Path| known.canonicalize().is_ok_and(|known| known == path);
        let whole = [&self.script].into_iter().chain(&self.options.inputs.stdlib).find(|known| is(known));
        let root = self.script.canonicalize().ok().and_then(|script| script.parent().map(Path::to_path_buf));
        let inner = root.as_deref().and_then(|root| path.strip_prefix(root).ok()).unwrap_or(path);
        match (whole, self.script.parent()) {
            (Some(whole), _) => whole.display().to_string(),
            (None, Some(folder)) => folder.join(inner).display().to_string(),
            (None, None) => inner.display().to_string(),
        }
    }
}
