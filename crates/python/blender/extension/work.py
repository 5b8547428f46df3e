"""Runs of scripts beside the user interface.

A change asks for a run; a thread runs the script; a timer of Blender puts the model into the file, because only the main
thread may change it. A change during a run cancels it. Without a user interface there are no timers, so runs are made at once.
"""

import contextlib
import os
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import bpy
import burgeon

# Time (s) between two looks at finished runs, and at the files of scripts.
PULSE, LOOK = 0.02, 0.3


class Cancelled(Exception):
    """A run whose settings have changed."""


@dataclass
class Job:
    """A run in a thread."""

    arguments: dict[str, Any]
    script: str
    begun: float = field(default_factory=time.perf_counter)
    is_cancelled: bool = False
    progress: str = ""
    parameters: dict[str, burgeon.Parameter] | None = None
    model: burgeon.Model | None = None
    error: str | None = None
    thread: threading.Thread | None = None

    def run(self) -> None:
        """Reads the parameters and runs the script; keeps the model or the error."""
        try:
            known = {key: it for key, it in self.arguments.items() if key in ("data", "values")}
            try:
                self.parameters = burgeon.parameters(self.script, **known)
            except burgeon.Error:
                # A value that the script does not have any more is left out.
                known.pop("values", None)
                self.parameters = burgeon.parameters(self.script, **known)
                values = self.arguments["values"]
                self.arguments["values"] = {name: it for name, it in values.items() if name in self.parameters}
            self.model = burgeon.run(self.script, progress=self.note, print=None, **self.arguments)
        except Cancelled:
            self.is_cancelled = True
        except burgeon.Error as error:
            self.error = str(error)
        except Exception as error:  # A failed thread must not stay unnoticed.
            self.error = f"{type(error).__name__}: {error}"

    def note(self, progress: burgeon.Progress) -> None:
        if self.is_cancelled:
            raise Cancelled
        self.progress = progress.text


# Jobs by the session ids of collections, collections that wait for a run, and those whose requests are held back.
_jobs: dict[int, Job] = {}
_waiting: set[int] = set()
_held: dict[int, bool] = {}
# Latest change of the files of a script, by the session ids of collections.
_stamps: dict[int, float] = {}
_looked = 0.0


def models() -> list[bpy.types.Collection]:
    """Returns the collections that are models."""
    return [it for it in bpy.data.collections if it.burgeon.is_model and it.library is None]


def is_running(collection: bpy.types.Collection) -> bool:
    """Returns true while the script of a collection runs or waits for its run."""
    return collection.session_uid in _jobs or collection.session_uid in _waiting


def progress_of(collection: bpy.types.Collection) -> str:
    """Returns the progress of the current run; empty if there is none."""
    job = _jobs.get(collection.session_uid)
    return job.progress if job else ""


def has_no_window() -> bool:
    """Returns true without a user interface, where nothing calls ``pulse``."""
    return bpy.app.background


def request(collection: bpy.types.Collection) -> None:
    """Asks for a run with the present settings."""
    key = collection.session_uid
    if not collection.burgeon.is_model or not collection.burgeon.script:
        return
    # An empty message tells that what is shown belongs to other settings.
    collection.burgeon.message = ""
    if key in _held:
        _held[key] = True
    elif has_no_window():
        job = job_of(collection)
        job.run()
        _finish(collection, job)
    else:
        _waiting.add(key)
        if key in _jobs:
            _jobs[key].is_cancelled = True


@contextlib.contextmanager
def one_request(collection: bpy.types.Collection, runs: bool = True) -> Iterator[None]:
    """Makes one run of all requests in the block; none if ``runs`` is false."""
    key = collection.session_uid
    if key in _held:
        yield
        return
    _held[key] = False
    try:
        yield
    finally:
        asked = _held.pop(key)
    if asked and runs:
        request(collection)


def job_of(collection: bpy.types.Collection) -> Job:
    from . import values

    settings = collection.burgeon
    script = bpy.path.abspath(settings.script)
    arguments = {"seed": settings.seed, "lod": settings.detail, "values": values.changed_values(collection)}
    if settings.data:
        arguments["data"] = [bpy.path.abspath(settings.data)]
    return Job(arguments, script)


def _finish(collection: bpy.types.Collection, job: Job) -> None:
    """Puts the result of a run into the file. A failed run leaves the last model."""
    from . import scene, values

    settings = collection.burgeon
    if job.parameters is not None:
        values.adopt(collection, job.parameters)
    settings.error = job.error or ""
    if job.model is not None:
        settings.warnings = "\n".join(str(it) for it in job.model.warnings)
        count = scene.show(job.model, collection)
        took = time.perf_counter() - job.begun
        settings.message = f"{job.model.triangle_count:,} triangles in {count:,} objects, {took:.2f} s"
    for area in (area for window in bpy.context.window_manager.windows for area in window.screen.areas):
        area.tag_redraw()


def _newest(script: str) -> float:
    """Returns the time of the latest change among the files of a script's folder that scripts may be made of."""
    newest = 0.0
    folder = os.path.dirname(script) or "."
    with contextlib.suppress(OSError):
        for entry in os.scandir(folder):
            if entry.name.endswith((".lua", ".luau", ".json", ".png", ".jpg", ".glb")):
                newest = max(newest, entry.stat().st_mtime)
    return newest


def _look_at_files() -> None:
    for collection in models():
        settings = collection.burgeon
        if not (settings.follows and settings.script):
            continue
        newest = _newest(bpy.path.abspath(settings.script))
        known = _stamps.get(collection.session_uid)
        _stamps[collection.session_uid] = newest
        if known is not None and newest != known:
            request(collection)


def pulse() -> float:
    """Begins and finishes runs. Blender calls it every few milliseconds."""
    global _looked
    now = time.perf_counter()
    if now - _looked > LOOK:
        _looked = now
        _look_at_files()
    by_key = {it.session_uid: it for it in models()}
    for key, job in list(_jobs.items()):
        if job.thread is not None and job.thread.is_alive():
            continue
        del _jobs[key]
        if key in by_key and not job.is_cancelled:
            _finish(by_key[key], job)
    for key in list(_waiting):
        if key not in by_key:
            _waiting.discard(key)
        elif key not in _jobs:
            _waiting.discard(key)
            job = job_of(by_key[key])
            job.thread = threading.Thread(target=job.run, daemon=True)
            _jobs[key] = job
            job.thread.start()
    return PULSE


@bpy.app.handlers.persistent
def _file_opened(*_: Any) -> None:
    """Forgets the runs of the last file, and reads the parameters of the models of this one."""
    for job in _jobs.values():
        job.is_cancelled = True
    _jobs.clear()
    _waiting.clear()
    _stamps.clear()
    from . import values

    for collection in models():
        if values.group(collection) is None:
            with contextlib.suppress(burgeon.Error):
                path = bpy.path.abspath(collection.burgeon.script)
                values.adopt(collection, burgeon.parameters(path))


@bpy.app.handlers.persistent
def _undone(*_: Any) -> None:
    """Runs the models of an undo step that was stored before their run had ended."""
    for collection in models():
        if not collection.burgeon.message:
            request(collection)


UNDO_HANDLERS = (bpy.app.handlers.undo_post, bpy.app.handlers.redo_post)


def register() -> None:
    bpy.app.handlers.load_post.append(_file_opened)
    for handlers in UNDO_HANDLERS:
        handlers.append(_undone)
    if not has_no_window():
        bpy.app.timers.register(pulse, persistent=True)


def unregister() -> None:
    bpy.app.handlers.load_post.remove(_file_opened)
    for handlers in UNDO_HANDLERS:
        handlers.remove(_undone)
    if bpy.app.timers.is_registered(pulse):
        bpy.app.timers.unregister(pulse)
    for job in _jobs.values():
        job.is_cancelled = True
